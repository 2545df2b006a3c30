//! What is said to people: one message a verdict, with what to do next.

use super::conflict::{Conflict, Reached};
use super::gait::NoGait;
use super::problem::{ConstraintKind, Objective, Problem};
use super::program::{Point, Program, Row};
use super::solution::{ActiveKind, Kink, Solution, Status};
use crate::return_map::{Stop, StopReason, Warning};
use std::fmt;

/// Distance of a multiplier from 1 at which gaits meet or branch.
const FOLD: f64 = 1e-4;

/// The message of a verdict; `detail` names what is violated, disagrees, or what Clarabel said.
pub(super) fn message(problem: &Problem<'_>, solution: &Solution, detail: &str) -> String {
    match solution.status {
        Status::Optimal => optimal(problem, solution),
        Status::Unconfirmed => format!(
            "the search converged, but a fresh simulation disagrees: {detail}; tighten the accuracy, or look at the gait \
             with `gait` before relying on it"
        ),
        Status::Saddle => format!(
            "the first-order conditions of an optimum hold here, but the objective still improves {}, and no search from next \
             to it ended at a better gait; start elsewhere, or try more starts",
            along(problem, solution)
        ),
        Status::Infeasible | Status::InfeasibleLocally => format!(
            "no gait near here meets all constraints: {detail}; relax that constraint, widen the ranges, or try more starts"
        ),
        Status::NoGait => no_gait(detail),
        Status::Undefined => undefined(detail),
        Status::Interrupted => interrupted(detail),
        Status::Unbounded => {
            "the objective improves without limit; bound it with a constraint or narrow the ranges".to_owned()
        }
        Status::IterationLimit => format!(
            "no optimum within {} iterations (KKT residual {:.1e}); if the objective or a constraint has a kink here (abs, \
             min, max, if), state it as two smooth constraints; else start closer to the optimum",
            solution.iterations, solution.kkt_residual
        ),
        Status::WorkLimit => work_limit(problem, detail),
        Status::Stalled => format!(
            "the search cannot make progress (KKT residual {:.1e}{}); the map may stop or have a kink next to this \
             point: start elsewhere, or keep the ranges away from it",
            solution.kkt_residual,
            if detail.is_empty() { String::new() } else { format!(", {detail}") }
        ),
        Status::SubproblemFailed => format!(
            "Clarabel could not solve a subproblem ({detail}), also after rescaling and regularising; narrow the ranges \
             or start elsewhere"
        ),
    }
}

/// The message of a search that took more maps than it may; `detail` names violated constraints.
fn work_limit(problem: &Problem<'_>, detail: &str) -> String {
    let work = problem.settings.work;
    let gaits = match problem.period {
        1 => String::new(),
        period => format!(" (a gait takes {period} of them)"),
    };
    let shown = match detail {
        "" => "the best gait so far, not an optimum".to_owned(),
        detail => format!("the gait that came closest to meeting all constraints: {detail}"),
    };
    format!(
        "no optimum within {work} maps of the model{gaits}, the most that one search may take; this is {shown}; allow more \
         work, start closer, or ask for a shorter period"
    )
}

/// The message of a search around which the map has no next step.
pub(super) fn refused(solution: &Solution, stop: &Stop, detail: &str) -> String {
    let advice = match stop.reason {
        StopReason::NoEvent => "narrow the ranges to where steps are shorter",
        _ => "start elsewhere, or keep the ranges away from it",
    };
    format!(
        "the search cannot make progress (KKT residual {:.1e}{}): next to this point {}; {advice}",
        solution.kkt_residual,
        if detail.is_empty() { String::new() } else { format!(", {detail}") },
        stop_text(stop)
    )
}

/// The direction of a flat optimum or a saddle in terms of the varied parameters.
fn along(problem: &Problem<'_>, solution: &Solution) -> String {
    let parameters = problem.map.info().parameters;
    let name = |p: &usize| format!("`{}`", parameters.get(*p).map_or("?", |q| q.name));
    let names: Vec<String> = solution.curvature.iter().flat_map(|c| c.along.iter().map(name)).collect();
    if names.is_empty() { "as the gait moves".to_owned() } else { format!("along {}", names.join(" and ")) }
}

fn optimal(problem: &Problem<'_>, solution: &Solution) -> String {
    let limits = limits(problem, solution);
    if limits.is_empty() {
        "local optimum, confirmed by simulation; nothing limits it".to_owned()
    } else {
        format!("local optimum, confirmed by simulation; limited by {}", limits.join(", "))
    }
}

