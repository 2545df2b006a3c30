//! One smooth step of a model, by any method: what event location and runs see of integration.
//!
//! [`Frame`] and [`Held`] are what stays constant while the clock runs, [`Carried`] says which of a model's functions are
//! integrated along with the state, [`Method`] is what every integration method does. A new method is a new file here on
//! top of its numerics in `ode`.

mod carried;
mod explicit;
mod frame;
mod radau;

pub(crate) use carried::{Bare, Carried, Whole};
pub(crate) use explicit::Explicit;
pub(crate) use frame::{Frame, Held};
pub(crate) use radau::Radau;

use crate::model::Model;
use crate::ode::{Bundle, Controller, Step, Tolerance};
use crate::return_map;
use core::fmt::Debug;

/// A step by method X: N states, W integrals, C columns of variations.
pub(crate) type StepOf<X, const N: usize, const W: usize, const C: usize> =
    Step<Bundle<N, W, C>, <X as Method>::Stages<N, W, C>>;

/// The step of the state alone.
pub(crate) type StateStep<X, const N: usize> = StepOf<X, N, 0, 0>;

/// State and rate at a point of a solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<const N: usize> {
    /// The state.
    pub(crate) x: [f64; N],
    /// Its rate.
    pub(crate) k: [f64; N],
    /// The derivative of the rate; zeros where the method has an explicit flow, which stands in for rates everywhere.
    pub(crate) bend: [f64; N],
}

/// What a step is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To go on: its error decides.
    Advance,
    /// To stand at a place inside a step that was accepted.
    Land,
}

/// An integration method.
pub(crate) trait Method: Copy + Debug + Send + Sync + 'static {
    /// Its public name.
    const KIND: return_map::Method;
    /// Whether the rate at the end of a step is no better than the polynomial through its stages.
    const RATES_BY_POLYNOMIAL: bool;
    /// What it keeps of a step.
    type Stages<const N: usize, const W: usize, const C: usize>: Copy + Debug;
    /// Its continuous output.
    type Dense<const N: usize>: Copy + Debug;
    /// Room that is used again from step to step.
    type Workspace<const N: usize>: Default + Debug;

    /// Its step size control.
    fn controller() -> Controller;

    /// No stages yet.
    fn stages<const N: usize, const W: usize, const C: usize>() -> Self::Stages<N, W, C>;

    /// The part of the stages that concerns the state alone.
    fn state_only<const N: usize, const W: usize, const C: usize>(
        stages: &Self::Stages<N, W, C>,
    ) -> Self::Stages<N, 0, 0>;

    /// What the next attempt is to expect: the stages of a step that was solved for, of the same run or of one nearby, which
    /// reaches over the same time or further. A method that solves for its stages starts from there.
    fn expect<const N: usize, const W: usize, const C: usize>(
        stages: &mut Self::Stages<N, W, C>,
        solved: &Self::Stages<N, 0, 0>,
    );

    /// Fills in the rates at the start of a step that begins a segment; `typical` is a typical step size. Returns a size for
    /// the first step, `None` where the start contradicts the equations.
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
        work: &mut Self::Workspace<N>,
        evaluations: &mut usize,
    ) -> Option<f64>;

    /// Takes a step of size `h`: fills in stages and end. Returns the error relative to the tolerance (0 when it
    /// lands): not a number where a value is not finite, infinite where the step cannot be solved.
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
        work: &mut Self::Workspace<N>,
        evaluations: &mut usize,
    ) -> f64;

    /// Fills in the rates at the end of a step that was taken.
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
    );

    /// Takes the rates of a step that is a small part `u` of one that was accepted, with stages `accepted`, from that one:
    /// over so short a time differences of states say nothing about rates.
    fn take_rates<const N: usize, const W: usize, const C: usize>(
        step: &mut StepOf<Self, N, W, C>,
        accepted: &Self::Stages<N, W, C>,
        u: f64,
    );

    /// The continuous output of a step.
    fn dense<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        step: &StateStep<Self, N>,
        evaluations: &mut usize,
    ) -> Self::Dense<N>;

    /// The state at the fraction `u` of the step.
    fn state<const N: usize>(dense: &Self::Dense<N>, u: f64) -> [f64; N];

    /// State and rate at the fraction `u` of the step.
    fn point<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        step: &StateStep<Self, N>,
        dense: &Self::Dense<N>,
        u: f64,
    ) -> Point<N>;

    /// The derivative of the rate at the fraction `u` of a step that was taken; zeros as in [`Point::bend`].
    fn bend<const N: usize, const W: usize, const C: usize>(step: &StepOf<Self, N, W, C>, u: f64) -> [f64; N];

    /// The rate at (`tau`, `x`) under the frame's selectors; a method without explicit flow takes `known`.
    fn rate<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        tau: f64,
        x: &[f64; N],
        known: &[f64; N],
    ) -> [f64; N];

    /// Whether the equations have finite values at (`tau`, `x`) with rates near `k`.
    fn defined<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        frame: Frame<'_, P>,
        tau: f64,
        x: &[f64; N],
        k: &[f64; N],
    ) -> bool;

    /// How far an accepted step reaches beyond the method's stability: above 1 it is limited by stability.
    fn stiffness<const N: usize, const W: usize, const C: usize>(step: &StepOf<Self, N, W, C>) -> f64;
}

/// What is known about step sizes where a segment begins.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Typical {
    /// The size of the last step before.
    Size(f64),
    /// Nothing but the longest time of a run.
    Longest(f64),
}

/// The part of a step that concerns the state alone.
pub(crate) fn state_step<X: Method, const N: usize, const W: usize, const C: usize>(
    step: &StepOf<X, N, W, C>,
) -> StateStep<X, N> {
    let state = |b: &Bundle<N, W, C>| Bundle::<N, 0, 0> { x: b.x, q: [], dx: [], dq: [] };
    Step {
        tau: step.tau,
        h: step.h,
        start: state(&step.start),
        start_rates: state(&step.start_rates),
        stages: X::state_only(&step.stages),
        end: state(&step.end),
        end_rates: state(&step.end_rates),
    }
}

/// State and rate after `h` from the start of a step, by one step of that size, which replaces it.
#[inline(never)]
pub(crate) fn restep<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    step: &mut StateStep<X, N>,
    h: f64,
    work: &mut X::Workspace<N>,
    evaluations: &mut usize,
) -> ([f64; N], [f64; N]) {
    let held = Held { frame, dp: &[], dstart: &[], columns: 0 };
    X::attempt::<M, Bare, N, P, Q, 0, 0>(&held, step, h, Purpose::Land, frame.tolerance, work, evaluations);
    X::finish::<M, Bare, N, P, Q, 0, 0>(&held, step, evaluations);
    (step.end.x, step.end_rates.x)
}

/// State and rate after one step of size `h` from (`tau`, `x`), where the rate is `k`.
pub(crate) fn short_step<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    tau: f64,
    (x, k): (&[f64; N], &[f64; N]),
    h: f64,
) -> [f64; N] {
    let bundle = |x: &[f64; N]| Bundle::<N, 0, 0> { x: *x, q: [], dx: [], dq: [] };
    let (start, start_rates) = (bundle(x), bundle(k));
    let mut step = Step { tau, h, start, start_rates, stages: X::stages(), end: start, end_rates: start_rates };
    restep::<X, M, N, P, Q>(frame, &mut step, h, &mut X::Workspace::<N>::default(), &mut 0).0
}
