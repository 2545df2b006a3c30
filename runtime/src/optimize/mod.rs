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
mod characteristic;
mod confirm;
mod critical_cone;
mod disturbed;
mod envelope;
mod escape;
mod gait;
mod independent;
mod jacobian_derivative;
mod jury;
mod kkt;
mod linearisation;
mod lyapunov;
mod message;
mod noise;
mod problem;
mod program;
mod quasi_newton;
mod search;
mod second_order;
mod solution;
mod starts;
mod stepper;
mod subproblem;
mod variables;
mod verdict;

pub use problem::{
    Bound, Constraint, ConstraintKind, Expression, Objective, Problem, ProblemError, Sense, Settings, Value, Vary,
};
pub use solution::{
    Active, ActiveKind, Confirmation, Curvature, Disturbed, Independent, Kink, Route, Sensitivity, Shape, Solution,
    Starts, Status,
};

use gait::NoGait;
use program::{Failure, Program};
use starts::Start;
use verdict::Verdict;

/// Solves a problem from all its starts; the best confirmed optimum wins. Deterministic.
///
/// # Errors
/// When the problem is wrong as stated.
pub fn solve(problem: &Problem<'_>) -> Result<Solution, ProblemError> {
    problem.validate()?;
    let (parameters, moved) = starts::projected(problem);
    let first = match starts::first(problem, &parameters) {
        Ok(first) => first,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(failure) => {
            let mut solution = verdict::no_gait(problem, parameters, &failure).solution;
            solution.starts.run = 1;
            return Ok(solution);
        }
    };
    let mut best = run(problem, &first, 0)?;
    let mut converged = usize::from(best.solution.status == Status::Optimal);
    for number in 1..problem.settings.starts {
        let verdict = run(problem, &first, number)?;
        converged += usize::from(verdict.solution.status == Status::Optimal);
        if better(problem, &verdict, &best) {
            best = verdict;
        }
    }
    let mut solution = verdict::tested(problem, best);
    solution.starts = Starts { run: problem.settings.starts, converged };
    solution.notes.extend(start_notes(problem, &moved, first.parameters != parameters));
    Ok(solution)
}

/// One start, a pure function of its number.
fn run(problem: &Problem<'_>, first: &Start, number: usize) -> Result<Verdict, ProblemError> {
    let further = match number {
        0 => Ok(first.clone()),
        _ => starts::further(problem, first, number),
    };
    let start = match further {
        Ok(start) => start,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(failure) => return Ok(verdict::no_gait(problem, first.parameters.clone(), &failure)),
    };
    match local(problem, &start) {
        Ok(verdict) => Ok(verdict),
        Err(Failure::Wrong(error)) => Err(error),
        Err(Failure::Stopped(stop)) => Ok(verdict::no_gait(problem, start.parameters, &NoGait::Stopped(stop))),
        Err(Failure::NotFinite(what)) => Ok(verdict::undefined(&start, &what)),
        Err(Failure::NoDerivative) => Ok(verdict::undefined(&start, "the derivative of the Jacobian")),
    }
}

/// The search from one gait, judged.
fn local(problem: &Problem<'_>, start: &Start) -> Result<Verdict, Failure> {
    let program = Program::new(problem, &start.parameters, &start.section)?;
    let point = verdict::starting_point(&program, &start.parameters, &start.section)?;
    let ended = search::search(&program, point)?;
    verdict::verdict(&program, ended).map_err(Failure::Wrong)
}

/// Whether a verdict is better: first by status, then by objective (for violated constraints: by violation).
fn better(problem: &Problem<'_>, a: &Verdict, b: &Verdict) -> bool {
    let rank = |status| match status {
        Status::Optimal => 0,
        Status::Unbounded => 1,
        Status::Unconfirmed | Status::Saddle => 2,
        Status::IterationLimit | Status::Stalled | Status::SubproblemFailed => 3,
        Status::InfeasibleLocally => 4,
        Status::NoGait => 5,
    };
    let (x, y) = (rank(a.solution.status), rank(b.solution.status));
    if x != y {
        return x < y;
    }
    if x >= 3 {
        return a.violation < b.violation;
    }
    match problem.sense {
        Sense::Maximize => a.solution.objective > b.solution.objective,
        Sense::Minimize => a.solution.objective < b.solution.objective,
    }
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
