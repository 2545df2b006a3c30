//! Eigenvalues (multipliers) of a small real matrix by falling magnitude.

use nalgebra::{Complex, DMatrix, Schur};

/// Eigenvalues by falling magnitude; NaN where the iteration fails, empty for an empty matrix.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let n = matrix.nrows();
    if n == 0 {
        return Vec::new();
    }
    let schur = if matrix.iter().all(|x| x.is_finite()) {
        // A bounded number of sweeps: defective matrices converge slowly at the tightest tolerance.
        [1.0, 1e3, 1e6].iter().find_map(|f| Schur::try_new(matrix.clone(), f * f64::EPSILON, 10_000))
    } else {
        None
    };
    let mut values = match schur {
        Some(schur) => schur.complex_eigenvalues().iter().copied().collect(),
        None => vec![Complex::new(f64::NAN, f64::NAN); n],
    };
    // Pairs stay together: equal magnitudes are ordered by real part, then by imaginary part.
    let key = |m: &Complex<f64>| (m.norm(), m.re, m.im);
    values.sort_by(|a, b| {
        let ((a0, a1, a2), (b0, b1, b2)) = (key(a), key(b));
        b0.total_cmp(&a0).then(b1.total_cmp(&a1)).then(b2.total_cmp(&a2))
    });
    values
}

/// Largest magnitude of an eigenvalue; 0 for an empty matrix, NaN when it cannot be found.
pub(super) fn spectral_radius(matrix: &DMatrix<f64>) -> f64 {
    eigenvalues(matrix).first().map_or(0.0, |m| m.norm())
}
