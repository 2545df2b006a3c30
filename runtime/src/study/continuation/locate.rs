//! Where between two points of a branch a test function is zero.
//!
//! Between the points a and b the branch is a curve over h = t_a . (y - y_a); a point of it is a correction in the hyperplane of its h, from the
//! cubic through both points with both tangents. The zero over h is found by false position with halved weights (Illinois), and bisection
//! whenever that is slow.

use super::Kind;
use super::corrector::tangent;
use super::indicators::outside;
use super::system::{Sample, System};
use crate::orbit::multipliers;
use crate::return_map::RequestError;
use nalgebra::DVector;

/// Most points that one zero costs.
const ITERATIONS: usize = 60;
/// The bracket's width, in scaled unknowns, at which a zero is found.
const WIDTH: f64 = 1e-13;
/// How far from the cubic, relative to the step, a point between may be.
const RADIUS: f64 = 0.5;
/// A fold and a branch point this close together are one branch point.
const SAME: f64 = 1e-5;

/// A bifurcation between two points.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub(super) kind: Kind,
    /// Index of the point before it.
    pub(super) after: usize,
    pub(super) sample: Sample,
    /// Whether more multipliers are outside the unit circle behind it than before.
    pub(super) loses: bool,
    /// Where in its step.
    pub(super) h: f64,
}

/// What a step contains.
pub(super) enum Seen {
    /// These bifurcations, in order.
    All(Vec<Found>),
    /// More than can be told apart; take shorter steps.
    TooMuch(Vec<Found>),
}

impl System<'_> {
    /// The bifurcations between two points of the branch.
    pub(super) fn bifurcations(&self, a: &Sample, b: &Sample, after: usize) -> Result<Seen, RequestError> {
        let (from, to) = (multipliers(&a.jacobian), multipliers(&b.jacobian));
        let (mut found, mut clear) = (Vec::new(), true);
        for kind in Kind::ALL {
            let (fa, fb) = (kind.indicator(a), kind.indicator(b));
            if (fa < 0.0) == (fb < 0.0) || kind.permanent(&from, &to) {
                continue;
            }
            match self.zero(kind, a, b)? {
                Some((h, sample)) => {
                    if kind.confirmed(&multipliers(&sample.jacobian)) {
                        found.push(Found { kind, after, sample, loses: self.grows(kind, a, b), h });
                    }
                }
                None => clear = false,
            }
        }
        found.sort_by(|one, other| one.h.total_cmp(&other.h));
        merge(&mut found);
        // Each bifurcation takes its multipliers through the circle: others must have gone through where the count differs.
        if let (Some(from), Some(to)) = (outside(&from), outside(&to)) {
            let explained: usize = found.iter().map(|f| f.kind.crossing()).sum();
            clear &= from.abs_diff(to) <= explained;
        }
        Ok(if clear { Seen::All(found) } else { Seen::TooMuch(found) })
    }

    /// Whether the multipliers that belong to a kind are outside behind the step.
    fn grows(&self, kind: Kind, a: &Sample, b: &Sample) -> bool {
        let count = |sample: &Sample| {
            let all = multipliers(&sample.jacobian);
            let belongs = |m: &&nalgebra::Complex<f64>| match kind {
                Kind::Fold | Kind::Branch => m.im == 0.0 && m.re > 1.0,
                Kind::Flip => m.im == 0.0 && m.re < -1.0,
                Kind::NeimarkSacker => m.norm() > 1.0,
            };
            all.iter().filter(belongs).count()
        };
        count(b) > count(a)
    }

    /// The zero of a test function that has different signs at both points; `None` where a point between cannot be found.
    fn zero(&self, kind: Kind, a: &Sample, b: &Sample) -> Result<Option<(f64, Sample)>, RequestError> {
        let length = a.tangent.dot(&(&b.y - &a.y));
        let (mut low, mut f_low, mut high, mut f_high) = (0.0, kind.indicator(a), length, kind.indicator(b));
        let (mut best, mut best_f): (Option<(f64, Sample)>, f64) = (None, f64::INFINITY);
        let (mut kept, mut width) = (0_i32, length);
        for iteration in 0..ITERATIONS {
            let mut h = high - f_high * (high - low) / (f_high - f_low);
            let slow = iteration % 3 == 2 && high - low > 0.5 * width;
            if slow || !(h > low && h < high) {
                h = 0.5 * (low + high);
            }
            if iteration % 3 == 2 {
                width = high - low;
            }
            let Some(sample) = self.between(a, b, h)? else {
                return Ok(best.filter(|_| high - low <= SAME * length));
            };
            let f = kind.indicator(&sample);
            if f.abs() < best_f {
                (best, best_f) = (Some((h, sample)), f.abs());
            }
            if f == 0.0 || high - low <= WIDTH {
                break;
            }
            if (f < 0.0) == (f_high < 0.0) {
                (high, f_high) = (h, f);
                f_low *= if kept == 1 { 0.5 } else { 1.0 };
                kept = 1;
            } else {
                (low, f_low) = (h, f);
                f_high *= if kept == -1 { 0.5 } else { 1.0 };
                kept = -1;
            }
        }
        Ok(best)
    }

    /// The point of the branch at h between two others.
    pub(super) fn between(&self, a: &Sample, b: &Sample, h: f64) -> Result<Option<Sample>, RequestError> {
        let length = a.tangent.dot(&(&b.y - &a.y));
        let Ok(corrected) = self.correct(cubic(a, b, h / length, length), &a.tangent, RADIUS * length)? else {
            return Ok(None);
        };
        let mut sample = corrected.sample;
        let Some(tangent) = tangent(&sample.matrix, &a.tangent) else {
            return Ok(None);
        };
        sample.tangent = tangent;
        Ok(Some(sample))
    }
}

/// The cubic through both points with both tangents, over h = x length.
fn cubic(a: &Sample, b: &Sample, x: f64, length: f64) -> DVector<f64> {
    let slope_b = &b.tangent / a.tangent.dot(&b.tangent);
    let (x2, x3) = (x * x, x * x * x);
    &a.y * (2.0 * x3 - 3.0 * x2 + 1.0)
        + &b.y * (3.0 * x2 - 2.0 * x3)
        + &a.tangent * ((x3 - 2.0 * x2 + x) * length)
        + slope_b * ((x3 - x2) * length)
}

/// A branch point where the branch turns round (the arms of a pitchfork) shows as a fold as well: it is one thing.
fn merge(found: &mut Vec<Found>) {
    let branches: Vec<DVector<f64>> =
        found.iter().filter(|f| f.kind == Kind::Branch).map(|f| f.sample.y.clone()).collect();
    found.retain(|f| f.kind != Kind::Fold || branches.iter().all(|y| (y - &f.sample.y).norm() > SAME));
}
