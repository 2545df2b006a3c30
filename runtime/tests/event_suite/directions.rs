//! Directions: falling, rising and either, several passages in one step, surfaces that change nothing.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{E, EITHER, END, Exact, FALL, Of, RISE, System, X, at_last, number};
use core::f64::consts::{PI, TAU};
use gaitc_runtime::scalar::Scalar;

/// x' = 1 and a guard (x - a)(x - b)(x - c), which rises, falls and rises; the flow allows one step over all of it.
/// Parameters a < b < c, the transition that has the guard, -, T.
pub struct Cubic;

/// (x - a)(x - b)(x - c).
pub fn cubic<S: Scalar>(x: S, p: &[S; 6]) -> S {
    (x - p[0]) * (x - p[1]) * (x - p[2])
}

/// What the passages at `times` of a guard of s make of (s, y, z), which only s' = 1 changes.
fn collect<S: Scalar>(kind: usize, times: &[S], x: &X<S>, last: S) -> Exact<S> {
    let (mut y, mut z) = (x[1], x[2]);
    let mut events = Vec::new();
    for t in times.iter().copied().filter(|t| number(*t) > 0.0 && number(*t) < number(last)) {
        (y, z) = (y + (x[0] + t) * z, z + z);
        events.push((kind, t));
    }
    events.push((END, last));
    Exact { events, end: [x[0] + last, y, z] }
}

impl System for Cubic {
    fn flow<S: Scalar>(_: usize, _: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(1.0), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            i if i as f64 == number(e.p[3]) => Some(cubic(x[0], e.p)),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        if i == END { *x } else { [x[0], x[1] + x[0] * x[2], x[2] + x[2]] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let at = [p[0] - x[0], p[1] - x[0], p[2] - x[0]];
        let kind = number(p[3]) as usize;
        let times = match kind {
            FALL => vec![at[1]],
            RISE => vec![at[0], at[2]],
            _ => at.to_vec(),
        };
        Some(collect(kind, &times, x, p[5]))
    }
}

/// x' = v, v' = -x; where x passes d, k v is added to z: nothing changes for k = 0. Parameters d, k, the transition
/// that has the guard, -, -, T.
pub struct Harmonic;

impl System for Harmonic {
    fn flow<S: Scalar>(_: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        [x[1], -x[0], c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            i if i as f64 == number(e.p[2]) => Some(x[0] - e.p[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == END { *x } else { [x[0], x[1], x[2] + e.p[1] * x[1]] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        // x = A sin(t + phase).
        let (size, phase) = ((x[0] * x[0] + x[1] * x[1]).sqrt(), x[0].atan2(x[1]));
        let (angle, speed) = ((p[0] / size).asin(), (size * size - p[0] * p[0]).sqrt());
        let kind = number(p[2]) as usize;
        let mut passages = Vec::new();
        for turn in -1..4 {
            let turn = c::<S>(TAU * f64::from(turn)) - phase;
            if kind != FALL {
                passages.push((turn + angle, speed));
            }
            if kind != RISE {
                passages.push((turn + c(PI) - angle, -speed));
            }
        }
        passages.retain(|(t, _)| number(*t) > 0.0 && number(*t) < number(p[5]));
        passages.sort_by(|a, b| number(a.0).total_cmp(&number(b.0)));
        let z = passages.iter().fold(x[2], |z, (_, v)| z + p[1] * *v);
        let events = passages.iter().map(|(t, _)| (kind, *t)).chain([(END, p[5])]).collect();
        let (sin, cos) = (p[5].sin(), p[5].cos());
        Some(Exact { events, end: [x[0] * cos + x[1] * sin, x[1] * cos - x[0] * sin, z] })
    }
}

/// An unstable focus: r' = s r, angle' = w; at each crossing of the x axis (y rises) x is increased by k and z by tau.
/// Parameters s, w, k, -, -, T.
pub struct Spiral;

impl System for Spiral {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        let [s, w, ..] = *e.p;
        [s * x[0] - w * x[1], w * x[0] + s * x[1], c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            RISE => Some(x[1]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == RISE { [x[0] + e.p[2], x[1], x[2] + e.tau] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [s, w, k, _, _, last] = *p;
        let (mut t, mut r, mut angle, mut z) = (c(0.0), (x[0] * x[0] + x[1] * x[1]).sqrt(), x[1].atan2(x[0]), x[2]);
        let mut events = Vec::new();
        loop {
            let turns = if number(angle) < 0.0 { 0.0 } else { TAU };
            let flight = (c::<S>(turns) - angle) / w;
            if number(t + flight) > number(last) {
                break;
            }
            (t, r, angle, z) = (t + flight, r * (s * flight).exp() + k, c(0.0), z + flight);
            events.push((RISE, t));
        }
        events.push((END, last));
        let rest = last - t;
        let (r, angle) = (r * (s * rest).exp(), angle + w * rest);
        Some(Exact { events, end: [r * angle.cos(), r * angle.sin(), z] })
    }
}

#[test]
fn several_passages_in_one_step() {
    let mut rows = Vec::new();
    for (kind, name) in [(FALL, "falling"), (RISE, "rising"), (EITHER, "either")] {
        let kind = kind as f64;
        for [a, b, c] in [[0.3, 0.5, 0.8], [0.02, 0.9, 1.1], [0.4, 0.41, 0.43], [0.1, 1.3, 1.31], [0.05, 0.06, 1.2]] {
            let name = format!("cubic {name}, zeros {a}, {b}, {c}");
            rows.push(Row::new(&name, Of::Cubic, [0.0, 0.2, 1.0], [a, b, c, kind, 0.0, 1.5]));
            // From far away, in long steps. Zeros that are closer than these are flat by what the guard went through.
            if b - a > 0.01 || c - b > 0.1 {
                rows.push(Row::new(&(name + ", late"), Of::Cubic, [-5.0, 0.2, 1.0], [a, b, c, kind, 0.0, 15.0]));
            }
        }
    }
    check(&rows);
}

#[test]
fn passages_of_an_oscillator() {
    let mut rows = Vec::new();
    for (kind, name) in [(FALL, "falling"), (RISE, "rising"), (EITHER, "either")] {
        for (d, k) in [(0.3, 0.7), (-0.9, 0.4), (0.3, 0.0), (0.0, 1.0)] {
            let name = format!("oscillator {name} through {d}, k {k}");
            rows.push(Row::new(&name, Of::Harmonic, [0.6, 0.8, 0.1], [d, k, kind as f64, 0.0, 0.0, 12.0]));
        }
    }
    rows.push(Row::new("focus", Of::Spiral, [0.5, 0.3, 0.0], [0.1, 3.0, 0.2, 0.0, 0.0, 5.0]));
    rows.push(Row::new("focus from below", Of::Spiral, [0.5, -0.3, 0.0], [-0.2, 3.0, 0.2, 0.0, 0.0, 5.0]));
    check(&rows);
}
