//! Return maps of small models against closed forms and differences; every way in which a run can end.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

mod common;
#[path = "trajectory/small.rs"]
mod followed;
mod trajectory;

use approx::assert_abs_diff_eq;
use common::toys::{BALL, CHATTER, DIP, DOMAIN, FALLING, FORCED, JUMP, PILING, PULSE, TWINS, WHEEL};
use common::{check_derivatives, completed, request, stopped};
use gaitc_runtime::interrupt::Interrupt;
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{
    Accuracy, Images, MapOutcome, MapRequest, Points, RequestError, ReturnMap, Sensitivity, StopReason, Warning,
};
use std::time::Duration;

const ALL: Sensitivity<'static> = Sensitivity::CoordinatesAndParameters(&[0, 1]);

#[test]
fn bouncing_ball_has_its_closed_forms() {
    let (g, e, v) = (9.81, 0.8, 3.0);
    let (z, p) = ([v], [g, e]);
    let r = completed(&BALL, &MapRequest { measures: true, ..request(&z, &p, ALL) });
    let duration = 2.0 * v / g;
    assert_abs_diff_eq!(r.coordinates[0], e * v, epsilon = 1e-14);
    for (column, exact) in [e, 0.0, v].iter().enumerate() {
        assert_abs_diff_eq!(r.jacobian[(0, column)], exact, epsilon = 1e-13);
    }
    assert_abs_diff_eq!(r.duration, duration, epsilon = 4e-15);
    for (column, exact) in [2.0 / g, -duration / g, 0.0].iter().enumerate() {
        assert_abs_diff_eq!(r.duration_gradient[column], exact, epsilon = 1e-13);
    }
    let apex = v * v / (2.0 * g);
    let measures = [apex, -v, 2.0 / 3.0 * apex, 2.0 / 3.0 * apex * duration, v, -v, duration];
    for (value, exact) in r.measures.iter().zip(measures) {
        assert_abs_diff_eq!(*value, exact, epsilon = 1e-13);
    }
    assert_abs_diff_eq!(r.measures_jacobian[(0, 0)], v / g, epsilon = 1e-13);
    assert_abs_diff_eq!(r.measures_jacobian[(1, 0)], -1.0, epsilon = 1e-13);
    assert_abs_diff_eq!(r.events[0].transversality, -v, epsilon = 1e-13);
    check_derivatives(&BALL, &request(&z, &p, ALL), &[0, 1], 1e-10);
    let three = MapRequest { period: 3, ..request(&z, &p, Sensitivity::Coordinates) };
    let three = completed(&BALL, &three);
    assert_abs_diff_eq!(three.jacobian[(0, 0)], e * e * e, epsilon = 1e-13);
    assert_eq!(three.events.len(), 3);
}

/// Over three bounces the height is largest at the first apex; the others, and the ground, are where it could have been taken.
#[test]
fn extrema_name_the_places_where_they_could_have_been_taken() {
    let (g, e, v) = (9.81_f64, 0.8_f64, 3.0_f64);
    let (z, p) = ([v], [g, e]);
    let ask = MapRequest { period: 3, measures: true, ..request(&z, &p, ALL) };
    let (outcome, candidates) = BALL.candidates(&ask).unwrap();
    let MapOutcome::Completed(map) = outcome else { panic!("it bounces") };
    let height = candidates.iter().filter(|c| c.functional == candidates[0].functional);
    let apexes: Vec<_> = height.filter(|c| c.measures[0] > 0.1).collect();
    assert_eq!(apexes.len(), 3, "{candidates:#?}");
    let duration: f64 = (0..3).map(|k| 2.0 * v * e.powi(k) / g).sum();
    let mut start = 0.0;
    for (k, apex) in apexes.into_iter().enumerate() {
        let speed = v * e.powi(k as i32);
        assert_abs_diff_eq!(apex.phase, (start + speed / g) / duration, epsilon = 1e-9);
        assert_abs_diff_eq!(apex.measures[0], speed * speed / (2.0 * g), epsilon = 1e-12);
        let by_restitution = speed / g * v * k as f64 * e.powi(k as i32 - 1);
        let exact = [speed / g * e.powi(k as i32), -speed * speed / (2.0 * g * g), by_restitution];
        for (column, exact) in exact.iter().enumerate() {
            assert_abs_diff_eq!(apex.measures_jacobian[(0, column)], exact, epsilon = 1e-11);
        }
        start += 2.0 * speed / g;
    }
    let taken = candidates.iter().find(|c| c.measures == map.measures).expect("the one that was taken is among them");
    assert_eq!(taken.measures_jacobian, map.measures_jacobian);
    assert_eq!(completed(&BALL, &ask).measures, map.measures);
}

