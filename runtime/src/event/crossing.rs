//! Passages of a surface inside one step, found on the dense output: a sign change, or a double crossing between two
//! ends of equal sign, or a touch.

use super::root::root;
use super::surface::{Reading, Side};
use crate::model::Direction;

/// A minimum whose distance from zero is below this fraction of the largest value in the segment is a touch.
const TOUCH: f64 = 1e-8;
/// How often the start of a bracket is halved towards a start that lies on the surface.
const HALVINGS: usize = 60;

/// What happens to a surface within a step. Places are fractions of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Passage {
    /// It is crossed at `at`, between `low` and `high`, leaving side `from`.
    Crossing { low: f64, high: f64, at: f64, from: Side },
    /// It is touched at this place.
    Touch { at: f64 },
}

/// Whether a closer look is needed; costs nothing and asks for no dense output.
pub(crate) fn suspicious(side: Side, h: f64, start: &Reading, end: &Reading) -> bool {
    changes_sign(side, h, start, end) || turns(side, h, start, end)
}

fn changes_sign(side: Side, h: f64, start: &Reading, end: &Reading) -> bool {
    let s = side.sign();
    let through = s * end.value <= 0.0 || (s * end.value <= end.rounding && s * end.rate < 0.0);
    if side == Side::Unknown || !through {
        return false;
    }
    // From zero to zero: an excursion that happens to end with the step, or a function that stays zero.
    let resting = start.value.abs() <= start.rounding && end.value.abs() <= end.rounding;
    !resting || (s * start.rate * h > start.rounding && s * end.rate * h < -end.rounding)
}

/// Towards the surface at the start and away from it at the end, with tangents that meet near it or beyond it.
fn turns(side: Side, h: f64, start: &Reading, end: &Reading) -> bool {
    let s = side.sign();
    let (v0, r0, v1, r1) = (s * start.value, s * start.rate, s * end.value, s * end.rate);
    if !(r0 < 0.0 && r1 > 0.0) {
        return false;
    }
    let meet = (v1 - v0 - r1 * h) / (r0 - r1);
    v0 + r0 * meet < 0.5 * v0.min(v1)
}

/// The first passage in the direction asked for. `value` and `rate` are the surface's function and its time derivative
/// on the dense output of a step of size `h`, `dip` a place in the step known to be on the other side with its value
/// there; `largest` is the largest magnitude of the function in the segment so far.
pub(crate) fn passage(
    side: Side,
    direction: Direction,
    (start, end, h, dip): (&Reading, &Reading, f64, Option<(f64, f64)>),
    largest: f64,
    value: &impl Fn(f64) -> f64,
    rate: &impl Fn(f64) -> f64,
) -> Option<Passage> {
    if let Some((turn, extreme)) = dip {
        return there_and_back(side, direction, (start, end), (turn, extreme), value);
    }
    if changes_sign(side, h, start, end) {
        return if side.leaves(direction) { Some(sign_change(side, start, end, value)) } else { None };
    }
    let turn = root(rate, 0.0, start.rate, 1.0, end.rate);
    let extreme = value(turn);
    if side.sign() * extreme < 0.0 {
        return there_and_back(side, direction, (start, end), (turn, extreme), value);
    }
    let touches = side.leaves(direction) && extreme.abs() <= TOUCH * largest;
    touches.then_some(Passage::Touch { at: turn })
}

/// The passage of a function that is on the other side, with the value `extreme`, at `turn`: on the way there, or, if
/// that direction does not count, on the way back.
fn there_and_back(
    side: Side,
    direction: Direction,
    (start, end): (&Reading, &Reading),
    (turn, extreme): (f64, f64),
    value: &impl Fn(f64) -> f64,
) -> Option<Passage> {
    if side.leaves(direction) {
        let end = Reading { value: extreme, ..*end };
        return Some(scaled(sign_change(side, start, &end, &|u| value(u * turn)), 0.0, turn));
    }
    if side.sign() * end.value <= 0.0 {
        return None;
    }
    let at = root(value, turn, extreme, 1.0, end.value);
    Some(Passage::Crossing { low: turn, high: 1.0, at, from: side.opposite() })
}

fn sign_change(side: Side, start: &Reading, end: &Reading, value: &impl Fn(f64) -> f64) -> Passage {
    if side.sign() * end.value > 0.0 {
        // Zero to rounding at the end, on the way through.
        return Passage::Crossing { low: 1.0, high: 1.0, at: 1.0, from: side };
    }
    let (mut low, mut low_value) = (0.0, start.value);
    if side.sign() * start.value <= start.rounding {
        // It starts on the surface: find a place where it has left it.
        low = 1.0;
        for _ in 0..HALVINGS {
            low *= 0.5;
            low_value = value(low);
            if side.sign() * low_value > 0.0 {
                break;
            }
        }
        if side.sign() * low_value <= 0.0 {
            return Passage::Crossing { low: 0.0, high: low, at: 0.0, from: side };
        }
    }
    let at = root(value, low, low_value, 1.0, end.value);
    Passage::Crossing { low, high: 1.0, at, from: side }
}

fn scaled(passage: Passage, offset: f64, width: f64) -> Passage {
    let map = |u: f64| offset + width * u;
    match passage {
        Passage::Crossing { low, high, at, from } => {
            Passage::Crossing { low: map(low), high: map(high), at: map(at), from }
        }
        Passage::Touch { at } => Passage::Touch { at: map(at) },
    }
}
