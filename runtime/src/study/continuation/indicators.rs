//! Test functions: smooth functions of a point of the branch that change sign at its bifurcations.
//!
//! All are determinants (or a component of the tangent), so that neither the order of the multipliers nor their meeting matters:
//!
//! - fold: the parameter's component of the tangent;
//! - branch point: the determinant of A with the tangent below it. det(dP/dz - I) is this times the tangent's parameter component, so it
//!   changes sign at both; this one is regular at folds;
//! - flip: det(dP/dz + I);
//! - Neimark-Sacker: det(C - I) with C the second compound of dP/dz (twice its bialternate product with itself), whose eigenvalues are the products
//!   of two multipliers. It is also zero at neutral saddles (two real multipliers with product 1), which are told apart where it vanishes.

use super::Kind;
use super::corrector::bordered;
use super::system::Sample;
use nalgebra::{Complex, DMatrix};

/// Multipliers this close to where they should be at a bifurcation are there; jumps of the map's derivative fail this.
const THERE: f64 = 1e-4;
/// Multipliers this close throughout are always there: no bifurcation, a property of the model.
const ALWAYS: f64 = 1e-7;

/// The second compound matrix: its entries are the 2 x 2 minors, its eigenvalues the products of two eigenvalues.
pub(super) fn second_compound(j: &DMatrix<f64>) -> DMatrix<f64> {
    let d = j.nrows();
    let pairs: Vec<(usize, usize)> = (0..d).flat_map(|p| (0..p).map(move |q| (p, q))).collect();
    DMatrix::from_fn(pairs.len(), pairs.len(), |row, column| {
        let ((p, q), (r, s)) = (pairs[row], pairs[column]);
        j[(p, r)] * j[(q, s)] - j[(p, s)] * j[(q, r)]
    })
}

fn shifted_determinant(matrix: &DMatrix<f64>, shift: f64) -> f64 {
    let n = matrix.nrows();
    (matrix + DMatrix::identity(n, n) * shift).determinant()
}

impl Kind {
    /// All, in the order in which they are looked for.
    pub(super) const ALL: [Self; 4] = [Self::Fold, Self::Branch, Self::Flip, Self::NeimarkSacker];

    /// The test function.
    pub(super) fn indicator(self, sample: &Sample) -> f64 {
        match self {
            Self::Fold => sample.along_parameter(),
            Self::Branch => bordered(&sample.matrix, &sample.tangent).determinant(),
            Self::Flip => shifted_determinant(&sample.jacobian, 1.0),
            Self::NeimarkSacker => shifted_determinant(&second_compound(&sample.jacobian), -1.0),
        }
    }

    /// How far the multipliers are from this bifurcation.
    fn distance(self, multipliers: &[Complex<f64>]) -> f64 {
        let nearest = |at: f64| multipliers.iter().map(|m| (m - at).norm()).fold(f64::INFINITY, f64::min);
        match self {
            Self::Fold | Self::Branch => nearest(1.0),
            Self::Flip => nearest(-1.0),
            Self::NeimarkSacker => {
                let complex = multipliers.iter().filter(|m| m.im > 0.0);
                complex.map(|m| (m.norm() - 1.0).abs()).fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// Whether a zero of the test function with these multipliers is this bifurcation: neither a neutral saddle nor a jump.
    pub(super) fn confirmed(self, multipliers: &[Complex<f64>]) -> bool {
        self.distance(multipliers) <= THERE
    }

    /// Whether the multipliers at both ends of a step say that the model always has them there, as a conserved quantity makes them.
    pub(super) fn permanent(self, from: &[Complex<f64>], to: &[Complex<f64>]) -> bool {
        self.distance(from) <= ALWAYS && self.distance(to) <= ALWAYS
    }

    /// By how many multipliers outside the unit circle both sides differ.
    pub(super) fn crossing(self) -> usize {
        if self == Self::NeimarkSacker { 2 } else { 1 }
    }
}

/// Number of multipliers outside the unit circle; `None` where one is too close to it to say.
pub(super) fn outside(multipliers: &[Complex<f64>]) -> Option<usize> {
    let clear = multipliers.iter().all(|m| (m.norm() - 1.0).abs() > ALWAYS);
    clear.then(|| multipliers.iter().filter(|m| m.norm() > 1.0).count())
}

#[cfg(test)]
mod tests {
    use super::{outside, second_compound};
    use crate::orbit::multipliers;
    use nalgebra::{Complex, DMatrix};

    #[test]
    fn the_compound_has_the_products_of_two_eigenvalues() {
        let t = DMatrix::from_row_slice(3, 3, &[0.5, 2.0, 1.0, 0.0, -0.9, 3.0, 0.0, 0.0, 0.1]);
        let s = DMatrix::from_row_slice(3, 3, &[1.0, 0.3, -0.2, 0.1, 2.0, 0.4, 0.7, -0.5, 1.5]);
        let similar = s.clone().try_inverse().unwrap_or_else(|| DMatrix::zeros(3, 3)) * t * s;
        let products = multipliers(&second_compound(&similar));
        for (product, expected) in products.iter().zip([-0.45, -0.09, 0.05]) {
            approx::assert_abs_diff_eq!(product.re, expected, epsilon = 1e-12);
        }
        assert_eq!(products.len(), 3);
        assert_eq!(second_compound(&DMatrix::zeros(1, 1)).nrows(), 0);
    }

    #[test]
    fn multipliers_on_the_circle_are_on_no_side() {
        let real = |re: f64| Complex::new(re, 0.0);
        assert_eq!(outside(&[real(-1.2), real(0.3)]), Some(1));
        assert_eq!(outside(&[real(-1.2), real(1.0)]), None);
        assert_eq!(outside(&[]), Some(0));
    }
}
