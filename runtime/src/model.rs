//! The ABI: what the compiler generates for a model, and what the runtime asks of it.
//!
//! A model is a type without data; all functions are associated functions, generic over [`Scalar`], allocation free and
//! panic free. An index out of range (mode, transition, switch, observable) or a slice of the wrong length gives NaN,
//! which the runtime reports as an outcome.
//!
//! Sizes: `N` states (the union over all modes), `P` parameters, `Q` time integrals. Matrices are arrays of *columns*
//! (`dx[j][i]` is the derivative of component `i` with respect to `x[j]`), the layout of `nalgebra::SMatrix`.
//!
//! The residual form F(x, k, tau, t, p; branch) = M(x) k - f, with k = x', serves implicit methods and singular mass
//! matrices; the explicit f is there for models without a mass matrix ([`ModelInfo::explicit`]). Integrands and
//! observables may depend on rates: a model with an explicit f puts it in their place, other models take k as an argument.

use crate::scalar::{Real, Scalar};

/// What a model function depends on besides the state. SI units.
#[derive(Clone, Copy, Debug)]
pub struct Env<'a, S: Scalar, const P: usize> {
    /// Time since the last transition (s).
    pub tau: S,
    /// Time since the start of the run (s).
    pub t: S,
    /// Parameters, in the order of [`ModelInfo::parameters`].
    pub p: &'a [S; P],
    /// Integer memory, in the order of [`ModelInfo::memory`].
    pub memory: &'a [S],
    /// Frozen branch selectors, one a switching function: true where the function is `>= 0`.
    pub branch: &'a [S::Mask],
}

/// A scalar function with all its first derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Gradient<S, const N: usize, const P: usize> {
    /// The value.
    pub value: S,
    /// With respect to the state.
    pub dx: [S; N],
    /// With respect to the parameters.
    pub dp: [S; P],
    /// With respect to tau.
    pub dtau: S,
    /// With respect to t.
    pub dt: S,
}

/// A state-valued function with all its first derivatives (arrays of columns).
#[derive(Clone, Copy, Debug)]
pub struct Jacobian<S, const N: usize, const P: usize> {
    /// The value.
    pub value: [S; N],
    /// With respect to the state.
    pub dx: [[S; N]; N],
    /// With respect to the parameters.
    pub dp: [[S; N]; P],
    /// With respect to tau.
    pub dtau: [S; N],
    /// With respect to t.
    pub dt: [S; N],
}

/// The residual F(x, k, ...) with all its first derivatives (arrays of columns).
#[derive(Clone, Copy, Debug)]
pub struct ResidualJacobian<S, const N: usize, const P: usize> {
    /// The value.
    pub value: [S; N],
    /// With respect to the state.
    pub dx: [[S; N]; N],
    /// With respect to the rate k: the mass matrix.
    pub dk: [[S; N]; N],
    /// With respect to the parameters.
    pub dp: [[S; N]; P],
    /// With respect to tau.
    pub dtau: [S; N],
    /// With respect to t.
    pub dt: [S; N],
}

/// The residual F(x, k, ...) with the matrices that Newton's method on it needs (arrays of columns).
#[derive(Clone, Copy, Debug)]
pub struct Linearised<S, const N: usize> {
    /// The value.
    pub value: [S; N],
    /// With respect to the state.
    pub dx: [[S; N]; N],
    /// With respect to the rate k: the mass matrix.
    pub dk: [[S; N]; N],
}

/// A scalar function of state and rate with all its first derivatives.
#[derive(Clone, Copy, Debug)]
pub struct RateGradient<S, const N: usize, const P: usize> {
    /// The value.
    pub value: S,
    /// With respect to the state.
    pub dx: [S; N],
    /// With respect to the rate k; zeros where the model has an explicit f, which stands in for k.
    pub dk: [S; N],
    /// With respect to the parameters.
    pub dp: [S; P],
    /// With respect to tau.
    pub dtau: S,
    /// With respect to t.
    pub dt: S,
}

/// C directions along which a function of state, rate, parameters and t is differentiated.
#[derive(Clone, Copy, Debug)]
pub struct Directions<'a, S, const N: usize, const P: usize, const C: usize> {
    /// Variations of the state.
    pub dx: &'a [[S; N]; C],
    /// Variations of the rate.
    pub dk: &'a [[S; N]; C],
    /// Variations of the parameters.
    pub dp: &'a [[S; P]; C],
    /// Variations of t.
    pub dt: &'a [S; C],
}

/// Flow, integrands and their variational columns, computed in one pass.
#[derive(Clone, Copy, Debug)]
pub struct Integrated<S, const N: usize, const Q: usize, const C: usize> {
    /// State derivative.
    pub flow: [S; N],
    /// Integrands.
    pub integrands: [S; Q],
    /// Derivatives of the state's variations.
    pub dflow: [[S; N]; C],
    /// Derivatives of the integrals' variations.
    pub dintegrands: [[S; Q]; C],
}

