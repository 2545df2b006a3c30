//! Derivative of the return map's Jacobian with respect to parameters and coordinates.
//!
//! Second-order sensitivities of the map; where it has none (mass matrices, ties), differences of the *exact* Jacobian, in
//! scaled unknowns: of fourth order along every unknown, or, while a search is still on its way, of second order along the
//! gaits alone, which takes a third of the maps.

use super::linearisation::following;
use super::program::{Failure, Point, Program};
use crate::return_map::{Points, Sensitivity};
use nalgebra::{DMatrix, DVector};

/// Step in scaled unknowns: truncation h^4 and rounding (error of the Jacobian)/h meet near here.
const STEP: f64 = 1e-3;

/// Offsets in steps with weights, and by how many steps the sum is divided.
struct Stencil {
    places: &'static [(f64, f64)],
    divisor: f64,
}

const CENTRAL: Stencil = Stencil { places: &[(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)], divisor: 12.0 };
const FORWARD: Stencil =
    Stencil { places: &[(0.0, -25.0), (1.0, 48.0), (2.0, -36.0), (3.0, 16.0), (4.0, -3.0)], divisor: 12.0 };
const SHORT_CENTRAL: Stencil = Stencil { places: &[(-1.0, -1.0), (1.0, 1.0)], divisor: 2.0 };
const SHORT_FORWARD: Stencil = Stencil { places: &[(0.0, -3.0), (1.0, 4.0), (2.0, -1.0)], divisor: 2.0 };

/// The derivative of the Jacobian in the unknowns.
pub(super) struct JacobianDerivative {
    /// dJ/du_j in scaled coordinates, for each varied parameter and then each section coordinate.
    pub(super) along: Vec<DMatrix<f64>>,
    /// The entries of the parameters are derivatives along the gaits, to about six digits, and those of the coordinates zero.
    /// For steps that stay with the gaits that is the same derivative; only the multipliers of the periodicity differ.
    pub(super) rough: bool,
}

/// dJ/du_j in scaled coordinates. `rough` asks for the cheap one where differences are taken.
///
/// Stencils stay within the bounds of the parameters and turn to one side where the map stops.
pub(super) fn jacobian_derivative(
    program: &Program<'_>,
    point: &Point,
    rough: bool,
) -> Result<JacobianDerivative, Failure> {
    if let Some(along) = second_order(program, point)? {
        return Ok(JacobianDerivative { along, rough: false });
    }
    let (m, d) = (program.variables.free.len(), program.variables.nominal.len());
    if rough && let Some(tangents) = tangents(program, point) {
        let direction = |j: usize| tangents.column(j).into_owned();
        let mut all: Vec<DMatrix<f64>> = Vec::with_capacity(m + d);
        for j in 0..m {
            all.push(along(program, &point.u, &direction(j), [&SHORT_CENTRAL, &SHORT_FORWARD])?);
        }
        all.resize(m + d, DMatrix::zeros(d, d));
        return Ok(JacobianDerivative { along: all, rough: true });
    }
    let unit = |j: usize| DVector::from_fn(m + d, |i, _| if i == j { 1.0 } else { 0.0 });
    let all: Result<Vec<_>, _> = (0..m + d).map(|j| along(program, &point.u, &unit(j), [&CENTRAL, &FORWARD])).collect();
    Ok(JacobianDerivative { along: all?, rough: false })
}

/// How parameters and coordinates move along the gaits for a unit of each parameter, (m + d) x m; `None` near a fold.
fn tangents(program: &Program<'_>, point: &Point) -> Option<DMatrix<f64>> {
    let (m, d) = (program.variables.free.len(), program.variables.nominal.len());
    let periodicity = program.periodicity_jacobian(point);
    let inverse = following(&periodicity, m, d)?;
    let mut tangents = DMatrix::zeros(m + d, m);
    tangents.view_mut((0, 0), (m, m)).fill_with_identity();
    tangents.view_mut((m, 0), (d, m)).copy_from(&(-inverse * periodicity.columns(0, m)));
    Some(tangents)
}

