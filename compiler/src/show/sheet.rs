//! What a model consists of, ready to be printed: the content of all pages, and the JSON of `gaitc show --json`.
//!
//! Every formula is there as it was written and typeset; every quantity in SI units and as it is printed. What is marked
//! `skip` is for pages only.

use super::drawn::{Drawing, Published};
use serde::Serialize;

/// A model on paper.
#[derive(Clone, Debug, Serialize)]
pub struct Sheet {
    pub(super) model: String,
    pub(super) title: String,
    pub(super) source: String,
    pub(super) parameters: Vec<Parameter>,
    pub(super) states: Vec<State>,
    pub(super) memory: Vec<Memory>,
    pub(super) definitions: Vec<Definition>,
    pub(super) modes: Vec<Mode>,
    pub(super) transitions: Vec<Transition>,
    pub(super) surfaces: Vec<Surface>,
    pub(super) section: Option<Section>,
    pub(super) measures: Vec<Measure>,
    pub(super) problems: Vec<Problem>,
    pub(super) drawing: Option<Drawing>,
    pub(super) published: Vec<Published>,
}

/// A name and how it is set.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Name {
    pub(super) name: String,
    #[serde(rename = "symbol")]
    pub(super) latex: String,
    #[serde(skip)]
    pub(super) text: String,
}

/// An expression.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Formula {
    /// As the spec has it, names of parts replaced by those that the spec gives them.
    pub(super) source: String,
    pub(super) latex: String,
    /// For a terminal.
    #[serde(skip)]
    pub(super) text: String,
    /// The LaTeX in pieces between which a line may be broken.
    #[serde(skip)]
    pub(super) terms: Vec<String>,
}

/// A name and what it equals: `q_theta` in a reset, an embedding, a symmetry.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Assignment {
    #[serde(flatten)]
    pub(super) left: Name,
    #[serde(flatten)]
    pub(super) right: Formula,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameter {
    #[serde(flatten)]
    pub(super) name: Name,
    /// SI units.
    pub(super) value: f64,
    /// The unit in which it is printed.
    pub(super) unit: String,
    /// SI units.
    pub(super) range: Option<(f64, f64)>,
    pub(super) doc: String,
    /// The part that it comes from, seen from the folder of the spec.
    pub(super) part: Option<String>,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct State {
    #[serde(flatten)]
    pub(super) name: Name,
    pub(super) unit: String,
    /// The modes that have it; all of them without.
    pub(super) modes: Option<Vec<String>>,
    pub(super) doc: String,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Memory {
    #[serde(flatten)]
    pub(super) name: Name,
    pub(super) initial: i64,
    pub(super) doc: String,
}

/// A let, or a function with its arguments, that the model uses.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Definition {
    #[serde(flatten)]
    pub(super) name: Name,
    pub(super) arguments: Vec<Name>,
    #[serde(flatten)]
    pub(super) formula: Formula,
    pub(super) doc: String,
    pub(super) part: Option<String>,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Mode {
    pub(super) name: String,
    pub(super) doc: String,
    pub(super) equations: Vec<Equation>,
}

/// A row of M(x) x' = flow.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Equation {
    #[serde(flatten)]
    pub(super) state: Name,
    /// Entries of the row, each by the state whose rate it multiplies; empty for a row of the identity.
    pub(super) mass: Vec<Assignment>,
    pub(super) flow: Formula,
    /// The left side.
    #[serde(skip)]
    pub(super) left_text: String,
    #[serde(rename = "left_latex")]
    pub(super) left_latex: String,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Transition {
    pub(super) name: String,
    pub(super) from: String,
    pub(super) to: String,
    pub(super) guard: Formula,
    pub(super) direction: &'static str,
    pub(super) when: Option<Formula>,
    pub(super) also_zero: Vec<Formula>,
    pub(super) reset: Vec<Assignment>,
    pub(super) doc: String,
}

/// A surface inside a mode.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Surface {
    pub(super) name: String,
    pub(super) mode: String,
    pub(super) guard: Formula,
    pub(super) direction: &'static str,
    pub(super) doc: String,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Section {
    /// `after` or `before` a transition, or `at` a surface.
    pub(super) side: &'static str,
    /// The name of that.
    pub(super) of: String,
    pub(super) coordinates: Vec<Name>,
    pub(super) embed: Vec<Assignment>,
    pub(super) start: Vec<Start>,
    pub(super) symmetry: Option<Vec<Assignment>>,
}

impl Section {
    /// Where it stands, in words before the name.
    pub(super) fn place(&self) -> &'static str {
        match self.side {
            "before" => "Just before",
            "at" => "On the surface",
            _ => "Just after",
        }
    }
}

/// First guess of a coordinate.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Start {
    #[serde(flatten)]
    pub(super) name: Name,
    /// SI units.
    pub(super) value: f64,
    #[serde(skip)]
    pub(super) shown: String,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Measure {
    #[serde(flatten)]
    pub(super) name: Name,
    #[serde(flatten)]
    pub(super) formula: Formula,
    pub(super) unit: String,
    pub(super) doc: String,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct Problem {
    pub(super) name: String,
    pub(super) doc: String,
    pub(super) default: bool,
    /// `maximize` or `minimize`.
    pub(super) sense: &'static str,
    pub(super) objective: Formula,
    pub(super) vary: Vec<Vary>,
    /// Parameters that are only known to lie in ranges.
    pub(super) robust: Vec<Vary>,
    pub(super) subject_to: Vec<Formula>,
    /// How many maps make the gait.
    pub(super) period: usize,
}

/// A parameter with a range to vary it over, or in which it is known to lie.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Vary {
    #[serde(flatten)]
    pub(super) name: Name,
    /// SI units.
    pub(super) range: (f64, f64),
    #[serde(skip)]
    pub(super) shown: (String, String),
}

impl Parameter {
    /// The value as it is printed.
    pub(super) fn shown(&self) -> String {
        crate::front::format_quantity(self.value, &self.unit)
    }

    /// The range as it is printed; empty without.
    pub(super) fn shown_range(&self) -> Option<(String, String)> {
        self.range.map(|(lower, upper)| {
            let shown = |value| crate::front::format_quantity(value, &self.unit);
            (shown(lower), shown(upper))
        })
    }
}