/// A compiled model.
pub trait Model<const N: usize, const P: usize, const Q: usize>: Copy + Default + Send + Sync + 'static {
    /// Names, units and structure.
    const INFO: &'static ModelInfo;

    /// State derivative f(x, ...), length N. Meaningful where `INFO.explicit`.
    fn flow<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> [S; N];

    /// f with all first derivatives.
    fn flow_jacobian<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> Jacobian<S, N, P>;

    /// f and, for each of C columns v of `dx`, (df/dx) v: the state's variational equation.
    fn variational<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        env: &Env<'_, S, P>,
    ) -> ([S; N], [[S; N]; C]);

    /// Terms of the flow and of its derivatives in the state that depend only on the clock, on parameters, memory and
    /// selectors.
    type Clock<S: Scalar>: Copy + Send + Sync;

    /// The terms of a mode at `env`.
    fn clock<S: Scalar>(mode: usize, env: &Env<'_, S, P>) -> Self::Clock<S>;

    /// The terms in one lane; NaN where there is no such lane.
    fn clock_lane<S: Real>(clock: &Self::Clock<S>, lane: usize) -> Self::Clock<f64>;

    /// What [`Self::variational`] gives, to rounding, from the terms at the same `env`.
    fn variational_at<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        clock: &Self::Clock<S>,
        env: &Env<'_, S, P>,
    ) -> ([S; N], [[S; N]; C]);

    /// f and integrands.
    fn integrated<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> ([S; N], [S; Q]);

    /// f and integrands and, for each of C columns (v, w) of (`dx`, `dp`), (d./dx) v + (d./dp) w.
    fn integrated_variational<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        dp: &[[S; P]; C],
        env: &Env<'_, S, P>,
    ) -> Integrated<S, N, Q, C>;

    /// Residual F(x, k, ...) = M(x) k - f.
    fn residual<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> [S; N];

    /// F with all first derivatives.
    fn residual_jacobian<S: Scalar>(
        mode: usize,
        x: &[S; N],
        k: &[S; N],
        env: &Env<'_, S, P>,
    ) -> ResidualJacobian<S, N, P>;

    /// F with its derivatives in x and k.
    fn residual_linearised<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> Linearised<S, N>;

    /// The Q integrands at state x and rate k.
    fn integrands<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> [S; Q];

    /// The integrands and their derivatives along C directions.
    fn integrands_along<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        k: &[S; N],
        along: &Directions<'_, S, N, P, C>,
        env: &Env<'_, S, P>,
    ) -> ([S; Q], [[S; Q]; C]);

    /// Switching function number `index`, evaluated under the frozen selectors of `env`.
    fn switch<S: Scalar>(index: usize, x: &[S; N], env: &Env<'_, S, P>) -> S;

    /// Switching function with all first derivatives.
    fn switch_gradient<S: Scalar>(index: usize, x: &[S; N], env: &Env<'_, S, P>) -> Gradient<S, N, P>;

    /// Guard of a transition.
    fn guard<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> S;

    /// Guard with all first derivatives.
    fn guard_gradient<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> Gradient<S, N, P>;

    /// Margin of a transition's `when`: enabled where it is `>= 0`; the constant 1 without `when`.
    fn when<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> S;

    /// State after a transition; `memory` receives the new memory (length of [`ModelInfo::memory`]).
    fn reset<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>, memory: &mut [S]) -> [S; N];

    /// State after a transition with all first derivatives.
    fn reset_jacobian<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> Jacobian<S, N, P>;

    /// Full state on the section from its coordinates `z` (length of [`ModelInfo::coordinates`]).
    fn embed<S: Scalar>(z: &[S], p: &[S; P]) -> [S; N];

    /// Derivatives of the embedding: `dz` receives one column a coordinate; the columns for the parameters are returned.
    fn embed_jacobian<S: Scalar>(z: &[S], p: &[S; P], dz: &mut [[S; N]]) -> [[S; N]; P];

    /// Image of a state under the symmetry (the identity without one).
    fn symmetry<S: Scalar>(x: &[S; N], p: &[S; P]) -> [S; N];

    /// Symmetry with its derivatives in state and parameters (`dtau` and `dt` are 0).
    fn symmetry_jacobian<S: Scalar>(x: &[S; N], p: &[S; P]) -> Jacobian<S, N, P>;

    /// Expression number `index` of those that start, end, maximum and minimum functionals refer to.
    fn observable<S: Scalar>(index: usize, mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> S;

    /// Observable with all first derivatives.
    fn observable_gradient<S: Scalar>(
        index: usize,
        mode: usize,
        x: &[S; N],
        k: &[S; N],
        env: &Env<'_, S, P>,
    ) -> RateGradient<S, N, P>;

    /// Measures (`out`) from the values of the functionals, in the order of [`ModelInfo::functionals`].
    fn measures<S: Scalar>(functionals: &[S], p: &[S; P], out: &mut [S]);

    /// Derivatives of the measures: with respect to the functionals (`dfunctionals`, row-major, one row a measure) and
    /// the parameters (`dp`, one array a measure).
    fn measures_jacobian<S: Scalar>(functionals: &[S], p: &[S; P], dfunctionals: &mut [S], dp: &mut [[S; P]]);
}

/// Name and unit of a number.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    /// Name in the spec.
    pub name: &'static str,
    /// SI base units, e.g. `m s^-1`; `1` for a pure number.
    pub si: &'static str,
}

