//! First derivatives of a step: the stages' equations differentiated where they hold.
//!
//! With F(tau + c_i h, x_i, k_i, p) = 0 and x_i = x + h sum_j a_ij k_j, a column of variations (v of the state at the start,
//! w of the parameters) gives dk_j by sum_j (delta_ij F_k + h a_ij F_x) dk_j = -(F_x v + F_p w): one factorisation for all
//! columns, the same matrix that Newton's method has at the solution.

use super::coefficients::Tableau;
use super::stages::{Implicit, Rates, Workspace};

impl<const N: usize, const S: usize> Workspace<N, S> {
    /// Differentiates the equations at the rates `k` of a solved step; false when their matrix is singular.
    pub fn differentiate<E: Implicit<N>>(
        &mut self,
        tableau: &Tableau<S>,
        equation: &E,
        place: (f64, f64),
        x: &[f64; N],
        k: &Rates<N, S>,
    ) -> bool {
        self.linearise(tableau, equation, place, x, k)
    }

    /// Variations of the rates of all stages for the variation `dx` of the state at the start; `forced[i]` is what other
    /// variations (of parameters, of time) add to the variation of F at stage i. After [`Self::differentiate`].
    pub fn column(&mut self, dx: &[f64; N], forced: &Rates<N, S>) -> Rates<N, S> {
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
        self.stages.solve(&right).rates
    }
}
