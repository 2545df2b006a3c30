//! Multipliers: the eigenvalues of the return map's Jacobian.

use nalgebra::{Complex, DMatrix};

/// Eigenvalues of a square matrix by falling magnitude; of a conjugate pair the one with positive imaginary part comes
/// first. Empty for a matrix without rows, or with entries that are not finite.
pub fn multipliers(jacobian: &DMatrix<f64>) -> Vec<Complex<f64>> {
    if !jacobian.is_square() || jacobian.iter().any(|v| !v.is_finite()) {
        return Vec::new();
    }
    let mut values: Vec<Complex<f64>> = match jacobian.nrows() {
        0 => Vec::new(),
        1 => vec![Complex::new(jacobian[(0, 0)], 0.0)],
        2 => two_by_two(jacobian).to_vec(),
        _ => jacobian.clone().complex_eigenvalues().iter().copied().collect(),
    };
    values.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.re.total_cmp(&a.re)).then(b.im.total_cmp(&a.im)));
    values
}

/// Largest magnitude of the multipliers; 0 when there are none.
pub fn spectral_radius(multipliers: &[Complex<f64>]) -> f64 {
    multipliers.iter().map(|m| m.norm()).fold(0.0, f64::max)
}

/// The quadratic formula without cancellation. The discriminant is formed as ((a - d)/2)^2 + b c, and of two real roots
/// the smaller is the determinant over the larger.
fn two_by_two(m: &DMatrix<f64>) -> [Complex<f64>; 2] {
    let (a, b, c, d) = (m[(0, 0)], m[(0, 1)], m[(1, 0)], m[(1, 1)]);
    let (centre, half) = (0.5 * (a + d), 0.5 * (a - d));
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let im = (-discriminant).sqrt();
        return [Complex::new(centre, im), Complex::new(centre, -im)];
    }
    let root = discriminant.sqrt();
    let large = if centre >= 0.0 { centre + root } else { centre - root };
    let small = if large == 0.0 { 0.0 } else { (a * d - b * c) / large };
    [Complex::new(large, 0.0), Complex::new(small, 0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_matrices_have_their_closed_forms() {
        assert!(multipliers(&DMatrix::zeros(0, 0)).is_empty());
        assert_eq!(spectral_radius(&[]), 0.0);
        assert_eq!(multipliers(&DMatrix::from_element(1, 1, -0.7)), [Complex::new(-0.7, 0.0)]);
        let rotation = DMatrix::from_row_slice(2, 2, &[0.6, -0.8, 0.8, 0.6]);
        let pair = multipliers(&rotation);
        approx::assert_relative_eq!(pair[0].im, 0.8, epsilon = 1e-15);
        approx::assert_relative_eq!(spectral_radius(&pair), 1.0, epsilon = 1e-15);
        // Nearly singular: the small root keeps its digits.
        let m = DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, 1.0 + 1e-9]);
        let small = multipliers(&m)[1].re;
        approx::assert_relative_eq!(small, (1.0 + 1e-9_f64 - 1.0) / multipliers(&m)[0].re, max_relative = 1e-12);
        assert!(multipliers(&DMatrix::from_element(2, 2, f64::NAN)).is_empty());
    }

    #[test]
    fn larger_matrices_agree_with_their_diagonal() {
        let t = DMatrix::from_row_slice(3, 3, &[0.5, 2.0, 1.0, 0.0, -0.9, 3.0, 0.0, 0.0, 0.1]);
        let values = multipliers(&t);
        for (value, expected) in values.iter().zip([-0.9, 0.5, 0.1]) {
            approx::assert_abs_diff_eq!(value.re, expected, epsilon = 1e-12);
        }
    }
}
