//! The gait optimizer: the best gait over parameters, subject to what must hold.
//!
//! ```text
//! maximise or minimise   F(m(z, p), p)
//! over                   varied parameters p_j in [lower, upper], section coordinates z
//! subject to             P(z; p) = z
//!                        margin_i(m(z, p), p) >= 0
//!                        spectral_radius(dP/dz) <= r
//! ```
//!
//! P is the return map, m its measures. The method is sequential convex programming ([`solve`], module `search`) with
//! exact first derivatives; stability enters through the Jury inequalities (module `jury`). An optimum is reported only
//! after a fresh simulation has confirmed it (module `confirm`). The mathematics is in `docs/optimizer.md`.
//!
//! A problem that is wrong as stated is a [`ProblemError`]; everything else, also that there is no gait or no optimum,
//! is a [`Solution`] whose [`Status`] and message say what happened and what to do next.

mod active_set;
mod attempt;
mod best;
mod characteristic;
mod confirm;
mod conflict;
mod critical_cone;
mod disturbed;
mod envelope;
mod escape;
mod factors;
mod gait;
mod independent;
mod jacobian_derivative;
mod jury;
mod kkt;
mod linearisation;
mod lyapunov;
mod maps;
mod message;
mod noise;
mod optima;
mod pieces;
mod problem;
mod program;
mod quasi_newton;
mod restore;
mod robust;
mod rows;
mod scene;
mod search;
mod second_order;
pub(crate) mod sobol;
mod solution;
mod solver;
mod spectrum;
mod standing;
mod starts;
mod stepper;
mod subproblem;
mod task;
mod trade;
mod unchanging;
mod variables;
mod verdict;

pub use crate::interrupt::Interrupt;
pub use conflict::{Conflict, Reached};
pub use optima::Optimum;
pub use problem::{
    Bound, Constraint, ConstraintKind, Expression, Objective, Problem, ProblemError, Sense, Settings, Value, Vary,
};
pub use robust::{Exception, InTheWay, Lost, RobustSolution, Scenario, Uncertain, solve_robust};
pub use solution::{
    Active, ActiveKind, Confirmation, Curvature, Disturbed, Independent, Kink, Route, Sensitivity, Shape, Solution,
    Starts, Status,
};
pub use solver::{Clarabel, Counts, Tally};
pub use trade::{Aim, Curve, Family, Gap, Origin, TradeOutcome, TradePoint, trade};

use attempt::{Attempt, attempt, goes_on};
use conflict::Found;
use gait::{NoGait, Start};
use rayon::prelude::*;
use restore::Blocked;

/// Where no start leads to an optimum, at least this many are tried before that is said.
const ENOUGH: usize = 5;
/// From how many starts the searches must agree that constraints cannot hold together.
const AGREEING: usize = 2;

/// Solves a problem from all its starts, side by side; the best confirmed optimum wins. Deterministic: the result depends
/// neither on the number of threads nor on which start ends first.
///
/// # Errors
/// When the problem is wrong as stated.
pub fn solve(problem: &Problem<'_>) -> Result<Solution, ProblemError> {
    problem.validate()?;
    match problem.settings.threads {
        0 => from_all_starts(problem),
        threads => {
            let hint = "the system refuses to start so many; give fewer";
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.map_err(|_| ProblemError::Setting { setting: "threads", hint })?.install(|| from_all_starts(problem))
        }
    }
}

fn from_all_starts(problem: &Problem<'_>) -> Result<Solution, ProblemError> {
    let (parameters, moved) = starts::projected(problem);
    let first = match starts::first(problem, &parameters) {
        Ok(first) => first,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(failure) => {
            let mut solution = verdict::no_gait(problem, parameters, &failure).solution;
            if matches!(failure, NoGait::Interrupted) {
                solution.status = Status::Interrupted;
                solution.message = "interrupted before any gait was found".to_owned();
            } else {
                solution.notes.push(message::nowhere(starts::rescues(problem)));
            }
            solution.starts.run = 1;
            return Ok(solution);
        }
    };
    let asked = problem.settings.starts;
    let mut attempts = run(problem, &first, 0..asked)?;
    let interrupted = || problem.settings.interrupt.requested();
    let no_optimum = |attempts: &[(usize, Attempt)]| attempts.iter().all(|(_, a)| goes_on(a.verdict.solution.status));
    if no_optimum(&attempts) && !interrupted() {
        attempts.extend(run(problem, &first, asked..ENOUGH)?);
    }
    let mut conflict = None;
    // Where a gait meets all constraints, if only one that is not confirmed to be the best, none is in the way.
    let met = |a: &Attempt| a.verdict.solution.status == Status::Unconfirmed && attempt::met(&a.verdict);
    if no_optimum(&attempts) && !interrupted() && !attempts.iter().any(|(_, a)| met(a)) {
        let blocked: Vec<Blocked> = attempts.iter().filter_map(|(_, attempt)| attempt.blocked.clone()).collect();
        match conflict::find(problem, &blocked)? {
            Found::Conflict(found) => conflict = Some(found),
            Found::Feasible(gait) => {
                let verdict = attempt::from(problem, &gait)?;
                attempts.push((attempts.len(), Attempt { verdict, blocked: None }));
            }
            Found::Nothing => {}
        }
    }
    let mut solution = chosen(problem, attempts, conflict.filter(|_| !interrupted()));
    if solution.status == Status::Optimal
        && solution.active.is_empty()
        && unchanging::unchanging(problem, &first, &solution)
    {
        solution.message = message::constant(problem);
    }
    solution.notes.extend(start_notes(problem, &moved, first.parameters != parameters));
    Ok(solution)
}

