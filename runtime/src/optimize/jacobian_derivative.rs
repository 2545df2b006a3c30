//! Derivative of the return map's Jacobian with respect to parameters and coordinates.
//!
//! Second-order sensitivities of the map; where it has none (mass matrices, ties), fourth-order differences of the *exact*
//! Jacobian, in scaled unknowns.

use super::program::{Failure, Point, Program};
use crate::return_map::{Points, Sensitivity};
use nalgebra::{DMatrix, DVector};

/// Step in scaled unknowns: truncation h^4 and rounding (error of the Jacobian)/h meet near here.
const STEP: f64 = 1e-3;

/// Offsets in steps and weights; the sum is divided by 12 steps.
const CENTRAL: [(f64, f64); 4] = [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)];
const FORWARD: [(f64, f64); 5] = [(0.0, -25.0), (1.0, 48.0), (2.0, -36.0), (3.0, 16.0), (4.0, -3.0)];

/// dJ/du_j in scaled coordinates, for each varied parameter and then each section coordinate.
///
/// Stencils stay within the bounds of the parameters and turn to one side where the map stops.
pub(super) fn jacobian_derivative(program: &Program<'_>, point: &Point) -> Result<Vec<DMatrix<f64>>, Failure> {
    if let Some(exact) = second_order(program, point)? {
        return Ok(exact);
    }
    let count = program.variables.free.len() + program.variables.nominal.len();
    (0..count).map(|j| along(program, &point.u, j)).collect()
}

/// The same by second-order sensitivities; `None` where there are none.
fn second_order(program: &Program<'_>, point: &Point) -> Result<Option<Vec<DMatrix<f64>>>, Failure> {
    let (variables, u) = (&program.variables, point.u.as_slice());
    let (parameters, section) = (variables.parameters(u, &program.base), variables.section(u));
    let Some(plan) = program.plan(&parameters, &section)? else {
        return Ok(None);
    };
    let chosen: Vec<usize> = variables.free.iter().map(|free| free.parameter).collect();
    let at = Points { coordinates: &section, parameters: &parameters };
    let Some(exact) = program.problem.map.second_order(&plan, at, &chosen)? else {
        return Ok(None);
    };
    let (m, d) = (chosen.len(), section.len());
    // Unknowns are parameters, then coordinates; directions of the sensitivities the other way round.
    let derivative = |j: usize| {
        let direction = if j < m { d + j } else { j - m };
        exact.second.get(direction).map(|second| program.scaled_jacobian(second) * variables.unit(j))
    };
    let all: Option<Vec<_>> = (0..m + d).map(derivative).collect();
    Ok(all.filter(|all| all.iter().all(|matrix| matrix.iter().all(|v| v.is_finite()))))
}

fn along(program: &Program<'_>, u: &DVector<f64>, j: usize) -> Result<DMatrix<f64>, Failure> {
    for step in [STEP, STEP / 16.0, STEP / 256.0] {
        let stencils: [(&[(f64, f64)], f64); 3] = [(&CENTRAL, step), (&FORWARD, step), (&FORWARD, -step)];
        for (stencil, step) in stencils {
            match difference(program, u, j, stencil, step) {
                Ok(Some(derivative)) => return Ok(derivative),
                Err(Failure::Wrong(error)) => return Err(Failure::Wrong(error)),
                Ok(None) | Err(_) => {}
            }
        }
    }
    Err(Failure::NoDerivative)
}

/// One stencil; `None` when it leaves the bounds.
fn difference(
    program: &Program<'_>,
    u: &DVector<f64>,
    j: usize,
    stencil: &[(f64, f64)],
    step: f64,
) -> Result<Option<DMatrix<f64>>, Failure> {
    let (lower, upper) = program.variables.bounds(j);
    if stencil.iter().any(|(offset, _)| !(lower..=upper).contains(&(u[j] + offset * step))) {
        return Ok(None);
    }
    let d = program.variables.nominal.len();
    let mut sum = DMatrix::zeros(d, d);
    for (offset, weight) in stencil {
        let mut u = u.clone();
        u[j] += offset * step;
        let parameters = program.variables.parameters(u.as_slice(), &program.base);
        let section = program.variables.section(u.as_slice());
        let map = program.request(&parameters, &section, Sensitivity::Coordinates, false)?;
        sum += program.scaled_jacobian(&map.jacobian) * *weight;
    }
    Ok(Some(sum / (12.0 * step)))
}
