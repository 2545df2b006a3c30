//! Evaluation of single generated functions with sizes erased, so that every derivative can be checked from outside.
//!
//! `gaitc verify` and the derivative tests compare what this returns with an independent evaluation of the spec.

mod evaluate;

use crate::hybrid::Hybrid;
use crate::model::{Functional, Model, ModelInfo};

/// A generated function. Indices are those of [`ModelInfo`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// f of a mode, by `flow_jacobian`.
    Flow(usize),
    /// The same by `variational`: derivatives in the state only.
    Variational(usize),
    /// The same by `variational_at`, from the terms of `clock`.
    Staged(usize),
    /// f and integrands of a mode (states, then integrals), by `integrated_variational`.
    Integrated(usize),
    /// F of a mode.
    Residual(usize),
    /// F of a mode, by `residual_linearised`: derivatives in state and rate only.
    Linearised(usize),
    /// Integrands of a mode, by `integrands_along`.
    Integrands(usize),
    /// A switching function.
    Switch(usize),
    /// Guard of a transition.
    Guard(usize),
    /// Reset of a transition (states).
    Reset(usize),
    /// Memory after a transition: no derivatives.
    Memory(usize),
    /// Margin of a transition's `when`: no derivatives.
    When(usize),
    /// Embedding of the section.
    Embed,
    /// Symmetry of the section.
    Symmetry,
    /// An observable in a mode.
    Observable {
        /// Index of the observable.
        index: usize,
        /// Index of the mode.
        mode: usize,
    },
    /// All measures as functions of functionals and parameters.
    Measures,
}

/// A variable that derivatives are taken with respect to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// The states.
    State,
    /// The section coordinates.
    Coordinate,
    /// The functionals.
    Functional,
    /// The rate k.
    Rate,
    /// The parameters.
    Parameter,
    /// Time since the last transition.
    Tau,
    /// Time since the start of the run.
    Time,
}

/// Where to evaluate. Slices have the model's lengths.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a> {
    /// States (for `Embed` its coordinates among them count).
    pub x: &'a [f64],
    /// Rates.
    pub k: &'a [f64],
    /// Parameters.
    pub p: &'a [f64],
    /// Memory.
    pub memory: &'a [f64],
    /// Functionals.
    pub functionals: &'a [f64],
    /// Branch selectors.
    pub branch: &'a [bool],
    /// Time since the last transition.
    pub tau: f64,
    /// Time since the start of the run.
    pub t: f64,
}

/// Value and first derivatives of a function.
#[derive(Clone, Debug, Default)]
pub struct Evaluation {
    /// The value as the derivative-carrying function computes it.
    pub value: Vec<f64>,
    /// The value as the function without derivatives computes it.
    pub plain: Vec<f64>,
    /// For each variable the derivative by columns: one column a component of the variable.
    pub derivatives: Vec<(Variable, Vec<Vec<f64>>)>,
}

/// Access to the generated functions of a model.
pub trait Probe: Send + Sync {
    /// Value and derivatives of one function; `None` when a slice has the wrong length or the index is out of range.
    fn probe(&self, function: Function, at: &Point<'_>) -> Option<Evaluation>;
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize> Probe for Hybrid<M, N, P, Q> {
    fn probe(&self, function: Function, at: &Point<'_>) -> Option<Evaluation> {
        evaluate::evaluate::<M, N, P, Q>(function, at)
    }
}

/// All functions that a model has.
pub fn functions(info: &ModelInfo) -> Vec<Function> {
    let modes = 0..info.modes.len();
    let mut all = Vec::new();
    for mode in modes.clone() {
        if info.explicit {
            all.extend([Function::Flow(mode), Function::Variational(mode), Function::Staged(mode)]);
            all.push(Function::Integrated(mode));
        }
        all.extend([Function::Residual(mode), Function::Linearised(mode)]);
        if integrals(info) > 0 {
            all.push(Function::Integrands(mode));
        }
    }
    all.extend((0..info.switches.len()).map(Function::Switch));
    for transition in 0..info.transitions.len() {
        all.extend([Function::Guard(transition), Function::When(transition), Function::Reset(transition)]);
        if !info.memory.is_empty() {
            all.push(Function::Memory(transition));
        }
    }
    if info.section.is_some() {
        all.push(Function::Embed);
    }
    if info.symmetric {
        all.push(Function::Symmetry);
    }
    for index in 0..observables(info) {
        all.extend(modes.clone().map(|mode| Function::Observable { index, mode }));
    }
    if !info.measures.is_empty() {
        all.push(Function::Measures);
    }
    all
}

/// Number of time integrals.
pub fn integrals(info: &ModelInfo) -> usize {
    let index = |f: &Functional| match *f {
        Functional::Integral(i) | Functional::Mean(i) => Some(i + 1),
        _ => None,
    };
    info.functionals.iter().filter_map(index).max().unwrap_or(0)
}

/// Number of observables.
pub fn observables(info: &ModelInfo) -> usize {
    let index = |f: &Functional| match *f {
        Functional::Start(i) | Functional::End(i) | Functional::Maximum(i) | Functional::Minimum(i) => Some(i + 1),
        Functional::Integral(_) | Functional::Mean(_) | Functional::Duration => None,
    };
    info.functionals.iter().filter_map(index).max().unwrap_or(0)
}
