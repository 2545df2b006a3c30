//! The distinct local optima among the ends of all starts.

use super::problem::Problem;
use super::solution::{Solution, Status};
use super::verdict::Verdict;

/// Two ends are the same optimum when no parameter differs by more than this part of its range and no section coordinate
/// by more than this part of itself ...
const SAME_PLACE: f64 = 1e-3;
/// ... and the objective by no more than this part of itself, ...
const SAME_VALUE: f64 = 1e-5;
/// ... or when the place is the same to this: an objective near zero has no digits to compare.
const VERY_SAME_PLACE: f64 = 1e-5;

/// A confirmed local optimum and how often it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimum {
    /// Objective, SI units.
    pub objective: f64,
    /// All parameters, SI units.
    pub parameters: Vec<f64>,
    /// Section coordinates of its gait, SI units.
    pub section: Vec<f64>,
    /// Its spectral radius.
    pub spectral_radius: f64,
    /// How many starts ended there.
    pub starts: usize,
}

/// The distinct optima, in the order of `verdicts` (best first): each verdict belongs to the first that it equals.
pub(super) fn distinct<'v>(problem: &Problem<'_>, verdicts: impl Iterator<Item = &'v Verdict>) -> Vec<Optimum> {
    let mut optima: Vec<Optimum> = Vec::new();
    for Verdict { solution, .. } in verdicts.filter(|verdict| verdict.solution.status == Status::Optimal) {
        match optima.iter_mut().find(|known| same(problem, known, solution)) {
            Some(known) => known.starts += 1,
            None => optima.push(Optimum {
                objective: solution.objective,
                parameters: solution.parameters.clone(),
                section: solution.section.clone(),
                spectral_radius: solution.spectral_radius,
                starts: 1,
            }),
        }
    }
    optima
}

fn same(problem: &Problem<'_>, known: &Optimum, found: &Solution) -> bool {
    let parameters = problem.vary.iter().map(|vary| {
        let range = vary.upper - vary.lower;
        let apart = (known.parameters[vary.parameter] - found.parameters[vary.parameter]).abs();
        if range > 0.0 { apart / range } else { 0.0 }
    });
    // Rounding about a coordinate that vanishes by symmetry makes no other gait.
    let size = known.section.iter().fold(0.0, |size: f64, z| size.max(z.abs()));
    let section = known.section.iter().zip(&found.section).map(|(a, b)| {
        let apart = (a - b).abs();
        if apart <= 1e-6 * size { 0.0 } else { apart / a.abs().max(b.abs()) }
    });
    let apart = parameters.chain(section).fold(0.0, f64::max);
    let value = known.objective.abs().max(found.objective.abs());
    let same_value = (known.objective - found.objective).abs() <= SAME_VALUE * value;
    apart <= VERY_SAME_PLACE || (apart <= SAME_PLACE && same_value)
}
