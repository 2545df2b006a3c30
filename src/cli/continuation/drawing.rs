//! A diagram as a picture: branches over the parameter, bifurcations marked.

use super::{Report, words};
use crate::picture::{self, Branches, Mark, label};
use gaitc_compiler::front::in_unit;
use gaitc_runtime::study::continuation::{Branch, Diagram, Point};

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
