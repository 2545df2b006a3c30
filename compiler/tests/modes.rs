//! A model with two modes, states that belong to one of them, several transitions from one mode and memory: compiled, run,
//! and compared with its closed form.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test
#![deny(warnings)] // of the golden file, too

use approx::assert_abs_diff_eq;
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, ReturnMap, Sensitivity};
use std::f64::consts::PI;
use std::marker::PhantomData;

#[path = "golden/hopper.rs"]
#[rustfmt::skip]
pub mod hopper;

use hopper::{Hopper, INTEGRALS, PARAMETERS, STATES};

const HOPPER: Hybrid<Hopper, STATES, PARAMETERS, INTEGRALS> = Hybrid(PhantomData);
const G: f64 = 9.81;
const OMEGA: f64 = 40.0;
const KEPT: f64 = 0.9;

fn map(speed: f64) -> MapResult {
    let request = MapRequest {
        coordinates: &[speed],
        parameters: &[G, OMEGA, 2.0, KEPT],
        memory: &[0.0],
        period: 1,
        sensitivity: Sensitivity::CoordinatesAndParameters(&[0, 1, 2, 3]),
        measures: true,
        accuracy: Accuracy::default(),
    };
    match HOPPER.evaluate(&request).unwrap() {
        MapOutcome::Completed(result) => *result,
        MapOutcome::Stopped(stop) => panic!("stopped: {stop:?}"),
    }
}

/// Checks one hop: `landing` is the part of the speed with which the spring begins, `kept` what is left of that in the end.
fn check(speed: f64, transition: &str, landing: f64, kept: f64, dkept: f64) {
    let result = map(speed);
    let names: Vec<&str> = result.events.iter().map(|event| HOPPER.info().transitions[event.transition].name).collect();
    assert_eq!(names, [transition, "lift"]);
    let (flight, start) = (2.0 * speed / G, landing * speed);
    assert_abs_diff_eq!(result.coordinates[0], start * kept, epsilon = 1e-12);
    assert_abs_diff_eq!(result.duration, flight + PI / OMEGA, epsilon = 1e-12);
    let (top, deepest) = (speed * speed / (2.0 * G), start / OMEGA);
    for (measure, exact) in result.measures.iter().zip([top, deepest, 2.0 * (top + deepest)]) {
        assert_abs_diff_eq!(*measure, exact, epsilon = 1e-11);
    }
    for (column, exact) in [landing * kept, 0.0, 0.0, 0.0, start * dkept].into_iter().enumerate() {
        assert_abs_diff_eq!(result.jacobian[(0, column)], exact, epsilon = 1e-10);
    }
}

#[test]
fn a_soft_landing_has_its_closed_form() {
    check(1.0, "soft", 1.0, KEPT, 1.0);
}

#[test]
fn a_hard_landing_is_another_transition_and_is_remembered() {
    check(3.0, "hard", 0.5, 1.0, 0.0);
}
