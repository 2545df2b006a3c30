//! Switching functions: jumps of the flow, kinks, several at once, a switch where a transition happens.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{E, EITHER, END, Exact, FALL, Of, RISE, System, X, at_last, number};
use gaitc_runtime::scalar::Scalar;

/// x' = 1, y' = c before and d after the line x = a + b y. Parameters a, b, c, d, -, T.
pub struct Jump;

impl System for Jump {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        [c(1.0), S::select(e.branch[0], e.p[2], e.p[3]), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, _: &X<S>, e: &E<'_, S>) -> Option<S> {
        if i == END { at_last(e) } else { None }
    }
    fn switch<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == 0 { e.p[0] + e.p[1] * x[1] - x[0] } else { c(1.0) }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, before, after, _, last] = *p;
        let s = (a + b * x[1] - x[0]) / (c::<S>(1.0) - b * before);
        let end = [x[0] + last, x[1] + before * s + after * (last - s), x[2]];
        Some(Exact { events: vec![(END, last)], end })
    }
}

/// x' = -1, y' = |x|; where |x| passes a, x is added to y. Parameters a, -, -, -, -, T.
pub struct Kink;

impl System for Kink {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [c(-1.0), S::select(e.branch[0], x[0], -x[0]), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            EITHER => Some(S::select(e.branch[0], x[0], -x[0]) - e.p[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        if i == EITHER { [x[0], x[1] + x[0], x[2] + x[2]] } else { *x }
    }
    fn switch<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> S {
        if i == 0 { x[0] } else { c(1.0) }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, .., last] = *p;
        let end = x[0] - last;
        let area = c::<S>(0.5) * (x[0] * x[0] + end * end);
        if number(a) == 0.0 {
            // Guard and kink are one: it fires once, with x - a for |x| - a.
            let events = vec![(EITHER, x[0] - a), (END, last)];
            return Some(Exact { events, end: [end, x[1] + area + a, x[2] + x[2]] });
        }
        let z = c::<S>(4.0) * x[2];
        Some(Exact { events: vec![(EITHER, x[0] - a), (EITHER, x[0] + a), (END, last)], end: [end, x[1] + area, z] })
    }
}

/// x' = 1; y' jumps from c to d at x = a, z' from e to -e at x = b. Parameters a, b, c, d, e, T.
pub struct Pair;

impl System for Pair {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        [c(1.0), S::select(e.branch[0], e.p[2], e.p[3]), S::select(e.branch[1], e.p[4], -e.p[4])]
    }
    fn guard<S: Scalar>(i: usize, _: &X<S>, e: &E<'_, S>) -> Option<S> {
        if i == END { at_last(e) } else { None }
    }
    fn switch<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == 0 { e.p[0] - x[0] } else { c::<S>(3.0) * (e.p[1] - x[0]) }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, before, after, k, last] = *p;
        let (s, r) = (a - x[0], b - x[0]);
        let end = [x[0] + last, x[1] + before * s + after * (last - s), x[2] + k * (r + r - last)];
        Some(Exact { events: vec![(END, last)], end })
    }
}

/// x' = 1; at x = a, y' jumps from c to d and a transition adds b x to y. Parameters a, b, c, d, -, T.
pub struct Coincident;

impl System for Coincident {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        [c(1.0), S::select(e.branch[0], e.p[2], e.p[3]), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(c::<S>(2.0) * (e.p[0] - x[0])),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == FALL { [x[0], x[1] + e.p[1] * x[0], x[2]] } else { *x }
    }
    fn switch<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == 0 { e.p[0] - x[0] } else { c(1.0) }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, before, after, _, last] = *p;
        let s = a - x[0];
        let end = [x[0] + last, x[1] + before * s + after * (last - s) + b * a, x[2]];
        Some(Exact { events: vec![(FALL, s), (END, last)], end })
    }
}

/// x' = 1, y' = max(a - x, min(x - b, c)): a switch under another one. Parameters a, b, c, -, -, T.
pub struct Nested;

fn smaller<S: Scalar>(x: &X<S>, e: &E<'_, S>) -> S {
    // The second selector is that of min: x - b >= c.
    S::select(e.branch[1], e.p[2], x[0] - e.p[1])
}

