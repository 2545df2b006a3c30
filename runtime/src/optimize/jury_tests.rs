//! The Jury inequalities against eigenvalues and difference quotients.

use super::super::characteristic::Characteristic;
use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

fn smallest(matrix: &DMatrix<f64>, radius: f64) -> f64 {
    let values = rows(&Characteristic::new(matrix).coefficients, radius);
    values.into_iter().map(|row| row.value).fold(f64::INFINITY, f64::min)
}

fn spectral_radius(matrix: &DMatrix<f64>) -> f64 {
    matrix.complex_eigenvalues().iter().map(|m| m.norm()).fold(0.0, f64::max)
}

fn matrix() -> impl Strategy<Value = DMatrix<f64>> {
    (1usize..=7)
        .prop_flat_map(|n| proptest::collection::vec(-1.0..1.0f64, n * n).prop_map(move |v| DMatrix::from_vec(n, n, v)))
}

proptest! {
    #[test]
    fn inequalities_hold_exactly_inside_the_disk(j in matrix(), factor in 0.3..1.7f64) {
        let rho = spectral_radius(&j);
        prop_assume!(rho > 1e-2 && (factor - 1.0).abs() > 1e-3);
        // Scaled to a spectral radius of 1, so that the values are of order one.
        let j = j / rho;
        prop_assert_eq!(smallest(&j, factor) > 0.0, factor > 1.0, "smallest value {}", smallest(&j, factor));
    }

    #[test]
    fn one_inequality_is_zero_on_the_circle(j in matrix()) {
        let rho = spectral_radius(&j);
        prop_assume!(rho > 1e-2);
        prop_assert!(smallest(&(j / rho), 1.0).abs() < 1e-9);
    }

    #[test]
    fn gradients_agree_with_differences(j in matrix(), radius in 0.2..1.5f64) {
        let a = Characteristic::new(&j).coefficients;
        let h = 1e-5;
        for (i, row) in rows(&a, radius).into_iter().enumerate() {
            let slope = (rows(&a, radius + h)[i].value - rows(&a, radius - h)[i].value) / (2.0 * h);
            assert_relative_eq!(row.radius, slope, epsilon = 1e-5, max_relative = 1e-5);
            for k in 0..a.len() {
                let (mut plus, mut minus) = (a.clone(), a.clone());
                plus[k] += h;
                minus[k] -= h;
                let slope = (rows(&plus, radius)[i].value - rows(&minus, radius)[i].value) / (2.0 * h);
                assert_relative_eq!(row.coefficients[k], slope, epsilon = 1e-5, max_relative = 1e-5);
            }
        }
    }
}

#[test]
fn counts_match() {
    for n in 0..8 {
        assert_eq!(rows(&Characteristic::new(&DMatrix::identity(n, n)).coefficients, 1.0).len(), count(n));
    }
}

#[test]
fn a_deadbeat_map_meets_every_bound() {
    let nilpotent = nalgebra::dmatrix![0.0, 1.0, 0.0; 0.0, 0.0, 1.0; 0.0, 0.0, 0.0];
    assert!(smallest(&nilpotent, 1e-3) > 0.0);
    assert!(rows(&Characteristic::new(&nilpotent).coefficients, 0.0).iter().all(|row| row.value == 0.0));
}

#[test]
fn a_complex_pair_that_meets_stays_smooth() {
    // x^2 - 2 b x + d at b^2 = d: both multipliers equal; the gradient is finite and not zero.
    for row in rows(&[0.25, -1.0, 1.0], 0.5) {
        assert!(row.coefficients.iter().all(|d| d.is_finite()) && row.radius.is_finite());
        assert!(row.coefficients.iter().any(|d| d.abs() > 0.1));
    }
}
