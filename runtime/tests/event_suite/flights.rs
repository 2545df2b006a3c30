//! Free flight on to a floor: falling guards, many impacts, a moving floor, very long and very short flights.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{E, END, Exact, FALL, Of, System, X, at_last, number};
use gaitc_runtime::scalar::Scalar;

/// Ball (height, speed, impacts) on a floor that rises with speed u; restitution e. Parameters g, e, u, -, -, T.
pub struct Ball;

/// The time to an impact, and the speed relative to the floor there, from height h with relative speed w.
pub fn fall<S: Scalar>(h: S, w: S, g: S) -> (S, S) {
    let v = (w * w + c::<S>(2.0) * g * h).sqrt();
    // Without cancellation.
    (if number(w) < 0.0 { c::<S>(2.0) * h / (v - w) } else { (w + v) / g }, -v)
}

impl System for Ball {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[1], -e.p[0], c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0] - e.p[2] * e.t),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        match i {
            FALL => [x[0], e.p[2] - e.p[1] * (x[1] - e.p[2]), x[2] + c(1.0)],
            _ => *x,
        }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [g, e, u, _, _, last] = *p;
        let (mut t, mut h, mut w, mut n) = (c(0.0), x[0], x[1] - u, x[2]);
        let mut events = Vec::new();
        loop {
            let (flight, impact) = fall(h, w, g);
            if number(t + flight) > number(last) {
                break;
            }
            (t, h, w, n) = (t + flight, c(0.0), -(e * impact), n + c(1.0));
            events.push((FALL, t));
        }
        let rest = last - t;
        events.push((END, last));
        Some(Exact { events, end: [h + w * rest - c::<S>(0.5) * g * rest * rest + u * last, w - g * rest + u, n] })
    }
}

/// A drop that ends the map at the floor y = c. Parameters g, e, c, -, -, -; the reset v+ = -e v also notes t v and tau.
pub struct Drop;

impl System for Drop {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[1], -e.p[0], c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        (i == END).then(|| x[0] - e.p[2])
    }
    fn reset<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[0], -(e.p[1] * x[1]), x[2] + e.t * x[1] + e.tau]
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (t, v) = fall(x[0] - p[2], x[1], p[0]);
        Some(Exact { events: vec![(END, t)], end: [p[2], -(p[1] * v), x[2] + t * v + t] })
    }
}

#[test]
fn falling_guards() {
    check(&[
        Row::new("one impact", Of::Ball, [1.0, 0.5, 0.0], [9.81, 0.7, 0.0, 0.0, 0.0, 0.8]),
        Row::new("five impacts", Of::Ball, [0.2, 0.0, 0.0], [9.81, 0.9, 0.0, 0.0, 0.0, 1.8]),
        Row::new("from the floor", Of::Ball, [0.0, 2.0, 0.0], [9.81, 0.8, 0.0, 0.0, 0.0, 0.6]),
        Row::new("floor that rises", Of::Ball, [1.0, 0.5, 0.0], [9.81, 0.7, 0.3, 0.0, 0.0, 1.2]),
        Row::new("floor that sinks", Of::Ball, [1.0, 0.5, 0.0], [9.81, 0.7, -0.4, 0.0, 0.0, 1.2]),
        Row::new("no impact in time", Of::Ball, [1.0, 0.5, 0.0], [9.81, 0.7, 0.0, 0.0, 0.0, 0.4]),
        Row::new("drop", Of::Drop, [1.0, 0.5, 0.0], [9.81, 0.7, 0.2, 0.0, 0.0, 0.0]),
    ]);
}

#[test]
fn long_and_short_flights() {
    let ball = Row::new("a million seconds", Of::Ball, [0.0, 1.0, 0.0], [2e-6, 0.5, 0.0, 0.0, 0.0, 1.2e6]);
    let drop = Row::new("drop of a million seconds", Of::Drop, [0.0, 1.0, 0.0], [2e-6, 0.5, 0.0, 0.0, 0.0, 0.0]);
    check(&[
        // It rises 2.5e5 m, and heights of 0 have the rounding of that; derivatives go up to 5e11, and those that are 0
        // have the rounding of what they were before.
        ball.limit(1e7).within(2.5e5 * 1e-15, 1e-9, 1e-9),
        drop.limit(1e7).within(2.5e5 * 1e-15, 1e-14, 1e-9),
        Row::new("a nanosecond", Of::Ball, [0.0, 5e-9, 0.0], [10.0, 0.5, 0.0, 0.0, 0.0, 1.2e-9]),
        Row::new("drop of a nanosecond", Of::Drop, [0.0, 5e-9, 0.0], [10.0, 0.5, 0.0, 0.0, 0.0, 0.0]),
        Row::new("fast drop of a nanosecond", Of::Drop, [1e-3, -1e6, 0.0], [10.0, 0.5, 0.0, 0.0, 0.0, 0.0]),
    ]);
}
