//! Radau IIA with S stages, for models in residual form: mass matrices, also singular ones, and stiff flows.

use super::{Carried, Frame, Held, Method, Point, Purpose, StateStep, StepOf, Typical};
use crate::model::{Linearised, Model};
use crate::ode::radau::{
    Implicit, Polynomial, RADAU3, RADAU5, Rates, Tableau, Workspace, size, solve, tolerance_of_estimate, weighted,
};
use crate::ode::{Bundle, Controller, OdeState, Tolerance};
use crate::return_map;
use core::marker::PhantomData;

/// Newton's method goes on until what is left is this fraction of the tolerance.
const NEWTON: f64 = 0.1;
/// Changes of so many units in the last place cannot be told from rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Factor of the tolerance for the error estimate.
const FACTOR: f64 = 3.0;
/// The same where functionals may take rates.
const FACTOR_WITH_RATES: f64 = 0.1;
/// How far the polynomial of the step before predicts, in its own lengths.
const REACH: f64 = 2.0;
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

/// The equations of a frame.
struct Equation<'a, M, const P: usize, const Q: usize> {
    frame: Frame<'a, P>,
    model: PhantomData<M>,
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize> Implicit<N> for Equation<'_, M, P, Q> {
    #[inline]
    fn residual(&self, tau: f64, x: &[f64; N], k: &[f64; N]) -> [f64; N] {
        M::residual(self.frame.mode, x, k, &self.frame.env(tau))
    }
    #[inline]
    fn linearised(&self, tau: f64, x: &[f64; N], k: &[f64; N]) -> Linearised<f64, N> {
        M::residual_linearised(self.frame.mode, x, k, &self.frame.env(tau))
    }
}

