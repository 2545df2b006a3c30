//! Whether an objective changes at all: where nothing limits an optimum, it may be one only because every gait is.

use super::gait::Start;
use super::problem::{Objective, Problem};
use super::solution::Solution;
use super::standing::standing;
use super::starts;

/// At how many other gaits the objective is looked at.
const PLACES: usize = 4;

/// Whether the objective has the same value at the first gait, at the optimum and at gaits elsewhere in the ranges, as far
/// as the maps are accurate.
pub(super) fn unchanging(problem: &Problem<'_>, first: &Start, best: &Solution) -> bool {
    if !matches!(problem.objective, Objective::Expression(_)) || problem.vary.iter().all(|v| v.lower == v.upper) {
        return false;
    }
    let same = |start: &Start| {
        standing(problem, start).ok().map(|standing| {
            let size = standing.objective.abs().max(best.objective.abs());
            (standing.objective - best.objective).abs() <= 1e2 * problem.settings.accuracy.relative * size
        })
    };
    if same(first) != Some(true) {
        return false;
    }
    let elsewhere = (1..=PLACES).filter_map(|number| same(&starts::further(problem, first, number).ok()?));
    let found: Vec<bool> = elsewhere.collect();
    !found.is_empty() && found.iter().all(|same| *same)
}
