//! Starting points: the given one, then a scrambled Sobol sequence that fills the ranges evenly.
//!
//! Each start brings its own gait, followed from the first one; everything here is a pure function of problem and
//! number of the start.

use super::gait::{self, NoGait, Start};
use super::problem::Problem;
use super::sobol;
use rayon::prelude::*;

/// How many other parameter sets are tried when there is no gait at the given ones.
const RESCUES: usize = 32;

/// The given parameters with the varied ones inside their ranges, and the numbers of those that had to be moved.
pub(super) fn projected(problem: &Problem<'_>) -> (Vec<f64>, Vec<usize>) {
    let mut parameters = problem.parameters.clone();
    let mut moved = Vec::new();
    for vary in &problem.vary {
        let value = parameters[vary.parameter];
        let inside = value.clamp(vary.lower, vary.upper);
        if inside != value {
            moved.push(vary.parameter);
        }
        parameters[vary.parameter] = inside;
    }
    (parameters, moved)
}

/// The first gait: at the projected parameters; else followed from the given ones; else at any point of the ranges.
///
/// # Errors
/// The failure at the projected parameters.
pub(super) fn first(problem: &Problem<'_>, parameters: &[f64]) -> Result<Start, NoGait> {
    let failure = match gait::near(problem, parameters, &problem.start) {
        Ok(section) => return Ok(Start { parameters: parameters.to_vec(), section }),
        Err(NoGait::Wrong(error)) => return Err(NoGait::Wrong(error)),
        Err(failure) => failure,
    };
    if parameters != problem.parameters
        && let Ok(section) = gait::near(problem, &problem.parameters, &problem.start)
        && let Ok(start) = gait::follow(problem, &Start { parameters: problem.parameters.clone(), section }, parameters)
    {
        return Ok(start);
    }
    let found = (1..=rescues(problem)).into_par_iter().find_map_first(|number| {
        if problem.settings.interrupt.requested() {
            return None;
        }
        let parameters = spread(problem, parameters, number);
        let section = gait::at_a_glance(problem, &parameters, &problem.start).ok()?;
        Some(Start { parameters, section })
    });
    found.ok_or(if problem.settings.interrupt.requested() { NoGait::Interrupted } else { failure })
}

/// How many other parameter sets are tried: fewer where a gait takes many maps, so that the work stays bounded.
pub(super) fn rescues(problem: &Problem<'_>) -> usize {
    let each = gait::GLANCE.saturating_mul(problem.period);
    (problem.settings.work / each.max(1)).clamp(1, RESCUES)
}

/// Start number `number` (from 1), followed from the first; where the gait cannot be followed all the way, the last one
/// on the way there.
///
/// # Errors
/// Where there is no step of the way at all.
pub(super) fn further(problem: &Problem<'_>, first: &Start, number: usize) -> Result<Start, NoGait> {
    let (last, failure) = gait::follow_far(problem, first, &spread(problem, &first.parameters, number))?;
    match failure {
        Some(failure) if last.parameters == first.parameters => Err(failure),
        _ => Ok(last),
    }
}

/// Parameters number `number` (from 1) of the sequence in the ranges.
pub(super) fn spread(problem: &Problem<'_>, base: &[f64], number: usize) -> Vec<f64> {
    let mut parameters = base.to_vec();
    for (axis, vary) in problem.vary.iter().enumerate() {
        let fraction = sobol::coordinate(number.saturating_sub(1), axis, problem.settings.seed);
        let value = vary.lower + fraction * (vary.upper - vary.lower);
        parameters[vary.parameter] = value.clamp(vary.lower, vary.upper);
    }
    parameters
}
