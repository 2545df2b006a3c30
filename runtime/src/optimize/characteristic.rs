//! Characteristic polynomial p(x) = det(x I - J) and its derivative in the entries of J.
//!
//! Faddeev and LeVerrier: adj(x I - J) = sum_k B_k x^k with B_{n-1} = I, B_{k-1} = J B_k + a_k I and
//! a_{n-m} = -tr(J B_{n-m})/m. Jacobi's formula then gives da_k = -tr(B_k dJ).

use nalgebra::DMatrix;

/// p(x) = sum_k a_k x^k of an n x n matrix.
#[derive(Clone, Debug)]
pub(super) struct Characteristic {
    /// a_0 to a_n = 1.
    pub(super) coefficients: Vec<f64>,
    /// B_0 to B_{n-1}.
    adjugate: Vec<DMatrix<f64>>,
}

impl Characteristic {
    /// Of a square matrix, of any size from 0.
    pub(super) fn new(matrix: &DMatrix<f64>) -> Self {
        let n = matrix.nrows();
        let mut coefficients = vec![0.0; n + 1];
        coefficients[n] = 1.0;
        let mut adjugate = Vec::with_capacity(n);
        let mut b = DMatrix::identity(n, n);
        for m in 1..=n {
            let product = matrix * &b;
            let a = -product.trace() / m as f64;
            coefficients[n - m] = a;
            adjugate.push(b);
            b = product + DMatrix::identity(n, n) * a;
        }
        adjugate.reverse();
        Self { coefficients, adjugate }
    }

    /// Change of a_0 to a_{n-1} when the matrix changes by `direction`; a_n stays 1.
    pub(super) fn derivative(&self, direction: &DMatrix<f64>) -> Vec<f64> {
        // tr(B D) is the sum of the entries of B^T times those of D.
        self.adjugate.iter().map(|b| -b.transpose().dot(direction)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn diagonal_matrix_has_the_product_of_linear_factors() {
        let p = Characteristic::new(&DMatrix::from_diagonal(&nalgebra::dvector![1.0, 2.0, -3.0]));
        // (x - 1)(x - 2)(x + 3) = x^3 - 7 x + 6
        for (a, expected) in p.coefficients.iter().zip([6.0, -7.0, 0.0, 1.0]) {
            assert_relative_eq!(*a, expected, epsilon = 1e-14);
        }
    }

    #[test]
    fn derivative_agrees_with_differences() {
        let j = nalgebra::dmatrix![0.3, -1.2, 0.4; 0.8, 0.1, -0.5; -0.2, 0.9, 0.7];
        let d = nalgebra::dmatrix![0.5, 0.1, -0.3; 0.2, -0.6, 0.4; 0.7, 0.3, -0.1];
        let h = 1e-6;
        let (plus, minus) = (Characteristic::new(&(&j + &d * h)), Characteristic::new(&(&j - &d * h)));
        for (k, slope) in Characteristic::new(&j).derivative(&d).into_iter().enumerate() {
            let difference = (plus.coefficients[k] - minus.coefficients[k]) / (2.0 * h);
            assert_relative_eq!(slope, difference, epsilon = 1e-8);
        }
    }
}
