//! How a model is drawn and what others have published of it, on paper: content, and the lines of each page.

use super::escape::{latex, plain};
use super::literal::quantity_latex;
use super::sheet::{Formula, Start};
use super::wrap::{formula, wrapped};
use serde::Serialize;

/// `[drawing]`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Drawing {
    /// Of the body: to the right, and up.
    pub(super) velocity: Option<[Formula; 2]>,
    pub(super) points: Vec<DrawnPoint>,
    pub(super) links: Vec<[String; 2]>,
    /// Curves of one axis each.
    pub(super) panels: Vec<Vec<Formula>>,
}

/// A point seen from the body.
#[derive(Clone, Debug, Serialize)]
pub(super) struct DrawnPoint {
    pub(super) name: String,
    pub(super) at: [Formula; 2],
    /// The modes in which it is there; all of them without.
    pub(super) modes: Option<Vec<String>>,
    pub(super) held: bool,
    pub(super) doc: String,
}

/// `[published.NAME]`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Published {
    pub(super) name: String,
    pub(super) doc: String,
    pub(super) source: String,
    pub(super) set: Vec<Start>,
    pub(super) start: Vec<Start>,
    pub(super) measures: Vec<Start>,
    pub(super) section: Vec<Start>,
    pub(super) spread: Vec<Start>,
}

impl DrawnPoint {
    /// What there is to know of it besides its place.
    fn said(&self) -> String {
        let modes = self.modes.as_ref().map(|modes| format!("in {}", modes.join(", ")));
        let held = self.held.then(|| "stands still".to_owned());
        let doc = Some(self.doc.clone()).filter(|doc| !doc.is_empty());
        [doc, modes, held].into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}

impl Drawing {
    /// For a terminal.
    pub(super) fn text(&self) -> String {
        let pair = |[x, y]: &[Formula; 2]| format!("({}, {})", x.text, y.text);
        let mut body = String::new();
        if let Some(velocity) = &self.velocity {
            body += &formula("  body moves at ", &pair(velocity), 16);
        }
        for point in &self.points {
            body += &formula(&format!("  {} is at body + ", plain(&point.name)), &pair(&point.at), 16);
            let said = point.said();
            body += &if said.is_empty() { String::new() } else { wrapped("      ", &plain(&said), 6) };
        }
        for [a, b] in &self.links {
            body += &format!("  a line joins {} and {}\n", plain(a), plain(b));
        }
        for panel in &self.panels {
            let curves: Vec<&str> = panel.iter().map(|curve| curve.text.as_str()).collect();
            body += &formula("  a panel shows ", &curves.join(", "), 16);
        }
        body
    }

    /// A paragraph on each point of which there is something to say.
    pub(super) fn said(&self) -> impl Iterator<Item = String> {
        let said = self.points.iter().map(|point| (&point.name, point.said()));
        said.filter(|(_, said)| !said.is_empty()).map(|(name, said)| format!("{name}: {said}"))
    }

    /// Rows of a display.
    pub(super) fn latex(&self) -> Vec<String> {
        let pair = |[x, y]: &[Formula; 2]| format!("\\left({},\\, {}\\right)", x.latex, y.latex);
        let mut rows = Vec::new();
        rows.extend(self.velocity.iter().map(|v| format!("\\text{{velocity of the body}} & = {}", pair(v))));
        rows.extend(
            self.points
                .iter()
                .map(|point| format!("\\text{{{}, from the body}} & = {}", latex(&point.name), pair(&point.at))),
        );
        let line = |[a, b]: &[String; 2]| format!("\\text{{line}} & \\text{{ from {} to {}}}", latex(a), latex(b));
        rows.extend(self.links.iter().map(line));
        rows.extend(self.panels.iter().map(|panel| {
            let curves: Vec<&str> = panel.iter().map(|curve| curve.latex.as_str()).collect();
            format!("\\text{{panel}} & \\quad {}", curves.join(",\\, "))
        }));
        rows
    }
}

impl Published {
    /// For a terminal.
    pub(super) fn text(&self) -> String {
        let mut body = if self.doc.is_empty() { String::new() } else { wrapped("  ", &plain(&self.doc), 2) };
        body += &wrapped("  source: ", &plain(&self.source), 10);
        for (head, item) in self.items() {
            body += &wrapped("  ", &format!("{head}{} = {}", item.name.text, plain(&item.shown)), 6);
        }
        body
    }

    /// Rows of a display.
    pub(super) fn latex(&self) -> Vec<String> {
        let row = |(head, item): (&str, &Start)| {
            let head = if head.is_empty() { String::new() } else { format!("\\text{{{head}}} ") };
            format!("{head}{} & = {}", item.name.latex, quantity_latex(&item.shown))
        };
        self.items().map(row).collect()
    }

    /// Where the numbers stand, and what they are.
    pub(super) fn source(&self) -> String {
        let doc = if self.doc.is_empty() { String::new() } else { format!("{}; ", self.doc) };
        format!("{doc}source: {}", self.source)
    }

    /// All quantities, each with a word before it.
    fn items(&self) -> impl Iterator<Item = (&'static str, &Start)> {
        let at = self.set.iter().map(|item| ("at ", item));
        let from = self.start.iter().map(|item| ("from ", item));
        let numbers = self.measures.iter().chain(&self.section).map(|item| ("", item));
        let spread = self.spread.iter().map(|item| ("spread of ", item));
        at.chain(from).chain(numbers).chain(spread)
    }
}
