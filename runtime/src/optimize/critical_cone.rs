//! The critical cone: directions in which an optimum is not decided by first derivatives.
//!
//! Along a direction s that keeps every constraint with a positive multiplier active (h' s = 0, c_i' s = 0), the
//! objective does not change to first order. A constraint that is active with a multiplier of zero only keeps s on one
//! side, c_i' s >= 0. A point is a strict local minimum when the Lagrangian's Hessian is positive on all these s, and
//! none when it is negative on one of them (Nocedal and Wright, *Numerical Optimization*, section 12.5).

use super::kkt::kkt;
use super::program::Program;
use super::search::Ended;
use nalgebra::{DMatrix, DVector};

/// Scaled multiplier below which a constraint does not limit anything.
pub(super) const NEGLIGIBLE: f64 = 1e-6;
/// Scaled value, or distance from a bound, below which a constraint is active.
const ACTIVE: f64 = 1e-6;
/// Singular value of rows of length one below which they are linearly dependent.
const DEPENDENT: f64 = 1e-6;
/// How far a direction may lead out of a half space and still count as inside.
const OUTSIDE: f64 = 1e-8;
/// Most constraints with a multiplier of zero: each doubles the number of faces.
const MOST_WEAK: usize = 10;

/// The cone at a point, in the scaled unknowns.
#[derive(Clone, Debug)]
pub(super) struct CriticalCone {
    /// Orthonormal basis of the directions that keep all constraints with a positive multiplier, n x r.
    pub(super) basis: DMatrix<f64>,
    /// Gradients of the active constraints without a multiplier in that basis, as rows: directions t need `weak * t >= 0`.
    pub(super) weak: DMatrix<f64>,
    /// How many bounds and inequalities have a positive multiplier.
    pub(super) strong: usize,
}

/// What a quadratic form is on a cone.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Sign {
    /// Positive: its smallest value on directions of length one (infinite for a cone without directions).
    Positive(f64),
    /// Zero to the tolerance along this direction, and negative nowhere.
    Flat(f64, DVector<f64>),
    /// Negative along this direction.
    Negative(f64, DVector<f64>),
    /// Not decided: too many half spaces.
    Undecided,
}

/// Scaled multiplier from which on a constraint counts as one that limits: what is below the residual of the conditions
/// themselves says nothing.
pub(super) fn significant(program: &Program<'_>, ended: &Ended) -> f64 {
    let residual = kkt(program, &ended.point, &ended.lin, &ended.multipliers).optimality;
    NEGLIGIBLE.max(10.0 * residual)
}

impl CriticalCone {
    /// At the end of a search.
    pub(super) fn at(program: &Program<'_>, ended: &Ended) -> Self {
        let (n, least) = (program.len(), significant(program, ended));
        let (m, point) = (&ended.multipliers, &ended.point);
        let mut kept: Vec<DVector<f64>> = ended.lin.h.row_iter().map(|row| row.transpose()).collect();
        let (equalities, mut weak) = (kept.len(), Vec::new());
        let mut add = |gradient: DVector<f64>, multiplier: f64, value: f64| {
            if multiplier > least {
                kept.push(gradient);
            } else if value <= ACTIVE {
                weak.push(gradient);
            }
        };
        for (i, row) in ended.lin.c.row_iter().enumerate() {
            add(row.transpose(), m.inequality[i], point.c[i]);
        }
        for i in 0..n {
            let (lower, upper) = program.variables.bounds(i);
            add(unit(n, i), m.low[i], point.u[i] - lower);
            add(-unit(n, i), m.high[i], upper - point.u[i]);
        }
        let strong = kept.len() - equalities;
        let basis = null_space(&kept, n);
        let weak: Vec<DVector<f64>> = weak
            .iter()
            .filter_map(|gradient| basis.tr_mul(gradient).try_normalize(DEPENDENT * gradient.norm()))
            .collect();
        let rows = DMatrix::from_fn(weak.len(), basis.ncols(), |i, j| weak[i][j]);
        Self { basis, weak: rows, strong }
    }
}

fn unit(n: usize, i: usize) -> DVector<f64> {
    DVector::from_fn(n, |k, _| if k == i { 1.0 } else { 0.0 })
}

/// Orthonormal basis of what is orthogonal to all rows, n x r.
fn null_space(rows: &[DVector<f64>], n: usize) -> DMatrix<f64> {
    let units: Vec<DVector<f64>> = rows.iter().filter_map(|row| row.try_normalize(f64::MIN_POSITIVE)).collect();
    // Padded with rows of zeros, so that the decomposition has all n right singular vectors.
    let matrix = DMatrix::from_fn(units.len().max(n), n, |i, j| units.get(i).map_or(0.0, |row| row[j]));
    if n == 0 || !matrix.iter().all(|x| x.is_finite()) {
        return DMatrix::zeros(n, 0);
    }
    let svd = matrix.svd(false, true);
    let Some(v_t) = svd.v_t else {
        return DMatrix::zeros(n, 0);
    };
    let free: Vec<DVector<f64>> = (svd.singular_values.iter().zip(v_t.row_iter()))
        .filter(|(value, _)| **value <= DEPENDENT)
        .map(|(_, row)| row.transpose())
        .collect();
    DMatrix::from_fn(n, free.len(), |i, j| free[j][i])
}

