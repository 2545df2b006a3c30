//! The two quantities of `--trade A:B` and which way each is better.

use crate::cli::{InputError, inputs};
use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::parse_objective;
use gaitc_compiler::front::{format_quantity, format_si, in_unit, si_unit};
use gaitc_compiler::ir::{Model, Node, NodeId, Problem, Sense, Symbol};

/// A quantity that is traded for another.
pub(super) struct Quantity {
    /// As the user wrote it, without the sense.
    pub(super) text: String,
    /// The expression in the spec's graph.
    pub(super) node: NodeId,
    pub(super) dimension: Dimension,
    /// The unit in which it is shown.
    pub(super) unit: String,
    /// Whether that unit is the user's.
    own_unit: bool,
    pub(super) sense: Sense,
}

impl Quantity {
    pub(super) fn is_spectral_radius(&self, spec: &Model) -> bool {
        matches!(spec.graph.node(self.node), Node::Symbol(Symbol::SpectralRadius))
    }

    /// A value in SI units as people read it.
    pub(super) fn show(&self, value: f64) -> String {
        if self.own_unit { format_quantity(value, &self.unit) } else { format_si(value, self.dimension) }
    }

    /// A value in SI units as a number in `unit`.
    pub(super) fn number(&self, value: f64) -> f64 {
        if self.own_unit { in_unit(value, &self.unit) } else { value }
    }

    /// Name and unit, for axes and columns.
    pub(super) fn label(&self) -> String {
        match self.unit.as_str() {
            "" | "1" => self.text.clone(),
            unit => format!("{} [{unit}]", self.text),
        }
    }
}

/// Reads `A:B`, each with `max` or `min` before it where the sense is not clear.
pub(super) fn pair(spec: &mut Model, problem: &Problem, text: &str) -> Result<(Quantity, Quantity), InputError> {
    let wrong = |what: &str| {
        InputError(format!(
            "--trade {text}: {what}\n  help: name two quantities, as in `--trade climb_speed:spectral_radius`; `max` or `min` before \
             one says which way it is better"
        ))
    };
    let [a, b] = text.split(':').collect::<Vec<_>>()[..] else {
        return Err(wrong("there are not two quantities with a `:` between them"));
    };
    let ((sense_a, a), (sense_b, b)) = (explicit(a), explicit(b));
    if a.is_empty() || b.is_empty() {
        return Err(wrong("a quantity is missing"));
    }
    if a == b {
        return Err(wrong("both quantities are the same"));
    }
    // A name that is not there is a better reason than a sense that is not known.
    for quantity in [a, b] {
        parse_objective(spec, quantity).map_err(inputs::given("--trade", text))?;
    }
    let known_a = sense_a.or_else(|| known(spec, problem, a));
    let known_b = sense_b.or_else(|| known(spec, problem, b));
    let (sense_a, sense_b) = match (known_a, known_b) {
        (Some(a), Some(b)) => (a, b),
        // What is gained in one is paid for in the other.
        (Some(a), None) => (a, opposite(a)),
        (None, Some(b)) => (opposite(b), b),
        (None, None) => {
            return Err(wrong(&format!(
                "no problem of the model says whether more or less of `{a}` or `{b}` is better"
            )));
        }
    };
    Ok((quantity(spec, a, sense_a)?, quantity(spec, b, sense_b)?))
}

/// A leading `max` or `min`.
fn explicit(text: &str) -> (Option<Sense>, &str) {
    let text = text.trim();
    let after = |word: &str| text.strip_prefix(word).filter(|rest| rest.starts_with(' ')).map(str::trim);
    match (after("max"), after("min")) {
        (Some(rest), _) => (Some(Sense::Maximize), rest),
        (None, Some(rest)) => (Some(Sense::Minimize), rest),
        (None, None) => (None, text),
    }
}

/// The sense that the problem, or another one of the spec, gives to a quantity.
fn known(spec: &Model, problem: &Problem, text: &str) -> Option<Sense> {
    if text == "spectral_radius" {
        return Some(Sense::Minimize);
    }
    let all = std::iter::once(problem).chain(&spec.problems);
    all.filter(|p| p.objective_text.trim() == text).map(|p| p.sense).next()
}

fn opposite(sense: Sense) -> Sense {
    match sense {
        Sense::Maximize => Sense::Minimize,
        Sense::Minimize => Sense::Maximize,
    }
}

fn quantity(spec: &mut Model, text: &str, sense: Sense) -> Result<Quantity, InputError> {
    let (node, dimension) = parse_objective(spec, text)?;
    if sense == Sense::Maximize && matches!(spec.graph.node(node), Node::Symbol(Symbol::SpectralRadius)) {
        return Err(InputError(
            "--trade: the spectral radius can only be minimised\n  help: leave out `max`".to_owned(),
        ));
    }
    let own = spec.measures.iter().find(|m| m.name == text).map(|m| m.unit.clone());
    let own_unit = own.is_some();
    let unit = own.unwrap_or_else(|| si_unit(dimension));
    Ok(Quantity { text: text.to_owned(), node, dimension, unit, own_unit, sense })
}