fn equation<M, const P: usize, const Q: usize>(frame: Frame<'_, P>) -> Equation<'_, M, P, Q> {
    Equation { frame, model: PhantomData }
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
        let k = core::array::from_fn(|s| Bundle { x: stages.k[s].x, q: [], dx: [], dq: [] });
        Stages { k, polynomial: stages.polynomial }
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
            let change = core::array::from_fn(|j| here[j] - at_start[j]);
            *stage = step.start_rates.advance(1.0, change, accepted.k.each_ref());
        }
        step.end_rates = step.stages.k[S - 1];
    }

    fn dense<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        _: Frame<'_, P>,
        step: &StateStep<Self, N>,
        _: &mut usize,
    ) -> Polynomial<N, S> {
        Polynomial {
            tau: step.tau,
            h: step.h,
            start: step.start.x,
            rates: core::array::from_fn(|s| step.stages.k[s].x),
        }
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
        let k: Rates<N, S> = core::array::from_fn(|s| step.stages.k[s].x);
        weighted(&Self::TABLEAU.slopes(u), &k).map(|v| v / step.h)
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

impl<const S: usize> Radau<S>
where
    Self: Tabulated<S>,
{
    /// Solves for the rates of the state at the stages of `step`; false when that fails.
    #[inline(never)]
    fn solve_state<
        M: Model<N, P, Q>,
        const N: usize,
        const P: usize,
        const Q: usize,
        const W: usize,
        const C: usize,
    >(
        equation: &Equation<'_, M, P, Q>,
        step: &mut StepOf<Self, N, W, C>,
        tolerance: Tolerance,
        work: &mut Workspace<N, S>,
        evaluations: &mut usize,
    ) -> bool {
        let (t, x, place) = (&Self::TABLEAU, step.start.x, (step.tau, step.h));
        let scale = newton_scale(&x, tolerance);
        let mut run = |mut k: Rates<N, S>| {
            let solved = solve(t, equation, place, &x, &mut k, &scale, work);
            *evaluations += S * solved.unwrap_or(1);
            solved.map(|_| k)
        };
        let flat = [step.start_rates.x; S];
        let predicted = step.stages.polynomial.and_then(|polynomial| predict(t, &polynomial, place));
        let solved = predicted.and_then(&mut run).or_else(|| run(flat));
        let Some(k) = solved else {
            return false;
        };
        for (stage, k) in step.stages.k.iter_mut().zip(&k) {
            stage.x = *k;
        }
        step.stages.polynomial = Some(Polynomial { tau: step.tau, h: step.h, start: x, rates: k });
        true
    }

    /// The error of the state alone.
    fn state_error<const N: usize, const W: usize, const C: usize>(
        step: &StepOf<Self, N, W, C>,
        estimate: Tolerance,
        work: &mut Workspace<N, S>,
    ) -> f64 {
        let t = &Self::TABLEAU;
        if !work.factorise_filter(step.h * t.gamma) {
            return f64::INFINITY;
        }
        let state = |x: [f64; N]| Bundle::<N, 0, 0> { x, q: [], dx: [], dq: [] };
        let k: [Bundle<N, 0, 0>; S] = core::array::from_fn(|s| state(step.stages.k[s].x));
        let start = state(step.start.x);
        let end = start.advance(step.h, t.a[S - 1], k.each_ref());
        let d = t.defect(step.h, &state(step.start_rates.x), &k);
        size(&start, &end, &state(work.filtered(&d.x)), estimate)
    }

    /// The error of everything; after [`Self::state_error`].
    fn error<const N: usize, const W: usize, const C: usize>(
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

    /// Variations and integrands at the stages of a step whose state is solved for.
    #[inline(never)]
    fn differentiate<
        M: Model<N, P, Q>,
        R: Carried<M, N, P, Q, W, C>,
        const N: usize,
        const P: usize,
        const Q: usize,
        const W: usize,
        const C: usize,
    >(
        held: &Held<'_, P, C>,
        equation: &Equation<'_, M, P, Q>,
        step: &mut StepOf<Self, N, W, C>,
        work: &mut Workspace<N, S>,
        evaluations: &mut usize,
    ) -> bool {
        if W == 0 && held.columns == 0 {
            return true;
        }
        let (t, h) = (&Self::TABLEAU, step.h);
        let k: Rates<N, S> = core::array::from_fn(|s| step.stages.k[s].x);
        let polynomial = Polynomial { tau: step.tau, h, start: step.start.x, rates: k };
        let x: [[f64; N]; S] = core::array::from_fn(|s| {
            let change = weighted(&t.a[s], &k);
            core::array::from_fn(|i| polynomial.start[i] + h * change[i])
        });
        let time = |s: usize| step.tau + t.c[s] * h;
        if held.columns > 0 {
            let place = (step.tau, h);
            if !work.differentiate(t, equation, place, &step.start.x, &k) {
                return false;
            }
            *evaluations += S;
            let forced: [[[f64; N]; C]; S] = core::array::from_fn(|s| R::forced(held, time(s), &x[s], &k[s]));
            for c in 0..held.columns.min(C) {
                let of_column = core::array::from_fn(|s| forced[s][c]);
                let dk = work.column(&step.start.dx[c], &of_column);
                for (stage, dk) in step.stages.k.iter_mut().zip(&dk) {
                    stage.dx[c] = *dk;
                }
            }
        }
        if W > 0 {
            for s in 0..S {
                let dk = step.stages.k[s].dx;
                let mut dx = step.start.dx;
                for (weight, stage) in t.a[s].iter().zip(&step.stages.k) {
                    for c in 0..held.columns.min(C) {
                        for i in 0..N {
                            dx[c][i] += h * weight * stage.dx[c][i];
                        }
                    }
                }
                let (q, dq) = R::integrands(held, time(s), (&x[s], &k[s]), (&dx, &dk));
                step.stages.k[s].q = q;
                step.stages.k[s].dq = dq;
            }
        }
        true
    }

    /// How little the rates at the start of a solved step are known: the size of the first term that its polynomial leaves
    /// out, extrapolated from the last two that it has.
    fn uncertainty<const N: usize, const W: usize, const C: usize>(
        step: &StepOf<Self, N, W, C>,
        tolerance: Tolerance,
    ) -> f64 {
        // Of the state alone: a variation may miss by a tolerance what slaves it, and is drawn back to it at once.
        let state = |x: [f64; N]| Bundle::<N, 0, 0> { x, q: [], dx: [], dq: [] };
        let k: Rates<N, S> = core::array::from_fn(|s| step.stages.k[s].x);
        let term = |m: usize| {
            let coefficient = weighted(&Self::TABLEAU.coefficient(m), &k).map(|v| step.h * v);
            let estimate = tolerance_of_estimate(tolerance, S, FACTOR_WITH_RATES);
            size(&state(step.start.x), &state(step.end.x), &state(coefficient), estimate)
        };
        let (last, before) = (term(S - 1), term(S - 2));
        if last == 0.0 { 0.0 } else { last * (last / before).min(1.0) }
    }
}

/// Size of a change of each state that does not matter.
fn newton_scale<const N: usize>(x: &[f64; N], tolerance: Tolerance) -> [f64; N] {
    let largest = x.iter().fold(1.0_f64, |largest, v| largest.max(v.abs()));
    let absolute = (NEWTON * tolerance.absolute * largest).max(f64::MIN_POSITIVE);
    let relative = (NEWTON * tolerance.relative).max(ROUNDING);
    x.map(|v| absolute + relative * v.abs())
}

/// The rates at the stages of a step at `place` as a polynomial solved for before predicts them; `None` where it is too far.
fn predict<const N: usize, const S: usize>(
    t: &Tableau<S>,
    polynomial: &Polynomial<N, S>,
    (tau, h): (f64, f64),
) -> Option<Rates<N, S>> {
    let theta = |c: f64| (tau + c * h - polynomial.tau) / polynomial.h;
    (theta(1.0) <= REACH).then(|| core::array::from_fn(|s| polynomial.rate(t, theta(t.c[s]))))
}
