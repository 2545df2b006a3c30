//! Grazing: crossings that get flatter and flatter, touches, misses, an inflection.

use crate::check::{Row, Warned, check, plain};
use crate::common::auto::c;
use crate::family::{E, END, Exact, FALL, Of, System, X, at_last, number};
use gaitc_runtime::return_map::{MapOutcome, MapResult, Method, Sensitivity};
use gaitc_runtime::scalar::Scalar;

/// x' = 2 (t - 1): x = (t - 1)^2 from x = 1; where x falls below d, it is increased by 1, and y by t. Parameters d, -, -, -, -, T.
pub struct Parabola;

impl System for Parabola {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        [c::<S>(2.0) * (e.t - c(1.0)), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0] - e.p[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == FALL { [x[0] + c(1.0), x[1] + e.t, x[2]] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let depth = p[0] - (x[0] - c(1.0));
        let end = x[0] + p[5] * (p[5] - c(2.0));
        if number(depth) <= 0.0 {
            return Some(Exact { events: vec![(END, p[5])], end: [end, x[1], x[2]] });
        }
        let t = c::<S>(1.0) - depth.sqrt();
        Some(Exact { events: vec![(FALL, t), (END, p[5])], end: [end + c(1.0), x[1] + t, x[2]] })
    }
}

/// x' = -3 (t - 1)^2: x = (1 - t)^3 from x = 1 crosses 0 with no slope; y is increased by t. Parameters -, -, -, -, -, T.
pub struct Inflection;

impl System for Inflection {
    fn flow<S: Scalar>(_: usize, _: &X<S>, e: &E<'_, S>) -> X<S> {
        let s = e.t - c(1.0);
        [c::<S>(-3.0) * s * s, c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(x[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == FALL { [x[0], x[1] + e.t, x[2]] } else { *x }
    }
}

fn parabola(d: f64) -> Row {
    Row::new(&format!("depth {d}"), Of::Parabola, [1.0, 0.0, 0.0], [d, 0.0, 0.0, 0.0, 0.0, 1.75])
}

fn map(row: &Row, method: Method) -> MapResult {
    match row.run(method, Sensitivity::Coordinates) {
        MapOutcome::Completed(result) => *result,
        MapOutcome::Stopped(stop) => panic!("{stop:?}"),
    }
}

/// The state, of size 1, is known to its rounding u; so d is, the time 1 - sqrt(d) to u/(2 sqrt(d)), and its derivative
/// 1/(2 sqrt(d)) to u/(4 d^(3/2)), that is u/(2 d) of itself.
#[test]
fn the_flatter_the_crossing_the_larger_the_derivative() {
    let mut rows = Vec::new();
    for decade in 1..=12 {
        let d = 0.5 * 0.1_f64.powi(decade);
        let u = 4.0 * f64::EPSILON;
        let (times, derivatives) = ((u / (2.0 * d.sqrt())).max(1e-12), (u / d).max(1e-11));
        // The implicit method knows the state to its tolerance only.
        let implicit = (1e-13 / d).max(1e-9);
        // 2 sqrt(d) against 2 at the start.
        let flat = d.sqrt() <= 1e-4;
        let row = parabola(d).within(times, derivatives, implicit);
        rows.push(if flat { row.warns(&[Warned::Grazing(FALL)]) } else { row });
    }
    check(&rows);
}

/// The law 1/sqrt(d) itself: a hundredth of the depth, ten times the derivative.
#[test]
fn the_derivative_follows_the_square_root() {
    let at = |d: f64| map(&parabola(d), Method::Explicit).jacobian[(1, 0)];
    for decade in 1..=4 {
        let d = 0.1_f64.powi(decade);
        // u/(2 d) of itself, as above.
        let known = 1e-11_f64.max(4.0 * f64::EPSILON / (0.01 * d));
        assert!((at(0.01 * d) / at(d) - 10.0).abs() < 10.0 * known, "{d}");
    }
}

#[test]
fn touches_and_misses() {
    let warned = &[Warned::Grazing(FALL)];
    let misses = [-1e-7, -1e-3].map(|d| parabola(d).planless());
    check(&[parabola(0.0).warns(warned), parabola(-1e-9).warns(warned)]);
    check(&misses);
}

/// A zero of the third order is known to the cube root of rounding; there is no derivative, and the warning says so.
#[test]
fn a_crossing_without_slope() {
    for method in [Method::Explicit, Method::Radau5] {
        let row = Row::new("inflection", Of::Inflection, [1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.75]);
        let r = map(&row, method);
        let transitions: Vec<usize> = r.events.iter().map(|e| e.transition).collect();
        assert_eq!(transitions, [FALL, END], "{method:?}");
        assert!((r.events[0].time - 1.0).abs() < 1e-4, "{method:?} {:?}", r.events[0]);
        let warned: Vec<Warned> = r.warnings.iter().map(plain).collect();
        assert_eq!(warned, [Warned::Grazing(FALL)], "{method:?}");
    }
}
