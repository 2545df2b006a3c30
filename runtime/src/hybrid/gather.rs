//! The result of a pass: image, measures and what the user has to know, out of a run that has come to its end.

use super::Columns;
use super::functionals::Varied;
use super::map::Reached;
use super::run::Run;
use crate::integrate::{self, Carried};
use crate::model::{Model, ModelInfo};
use crate::return_map::{AlsoZeroAt, MapRequest, MapResult};
use nalgebra::{DMatrix, DVector};

/// The result of a run, with the columns of the pass.
pub(super) fn gather<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    run: &Run<'_, X, M, R, N, P, Q, W, C>,
    request: &MapRequest<'_>,
    columns: Columns<'_>,
    reached: &Reached<N, C>,
) -> MapResult
where
    X: integrate::Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    let (d, width) = (columns.coordinates, columns.width.min(C));
    let duration = run.duration();
    let functionals = if request.measures { run.functionals() } else { Vec::new() };
    let (measures, measures_jacobian) = if request.measures {
        measures::<M, N, P, Q, C>(&functionals, &run.segment.dp, run.segment.p, width)
    } else {
        (DVector::zeros(0), DMatrix::zeros(0, width))
    };
    MapResult {
        coordinates: DVector::from_fn(d, |i, _| reached.at.z[i]),
        jacobian: DMatrix::from_fn(d, width, |i, c| reached.at.dz[c][i]),
        state: DVector::from_column_slice(&reached.first),
        end: DVector::from_column_slice(&reached.end),
        duration: duration.value,
        duration_gradient: DVector::from_fn(width, |c, _| duration.gradient[c]),
        measures,
        measures_jacobian,
        events: run.events.clone(),
        also_zero: also_zero(M::INFO, &functionals),
        method: X::KIND,
        statistics: run.statistics,
        warnings: run.warnings.clone(),
    }
}

/// The functions that vanish with a guard, from their functionals.
fn also_zero<const C: usize>(info: &ModelInfo, functionals: &[Varied<C>]) -> Vec<AlsoZeroAt> {
    let value = |i: usize| functionals.get(i).map(|f| f.value);
    let listed = info.transitions.iter().enumerate().flat_map(|(transition, t)| {
        t.also_zero.iter().enumerate().map(move |(index, listed)| (transition, index, listed))
    });
    listed
        .filter_map(|(transition, index, listed)| {
            let (start, end, rate) = (value(listed.start)?, value(listed.end)?, value(listed.rate)?);
            Some(AlsoZeroAt { transition, index, start, end, rate })
        })
        .collect()
}

/// Measures and their derivatives along the columns, by the chain rule.
pub(super) fn measures<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    functionals: &[Varied<C>],
    dp: &[[f64; P]; C],
    p: &[f64; P],
    width: usize,
) -> (DVector<f64>, DMatrix<f64>) {
    let values: Vec<f64> = functionals.iter().map(|f| f.value).collect();
    let (m, f) = (M::INFO.measures.len(), values.len());
    let mut measures = vec![0.0; m];
    M::measures(&values, p, &mut measures);
    let mut by_functional = vec![0.0; m * f];
    let mut by_parameter = vec![[0.0; P]; m];
    if width > 0 {
        M::measures_jacobian(&values, p, &mut by_functional, &mut by_parameter);
    }
    let jacobian = DMatrix::from_fn(m, width, |i, c| {
        let mut sum = 0.0;
        for j in 0..f {
            let slope = by_functional[i * f + j];
            // A functional that a measure does not depend on must not spoil it.
            if slope != 0.0 {
                sum += slope * functionals[j].gradient[c];
            }
        }
        for j in 0..P {
            sum += by_parameter[i][j] * dp[c][j];
        }
        sum
    });
    (DVector::from_vec(measures), jacobian)
}

/// Appends the columns of a further pass of the same map.
pub(super) fn append(mut all: MapResult, part: MapResult) -> MapResult {
    let side_by_side = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        DMatrix::from_fn(a.nrows(), a.ncols() + b.ncols(), |i, j| {
            if j < a.ncols() { a[(i, j)] } else { b[(i, j - a.ncols())] }
        })
    };
    all.jacobian = side_by_side(&all.jacobian, &part.jacobian);
    all.measures_jacobian = side_by_side(&all.measures_jacobian, &part.measures_jacobian);
    let split = all.duration_gradient.len();
    all.duration_gradient = DVector::from_fn(split + part.duration_gradient.len(), |c, _| {
        if c < split { all.duration_gradient[c] } else { part.duration_gradient[c - split] }
    });
    all.statistics.steps += part.statistics.steps;
    all.statistics.rejected += part.statistics.rejected;
    all.statistics.evaluations += part.statistics.evaluations;
    all
}
