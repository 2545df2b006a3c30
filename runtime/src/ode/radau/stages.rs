//! The rates of the stages, by Newton's method on all of them at once.
//!
//! The matrix has the blocks delta_ij F_k + h a_ij F_x, each row of blocks with the derivatives at its own stage: where the
//! mass matrix changes from nothing to full size within a step, one matrix for all stages would not do. It is kept as long
//! as the iteration contracts well.

use super::coefficients::Tableau;
use super::lu::Factors;
use super::polynomial::weighted;
use crate::model::Linearised;

/// Most iterations of one step.
const ITERATIONS: usize = 14;
/// A matrix is kept where it will take so many more iterations at most: a new one costs about as much.
const PATIENCE: f64 = 5.0;

/// An equation F(tau, x, k) = 0 for the rate k of the state x.
pub trait Implicit<const N: usize> {
    /// F.
    fn residual(&self, tau: f64, x: &[f64; N], k: &[f64; N]) -> [f64; N];
    /// F with its derivatives in x and k.
    fn linearised(&self, tau: f64, x: &[f64; N], k: &[f64; N]) -> Linearised<f64, N>;
}

/// Rates of the stages.
pub type Rates<const N: usize, const S: usize> = [[f64; N]; S];

/// Matrices that are used again from step to step.
#[derive(Clone, Debug)]
pub struct Workspace<const N: usize, const S: usize> {
    /// The matrix of all stages.
    pub(super) stages: Factors<N, S>,
    /// The matrix of the error estimate.
    pub(super) filter: Factors<N, 1>,
    /// What the rows of the matrix of all stages were divided by.
    pub(super) scales: Rates<N, S>,
}

impl<const N: usize, const S: usize> Default for Workspace<N, S> {
    fn default() -> Self {
        Self { stages: Factors::default(), filter: Factors::default(), scales: [[1.0; N]; S] }
    }
}

impl<const N: usize, const S: usize> Workspace<N, S> {
    /// Fills in and factorises the matrix of all stages; each row is scaled, as equations have different units.
    pub(super) fn factorise(&mut self, tableau: &Tableau<S>, h: f64, linearised: &[Linearised<f64, N>; S]) -> bool {
        let rows = self.stages.rows_mut();
        for (i, at) in linearised.iter().enumerate() {
            for a in 0..N {
                let scale = row_scale(at, h, a);
                self.scales[i][a] = scale;
                let row = &mut rows[i * N + a];
                let by_state: [f64; N] = core::array::from_fn(|b| scale * h * at.dx[b][a]);
                for (block, weight) in row.iter_mut().zip(&tableau.a[i]) {
                    *block = by_state.map(|v| weight * v);
                }
                for b in 0..N {
                    row[i][b] += scale * at.dk[b][a];
                }
            }
        }
        self.stages.factorise()
    }

    /// Solves for the rates of all stages; the right-hand side is not scaled.
    pub(super) fn solve(&mut self, b: &mut Rates<N, S>) {
        for (b, scales) in b.iter_mut().zip(&self.scales) {
            for a in 0..N {
                b[a] *= scales[a];
            }
        }
        self.stages.solve(b);
    }
}

/// The inverse of the largest derivative of equation a; 1 where all vanish, which is found when factorising.
#[inline]
pub(super) fn row_scale<const N: usize>(at: &Linearised<f64, N>, h: f64, a: usize) -> f64 {
    let mut largest = 0.0_f64;
    for b in 0..N {
        largest = largest.max(at.dk[b][a].abs()).max((h * at.dx[b][a]).abs());
    }
    if largest > 0.0 { 1.0 / largest } else { 1.0 }
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
    core::array::from_fn(|a| x[a] + h * change[a])
}

/// Solves for the rates `k` of the stages of a step of size `h` from (`tau`, `x`), starting from what `k` holds. `scale` is
/// the size of a change of each state that does not matter. Also returns the derivatives at the last stage where the
/// matrix was made; `None` when the iteration does not converge.
pub fn solve<E: Implicit<N>, const N: usize, const S: usize>(
    tableau: &Tableau<S>,
    equation: &E,
    (tau, h): (f64, f64),
    x: &[f64; N],
    k: &mut Rates<N, S>,
    scale: &[f64; N],
    work: &mut Workspace<N, S>,
) -> Option<(Linearised<f64, N>, usize)> {
    let mut last: Option<Linearised<f64, N>> = None;
    let (mut before, mut stale) = (f64::INFINITY, true);
    for iteration in 1..=ITERATIONS {
        let mut step = [[0.0; N]; S];
        if stale {
            let linearised = core::array::from_fn(|i| {
                equation.linearised(tau + tableau.c[i] * h, &state_at(tableau, i, h, x, k), &k[i])
            });
            if !work.factorise(tableau, h, &linearised) {
                return None;
            }
            step = core::array::from_fn(|i| linearised[i].value);
            last = Some(linearised[S - 1]);
        } else {
            for i in 0..S {
                step[i] = equation.residual(tau + tableau.c[i] * h, &state_at(tableau, i, h, x, k), &k[i]);
            }
        }
        work.solve(&mut step);
        for (k, step) in k.iter_mut().zip(&step) {
            for a in 0..N {
                k[a] -= step[a];
            }
        }
        let size = largest(tableau, h, &step, scale);
        if !size.is_finite() {
            return None;
        }
        if done(iteration, size, before) {
            return last.map(|last| (last, iteration));
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
fn largest<const N: usize, const S: usize>(tableau: &Tableau<S>, h: f64, step: &Rates<N, S>, scale: &[f64; N]) -> f64 {
    let mut worst = 0.0;
    for i in 0..S {
        let change = weighted(&tableau.a[i], step);
        for a in 0..N {
            let size = (h * change[a] / scale[a]).abs();
            // NaN wins, and stays.
            if size > worst || size.is_nan() {
                worst = size;
            }
        }
    }
    worst
}
