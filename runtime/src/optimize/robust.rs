//! Robust problems: the best design for machines of which some parameters are only known to lie in ranges.
//!
//! ```text
//! maximise   t
//! over       varied parameters p, section coordinates z_s of each scenario, t
//! subject to F(m(z_s, p_s), p_s) >= t,   P(z_s; p_s) = z_s,   every constraint at (z_s, p_s)
//! ```
//!
//! p_s is p with the uncertain parameters of scenario s: the nominal values and the corners of the box. The design is one, the
//! gait adapts to each machine. Afterwards points inside the box are looked at; one that is worse than all scenarios, or at
//! which a constraint does not hold, becomes a scenario itself. What is left over makes the answer unconfirmed.

mod check;
mod judge;
mod restore;
mod scenarios;

use super::gait::{self, NoGait, Start};
use super::message;
use super::pieces;
use super::problem::{Problem, ProblemError};
use super::program::{Failure, Program};
use super::scene::Scene;
use super::search::{End, Ended};
use super::solution::{Solution, Status};
use super::task::Task;
use super::verdict;
use check::{Checked, check};
pub use restore::InTheWay;
use restore::{Design, Restored};

/// So many different optima of the nominal machine are begun from.
const MOST_BEGINNINGS: usize = 4;
/// How often points inside the box may become scenarios.
const ROUNDS: usize = 5;

/// A parameter that is only known to lie in a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// Index into `info().parameters`; not one that varies.
    pub parameter: usize,
    /// Lower end, SI units, finite.
    pub lower: f64,
    /// Upper end, SI units, finite, at least `lower`.
    pub upper: f64,
}

/// How the design does in one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Its values of the uncertain parameters, SI units, in their order.
    pub values: Vec<f64>,
    /// Section coordinates of its gait, SI units.
    pub section: Vec<f64>,
    /// Objective, SI units.
    pub objective: f64,
    /// Its spectral radius.
    pub spectral_radius: f64,
    /// Whether the objective of this scenario limits the worst one.
    pub worst: bool,
    /// The constraints that limit the optimum in this scenario (indices into `Problem::constraints`).
    pub limits: Vec<usize>,
}

/// A point inside the box that is worse than every scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Exception {
    /// Its values of the uncertain parameters, SI units, in their order.
    pub values: Vec<f64>,
    /// In words, what is worse there.
    pub what: String,
}

/// A machine to which the gait of no design could be followed that is best without uncertainty.
#[derive(Clone, Debug, PartialEq)]
pub struct Lost {
    /// Its values of the uncertain parameters, SI units, in their order.
    pub values: Vec<f64>,
    /// In words, why.
    pub why: String,
}

/// The result of [`solve_robust`].
#[derive(Clone, Debug)]
pub struct RobustSolution {
    /// The optimum. Its objective is the worst over all scenarios; section, multipliers and measures are those of the scenario
    /// that has it (of the largest spectral radius where that is the objective), and so are its uncertain parameters. Prices
    /// are the sums over all scenarios. Without an optimum, what the search ended with; where there was no search, no more than the
    /// design that is best without uncertainty.
    pub solution: Solution,
    /// All scenarios; empty where no gait could be followed to each of them.
    pub scenarios: Vec<Scenario>,
    /// The best objective of the problem as it is, without uncertainty, SI units.
    pub nominal: f64,
    /// How many points inside the box were looked at.
    pub checked: usize,
    /// How often points inside the box became scenarios.
    pub rounds: usize,
    /// Points inside that are worse than the scenarios all the same: the status is then no better than `Unconfirmed`.
    pub exceptions: Vec<Exception>,
    /// Where no design was found with which all constraints hold for all machines: the one in the way.
    pub in_the_way: Option<InTheWay>,
    /// Where there was nothing to search from: the machine without a gait.
    pub lost: Option<Lost>,
}

/// Solves a problem for all machines of the box that `uncertain` spans. Deterministic.
///
/// # Errors
/// When the problem is wrong as stated; also for a bound on the spectral radius that is an expression.
pub fn solve_robust(mut problem: Problem<'_>, uncertain: &[Uncertain]) -> Result<RobustSolution, ProblemError> {
    problem.validate()?;
    scenarios::validate(&problem, uncertain)?;
    let long_tests = std::mem::replace(&mut problem.settings.long_tests, false);
    let scenes = scenarios::corners(&problem, uncertain);
    for u in uncertain {
        let value = &mut problem.parameters[u.parameter];
        *value = value.clamp(u.lower, u.upper);
    }
    let nominal = super::solve(&problem)?;
    if nominal.status != Status::Optimal {
        return Ok(without(nominal, |message| format!("already without uncertainty: {message}")));
    }
    let robust = Robust { problem: &problem, uncertain, long_tests };
    let best_nominal = nominal.objective;
    let found = match robust.best(&nominal, &scenes)? {
        Ok(found) => robust.checked(found, &nominal)?,
        Err(none) => robust.nowhere(&nominal, Status::NoGait, none),
    };
    Ok(RobustSolution { nominal: best_nominal, ..found })
}