/// z is the speed just before an impact: z+ = e z, or z where the impact is slow, and the flight takes 2 e |z| / g.
#[test]
fn a_map_may_begin_before_its_transition() {
    let (g, e) = (9.81, 0.8);
    for (v, kept) in [(-3.0, e), (-0.5, 1.0)] {
        let (z, p, memory) = ([v], [g, e], [0.0]);
        let ask = MapRequest { measures: true, memory: &memory, ..request(&z, &p, ALL) };
        let r = completed(&FALLING, &ask);
        assert_abs_diff_eq!(r.coordinates[0], kept * v, epsilon = 1e-14);
        assert_eq!(r.state.as_slice(), [0.0, v]);
        let by_restitution = if kept == e { v } else { 0.0 };
        for (column, exact) in [kept, 0.0, by_restitution].iter().enumerate() {
            assert_abs_diff_eq!(r.jacobian[(0, column)], exact, epsilon = 1e-13);
        }
        for (value, exact) in r.measures.iter().zip([-kept * v, kept * v, -2.0 * kept * v / g]) {
            assert_abs_diff_eq!(*value, exact, epsilon = 1e-13);
        }
        assert_eq!(r.events.len(), 1);
        check_derivatives(&FALLING, &MapRequest { measures: true, ..ask }, &[0, 1], 1e-10);
        let two = completed(&FALLING, &MapRequest { period: 2, ..ask });
        let second = if kept * v < -1.0 { e } else { 1.0 };
        assert_abs_diff_eq!(two.coordinates[0], kept * second * v, epsilon = 1e-13);
        assert_abs_diff_eq!(two.jacobian[(0, 0)], kept * second, epsilon = 1e-13);
    }
}

#[test]
fn impacts_that_pile_up_are_zeno() {
    let (z, p) = ([3.0], [9.81, 0.5]);
    let stop = stopped(&PILING, &request(&z, &p, Sensitivity::Coordinates));
    assert_eq!(stop.reason, StopReason::Zeno);
    // 2 v/g (1 + e + e^2 + ...)
    assert_abs_diff_eq!(stop.time, 2.0 * 3.0 / 9.81 / (1.0 - 0.5), epsilon = 1e-8);
}

/// The ball's map z+ = e z has its only fixed point where bounces have no height. A guess so near to it that it maps onto itself to
/// any tolerance in m/s is no gait either.
#[test]
fn bounces_of_no_height_are_no_gait() {
    for guess in [3.0, 1e-4, 1e-10, 1e-16] {
        let outcome = find_gait(&BALL, &GaitRequest::new(&[9.81, 0.8], &[]), &[guess]).unwrap();
        let GaitStatus::Stopped(stop) = &outcome.status else { panic!("{guess}: {outcome:?}") };
        assert_eq!(stop.reason, StopReason::Zeno, "{guess}");
        assert!(outcome.gait.is_none());
    }
}

#[test]
fn rimless_wheel_has_multiplier_mu_squared() {
    let (k, alpha, gamma, mu) = (9.81, 0.3, 0.08, 0.7);
    let p = [k, alpha, gamma, mu];
    let outcome = find_gait(&WHEEL, &GaitRequest::new(&p, &[]), &[1.5]).unwrap();
    assert_eq!(outcome.status, GaitStatus::Converged);
    let gait = outcome.gait.unwrap();
    // Energy: the end rate w obeys w^2 = z^2 + 2 k (cos(start) - cos(end)), and z = mu w.
    let gain = 2.0 * k * ((gamma - alpha).cos() - (gamma + alpha).cos());
    assert_abs_diff_eq!(gait.coordinates[0], mu * (gain / (1.0 - mu * mu)).sqrt(), epsilon = 1e-13);
    assert_abs_diff_eq!(gait.multipliers[0].re, mu * mu, epsilon = 1e-12);
    check_derivatives(&WHEEL, &request(&[1.6], &p, Sensitivity::None), &[0, 1, 2, 3], 1e-9);
}

#[test]
fn a_wheel_that_is_too_slow_has_no_event() {
    let accuracy = Accuracy { time_limit: 5.0, ..Accuracy::default() };
    let p = [9.81, 0.3, 0.08, 0.7];
    let stop = stopped(&WHEEL, &MapRequest { accuracy, ..request(&[0.2], &p, Sensitivity::Coordinates) });
    assert_eq!(stop.reason, StopReason::NoEvent);
    assert_abs_diff_eq!(stop.time, 5.0, epsilon = 1e-9);
    let accuracy = Accuracy { step_limit: 3, ..Accuracy::default() };
    let stop = stopped(&WHEEL, &MapRequest { accuracy, ..request(&[1.6], &p, Sensitivity::Coordinates) });
    assert_eq!(stop.reason, StopReason::StepLimit);
}

