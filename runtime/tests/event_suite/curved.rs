//! Guards that are not linear in the state, and a flow that is not.

use crate::check::{Row, Warned, check};
use crate::common::auto::c;
use crate::family::{E, EITHER, END, Exact, FALL, Of, RISE, SECOND, System, X, at_last, number};
use core::f64::consts::PI;
use gaitc_runtime::scalar::Scalar;

fn straight<S: Scalar>(x: &X<S>, t: S) -> X<S> {
    [x[0] + t * x[2].cos(), x[1] + t * x[2].sin(), x[2]]
}

/// Times to the circle of radius r on a straight way, if it is met: in and out.
fn circle<S: Scalar>(x: &X<S>, r: S) -> Option<(S, S)> {
    let along = x[0] * x[2].cos() + x[1] * x[2].sin();
    let under = along * along + r * r - x[0] * x[0] - x[1] * x[1];
    (number(under) > 0.0).then(|| (-along - under.sqrt(), under.sqrt() - along))
}

fn inside<S: Scalar>(x: &X<S>, e: &E<'_, S>) -> S {
    e.p[0] * e.p[0] - x[0] * x[0] - x[1] * x[1]
}

/// A ball (x, y, heading) of speed 1 in a circle of radius a. Parameters a, -, -, -, -, T.
pub struct Billiard;

