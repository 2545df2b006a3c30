//! Guards that are zero where a segment starts, at the start of the map or after a reset.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{E, EITHER, END, Exact, FALL, Of, RISE, SECOND, System, X, at_last, number};
use gaitc_runtime::return_map::StopReason;
use gaitc_runtime::scalar::Scalar;

/// x' = a + b t + c t^2; where x passes 0, x is increased by d, and y by t. Parameters a, b, c, the transition that has the guard,
/// d, T. The closed form knows the first passage only, which is at t = 1 or 2.
pub struct Polynomial;

/// A zero near `t`, which is exact but for variations: steps of Newton's method give it theirs, each one order more.
pub fn varied<S: Scalar>(t: f64, f: impl Fn(S) -> S, slope: impl Fn(S) -> S) -> S {
    (0..2).fold(c(t), |t, _| t - f(t) / slope(t))
}

impl System for Polynomial {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        [e.p[0] + e.t * (e.p[1] + e.t * e.p[2]), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            i if i as f64 == number(e.p[3]) => Some(x[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == END { *x } else { [x[0] + e.p[4], x[1] + e.t, x[2]] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, k, kind, d, last] = *p;
        let slope = |t: S| a + t * (b + t * k);
        let height = |t: S| x[0] + t * (a + t * (b * c(0.5) + t * k * c(1.0 / 3.0)));
        let kind = number(kind) as usize;
        let fires = |t: f64| {
            let slope = number(slope(c(t)));
            let counts = if kind == FALL { slope < 0.0 } else { kind == EITHER || slope > 0.0 };
            number(height(c(t))).abs() < 1e-15 && slope != 0.0 && counts && t < number(last)
        };
        let end = height(last);
        Some(match [1.0, 2.0].into_iter().find(|t| fires(*t)) {
            Some(t) => {
                let t = varied(t, height, slope);
                Exact { events: vec![(kind, t), (END, last)], end: [end + d, x[1] + t, x[2]] }
            }
            None => Exact { events: vec![(END, last)], end: [end, x[1], x[2]] },
        })
    }
}

/// Free flight (y, v) under -g; at y = 1 it is put on the guard y = 0 with speed w; there v is multiplied with k and n counted.
/// Parameters g, w, k, -, -, T.
pub struct Landing;

impl System for Landing {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[1], -e.p[0], c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0] - c(1.0)),
            SECOND => Some(x[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        match i {
            FALL => [c(0.0), e.p[1], x[2] + e.tau],
            SECOND => [x[0], e.p[2] * x[1], x[2] + c::<S>(10.0) * e.tau],
            _ => *x,
        }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [g, w, k, _, _, last] = *p;
        let (first, _) = crate::flights::fall(x[0] - c(1.0), x[1], g);
        let (mut t, mut v, mut z) = (first, w, x[2] + first);
        let mut events = vec![(FALL, t)];
        if number(w / g) > 0.0 {
            let flight = c::<S>(2.0) * w / g;
            (t, v, z) = (t + flight, -(k * w), z + c::<S>(10.0) * flight);
            events.push((SECOND, t));
        }
        events.push((END, last));
        let rest = last - t;
        Some(Exact { events, end: [v * rest - c::<S>(0.5) * g * rest * rest, v - g * rest, z] })
    }
}

#[test]
fn guards_that_are_zero_at_the_start() {
    let row = |name: &str, kind: usize, [a, b, c]: [f64; 3]| {
        Row::new(name, Of::Polynomial, [0.0, 0.0, 0.0], [a, b, c, kind as f64, 10.0, 2.4])
    };
    check(&[
        row("up, falls at 1", FALL, [1.0, -2.0, 0.0]),
        row("up, falls at 1, rising does not count it", RISE, [1.0, -2.0, 0.0]),
        row("up, either at 1", EITHER, [1.0, -2.0, 0.0]),
        row("down, rises at 1, falls at 2", FALL, [-2.0, 6.0, -3.0]),
        row("down, rises at 1", RISE, [-2.0, 6.0, -3.0]),
        row("down, either at 1", EITHER, [-2.0, 6.0, -3.0]),
        row("up with zero slope, falls at 1", FALL, [0.0, 2.0, -3.0]),
        row("down with zero slope, rises at 1", RISE, [0.0, -2.0, 3.0]),
        row("down with zero slope, either at 1", EITHER, [0.0, -2.0, 3.0]),
        row("up with zero slope and curvature, falling", FALL, [0.0, 0.0, 1.0]),
        row("down with zero slope and curvature, rising", RISE, [0.0, 0.0, -1.0]),
        row("stays zero", FALL, [0.0; 3]).planless(),
        row("stays zero, either", EITHER, [0.0; 3]).planless(),
        row("down with zero slope, falling", FALL, [0.0, -2.0, 3.0]).stops(StopReason::Zeno, 0.0, 0.0),
        row("up with zero slope, rising", RISE, [0.0, 2.0, -3.0]).stops(StopReason::Zeno, 0.0, 0.0),
        row("down with zero slope and curvature, falling", FALL, [0.0, 0.0, -1.0]).stops(StopReason::Zeno, 0.0, 0.0),
    ]);
}

#[test]
fn resets_that_land_on_a_guard() {
    let row =
        |name: &str, g: f64, w: f64, k: f64| Row::new(name, Of::Landing, [1.5, 0.3, 0.0], [g, w, k, 0.0, 0.0, 1.4]);
    let at = (0.3 + (0.09_f64 + 2.0 * 9.81 * 0.5).sqrt()) / 9.81;
    check(&[
        row("lands moving up", 9.81, 2.0, 0.5),
        row("lands moving down", 9.81, -2.0, 0.5),
        row("lands at rest", 9.81, 0.0, 0.5).stops(StopReason::Zeno, at, 1e-12),
    ]);
}
