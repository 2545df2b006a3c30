//! The rates of the stages, by Newton's method on all of them at once.
//!
//! The matrix has the blocks delta_ij F_k + h a_ij F_x, each row of blocks with the derivatives at its own stage: where the
//! mass matrix changes from nothing to full size within a step, one matrix for all stages would not do. It is kept as long
//! as the iteration contracts well.

use super::coefficients::Tableau;
use super::elimination::{Solution, System};
use super::inverse::Inverse;
use super::polynomial::weighted;
use crate::model::Linearised;
use crate::scalar::filled;

/// Most iterations of one step.
const ITERATIONS: usize = 14;
/// A matrix is kept where it will take so many more iterations at most: a new one costs about as much.
const PATIENCE: f64 = 5.0;
/// A matrix serves for steps that differ from its own by this fraction.
const NEARLY: f64 = 1e-4;

/// An equation F(tau, x, k) = 0 for the rate k of the state x.
pub trait Implicit<const N: usize> {
    /// F.
    fn residual(&self, tau: f64, x: &[f64; N], k: &[f64; N]) -> [f64; N];
    /// F with its derivatives in x and k.
    fn linearised(&self, tau: f64, x: &[f64; N], k: &[f64; N]) -> Linearised<f64, N>;
}

/// Rates of the stages.
pub type Rates<const N: usize, const S: usize> = [[f64; N]; S];

/// Derivatives and matrices, used again from step to step.
#[derive(Clone, Debug)]
pub struct Workspace<const N: usize, const S: usize> {
    /// Derivatives at the stages.
    pub(super) linearised: [Linearised<f64, N>; S],
    /// The equations of all stages.
    pub(super) stages: System<N, S>,
    /// The step whose matrix is factorised: its tau, size and state at the start.
    made: Option<(f64, f64, [f64; N])>,
    /// Derivatives at the last stage, where the matrix of Newton's method was made.
    pub(super) end: Linearised<f64, N>,
    /// The matrix of the error estimate.
    pub(super) filter: Inverse,
    /// What its rows were multiplied with.
    pub(super) filter_scales: [f64; N],
}

impl<const N: usize, const S: usize> Default for Workspace<N, S> {
    fn default() -> Self {
        let zero = Linearised { value: [0.0; N], dx: [[0.0; N]; N], dk: [[0.0; N]; N] };
        Self {
            linearised: [zero; S],
            stages: System::default(),
            made: None,
            end: zero,
            filter: Inverse::default(),
            filter_scales: [1.0; N],
        }
    }
}

impl<const N: usize, const S: usize> Workspace<N, S> {
    /// Forgets the matrix: the equations may have changed.
    pub fn forget(&mut self) {
        self.made = None;
    }

    /// Whether the matrix is that of a step from the same start of nearly this size.
    fn stands(&self, (tau, h): (f64, f64), x: &[f64; N]) -> bool {
        self.made.is_some_and(|(t, size, start)| t == tau && start == *x && (h - size).abs() <= NEARLY * size)
    }

    /// Linearises at the stages with rates `k` and factorises; false when the matrix is singular.
    pub(super) fn linearise<E: Implicit<N>>(
        &mut self,
        tableau: &Tableau<S>,
        equation: &E,
        (tau, h): (f64, f64),
        x: &[f64; N],
        k: &Rates<N, S>,
    ) -> bool {
        for (i, slot) in self.linearised.iter_mut().enumerate() {
            *slot = equation.linearised(tau + tableau.c[i] * h, &state_at(tableau, i, h, x, k), &k[i]);
        }
        let regular = self.stages.factorise(tableau, h, &self.linearised);
        self.made = regular.then_some((tau, h, *x));
        regular
    }
}

/// State at stage i.
#[inline]
pub(super) fn state_at<const N: usize, const S: usize>(
    tableau: &Tableau<S>,
    i: usize,
    h: f64,
    x: &[f64; N],
    k: &Rates<N, S>,
) -> [f64; N] {
    let change = weighted(&tableau.a[i], k);
    filled(0.0, |a| x[a] + h * change[a])
}

/// Solves for the rates `k` of the stages of a step of size `h` from (`tau`, `x`), starting from what `k` holds. `scale` is
/// the size of a change of each state that does not matter. Returns how many iterations it took; `None` when they do not
/// converge.
pub fn solve<E: Implicit<N>, const N: usize, const S: usize>(
    tableau: &Tableau<S>,
    equation: &E,
    (tau, h): (f64, f64),
    x: &[f64; N],
    k: &mut Rates<N, S>,
    scale: &[f64; N],
    work: &mut Workspace<N, S>,
) -> Option<usize> {
    let (mut before, mut stale) = (f64::INFINITY, !work.stands((tau, h), x));
    for iteration in 1..=ITERATIONS {
        let mut step = [[0.0; N]; S];
        if stale {
            if !work.linearise(tableau, equation, (tau, h), x, k) {
                return None;
            }
            for (value, at) in step.iter_mut().zip(&work.linearised) {
                *value = at.value;
            }
            work.end = work.linearised[S - 1];
        } else {
            for i in 0..S {
                step[i] = equation.residual(tau + tableau.c[i] * h, &state_at(tableau, i, h, x, k), &k[i]);
            }
        }
        let step = work.stages.solve(&step);
        for (k, step) in k.iter_mut().zip(&step.rates) {
            for a in 0..N {
                k[a] -= step[a];
            }
        }
        let size = largest(&step, scale);
        if !size.is_finite() {
            return None;
        }
        if done(iteration, size, before) {
            return Some(iteration);
        }
        if iteration > 2 && size > 2.0 * before {
            return None;
        }
        stale = iteration > 1 && to_go(size, before) > PATIENCE;
        before = size;
    }
    None
}

/// How many more iterations it takes if they shrink as the last one did.
fn to_go(size: f64, before: f64) -> f64 {
    let contraction = size / before;
    if contraction < 1.0 { size.max(1.0).ln() / -contraction.ln() } else { f64::INFINITY }
}

/// Whether what is left after a step of this size does not matter, judged by how fast the steps shrink.
fn done(iteration: usize, size: f64, before: f64) -> bool {
    // A first step has nothing to compare with.
    let contraction = if iteration == 1 { 1.0 } else { size / before };
    let left = if contraction < 1.0 { size * contraction / (1.0 - contraction) } else { f64::INFINITY };
    left <= 1.0 || size <= NEGLIGIBLE || (contraction > STAGNATION && size <= ROUNDING && iteration > 2)
}

/// Steps below this, relative to `scale`, are the last ones whatever the contraction.
const NEGLIGIBLE: f64 = 1e-2;
/// Steps that shrink no faster than this and are below `ROUNDING` are rounding errors.
const STAGNATION: f64 = 0.3;
const ROUNDING: f64 = 32.0;

/// Largest change of a stage's state, relative to `scale`.
fn largest<const N: usize, const S: usize>(step: &Solution<N, S>, scale: &[f64; N]) -> f64 {
    let mut worst = 0.0;
    for a in 0..N {
        let mut state = 0.0_f64;
        for change in step.increments[a] {
            // NaN wins, and stays.
            state = if change.abs() > state || change.is_nan() { change.abs() } else { state };
        }
        let size = state / scale[a];
        worst = if size > worst || size.is_nan() { size } else { worst };
    }
    worst
}
