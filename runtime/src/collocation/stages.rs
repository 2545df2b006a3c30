//! One step: the rates at the nodes solve F(x_0 + h sum_j a_ij k_j, k_i, tau + c_i h) = 0, all at once, by Newton's method.

use super::gauss::{Gauss, S};
use crate::model::{Env, Model};
use crate::scalar::filled;
use nalgebra::{DMatrix, DVector};

/// Newton corrections of a step.
const CORRECTIONS: usize = 20;
/// A correction below this, relative to the state, is the last but one: the next is its square.
const SMALL: f64 = 1e-7;

/// Where a step starts and under what it runs.
#[derive(Clone, Debug)]
pub(super) struct Frame<'p, const N: usize, const P: usize> {
    pub(super) p: &'p [f64; P],
    pub(super) mode: usize,
    pub(super) memory: Vec<f64>,
    pub(super) branch: Vec<bool>,
    /// Time since the start of the run at which tau was 0.
    pub(super) start: f64,
    pub(super) tau: f64,
    pub(super) x: [f64; N],
}

impl<const N: usize, const P: usize> Frame<'_, N, P> {
    /// The environment a time `h` later.
    pub(super) fn env(&self, h: f64) -> Env<'_, f64, P> {
        let tau = self.tau + h;
        Env { tau, t: self.start + tau, p: self.p, memory: &self.memory, branch: &self.branch }
    }

    /// The state after a step; `None` where the equations cannot be solved.
    pub(super) fn step<M: Model<N, P, Q>, const Q: usize>(&self, gauss: &Gauss, h: f64) -> Option<[f64; N]> {
        let mut rates = [[0.0; N]; S];
        let mut last = false;
        for _ in 0..CORRECTIONS {
            let correction = self.correction::<M, Q>(gauss, h, &rates)?;
            let mut largest = 0.0_f64;
            for n in 0..N {
                let fastest = rates.iter().map(|k| k[n].abs()).fold(0.0, f64::max);
                let size = self.x[n].abs() + h * fastest + f64::MIN_POSITIVE;
                for i in 0..S {
                    rates[i][n] -= correction[i * N + n];
                    largest = largest.max(h * correction[i * N + n].abs() / size);
                }
            }
            if last {
                let x = filled(0.0, |n| self.x[n] + h * (0..S).map(|i| gauss.b[i] * rates[i][n]).sum::<f64>());
                return x.iter().all(|v| v.is_finite()).then_some(x);
            }
            last = largest <= SMALL;
        }
        None
    }

    /// Newton's correction of all rates.
    fn correction<M: Model<N, P, Q>, const Q: usize>(
        &self,
        gauss: &Gauss,
        h: f64,
        rates: &[[f64; N]; S],
    ) -> Option<DVector<f64>> {
        let mut matrix = DMatrix::zeros(S * N, S * N);
        let mut residual = DVector::zeros(S * N);
        for i in 0..S {
            let x = filled(0.0, |n| self.x[n] + h * (0..S).map(|j| gauss.a[i][j] * rates[j][n]).sum::<f64>());
            let at = M::residual_linearised(self.mode, &x, &rates[i], &self.env(gauss.c[i] * h));
            for row in 0..N {
                residual[i * N + row] = at.value[row];
                for column in 0..N {
                    for j in 0..S {
                        matrix[(i * N + row, j * N + column)] = h * gauss.a[i][j] * at.dx[column][row];
                    }
                    matrix[(i * N + row, i * N + column)] += at.dk[column][row];
                }
            }
        }
        if !matrix.iter().chain(residual.iter()).all(|v| v.is_finite()) {
            return None;
        }
        matrix.lu().solve(&residual)
    }
}
