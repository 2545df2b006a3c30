//! Events that pile up: sliding, chattering, Zeno.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::family::{BACK, E, END, Exact, FALL, OUT, Of, SECOND, System, X, at_last, number};
use approx::assert_abs_diff_eq;
use gaitc_runtime::return_map::{MapOutcome, Method, Sensitivity, StopReason};
use gaitc_runtime::scalar::Scalar;

/// The flow points at the line x = a y from both sides: x' = -b above, c below, y' = d. Parameters a, b, c, d, -, T.
pub struct Sliding;

impl System for Sliding {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        [S::select(e.branch[0], -e.p[1], e.p[2]), e.p[3], c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, _: &X<S>, e: &E<'_, S>) -> Option<S> {
        if i == END { at_last(e) } else { None }
    }
    fn switch<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == 0 { x[0] - e.p[0] * x[1] } else { c(1.0) }
    }
}

/// A relay with a narrow gap a: x' = -1 at home down to 0, x' = 1 away up to a. Parameters a, -, -, -, -, T.
pub struct Relay;

impl System for Relay {
    fn flow<S: Scalar>(mode: usize, _: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(if mode == 0 { -1.0 } else { 1.0 }), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            OUT => Some(x[0]),
            BACK => Some(e.p[0] - x[0]),
            _ => None,
        }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (mut t, mut x0) = (x[0], c(0.0));
        let mut events = vec![(OUT, t)];
        while number(t) < number(p[5]) {
            events.push((BACK, t + p[0]));
            (t, x0) = (t + p[0] + p[0], t + p[0] + p[0]);
            events.push((OUT, t));
        }
        // The last way out comes after the end.
        events.pop();
        events.push((END, p[5]));
        Some(Exact { events, end: [x0 - p[5], x[1], x[2]] })
    }
}

/// A ball (x, v) between a wall at 0, where it keeps its speed, and one at z that approaches with speed u, where it keeps the part
/// e of its speed relative to it. With v = u (1 + e)/(1 - e) the gap shrinks by e from round to round. Parameters u, e, -, -, -, T.
pub struct Walls;

impl System for Walls {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [x[1], c(0.0), -e.p[0]]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0]),
            SECOND => Some(x[2] - x[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        let [u, k, ..] = *e.p;
        match i {
            FALL => [x[0], -x[1], x[2]],
            SECOND => [x[0], -(k * (x[1] + u)) - u, x[2]],
            _ => *x,
        }
    }
}

#[test]
fn events_that_pile_up() {
    let zeno = StopReason::Zeno;
    let impacts = |y: f64, v: f64, e: f64| {
        let fall = (v * v + 2.0 * 9.81 * y).sqrt();
        (v + fall) / 9.81 + 2.0 * e * fall / (9.81 * (1.0 - e))
    };
    let ball = |name: &str, y: f64, v: f64, e: f64| {
        let row = Row::new(name, Of::Ball, [y, v, 0.0], [9.81, e, 0.0, 0.0, 0.0, 50.0]);
        // A run is Zeno when flights are shorter than 1e-10 of the time so far: as much may be missing, e/(1 - e) times.
        row.stops(zeno, impacts(y, v, e), 1e-9)
    };
    check(&[
        ball("ball with e = 0.5", 1.0, 0.5, 0.5),
        ball("ball with e = 0.8", 0.0, 3.0, 0.8),
        ball("ball with e = 0.1", 1.0, -2.0, 0.1),
        Row::new("closing walls", Of::Walls, [0.0, 0.3, 1.0], [0.1, 0.5, 0.0, 0.0, 0.0, 50.0]).stops(zeno, 10.0, 1e-9),
        Row::new("sliding", Of::Sliding, [1.0, 0.0, 0.0], [0.0, 1.0, 1.0, 0.0, 0.0, 5.0]).stops(zeno, 1.0, 1e-9),
        Row::new("sliding on a slope", Of::Sliding, [1.0, 0.5, 0.0], [0.5, 2.0, 1.5, 0.4, 0.0, 5.0]).stops(
            zeno,
            0.75 / 2.2,
            1e-9,
        ),
        Row::new("relay", Of::Relay, [1.0, 0.3, 0.2], [0.2, 0.0, 0.0, 0.0, 0.0, 2.1]),
        Row::new("narrow relay", Of::Relay, [1.0, 0.0, 0.0], [1e-12, 0.0, 0.0, 0.0, 0.0, 5.0]).stops(zeno, 1.0, 1e-9),
    ]);
}

#[test]
fn a_flow_that_leaves_its_surface_goes_on() {
    // The same line, crossed: it is no sliding when the flow beyond leads away.
    let row = Row::new("crossing", Of::Sliding, [1.0, 0.0, 0.0], [0.0, 1.0, -2.0, 0.3, 0.0, 3.0]);
    for method in [Method::Explicit, Method::Radau5] {
        let MapOutcome::Completed(r) = row.run(method, Sensitivity::None) else { panic!("stopped") };
        assert_abs_diff_eq!(r.coordinates[0], -4.0, epsilon = 1e-12);
    }
}
