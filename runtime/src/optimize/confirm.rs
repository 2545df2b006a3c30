//! Confirmation of a gait by a fresh simulation with other settings: periodicity, measures, linearisation and, when
//! the gait is claimed to be stable, that a disturbance really dies out.

use super::disturbed::{Linear, disturbed};
use super::gait;
use super::independent::{Claimed, independent, scaled};
use super::problem::Problem;
use super::solution::{Confirmation, Solution};
use super::stepper::Stepper;
use crate::return_map::{Accuracy, MapResult};
use nalgebra::{DMatrix, DVector};

/// Disturbance relative to the size of each coordinate: small enough for the linearisation, large against rounding.
const DISTURBANCE: f64 = 1e-5;
const MOST_MAPS: usize = 5000;
/// What a followed disturbance should fall to.
const TARGET: f64 = 1e-2;

/// A gait as the search left it.
pub(super) struct Claim<'c> {
    pub(super) parameters: &'c [f64],
    pub(super) section: &'c [f64],
    pub(super) map: &'c MapResult,
    pub(super) spectral_radius: f64,
    /// Size of each coordinate.
    pub(super) nominal: &'c [f64],
}

/// Simulates afresh; the error says what disagrees.
pub(super) fn confirm(problem: &Problem<'_>, claim: &Claim<'_>) -> Result<Confirmation, String> {
    let accuracy = tightened(problem.settings.accuracy);
    let sizes = DVector::from_column_slice(claim.nominal);
    let z = DVector::from_column_slice(claim.section);
    let run = |z: &DVector<f64>, measures: bool| {
        gait::map(problem, claim.parameters, z.as_slice(), accuracy, measures)
            .map_err(|failure| format!("a run from the gait does not complete: {failure}"))
    };
    let fresh = run(&z, true)?;
    let mut found = Confirmation {
        residual: (&fresh.coordinates - &z).component_div(&sizes).amax(),
        measures: measures_differ(claim.map, &fresh),
        ..Confirmation::default()
    };
    let relative = problem.settings.accuracy.relative;
    let info = problem.map.info();
    if let Some(open) = fresh.open(info, relative) {
        return Err(open.describe(info));
    }
    check(found.residual, f64::max(1e-8, 1e3 * relative), "the gait does not return to itself")?;
    check(found.measures, f64::max(1e-6, 1e4 * relative), "a measure differs")?;
    let jacobian = claim.map.jacobian.columns(0, z.len()).into_owned();
    let direction = disturbance(&sizes);
    let (plus, minus) = (run(&(&z + &direction), false)?, run(&(&z - &direction), false)?);
    found.linearisation = linearisation_differs(&jacobian, &direction, &plus, &minus, &sizes);
    check(
        found.linearisation,
        f64::max(1e-3, 10.0 * relative / DISTURBANCE),
        "the Jacobian differs from a difference of maps",
    )?;
    if claim.spectral_radius < 1.0 && !z.is_empty() {
        (found.maps, found.remaining) = follow(problem, claim, &jacobian, &direction, &sizes)?;
    }
    Ok(found)
}

/// What takes longer than a few maps: a thousand disturbed maps in sequence, and another route to map and Jacobian. Both are
/// noted in the solution's confirmation.
///
/// # Errors
/// What disagrees, in words.
pub(super) fn at_length(problem: &Problem<'_>, solution: &mut Solution, nominal: &[f64]) -> Result<(), String> {
    let Solution { parameters, section, spectral_radius, confirmation: Some(confirmation), .. } = solution else {
        return Ok(());
    };
    if section.is_empty() {
        return Ok(());
    }
    let map = gait::map(problem, parameters, section, problem.settings.accuracy, false)
        .map_err(|failure| format!("a run from the gait does not complete: {failure}"))?;
    let sizes = DVector::from_column_slice(nominal);
    let jacobian = scaled(&map.jacobian, &sizes);
    confirmation.independent = independent(problem, &Claimed { parameters, section, map: &map, sizes: &sizes })?;
    let linear = Linear { parameters, section, sizes: &sizes, jacobian: &jacobian, spectral_radius: *spectral_radius };
    confirmation.disturbed = Some(disturbed(problem, &linear)?);
    Ok(())
}

