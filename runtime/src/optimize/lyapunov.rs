//! Deviations of a stable gait under random disturbances: their covariance, and how well a run of given length shows it.
//!
//! With a disturbance w_k of covariance Q before each map, deviations follow e_(k+1) = J (e_k + w_k) to first order. Their
//! stationary covariance solves the discrete Lyapunov equation S = J (S + Q) J', and deviations tau maps apart have the
//! covariance J^tau S. The variance of a sample of N of them along a direction a, of normal disturbances and known mean, then
//! has itself the variance
//!
//! ```text
//! (2/N) sum_(|tau| < N) (1 - |tau|/N) (a' J^|tau| S a)^2.
//! ```

use nalgebra::{DMatrix, DVector};

/// Doublings of the series: enough for 2^64 terms.
const DOUBLINGS: usize = 64;

/// The stationary covariance S = J (S + Q) J'; `None` where the gait is not stable.
pub(super) fn stationary(jacobian: &DMatrix<f64>, disturbance: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    // S is the sum of J^k Q J'^k over k >= 1, summed by doubling (R. A. Smith 1968).
    let mut power = jacobian.clone();
    let mut sum = jacobian * disturbance * jacobian.transpose();
    for _ in 0..DOUBLINGS {
        let more = &power * &sum * power.transpose();
        if !more.iter().all(|x| x.is_finite()) {
            return None;
        }
        sum += &more;
        if more.amax() <= f64::EPSILON * sum.amax() {
            return Some((&sum + sum.transpose()) * 0.5);
        }
        power = &power * &power;
    }
    None
}

/// Variance along a direction of length one, and the relative standard deviation of its estimate from `samples` maps in
/// sequence.
pub(super) fn along(
    jacobian: &DMatrix<f64>,
    covariance: &DMatrix<f64>,
    direction: &DVector<f64>,
    samples: usize,
) -> (f64, f64) {
    let mut apart = covariance * direction;
    let variance = direction.dot(&apart);
    let mut sum = variance * variance;
    let n = samples as f64;
    for tau in 1..samples {
        apart = jacobian * apart;
        let shared = direction.dot(&apart);
        sum += 2.0 * (1.0 - tau as f64 / n) * shared * shared;
    }
    (variance, (2.0 * sum / n).sqrt() / variance)
}

/// A square root R of a covariance, S = R R'.
pub(super) fn root(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = covariance.clone().symmetric_eigen();
    let mut root = eigen.eigenvectors;
    for (mut column, value) in root.column_iter_mut().zip(eigen.eigenvalues.iter()) {
        column *= value.max(0.0).sqrt();
    }
    root
}

/// How far a sample variance is from the one predicted, in standard deviations of a normal variable: the cube root of a
/// variance with `relative` standard deviation is nearly normal (Wilson and Hilferty 1931), also for few effective samples.
pub(super) fn score(ratio: f64, relative: f64) -> f64 {
    // A chi-square distribution of this relative spread has 2/relative^2 degrees of freedom.
    let spread = relative * relative / 9.0;
    (ratio.max(0.0).cbrt() - (1.0 - spread)) / spread.sqrt()
}

#[cfg(test)]
#[allow(clippy::expect_used)] // a failing test should say where
mod tests {
    use super::super::noise::Noise;
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn the_covariance_solves_its_equation() {
        let j = dmatrix![0.9, 0.4; -0.1, 0.7];
        let q = dmatrix![1.0, 0.0; 0.0, 4.0];
        let s = stationary(&j, &q).expect("stable");
        assert!((&j * (&s + &q) * j.transpose() - &s).amax() < 1e-12 * s.amax());
        assert!((&root(&s) * root(&s).transpose() - &s).amax() < 1e-12 * s.amax());
        assert_eq!(stationary(&dmatrix![1.1], &dmatrix![1.0]), None);
        // One dimension: S = r^2/(1 - r^2), also close to the limit.
        let r: f64 = 0.99999;
        let exact = r * r / (1.0 - r * r);
        approx::assert_relative_eq!(
            stationary(&dmatrix![r], &dmatrix![1.0]).expect("stable")[0],
            exact,
            max_relative = 1e-9
        );
        assert_eq!(stationary(&dmatrix![0.0, 1.0; 0.0, 0.0], &q).expect("stable"), dmatrix![4.0, 0.0; 0.0, 0.0]);
    }

    /// The formula for the sampling error against the sampling error of many runs.
    #[test]
    fn sample_variances_scatter_as_predicted() {
        let j = dmatrix![0.8, 0.5; -0.3, 0.6];
        let q = DMatrix::identity(2, 2);
        let s = stationary(&j, &q).expect("stable");
        let root = root(&s);
        let direction = dvector![1.0, 0.0];
        let (samples, runs) = (100, 4000);
        let (variance, relative) = along(&j, &s, &direction, samples);
        let mut noise = Noise::new(11);
        let ratios: Vec<f64> = (0..runs)
            .map(|_| {
                let mut draw = || DVector::from_fn(2, |_, _| noise.normal());
                let mut e = &root * draw();
                let mut sum = 0.0;
                for _ in 0..samples {
                    e = &j * (e + draw());
                    sum += e[0] * e[0];
                }
                sum / samples as f64 / variance
            })
            .collect();
        let mean = ratios.iter().sum::<f64>() / f64::from(runs);
        let scatter = (ratios.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / f64::from(runs)).sqrt();
        // Means over 4000 runs, known to 1.6 % of one run's scatter, which is itself known to 2 %.
        assert!((mean - 1.0).abs() < 5.0 * relative / f64::from(runs).sqrt(), "{mean}");
        assert!((scatter / relative - 1.0).abs() < 0.1, "{scatter} {relative}");
        let scores: Vec<f64> = ratios.iter().map(|r| score(*r, relative)).collect();
        let beyond = scores.iter().filter(|z| z.abs() > 1.96).count();
        assert!((120..280).contains(&beyond), "{beyond} of {runs} beyond the limits of 5 %");
    }
}
