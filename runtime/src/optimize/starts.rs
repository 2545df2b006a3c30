//! Starting points: the given one, then a Halton sequence with a random shift that fills the ranges evenly.
//!
//! Each start brings its own gait, followed from the first one; everything here is a pure function of problem and
//! number of the start.

use super::gait::{self, NoGait};
use super::problem::Problem;

/// How many other parameter sets are tried when there is no gait at the given ones.
const RESCUES: usize = 32;

/// A gait to start from.
#[derive(Clone, Debug)]
pub(super) struct Start {
    /// All parameters.
    pub(super) parameters: Vec<f64>,
    /// Its section coordinates.
    pub(super) section: Vec<f64>,
}

/// The given parameters with the varied ones inside their ranges, and the numbers of those that had to be moved.
pub(super) fn projected(problem: &Problem<'_>) -> (Vec<f64>, Vec<usize>) {
    let mut parameters = problem.parameters.clone();
    let mut moved = Vec::new();
    for vary in &problem.vary {
        let value = parameters[vary.parameter];
        let inside = value.clamp(vary.lower, vary.upper);
        if inside != value {
            moved.push(vary.parameter);
        }
        parameters[vary.parameter] = inside;
    }
    (parameters, moved)
}

/// The first gait: at the projected parameters; else followed from the given ones; else at any point of the ranges.
///
/// # Errors
/// The failure at the projected parameters.
pub(super) fn first(problem: &Problem<'_>, parameters: &[f64]) -> Result<Start, NoGait> {
    let failure = match gait::near(problem, parameters, &problem.start) {
        Ok(section) => return Ok(Start { parameters: parameters.to_vec(), section }),
        Err(NoGait::Wrong(error)) => return Err(NoGait::Wrong(error)),
        Err(failure) => failure,
    };
    if parameters != problem.parameters
        && let Ok(section) = gait::near(problem, &problem.parameters, &problem.start)
        && let Ok(section) = gait::follow(problem, (&problem.parameters, &section), parameters)
    {
        return Ok(Start { parameters: parameters.to_vec(), section });
    }
    let found = (1..=RESCUES).find_map(|number| {
        let parameters = spread(problem, parameters, number);
        let section = gait::near(problem, &parameters, &problem.start).ok()?;
        Some(Start { parameters, section })
    });
    found.ok_or(failure)
}

/// Start number `number` (from 1), followed from the first.
///
/// # Errors
/// When no gait can be followed there.
pub(super) fn further(problem: &Problem<'_>, first: &Start, number: usize) -> Result<Start, NoGait> {
    let parameters = spread(problem, &first.parameters, number);
    let section = gait::follow(problem, (&first.parameters, &first.section), &parameters)?;
    Ok(Start { parameters, section })
}

/// Parameters number `number` (from 1) of the sequence in the ranges.
fn spread(problem: &Problem<'_>, base: &[f64], number: usize) -> Vec<f64> {
    let mut parameters = base.to_vec();
    let mut shift = problem.settings.seed;
    for (axis, vary) in problem.vary.iter().enumerate() {
        let offset = unit_interval(&mut shift);
        let fraction = (radical_inverse(number, prime(axis)) + offset).fract();
        let value = vary.lower + fraction * (vary.upper - vary.lower);
        parameters[vary.parameter] = value.clamp(vary.lower, vary.upper);
    }
    parameters
}

/// Van der Corput's radical inverse of `number` to a base.
fn radical_inverse(mut number: usize, base: usize) -> f64 {
    let (mut value, mut place) = (0.0, 1.0 / base as f64);
    while number > 0 {
        value += (number % base) as f64 * place;
        number /= base;
        place /= base as f64;
    }
    value
}

/// Prime number `index` (from 0): 2, 3, 5, ...
fn prime(index: usize) -> usize {
    let is_prime = |n: &usize| (2..*n).take_while(|k| k * k <= *n).all(|k| !n.is_multiple_of(k));
    (2..).filter(is_prime).nth(index).unwrap_or(2)
}

/// Next number in [0, 1) of the SplitMix64 generator (Steele, Lea and Flood 2014).
fn unit_interval(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut x = *state;
    x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_primes_and_radical_inverses() {
        assert_eq!((0..6).map(prime).collect::<Vec<_>>(), [2, 3, 5, 7, 11, 13]);
        assert_eq!((1..5).map(|n| radical_inverse(n, 2)).collect::<Vec<_>>(), [0.5, 0.25, 0.75, 0.125]);
    }

    #[test]
    fn shifts_are_in_the_unit_interval_and_depend_on_the_seed() {
        let (mut a, mut b) = (1, 2);
        let (x, y) = (unit_interval(&mut a), unit_interval(&mut b));
        assert!((0.0..1.0).contains(&x) && (0.0..1.0).contains(&y) && x != y);
    }
}
