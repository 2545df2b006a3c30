//! Evaluation of single generated functions with sizes erased, so that every derivative can be checked from outside.
//!
//! `gaitc verify` and the derivative tests compare what this returns with an independent evaluation of the spec.

use crate::model::ModelInfo;

/// A generated function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// f of a mode.
    Flow(usize),
    /// f and integrands of a mode (states, then integrals).
    Integrated(usize),
    /// F of a mode.
    Residual(usize),
    /// A switching function.
    Switch(usize),
    /// Guard of a transition.
    Guard(usize),
    /// Reset of a transition (states).
    Reset(usize),
    /// Embedding of the section.
    Embed,
    /// Symmetry of the section.
    Symmetry,
    /// An observable (index, mode).
    Observable(usize, usize),
    /// All measures as functions of functionals and parameters.
    Measures,
}

/// A variable that derivatives are taken with respect to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// The states (for `Embed`: the section coordinates; for `Measures`: the functionals).
    State,
    /// The rate k.
    Rate,
    /// The parameters.
    Parameter,
    /// Time since the last transition.
    Tau,
    /// Time since the start.
    Time,
}

/// Where to evaluate. Slices have the model's lengths.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a> {
    /// States (for `Embed`: coordinates; for `Measures`: functionals).
    pub x: &'a [f64],
    /// Rates.
    pub k: &'a [f64],
    /// Parameters.
    pub p: &'a [f64],
    /// Memory.
    pub memory: &'a [f64],
    /// Branch selectors.
    pub branch: &'a [bool],
    /// Time since the last transition.
    pub tau: f64,
    /// Time since the start.
    pub t: f64,
}

/// Value and first derivatives.
#[derive(Clone, Debug, Default)]
pub struct Evaluation {
    /// The value.
    pub value: Vec<f64>,
    /// For each variable the derivative, row-major: one row a component of the value.
    pub derivatives: Vec<(Variable, Vec<Vec<f64>>)>,
}

impl PartialEq<Variable> for &Variable {
    fn eq(&self, other: &Variable) -> bool {
        **self == *other
    }
}

/// Access to the generated functions of a model.
pub trait Probe: Send + Sync {
    /// All functions that the model has.
    fn functions(&self, info: &ModelInfo) -> Vec<Function>;

    /// Value and derivatives of one function; `None` when a slice has the wrong length.
    fn probe(&self, function: Function, at: &Point<'_>) -> Option<Evaluation>;
}
