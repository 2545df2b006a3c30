//! Newton's method back to a branch, and the branch's tangent.
//!
//! From a guess y_0 the point of the branch in the hyperplane row . (y - y_0) = 0 solves the bordered system
//!
//! ```text
//! | A   | dy = | -F |
//! | row |      |  0 |
//! ```
//!
//! which is regular at folds, where dP/dz - I alone is not. The tangent solves the same matrix with (0, ..., 0, 1) on the right.

use super::system::{Sample, System};
use crate::return_map::{RequestError, Stop};
use nalgebra::{DMatrix, DVector};

/// Most Newton steps of one correction.
const ITERATIONS: usize = 8;
/// A residual below this is rounding.
const ROUNDING: f64 = 1e-13;
/// Singular values below this part of the largest are 0.
const RANK: f64 = 1e-8;

/// A point of the branch.
pub(super) struct Corrected {
    pub(super) sample: Sample,
    /// Newton steps until the residual was within the tolerance.
    pub(super) iterations: usize,
}

/// Why there is none near a guess.
#[derive(Clone, Debug)]
pub(super) enum Miss {
    /// The map has no next section crossing on the way.
    Stopped(Stop),
    /// Newton's method does not converge, or leads away.
    Diverged,
}

/// The matrix with a row below it.
pub(super) fn bordered(matrix: &DMatrix<f64>, row: &DVector<f64>) -> DMatrix<f64> {
    let d = matrix.nrows();
    let mut all = matrix.clone().insert_row(d, 0.0);
    all.set_row(d, &row.transpose());
    all
}

/// The unit vector along the branch, on the side of a reference.
pub(super) fn tangent(matrix: &DMatrix<f64>, reference: &DVector<f64>) -> Option<DVector<f64>> {
    let d = matrix.nrows();
    let mut right = DVector::zeros(d + 1);
    right[d] = 1.0;
    let solved = bordered(matrix, reference).lu().solve(&right).filter(|t| t.iter().all(|v| v.is_finite()));
    let direction = solved.or_else(|| null_space(matrix, 1).pop())?;
    let direction = direction.try_normalize(0.0)?;
    Some(if direction.dot(reference) < 0.0 { -direction } else { direction })
}

/// The last `count` right singular vectors of a d x (d + 1) matrix, that of the smallest singular value last.
pub(super) fn null_space(matrix: &DMatrix<f64>, count: usize) -> Vec<DVector<f64>> {
    let d = matrix.nrows();
    // Square, so that all right singular vectors are there.
    let svd = matrix.clone().insert_row(d, 0.0).svd(false, true);
    let Some(vectors) = svd.v_t else {
        return Vec::new();
    };
    let mut order: Vec<usize> = (0..=d).collect();
    order.sort_by(|&a, &b| svd.singular_values[b].total_cmp(&svd.singular_values[a]));
    order.iter().rev().take(count).rev().map(|&i| vectors.row(i).transpose()).collect()
}

/// Whether the branch has one direction only: A has full rank.
pub(super) fn is_regular(matrix: &DMatrix<f64>) -> bool {
    let values = matrix.clone().svd(false, false).singular_values;
    let (low, high) = values.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
    values.is_empty() || low > RANK * high
}

impl System<'_> {
    /// The point of the branch in the hyperplane through `guess` with normal `row`, at most `radius` from the guess.
    pub(super) fn correct(
        &self,
        guess: DVector<f64>,
        row: &DVector<f64>,
        radius: f64,
    ) -> Result<Result<Corrected, Miss>, RequestError> {
        let mut sample = match self.evaluate(&guess)? {
            Ok(sample) => sample,
            Err(stop) => return Ok(Err(Miss::Stopped(stop))),
        };
        let mut iterations = 0;
        while sample.residual > self.request.tolerance {
            if iterations == ITERATIONS {
                return Ok(Err(Miss::Diverged));
            }
            iterations += 1;
            let next = match self.newton_step(&sample, row)? {
                Ok(next) => next,
                Err(miss) => return Ok(Err(miss)),
            };
            // The first step may go uphill: it enters the quadric that the predictor has left.
            let shrinks = iterations == 1 || next.residual < 0.5 * sample.residual;
            if !shrinks || (&next.y - &guess).norm() > radius {
                return Ok(Err(Miss::Diverged));
            }
            sample = next;
        }
        // Close to the branch each step doubles the digits: one more is worth its price.
        if sample.residual > ROUNDING
            && let Ok(next) = self.newton_step(&sample, row)?
            && next.residual < sample.residual
        {
            sample = next;
        }
        Ok(Ok(Corrected { sample, iterations }))
    }

    fn newton_step(&self, sample: &Sample, row: &DVector<f64>) -> Result<Result<Sample, Miss>, RequestError> {
        let d = sample.coordinates();
        let right = (-&sample.gap).insert_row(d, 0.0);
        let Some(step) = bordered(&sample.matrix, row).lu().solve(&right) else {
            return Ok(Err(Miss::Diverged));
        };
        let mut y = &sample.y + step;
        // On a hyperplane of constant parameter it stays what it is to the last bit.
        if row.iter().take(d).all(|v| *v == 0.0) {
            y[d] = sample.y[d];
        }
        Ok(self.evaluate(&y)?.map_err(Miss::Stopped))
    }
}
