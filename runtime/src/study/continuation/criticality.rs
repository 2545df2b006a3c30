//! From which side other gaits come at flips and branch points: where a few of them at small amplitudes are.

use super::Criticality;
use super::locate::Found;
use super::switching::RADIUS;
use super::system::{Sample, System};
use crate::orbit::multipliers;
use crate::return_map::RequestError;

/// Distances from the bifurcation, in scaled unknowns; each is tried with its half.
const AMPLITUDES: [f64; 3] = [0.02, 0.01, 0.005];
/// A parameter shift that does not grow with the amplitude or its square, to this relative accuracy, says nothing of the side.
const ACCURACY: f64 = 0.3;
/// Shifts of the scaled parameter below this are rounding.
const SHIFT: f64 = 1e-9;

/// How a branch goes through a branch point, by points on both sides of it.
enum Through {
    /// On over the parameter. The points, that at the smaller value of the parameter first.
    Straight(Box<[Sample; 2]>),
    /// It turns round there, as the arms of a pitchfork do; whether at the lower end of its values.
    Turns(bool),
}

impl System<'_> {
    /// From which side the gaits of twice the period come; `None` where two small amplitudes do not agree on it. `self` is the system
    /// of twice the period.
    pub(super) fn doubling(&self, flip: &Found, single: &System<'_>) -> Result<Option<Criticality>, RequestError> {
        let Some(direction) = self.flip_direction(&flip.sample) else {
            return Ok(None);
        };
        let start = self.rescaled(single, &flip.sample.y);
        for amplitude in AMPLITUDES {
            let shift = |amplitude| -> Result<Option<f64>, RequestError> {
                Ok(self.doubled(&start, &direction, amplitude, single)?.map(|s| s.s() - flip.sample.s()))
            };
            if let (Some(large), Some(small)) = (shift(amplitude)?, shift(0.5 * amplitude)?)
                && grows(large, small, 4.0)
            {
                // The parameter's direction in which the multiplier leaves the circle.
                let leaving = flip.sample.along_parameter() * if flip.loses { 1.0 } else { -1.0 };
                let same = (small > 0.0) == (leaving > 0.0);
                return Ok(Some(if same { Criticality::Supercritical } else { Criticality::Subcritical }));
            }
        }
        Ok(None)
    }

    /// What crosses at a branch point: a branch that goes on, or the arms of a pitchfork; `None` where small amplitudes do not
    /// agree on it.
    pub(super) fn crossing(&self, at: &Sample) -> Result<Option<Criticality>, RequestError> {
        let Some(directions) = self.other_direction(at)? else {
            return Ok(None);
        };
        let known = |signed: f64| -> Result<Option<Sample>, RequestError> {
            let reached = self.correct(&at.y + &at.tangent * signed, &at.tangent, RADIUS * signed.abs())?;
            Ok(reached.ok().map(|corrected| corrected.sample))
        };
        let other = |signed: f64| self.on_other(at, &directions, signed);
        for amplitude in AMPLITUDES {
            let both = (through(at, amplitude, &known)?, through(at, amplitude, &other)?);
            let (stem, low) = match both {
                (Some(Through::Straight(_)), Some(Through::Straight(_))) => {
                    return Ok(Some(Criticality::Transcritical));
                }
                (Some(Through::Straight(stem)), Some(Through::Turns(low)))
                | (Some(Through::Turns(low)), Some(Through::Straight(stem))) => (stem, low),
                _ => continue,
            };
            // The arms are where the stem has one multiplier more beyond 1, or one less.
            let [below, above] = stem.each_ref().map(beyond);
            let (with_arms, without) = if low { (above, below) } else { (below, above) };
            return Ok(match with_arms.cmp(&without) {
                std::cmp::Ordering::Greater => Some(Criticality::Supercritical),
                std::cmp::Ordering::Less => Some(Criticality::Subcritical),
                std::cmp::Ordering::Equal => None,
            });
        }
        Ok(None)
    }
}

/// Whether a shift at an amplitude is so many times that at half of it.
fn grows(large: f64, small: f64, times: f64) -> bool {
    small.abs() > SHIFT && (large / small / times - 1.0).abs() < ACCURACY
}

/// How a branch goes through a branch point, by its points at signed distances from there.
fn through(
    at: &Sample,
    amplitude: f64,
    point: &dyn Fn(f64) -> Result<Option<Sample>, RequestError>,
) -> Result<Option<Through>, RequestError> {
    let mut near = Vec::new();
    for side in [1.0, -1.0] {
        let (Some(large), Some(small)) = (point(side * amplitude)?, point(0.5 * side * amplitude)?) else {
            return Ok(None);
        };
        near.push((large.s() - at.s(), small.s() - at.s(), small));
    }
    let all = |times| near.iter().all(|(large, small, _)| grows(*large, *small, times));
    let lower = near.iter().filter(|(_, small, _)| *small < 0.0).count();
    let (linear, quadratic) = (all(2.0), all(4.0));
    near.sort_by(|a, b| a.1.total_cmp(&b.1));
    let samples: Vec<Sample> = near.into_iter().map(|(.., sample)| sample).collect();
    Ok(match (<[Sample; 2]>::try_from(samples), lower) {
        (Ok(samples), 1) if linear => Some(Through::Straight(Box::new(samples))),
        (_, 0) if quadratic => Some(Through::Turns(true)),
        (_, 2) if quadratic => Some(Through::Turns(false)),
        _ => None,
    })
}

/// How many real multipliers are larger than 1.
fn beyond(sample: &Sample) -> usize {
    multipliers(&sample.jacobian).iter().filter(|m| m.im == 0.0 && m.re > 1.0).count()
}
