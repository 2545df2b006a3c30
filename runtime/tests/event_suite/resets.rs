//! Resets: to another mode and back, with memory, with parameters, several in one map.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{BACK, E, END, Exact, FALL, OUT, Of, RISE, System, X, at_last, count, number};
use gaitc_runtime::scalar::Scalar;

/// At home x' = a; at x = b it goes out with x+ = c x, where x' = -d x; at x = e it comes back with x+ = x - e.
/// y notes t on the way out, z tau x on the way back. Parameters a, b, c, d, e, T; T is at home.
pub struct TwoModes;

impl System for TwoModes {
    fn flow<S: Scalar>(mode: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [if mode == 0 { e.p[0] } else { -(e.p[3] * x[0]) }, c(0.0), x[1]]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            OUT => Some(e.p[1] - x[0]),
            BACK => Some(x[0] - e.p[4]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        match i {
            OUT => [e.p[2] * x[0], x[1] + e.t, x[2]],
            BACK => [x[0] - e.p[4], x[1], x[2] + e.tau * x[0]],
            _ => *x,
        }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, k, d, back, last] = *p;
        let (mut t, [mut x, mut y, mut z]): (S, X<S>) = (c(0.0), *x);
        let mut events = Vec::new();
        loop {
            let leave = t + (b - x) / a;
            if number(leave) > number(last) {
                break;
            }
            (z, y, t) = (z + y * (leave - t), y + leave, leave);
            events.push((OUT, t));
            let away = (k * b / back).ln() / d;
            (z, x, t) = (z + y * away + away * back, c(0.0), t + away);
            events.push((BACK, t));
        }
        events.push((END, last));
        Some(Exact { events, end: [x + a * (last - t), y, z + y * (last - t)] })
    }
}

/// x' = y, y' = 0: at x = 1 rising, and at x = 0 falling, y+ = -y a (n + 1) with n the transitions so far, and z counts b n.
/// Parameters a, b, -, -, -, T.
pub struct Counting;

impl System for Counting {
    fn flow<S: Scalar>(_: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        [x[1], c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0]),
            RISE => Some(x[0] - c(1.0)),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == END {
            return *x;
        }
        [x[0], -(x[1] * e.p[0] * (count(e) + c(1.0))), x[2] + e.p[1] * count(e)]
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (mut t, [mut x, mut y, mut z]): (S, X<S>) = (c(0.0), *x);
        let (mut events, mut n) = (Vec::new(), 0.0);
        loop {
            let up = number(y) > 0.0;
            let wall = c::<S>(if up { 1.0 } else { 0.0 });
            let hit = t + (wall - x) / y;
            if number(hit) > number(p[5]) {
                break;
            }
            (t, x, y, z) = (hit, wall, -(y * p[0] * c(n + 1.0)), z + p[1] * c(n));
            events.push((if up { RISE } else { FALL }, t));
            n += 1.0;
        }
        events.push((END, p[5]));
        Some(Exact { events, end: [x + y * (p[5] - t), y, z] })
    }
}

#[test]
fn resets() {
    check(&[
        Row::new("out and back", Of::TwoModes, [0.2, 0.1, 0.0], [1.0, 1.0, 1.5, 2.0, 0.4, 2.0]),
        Row::new("out and back, often", Of::TwoModes, [0.2, 0.1, 0.0], [2.0, 1.0, 1.2, 3.0, 0.5, 5.0]),
        Row::new("at home", Of::TwoModes, [0.2, 0.1, 0.0], [1.0, 1.0, 1.5, 2.0, 0.4, 0.5]),
        Row::new("one bounce", Of::Counting, [0.5, 1.0, 0.0], [0.7, 2.0, 0.0, 0.0, 0.0, 1.0]),
        Row::new("bounces that get faster", Of::Counting, [0.5, -1.0, 0.0], [0.7, 2.0, 0.0, 0.0, 0.0, 3.0]),
    ]);
}
