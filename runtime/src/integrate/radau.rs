//! Radau IIA with S stages, for models in residual form: mass matrices, also singular ones, and stiff flows.

mod accuracy;
mod solving;

use super::{Carried, Frame, Held, Method, Point, Purpose, StateStep, StepOf, Typical};
use crate::model::Model;
use crate::ode::radau::{
    Implicit, Polynomial, RADAU3, RADAU5, Rates, Tableau, Workspace, tolerance_of_estimate, weighted,
};
use crate::ode::{Bundle, Controller, OdeState, Tolerance};
use crate::return_map;
use crate::scalar::filled;
use accuracy::{FACTOR, FACTOR_WITH_RATES};
use solving::equation;

/// The first rates of a segment come from a step of this fraction of a typical one ...
const SHORT: f64 = 0.01;
/// ... or of the longest time of a run, ...
const SHORTEST: f64 = 1e-6;
/// ... which is shortened this often ...
const SHORTENINGS: usize = 14;
/// ... until it knows those rates to this fraction of the tolerance.
const CERTAINTY: f64 = 1e-2;

/// Radau IIA with S stages.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Radau<const S: usize>;

/// Which numbers of stages there are.
pub(crate) trait Tabulated<const S: usize>: Copy {
    /// The public name.
    const KIND: return_map::Method;
    /// The coefficients.
    const TABLEAU: Tableau<S>;
}

impl Tabulated<3> for Radau<3> {
    const KIND: return_map::Method = return_map::Method::Radau3;
    const TABLEAU: Tableau<3> = RADAU3;
}

impl Tabulated<5> for Radau<5> {
    const KIND: return_map::Method = return_map::Method::Radau5;
    const TABLEAU: Tableau<5> = RADAU5;
}

/// What a step keeps: the rates of everything at its stages, and the last polynomial of the state that was solved for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stages<const N: usize, const W: usize, const C: usize, const S: usize> {
    k: [Bundle<N, W, C>; S],
    polynomial: Option<Polynomial<N, S>>,
}

