//! The gait at given parameters: damped Newton on P(z; p) - z = 0, and continuation in the parameters.

use super::problem::{Problem, ProblemError};
use crate::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, Sensitivity, Stop};
use nalgebra::{DMatrix, DVector};

/// Residual, relative to the coordinates' sizes, below which a gait that no longer improves is found.
const CLOSE: f64 = 1e-9;
const MOST_ITERATIONS: usize = 60;
/// Smallest part of the way that continuation takes at once.
const SHORTEST: f64 = 1.0 / 512.0;

/// Why there is no gait.
#[derive(Clone, Debug)]
pub(super) enum NoGait {
    /// The map stops at the guess itself.
    Stopped(Stop),
    /// Newton ends where |P(z) - z| is this, relative to the coordinates' sizes.
    NotConverged(f64),
    /// The problem is wrong.
    Wrong(ProblemError),
}

/// One map with the Jacobian in the coordinates.
pub(super) fn map(
    problem: &Problem<'_>,
    parameters: &[f64],
    section: &[f64],
    accuracy: Accuracy,
    measures: bool,
) -> Result<MapResult, NoGait> {
    let outcome = problem.map.evaluate(&MapRequest {
        coordinates: section,
        parameters,
        memory: &problem.memory,
        period: problem.period,
        sensitivity: Sensitivity::Coordinates,
        measures,
        accuracy,
    });
    match outcome {
        Ok(MapOutcome::Completed(map)) => Ok(*map),
        Ok(MapOutcome::Stopped(stop)) => Err(NoGait::Stopped(stop)),
        Err(error) => Err(NoGait::Wrong(error.into())),
    }
}

/// The gait near a guess.
pub(super) fn newton(problem: &Problem<'_>, parameters: &[f64], guess: &[f64]) -> Result<Vec<f64>, NoGait> {
    let accuracy = problem.settings.accuracy;
    let largest = guess.iter().fold(0.0, |a: f64, z| a.max(z.abs()));
    let size = if largest > 0.0 { largest } else { 1.0 };
    let sizes = DVector::from_iterator(guess.len(), guess.iter().map(|z| z.abs().max(1e-3 * size)));
    let mut z = DVector::from_column_slice(guess);
    let mut at = map(problem, parameters, z.as_slice(), accuracy, false)?;
    let mut residual = norm(&at, &z, &sizes);
    for _ in 0..MOST_ITERATIONS {
        if residual == 0.0 {
            break;
        }
        let Some(step) = newton_step(&at, &z) else { break };
        let Some((next, next_z, next_residual)) = descend(problem, parameters, &z, &step, residual, &sizes)? else {
            break;
        };
        (at, z, residual) = (next, next_z, next_residual);
    }
    if residual <= CLOSE { Ok(z.as_slice().to_vec()) } else { Err(NoGait::NotConverged(residual)) }
}

fn norm(map: &MapResult, z: &DVector<f64>, sizes: &DVector<f64>) -> f64 {
    (&map.coordinates - z).component_div(sizes).norm()
}

/// (I - J)^-1 (P(z) - z), the shortest one where I - J is singular.
fn newton_step(map: &MapResult, z: &DVector<f64>) -> Option<DVector<f64>> {
    let d = z.len();
    let matrix = DMatrix::identity(d, d) - map.jacobian.columns(0, d);
    let right = &map.coordinates - z;
    if let Some(step) = matrix.clone().lu().solve(&right)
        && step.iter().all(|x| x.is_finite())
    {
        return Some(step);
    }
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    matrix.try_svd(true, true, f64::EPSILON, 10_000)?.solve(&right, 1e-12).ok()
}

type Descent = Option<(MapResult, DVector<f64>, f64)>;

/// Halves the step until the residual falls; `None` when it never does.
fn descend(
    problem: &Problem<'_>,
    parameters: &[f64],
    z: &DVector<f64>,
    step: &DVector<f64>,
    residual: f64,
    sizes: &DVector<f64>,
) -> Result<Descent, NoGait> {
    let mut factor = 1.0;
    // Close to the gait only a full step can help; rounding decides the rest.
    let halvings = if residual < CLOSE { 1 } else { 14 };
    for _ in 0..halvings {
        let trial = z + step * factor;
        match map(problem, parameters, trial.as_slice(), problem.settings.accuracy, false) {
            Ok(at) => {
                let norm = norm(&at, &trial, sizes);
                if norm < residual {
                    return Ok(Some((at, trial, norm)));
                }
            }
            Err(NoGait::Wrong(error)) => return Err(NoGait::Wrong(error)),
            Err(_) => {}
        }
        factor *= 0.5;
    }
    Ok(None)
}

/// Follows a gait from one set of parameters to another, halving the way on failure; predicts along the secant.
pub(super) fn follow(problem: &Problem<'_>, from: (&[f64], &[f64]), to: &[f64]) -> Result<Vec<f64>, NoGait> {
    let (start, gait) = from;
    let between = |t: f64| -> Vec<f64> {
        start.iter().zip(to).map(|(a, b)| if t < 1.0 { a + t * (b - a) } else { *b }).collect()
    };
    let (mut t, mut stride) = (0.0, 1.0);
    let mut z = gait.to_vec();
    let mut slope = vec![0.0; z.len()];
    while t < 1.0 {
        let next: f64 = f64::min(1.0, t + stride);
        let guess: Vec<f64> = z.iter().zip(&slope).map(|(z, s)| z + s * (next - t)).collect();
        match newton(problem, &between(next), &guess) {
            Ok(found) => {
                slope = found.iter().zip(&z).map(|(a, b)| (a - b) / (next - t)).collect();
                (z, t) = (found, next);
                stride *= 2.0;
            }
            Err(NoGait::Wrong(error)) => return Err(NoGait::Wrong(error)),
            Err(failure) => {
                stride *= 0.5;
                slope.fill(0.0);
                if stride < SHORTEST {
                    return Err(failure);
                }
            }
        }
    }
    Ok(z)
}