impl System for Billiard {
    fn flow<S: Scalar>(_: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        [x[2].cos(), x[2].sin(), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some(inside(x, e)),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        if i == FALL { [x[0], x[1], c::<S>(2.0) * x[1].atan2(x[0]) + c(PI) - x[2]] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let (mut t, mut x): (S, X<S>) = (c(0.0), *x);
        let mut events = Vec::new();
        while let Some((_, flight)) = circle(&x, p[0]).filter(|way| number(t + way.1) < number(p[5])) {
            t = t + flight;
            x = straight(&x, flight);
            x[2] = c::<S>(2.0) * x[1].atan2(x[0]) + c(PI) - x[2];
            events.push((FALL, t));
        }
        events.push((END, p[5]));
        Some(Exact { events, end: straight(&x, p[5] - t) })
    }
}

/// A ray (x, y, heading) through a circle of radius a from outside: it is turned by b y where it enters, by c x where it leaves.
/// Parameters a, b, c, -, -, T.
pub struct Lens;

impl System for Lens {
    fn flow<S: Scalar>(_: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        [x[2].cos(), x[2].sin(), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            SECOND | RISE => Some(-inside(x, e)),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        match i {
            SECOND => [x[0], x[1], x[2] + e.p[1] * x[1]],
            RISE => [x[0], x[1], x[2] + e.p[2] * x[0]],
            _ => *x,
        }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let last = p[5];
        let Some((enter, _)) = circle(x, p[0]).filter(|way| number(way.0) > 0.0) else {
            return Some(Exact { events: vec![(END, last)], end: straight(x, last) });
        };
        let mut x = straight(x, enter);
        x[2] = x[2] + p[1] * x[1];
        // From the circle: the chord.
        let chord = c::<S>(-2.0) * (x[0] * x[2].cos() + x[1] * x[2].sin());
        let mut x = straight(&x, chord);
        x[2] = x[2] + p[2] * x[0];
        let leave = enter + chord;
        Some(Exact { events: vec![(SECOND, enter), (RISE, leave), (END, last)], end: straight(&x, last - leave) })
    }
}

/// x' = 1, y' = -2 with the guard (x - a)(y - b); z collects c x + y. Parameters a, b, c, -, -, T.
pub struct Product;

impl System for Product {
    fn flow<S: Scalar>(_: usize, _: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(1.0), c(-2.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            EITHER => Some((x[0] - e.p[0]) * (x[1] - e.p[1])),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == EITHER { [x[0], x[1], x[2] + x[2] + e.p[2] * x[0] + x[1]] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let mut times = [p[0] - x[0], (x[1] - p[1]) * c(0.5)];
        times.sort_by(|a, b| number(*a).total_cmp(&number(*b)));
        let at = |t: S| (x[0] + t, x[1] - t - t);
        let z = times.iter().fold(x[2], |z, t| z + z + p[2] * at(*t).0 + at(*t).1);
        let events = times.iter().map(|t| (EITHER, *t)).chain([(END, p[5])]).collect();
        Some(Exact { events, end: [at(p[5]).0, at(p[5]).1, z] })
    }
}

/// x' = 1; at exp(-a x) = b, x returns to 0 and y collects it. Parameters a, b, -, -, -, T.
pub struct Exponential;

impl System for Exponential {
    fn flow<S: Scalar>(_: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        [c(1.0), c(0.0), x[0]]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            FALL => Some((-(e.p[0] * x[0])).exp() - e.p[1]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, _: &E<'_, S>) -> X<S> {
        if i == FALL { [c(0.0), x[1] + x[0], x[2]] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let far = -(p[1].ln() / p[0]);
        let (mut t, [mut x, mut y, mut z]): (S, X<S>) = (c(0.0), *x);
        let mut events = Vec::new();
        let area = |from: S, to: S| c::<S>(0.5) * (to * to - from * from);
        while number(t + far - x) < number(p[5]) {
            (t, y, z, x) = (t + far - x, y + far, z + area(x, far), c(0.0));
            events.push((FALL, t));
        }
        events.push((END, p[5]));
        let last = x + p[5] - t;
        Some(Exact { events, end: [last, y, z + area(x, last)] })
    }
}

/// x' = b x (1 - x); at x = a, x is multiplied with c and y collects t. Parameters a, b, c, -, -, T.
pub struct Logistic;

impl System for Logistic {
    fn flow<S: Scalar>(_: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        [e.p[1] * x[0] * (c::<S>(1.0) - x[0]), c(0.0), c(0.0)]
    }
    fn guard<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> Option<S> {
        match i {
            END => at_last(e),
            RISE => Some(x[0] - e.p[0]),
            _ => None,
        }
    }
    fn reset<S: Scalar>(i: usize, x: &X<S>, e: &E<'_, S>) -> X<S> {
        if i == RISE { [e.p[2] * x[0], x[1] + e.t, x[2]] } else { *x }
    }
    fn exact<S: Scalar>(x: &X<S>, p: &[S; 6]) -> Option<Exact<S>> {
        let [a, b, k, _, _, last] = *p;
        let odds = |x: S| x / (c::<S>(1.0) - x);
        let (mut t, [mut x, mut y, z]): (S, X<S>) = (c(0.0), *x);
        let mut events = Vec::new();
        loop {
            let rise = (odds(a) / odds(x)).ln() / b;
            if number(t + rise) > number(last) {
                break;
            }
            (t, x, y) = (t + rise, k * a, y + t + rise);
            events.push((RISE, t));
        }
        events.push((END, last));
        let end = odds(x) * (b * (last - t)).exp();
        Some(Exact { events, end: [end / (c::<S>(1.0) + end), y, z] })
    }
}

#[test]
fn circles() {
    check(&[
        Row::new("billiard, one bounce", Of::Billiard, [0.2, 0.1, 0.4], [1.0, 0.0, 0.0, 0.0, 0.0, 1.5]),
        Row::new("billiard, five bounces", Of::Billiard, [0.2, 0.1, 0.4], [1.0, 0.0, 0.0, 0.0, 0.0, 9.0]),
        // Whispering: each bounce multiplies what the state is off by.
        Row::new("billiard, flat bounces", Of::Billiard, [0.0, -0.9, 0.1], [1.0, 0.0, 0.0, 0.0, 0.0, 3.0]),
        Row::new("lens", Of::Lens, [-2.0, 0.3, 0.0], [1.0, -0.2, 0.1, 0.0, 0.0, 5.0]).planless(),
        Row::new("lens from afar", Of::Lens, [-50.0, 0.3, 0.0], [1.0, -0.2, 0.1, 0.0, 0.0, 90.0]).planless(),
        Row::new("lens near its rim", Of::Lens, [-2.0, 0.999, 0.0], [1.0, 0.0, 0.1, 0.0, 0.0, 5.0]).planless(),
        Row::new("lens, passed by", Of::Lens, [-2.0, 1.001, 0.0], [1.0, -0.2, 0.1, 0.0, 0.0, 5.0]).planless(),
    ]);
}

#[test]
fn other_guards() {
    check(&[
        Row::new("product", Of::Product, [0.0, 1.0, 0.1], [0.7, 0.2, 0.5, 0.0, 0.0, 1.5]),
        Row::new("product, near", Of::Product, [0.0, 1.0, 0.1], [0.4001, 0.2, 0.5, 0.0, 0.0, 1.5]),
        Row::new("exponential", Of::Exponential, [0.1, 0.0, 0.0], [2.0, 0.3, 0.0, 0.0, 0.0, 2.0]),
        Row::new("steep exponential", Of::Exponential, [0.1, 0.0, 0.0], [40.0, 1e-9, 0.0, 0.0, 0.0, 0.9]).warns(&[
            // 4e-8 per second where it falls, 40 at the start: by that measure it is flat.
            Warned::Grazing(FALL),
        ]),
        Row::new("logistic", Of::Logistic, [0.1, 0.0, 0.0], [0.8, 1.5, 0.3, 0.0, 0.0, 6.0]),
    ]);
}
