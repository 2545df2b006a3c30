//! Damped BFGS: a positive definite model of the Lagrangian's Hessian (Powell 1978; Nocedal and Wright, section 18.3).

use nalgebra::{DMatrix, DVector};

/// The model B.
#[derive(Clone, Debug)]
pub(super) struct QuasiNewton {
    /// B, symmetric and positive definite.
    pub(super) matrix: DMatrix<f64>,
    fresh: bool,
}

impl QuasiNewton {
    /// The identity, which the first update rescales.
    pub(super) fn new(n: usize) -> Self {
        Self { matrix: DMatrix::identity(n, n), fresh: true }
    }

    /// Takes in that the Lagrangian's gradient changed by `y` over the step `s`.
    pub(super) fn update(&mut self, s: &DVector<f64>, y: &DVector<f64>) {
        let n = s.len();
        let (ss, sy, yy) = (s.dot(s), s.dot(y), y.dot(y));
        // Differences this small are rounding.
        if !(ss > 1e-24 && sy.is_finite() && yy.is_finite()) {
            return;
        }
        if self.fresh && sy > 0.1 * (ss * yy).sqrt() {
            self.matrix = DMatrix::identity(n, n) * (yy / sy).clamp(1e-4, 1e4);
        }
        self.fresh = false;
        let bs = &self.matrix * s;
        let sbs = s.dot(&bs);
        let theta = if sy >= 0.2 * sbs { 1.0 } else { 0.8 * sbs / (sbs - sy) };
        let r = y * theta + &bs * (1.0 - theta);
        let sr = s.dot(&r);
        let next = &self.matrix - &bs * bs.transpose() / sbs + &r * r.transpose() / sr;
        if sbs > 0.0 && sr > 0.0 && next.iter().all(|x| x.is_finite()) {
            self.matrix = (&next + next.transpose()) * 0.5;
        }
        self.keep_bounded();
    }

    /// A model whose curvatures differ by more than 1e10 says nothing any more: start again.
    fn keep_bounded(&mut self) {
        let eigenvalues = self.matrix.symmetric_eigenvalues();
        let (low, high) = (eigenvalues.min(), eigenvalues.max());
        if !(low > 0.0 && high < 1e10 && high < 1e10 * low) {
            *self = Self::new(self.matrix.nrows());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn learns_a_quadratic_and_stays_positive_definite() {
        let hessian = nalgebra::dmatrix![3.0, 1.0; 1.0, 2.0];
        let mut model = QuasiNewton::new(2);
        for k in 0..40 {
            let s = nalgebra::dvector![(k as f64).cos(), (k as f64 * 1.7).sin()];
            model.update(&s, &(&hessian * &s));
        }
        assert_relative_eq!(model.matrix, hessian, epsilon = 1e-6);
        model.update(&nalgebra::dvector![1.0, 0.0], &nalgebra::dvector![-5.0, 0.0]);
        assert!(model.matrix.symmetric_eigenvalues().min() > 0.0);
    }
}