/// The same by second-order sensitivities; `None` where there are none.
fn second_order(program: &Program<'_>, point: &Point) -> Result<Option<Vec<DMatrix<f64>>>, Failure> {
    let (variables, u) = (&program.variables, point.u.as_slice());
    let (parameters, section) = (variables.parameters(u, &program.base), variables.section(u));
    let chosen: Vec<usize> = variables.free.iter().map(|free| free.parameter).collect();
    let (m, d, all) = (chosen.len(), program.problem.start.len(), section.len());
    let mut second = vec![DMatrix::zeros(all, all); m + all];
    for (s, scene) in program.scenes.iter().enumerate() {
        let (own, block) = (scene.parameters(&parameters), program.block(s));
        let at = Points { coordinates: &section[block.clone()], parameters: &own };
        let Some(plan) = program.plan(at.parameters, at.coordinates)? else {
            return Ok(None);
        };
        let Some(exact) = program.problem.map.second_order(&plan, at, &chosen)? else {
            return Ok(None);
        };
        // Unknowns are parameters, then the coordinates of all scenes; directions of a map are its coordinates, then parameters.
        let directions = (0..m).map(|j| (j, d + j)).chain((0..d).map(|i| (m + block.start + i, i)));
        for (unknown, direction) in directions {
            let Some(matrix) = exact.second.get(direction) else { return Ok(None) };
            if direction >= d && scene.changes(chosen[direction - d]) {
                continue;
            }
            second[unknown].view_mut((block.start, block.start), (d, d)).copy_from(&matrix.columns(0, d));
        }
    }
    let derivative = |(j, second): (usize, &DMatrix<f64>)| program.scaled_jacobian(second) * variables.unit(j);
    let all = Some(second.iter().enumerate().map(derivative).collect::<Vec<_>>());
    Ok(all.filter(|all| all.iter().all(|matrix| matrix.iter().all(|v| v.is_finite()))))
}

/// Along a direction, by the first stencil that fits, with shorter steps where none does.
fn along(
    program: &Program<'_>,
    u: &DVector<f64>,
    direction: &DVector<f64>,
    [central, forward]: [&Stencil; 2],
) -> Result<DMatrix<f64>, Failure> {
    let longest = direction.amax().max(1.0);
    for step in [STEP, STEP / 16.0, STEP / 256.0].map(|step| step / longest) {
        for (stencil, step) in [(central, step), (forward, step), (forward, -step)] {
            match difference(program, u, direction, stencil, step) {
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
    direction: &DVector<f64>,
    stencil: &Stencil,
    step: f64,
) -> Result<Option<DMatrix<f64>>, Failure> {
    let place = |offset: f64| {
        let mut place = u.clone();
        place.rows_mut(0, direction.len()).axpy(offset * step, direction, 1.0);
        place
    };
    let inside = |(offset, _): &(f64, f64)| {
        let place = place(*offset);
        let within = |j: usize| {
            let (lower, upper) = program.variables.bounds(j);
            (lower..=upper).contains(&place[j])
        };
        (0..direction.len()).all(|j| direction[j] == 0.0 || within(j))
    };
    if !stencil.places.iter().all(inside) {
        return Ok(None);
    }
    let d = program.variables.nominal.len();
    let mut sum = DMatrix::zeros(d, d);
    for (offset, weight) in stencil.places {
        let place = place(*offset);
        let parameters = program.variables.parameters(place.as_slice(), &program.base);
        let section = program.variables.section(place.as_slice());
        let map = program.request(&parameters, &section, Sensitivity::Coordinates, false)?;
        sum += program.scaled_jacobian(&map.jacobian) * *weight;
    }
    Ok(Some(sum / (stencil.divisor * step)))
}
