//! Dense output of order 7 of a step: a polynomial of degree 7 in theta in [0, 1], here for the state only.
//!
//! It serves to bracket events and extrema; accurate values come from re-stepping (see `event::locate`).

use super::coefficients::{A, C, D, DENSE_STAGES, STAGES};
use super::step::{Stages, combine};
use crate::ode::{Bundle, OdeState, Step};

/// The polynomial of one step, for the N states.
#[derive(Clone, Copy, Debug)]
pub struct Dense<const N: usize> {
    start: [f64; N],
    terms: [[f64; N]; 7],
}

impl<const N: usize> Dense<N> {
    /// Needs three more evaluations of the flow.
    pub fn new<const Q: usize, const C0: usize>(
        step: &Step<Bundle<N, Q, C0>, Stages<Bundle<N, Q, C0>>>,
        flow: &impl Fn(f64, &[f64; N]) -> [f64; N],
    ) -> Self {
        let state = |x: [f64; N]| Bundle::<N, 0, 0> { x, q: [], dx: [], dq: [] };
        let (tau, h, y) = (step.tau, step.h, state(step.start.x));
        let mut k = [state([0.0; N]); DENSE_STAGES];
        for s in 0..STAGES {
            k[s] = state(step.stages[s].x);
        }
        k[12] = state(step.end_rates.x);
        let rates = |tau: f64, y: &Bundle<N, 0, 0>| state(flow(tau, &y.x));
        k[13] = rates(tau + C[13] * h, &combine!(y, h, k, A[13]; 0, 6, 7, 8, 9, 10, 11, 12));
        k[14] = rates(tau + C[14] * h, &combine!(y, h, k, A[14]; 0, 5, 6, 7, 10, 11, 12, 13));
        k[15] = rates(tau + C[15] * h, &combine!(y, h, k, A[15]; 0, 5, 6, 7, 8, 12, 13, 14));
        let mut terms = [[0.0; N]; 7];
        for i in 0..N {
            let difference = step.end.x[i] - step.start.x[i];
            terms[0][i] = difference;
            terms[1][i] = h * k[0].x[i] - difference;
            terms[2][i] = 2.0 * difference - h * (k[12].x[i] + k[0].x[i]);
        }
        for (row, term) in D.iter().zip(&mut terms[3..]) {
            *term = combine!(Bundle::ZERO, h, k, row; 0, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15).x;
        }
        Self { start: step.start.x, terms }
    }

    /// The state at the fraction `theta` of the step.
    pub fn at(&self, theta: f64) -> [f64; N] {
        let other = 1.0 - theta;
        let mut x = [0.0; N];
        for i in 0..N {
            let t = |j: usize| self.terms[j][i];
            let inner = t(3) + theta * (t(4) + other * (t(5) + theta * t(6)));
            x[i] = self.start[i] + theta * (t(0) + other * (t(1) + theta * (t(2) + other * inner)));
        }
        x
    }
}
