//! Guards with `when`.

use crate::check::{Row, check};
use crate::common::auto::c;
use crate::directions::cubic;
use crate::family::{E, EITHER, END, Exact, FALL, Of, SECOND, System, X, at_last, number};
use gaitc_runtime::scalar::Scalar;

/// x' = y' = 1; at x = a, when s (y - b) >= 0, z is increased by x y; at x = a + d by 1. Parameters a, b, s, d, -, T.
pub struct Gate;

impl System for Gate {
    fn flow<S: Scalar>(_: usize, _: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(1.0), c(1.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(e.p[0] - x[0]),
            SECOND => Some(e.p[0] + e.p[3] - x[0]),
            _ => None,
        }
    }
    fn when<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == FALL { e.p[2] * (x[1] - e.p[1]) } else { c(1.0) }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        match i {
            FALL => [x[0], x[1], x[2] + x[0] * x[1]],
            SECOND => [x[0], x[1], x[2] + x[0]],
            _ => *x,
        }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, s, d, _, last] = *p;
        let t = a - x[0];
        let y = x[1] + t;
        let (mut events, mut z) = (Vec::new(), x[2]);
        let fires = number(s * (y - b)) >= 0.0;
        if fires {
            z = z + a * y;
            events.push((FALL, t));
        }
        if !(fires && number(d) == 0.0) {
            z = z + a + d;
            events.push((SECOND, t + d));
        }
        events.push((END, last));
        Some(Exact { events, end: [x[0] + last, x[1] + last, z] })
    }
}

/// The cubic guard of both directions, when x >= d. Parameters a < b < c, d, -, T.
pub struct GatedCubic;

impl System for GatedCubic {
    fn flow<S: Scalar>(_: usize, _: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(1.0), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            EITHER => Some(cubic(x[0], e.p)),
            _ => None,
        }
    }
    fn when<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> S {
        if i == EITHER { x[0] - e.p[3] } else { c(1.0) }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        if i == END { *x } else { [x[0], x[1] + x[0] * x[2], x[2] + x[2]] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (mut events, mut y, mut z) = (Vec::new(), x[1], x[2]);
        for at in p[..3].iter().copied().filter(|at| number(*at) >= number(p[3])) {
            (y, z) = (y + at * z, z + z);
            events.push((EITHER, at - x[0]));
        }
        events.push((END, p[5]));
        Some(Exact { events, end: [x[0] + p[5], y, z] })
    }
}

#[test]
fn conditions() {
    let row = |name: &str, b: f64, s: f64, d: f64| Row::new(name, Of::Gate, [0.0, 0.5, 0.0], [1.0, b, s, d, 0.0, 2.0]);
    check(&[
        row("holds", 0.0, 1.0, 0.4),
        row("does not hold", 2.0, 1.0, 0.4).planless(),
        row("on its edge", 0.8, 0.0, 0.4),
        row("begins to hold just before", 1.5 - 1e-9, 1.0, 0.4),
        row("begins to hold just after", 1.5 + 1e-9, 1.0, 0.4).planless(),
        row("ceases to hold just before", 1.5 - 1e-9, -1.0, 0.4).planless(),
        row("ceases to hold just after", 1.5 + 1e-9, -1.0, 0.4),
        row("begins to hold in the middle", 0.8, 1.0, 0.4),
        row("the other of a tie does not hold", 2.0, 1.0, 0.0).planless(),
        row("does not hold, the next follows at once", 2.0, 1.0, 1e-9).planless(),
    ]);
}

#[test]
fn crossings_that_are_passed_over() {
    let mut rows = Vec::new();
    for d in [0.0, 0.2, 0.35, 0.45, 0.6, 0.79, 0.9] {
        for (start, last) in [(0.1, 1.0), (-5.0, 15.0)] {
            let name = format!("crossings from {d} on, start {start}");
            let row = Row::new(&name, Of::GatedCubic, [start, 0.0, 1.0], [0.3, 0.5, 0.8, d, 0.0, last]);
            rows.push(if d < 0.3 { row } else { row.planless() });
        }
    }
    check(&rows);
}
