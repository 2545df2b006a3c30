//! On which side of a surface a segment starts: the first of value, time derivative, look ahead that is not zero.
//!
//! So the guard that has just fired neither fires again at once nor is lost.

use super::surface::{Reading, Side, Surface, value};
use crate::integrate::{Frame, Method, short_step};
use crate::model::{Direction, Model};

/// How far ahead, as fractions of a typical step, the function is looked at when value and rate are both zero.
const LOOK_AHEAD: [f64; 3] = [1e-2, 1e-1, 1.0];

/// Where a segment starts relative to a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Start {
    /// The side that it is on, or goes to.
    pub(crate) side: Side,
    /// Whether value and rate are both zero.
    pub(crate) tangent: bool,
}

/// The side of a surface on which a segment starts. `typical` is a typical step size, `ahead(d)` the function's value
/// after a short time d.
pub(crate) fn arm(reading: &Reading, typical: f64, ahead: &impl Fn(f64) -> f64) -> Start {
    if reading.value.abs() > reading.rounding {
        return Start { side: Side::of(reading.value), tangent: false };
    }
    if (reading.rate * typical).abs() > reading.rounding {
        return Start { side: Side::of(reading.rate), tangent: false };
    }
    for fraction in LOOK_AHEAD {
        let value = ahead(fraction * typical);
        if value.abs() > reading.rounding {
            return Start { side: Side::of(value), tangent: true };
        }
    }
    Start { side: Side::Unknown, tangent: true }
}

/// Whether a segment that starts so ends at once: it stands on the guard, with no rate, and turns the way that fires.
pub(crate) fn ends_at_once(start: Start, direction: Direction) -> bool {
    let fires = match direction {
        Direction::Falling => start.side == Side::Negative,
        Direction::Rising => start.side == Side::Positive,
        Direction::Either => false,
    };
    start.tangent && fires
}

/// [`arm`] for a surface of a run that stands at (`tau`, `x`) with rate `k`.
pub(crate) fn start_side<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    surface: Surface,
    reading: &Reading,
    tau: f64,
    (x, k): (&[f64; N], &[f64; N]),
    typical: f64,
) -> Start {
    let ahead = |d: f64| {
        let later = short_step::<X, M, N, P, Q>(frame, tau, (x, k), d);
        value::<M, N, P, Q>(surface, &later, &frame.env(tau + d))
    };
    arm(reading, typical, &ahead)
}