/// The message where a parameter is limited by a bound in units of its range, but not in its own size.
pub(super) fn range_too_wide(problem: &Problem<'_>, parameter: usize, value: f64, bound: f64) -> String {
    let name = problem.map.info().parameters.get(parameter).map_or("?", |q| q.name);
    let in_words = |value: f64| quantity(problem, parameter, value);
    let (least, most) = (in_words(0.01 * value.abs()), in_words(100.0 * value.abs()));
    let (value, bound) = (in_words(value), in_words(bound));
    format!(
        "the range of `{name}` is too wide to tell {value} from its bound {bound}; narrow it to the powers of ten that matter, \
         such as {least} to {most} in magnitude"
    )
}

/// A value of a parameter in SI units, to seven digits.
pub(super) fn quantity(problem: &Problem<'_>, parameter: usize, value: f64) -> String {
    let unit = match problem.map.info().parameters.get(parameter).map_or("1", |q| q.si) {
        "1" => String::new(),
        si => format!(" {si}"),
    };
    let digits = value.abs();
    if digits != 0.0 && !(1e-3..1e6).contains(&digits) {
        return format!("{value:.3e}{unit}");
    }
    let text = format!("{value:.6}");
    format!("{}{unit}", text.trim_end_matches('0').trim_end_matches('.'))
}

/// What limits an optimum: active bounds and constraints, and what the gaits themselves do there.
fn limits(problem: &Problem<'_>, solution: &Solution) -> Vec<String> {
    let info = problem.map.info();
    let name = |index: usize| info.parameters.get(index).map_or("?", |q| q.name);
    let mut limits: Vec<String> = solution
        .active
        .iter()
        .map(|active| match active.kind {
            ActiveKind::LowerBound(p) => format!("the lower bound of `{}`", name(p)),
            ActiveKind::UpperBound(p) => format!("the upper bound of `{}`", name(p)),
            ActiveKind::Constraint(i) => problem.constraints.get(i).map_or(String::new(), |c| match c.kind {
                ConstraintKind::SpectralRadius { .. } => format!("stability (`{}`)", c.name),
                ConstraintKind::Margin { .. } => format!("`{}`", c.name),
            }),
        })
        .collect();
    if solution.kink.is_some() && matches!(problem.objective, Objective::SpectralRadius) {
        limits.push("multipliers that meet here".to_owned());
    }
    if limits.is_empty() && solution.multipliers.iter().any(|m| (m - 1.0).norm() < FOLD) {
        limits.push("the gait itself, which ends or branches here (a multiplier is 1)".to_owned());
    }
    limits
}

/// The message of a conflict, without units: shares of each bound.
pub(super) fn conflict(problem: &Problem<'_>, conflict: &Conflict) -> String {
    let name = |i: usize| problem.constraints.get(i).map_or("?", |c| c.name.as_str());
    let names: Vec<String> = conflict.members.iter().map(|member| format!("`{}`", name(member.constraint))).collect();
    let reach =
        |member: &Reached| format!("`{}` misses by {:.2e} of its scale", name(member.constraint), -member.scaled);
    let reached: Vec<String> = conflict.members.iter().map(reach).collect();
    match names.as_slice() {
        [one] => format!("{one} cannot hold in these ranges: at best it misses by {:.2e} of its scale", {
            conflict.members.first().map_or(f64::NAN, |member| -member.scaled)
        }),
        _ => format!(
            "{} cannot hold together in these ranges: while the others hold, {}",
            listed(&names),
            listed(&reached)
        ),
    }
}

/// `a`, `b` and `c`.
fn listed(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}

/// The message of an objective that nothing changes.
pub(super) fn constant(problem: &Problem<'_>) -> String {
    let info = problem.map.info();
    let names: Vec<String> = (problem.vary.iter())
        .filter_map(|vary| info.parameters.get(vary.parameter))
        .map(|quantity| format!("`{}`", quantity.name))
        .collect();
    format!(
        "the objective does not change with {}: every gait that meets the constraints is as good as this one; \
         optimise something else, or vary what it depends on",
        listed(&names)
    )
}

/// The message where a value is missing at a start.
pub(super) fn undefined(what: &str) -> String {
    format!(
        "{what} is not defined where the search would begin (not a finite number there); begin elsewhere, narrow the ranges, \
         or state it so that it has a value everywhere"
    )
}

/// The message of an interrupted search; `detail` names violated constraints.
fn interrupted(detail: &str) -> String {
    if detail.is_empty() {
        "this is the best gait so far, not an optimum".to_owned()
    } else {
        format!("interrupted before any gait met all constraints; the one that came closest: {detail}")
    }
}

/// Said behind the message of a search without an optimum when other starts did no better.
pub(super) fn also_others(starts: usize) -> String {
    format!(" ({starts} starts ended without an optimum)")
}

/// The note where the first guess led to no gait, at the given parameters or elsewhere in the ranges.
pub(super) fn nowhere(places: usize) -> String {
    format!("nor was there a gait near that guess at {places} other places in the ranges")
}

/// The message without a gait.
pub(super) fn no_gait(detail: &str) -> String {
    format!("no periodic gait to start from: {detail}; give a better first guess of the section, or other parameters")
}

