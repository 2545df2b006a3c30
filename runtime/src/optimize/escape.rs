//! From a saddle to an optimum: the search goes on from points on both sides along the direction in which the Lagrangian
//! curves the wrong way.

use super::gait::{self, NoGait};
use super::kkt::infeasibility;
use super::problem::ProblemError;
use super::program::{Failure, Program};
use super::search::{End, Ended, search};
use super::second_order::{SecondOrder, second_order};
use super::solution::Shape;
use super::verdict::starting_point;
use nalgebra::DVector;

/// Lengths of the step off the saddle, in scaled unknowns.
const STEPS: [f64; 2] = [0.1, 0.02];
/// Saddles in a row.
const MOST_SADDLES: usize = 4;
/// By how much the scaled objective has to improve.
const BETTER: f64 = 1e-9;

/// Judges the end of a search by second derivatives and leaves saddles as long as that improves the objective; `None` where
/// the search did not converge.
///
/// # Errors
/// For a problem that turns out to be wrong as stated.
pub(super) fn settle(program: &Program<'_>, ended: &mut Ended) -> Result<Option<SecondOrder>, ProblemError> {
    if !converged(ended) {
        return Ok(None);
    }
    let mut found = second_order(program, ended);
    for _ in 0..MOST_SADDLES {
        let (Shape::Saddle, Some(direction)) = (found.curvature.shape, &found.descent) else {
            break;
        };
        let found_better = off(program, ended, direction)?;
        // The searches had rows of their own.
        program.adopt(Some(found_better.as_ref().map_or(&ended.point, |better| &better.point)));
        let Some(better) = found_better else {
            break;
        };
        let iterations = ended.iterations + better.iterations;
        *ended = Ended { iterations, ..better };
        if !converged(ended) {
            return Ok(None);
        }
        found = second_order(program, ended);
    }
    Ok(Some(found))
}

fn converged(ended: &Ended) -> bool {
    matches!(ended.end, End::Converged | End::Acceptable)
}

/// The best end of the searches from both sides, if any is better than the saddle.
fn off(program: &Program<'_>, saddle: &Ended, direction: &DVector<f64>) -> Result<Option<Ended>, ProblemError> {
    let mut best: Option<Ended> = None;
    for step in STEPS {
        for side in [step, -step] {
            let ended = match from(program, saddle, &(direction * side)) {
                Ok(ended) => ended,
                Err(Failure::Wrong(error)) => return Err(error),
                Err(_) => continue,
            };
            let known = best.as_ref().map_or(saddle.point.f - BETTER, |best| best.point.f);
            let tolerance = 10.0 * program.problem.settings.attainable_feasibility();
            let ends = converged(&ended) || ended.end == End::Unbounded;
            if ends && ended.point.f < known && infeasibility(&ended.point) <= tolerance {
                best = Some(ended);
            }
        }
        if best.is_some() {
            break;
        }
    }
    Ok(best)
}

/// The search from the gait next to a point off the saddle.
fn from(program: &Program<'_>, saddle: &Ended, step: &DVector<f64>) -> Result<Ended, Failure> {
    let u = &saddle.point.u + step;
    let parameters = program.variables.parameters(u.as_slice(), &program.base);
    let section = match gait::near(program.problem, &parameters, &program.variables.section(u.as_slice())) {
        Ok(section) => section,
        Err(NoGait::Wrong(error)) => return Err(Failure::Wrong(error)),
        Err(_) => return Err(Failure::NoDerivative),
    };
    search(program, starting_point(program, &parameters, &section)?)
}
