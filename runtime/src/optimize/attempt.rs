//! One start: its gait, the search from there, the way round where that search ends without an optimum, the verdict.

use super::gait::{NoGait, Start};
use super::pieces;
use super::problem::{Problem, ProblemError, Sense};
use super::program::Failure;
use super::restore::{Blocked, Restored, restore};
use super::scene::Scene;
use super::solution::Status;
use super::starts;
use super::task::Task;
use super::verdict::{self, Verdict};
use std::cmp::Ordering;

/// Violation, in units of a constraint's scale, up to which a gait on the way counts as one that meets it.
const MET: f64 = 1e-6;

/// What came of one start.
pub(super) struct Attempt {
    pub(super) verdict: Verdict,
    /// What was in the way of bringing its constraints to hold.
    pub(super) blocked: Option<Blocked>,
}

/// Runs one start, a pure function of its number (as long as nobody interrupts). A search that ends without an optimum is
/// repeated from a gait at which all constraints hold, where one can be reached.
///
/// # Errors
/// Only for a problem that turns out to be wrong as stated.
pub(super) fn attempt(problem: &Problem<'_>, first: &Start, number: usize) -> Result<Attempt, ProblemError> {
    let further = match number {
        0 => Ok(first.clone()),
        _ => starts::further(problem, first, number),
    };
    let start = match further {
        Ok(start) => start,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(failure) => {
            let verdict = verdict::no_gait(problem, first.parameters.clone(), &failure);
            return Ok(Attempt { verdict, blocked: None });
        }
    };
    let direct = from(problem, &start)?;
    let wanted = vec![true; problem.constraints.len()];
    if !goes_on(direct.solution.status) || wanted.is_empty() || problem.settings.interrupt.requested() {
        return Ok(Attempt { verdict: direct, blocked: None });
    }
    match restore(problem, &wanted, &start)? {
        Restored::Blocked(blocked) => Ok(Attempt { verdict: direct, blocked: Some(blocked) }),
        // All constraints held at the start itself: nothing new to try.
        Restored::Feasible(gait) if gait != start => {
            let second = from(problem, &gait)?;
            let verdict = if order(problem, &second, &direct) == Ordering::Less { second } else { direct };
            Ok(Attempt { verdict, blocked: None })
        }
        Restored::Feasible(_) | Restored::Lost => Ok(Attempt { verdict: direct, blocked: None }),
    }
}

/// Whether an end may be due to the start alone.
pub(super) fn goes_on(status: Status) -> bool {
    !matches!(status, Status::Optimal | Status::Unbounded | Status::Interrupted | Status::WorkLimit)
}

/// The search from one gait, judged.
pub(super) fn from(problem: &Problem<'_>, start: &Start) -> Result<Verdict, ProblemError> {
    let failure = match judged(problem, start) {
        Ok(mut verdict) => {
            // A confirmation that was cut short disagrees with nothing.
            if verdict.solution.status == Status::Unconfirmed && problem.settings.interrupt.requested() {
                verdict.solution.status = Status::Interrupted;
            }
            return Ok(verdict);
        }
        Err(failure) => failure,
    };
    match failure {
        Failure::Wrong(error) => Err(error),
        Failure::Stopped(stop) => Ok(verdict::no_gait(problem, start.parameters.clone(), &NoGait::Stopped(stop))),
        Failure::NotFinite(what) => Ok(verdict::undefined(start, &what)),
        Failure::NoDerivative => Ok(verdict::undefined(start, "the derivative of the Jacobian")),
    }
}

fn judged(problem: &Problem<'_>, start: &Start) -> Result<Verdict, Failure> {
    let from = (start.parameters.as_slice(), start.section.as_slice());
    let (program, ended) = pieces::searched(problem, &Task::asked(problem), &[Scene::default()], from)?;
    verdict::verdict(&program, ended).map_err(Failure::Wrong)
}

/// Which of two verdicts is better (`Less`): first by status, then by objective, without an optimum by violation.
pub(super) fn order(problem: &Problem<'_>, a: &Verdict, b: &Verdict) -> Ordering {
    let rank = |verdict: &Verdict| match verdict.solution.status {
        Status::Optimal => 0,
        Status::Unbounded => 1,
        Status::Unconfirmed | Status::Saddle => 2,
        Status::Interrupted
        | Status::IterationLimit
        | Status::WorkLimit
        | Status::Stalled
        | Status::SubproblemFailed => 3,
        Status::Infeasible | Status::InfeasibleLocally => 4,
        Status::Undefined => 5,
        Status::NoGait => 6,
    };
    let violation = |v: &Verdict| if rank(v) >= 3 { v.violation } else { 0.0 };
    (rank(a).cmp(&rank(b))).then(violation(a).total_cmp(&violation(b))).then(by_objective(problem, a, b))
}

/// Which of two gaits is better to have when the search was interrupted: one that meets the constraints, then by objective.
pub(super) fn order_so_far(problem: &Problem<'_>, a: &Verdict, b: &Verdict) -> Ordering {
    let violation = |v: &Verdict| if v.violation <= MET { 0.0 } else { v.violation };
    violation(a).total_cmp(&violation(b)).then(by_objective(problem, a, b))
}

/// Whether a gait meets the constraints closely enough to be reported as the best so far.
pub(super) fn met(verdict: &Verdict) -> bool {
    verdict.violation <= MET
}

/// The better objective first; what has none last.
fn by_objective(problem: &Problem<'_>, a: &Verdict, b: &Verdict) -> Ordering {
    let value = |v: &Verdict| match (problem.sense, v.solution.objective) {
        (_, x) if x.is_nan() => f64::INFINITY,
        (Sense::Maximize, x) => -x,
        (Sense::Minimize, x) => x,
    };
    value(a).total_cmp(&value(b))
}
