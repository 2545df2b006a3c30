//! A diagram as a picture: branches over the parameter, bifurcations marked.

use super::{Report, words};
use crate::picture::{self, Branches, Curve, Event, Level, Mark, Panel, Series, label};
use gaitc_compiler::front::in_unit;
use gaitc_runtime::study::continuation::{Bifurcation, Branch, Diagram, Point};

/// More branches than this find no room above each other.
const MOST_PANELS: usize = 4;

impl Report<'_> {
    pub(super) fn picture(&self, diagram: &Diagram) -> Branches {
        let parameter = self.parameter();
        let marks = diagram.branches.iter().flat_map(|branch| &branch.bifurcations);
        let several = diagram.branches.len() > 1;
        let all = diagram.branches.iter().enumerate();
        Branches {
            title: format!("{}: gaits over {}", self.loaded.spec.name, parameter.name),
            x: label(&parameter.name, &parameter.unit),
            y: label(&self.shown.name, &self.shown.unit),
            branches: all.map(|(number, branch)| self.curve(several.then_some(number + 1), branch)).collect(),
            marks: marks.map(|b| Mark { at: self.at(&b.point), label: words::kind(b.kind).to_owned() }).collect(),
        }
    }

    /// The magnitudes of all multipliers over the parameter, one panel a branch: stable where all are below 1.
    pub(super) fn multipliers(&self, diagram: &Diagram) -> Series {
        let parameter = self.parameter();
        let several = diagram.branches.len() > 1;
        let panels = diagram.branches.iter().take(MOST_PANELS).enumerate().map(|(number, branch)| {
            let name = if several { format!("branch {}", number + 1) } else { "magnitude of multipliers".to_owned() };
            let level = Level { name: "1: stable below".to_owned(), value: 1.0, curve: None };
            Panel { y: name, curves: self.magnitudes(branch), levels: vec![level] }
        });
        let bifurcations = diagram.branches.iter().take(MOST_PANELS).flat_map(|branch| &branch.bifurcations);
        let event = |b: &Bifurcation| Event {
            at: in_unit(b.point.value, &parameter.unit),
            label: words::kind(b.kind).to_owned(),
        };
        let mut events: Vec<Event> = bifurcations.map(event).collect();
        events.sort_by(|a, b| a.at.total_cmp(&b.at));
        Series {
            title: format!("{}: magnitude of multipliers over {}", self.loaded.spec.name, parameter.name),
            x: label(&parameter.name, &parameter.unit),
            panels: panels.collect(),
            events,
        }
    }

    /// One curve a multiplier, the largest first, through gaits and bifurcations in order along the branch.
    fn magnitudes(&self, branch: &Branch) -> Vec<Curve> {
        let count = branch.points.iter().map(|point| point.multipliers.len()).max().unwrap_or(0);
        let name = |i: usize| match i {
            0 => "largest".to_owned(),
            i => format!("number {}", i + 1),
        };
        let curve = |i: usize| {
            let at = |point: &Point| {
                let magnitude = point.multipliers.get(i).map_or(f64::NAN, |m| m.norm());
                (in_unit(point.value, &self.parameter().unit), magnitude)
            };
            let mut points = Vec::new();
            for (index, point) in branch.points.iter().enumerate() {
                points.push(at(point));
                points.extend(branch.bifurcations.iter().filter(|b| b.after == index).map(|b| at(&b.point)));
            }
            Curve { name: name(i), points }
        };
        (0..count).map(curve).collect()
    }

    /// Parameter and shown quantity in the units of their labels.
    fn at(&self, point: &Point) -> (f64, f64) {
        (in_unit(point.value, &self.parameter().unit), in_unit(self.shown.of(point), &self.shown.unit))
    }

    /// A branch, cut exactly at its bifurcations.
    fn curve(&self, number: Option<usize>, branch: &Branch) -> picture::Branch {
        let (mut points, mut stable) = (Vec::new(), Vec::new());
        let entered = |i: usize| i == branch.start && branch.parent.is_some();
        // The gait on a bifurcation is neither: it belongs to the piece that it begins or ends.
        let holds = |i: usize| match branch.points.get(if entered(i) { i + 1 } else { i }) {
            Some(point) => point.stable(),
            None => branch.points[i].stable(),
        };
        for (i, point) in branch.points.iter().enumerate() {
            points.push(self.at(point));
            stable.push(holds(i));
            for bifurcation in branch.bifurcations.iter().filter(|b| b.after == i) {
                // Once for the piece before it, once for that behind.
                points.extend([self.at(&bifurcation.point); 2]);
                stable.extend([holds(i), holds((i + 1).min(branch.points.len() - 1))]);
            }
        }
        let maps = if branch.period == 1 { "1 map".to_owned() } else { format!("{} maps", branch.period) };
        let name = number.map_or_else(String::new, |number| format!("branch {number}: {maps}"));
        picture::Branch { name, points, stable }
    }
}