/// No optimum, and nothing to say of scenarios.
fn without(mut solution: Solution, message: impl Fn(&str) -> String) -> RobustSolution {
    solution.message = message(&solution.message);
    let nominal = solution.objective;
    RobustSolution {
        solution,
        scenarios: Vec::new(),
        nominal,
        checked: 0,
        rounds: 0,
        exceptions: Vec::new(),
        in_the_way: None,
        lost: None,
    }
}

/// Why there is no search: a machine that was lost on the way to it, or in words what else.
enum NoSearch {
    Lost(Lost),
    Other(String),
}

/// A robust problem that is being solved.
struct Robust<'p> {
    problem: &'p Problem<'p>,
    uncertain: &'p [Uncertain],
    long_tests: bool,
}

/// The end of one search.
struct Found<'p> {
    program: Program<'p>,
    ended: Ended,
    /// Why it is no optimum, where that is known.
    in_the_way: Option<InTheWay>,
}

impl<'p> Robust<'p> {
    /// The best end of searches from the optima of the nominal machine, or why there is none.
    fn best(&self, nominal: &Solution, scenes: &[Scene]) -> Result<Result<Found<'p>, NoSearch>, ProblemError> {
        let mut best: Option<Found<'p>> = None;
        let mut failure = NoSearch::Other(String::new());
        for optimum in nominal.optima.iter().take(MOST_BEGINNINGS) {
            let start = Start { parameters: optimum.parameters.clone(), section: optimum.section.clone() };
            match self.from(scenes, &start)? {
                Ok(found) if best.as_ref().is_none_or(|best| better(&found, best)) => best = Some(found),
                Ok(_) => {}
                Err(none) => failure = none,
            }
        }
        Ok(best.ok_or(failure))
    }

    /// The search from a gait of the nominal machine.
    fn from(&self, scenes: &[Scene], nominal: &Start) -> Result<Result<Found<'p>, NoSearch>, ProblemError> {
        let mut section = Vec::new();
        for scene in scenes {
            match gait::follow(self.problem, nominal, &scene.parameters(&nominal.parameters)) {
                Ok(start) => section.extend(start.section),
                Err(NoGait::Wrong(error)) => return Err(error),
                Err(failure) => {
                    return Ok(Err(NoSearch::Lost(Lost { values: self.values(scene), why: failure.to_string() })));
                }
            }
        }
        let design = Design { parameters: nominal.parameters.clone(), section };
        Ok(self.solved(scenes, &design)?.map_err(NoSearch::Other))
    }

    /// The search from a design; where it ends without an optimum, once more from one with which all constraints hold, or with
    /// the constraint that is in the way of such a design.
    fn solved(&self, scenes: &[Scene], from: &Design) -> Result<Result<Found<'p>, String>, ProblemError> {
        let first = self.search(scenes, &from.parameters, &from.section)?;
        let settled =
            |found: &Found<'_>| converged(found) || matches!(found.ended.end, End::Unbounded | End::Exhausted);
        let none = self.problem.constraints.is_empty() || self.problem.settings.interrupt.requested();
        if none || first.as_ref().is_ok_and(settled) {
            return Ok(first);
        }
        Ok(match self.restored(scenes, from)? {
            Restored::Feasible(design) => match (first, self.search(scenes, &design.parameters, &design.section)?) {
                (Ok(first), Ok(second)) => Ok(if better(&second, &first) { second } else { first }),
                (Err(_), second) => second,
                (first, Err(_)) => first,
            },
            Restored::Blocked(blocked) => first.map(|found| Found { in_the_way: Some(*blocked), ..found }),
            Restored::Lost => first,
        })
    }

    /// The search from gaits of all scenes.
    fn search(
        &self,
        scenes: &[Scene],
        parameters: &[f64],
        section: &[f64],
    ) -> Result<Result<Found<'p>, String>, ProblemError> {
        let run = || {
            let task = Task::asked(self.problem);
            let (program, ended) = pieces::searched(self.problem, &task, scenes, (parameters, section))?;
            Ok(Found { program, ended, in_the_way: None })
        };
        match run() {
            Ok(found) => Ok(Ok(found)),
            Err(Failure::Wrong(error)) => Err(error),
            Err(Failure::Stopped(stop)) => Ok(Err(NoGait::Stopped(stop).to_string())),
            Err(Failure::NotFinite(what)) => Ok(Err(format!("{what} is not defined where the search would begin"))),
            Err(Failure::NoDerivative) => {
                Ok(Err("the Jacobian has no derivative where the search would begin".to_owned()))
            }
        }
    }

    /// Looks inside the box, and makes scenarios of the worst points there, as long as that changes anything.
    fn checked(&self, mut found: Found<'p>, nominal: &Solution) -> Result<RobustSolution, ProblemError> {
        let mut rounds = 0;
        loop {
            let judged = judge::judged(self, &mut found)?;
            if judged.status != Status::Optimal {
                return Ok(self.result(judged, &found, Checked::default(), rounds));
            }
            let checked = check(self, &found)?;
            if checked.worse.is_empty() || rounds == ROUNDS || self.problem.settings.interrupt.requested() {
                let solution = judge::confirmed(self, &found, judged)?;
                return Ok(self.result(solution, &found, checked, rounds));
            }
            rounds += 1;
            let mut scenes = found.program.scenes.clone();
            let mut section = found.ended.point.section.clone();
            for worse in &checked.worse {
                scenes.push(self.scene(&worse.values));
                section.extend(&worse.section);
            }
            let parameters = found.ended.point.parameters.clone();
            match self.solved(&scenes, &Design { parameters, section })? {
                Ok(next) => found = next,
                Err(words) => return Ok(self.nowhere(nominal, Status::Stalled, NoSearch::Other(words))),
            }
        }
    }

    fn result(&self, solution: Solution, found: &Found<'_>, checked: Checked, rounds: usize) -> RobustSolution {
        let exceptions = checked.worse.into_iter().map(|worse| Exception { values: worse.values, what: worse.what });
        let mut exceptions: Vec<Exception> = exceptions.collect();
        exceptions.extend(checked.lost);
        let mut solution = solution;
        if let (Status::Optimal, [first, ..]) = (solution.status, exceptions.as_slice()) {
            solution.status = Status::Unconfirmed;
            solution.message = self.exception(first, exceptions.len(), checked.points);
        }
        if let Some(in_the_way) = &found.in_the_way {
            solution.status = Status::InfeasibleLocally;
            solution.message = self.blocked(in_the_way);
        }
        RobustSolution {
            scenarios: judge::scenarios(self, found),
            solution,
            nominal: f64::NAN,
            checked: checked.points,
            rounds,
            exceptions,
            in_the_way: found.in_the_way.clone(),
            lost: None,
        }
    }

    /// Without a search: the design that is best without uncertainty, and nothing of how that does, which would be taken for the
    /// worst case.
    fn nowhere(&self, nominal: &Solution, status: Status, why: NoSearch) -> RobustSolution {
        let (message, lost) = match why {
            NoSearch::Other(words) => (words, None),
            NoSearch::Lost(lost) => {
                let at = scenarios::words(self.problem, self.uncertain, &lost.values);
                (message::lost(&at, &lost.why), Some(lost))
            }
        };
        let (parameters, section) = (nominal.parameters.clone(), nominal.section.clone());
        let mut solution = verdict::without_values(status, message, parameters, section).solution;
        solution.notes.clone_from(&nominal.notes);
        RobustSolution { lost, ..without(solution, str::to_owned) }
    }

    /// The message of a worst case that is not the worst.
    fn exception(&self, first: &Exception, count: usize, points: usize) -> String {
        let at = scenarios::words(self.problem, self.uncertain, &first.values);
        format!(
            "the search converged, but its scenarios are not the worst: of {points} points inside the uncertain ranges {count} do \
             worse, or have no gait that can be followed; at {at} {}; narrow the ranges, or look at these machines with `gait`",
            first.what
        )
    }

    /// The message of a constraint in the way, without units of people.
    fn blocked(&self, in_the_way: &InTheWay) -> String {
        let name = |i: usize| self.problem.constraints.get(i).map_or("?", |c| c.name.as_str());
        let at = scenarios::words(self.problem, self.uncertain, &in_the_way.values);
        format!(
            "no design was found with which `{}` holds for all machines: at best it misses by {:.2e} of its scale at {at}; \
             narrow the uncertain ranges, relax it, or widen the ranges",
            name(in_the_way.reached.constraint),
            -in_the_way.reached.scaled
        )
    }

    /// The uncertain parameters in a scene.
    fn values(&self, scene: &Scene) -> Vec<f64> {
        let parameters = scene.parameters(&self.problem.parameters);
        self.uncertain.iter().map(|u| parameters[u.parameter]).collect()
    }

    /// The scene with these values.
    fn scene(&self, values: &[f64]) -> Scene {
        Scene { changed: self.uncertain.iter().zip(values).map(|(u, value)| (u.parameter, *value)).collect() }
    }
}

/// Whether a search ended at an optimum.
fn converged(found: &Found<'_>) -> bool {
    matches!(found.ended.end, End::Converged | End::Acceptable)
}

/// Whether an end is better than another: converged before all others, then by objective.
fn better(a: &Found<'_>, b: &Found<'_>) -> bool {
    // Each program has its own unit of the objective.
    let value = |found: &Found<'_>| found.program.objective_scale * found.ended.point.f;
    match (converged(a), converged(b)) {
        (true, false) => true,
        (false, true) => false,
        _ => value(a) < value(b),
    }
}
