//! The collocation polynomial u of a step: u(0) is the state at the start, u' passes through the rates of the stages.

use super::coefficients::Tableau;
use crate::scalar::filled;

/// The polynomial of a step's state: degree S, so the rate is of degree S - 1.
#[derive(Clone, Copy, Debug)]
pub struct Polynomial<const N: usize, const S: usize> {
    /// Where it starts.
    pub tau: f64,
    /// Size of its step.
    pub h: f64,
    /// State at the start.
    pub start: [f64; N],
    /// Rates of the stages.
    pub rates: [[f64; N]; S],
}

impl<const S: usize> Tableau<S> {
    /// Weights of the stages' rates in h^-1 (u(theta) - u(0)).
    pub fn integrals(&self, theta: f64) -> [f64; S] {
        filled(0.0, |j| {
            let terms = self.lagrange[j].iter().enumerate().rev();
            theta * terms.fold(0.0, |sum, (m, c)| sum * theta + c / (m + 1) as f64)
        })
    }

    /// Weights of the stages' rates in the rate u'(theta).
    pub fn values(&self, theta: f64) -> [f64; S] {
        filled(0.0, |j| self.lagrange[j].iter().rev().fold(0.0, |sum, c| sum * theta + c))
    }

    /// Weights of the stages' rates in h u''(theta).
    pub fn slopes(&self, theta: f64) -> [f64; S] {
        filled(0.0, |j| {
            let terms = self.lagrange[j].iter().enumerate().skip(1).rev();
            terms.fold(0.0, |sum, (m, c)| sum * theta + c * m as f64)
        })
    }

    /// Weights of the stages' rates in the coefficient of theta^m of the rate.
    pub fn coefficient(&self, m: usize) -> [f64; S] {
        filled(0.0, |j| self.lagrange[j][m])
    }
}

/// Weighted sum of vectors.
pub fn weighted<const N: usize, const S: usize>(weights: &[f64; S], vectors: &[[f64; N]; S]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (w, v) in weights.iter().zip(vectors) {
        for i in 0..N {
            sum[i] += w * v[i];
        }
    }
    sum
}

impl<const N: usize, const S: usize> Polynomial<N, S> {
    /// The state at the fraction `theta` of the step.
    pub fn state(&self, tableau: &Tableau<S>, theta: f64) -> [f64; N] {
        let change = weighted(&tableau.integrals(theta), &self.rates);
        filled(0.0, |i| self.start[i] + self.h * change[i])
    }

    /// The rate there.
    pub fn rate(&self, tableau: &Tableau<S>, theta: f64) -> [f64; N] {
        weighted(&tableau.values(theta), &self.rates)
    }

    /// The derivative of the rate there.
    pub fn second_rate(&self, tableau: &Tableau<S>, theta: f64) -> [f64; N] {
        let sums = weighted(&tableau.slopes(theta), &self.rates);
        filled(0.0, |i| sums[i] / self.h)
    }
}
