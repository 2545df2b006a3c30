//! A model's equations at the stages of a step: solved for the rates of the state, differentiated for everything else.

use super::{Radau, Tabulated};
use crate::integrate::{Carried, Frame, Held, StepOf};
use crate::model::{Linearised, Model};
use crate::ode::Tolerance;
use crate::ode::radau::{Implicit, Polynomial, Rates, Tableau, Workspace, solve, weighted};
use crate::scalar::filled;
use core::marker::PhantomData;

/// Newton's method goes on until what is left is this fraction of the tolerance.
const NEWTON: f64 = 0.1;
/// Changes of so many units in the last place cannot be told from rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// How far the polynomial of the step before predicts, in its own lengths.
const REACH: f64 = 2.0;

/// The equations of a frame.
pub(super) struct Equation<'a, M, const P: usize, const Q: usize> {
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

/// The equations of `frame`.
pub(super) fn equation<M, const P: usize, const Q: usize>(frame: Frame<'_, P>) -> Equation<'_, M, P, Q> {
    Equation { frame, model: PhantomData }
}

impl<const S: usize> Radau<S>
where
    Self: Tabulated<S>,
{
    /// Solves for the rates of the state at the stages of `step`; false when that fails.
    #[inline(never)]
    pub(super) fn solve_state<
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
            if solved.is_none() {
                work.forget();
            }
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

    /// Variations and integrands at the stages of a step whose state is solved for.
    #[inline(never)]
    pub(super) fn differentiate<
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
        let k: Rates<N, S> = filled([0.0; N], |s| step.stages.k[s].x);
        let polynomial = Polynomial { tau: step.tau, h, start: step.start.x, rates: k };
        let x: [[f64; N]; S] = filled([0.0; N], |s| {
            let change = weighted(&t.a[s], &k);
            filled(0.0, |i| polynomial.start[i] + h * change[i])
        });
        let time = |s: usize| step.tau + t.c[s] * h;
        if held.columns > 0 {
            let place = (step.tau, h);
            if !work.differentiate(t, equation, place, &step.start.x, &k) {
                return false;
            }
            *evaluations += S;
            let forced: [[[f64; N]; C]; S] = filled([[0.0; N]; C], |s| R::forced(held, time(s), &x[s], &k[s]));
            for c in 0..held.columns.min(C) {
                let of_column = filled([0.0; N], |s| forced[s][c]);
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
    (theta(1.0) <= REACH).then(|| filled([0.0; N], |s| polynomial.rate(t, theta(t.c[s]))))
}
