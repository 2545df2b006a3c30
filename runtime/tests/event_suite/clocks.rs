//! Time events: guards in tau and in t, flows and resets that use both.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{E, END, Exact, FALL, Of, SECOND, System, X, at_last, number};
use gaitc_runtime::scalar::Scalar;

/// x' = y + tau, y' = t; every a seconds of tau, and once at t = b, x is increased by c tau, y by d t, z by x t.
/// Parameters a, b, c, d, -, T.
pub struct Clocks;

impl System for Clocks {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[1] + e.tau, e.t, c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, _: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(e.p[0] - e.tau),
            SECOND => Some(e.p[1] - e.t),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == END { *x } else { [x[0] + e.p[2] * e.tau, x[1] + e.p[3] * e.t, x[2] + x[0] * e.t] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (mut t, mut x): (S, X<S>) = (c(0.0), *x);
        let mut events = Vec::new();
        loop {
            let tick = (FALL, t + p[0]);
            let once = (SECOND, p[1]);
            let pending = number(p[1]) > number(t);
            let next = if pending && number(p[1]) < number(tick.1) { once } else { tick };
            let next = if number(p[5]) < number(next.1) { (END, p[5]) } else { next };
            let (h, half) = (next.1 - t, c::<S>(0.5));
            x[0] = x[0] + x[1] * h + half * (t + c(1.0)) * h * h + h * h * h * c(1.0 / 6.0);
            x[1] = x[1] + t * h + half * h * h;
            t = next.1;
            events.push(next);
            if next.0 == END {
                return Some(Exact { events, end: x });
            }
            x = [x[0] + p[2] * h, x[1] + p[3] * t, x[2] + x[0] * t];
        }
    }
}

#[test]
fn time_events() {
    let row = |name: &str, a: f64, b: f64, last: f64| {
        Row::new(name, Of::Clocks, [0.1, -0.2, 0.3], [a, b, 0.4, 0.5, 0.0, last])
    };
    check(&[
        row("tau", 0.7, 9.0, 1.0),
        row("t", 9.0, 0.6, 1.0),
        row("both", 0.4, 0.6, 2.3),
        row("both, t first", 0.4, 0.1, 2.3),
        row("end only", 9.0, 8.0, 1.0),
        row("twenty ticks", 0.1, 0.55, 2.03),
    ]);
}