/// It would rock on for a hundred million seconds.
#[test]
fn somebody_who_asks_to_stop_is_heard_in_the_middle_of_a_map() {
    let interrupt = Interrupt::new();
    let accuracy = Accuracy { time_limit: 1e8, step_limit: usize::MAX, interrupt, ..Accuracy::default() };
    let p = [9.81, 0.3, 0.08, 0.7];
    let ask = MapRequest { accuracy, ..request(&[0.2], &p, Sensitivity::Coordinates) };
    let stop = std::thread::scope(|scope| {
        scope.spawn(|| {
            std::thread::sleep(Duration::from_millis(20));
            interrupt.request()
        });
        stopped(&WHEEL, &ask)
    });
    assert_eq!(stop.reason, StopReason::Interrupted);
    assert!(stop.time > 0.0 && stop.time < 1e7, "{}", stop.time);
    // Nor are plans replayed: their lanes are declined.
    let usual = request(&[1.6], &p, Sensitivity::Coordinates);
    let later = Interrupt::new();
    let (_, plan) =
        WHEEL.plan(&MapRequest { accuracy: Accuracy { interrupt: later, ..usual.accuracy }, ..usual }).unwrap();
    let (plan, mut images) = (plan.unwrap(), Images::default());
    let points = Points { coordinates: &[1.6, 1.6001, 1.5999, 1.6], parameters: &p };
    WHEEL.replay(&plan, points, &mut images).unwrap();
    assert_eq!(images.held, [true; 4]);
    later.request();
    WHEEL.replay(&plan, points, &mut images).unwrap();
    assert_eq!(images.held, [false; 4]);
}

#[test]
fn explicit_time_enters_all_derivatives() {
    let p = [0.5, 1.7, 0.3, 0.9];
    let z = [0.35, 0.8];
    let base = MapRequest { memory: &[0.0], ..request(&z, &p, Sensitivity::None) };
    let r = completed(&FORCED, &base);
    assert_eq!(r.events.len(), 2);
    check_derivatives(&FORCED, &base, &[0, 1, 2, 3], 1e-8);
    check_derivatives(&FORCED, &MapRequest { period: 2, ..base }, &[0, 1, 2, 3], 1e-7);
}

#[test]
fn a_jump_of_the_flow_has_its_saltation() {
    // From (x, y): x + s = w + (y + a s)/10 at s, then b for the rest 1 - x - s.
    let (a, b, w) = (0.4, -0.7, 0.5);
    let (x, y) = (0.05, 0.2);
    let (z, p) = ([x, y], [a, b, w]);
    let base = MapRequest { measures: true, ..request(&z, &p, Sensitivity::CoordinatesAndParameters(&[0, 1, 2])) };
    let r = completed(&JUMP, &base);
    let slope = 1.0 - 0.1 * a;
    let s = (w + 0.1 * y - x) / slope;
    assert_abs_diff_eq!(r.coordinates[1], y + a * s + b * (1.0 - x - s), epsilon = 1e-14);
    let exact = [
        -(a - b) / slope - b,
        1.0 + (a - b) * 0.1 / slope,
        s + (a - b) * 0.1 * s / slope,
        1.0 - x - s,
        (a - b) / slope,
    ];
    for (column, exact) in exact.iter().enumerate() {
        assert_abs_diff_eq!(r.jacobian[(1, column)], exact, epsilon = 1e-13);
    }
    // The peak is at the switch, a kink.
    assert_abs_diff_eq!(r.measures[1], y + a * s, epsilon = 1e-14);
    check_derivatives(&JUMP, &request(&z, &p, Sensitivity::None), &[0, 1, 2], 1e-10);
}

#[test]
fn a_double_crossing_inside_one_step_is_found() {
    for dip in [1e-3, 1e-6] {
        let r = completed(&DIP, &request(&[0.0], &[dip], Sensitivity::Coordinates));
        let transitions: Vec<usize> = r.events.iter().map(|e| e.transition).collect();
        assert_eq!(transitions, [1, 0], "dip {dip}");
        assert_abs_diff_eq!(r.events[0].time, 1.0 - dip.sqrt(), epsilon = 1e-12);
    }
}

#[test]
fn a_touch_is_reported_and_a_near_miss_is_not() {
    let touch = completed(&DIP, &request(&[0.0], &[0.0], Sensitivity::Coordinates));
    assert!(matches!(touch.warnings[..], [Warning::Grazing { transition: 1, .. }]), "{:?}", touch.warnings);
    let flat = completed(&DIP, &request(&[0.0], &[1e-12], Sensitivity::Coordinates));
    assert!(flat.warnings.iter().any(|w| matches!(w, Warning::Grazing { transition: 1, .. })));
    let miss = completed(&DIP, &request(&[0.0], &[-1e-3], Sensitivity::Coordinates));
    assert!(miss.warnings.is_empty());
    assert_eq!(miss.events.len(), 1);
}

