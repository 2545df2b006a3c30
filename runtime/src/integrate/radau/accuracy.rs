//! How large the error of a step is, and how well the first rates of a segment are known.

use super::{Radau, Tabulated};
use crate::integrate::StepOf;
use crate::ode::radau::{Rates, Workspace, size, tolerance_of_estimate, weighted};
use crate::ode::{Bundle, OdeState, Tolerance};
use crate::scalar::filled;

/// Factor of the tolerance for the error estimate.
pub(super) const FACTOR: f64 = 3.0;
/// The same where functionals may take rates.
pub(super) const FACTOR_WITH_RATES: f64 = 0.1;

impl<const S: usize> Radau<S>
where
    Self: Tabulated<S>,
{
    /// The error of the state alone.
    pub(super) fn state_error<const N: usize, const W: usize, const C: usize>(
        step: &StepOf<Self, N, W, C>,
        estimate: Tolerance,
        work: &mut Workspace<N, S>,
    ) -> f64 {
        let t = &Self::TABLEAU;
        if !work.factorise_filter(step.h * t.gamma) {
            return f64::INFINITY;
        }
        let state = |x: [f64; N]| Bundle::<N, 0, 0> { x, q: [], dx: [], dq: [] };
        let k: [Bundle<N, 0, 0>; S] = filled(Bundle::ZERO, |s| state(step.stages.k[s].x));
        let start = state(step.start.x);
        let end = start.advance(step.h, t.a[S - 1], k.each_ref());
        let d = t.defect(step.h, &state(step.start_rates.x), &k);
        size(&start, &end, &state(work.filtered(&d.x)), estimate)
    }

    /// The error of everything; after [`Self::state_error`].
    pub(super) fn error<const N: usize, const W: usize, const C: usize>(
        columns: usize,
        step: &StepOf<Self, N, W, C>,
        estimate: Tolerance,
        work: &mut Workspace<N, S>,
    ) -> f64 {
        let mut e = Self::TABLEAU.defect(step.h, &step.start_rates, &step.stages.k);
        e.x = work.filtered(&e.x);
        for column in e.dx.iter_mut().take(columns) {
            *column = work.filtered(column);
        }
        size(&step.start, &step.end, &e, estimate)
    }

    /// How little the rates at the start of a solved step are known: the size of the first term that its polynomial leaves
    /// out, extrapolated from the last two that it has.
    pub(super) fn uncertainty<const N: usize, const W: usize, const C: usize>(
        step: &StepOf<Self, N, W, C>,
        tolerance: Tolerance,
    ) -> f64 {
        // Of the state alone: a variation may miss by a tolerance what slaves it, and is drawn back to it at once.
        let state = |x: [f64; N]| Bundle::<N, 0, 0> { x, q: [], dx: [], dq: [] };
        let k: Rates<N, S> = filled([0.0; N], |s| step.stages.k[s].x);
        let term = |m: usize| {
            let coefficient = weighted(&Self::TABLEAU.coefficient(m), &k).map(|v| step.h * v);
            let estimate = tolerance_of_estimate(tolerance, S, FACTOR_WITH_RATES);
            size(&state(step.start.x), &state(step.end.x), &state(coefficient), estimate)
        };
        let (last, before) = (term(S - 1), term(S - 2));
        if last == 0.0 { 0.0 } else { last * (last / before).min(1.0) }
    }
}
