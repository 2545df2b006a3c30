//! From an easy problem to the asked one: constraints that a gait violates are brought to hold one after the other.
//!
//! Each is pushed until it holds (a search that maximises its margin, or minimises the spectral radius) while those that
//! hold already are kept. Every one of these searches begins at a gait that is feasible for it, and its number is at most
//! that of the constraints. What ends in the way is a set of constraints of which all but one hold, and the most that
//! was reached of that one.

use super::gait::{self, NoGait, Start};
use super::pieces;
use super::problem::{Problem, ProblemError};
use super::program::Failure;
use super::scene::Scene;
use super::search::{End, Ended};
use super::standing::{Standing, standing};
use super::task::{Goal, Task};

/// What a push may lose of the constraints that it keeps, in units of their scales.
const SLACK: f64 = 1e-6;

/// Where a restoration ended.
pub(super) enum Restored {
    /// A gait at which all wanted constraints hold.
    Feasible(Start),
    /// One constraint could not be brought to hold together with those before it.
    Blocked(Blocked),
    /// There was no gait to go on from, or a value is not defined.
    Lost,
}

/// A constraint in the way.
#[derive(Clone, Debug)]
pub(super) struct Blocked {
    /// Where the restoration began.
    pub(super) from: Start,
    /// The gait with the largest margin of `failing`.
    pub(super) at: Start,
    /// The constraints that hold there, because they were kept.
    pub(super) kept: Vec<bool>,
    /// The one that does not.
    pub(super) failing: usize,
}

/// The end of one push.
pub(super) struct Pushed {
    /// The gait.
    pub(super) gait: Start,
    pub(super) standing: Standing,
    /// Whether the constraint holds there, and all kept ones still do.
    pub(super) reached: bool,
    /// Whether the search converged: no small change brings the constraint any closer to holding.
    pub(super) converged: bool,
}

/// Brings all `wanted` constraints to hold, from a gait.
///
/// # Errors
/// Only for a problem that turns out to be wrong as stated.
pub(super) fn restore(problem: &Problem<'_>, wanted: &[bool], from: &Start) -> Result<Restored, ProblemError> {
    let tolerance = 10.0 * problem.settings.attainable_feasibility();
    let mut kept = vec![false; wanted.len()];
    let mut at = from.clone();
    loop {
        let Some(now) = values(problem, &at)? else { return Ok(Restored::Lost) };
        for i in 0..wanted.len() {
            kept[i] |= wanted[i] && now.holds(i, tolerance);
        }
        let missing = (0..wanted.len()).filter(|&i| wanted[i] && !kept[i]);
        // The easiest first; what is not defined here may be so after the others hold.
        let ease = |i: usize| if now.scaled[i].is_nan() { f64::NEG_INFINITY } else { now.scaled[i] };
        let Some(next) = missing.max_by(|&a, &b| ease(a).total_cmp(&ease(b)).then(b.cmp(&a))) else {
            return Ok(Restored::Feasible(at));
        };
        match push(problem, &kept, next, &at)? {
            None => return Ok(Restored::Lost),
            Some(pushed) if pushed.reached => {
                kept[next] = true;
                at = pushed.gait;
            }
            Some(pushed) => {
                let blocked = Blocked { from: from.clone(), at: pushed.gait, kept, failing: next };
                return Ok(Restored::Blocked(blocked));
            }
        }
    }
}

/// Pushes one constraint towards holding, while others are kept; `None` where there is no gait at the end, or no value.
///
/// # Errors
/// Only for a problem that turns out to be wrong as stated.
pub(super) fn push(
    problem: &Problem<'_>,
    kept: &[bool],
    constraint: usize,
    from: &Start,
) -> Result<Option<Pushed>, ProblemError> {
    let mut kept = kept.to_vec();
    kept[constraint] = false;
    let ended = match pushing(problem, Task { goal: Goal::Push(constraint), kept: kept.clone() }, from) {
        Ok(ended) => ended,
        Err(Failure::Wrong(error)) => return Err(error),
        Err(_) => return Ok(None),
    };
    let section = match gait::near(problem, &ended.point.parameters, &ended.point.section) {
        Ok(section) => section,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(_) => return Ok(None),
    };
    let gait = Start { parameters: ended.point.parameters, section };
    let Some(standing) = values(problem, &gait)? else { return Ok(None) };
    let tolerance = 10.0 * problem.settings.attainable_feasibility();
    let all_kept = kept.iter().enumerate().all(|(i, kept)| !kept || standing.holds(i, SLACK));
    let reached = all_kept && standing.holds(constraint, tolerance);
    let converged = all_kept && matches!(ended.end, End::Converged | End::Acceptable);
    Ok(Some(Pushed { gait, standing, reached, converged }))
}

fn pushing(problem: &Problem<'_>, task: Task, from: &Start) -> Result<Ended, Failure> {
    let from = (from.parameters.as_slice(), from.section.as_slice());
    Ok(pieces::searched(problem, &task, &[Scene::default()], from)?.1)
}

/// The values at a gait; `None` where there are none.
fn values(problem: &Problem<'_>, gait: &Start) -> Result<Option<Standing>, ProblemError> {
    match standing(problem, gait) {
        Ok(standing) => Ok(Some(standing)),
        Err(NoGait::Wrong(error)) => Err(error),
        Err(_) => Ok(None),
    }
}