/// A tenth of the tolerances, as far as double precision carries.
fn tightened(accuracy: Accuracy) -> Accuracy {
    Accuracy {
        relative: f64::max(0.1 * accuracy.relative, 1e-13),
        absolute: f64::max(0.1 * accuracy.absolute, 1e-16),
        step_limit: accuracy.step_limit.saturating_mul(4),
        ..accuracy
    }
}

fn check(value: f64, bound: f64, what: &str) -> Result<(), String> {
    if value <= bound { Ok(()) } else { Err(format!("{what}: {value:.1e}, where {bound:.0e} is allowed")) }
}

fn measures_differ(claimed: &MapResult, fresh: &MapResult) -> f64 {
    let difference = |(a, b): (&f64, &f64)| {
        // A measure may be undefined (0/0); it then has to stay so.
        if a.is_nan() && b.is_nan() { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()).max(1e-6) }
    };
    let all = claimed.measures.iter().zip(fresh.measures.iter()).map(difference);
    all.fold(0.0, |worst: f64, x| if x.is_nan() { f64::INFINITY } else { worst.max(x) })
}

/// A fixed direction with a part along every coordinate, no two alike.
fn disturbance(sizes: &DVector<f64>) -> DVector<f64> {
    let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    let shape = |i: usize| sign(i) / (1.0 + 0.37 * i as f64);
    DVector::from_fn(sizes.len(), |i, _| DISTURBANCE * sizes[i] * shape(i))
}

fn linearisation_differs(
    jacobian: &DMatrix<f64>,
    direction: &DVector<f64>,
    plus: &MapResult,
    minus: &MapResult,
    sizes: &DVector<f64>,
) -> f64 {
    let difference = (&plus.coordinates - &minus.coordinates) * 0.5;
    let error = (jacobian * direction - &difference).component_div(sizes).norm();
    let size = (jacobian * direction).component_div(sizes).norm().max(direction.component_div(sizes).norm());
    if size > 0.0 { error / size } else { 0.0 }
}

/// Follows a disturbed gait for as many maps as the multipliers need; number of maps and what remains.
fn follow(
    problem: &Problem<'_>,
    claim: &Claim<'_>,
    jacobian: &DMatrix<f64>,
    direction: &DVector<f64>,
    sizes: &DVector<f64>,
) -> Result<(usize, f64), String> {
    let accuracy = tightened(problem.settings.accuracy);
    let mut stepper = Stepper::new(problem, (claim.parameters, claim.section), accuracy)?;
    let maps = maps_needed(claim.spectral_radius);
    let z = DVector::from_column_slice(claim.section);
    let first = direction.component_div(sizes).norm();
    let mut disturbed = &z + direction;
    let mut predicted = direction.clone();
    let mut largest = first;
    for _ in 0..maps {
        disturbed = stepper.map(&disturbed)?;
        predicted = jacobian * predicted;
        largest = f64::max(largest, predicted.component_div(sizes).norm());
        if !disturbed.iter().all(|x| x.is_finite()) {
            return Err("a small disturbance of the gait, claimed to be stable, leads out of the model".to_owned());
        }
    }
    let remaining = (disturbed - z).component_div(sizes).norm() / first;
    // The bound follows the linear prediction: close to the limit of stability little dies out in any number of maps
    // that one can afford, and a non-normal map grows before it decays.
    let allowed = f64::max(0.1, 2.0 * predicted.component_div(sizes).norm() / first).min(0.999 * largest / first);
    if remaining <= allowed {
        Ok((maps, remaining))
    } else {
        let percent = 100.0 * remaining;
        Err(format!("a small disturbance of the gait, claimed to be stable, is at {percent:.3} % after {maps} maps"))
    }
}

/// Maps until a disturbance falls to the target.
fn maps_needed(spectral_radius: f64) -> usize {
    if spectral_radius <= TARGET {
        return 4;
    }
    let maps = (TARGET.ln() / spectral_radius.ln()).ceil();
    // The cast saturates.
    (maps as usize).clamp(4, MOST_MAPS)
}