/// Runs starts side by side, in the order of their numbers; those that an interruption came before are left out (but
/// never the first).
fn run(
    problem: &Problem<'_>,
    first: &Start,
    numbers: std::ops::Range<usize>,
) -> Result<Vec<(usize, Attempt)>, ProblemError> {
    let one = |number: usize| -> Option<Result<(usize, Attempt), ProblemError>> {
        let skipped = number > 0 && problem.settings.interrupt.requested();
        (!skipped).then(|| Ok((number, attempt(problem, first, number)?)))
    };
    if numbers.len() == 1 {
        numbers.filter_map(one).collect()
    } else {
        numbers.into_par_iter().filter_map(one).collect()
    }
}

/// The best of all attempts, with what the others say.
fn chosen(problem: &Problem<'_>, mut attempts: Vec<(usize, Attempt)>, conflict: Option<Conflict>) -> Solution {
    let interrupted = attempts.iter().any(|(_, attempt)| attempt.verdict.solution.status == Status::Interrupted)
        || (attempts.len() < problem.settings.starts)
        // A search, a restoration or a confirmation that was cut short says nothing of its own.
        || (problem.settings.interrupt.requested()
            && attempts.iter().all(|(_, attempt)| attempt.verdict.solution.status != Status::Optimal));
    let run = attempts.len();
    attempts.sort_by(|(i, a), (k, b)| {
        let order = if interrupted { attempt::order_so_far } else { attempt::order };
        order(problem, &a.verdict, &b.verdict).then(i.cmp(k))
    });
    // The long tests are for an answer, not for what an interruption leaves.
    let refuted = if problem.settings.long_tests && !interrupted { refuted(problem, &mut attempts) } else { 0 };
    let optima = optima::distinct(problem, attempts.iter().map(|(_, attempt)| &attempt.verdict));
    let converged = optima.iter().map(|optimum| optimum.starts).sum();
    let mut attempts = attempts.into_iter();
    let Some((number, Attempt { verdict, .. })) = attempts.next() else {
        // Start 0 always runs.
        return verdict::no_gait(problem, problem.parameters.clone(), &NoGait::Interrupted).solution;
    };
    let met = attempt::met(&verdict);
    let mut solution = verdict.solution;
    if solution.status == Status::Optimal && refuted > 0 {
        solution.notes.push(message::refuted(refuted));
    }
    if interrupted {
        if solution.status != Status::Interrupted {
            let detail = if met { "" } else { "it is the one shown here" };
            solution.message =
                message::message(problem, &Solution { status: Status::Interrupted, ..solution.clone() }, detail);
        }
        solution.status = Status::Interrupted;
    }
    if let Some(conflict) = conflict {
        let agree = conflict.agreeing >= AGREEING;
        solution.status = if agree { Status::Infeasible } else { Status::InfeasibleLocally };
        solution.message = message::conflict(problem, &conflict);
        solution.conflict = Some(conflict);
    } else if goes_on(solution.status) && run > 1 {
        solution.message.push_str(&message::also_others(run));
    }
    if solution.status == Status::Optimal && number >= problem.settings.starts {
        solution.notes.push(
            "the search from the given start led to no optimum; this one was found from another start".to_owned(),
        );
    }
    solution.optima = optima;
    solution.starts = Starts { run, converged };
    solution
}

/// Puts optima to the long tests, best first, until one passes, which then comes first. How many did not pass.
fn refuted(problem: &Problem<'_>, attempts: &mut [(usize, Attempt)]) -> usize {
    let optimal = |attempt: &Attempt| attempt.verdict.solution.status == Status::Optimal;
    let mut refuted = 0;
    for (_, attempt) in attempts.iter_mut().filter(|(_, attempt)| optimal(attempt)) {
        if verdict::tested(problem, &mut attempt.verdict) {
            break;
        }
        refuted += 1;
    }
    // Stable: what is of the same status stays in its order.
    attempts.sort_by_key(|(_, attempt)| !optimal(attempt));
    refuted
}

fn start_notes(problem: &Problem<'_>, moved: &[usize], elsewhere: bool) -> Vec<String> {
    let info = problem.map.info();
    let name = |p: usize| info.parameters.get(p).map_or("?", |q| q.name);
    let mut notes: Vec<String> = moved
        .iter()
        .map(|&p| format!("the start value of `{}` lies outside its range and was moved to the nearest bound", name(p)))
        .collect();
    if elsewhere {
        notes.push("there is no gait at the given parameters; the search began elsewhere in the ranges".to_owned());
    }
    notes
}