/// Which constraints do not hold at a point, and by how much relative to their scale; empty when all hold.
pub(super) fn violations(program: &Program<'_>, point: &Point) -> String {
    let tolerance = 10.0 * program.problem.settings.attainable_feasibility();
    let mut worst: Vec<(String, f64)> = Vec::new();
    let mut add = |name: String, value: f64| match worst.iter_mut().find(|(known, _)| *known == name) {
        Some((_, known)) => *known = known.max(value),
        None => worst.push((name, value)),
    };
    for (row, c) in program.rows.iter().zip(point.c.iter()) {
        if -c > tolerance
            && let Row::Margin(i, _) | Row::Jury(Some(i), _) = *row
            && let Some(constraint) = program.problem.constraints.get(i)
        {
            add(format!("`{}` is violated", constraint.name), -c);
        }
    }
    if point.h.amax() > tolerance {
        add("the gait is not periodic".to_owned(), point.h.amax());
    }
    let parts: Vec<String> = worst.into_iter().map(|(name, by)| format!("{name} (by {by:.1e} of its scale)")).collect();
    parts.join(", ")
}

/// The note where ends of other starts were better, or equal, but did not pass the long tests.
pub(super) fn refuted(count: usize) -> String {
    let ends = if count == 1 { "end of another start".to_owned() } else { format!("{count} ends of other starts") };
    format!("the {ends} came before this one, but did not pass the long tests of the confirmation")
}

/// The note where multipliers meet.
pub(super) fn kink(kink: &Kink) -> String {
    let m = kink.multiplier;
    format!(
        "multipliers meet near {:.6}{:+.6}i (relative gap {:.1e}): the spectral radius has a kink here, and to one side it \
         rises steeply",
        m.re, m.im, kink.gap
    )
}

/// The message where the gait of the best design without uncertainty is lost on the way to a machine.
pub(super) fn lost(machine: &str, why: &str) -> String {
    format!(
        "the best design without uncertainty has a gait, but it cannot be followed to {machine}: {why}; narrow the uncertain ranges, \
         or start from values and a first guess that lead to a gait everywhere in them"
    )
}

/// The note where extrema are taken at several places of the map at once, given as fractions of its duration.
pub(super) fn places(name: &str, phases: &[f64]) -> String {
    let name = if name == "the objective" { name.to_owned() } else { format!("`{name}`") };
    let all: Vec<String> = phases.iter().map(|phase| format!("{:.1} %", 100.0 * phase)).collect();
    let (last, others) = all.split_last().map_or(("", &[][..]), |(last, others)| (last.as_str(), others));
    format!(
        "an extremum in {name} is taken at several places at once here, after {} and {last} of the duration: it has a kink, and \
         each of these places limits the optimum",
        others.join(", ")
    )
}

/// The note where hardly anything of a disturbance is left after one map.
pub(super) fn deadbeat(radius: f64) -> String {
    format!(
        "one map takes a disturbance away (deadbeat): the search stops there, and the spectral radius of {radius:.0e} is what \
         stopping and rounding leave, not a measured value"
    )
}

/// A warning of the return map at the optimum.
pub(super) fn warning(problem: &Problem<'_>, warning: &Warning) -> String {
    let transitions = problem.map.info().transitions;
    let name = |index: usize| transitions.get(index).map_or("?", |transition| transition.name);
    match *warning {
        Warning::Grazing { transition, time, .. } => format!(
            "the guard of `{}` is only touched at {time:.6} s: derivatives and stability are not valid there",
            name(transition)
        ),
        Warning::Tie { taken, other, time } => format!(
            "`{}` and `{}` fire together at {time:.6} s; the first was taken, and derivatives hold for that order only",
            name(taken),
            name(other)
        ),
    }
}

impl fmt::Display for NoGait {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stopped(stop) => write!(f, "{}", stop_text(stop)),
            Self::NotConverged(residual) => {
                write!(f, "Newton's method ends where a map still moves the start by {residual:.1e}")
            }
            Self::Open(text) => write!(f, "{text}"),
            Self::Interrupted => write!(f, "interrupted"),
            Self::Wrong(error) => write!(f, "{error}"),
        }
    }
}

/// Why a run stopped.
pub(super) fn stop_text(stop: &Stop) -> String {
    let why = match stop.reason {
        StopReason::NoEvent => "no step ends within the time limit",
        StopReason::StepLimit => "the integration needs more steps than allowed",
        StopReason::StepTooSmall => "the integration needs steps below rounding",
        StopReason::NotFinite => "the run leaves the domain where the model is defined",
        StopReason::Inconsistent => "the state contradicts the equations where the mass matrix is singular",
        StopReason::Zeno => "transitions pile up in time",
        StopReason::Interrupted => "it was interrupted",
    };
    format!("{why} (after {:.6} s)", stop.time)
}
