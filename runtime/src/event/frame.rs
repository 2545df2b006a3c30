//! A mode with everything held that stays constant while the clock runs: what event location needs of a run.
//!
//! Nothing here depends on the number of sensitivity columns, so it is compiled once a model.

use super::surface::{Reading, Surface, read};
use crate::model::{Env, Model};
use crate::ode::{Bundle, Stages, Step, attempt};

/// The step of the state alone.
pub(crate) type StateStep<const N: usize> = Step<Bundle<N, 0, 0>>;

/// Mode, start of the clock, parameters, memory, selectors.
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
}

impl<'a, const P: usize> Frame<'a, P> {
    /// The environment at `tau`.
    #[inline(always)]
    pub(crate) fn env(&self, tau: f64) -> Env<'a, f64, P> {
        Env { tau, t: self.start + tau, p: self.p, memory: self.memory, branch: self.branch }
    }

    /// The flow.
    #[inline]
    pub(crate) fn flow<M: Model<N, P, Q>, const N: usize, const Q: usize>(&self, tau: f64, x: &[f64; N]) -> [f64; N] {
        M::flow(self.mode, x, &self.env(tau))
    }

    /// Reads a surface at (`tau`, `x`).
    #[inline(never)]
    pub(crate) fn read<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        surface: Surface,
        tau: f64,
        x: &[f64; N],
    ) -> Reading {
        read::<M, N, P, Q>(surface, x, &self.flow::<M, N, Q>(tau, x), &self.env(tau))
    }

    /// The state after one step of size `h` from (`tau`, `x`), where the flow is `rate`.
    #[inline(never)]
    pub(crate) fn short_step<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        tau: f64,
        x: &[f64; N],
        rate: &[f64; N],
        h: f64,
    ) -> [f64; N] {
        let bundle = |x: [f64; N]| Bundle::<N, 0, 0> { x, q: [], dx: [], dq: [] };
        let mut k: Stages<Bundle<N, 0, 0>> = [bundle(*rate); 12];
        let rates = |tau: f64, y: &Bundle<N, 0, 0>| bundle(self.flow::<M, N, Q>(tau, &y.x));
        attempt(&rates, tau, h, &bundle(*x), &mut k).x
    }

    /// The state after `h` from the start of a step, by one step of that size.
    pub(crate) fn restep<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        step: &StateStep<N>,
        h: f64,
    ) -> [f64; N] {
        self.short_step::<M, N, Q>(step.tau, &step.start.x, &step.stages[0].x, h)
    }
}
