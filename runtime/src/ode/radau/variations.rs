//! First derivatives of a step: the stages' equations differentiated where they hold.
//!
//! With F(tau + c_i h, x_i, k_i, p) = 0 and x_i = x + h sum_j a_ij k_j, a column of variations (v of the state at the start,
//! w of the parameters) gives dk_j by sum_j (delta_ij F_k + h a_ij F_x) dk_j = -(F_x v + F_p w): one factorisation for all
//! columns, the same matrix that Newton's method has at the solution.

use super::coefficients::Tableau;
use super::stages::{Implicit, Rates, Workspace, state_at};
use crate::model::Linearised;

/// The derivatives of the equations at the stages of a solved step; their matrix is factorised in the workspace.
#[derive(Clone, Copy, Debug)]
pub struct Differentiated<const N: usize, const S: usize> {
    linearised: [Linearised<f64, N>; S],
}

impl<const N: usize, const S: usize> Differentiated<N, S> {
    /// Differentiates at the rates `k` of a solved step; `None` when the matrix is singular.
    pub fn new<E: Implicit<N>>(
        tableau: &Tableau<S>,
        equation: &E,
        (tau, h): (f64, f64),
        x: &[f64; N],
        k: &Rates<N, S>,
        work: &mut Workspace<N, S>,
    ) -> Option<Self> {
        let linearised = core::array::from_fn(|i| {
            equation.linearised(tau + tableau.c[i] * h, &state_at(tableau, i, h, x, k), &k[i])
        });
        work.stages.factorise(&tableau.a, h, &linearised).then_some(Self { linearised })
    }

    /// Variations of the rates of all stages for the variation `dx` of the state at the start; `forced[i]` is what other
    /// variations (of parameters, of time) add to the variation of F at stage i.
    pub fn column(&self, dx: &[f64; N], forced: &Rates<N, S>, work: &mut Workspace<N, S>) -> Rates<N, S> {
        let mut right = [[0.0; N]; S];
        for (i, at) in self.linearised.iter().enumerate() {
            for a in 0..N {
                let mut sum = forced[i][a];
                for b in 0..N {
                    sum += at.dx[b][a] * dx[b];
                }
                right[i][a] = -sum;
            }
        }
        work.stages.solve(&right)
    }
}
