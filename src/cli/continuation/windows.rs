//! Stability windows: for which values of the parameter the gaits of a branch are stable.

use gaitc_runtime::study::continuation::{Branch, Kind};

/// A piece of a branch whose gaits are all stable, or all not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) stable: bool,
    /// Smallest and largest value of the parameter (SI units).
    pub(super) values: (f64, f64),
}

/// The windows in order along the branch. Where stability changes, a window ends at the bifurcation that changes it; where it changes
/// by a jump, at the last point before it.
pub(super) fn windows(branch: &Branch) -> Vec<Window> {
    let mut all: Vec<Window> = Vec::new();
    for (i, point) in branch.points.iter().enumerate() {
        let stable = point.stable();
        // The first point of a branch may be the bifurcation that it comes from.
        if i == branch.start && branch.parent.is_some() {
            if let Some(window) = all.last_mut() {
                window.extend(point.value);
            }
            continue;
        }
        match all.last_mut().filter(|window| window.stable == stable) {
            Some(window) => window.extend(point.value),
            None => {
                let between = branch.bifurcations.iter().filter(|b| b.after + 1 == i);
                // Where another branch crosses, this one may change, too; in a step with both the other bifurcation does it.
                let between = between.min_by_key(|b| b.kind == Kind::Branch);
                let edge = between.map(|b| b.point.value);
                let origin =
                    (i > 0 && i - 1 == branch.start && branch.parent.is_some()).then(|| branch.points[i - 1].value);
                if let (Some(window), Some(edge)) = (all.last_mut(), edge) {
                    window.extend(edge);
                }
                let mut window = Window { stable, values: (point.value, point.value) };
                if let Some(edge) = edge.or(origin) {
                    window.extend(edge);
                }
                all.push(window);
            }
        }
        // Folds reach further than the points around them.
        if let Some(window) = all.last_mut() {
            let turns = branch.bifurcations.iter().filter(|b| b.after == i && b.kind == Kind::Fold);
            turns.for_each(|fold| window.extend(fold.point.value));
        }
    }
    all
}

impl Window {
    fn extend(&mut self, value: f64) {
        self.values = (self.values.0.min(value), self.values.1.max(value));
    }
}
