//! Stiff flows, ends of the domain, the time limit.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{E, END, Exact, FALL, Of, RISE, System, X, at_last, number};
use crate::starts::varied;
use core::f64::consts::FRAC_PI_2;
use gaitc_runtime::return_map::{MapOutcome, Method, Sensitivity, StopReason};
use gaitc_runtime::scalar::Scalar;

/// x' = 1, y' = -k (y - x): y follows x at the distance 1/k; where it rises through a, z collects t. Parameters k, a, -, -, -, T.
pub struct Stiff;

impl System for Stiff {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [c(1.0), -(e.p[0] * (x[1] - x[0])), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            RISE => Some(x[1] - e.p[1]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == RISE { [x[0], x[1], x[2] + e.t] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [k, a, .., last] = *p;
        let off = x[1] - x[0] + c::<S>(1.0) / k;
        let y = |t: S| x[0] + t - c::<S>(1.0) / k + off * (-(k * t)).exp();
        let slope = |t: S| c::<S>(1.0) - k * off * (-(k * t)).exp();
        let mut t = number(a - x[0] + c::<S>(1.0) / k);
        for _ in 0..50 {
            t -= number(y(c(t)) - a) / number(slope(c(t)));
        }
        let t = varied(t, |t| y(t) - a, slope);
        Some(Exact { events: vec![(RISE, t), (END, last)], end: [x[0] + last, y(last), x[2] + t] })
    }
}

/// x' = -(a + sqrt(x)) with a guard beyond the end of its domain. Parameters a, -, -, -, -, T.
pub struct Root;

impl System for Root {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [-(e.p[0] + x[0].sqrt()), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0] + c(0.1)),
            _ => None,
        }
    }
}

/// x' = 1 + x^2, which becomes infinite; at x = a, y collects t. Parameters a, -, -, -, -, T.
pub struct Blowup;

impl System for Blowup {
    fn flow<S: Scalar>(_: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        [c::<S>(1.0) + x[0] * x[0], c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            RISE => Some(x[0] - e.p[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == RISE { [x[0], x[1] + e.t, x[2]] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (start, t) = (x[0].atan(), p[0].atan() - x[0].atan());
        Some(Exact { events: vec![(RISE, t), (END, p[5])], end: [(start + p[5]).tan(), x[1] + t, x[2]] })
    }
}

#[test]
fn stiff_flows() {
    let row = |name: &str, k: f64| Row::new(name, Of::Stiff, [0.0, 0.0, 0.0], [k, 0.5, 0.0, 0.0, 0.0, 1.0]);
    // Behind the event y is slaved: its own error is forgotten, but an error of the method's estimate stays in what is seen of it.
    let rows = [
        row("k = 5", 5.0),
        row("k = 1e4", 1e4).method(Method::Automatic).within(1e-10, 1e-9, 1e-9),
        row("k = 1e6", 1e6).method(Method::Automatic).within(1e-10, 1e-9, 1e-9),
    ];
    check(&rows);
    for row in &rows[1..] {
        let MapOutcome::Completed(r) = row.run(Method::Automatic, Sensitivity::Coordinates) else { panic!("stopped") };
        assert_eq!(r.method, Method::Radau5);
    }
}

#[test]
fn ends_of_the_domain() {
    // 2 (sqrt(x) - a ln(1 + sqrt(x)/a)) to x = 0.
    let a = 0.1_f64;
    let leaves = 2.0 * (1.0 - a * (1.0 + 1.0 / a).ln());
    let blowup = |name: &str, last: f64| Row::new(name, Of::Blowup, [0.2, 0.0, 0.0], [3.0, 0.0, 0.0, 0.0, 0.0, last]);
    check(&[
        // The square root has no derivatives at 0: steps end a little before.
        Row::new("square root", Of::Root, [1.0, 0.0, 0.0], [a, 0.0, 0.0, 0.0, 0.0, 5.0]).stops(
            StopReason::NotFinite,
            leaves,
            1e-6,
        ),
        blowup("before it becomes infinite", 1.3),
        blowup("becomes infinite", 2.0).stops(StopReason::StepTooSmall, FRAC_PI_2 - 0.2_f64.atan(), 1e-9),
    ]);
}

#[test]
fn the_time_limit() {
    let ball = |name: &str| Row::new(name, Of::Ball, [1.0, 0.0, 0.0], [2.0, 0.7, 0.0, 0.0, 0.0, 2.0]);
    let drop = |name: &str| Row::new(name, Of::Drop, [1.0, 0.0, 0.0], [2.0, 0.5, 0.0, 0.0, 0.0, 0.0]);
    let none = StopReason::NoEvent;
    check(&[
        ball("clock, limit after").limit(2.0 + 1e-9),
        ball("clock, limit at the event").limit(2.0),
        ball("clock, limit before").limit(2.0 - 1e-9).stops(none, 2.0 - 1e-9, 1e-12),
        drop("surface, limit after").limit(1.0 + 1e-9),
        drop("surface, limit at the event").limit(1.0),
        drop("surface, limit before").limit(1.0 - 1e-9).stops(none, 1.0 - 1e-9, 1e-12),
    ]);
}