#[test]
fn ties_are_reported_and_the_first_of_the_spec_is_taken() {
    let r = completed(&TWINS, &request(&[0.1], &[0.0], Sensitivity::Coordinates));
    assert_eq!(r.events[0].transition, 1);
    assert_abs_diff_eq!(r.coordinates[0], 0.0, epsilon = 1e-15);
    assert!(matches!(r.warnings[..], [Warning::Tie { taken: 1, other: 2, .. }]), "{:?}", r.warnings);
    let apart = completed(&TWINS, &request(&[0.1], &[1e-6], Sensitivity::Coordinates));
    assert!(apart.warnings.is_empty());
    // Now the second comes first, and its reset leads away for longer than the time limit.
    let accuracy = Accuracy { time_limit: 3.0, ..Accuracy::default() };
    let base = MapRequest { accuracy, ..request(&[0.1], &[-1e-6], Sensitivity::Coordinates) };
    assert_eq!(stopped(&TWINS, &base).reason, StopReason::NoEvent);
}

#[test]
fn leaving_the_domain_is_named() {
    let stop = stopped(&DOMAIN, &request(&[1.0], &[-1.0], Sensitivity::Coordinates));
    assert_eq!(stop.reason, StopReason::NotFinite);
    assert!(stop.state[0] >= 0.0 && stop.state[0] < 1e-6, "{stop:?}");
}

#[test]
fn chattering_is_zeno() {
    let stop = stopped(&CHATTER, &request(&[1.0], &[], Sensitivity::Coordinates));
    assert_eq!(stop.reason, StopReason::Zeno);
    assert_abs_diff_eq!(stop.time, 1.0, epsilon = 1e-9);
}

#[test]
fn a_section_without_coordinates_works() {
    let p = [9.81, 0.4];
    let outcome = find_gait(&PULSE, &GaitRequest::new(&p, &[]), &[]).unwrap();
    assert_eq!(outcome.status, GaitStatus::Converged);
    let gait = outcome.gait.unwrap();
    assert!(gait.multipliers.is_empty() && gait.spectral_radius == 0.0);
    let mean = 9.81 * (1.0 - (1.0 - (-0.4_f64).exp()) / 0.4);
    assert_abs_diff_eq!(gait.map.measures[0], mean, epsilon = 1e-13);
    check_derivatives(&PULSE, &request(&[], &p, Sensitivity::None), &[0, 1], 1e-10);
}

#[test]
fn wrong_requests_are_errors() {
    let p = [9.81, 0.8];
    let nan = BALL.evaluate(&request(&[f64::NAN], &p, Sensitivity::None));
    assert!(matches!(nan, Err(RequestError::NotFinite { index: 0, .. })));
    let short = BALL.evaluate(&request(&[], &p, Sensitivity::None));
    assert!(matches!(short, Err(RequestError::Length { expected: 1, got: 0, .. })));
    let far = BALL.evaluate(&request(&[1.0], &p, Sensitivity::CoordinatesAndParameters(&[2])));
    assert!(matches!(far, Err(RequestError::Length { .. })));
    let accuracy = Accuracy { absolute: f64::NAN, ..Accuracy::default() };
    let bad = BALL.evaluate(&MapRequest { accuracy, ..request(&[1.0], &p, Sensitivity::None) });
    assert!(matches!(bad, Err(RequestError::Accuracy(_))));
    let none = BALL.evaluate(&MapRequest { period: 0, ..request(&[1.0], &p, Sensitivity::None) });
    assert!(matches!(none, Err(RequestError::Accuracy(_))));
}

#[test]
fn many_columns_in_several_passes_agree_with_one() {
    let p = [9.81, 0.8];
    let chosen: Vec<usize> = (0..30).map(|i| i % 2).collect();
    let many = Sensitivity::CoordinatesAndParameters(&chosen);
    let r = completed(&BALL, &MapRequest { measures: true, ..request(&[3.0], &p, many) });
    let one = completed(&BALL, &MapRequest { measures: true, ..request(&[3.0], &p, ALL) });
    assert_eq!(r.jacobian.ncols(), 31);
    for column in 1..31 {
        let same = if column % 2 == 1 { 1 } else { 2 };
        assert_abs_diff_eq!(r.jacobian[(0, column)], one.jacobian[(0, same)], epsilon = 1e-13);
        assert_abs_diff_eq!(r.duration_gradient[column], one.duration_gradient[same], epsilon = 1e-13);
        for m in 0..r.measures.len() {
            assert_abs_diff_eq!(r.measures_jacobian[(m, column)], one.measures_jacobian[(m, same)], epsilon = 1e-12);
        }
    }
}
