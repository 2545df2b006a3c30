//! The verdict on a robust search: every scenario is a gait of its own, simulated afresh, and the worst is what is reported.

use super::super::confirm::{self, Claim};
use super::super::critical_cone::significant;
use super::super::envelope;
use super::super::gait::{self, NoGait, Start};
use super::super::kkt::kkt;
use super::super::message;
use super::super::problem::{ConstraintKind, Objective, ProblemError, Sense};
use super::super::program::Row;
use super::super::search::End;
use super::super::second_order::second_order;
use super::super::solution::{Confirmation, Shape, Solution, Starts, Status};
use super::super::standing::{Standing, standing};
use super::super::verdict;
use super::check::worst_scenario;
use super::{Found, Robust, Scenario, scenarios};
use crate::orbit;

/// A violation that counts as none, in units of a constraint's scale: Jury rows and eigenvalues differ by rounding.
const HOLDS: f64 = 1e-7;
/// Where multipliers meet, rounding moves them by its square root.
const HOLDS_AT_A_KINK: f64 = 1e-4;

/// A scenario's gait and its values.
struct Stands {
    gait: Start,
    standing: Standing,
}

/// Each scenario on its own: its gait polished by Newton's method, its values from a map of its own.
fn stands(robust: &Robust<'_>, found: &Found<'_>) -> Result<Vec<Stands>, NoGait> {
    let point = &found.ended.point;
    let one = |(s, scene): (usize, &super::Scene)| {
        let parameters = scene.parameters(&point.parameters).into_owned();
        let section = gait::near(robust.problem, &parameters, &point.section[found.program.block(s)])?;
        let gait = Start { parameters, section };
        let standing = standing(robust.problem, &gait)?;
        Ok(Stands { gait, standing })
    };
    found.program.scenes.iter().enumerate().map(one).collect()
}

/// Number of the scenario with the worst objective.
fn worst(robust: &Robust<'_>, all: &[Stands]) -> usize {
    let badness = |i: usize| match robust.problem.sense {
        Sense::Maximize => -all[i].standing.objective,
        Sense::Minimize => all[i].standing.objective,
    };
    (0..all.len()).max_by(|a, b| badness(*a).total_cmp(&badness(*b)).then(b.cmp(a))).unwrap_or(0)
}

/// The solution of a search, but for the confirmation.
///
/// # Errors
/// For a problem that turns out to be wrong as stated.
pub(super) fn judged(robust: &Robust<'_>, found: &mut Found<'_>) -> Result<Solution, ProblemError> {
    let (program, ended) = (&found.program, &found.ended);
    let status = match &ended.end {
        End::Converged | End::Acceptable => Status::Optimal,
        End::Infeasible => Status::InfeasibleLocally,
        End::Interrupted => Status::Interrupted,
        End::Unbounded => Status::Unbounded,
        End::IterationLimit => Status::IterationLimit,
        End::Exhausted => Status::WorkLimit,
        End::Stalled | End::Reached => Status::Stalled,
        End::Subproblem(_) => Status::SubproblemFailed,
    };
    let section = ended.point.section[program.block(0)].to_vec();
    let mut solution = verdict::without_values(status, String::new(), ended.point.parameters.clone(), section).solution;
    solution.objective = worst_scenario(found);
    solution.iterations = ended.iterations;
    solution.kkt_residual = kkt(program, &ended.point, &ended.lin, &ended.multipliers).residual();
    solution.starts = Starts { run: 1, converged: usize::from(status == Status::Optimal) };
    let detail = match &ended.end {
        End::Subproblem(words) => words.clone(),
        _ => message::violations(program, &ended.point),
    };
    let all = match stands(robust, found) {
        Ok(all) => all,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(failure) => {
            let status = if status == Status::Optimal { Status::Unconfirmed } else { status };
            let solution = Solution { status, ..solution };
            let message = message::message(robust.problem, &solution, &failure.to_string());
            return Ok(Solution { message, ..solution });
        }
    };
    let of = &all[worst(robust, &all)];
    solution.parameters.clone_from(&of.gait.parameters);
    solution.section.clone_from(&of.gait.section);
    solution.spectral_radius = of.standing.spectral_radius;
    solution.measures.clone_from(&of.standing.measures);
    if matches!(robust.problem.objective, Objective::SpectralRadius) {
        solution.objective = of.standing.spectral_radius;
    }
    if let Ok(map) =
        gait::map(robust.problem, &of.gait.parameters, &of.gait.section, robust.problem.settings.accuracy, false)
    {
        solution.multipliers = orbit::multipliers(&map.jacobian.columns(0, of.gait.section.len()).into_owned());
        solution.kink = verdict::kink(&solution.multipliers);
        solution.notes.extend(map.warnings.iter().map(|warning| message::warning(robust.problem, warning)));
    }
    if status == Status::Optimal {
        solution.active = verdict::active(program, ended);
        let curvature = second_order(program, ended).curvature;
        if curvature.shape == Shape::Saddle {
            solution.status = Status::Saddle;
        }
        solution.curvature = Some(curvature);
        let certain = |p: usize| robust.uncertain.iter().all(|u| u.parameter != p);
        solution.sensitivities = envelope::sensitivities(program, ended);
        solution.sensitivities.retain(|sensitivity| certain(sensitivity.parameter));
        if let Some(reason) = violated(robust, &all, solution.kink.is_some()) {
            solution.status = Status::Unconfirmed;
            solution.message = message::message(robust.problem, &solution, &reason);
            return Ok(solution);
        }
    }
    solution.notes.extend(program.kinks(ended));
    solution.notes.extend(verdict::deadbeat(program, &ended.point, &solution));
    solution.message = match &ended.refused {
        Some(stop) if solution.status == Status::Stalled => message::refused(&solution, stop, &detail),
        _ => message::message(robust.problem, &solution, &detail),
    };
    Ok(solution)
}