impl<const S: usize> Method for Radau<S>
where
    Self: Tabulated<S>,
{
    const KIND: return_map::Method = <Self as Tabulated<S>>::KIND;
    const RATES_BY_POLYNOMIAL: bool = true;
    type Stages<const N: usize, const W: usize, const C: usize> = Stages<N, W, C, S>;
    type Dense<const N: usize> = Polynomial<N, S>;
    type Workspace<const N: usize> = Workspace<N, S>;

    fn controller() -> Controller {
        Controller::predictive((S + 1) as f64)
    }

    fn stages<const N: usize, const W: usize, const C: usize>() -> Stages<N, W, C, S> {
        Stages { k: [Bundle::ZERO; S], polynomial: None }
    }

    fn state_only<const N: usize, const W: usize, const C: usize>(stages: &Stages<N, W, C, S>) -> Stages<N, 0, 0, S> {
        let k = filled(Bundle::ZERO, |s| Bundle { x: stages.k[s].x, q: [], dx: [], dq: [] });
        Stages { k, polynomial: stages.polynomial }
    }

    fn expect<const N: usize, const W: usize, const C: usize>(
        stages: &mut Stages<N, W, C, S>,
        solved: &Stages<N, 0, 0, S>,
    ) {
        stages.polynomial = solved.polynomial;
    }

    fn begin<
        M: Model<N, P, Q>,
        R: Carried<M, N, P, Q, W, C>,
        const N: usize,
        const P: usize,
        const Q: usize,
        const W: usize,
        const C: usize,
    >(
        held: &Held<'_, P, C>,
        step: &mut StepOf<Self, N, W, C>,
        typical: Typical,
        tolerance: Tolerance,
        work: &mut Workspace<N, S>,
        evaluations: &mut usize,
    ) -> Option<f64> {
        let mut h = match typical {
            Typical::Size(h) => SHORT * h,
            Typical::Longest(time) => SHORTEST * time,
        };
        step.start_rates = Bundle::ZERO;
        work.forget();
        for _ in 0..SHORTENINGS {
            step.stages.polynomial = None;
            let solved =
                Self::attempt::<M, R, N, P, Q, W, C>(held, step, h, Purpose::Land, tolerance, work, evaluations);
            if solved == 0.0 {
                let uncertainty = Self::uncertainty(step, tolerance);
                if uncertainty <= CERTAINTY {
                    step.start_rates =
                        Bundle::ZERO.advance(1.0, Self::TABLEAU.coefficient(0), step.stages.k.each_ref());
                    if const { M::INFO.explicit } {
                        // Exactly zero where the flow is: guards that start at zero are armed by that.
                        step.start_rates.x = M::flow(held.frame.mode, &step.start.x, &held.frame.env(step.tau));
                    }
                    step.stages.polynomial = None;
                    return Some(match typical {
                        Typical::Size(known) => known,
                        Typical::Longest(_) => h * (0.1 / uncertainty).powf(1.0 / (S + 1) as f64).clamp(1.0, 1e4),
                    });
                }
            }
            h *= 0.125;
        }
        None
    }

    fn attempt<
        M: Model<N, P, Q>,
        R: Carried<M, N, P, Q, W, C>,
        const N: usize,
        const P: usize,
        const Q: usize,
        const W: usize,
        const C: usize,
    >(
        held: &Held<'_, P, C>,
        step: &mut StepOf<Self, N, W, C>,
        h: f64,
        purpose: Purpose,
        tolerance: Tolerance,
        work: &mut Workspace<N, S>,
        evaluations: &mut usize,
    ) -> f64 {
        step.h = h;
        let equation = equation::<M, P, Q>(held.frame);
        if R::MEASURED {
            // Functionals may take rates, which are to be solved for with the step's own matrix.
            work.forget();
        }
        if !Self::solve_state::<M, N, P, Q, W, C>(&equation, step, tolerance, work, evaluations) {
            let at_start = equation.residual(step.tau, &step.start.x, &step.start_rates.x);
            return if at_start.iter().all(|v| v.is_finite()) { f64::INFINITY } else { f64::NAN };
        }
        let advance = purpose == Purpose::Advance;
        let factor = if R::MEASURED { FACTOR_WITH_RATES } else { FACTOR };
        let estimate = tolerance_of_estimate(tolerance, S, factor);
        if advance {
            let error = Self::state_error(step, estimate, work);
            if error.is_nan() || error > 1.0 {
                return error;
            }
        }
        if !Self::differentiate::<M, R, N, P, Q, W, C>(held, &equation, step, work, evaluations) {
            return f64::INFINITY;
        }
        step.end = step.start.advance(h, Self::TABLEAU.a[S - 1], step.stages.k.each_ref());
        if advance { Self::error(held.columns, step, estimate, work) } else { 0.0 }
    }

    fn finish<
        M: Model<N, P, Q>,
        R: Carried<M, N, P, Q, W, C>,
        const N: usize,
        const P: usize,
        const Q: usize,
        const W: usize,
        const C: usize,
    >(
        _: &Held<'_, P, C>,
        step: &mut StepOf<Self, N, W, C>,
        _: &mut usize,
    ) {
        step.end_rates = step.stages.k[S - 1];
    }

    fn take_rates<const N: usize, const W: usize, const C: usize>(
        step: &mut StepOf<Self, N, W, C>,
        accepted: &Stages<N, W, C, S>,
        u: f64,
    ) {
        let t = &Self::TABLEAU;
        let at_start = t.values(0.0);
        for (i, stage) in step.stages.k.iter_mut().enumerate() {
            // The rate at the start is known better than the polynomial's, which knows how it changes.
            let here = t.values(u * t.c[i]);
            let change = filled(0.0, |j| here[j] - at_start[j]);
            *stage = step.start_rates.advance(1.0, change, accepted.k.each_ref());
        }
        step.end_rates = step.stages.k[S - 1];
    }

    fn dense<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        _: Frame<'_, P>,
        step: &StateStep<Self, N>,
        _: &mut usize,
    ) -> Polynomial<N, S> {
        Polynomial { tau: step.tau, h: step.h, start: step.start.x, rates: filled([0.0; N], |s| step.stages.k[s].x) }
    }

    fn state<const N: usize>(dense: &Polynomial<N, S>, u: f64) -> [f64; N] {
        dense.state(&Self::TABLEAU, u)
    }

    fn point<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        _: Frame<'_, P>,
        _: &StateStep<Self, N>,
        dense: &Polynomial<N, S>,
        u: f64,
    ) -> Point<N> {
        let t = &Self::TABLEAU;
        Point { x: dense.state(t, u), k: dense.rate(t, u), bend: dense.second_rate(t, u) }
    }

    fn bend<const N: usize, const W: usize, const C: usize>(step: &StepOf<Self, N, W, C>, u: f64) -> [f64; N] {
        let k: Rates<N, S> = filled([0.0; N], |s| step.stages.k[s].x);
        let sums = weighted(&Self::TABLEAU.slopes(u), &k);
        filled(0.0, |i| sums[i] / step.h)
    }

    fn rate<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        _: Frame<'_, P>,
        _: f64,
        _: &[f64; N],
        known: &[f64; N],
    ) -> [f64; N] {
        *known
    }

    fn defined<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        tau: f64,
        x: &[f64; N],
        k: &[f64; N],
    ) -> bool {
        M::residual(frame.mode, x, k, &frame.env(tau)).iter().all(|v| v.is_finite())
    }

    fn stiffness<const N: usize, const W: usize, const C: usize>(_: &StepOf<Self, N, W, C>) -> f64 {
        0.0
    }
}
