//! A diagram for people: range and stability windows of each branch, bifurcations, ends.

use super::windows::windows;
use super::{Report, words};
use crate::cli::output;
use gaitc_compiler::front::format_quantity;
use gaitc_runtime::study::continuation::{Branch, Diagram};

/// A spectral radius this close to 1 is that of a bifurcation.
const NEUTRAL: f64 = 1e-7;
/// How many gaits of a branch the table shows.
const ROWS: usize = 11;

impl Report<'_> {
    pub(super) fn text(&self, status: &str, message: &str, diagram: &Diagram) -> String {
        let name = &self.parameter().name;
        let [from, to] = [self.range.0, self.range.1].map(|v| words::value(self, v));
        let mut text =
            format!("{} · continue {name} from {from} to {to}\n{status}: {message}\n", self.loaded.spec.name);
        for warning in self.warnings {
            text += &format!("warning: {warning}\n");
        }
        if diagram.branches.is_empty() {
            return text
                + &format!(
                    "help: start at another value of {name} (--from QUANTITY), or from another guess (--guess COORD=QUANTITY)\n"
                );
        }
        for (number, branch) in diagram.branches.iter().enumerate() {
            text += &self.branch_text(diagram, number, branch);
        }
        for parent in &diagram.not_entered {
            let at = diagram.branches.get(parent.branch).and_then(|b| b.bifurcations.get(parent.bifurcation));
            if let Some(at) = at {
                text += &format!(
                    "\nthe branch at the {} of branch {} ({name} = {}) was not entered: no gait of it was found nearby\n",
                    words::kind(at.kind),
                    parent.branch + 1,
                    words::value(self, at.point.value)
                );
            }
        }
        text
    }

    fn branch_text(&self, diagram: &Diagram, number: usize, branch: &Branch) -> String {
        let maps = if branch.period == 1 { "1 map".to_owned() } else { format!("{} maps", branch.period) };
        let mut text = format!("\nbranch {} · gaits of {maps}{}\n", number + 1, self.origin(diagram, branch));
        if branch.repeats_sooner {
            let sooner = if branch.period == 2 { "1 map".to_owned() } else { format!("{} maps", branch.period / 2) };
            text += &format!("note: these gaits repeat after {sooner} already\n");
        }
        for window in windows(branch) {
            let [from, to] = [window.values.0, window.values.1].map(|v| words::value(self, v));
            text += &format!("  {} from {from} to {to}\n", if window.stable { "stable" } else { "not stable" });
        }
        text += &format!("\n{}", self.gaits(branch));
        if !branch.bifurcations.is_empty() {
            let rows = branch.bifurcations.iter().map(|b| {
                let at = words::value(self, b.point.value);
                vec![words::kind(b.kind).to_owned(), at, words::meaning(self, branch, b)]
            });
            text += &format!("\n{}", output::table(&["bifurcation", &self.parameter().name, "what happens"], rows));
        }
        text + &self.ends(diagram, branch)
    }

    fn origin(&self, diagram: &Diagram, branch: &Branch) -> String {
        let parent = branch.parent.and_then(|parent| {
            let from = diagram.branches.get(parent.branch)?.bifurcations.get(parent.bifurcation)?;
            Some((parent.branch + 1, from))
        });
        parent.map_or_else(String::new, |(number, from)| {
            format!(
                " · from the {} of branch {number} at {}",
                words::kind(from.kind),
                words::value(self, from.point.value)
            )
        })
    }

    /// Some gaits, spread along the branch.
    fn gaits(&self, branch: &Branch) -> String {
        let last = branch.points.len() - 1;
        let count = branch.points.len().min(ROWS);
        let spread = (0..count).map(|i| if count > 1 { i * last / (count - 1) } else { 0 });
        let rows = spread.filter_map(|i| branch.points.get(i)).map(|point| {
            let stable = match point.spectral_radius {
                radius if (radius - 1.0).abs() < NEUTRAL => "neutral",
                radius if radius < 1.0 => "stable",
                _ => "not stable",
            };
            let shown = format_quantity(self.shown.of(point), &self.shown.unit);
            vec![words::value(self, point.value), shown, format!("{:.6}", point.spectral_radius), stable.to_owned()]
        });
        output::table(&[&self.parameter().name, &self.shown.name, "spectral radius", ""], rows)
    }

    fn ends(&self, diagram: &Diagram, branch: &Branch) -> String {
        let at = [branch.points.first(), branch.points.last()];
        let mut text = String::new();
        let mut helps: Vec<String> = Vec::new();
        for ((name, point), end) in ["begins", "ends"].iter().zip(at).zip(&branch.ends) {
            let (why, help) = words::end(self, diagram, branch, end);
            let at = point.map_or_else(String::new, |point| words::value(self, point.value));
            text += &format!("{name} at {at}: {why}\n");
            helps.extend(help.filter(|help| !helps.contains(help)));
        }
        for help in helps {
            text += &format!("help: {help}\n");
        }
        format!("\n{text}")
    }
}