/// The sign of t' H t on the directions t with `weak * t >= 0`; values within the tolerance count as zero.
///
/// The smallest value over directions of length one is taken inside some face of the cone, where it is an eigenvalue of H
/// on that face's span. So the eigenvectors of all faces that lie in the cone decide; where eigenvalues are repeated and
/// only a mixture of their vectors lies in it, the edges of what is in it show up on smaller faces.
pub(super) fn sign(hessian: &DMatrix<f64>, weak: &DMatrix<f64>, tolerance: f64) -> Sign {
    let (r, w) = (hessian.nrows(), weak.nrows());
    if w > MOST_WEAK {
        return Sign::Undecided;
    }
    let mut least: Option<(f64, DVector<f64>)> = None;
    for face in 0..1_usize << w {
        let rows: Vec<DVector<f64>> = (0..w).filter(|i| face >> i & 1 == 1).map(|i| weak.row(i).transpose()).collect();
        let span = null_space(&rows, r);
        if span.ncols() == 0 {
            continue;
        }
        let eigen = span.tr_mul(&(hessian * &span)).symmetric_eigen();
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            let direction = &span * vector;
            let inside = |side: &f64| (weak * &direction * *side).iter().all(|x| *x >= -OUTSIDE);
            if let Some(side) = [1.0, -1.0].into_iter().find(inside)
                && least.as_ref().is_none_or(|(known, _)| value < known)
            {
                least = Some((*value, direction * side));
            }
        }
    }
    match least {
        Some((value, direction)) if value < -tolerance => Sign::Negative(value, direction),
        Some((value, direction)) if value <= tolerance => Sign::Flat(value, direction),
        Some((value, _)) => Sign::Positive(value),
        None => Sign::Positive(f64::INFINITY),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    fn free(r: usize) -> DMatrix<f64> {
        DMatrix::zeros(0, r)
    }

    #[test]
    fn the_null_space_is_orthogonal_to_dependent_rows_of_any_size() {
        let rows = [nalgebra::dvector![1e-9, 2e-9, 0.0], nalgebra::dvector![3e6, 6e6, 0.0]];
        let basis = null_space(&rows, 3);
        assert_eq!(basis.ncols(), 2);
        assert!(basis.iter().all(|x| x.is_finite()));
        assert!((basis.row(0) + basis.row(1) * 2.0).amax() < 1e-14);
        assert_eq!(null_space(&[], 2).ncols(), 2);
        assert_eq!(null_space(&[], 0).ncols(), 0);
    }

    #[test]
    fn without_half_spaces_the_smallest_eigenvalue_decides() {
        assert_eq!(sign(&dmatrix![2.0, 0.0; 0.0, 3.0], &free(2), 1e-6), Sign::Positive(2.0));
        assert!(matches!(sign(&dmatrix![1e-9, 0.0; 0.0, 3.0], &free(2), 1e-6), Sign::Flat(..)));
        assert!(matches!(sign(&dmatrix![1.0, 2.0; 2.0, 1.0], &free(2), 1e-6), Sign::Negative(..)));
        assert_eq!(sign(&DMatrix::zeros(0, 0), &free(0), 1e-6), Sign::Positive(f64::INFINITY));
    }

    #[test]
    fn half_spaces_can_cut_negative_directions_off() {
        // x y is negative only where x and y have different signs: not in the first quadrant, where it is flat on the axes.
        let product = dmatrix![0.0, 0.5; 0.5, 0.0];
        let quadrant = dmatrix![1.0, 0.0; 0.0, 1.0];
        assert!(matches!(sign(&product, &quadrant, 1e-6), Sign::Flat(..)));
        assert!(matches!(sign(&-&product, &quadrant, 1e-6), Sign::Negative(..)));
        // x^2 - y^2 where y = 0 has to hold from both sides.
        let saddle = dmatrix![1.0, 0.0; 0.0, -1.0];
        let line = dmatrix![0.0, 1.0; 0.0, -1.0];
        assert_eq!(sign(&saddle, &line, 1e-6), Sign::Positive(1.0));
        // A half space leaves one of two opposite directions.
        assert!(matches!(sign(&saddle, &dmatrix![0.0, 1.0], 1e-6), Sign::Negative(..)));
        // A wedge around the x axis, |y| <= x/2, is free of the negative direction.
        let wedge = dmatrix![0.5, 1.0; 0.5, -1.0];
        let found = sign(&saddle, &wedge, 1e-6);
        assert!(matches!(found, Sign::Positive(least) if (least - 0.6).abs() < 1e-12), "{found:?}");
    }

    #[test]
    fn repeated_eigenvalues_show_up_on_smaller_faces() {
        // A wedge around the direction (0.8, 0.6), away from the axes that the decomposition finds.
        let wedge = dmatrix![0.8, -0.5; -0.5, 0.8];
        assert!(matches!(sign(&dmatrix![-1.0, 0.0; 0.0, -1.0], &wedge, 1e-6), Sign::Negative(..)));
        // -(x^2 + y^2) + 5 z^2 on the pyramid |x|, |y| <= z/2 around the z axis.
        let form = dmatrix![-1.0, 0.0, 0.0; 0.0, -1.0, 0.0; 0.0, 0.0, 5.0];
        let pyramid = dmatrix![1.0, 0.0, 0.5; -1.0, 0.0, 0.5; 0.0, 1.0, 0.5; 0.0, -1.0, 0.5];
        assert!(matches!(sign(&form, &pyramid, 1e-6), Sign::Positive(_)));
        let flatter = dmatrix![1.0, 0.0, 2.0; -1.0, 0.0, 2.0; 0.0, 1.0, 2.0; 0.0, -1.0, 2.0];
        assert!(matches!(sign(&form, &flatter, 1e-6), Sign::Negative(..)));
    }
}
