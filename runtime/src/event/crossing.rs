//! Passages of a surface inside one step, found on the dense output: sign changes, crossings there and back between two
//! ends of equal sign, touches.
//!
//! A step is short enough that the function looks like the cubic through its values and rates at both ends
//! (`hybrid/resolution`), so it turns twice at most; between turns it passes zero once or not at all.

use super::root::root;
use super::surface::{Reading, Side};
use crate::model::Direction;

/// A minimum whose distance from zero is below this fraction of the largest value in the segment is a touch.
const TOUCH: f64 = 1e-8;
/// How often the start of a bracket is halved towards a start that lies on the surface.
const HALVINGS: usize = 60;
/// A turn counts as near the surface when the cubic comes closer to it than this fraction of the closer end.
const NEAR: f64 = 0.5;

/// What happens to a surface within a step. Places are fractions of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Passage {
    /// It is crossed at `at`, between `low` and `high`, leaving side `from`.
    Crossing { low: f64, high: f64, at: f64, from: Side },
    /// It is touched at this place.
    Touch { at: f64 },
}

/// Whether a closer look is needed; costs next to nothing and asks for no dense output.
pub(crate) fn suspicious(side: Side, h: f64, start: &Reading, end: &Reading) -> bool {
    changes_sign(side, h, start, end) || turns(side, h, start, end) || turns_twice(side, h, start, end)
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

/// Towards the surface at the start and away from it, or at rest, at the end, with tangents that meet near it or beyond it,
/// or with an end that touches it.
fn turns(side: Side, h: f64, start: &Reading, end: &Reading) -> bool {
    let s = side.sign();
    let (v0, r0, v1, r1) = (s * start.value, s * start.rate, s * end.value, s * end.rate);
    if !(r0 < 0.0 && r1 >= 0.0) {
        return false;
    }
    let meet = (v1 - v0 - r1 * h) / (r0 - r1);
    v0 + r0 * meet < NEAR * v0.min(v1) || v0.min(v1) <= TOUCH * v0.max(v1)
}

/// Up and down again, or down and up, with the same sense at both ends, near the surface.
fn turns_twice(side: Side, h: f64, start: &Reading, end: &Reading) -> bool {
    let s = side.sign();
    if side == Side::Unknown || start.rate * end.rate <= 0.0 {
        return false;
    }
    let Some((first, second)) = turning_places(h, start, end) else {
        return false;
    };
    let near = NEAR * (s * start.value).min(s * end.value);
    let cubic = Cubic::new(h, start, end);
    s * cubic.at(first) < near || s * cubic.at(second) < near
}

/// The cubic v + u (d + u (b + u c)) through values and rates at both ends.
struct Cubic {
    v: f64,
    d: f64,
    b: f64,
    c: f64,
}

impl Cubic {
    fn new(h: f64, start: &Reading, end: &Reading) -> Self {
        let (d, last, change) = (h * start.rate, h * end.rate, end.value - start.value);
        Self { v: start.value, d, b: 3.0 * change - 2.0 * d - last, c: d + last - 2.0 * change }
    }

    fn at(&self, u: f64) -> f64 {
        self.v + u * (self.d + u * (self.b + u * self.c))
    }
}

/// Where the cubic turns, if it does so twice inside the step.
fn turning_places(h: f64, start: &Reading, end: &Reading) -> Option<(f64, f64)> {
    let Cubic { d, b, c, .. } = Cubic::new(h, start, end);
    // d + 2 b u + 3 c u^2 = 0
    let under = b * b - 3.0 * c * d;
    if under.is_nan() || under <= 0.0 {
        return None;
    }
    let far = -(b + under.sqrt().copysign(b));
    let (one, other) = (far / (3.0 * c), d / far);
    let (first, second) = (one.min(other), one.max(other));
    (first > 0.0 && second < 1.0 && first < second).then_some((first, second))
}

/// The places where the function turns, on the dense output.
fn turning(start: &Reading, end: &Reading, h: f64, rate: &impl Fn(f64) -> f64) -> Vec<f64> {
    if start.rate * end.rate < 0.0 || (end.rate == 0.0 && start.rate != 0.0) {
        return vec![root(rate, 0.0, start.rate, 1.0, end.rate)];
    }
    let Some((first, second)) = turning_places(h, start, end) else {
        return Vec::new();
    };
    let middle = 0.5 * (first + second);
    let between = rate(middle);
    // Of the same sense there, too: almost a turn.
    if between * start.rate >= 0.0 || between * end.rate >= 0.0 {
        return Vec::new();
    }
    vec![root(rate, 0.0, start.rate, middle, between), root(rate, middle, between, 1.0, end.rate)]
}

/// All passages in the direction asked for, in order, and touches. `value` and `rate` are the surface's function and its
/// time derivative on the dense output of a step of size `h`, `dip` a place in the step known to be on the other side
/// with its value there; `largest` is the largest magnitude of the function in the segment so far.
pub(crate) fn passages(
    side: Side,
    direction: Direction,
    (start, end, h, dip): (&Reading, &Reading, f64, Option<(f64, f64)>),
    largest: f64,
    value: &impl Fn(f64) -> f64,
    rate: &impl Fn(f64) -> f64,
) -> Vec<Passage> {
    let noise = start.rounding.max(end.rounding);
    let changes = changes_sign(side, h, start, end);
    // With one turn only, it matters when there is nothing else to go by: else it is beyond the crossing, or before it.
    let once = start.rate * end.rate <= 0.0;
    let known = once && (changes || dip.is_some());
    let turns = if known { Vec::new() } else { turning(start, end, h, rate) };
    let turns = turns.into_iter().filter(|u| *u > 0.0).map(|u| (u, value(u)));
    let mut places: Vec<(f64, f64)> = turns.chain(dip).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let on_surface = side.sign() * start.value <= start.rounding;
    let mut found = Vec::new();
    let (mut now, mut low) = (side, Low { at: 0.0, value: start.value, on_surface });
    let mut largest = largest;
    for (at, v) in places {
        let beyond = now.sign() * v;
        if beyond < -noise {
            if now.leaves(direction) {
                found.push(crossing(now, low, (at, v), value));
            }
            (now, low) = (now.opposite(), Low { at, value: v, on_surface: false });
        } else if !low.on_surface && now.leaves(direction) && v.abs() <= noise.max(TOUCH * largest) {
            found.push(Passage::Touch { at });
        } else if beyond > noise {
            low = Low { at, value: v, on_surface: false };
        }
        largest = largest.max(v.abs());
    }
    let changes = if now == side { changes } else { now.sign() * end.value <= 0.0 };
    if changes && now.leaves(direction) {
        found.push(crossing(now, low, (1.0, end.value), value));
    }
    found
}

/// The lower end of a bracket.
#[derive(Clone, Copy, Debug)]
struct Low {
    at: f64,
    value: f64,
    /// Whether it is the start of a segment, zero to rounding.
    on_surface: bool,
}

fn crossing(from: Side, low: Low, (high, end): (f64, f64), value: &impl Fn(f64) -> f64) -> Passage {
    if from.sign() * end > 0.0 {
        // Zero to rounding at the end, on the way through.
        return Passage::Crossing { low: high, high, at: high, from };
    }
    let (mut place, mut place_value) = (low.at, low.value);
    if low.on_surface {
        // Find a place where it has left the surface.
        place = high;
        for _ in 0..HALVINGS {
            place *= 0.5;
            place_value = value(place);
            if from.sign() * place_value > 0.0 {
                break;
            }
        }
        if from.sign() * place_value <= 0.0 {
            return Passage::Crossing { low: 0.0, high: place, at: 0.0, from };
        }
    }
    let at = root(value, place, place_value, high, end);
    Passage::Crossing { low: place, high, at, from }
}

#[cfg(test)]
mod tests {
    use super::{Passage, Side, passages, suspicious};
    use crate::event::surface::Reading;
    use crate::model::Direction;

    /// Places of crossings of a function on the step from 0 to 1.
    fn crossings(direction: Direction, f: impl Fn(f64) -> f64, rate: impl Fn(f64) -> f64) -> Vec<f64> {
        let reading = |u: f64| Reading { value: f(u), rate: rate(u), rounding: 1e-15, clock_only: false };
        let (start, end, side) = (reading(0.0), reading(1.0), Side::of(f(0.0)));
        assert!(suspicious(side, 1.0, &start, &end));
        let found = passages(side, direction, (&start, &end, 1.0, None), 1.0, &f, &rate);
        found.iter().filter_map(|p| if let Passage::Crossing { at, .. } = *p { Some(at) } else { None }).collect()
    }

    #[test]
    fn all_passages_of_a_cubic_are_found() {
        let f = |u: f64| (u - 0.2) * (u - 0.3) * (u - 0.8);
        let rate = |u: f64| (u - 0.3) * (u - 0.8) + (u - 0.2) * (u - 0.8) + (u - 0.2) * (u - 0.3);
        let near = |found: &[f64], exact: &[f64]| {
            found.len() == exact.len() && found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-14)
        };
        assert!(near(&crossings(Direction::Either, f, rate), &[0.2, 0.3, 0.8]));
        assert!(near(&crossings(Direction::Rising, f, rate), &[0.2, 0.8]));
        assert!(near(&crossings(Direction::Falling, f, rate), &[0.3]));
        // Both ends on one side: up, down through zero, and up again.
        let f = |u: f64| (u + 0.1) * (u - 0.6) * (u - 0.8);
        let rate = |u: f64| (u - 0.6) * (u - 0.8) + (u + 0.1) * (u - 0.8) + (u + 0.1) * (u - 0.6);
        assert!(near(&crossings(Direction::Either, f, rate), &[0.6, 0.8]));
        assert!(near(&crossings(Direction::Rising, f, rate), &[0.8]));
    }
}
