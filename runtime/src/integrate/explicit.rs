//! The explicit method of order 8, for models with an explicit flow.

use super::{Carried, Frame, Held, Method, Point, Purpose, StateStep, StepOf, Typical};
use crate::model::Model;
use crate::ode::explicit::{Dense, ERROR_ORDER, Stages, attempt, error, stage_times, stiffness};
use crate::ode::{Bundle, Controller, Tolerance, first_step};
use crate::return_map;
use crate::scalar::filled;

/// The explicit method.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Explicit;

fn flow<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
) -> impl Fn(f64, &[f64; N]) -> [f64; N] {
    move |tau, x| M::flow(frame.mode, x, &frame.env(tau))
}

impl Method for Explicit {
    const KIND: return_map::Method = return_map::Method::Explicit;
    const RATES_BY_POLYNOMIAL: bool = false;
    type Stages<const N: usize, const W: usize, const C: usize> = Stages<Bundle<N, W, C>>;
    type Dense<const N: usize> = Dense<N>;
    type Workspace<const N: usize> = ();

    fn controller() -> Controller {
        Controller::new(ERROR_ORDER)
    }

    fn stages<const N: usize, const W: usize, const C: usize>() -> Stages<Bundle<N, W, C>> {
        [Bundle::ZERO; 12]
    }

    fn state_only<const N: usize, const W: usize, const C: usize>(
        stages: &Stages<Bundle<N, W, C>>,
    ) -> Stages<Bundle<N, 0, 0>> {
        filled(Bundle::ZERO, |s| Bundle { x: stages[s].x, q: [], dx: [], dq: [] })
    }

    fn expect<const N: usize, const W: usize, const C: usize>(
        _: &mut Self::Stages<N, W, C>,
        _: &Self::Stages<N, 0, 0>,
    ) {
        // Its stages are computed one after the other: nothing is guessed.
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
        (): &mut (),
        evaluations: &mut usize,
    ) -> Option<f64> {
        step.start_rates = R::rates(held, step.tau, &step.start);
        *evaluations += 1;
        Some(match typical {
            Typical::Size(h) => h,
            Typical::Longest(time) => {
                *evaluations += 1;
                let (tau, x, rate) = (step.tau, &step.start.x, &step.start_rates.x);
                first_step(&flow::<M, N, P, Q>(held.frame), tau, x, rate, tolerance, time)
            }
        })
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
        (): &mut (),
        evaluations: &mut usize,
    ) -> f64 {
        step.h = h;
        step.stages[0] = step.start_rates;
        step.end = stages::<M, R, N, P, Q, W, C>(held, step.tau, h, &step.start, &mut step.stages);
        *evaluations += 11;
        match purpose {
            Purpose::Advance => error(h, &step.start, &step.end, &step.stages, tolerance),
            Purpose::Land => 0.0,
        }
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
        held: &Held<'_, P, C>,
        step: &mut StepOf<Self, N, W, C>,
        evaluations: &mut usize,
    ) {
        step.end_rates = R::rates(held, step.tau + step.h, &step.end);
        *evaluations += 1;
    }

    fn take_rates<const N: usize, const W: usize, const C: usize>(
        _: &mut StepOf<Self, N, W, C>,
        _: &Stages<Bundle<N, W, C>>,
        _: f64,
    ) {
        // The flow gives the rates at any place.
    }

    fn dense<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        step: &StateStep<Self, N>,
        evaluations: &mut usize,
    ) -> Dense<N> {
        *evaluations += 3;
        Dense::new(step, &flow::<M, N, P, Q>(frame))
    }

    fn state<const N: usize>(dense: &Dense<N>, u: f64) -> [f64; N] {
        dense.at(u)
    }

    fn point<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        step: &StateStep<Self, N>,
        dense: &Dense<N>,
        u: f64,
    ) -> Point<N> {
        let x = dense.at(u);
        Point { x, k: M::flow(frame.mode, &x, &frame.env(step.tau + u * step.h)), bend: [0.0; N] }
    }

    fn bend<const N: usize, const W: usize, const C: usize>(_: &StepOf<Self, N, W, C>, _: f64) -> [f64; N] {
        [0.0; N]
    }

    fn rate<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        tau: f64,
        x: &[f64; N],
        _: &[f64; N],
    ) -> [f64; N] {
        M::flow(frame.mode, x, &frame.env(tau))
    }

    fn defined<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        tau: f64,
        x: &[f64; N],
        _: &[f64; N],
    ) -> bool {
        M::flow(frame.mode, x, &frame.env(tau)).iter().all(|v| v.is_finite())
    }

    fn stiffness<const N: usize, const W: usize, const C: usize>(step: &StepOf<Self, N, W, C>) -> f64 {
        stiffness(step.h, &step.start, &step.end, &step.end_rates, &step.stages)
    }
}

/// One step of everything; the one place where the method is compiled for a model and a number of columns.
#[inline(never)]
fn stages<
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
    const N: usize,
    const P: usize,
    const Q: usize,
    const W: usize,
    const C: usize,
>(
    held: &Held<'_, P, C>,
    tau: f64,
    h: f64,
    start: &Bundle<N, W, C>,
    stages: &mut Stages<Bundle<N, W, C>>,
) -> Bundle<N, W, C> {
    let times = stage_times(tau, h);
    let rates = |i: usize, y: &Bundle<N, W, C>| R::rates(held, times.get(i - 1).copied().unwrap_or(tau), y);
    attempt(&rates, h, start, stages)
}
