//! A gait under random disturbances: a thousand maps in sequence, each coordinate disturbed before each of them.
//!
//! A stable gait has to stay, each map has to go where the linearisation says, and the deviations have to spread as the
//! discrete Lyapunov equation predicts (module `lyapunov`), within what a sample of that length can show. A gait that is not
//! stable has to be left as its linearisation predicts.

use super::lyapunov::{along, root, score, stationary};
use super::noise::Noise;
use super::problem::Problem;
use super::solution::Disturbed;
use super::stepper::Stepper;
use crate::return_map::Accuracy;
use nalgebra::{DMatrix, DVector};

/// Gaits in sequence, ...
const MAPS: usize = 1000;
/// ... fewer where they are made of many maps: no more maps than this, ...
const MOST_STEPS: usize = 20_000;
/// ... but so many in any case.
const FEWEST: usize = 100;
/// Largest predicted standard deviation of a coordinate relative to its size: small enough for the linearisation.
const SMALL: f64 = 1e-5;
/// Where the linear prediction fails, the disturbance is made so much smaller, as often as this: what is due to the map's
/// curvature then falls with it, a wrong Jacobian stays as wrong.
const SMALLER: f64 = 1.0 / 30.0;
const REDUCTIONS: i32 = 2;
/// Standard deviations of the sampling error that are allowed: one sound gait in two million is refused.
const ALLOWED: f64 = 5.0;
/// What a map may differ from the linear prediction by, relative to the deviations' predicted size ...
const NONLINEAR: f64 = 1e-2;
/// ... and how far out, in predicted standard deviations, a deviation of a gait that stays may be.
const FAR: f64 = 10.0;
/// A direction in which deviations are smaller than this part of the disturbance is not measured: there they show the errors
/// of the maps and the second order.
const THIN: f64 = 1e-2;
/// Deviations from an unstable gait begin at this, and are followed up to `SMALL` times ten.
const FIRST: f64 = 1e-8;
/// By how much an unstable gait's deviation may differ from the prediction.
const GROWN: f64 = 0.1;

/// Tolerance of the maps relative to the disturbance, and its limits.
const TOLERANCE: f64 = 1e-4;
const TIGHTEST: f64 = 1e-13;
const LOOSEST: f64 = 1e-9;

/// The gait in scaled coordinates.
pub(super) struct Linear<'c> {
    pub(super) parameters: &'c [f64],
    pub(super) section: &'c [f64],
    /// Size of each coordinate.
    pub(super) sizes: &'c DVector<f64>,
    /// Jacobian in units of these.
    pub(super) jacobian: &'c DMatrix<f64>,
    pub(super) spectral_radius: f64,
}

impl Linear<'_> {
    fn dimension(&self) -> usize {
        self.sizes.len()
    }

    /// Maps that are exact enough for deviations of this size.
    fn stepper<'s>(&'s self, problem: &'s Problem<'s>, level: f64) -> Result<Stepper<'s>, String> {
        let relative = (TOLERANCE * level).clamp(TIGHTEST, LOOSEST);
        let accuracy = Accuracy { relative, absolute: 0.1 * relative, ..problem.settings.accuracy };
        Stepper::new(problem, (self.parameters, self.section), accuracy)
    }
}

/// Follows the disturbed gait.
///
/// # Errors
/// What disagrees, in words.
pub(super) fn disturbed(problem: &Problem<'_>, linear: &Linear<'_>) -> Result<Disturbed, String> {
    let d = linear.dimension();
    let unit = DMatrix::identity(d, d);
    match stationary(linear.jacobian, &unit) {
        Some(covariance) if linear.spectral_radius < 1.0 => {
            // The disturbance that makes the deviations no larger than wanted.
            let largest = SMALL / covariance.diagonal().amax().sqrt().max(1.0);
            let at = |reductions: i32| {
                let level = largest * SMALLER.powi(reductions);
                let mut stepper = linear.stepper(problem, level)?;
                stays(linear, &covariance, level, (&mut stepper, problem.settings.seed, maps(problem)))
            };
            (1..=REDUCTIONS).fold(at(0), |found, reductions| found.or_else(|_| at(reductions)))
        }
        _ => grows(linear, &mut linear.stepper(problem, FIRST)?),
    }
}

