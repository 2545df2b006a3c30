//! The scenarios of a box of uncertain parameters, and what a box has to be.

use super::super::message::quantity;
use super::super::problem::{Bound, ConstraintKind, Problem, ProblemError};
use super::super::scene::Scene;
use super::Uncertain;

/// Up to so many uncertain parameters all corners of the box are scenarios.
const ALL_CORNERS: usize = 4;

/// Checks the box.
pub(super) fn validate(problem: &Problem<'_>, uncertain: &[Uncertain]) -> Result<(), ProblemError> {
    let known = problem.map.info().parameters;
    if uncertain.is_empty() {
        return Err(ProblemError::NothingUncertain);
    }
    for (i, u) in uncertain.iter().enumerate() {
        let Some(quantity) = known.get(u.parameter) else {
            return Err(ProblemError::UnknownParameter { index: u.parameter, count: known.len() });
        };
        let name = quantity.name;
        if !(u.lower.is_finite() && u.upper.is_finite() && (u.upper - u.lower).is_finite()) {
            return Err(ProblemError::NotFinite(format!("the range of `{name}`")));
        }
        if u.lower > u.upper {
            return Err(ProblemError::EmptyRange { name, lower: u.lower, upper: u.upper });
        }
        if problem.vary.iter().any(|vary| vary.parameter == u.parameter) {
            return Err(ProblemError::VariedAndUncertain(name));
        }
        if uncertain[..i].iter().any(|before| before.parameter == u.parameter) {
            return Err(ProblemError::UncertainTwice(name));
        }
    }
    let formula =
        |kind: &ConstraintKind| matches!(kind, ConstraintKind::SpectralRadius { bound: Bound::Expression(_) });
    match problem.constraints.iter().find(|constraint| formula(&constraint.kind)) {
        Some(constraint) => Err(ProblemError::RobustBound(constraint.name.clone())),
        None => Ok(()),
    }
}

/// The nominal values where they lie in the box, then its corners; with more than four uncertain parameters the ends of each
/// with all others in the middle of their ranges, and the two corners where all are at their lower or upper ends.
pub(super) fn corners(problem: &Problem<'_>, uncertain: &[Uncertain]) -> Vec<Scene> {
    let nominal: Vec<f64> = uncertain.iter().map(|u| problem.parameters[u.parameter]).collect();
    let inside = uncertain.iter().zip(&nominal).all(|(u, value)| (u.lower..=u.upper).contains(value));
    let n = uncertain.len();
    let lower: Vec<f64> = uncertain.iter().map(|u| u.lower).collect();
    let upper: Vec<f64> = uncertain.iter().map(|u| u.upper).collect();
    let mut all: Vec<Vec<f64>> = if inside { vec![nominal] } else { Vec::new() };
    if n <= ALL_CORNERS {
        let corner = |which: usize| (0..n).map(|i| if which >> i & 1 == 0 { lower[i] } else { upper[i] }).collect();
        all.extend((0..1_usize << n).map(corner));
    } else {
        let middle: Vec<f64> = lower.iter().zip(&upper).map(|(a, b)| a + 0.5 * (b - a)).collect();
        for i in 0..n {
            for end in [lower[i], upper[i]] {
                let mut values = middle.clone();
                values[i] = end;
                all.push(values);
            }
        }
        all.extend([lower, upper]);
    }
    let mut distinct: Vec<Vec<f64>> = Vec::new();
    for values in all {
        if !distinct.contains(&values) {
            distinct.push(values);
        }
    }
    let scene = |values: Vec<f64>| Scene {
        changed: uncertain.iter().zip(values).map(|(u, value)| (u.parameter, value)).collect(),
    };
    distinct.into_iter().map(scene).collect()
}

/// `m` = 2.8, `k` = 50 (SI units).
pub(super) fn words(problem: &Problem<'_>, uncertain: &[Uncertain], values: &[f64]) -> String {
    let known = problem.map.info().parameters;
    let one = |(u, value): (&Uncertain, &f64)| {
        let name = known.get(u.parameter).map_or("?", |quantity| quantity.name);
        format!("`{name}` = {}", quantity(problem, u.parameter, *value))
    };
    uncertain.iter().zip(values).map(one).collect::<Vec<_>>().join(", ")
}
