//! What stays constant while the clock tau runs: everything that a flow depends on besides state and tau.

use crate::model::Env;
use crate::ode::Tolerance;

/// Mode, start of the clock, parameters, memory, selectors; nothing here depends on the number of sensitivity columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<'a, const P: usize> {
    /// Index of the mode.
    pub(crate) mode: usize,
    /// Time since the start of the run at which tau was 0 (s).
    pub(crate) start: f64,
    /// Parameters.
    pub(crate) p: &'a [f64; P],
    /// Memory.
    pub(crate) memory: &'a [f64],
    /// Frozen branch selectors.
    pub(crate) branch: &'a [bool],
    /// Tolerance of the integration.
    pub(crate) tolerance: Tolerance,
}

impl<'a, const P: usize> Frame<'a, P> {
    /// The environment at `tau`.
    #[inline(always)]
    pub(crate) fn env(&self, tau: f64) -> Env<'a, f64, P> {
        Env { tau, t: self.start + tau, p: self.p, memory: self.memory, branch: self.branch }
    }
}

/// A frame with C columns of variations of parameters and start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Held<'a, const P: usize, const C: usize> {
    /// What does not depend on the columns.
    pub(crate) frame: Frame<'a, P>,
    /// Variations of the parameters, one array a column.
    pub(crate) dp: &'a [[f64; P]; C],
    /// Variations of the time at which tau was 0, one a column.
    pub(crate) dstart: &'a [f64; C],
    /// How many of the columns are in use; the others are zeros.
    pub(crate) columns: usize,
}
