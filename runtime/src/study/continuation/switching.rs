//! The way from a bifurcation to the branch that begins or crosses there.
//!
//! At a flip the gaits of twice the period leave along the eigenvector of -1. At a branch point A has a null space of two dimensions,
//! spanned by the branch's tangent t and a vector w orthogonal to it; with psi the left null vector of A, the directions a t + b w of the branches
//! through it solve
//!
//! ```text
//! psi . F_yy (a t + b w)^2 = 0,
//! ```
//!
//! whose term in a^2 is zero, since t is one of them. The other is -F_ww t + 2 F_tw w. The second derivatives along w come from central
//! differences of A. A point at a small distance along the direction is then found by Newton's method, and is taken only if it is elsewhere than
//! on the branch that it should leave.

use super::corrector::{null_space, tangent};
use super::system::{Sample, System};
use crate::return_map::RequestError;
use nalgebra::{DMatrix, DVector};

/// Distances from the bifurcation at which the other branch is looked for, in scaled unknowns.
const AMPLITUDES: [f64; 6] = [0.01, 0.02, 0.005, 0.002, 0.05, 0.001];
/// Part of the amplitude that a point has to be away from the old branch.
const ELSEWHERE: f64 = 0.2;
/// How far from the predicted point, relative to the amplitude, the other branch may be.
pub(super) const RADIUS: f64 = 1.0;
/// Steps of the differences.
const DIFFERENCE: f64 = 1e-3;
/// A gait is the same after fewer maps when it returns to within this distance, in scaled coordinates.
const REPEATS: f64 = 1e-4;

/// Unit vectors at a branch point.
pub(super) struct Directions {
    /// Along the other branch.
    pub(super) other: DVector<f64>,
    /// In the null space, across the known branch.
    pub(super) across: DVector<f64>,
}

impl System<'_> {
    /// Whether a gait returns after half the period already.
    pub(super) fn repeats_sooner(&self, sample: &Sample) -> Result<bool, RequestError> {
        if self.period % 2 == 1 {
            return Ok(false);
        }
        let half = Self { period: self.period / 2, ..self.clone() };
        Ok(half.evaluate(&sample.y)?.is_ok_and(|once| once.gap.norm() <= REPEATS))
    }

    /// A gait of twice the period near a flip, with the tangent away from it. `self` is the system of twice the period.
    pub(super) fn beside_flip(&self, flip: &Sample, single: &System<'_>) -> Result<Option<Sample>, RequestError> {
        let Some(direction) = self.flip_direction(flip) else {
            return Ok(None);
        };
        let start = self.rescaled(single, &flip.y);
        for amplitude in AMPLITUDES {
            if let Some(sample) = self.doubled(&start, &direction, amplitude, single)? {
                return Ok(Some(sample));
            }
        }
        Ok(None)
    }

    /// The eigenvector of -1, in scaled unknowns.
    pub(super) fn flip_direction(&self, flip: &Sample) -> Option<DVector<f64>> {
        let d = flip.coordinates();
        let matrix = DMatrix::from_fn(d, d, |i, j| {
            flip.jacobian[(i, j)] * self.scale[j] / self.scale[i] + if i == j { 1.0 } else { 0.0 }
        });
        let svd = matrix.svd(false, true);
        let (smallest, _) = svd.singular_values.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
        let vector = svd.v_t?.row(smallest).transpose();
        Some(vector.insert_row(d, 0.0))
    }

    /// A point of the doubled branch at an amplitude, if it is one.
    pub(super) fn doubled(
        &self,
        start: &DVector<f64>,
        direction: &DVector<f64>,
        amplitude: f64,
        single: &System<'_>,
    ) -> Result<Option<Sample>, RequestError> {
        let Ok(corrected) = self.correct(start + direction * amplitude, direction, RADIUS * amplitude)? else {
            return Ok(None);
        };
        let sample = corrected.sample;
        // One map has to lead elsewhere.
        let once = Self { period: single.period, ..self.clone() };
        let apart = once.evaluate(&sample.y)?.is_ok_and(|once| once.gap.norm() >= ELSEWHERE * amplitude);
        Ok(sample.away_from(start).filter(|_| apart))
    }

    /// Points on both sides of a branch point on the branch that crosses there, with tangents away from it.
    pub(super) fn beside_branch_point(&self, at: &Sample) -> Result<[Option<Sample>; 2], RequestError> {
        let Some(directions) = self.other_direction(at)? else {
            return Ok([None, None]);
        };
        let mut both = [None, None];
        for (slot, side) in both.iter_mut().zip([1.0, -1.0]) {
            for amplitude in AMPLITUDES {
                if let Some(sample) = self.on_other(at, &directions, side * amplitude)? {
                    *slot = sample.away_from(&at.y);
                    break;
                }
            }
        }
        Ok(both)
    }

    /// The point of the branch that crosses at a branch point at a signed distance, if it is one.
    pub(super) fn on_other(
        &self,
        at: &Sample,
        Directions { other, across }: &Directions,
        signed: f64,
    ) -> Result<Option<Sample>, RequestError> {
        let Ok(corrected) = self.correct(&at.y + other * signed, other, RADIUS * signed.abs())? else {
            return Ok(None);
        };
        let apart = across.dot(&(&corrected.sample.y - &at.y)).abs();
        let elsewhere = apart >= ELSEWHERE * signed.abs() * across.dot(other).abs();
        Ok(Some(corrected.sample).filter(|_| elsewhere))
    }

    /// The direction of the other branch, and the null vector across the known one.
    pub(super) fn other_direction(&self, at: &Sample) -> Result<Option<Directions>, RequestError> {
        let null = null_space(&at.matrix, 2);
        let svd = at.matrix.clone().svd(true, false);
        let smallest = svd.singular_values.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).map(|(i, _)| i);
        let ([n1, n2], Some(u), Some(smallest)) = (&null[..], svd.u, smallest) else {
            return Ok(None);
        };
        let left = u.column(smallest).into_owned();
        let Some(across) = (n2 * n1.dot(&at.tangent) - n1 * n2.dot(&at.tangent)).try_normalize(1e-6) else {
            return Ok(None);
        };
        let beside = |h: f64| self.evaluate(&(&at.y + &across * h));
        let (Ok(ahead), Ok(behind)) = (beside(DIFFERENCE)?, beside(-DIFFERENCE)?) else {
            return Ok(None);
        };
        let second = left.transpose() * (ahead.matrix - behind.matrix) / (2.0 * DIFFERENCE);
        let along = |v: &DVector<f64>| (&second * v)[0];
        let direction = &at.tangent * -along(&across) + &across * (2.0 * along(&at.tangent));
        Ok(direction.try_normalize(1e-8).map(|other| Directions { other, across }))
    }
}

impl Sample {
    /// With the tangent that leads away from a point.
    fn away_from(mut self, from: &DVector<f64>) -> Option<Self> {
        self.tangent = tangent(&self.matrix, &(&self.y - from))?;
        Some(self)
    }
}