/// In which direction a guard has to pass through zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From positive to negative.
    Falling,
    /// From negative to positive.
    Rising,
    /// Both.
    Either,
}

/// Structure of a transition.
#[derive(Clone, Copy, Debug)]
pub struct TransitionInfo {
    /// Name in the spec.
    pub name: &'static str,
    /// Index of the mode it leaves.
    pub from: usize,
    /// Index of the mode it enters.
    pub to: usize,
    /// Crossing direction that fires.
    pub direction: Direction,
    /// Other functions that are zero when it fires, by their functionals.
    pub also_zero: &'static [AlsoZero],
}

/// A function that vanishes together with a guard, so that people can see whether it would have served as the guard:
/// one that only touches zero would not. Indices into [`ModelInfo::functionals`].
#[derive(Clone, Copy, Debug)]
pub struct AlsoZero {
    /// The function as the spec writes it.
    pub text: &'static str,
    /// SI base units of the function.
    pub si: &'static str,
    /// Its value at the start of the map.
    pub start: usize,
    /// Its value just before the transition.
    pub end: usize,
    /// Its time derivative there.
    pub rate: usize,
}

/// Structure of a continuous mode.
#[derive(Clone, Copy, Debug)]
pub struct ModeInfo {
    /// Name in the spec.
    pub name: &'static str,
    /// Indices of the switching functions that its flow and the transitions from it depend on.
    pub switches: &'static [usize],
    /// Indices of those that matter when functionals are wanted too; contains `switches`.
    pub measured_switches: &'static [usize],
}

/// What a functional takes of its expression over one map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Functional {
    /// Time integral; index into the Q integrals.
    Integral(usize),
    /// Time integral over the duration; index into the Q integrals.
    Mean(usize),
    /// Observable just after the section's transition.
    Start(usize),
    /// Observable just before the next one.
    End(usize),
    /// Largest value of an observable.
    Maximum(usize),
    /// Smallest value of an observable.
    Minimum(usize),
    /// Duration of the map (s).
    Duration,
}

/// Where a Poincare section stands. A section on a surface inside a mode stands after a transition that changes nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Just after the transition of this index: a state on it is one that the reset has made.
    After(usize),
    /// Just before it: a map begins with the reset.
    Before(usize),
}

impl Section {
    /// Index of the transition.
    pub const fn transition(self) -> usize {
        match self {
            Self::After(transition) | Self::Before(transition) => transition,
        }
    }
}

/// Names, units and structure of a compiled model.
#[derive(Clone, Copy, Debug)]
pub struct ModelInfo {
    /// Name in the spec.
    pub name: &'static str,
    /// Hash of the equations it was compiled from.
    pub fingerprint: &'static str,
    /// Parameters.
    pub parameters: &'static [Quantity],
    /// States.
    pub states: &'static [Quantity],
    /// Integer memory.
    pub memory: &'static [&'static str],
    /// Modes.
    pub modes: &'static [ModeInfo],
    /// Transitions.
    pub transitions: &'static [TransitionInfo],
    /// What each switching function decides, for messages.
    pub switches: &'static [&'static str],
    /// Section: state indices of its coordinates; empty when the model has no section.
    pub coordinates: &'static [usize],
    /// Section: where it stands; `None` when the model has no section.
    pub section: Option<Section>,
    /// Section: state indices, coordinates left out, of what a gait has to lead back: everything that the motion depends on.
    pub returning: &'static [usize],
    /// Whether the section has a symmetry.
    pub symmetric: bool,
    /// Functionals, in the order that `measures` takes them.
    pub functionals: &'static [Functional],
    /// Measures.
    pub measures: &'static [Quantity],
    /// Whether the equations depend on t.
    pub uses_time: bool,
    /// Whether there is an explicit f (no mass matrix).
    pub explicit: bool,
}
