//! A look inside the box: gaits at points that fill it evenly, against the worst of all scenarios.

use super::super::gait::{self, NoGait, Start};
use super::super::problem::{ProblemError, Sense};
use super::super::sobol;
use super::super::standing::{Standing, standing};
use super::{Exception, Found, Robust};
use rayon::prelude::*;

/// So many points are looked at.
const POINTS: usize = 64;
/// What an objective may be worse by, relative to the worst scenario, and a constraint violated by, in units of its scale.
const SLACK: f64 = 1e-6;

/// What was found inside.
#[derive(Debug, Default)]
pub(super) struct Checked {
    /// Points looked at.
    pub(super) points: usize,
    /// The worst point in the objective and in each constraint, where these are worse than in all scenarios.
    pub(super) worse: Vec<Worse>,
    /// Points to which no gait could be followed.
    pub(super) lost: Vec<Exception>,
}

/// A point that is worse than all scenarios.
#[derive(Debug)]
pub(super) struct Worse {
    pub(super) values: Vec<f64>,
    pub(super) section: Vec<f64>,
    pub(super) what: String,
}

struct Seen {
    values: Vec<f64>,
    gait: Result<(Start, Standing), NoGait>,
}

/// Looks inside the box at the design of a search.
///
/// # Errors
/// For a problem that turns out to be wrong as stated.
pub(super) fn check(robust: &Robust<'_>, found: &Found<'_>) -> Result<Checked, ProblemError> {
    let seen: Vec<Seen> = (0..POINTS).into_par_iter().map(|number| look(robust, found, number)).collect();
    let mut checked = Checked { points: POINTS, ..Checked::default() };
    let mut all = Vec::new();
    for Seen { values, gait } in seen {
        match gait {
            Ok((gait, standing)) => all.push((values, gait, standing)),
            Err(NoGait::Wrong(error)) => return Err(error),
            Err(failure) => {
                checked.lost.push(Exception { values, what: format!("no gait can be followed there: {failure}") });
            }
        }
    }
    let worst = worst_scenario(found);
    let sign = if robust.problem.sense == Sense::Maximize { -1.0 } else { 1.0 };
    // How bad a point is in the objective, and then in each constraint; what is not a number is as bad as can be.
    let deficit = |standing: &Standing| sign * (standing.objective - worst) / worst.abs().max(f64::MIN_POSITIVE);
    let bad = |standing: &Standing, of: usize| {
        let bad = of.checked_sub(1).map_or_else(|| deficit(standing), |i| -standing.scaled[i]);
        if bad.is_nan() { f64::INFINITY } else { bad }
    };
    for of in 0..=robust.problem.constraints.len() {
        let Some((values, gait, standing)) = all.iter().max_by(|a, b| bad(&a.2, of).total_cmp(&bad(&b.2, of))) else {
            break;
        };
        let by = bad(standing, of);
        if by > SLACK && !checked.worse.iter().any(|known| known.values == *values) {
            let what = match of.checked_sub(1) {
                None => "the objective is worse".to_owned(),
                Some(i) => format!("`{}` does not hold", robust.problem.constraints[i].name),
            };
            let (values, section) = (values.clone(), gait.section.clone());
            checked.worse.push(Worse { values, section, what: format!("{what} (by {by:.1e})") });
        }
    }
    Ok(checked)
}

/// The objective that a search ended with, SI units.
pub(super) fn worst_scenario(found: &Found<'_>) -> f64 {
    let program = &found.program;
    program.sign() * program.objective_scale * found.ended.point.f
}

/// One point of a scrambled Sobol sequence; the gait there is followed from that of the first scenario.
fn look(robust: &Robust<'_>, found: &Found<'_>, number: usize) -> Seen {
    let value = |(axis, u): (usize, &super::Uncertain)| {
        let fraction = sobol::coordinate(number, axis, robust.problem.settings.seed);
        (u.lower + fraction * (u.upper - u.lower)).clamp(u.lower, u.upper)
    };
    let values: Vec<f64> = robust.uncertain.iter().enumerate().map(value).collect();
    let point = &found.ended.point;
    let first = Start {
        parameters: found.program.scenes[0].parameters(&point.parameters).into_owned(),
        section: point.section[found.program.block(0)].to_vec(),
    };
    let to = robust.scene(&values).parameters(&point.parameters).into_owned();
    let gait = gait::follow(robust.problem, &first, &to).and_then(|gait| {
        let standing = standing(robust.problem, &gait)?;
        Ok((gait, standing))
    });
    Seen { values, gait }
}