/// A constraint that does not hold in a scenario, from that scenario's own map; in words.
fn violated(robust: &Robust<'_>, all: &[Stands], kink: bool) -> Option<String> {
    for one in all {
        for (i, constraint) in robust.problem.constraints.iter().enumerate() {
            let stability = matches!(constraint.kind, ConstraintKind::SpectralRadius { .. });
            let slack = if stability && kink { HOLDS_AT_A_KINK } else { HOLDS };
            if !one.standing.holds(i, slack) {
                let values: Vec<f64> = robust.uncertain.iter().map(|u| one.gait.parameters[u.parameter]).collect();
                let at = scenarios::words(robust.problem, robust.uncertain, &values);
                return Some(format!("`{}` does not hold at {at}", constraint.name));
            }
        }
    }
    None
}

/// The solution after a fresh simulation of every scenario and, where they are asked for, the long tests of each. The numbers kept
/// are those of the reported scenario.
///
/// # Errors
/// For a problem that turns out to be wrong as stated.
pub(super) fn confirmed(
    robust: &Robust<'_>,
    found: &Found<'_>,
    mut solution: Solution,
) -> Result<Solution, ProblemError> {
    let all = match stands(robust, found) {
        Ok(all) => all,
        Err(NoGait::Wrong(error)) => return Err(error),
        Err(failure) => return Ok(disagrees(robust, solution, &failure.to_string())),
    };
    let reported = worst(robust, &all);
    for (s, one) in all.iter().enumerate() {
        let nominal = &found.program.variables.nominal[found.program.block(s)];
        match confirm_one(robust, one, nominal) {
            Ok(confirmation) if s == reported => solution.confirmation = Some(confirmation),
            Ok(_) => {}
            Err(reason) => {
                let values: Vec<f64> = robust.uncertain.iter().map(|u| one.gait.parameters[u.parameter]).collect();
                let at = scenarios::words(robust.problem, robust.uncertain, &values);
                return Ok(disagrees(robust, solution, &format!("at {at}: {reason}")));
            }
        }
    }
    Ok(solution)
}

fn disagrees(robust: &Robust<'_>, mut solution: Solution, reason: &str) -> Solution {
    if robust.problem.settings.interrupt.requested() {
        solution.status = Status::Interrupted;
        solution.message = message::message(robust.problem, &solution, "");
        return solution;
    }
    solution.status = Status::Unconfirmed;
    solution.message = message::message(robust.problem, &solution, reason);
    solution
}

fn confirm_one(robust: &Robust<'_>, one: &Stands, nominal: &[f64]) -> Result<Confirmation, String> {
    let Start { parameters, section } = &one.gait;
    let map = gait::map(robust.problem, parameters, section, robust.problem.settings.accuracy, true)
        .map_err(|failure| failure.to_string())?;
    let spectral_radius = one.standing.spectral_radius;
    let claim = Claim { parameters, section, map: &map, spectral_radius, nominal };
    let confirmation = confirm::confirm(robust.problem, &claim)?;
    let (parameters, section) = (parameters.clone(), section.clone());
    let mut alone = verdict::without_values(Status::Optimal, String::new(), parameters, section).solution;
    (alone.spectral_radius, alone.confirmation) = (spectral_radius, Some(confirmation.clone()));
    if robust.long_tests {
        confirm::at_length(robust.problem, &mut alone, nominal)?;
    }
    Ok(alone.confirmation.unwrap_or(confirmation))
}

/// All scenarios with what limits the optimum in each; empty where a gait is missing.
pub(super) fn scenarios(robust: &Robust<'_>, found: &Found<'_>) -> Vec<Scenario> {
    let Ok(all) = stands(robust, found) else { return Vec::new() };
    let (program, ended) = (&found.program, &found.ended);
    let converged = super::converged(found);
    let least = significant(program, ended);
    let one = |(s, (scene, stands)): (usize, (&super::Scene, Stands))| {
        let (mut limits, mut worst) = (Vec::new(), false);
        let rows = program.rows.iter().zip(&program.row_scenes).zip(ended.multipliers.inequality.iter());
        for ((row, _), _) in rows.filter(|((_, of), lambda)| converged && **of == s && **lambda > least) {
            match *row {
                Row::Worst(_) | Row::Jury(None, _) => worst = true,
                Row::Margin(i, _) | Row::Jury(Some(i), _) if !limits.contains(&i) => limits.push(i),
                Row::Margin(..) | Row::Jury(..) => {}
            }
        }
        Scenario {
            values: robust.values(scene),
            section: stands.gait.section,
            objective: stands.standing.objective,
            spectral_radius: stands.standing.spectral_radius,
            worst: worst || program.scenes.len() == 1,
            limits,
        }
    };
    program.scenes.iter().zip(all).enumerate().map(one).collect()
}
