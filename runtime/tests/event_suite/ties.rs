//! Guards that fall at the same time, or almost.

use crate::check::{Row, Warned, check};
use crate::common::auto::c;
use crate::family::{E, END, Exact, FALL, Of, SECOND, System, THIRD, X, at_last, number};
use gaitc_runtime::scalar::Scalar;

/// x' = 1, y' = 1/2; at x = a, b and c, by guards of different slopes, y is doubled and increased by the number of the guard and x.
/// Parameters a, b, c, -, -, T.
pub struct Runner;

const GUARDS: [usize; 3] = [FALL, SECOND, THIRD];

impl System for Runner {
    fn flow<S: Scalar>(_: usize, _: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(1.0), c(0.5), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        let slope = |k: usize| c::<S>(1.0 + 7.0 * k as f64);
        match i {
            END => at_last(e),
            _ => GUARDS.iter().position(|g| *g == i).map(|k| slope(k) * (e.p[k] - x[0])),
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        if i == END { *x } else { [x[0], x[1] + x[1] + c(i as f64) + x[0], x[2] + x[1]] }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let mut passages: Vec<(usize, S)> = GUARDS.iter().enumerate().map(|(k, i)| (*i, p[k] - x[0])).collect();
        passages.push((END, p[5]));
        // The first of the spec at one time; the others of that time do not come.
        passages.sort_by(|a, b| (number(a.1), a.0).partial_cmp(&(number(b.1), b.0)).expect("numbers"));
        passages.dedup_by(|b, a| number(b.1) == number(a.1));
        let (mut t, mut y, mut z): (S, S, S) = (c(0.0), x[1], x[2]);
        let mut events = Vec::new();
        for (i, at) in passages {
            y = y + c::<S>(0.5) * (at - t);
            t = at;
            events.push((i, at));
            if i == END {
                break;
            }
            (y, z) = (y + y + c(i as f64) + x[0] + t, z + y);
        }
        Some(Exact { events, end: [x[0] + t, y, z] })
    }
}

#[test]
fn ties() {
    let row = |name: &str, [a, b, c]: [f64; 3], last: f64| {
        Row::new(name, Of::Runner, [0.0, 0.3, 0.1], [a, b, c, 0.0, 0.0, last])
    };
    check(&[
        row("apart", [1.0, 1.5, 0.7], 2.0),
        row("two", [1.0, 1.0, 1.5], 2.0).warns(&[Warned::Tie(FALL, SECOND)]),
        row("two others", [1.5, 1.0, 1.0], 2.0).warns(&[Warned::Tie(SECOND, THIRD)]),
        row("three", [1.0, 1.0, 1.0], 2.0).warns(&[Warned::Tie(FALL, SECOND), Warned::Tie(FALL, THIRD)]),
        row("with the section", [1.0, 3.0, 3.0], 1.0).warns(&[Warned::Tie(END, FALL)]),
    ]);
}

#[test]
fn near_ties() {
    let mut rows = Vec::new();
    for gap in [1e-6, 1e-9, 1e-12, 1e-13] {
        for (order, [a, b, c]) in
            [("in order", [0.0, 1.0, 2.0]), ("reversed", [2.0, 1.0, 0.0]), ("mixed", [1.0, 2.0, 0.0])]
        {
            let p = [1.0 + a * gap, 1.0 + b * gap, 1.0 + c * gap, 0.0, 0.0, 2.0];
            rows.push(Row::new(&format!("{gap} apart, {order}"), Of::Runner, [0.0, 0.3, 0.1], p));
        }
    }
    check(&rows);
}