impl System for Nested {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [c(1.0), S::select(e.branch[0], e.p[0] - x[0], smaller(x, e)), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, _: &X<S>, e: &E<'_, S>) -> Option<S> {
        if i == END { at_last(e) } else { None }
    }
    fn switch<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == 0 { e.p[0] - x[0] - smaller(x, e) } else { x[0] - e.p[1] - e.p[2] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, top, _, _, last] = *p;
        // From a - x to x - b at their mean, to the constant at b + c.
        let half = c::<S>(0.5);
        let (first, second, end) = (half * (a + b), b + top, x[0] + last);
        let down = (a - half * (x[0] + first)) * (first - x[0]);
        let up = (half * (first + second) - b) * (second - first);
        Some(Exact { events: vec![(END, last)], end: [end, x[1] + down + up + top * (end - second), x[2]] })
    }
}

/// x' = y, y' = b up to the time t = a, then c; while tau <= d, z' = e. Parameters a, b, c, d, e, T.
pub struct Timed;

impl System for Timed {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[1], S::select(e.branch[0], e.p[1], e.p[2]), S::select(e.branch[1], e.p[4], c(0.0))]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            RISE => Some(x[0]),
            _ => None,
        }
    }
    fn switch<S: Scalar>(i: usize, _: &X<S>, e: &E<'_, S>) -> S {
        if i == 0 { e.p[0] - e.t } else { e.p[3] - e.tau }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, k, d, e, last] = *p;
        let half = c::<S>(0.5);
        // x rises through 0 before a, and the clock tau starts again; y goes on.
        let rise = (-x[1] + (x[1] * x[1] - c::<S>(2.0) * b * x[0]).sqrt()) / b;
        let (there, speed, rest) = (x[0] + x[1] * a + half * b * a * a, x[1] + b * a, last - a);
        let end = [there + speed * rest + half * k * rest * rest, speed + k * rest, x[2] + e * d + e * d];
        Some(Exact { events: vec![(RISE, rise), (END, last)], end })
    }
}

#[test]
fn jumps_of_the_flow() {
    let jump = |name: &str, a: f64, b: f64| Row::new(name, Of::Jump, [0.1, 0.2, 0.0], [a, b, 0.4, -0.7, 0.0, 1.0]);
    check(&[
        jump("jump at a wall", 0.5, 0.0),
        jump("jump at a slope", 0.5, 0.3),
        jump("jump at a slope the other way", 0.5, -0.8),
        jump("jump early", 0.1 + 1e-9, 0.0),
        jump("jump late", 1.1 - 1e-9, 0.0),
        Row::new("switches of clocks", Of::Timed, [-0.5, 0.6, 0.1], [0.9, 0.7, -0.4, 0.3, 1.5, 1.6]),
        Row::new("max of min", Of::Nested, [0.0, 0.2, 0.0], [1.0, 0.2, 0.6, 0.0, 0.0, 1.5]),
    ]);
}

#[test]
fn kinks() {
    check(&[
        Row::new("guard with a kink", Of::Kink, [1.0, 0.2, 0.3], [0.4, 0.0, 0.0, 0.0, 0.0, 2.0]),
        Row::new("guard with a kink nearby", Of::Kink, [1.0, 0.2, 0.3], [1e-6, 0.0, 0.0, 0.0, 0.0, 2.0]),
        // Guard and switch part where a is not 0: what y then gains between them is of second order.
        Row::new("guard zero at its kink", Of::Kink, [1.0, 0.2, 0.3], [0.0, 0.0, 0.0, 0.0, 0.0, 2.0]).once(),
    ]);
}

#[test]
fn several_switches_at_once() {
    let mut rows = Vec::new();
    for gap in [0.0, 1e-12, -1e-12, 1e-9, -1e-9, 0.2, -0.2] {
        let p = [0.5, 0.5 + gap, 0.4, -0.7, 0.9, 1.0];
        rows.push(Row::new(&format!("switches {gap} apart"), Of::Pair, [0.1, 0.2, 0.3], p));
    }
    rows.push(Row::new("switch with a guard", Of::Coincident, [0.1, 0.2, 0.0], [0.5, 0.6, 0.4, -0.7, 0.0, 1.0]));
    check(&rows);
}
