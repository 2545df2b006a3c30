//! `spectral_radius <= r` as smooth inequalities: the Jury (Schur-Cohn) conditions on the characteristic polynomial.
//!
//! With p(x) = det(x I - J), all roots of p lie in |x| < r exactly when those of q(y) = p(r y) = sum_k c_k y^k,
//! c_k = a_k r^k, lie in the unit disk: q(1) > 0, (-1)^n q(-1) > 0, and all inners of X - Y and X + Y have positive
//! determinants, X (Toeplitz, from c_n down) and Y (Hankel, from c_0 up) of size n - 1 (Jury, *Inners and Stability of
//! Dynamic Systems*, 1974; derivation in docs/optimizer.md). All are polynomials in the coefficients and r, also at
//! r = 0, and stay smooth where multipliers meet.

use nalgebra::DMatrix;

/// One inequality `value >= 0`.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The left-hand side.
    pub(super) value: f64,
    /// Derivative with respect to a_0 to a_n.
    pub(super) coefficients: Vec<f64>,
    /// Derivative with respect to r.
    pub(super) radius: f64,
}

/// How many inequalities a section of dimension n needs.
pub(super) fn count(n: usize) -> usize {
    match n {
        0 => 0,
        1 => 2,
        2 => 3,
        _ => 2 + 2 * (n / 2),
    }
}

/// The inequalities for the polynomial with coefficients a_0 to a_n (`polynomial`) and the bound r (`radius`).
pub(super) fn rows(polynomial: &[f64], radius: f64) -> Vec<Row> {
    let n = polynomial.len().saturating_sub(1);
    if n == 0 {
        return Vec::new();
    }
    let powers: Vec<f64> = (0..=n).map(|k| radius.powi(k as i32)).collect();
    let c: Vec<f64> = polynomial.iter().zip(&powers).map(|(a, power)| a * power).collect();
    forms(&c)
        .into_iter()
        .map(|(value, dc)| {
            let radius = (1..=n).map(|k| dc[k] * polynomial[k] * k as f64 * powers[k - 1]).sum();
            let coefficients = dc.iter().zip(&powers).map(|(d, power)| d * power).collect();
            Row { value, coefficients, radius }
        })
        .collect()
}

/// The inequalities in terms of c_0 to c_n: value and gradient.
fn forms(c: &[f64]) -> Vec<(f64, Vec<f64>)> {
    let n = c.len() - 1;
    let mut forms = vec![linear(c, |_| 1.0), linear(c, |k| if (n - k).is_multiple_of(2) { 1.0 } else { -1.0 })];
    let mut size = n - 1;
    while size > 0 {
        forms.push(inner(c, size, -1.0));
        // For n = 2 the other sign is half the sum of the first two.
        if n > 2 {
            forms.push(inner(c, size, 1.0));
        }
        size = size.saturating_sub(2);
    }
    forms
}

fn linear(c: &[f64], weight: impl Fn(usize) -> f64) -> (f64, Vec<f64>) {
    let weights: Vec<f64> = (0..c.len()).map(weight).collect();
    (weights.iter().zip(c).map(|(w, c)| w * c).sum(), weights)
}

/// Determinant of the inner of the given size of X + sign Y, and its gradient by Jacobi's formula.
fn inner(c: &[f64], size: usize, sign: f64) -> (f64, Vec<f64>) {
    let n = c.len() - 1;
    let offset = (n - 1 - size) / 2;
    // Which coefficients stand in row i, column j of X and of Y.
    let toeplitz = |i: usize, j: usize| (j >= i).then(|| n - (j - i));
    let hankel = |i: usize, j: usize| (i + j + 2 * offset).checked_sub(n - 2);
    let at = |k: Option<usize>| k.map_or(0.0, |k| c[k]);
    let matrix = DMatrix::from_fn(size, size, |i, j| at(toeplitz(i, j)) + sign * at(hankel(i, j)));
    let cofactors = cofactors(&matrix);
    let mut gradient = vec![0.0; c.len()];
    for i in 0..size {
        for j in 0..size {
            if let Some(k) = toeplitz(i, j) {
                gradient[k] += cofactors[(i, j)];
            }
            if let Some(k) = hankel(i, j) {
                gradient[k] += sign * cofactors[(i, j)];
            }
        }
    }
    (matrix.determinant(), gradient)
}

/// Matrix of cofactors, also where the matrix is singular (which it is exactly where the inequality is active).
fn cofactors(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows();
    DMatrix::from_fn(n, n, |i, j| {
        let minor = matrix.clone().remove_row(i).remove_column(j).determinant();
        if (i + j).is_multiple_of(2) { minor } else { -minor }
    })
}

#[cfg(test)]
#[path = "jury_tests.rs"]
mod tests;
