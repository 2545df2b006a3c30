//! The gait at given parameters, and continuation of a gait in the parameters.

use super::problem::{Problem, ProblemError};
use crate::orbit::{GaitRequest, GaitStatus, find_gait, follow};
use crate::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, Sensitivity, Stop};

/// Most Newton steps to a gait of which only a guess is known ...
const NEWTON_STEPS: usize = 50;
/// ... and to the next one on the way: more would say that the way is too long.
const CORRECTIONS: usize = 10;
/// Most maps for a gait at a place that is only tried because others had none: a search that succeeds takes a few.
pub(super) const GLANCE: usize = 60;

/// A run is given up when it takes so many times longer than the gait that is followed; more than what a search refuses as another
/// gait.
const PATIENCE: f64 = 20.0;

/// Why there is no gait.
#[derive(Clone, Debug)]
pub(super) enum NoGait {
    /// The map stops at the guess itself.
    Stopped(Stop),
    /// Newton ends where P(z) - z is still this large.
    NotConverged(f64),
    /// The coordinates repeat, another state does not: in words.
    Open(String),
    /// Somebody asked to stop.
    Interrupted,
    /// The problem is wrong.
    Wrong(ProblemError),
}

/// A gait to start from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Start {
    /// All parameters.
    pub(super) parameters: Vec<f64>,
    /// Its section coordinates.
    pub(super) section: Vec<f64>,
}

/// One map with the Jacobian in the coordinates; none where somebody asked to stop.
pub(super) fn map(
    problem: &Problem<'_>,
    parameters: &[f64],
    section: &[f64],
    accuracy: Accuracy,
    measures: bool,
) -> Result<MapResult, NoGait> {
    if problem.settings.interrupt.requested() {
        return Err(NoGait::Interrupted);
    }
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
pub(super) fn near(problem: &Problem<'_>, parameters: &[f64], guess: &[f64]) -> Result<Vec<f64>, NoGait> {
    let (section, _) = within(problem, parameters, guess, (NEWTON_STEPS, usize::MAX), problem.settings.accuracy)?;
    Ok(section)
}

/// The gait near a guess if it shows soon; for places that are tried because others had none.
pub(super) fn at_a_glance(problem: &Problem<'_>, parameters: &[f64], guess: &[f64]) -> Result<Vec<f64>, NoGait> {
    let limits = (NEWTON_STEPS, GLANCE.saturating_mul(problem.period));
    let (section, _) = within(problem, parameters, guess, limits, problem.settings.accuracy)?;
    Ok(section)
}

/// The gait near a guess, in so many Newton steps from each of its starts and so many maps in all, and its duration (s).
fn within(
    problem: &Problem<'_>,
    parameters: &[f64],
    guess: &[f64],
    (iteration_limit, map_limit): (usize, usize),
    accuracy: Accuracy,
) -> Result<(Vec<f64>, f64), NoGait> {
    let request = GaitRequest {
        period: problem.period,
        iteration_limit,
        map_limit,
        accuracy,
        measures: false,
        tolerance: f64::max(1e-10, 10.0 * problem.settings.accuracy.relative),
        ..GaitRequest::new(parameters, &problem.memory)
    };
    let outcome = find_gait(problem.map, &request, guess).map_err(|error| NoGait::Wrong(error.into()))?;
    match (outcome.status, outcome.gait) {
        (GaitStatus::Converged, Some(gait)) => Ok((gait.coordinates.as_slice().to_vec(), gait.map.duration)),
        (GaitStatus::Stopped(stop), _) => Err(NoGait::Stopped(stop)),
        (GaitStatus::Open(open), _) => Err(NoGait::Open(open.describe(problem.map.info()))),
        _ => Err(NoGait::NotConverged(outcome.residual)),
    }
}

/// The accuracy of maps near a gait of this duration (s): a run that goes on much longer leads to none of the same kind, and is
/// given up, so that places from which no step ends cost little.
pub(super) fn patient(accuracy: Accuracy, duration: f64) -> Accuracy {
    let limit = PATIENCE * duration;
    Accuracy { time_limit: if limit > 0.0 { accuracy.time_limit.min(limit) } else { accuracy.time_limit }, ..accuracy }
}

/// Follows a gait from one set of parameters to another.
pub(super) fn follow(problem: &Problem<'_>, from: &Start, to: &[f64]) -> Result<Start, NoGait> {
    let (last, failure) = follow_far(problem, from, to)?;
    failure.map_or(Ok(last), Err)
}

/// Follows a gait from one set of parameters towards another as far as it goes, halving the way on failure; predicts along
/// the secant. The last gait, and why it went no further.
///
/// # Errors
/// Only for a problem that is wrong as stated.
pub(super) fn follow_far(problem: &Problem<'_>, from: &Start, to: &[f64]) -> Result<(Start, Option<NoGait>), NoGait> {
    let accuracy = problem.settings.accuracy;
    let mut longest = match map(problem, &from.parameters, &from.section, accuracy, false) {
        Ok(first) => first.duration,
        Err(NoGait::Wrong(error)) => return Err(NoGait::Wrong(error)),
        Err(_) => f64::INFINITY,
    };
    let gait = |parameters: &[f64], guess: &[f64]| {
        if problem.settings.interrupt.requested() {
            return Err(NoGait::Interrupted);
        }
        let (section, duration) =
            within(problem, parameters, guess, (CORRECTIONS, usize::MAX), patient(accuracy, longest))?;
        longest = longest.max(duration);
        Ok(section)
    };
    let is_final = |failure: &NoGait| matches!(failure, NoGait::Interrupted | NoGait::Wrong(_));
    let followed = follow::follow((&from.parameters, &from.section), to, gait, is_final);
    match followed.failure {
        Some(NoGait::Wrong(error)) => Err(NoGait::Wrong(error)),
        failure => Ok((Start { parameters: followed.parameters, section: followed.section }, failure)),
    }
}