/// How many gaits in sequence.
fn maps(problem: &Problem<'_>) -> usize {
    (MOST_STEPS / problem.period.max(1)).clamp(FEWEST, MAPS)
}

fn stays(
    linear: &Linear<'_>,
    covariance: &DMatrix<f64>,
    level: f64,
    (stepper, seed, maps): (&mut Stepper<'_>, u64, usize),
) -> Result<Disturbed, String> {
    let d = linear.dimension();
    let covariance = covariance * (level * level);
    let size = covariance.diagonal().amax().sqrt().max(level);
    let mut noise = Noise::new(seed);
    let mut draw = || DVector::from_fn(d, |_, _| noise.normal());
    // Begun as the deviations of a gait that has been disturbed for ever.
    let mut deviation = root(&covariance) * draw();
    let mut sums = DMatrix::<f64>::zeros(d, d);
    let mut nonlinear = 0.0_f64;
    for map in 1..=maps {
        let start = &deviation + draw() * level;
        deviation = stepper.deviation(&start, linear.sizes)?;
        // Written so that what is no number counts as far.
        let near = deviation.iter().all(|e| e.abs() <= FAR * size);
        if !near {
            return Err(format!(
                "under small disturbances before each map the gait, claimed to be stable, is left after {map} maps"
            ));
        }
        nonlinear = nonlinear.max((&deviation - linear.jacobian * start).amax() / size);
        sums += &deviation * deviation.transpose();
    }
    if nonlinear > NONLINEAR {
        return Err(format!(
            "disturbed maps differ from what the Jacobian predicts by {nonlinear:.1e} of the deviations, where {NONLINEAR:.0e} is allowed"
        ));
    }
    let compared = compare(linear.jacobian, &covariance, &(sums / maps as f64), (level, maps))?;
    let memory = if linear.spectral_radius > 0.0 { -1.0 / linear.spectral_radius.ln() } else { 0.0 };
    Ok(Disturbed::Stays { maps, level, nonlinear, spread: compared.spread, sampling: compared.sampling, memory })
}

/// How the spread of the deviations compares with the prediction.
struct Compared {
    /// Largest relative difference of a coordinate's standard deviation, ...
    spread: f64,
    /// ... and what such a difference is by sampling alone.
    sampling: f64,
}

/// Compares variances along the coordinates and along the principal axes, which also shows wrong covariances.
fn compare(
    jacobian: &DMatrix<f64>,
    predicted: &DMatrix<f64>,
    sample: &DMatrix<f64>,
    (level, maps): (f64, usize),
) -> Result<Compared, String> {
    let d = predicted.nrows();
    let eigen = predicted.clone().symmetric_eigen();
    let coordinates = (0..d).map(|i| DVector::from_fn(d, |k, _| if k == i { 1.0 } else { 0.0 }));
    let axes = eigen.eigenvectors.column_iter().map(|axis| axis.into_owned());
    let thin = (THIN * level).powi(2);
    let mut found = Compared { spread: 0.0, sampling: 0.0 };
    for (k, direction) in coordinates.chain(axes).enumerate() {
        let (variance, relative) = along(jacobian, predicted, &direction, maps);
        if variance.is_nan() || variance <= thin {
            continue;
        }
        let ratio = direction.dot(&(sample * &direction)) / variance;
        let off = score(ratio, relative);
        if off.is_nan() || off.abs() > ALLOWED {
            return Err(format!(
                "under random disturbances the deviations' variance is {ratio:.3} times the one that the Jacobian predicts, \
                 {:.1} standard deviations of its sampling error off",
                off.abs()
            ));
        }
        if k < d {
            found.spread = found.spread.max((ratio.sqrt() - 1.0).abs());
            found.sampling = found.sampling.max(0.5 * relative);
        }
    }
    Ok(found)
}

/// Follows a small deviation of a gait that is not stable for as long as it stays small.
fn grows(linear: &Linear<'_>, stepper: &mut Stepper<'_>) -> Result<Disturbed, String> {
    let d = linear.dimension();
    // Towards what grows most: the direction that many maps leave.
    let mut direction = DVector::from_fn(d, |i, _| 1.0 / (1.0 + 0.37 * i as f64));
    for _ in 0..50 {
        direction = (linear.jacobian * &direction).try_normalize(0.0).unwrap_or(direction);
    }
    let mut predicted = direction * FIRST;
    let mut deviation = predicted.clone();
    let (mut maps, mut nonlinear) = (0, 0.0_f64);
    while maps < MAPS && (linear.jacobian * &predicted).norm() <= 10.0 * SMALL {
        deviation = stepper.deviation(&deviation, linear.sizes)?;
        predicted = linear.jacobian * predicted;
        maps += 1;
        nonlinear = nonlinear.max((&deviation - &predicted).norm() / predicted.norm());
    }
    let (grown, expected) = (deviation.norm() / FIRST, predicted.norm() / FIRST);
    if maps > 0 && (nonlinear.is_nan() || nonlinear > GROWN) {
        return Err(format!(
            "a small deviation from this gait, which is not stable, differs from what the Jacobian predicts by {:.1} %",
            100.0 * nonlinear
        ));
    }
    Ok(Disturbed::Grows { maps, grown, expected })
}

#[cfg(test)]
#[allow(clippy::expect_used)] // a failing test should say where
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    /// Deviations of the linear map itself, as covariance over a thousand maps in sequence.
    fn sampled(jacobian: &DMatrix<f64>, seed: u64) -> DMatrix<f64> {
        let mut noise = Noise::new(seed);
        let mut e = DVector::zeros(2);
        let mut sum = DMatrix::zeros(2, 2);
        for map in 0..MAPS + 100 {
            e = jacobian * (e + DVector::from_fn(2, |_, _| noise.normal()));
            if map >= 100 {
                sum += &e * e.transpose();
            }
        }
        sum / MAPS as f64
    }

    #[test]
    fn the_right_covariance_passes_and_wrong_ones_do_not() {
        let jacobian = dmatrix![0.6, 0.5; -0.4, 0.7];
        let right = stationary(&jacobian, &DMatrix::identity(2, 2)).expect("stable");
        for seed in 0..20 {
            let sample = sampled(&jacobian, seed);
            let found = compare(&jacobian, &right, &sample, (1.0, MAPS)).expect("as predicted");
            assert!(found.sampling > 0.02 && found.sampling < 0.08 && found.spread < 5.0 * found.sampling);
            assert!(compare(&jacobian, &(&right * 1.6), &sample, (1.0, MAPS)).is_err());
            assert!(compare(&jacobian, &(&right * 0.6), &sample, (1.0, MAPS)).is_err());
            // Right variances of the coordinates, wrong covariance of the two.
            let mut turned = right.clone();
            (turned[(0, 1)], turned[(1, 0)]) = (-0.7 * right[(0, 0)], -0.7 * right[(0, 0)]);
            assert!(compare(&jacobian, &turned, &sample, (1.0, MAPS)).is_err());
        }
    }

    #[test]
    fn what_a_map_leaves_nothing_of_is_not_measured() {
        let jacobian = dmatrix![1e-9, 0.0; 0.0, 1e-9];
        let tiny = stationary(&jacobian, &DMatrix::identity(2, 2)).expect("stable");
        let found =
            compare(&jacobian, &tiny, &dmatrix![1e-12, 0.0; 0.0, 1e-12], (1.0, MAPS)).expect("nothing to compare");
        assert_eq!((found.spread, found.sampling), (0.0, 0.0));
    }
}
