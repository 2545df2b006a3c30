//! The ball on a paddle: flight times, speeds, the saltation matrix and the time at which bounces pile up are closed forms.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::{json, number};
use gaitc_runtime::model::{Gradient, Jacobian};
use gaitc_runtime::probe::{Evaluation, Function, Point, Variable};
use gaitc_runtime::return_map::{MapOutcome, StopReason};
use gaitc_runtime::sensitivity::{Clock, Crossing, saltation_matrix};
use maps::Machine;

const G: f64 = 9.81;

fn machine(e: f64, kick: f64) -> Machine {
    Machine::new("bouncing_ball", &[("e", e), ("kick", kick)])
}

#[test]
fn the_gait_is_the_closed_form() {
    for (e, kick) in [(0.8, 0.5), (0.3, 2.0), (0.95, 0.1)] {
        let machine = machine(e, kick);
        let gait = machine.gait(None);
        let v = kick / (1.0 - e);
        assert_abs_diff_eq!(gait.coordinates[0], v, epsilon = 1e-12 * v.max(1.0));
        assert_abs_diff_eq!(gait.map.duration, 2.0 * v / G, epsilon = 1e-12);
        assert_abs_diff_eq!(gait.multipliers[0].re, e, epsilon = 1e-12);
        assert_relative_eq!(machine.measure(&gait.map, "height"), v * v / (2.0 * G), max_relative = 1e-12);
        assert_abs_diff_eq!(machine.measure(&gait.map, "loss"), 1.0 - e * e, epsilon = 1e-12);
    }
}

#[test]
fn impacts_of_the_classical_ball_are_a_geometric_series() {
    for e in [0.5, 0.8, 0.9] {
        let (ball, v, bounces) = (machine(e, 0.0), 2.0, 12);
        let MapOutcome::Completed(map) = ball.run(&[v], bounces) else { panic!("it bounces") };
        assert_eq!(map.events.len(), bounces);
        let mut time = 0.0;
        for (i, event) in map.events.iter().enumerate() {
            let speed = v * e.powi(i32::try_from(i).unwrap());
            time += 2.0 * speed / G;
            assert_abs_diff_eq!(event.time, time, epsilon = 1e-12);
            assert_abs_diff_eq!(event.transversality, -speed, epsilon = 1e-12);
        }
        let factor = e.powi(i32::try_from(bounces).unwrap());
        assert_abs_diff_eq!(map.coordinates[0], v * factor, epsilon = 1e-12);
        assert_abs_diff_eq!(map.jacobian[(0, 0)], factor, epsilon = 1e-12);
    }
}

#[test]
fn bounces_pile_up_at_the_closed_time() {
    for (e, v) in [(0.5, 2.0), (0.8, 2.0), (0.6, 5.0)] {
        let MapOutcome::Stopped(stop) = machine(e, 0.0).run(&[v], 1000) else { panic!("no end of bounces") };
        assert_eq!(stop.reason, StopReason::Zeno);
        // The run is given up after some bounces that took less than 1e-10 of the time so far.
        assert_abs_diff_eq!(stop.time, 2.0 * v / (G * (1.0 - e)), epsilon = 1e-8);
    }
    let (code, value) = json(&["gait", "bouncing_ball", "--set", "kick=0 m/s"]);
    assert_eq!((code, value["status"].as_str()), (2, Some("zeno")), "{value:#}");
    let (code, value) = json(&["gait", "bouncing_ball", "--set", "kick=0 m/s", "--period", "1000"]);
    assert_eq!((code, value["status"].as_str()), (2, Some("zeno")), "{value:#}");
    assert_abs_diff_eq!(value["stopped"]["time"].as_f64().unwrap(), 4.0 / (G * 0.2), epsilon = 1e-8);
}

/// The height kick^2/(2 g (1 - e)^2) grows with both; stability bounds the restitution, the range the kick.
#[test]
fn the_highest_bounce_is_the_closed_form() {
    let (code, best) = json(&["optimize", "bouncing_ball"]);
    assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{best:#}");
    assert_abs_diff_eq!(number(&best, "/parameters/e"), 0.5, epsilon = 1e-8);
    assert_abs_diff_eq!(number(&best, "/objective/value"), 16.0 / (2.0 * G), epsilon = 1e-7);
}

/// Xi = [[v+/v-, 0], [-(1 + e) g/v-, -e]] for the speeds v- and v+ before and after the impact, from the generated functions.
#[test]
fn the_saltation_matrix_is_the_closed_form() {
    for (e, kick, v) in [(0.8, 0.0, -2.0), (0.8, 0.5, -2.5), (0.3, 2.0, -0.7)] {
        let machine = machine(e, kick);
        let info = machine.model.compiled.info();
        let probe = |function, x: &[f64; 2]| -> Evaluation {
            let point = Point {
                x,
                k: &[0.0; 2],
                p: &machine.parameters,
                memory: &[],
                functionals: &vec![0.0; info.functionals.len()],
                branch: &vec![false; info.switches.len()],
                tau: 0.0,
                t: 0.0,
            };
            machine.model.compiled.probe(function, &point).unwrap()
        };
        let flow = |x: &[f64; 2]| -> [f64; 2] { probe(Function::Flow(0), x).value.try_into().unwrap() };
        let states = |evaluation: &Evaluation| {
            evaluation.derivatives.iter().find(|(v, _)| *v == Variable::State).unwrap().1.clone()
        };
        let before = [0.0, v];
        let (guard, reset) = (probe(Function::Guard(0), &before), probe(Function::Reset(0), &before));
        let after: [f64; 2] = reset.value.clone().try_into().unwrap();
        let dx = states(&guard);
        let guard =
            Gradient::<f64, 2, 0> { value: guard.value[0], dx: [dx[0][0], dx[1][0]], dp: [], dtau: 0.0, dt: 0.0 };
        let dx = states(&reset);
        let dx = [[dx[0][0], dx[0][1]], [dx[1][0], dx[1][1]]];
        let reset = Jacobian { value: after, dx, dp: [], dtau: [0.0; 2], dt: [0.0; 2] };
        let clock = Clock::RunsOn(flow(&after));
        let crossing = Crossing { guard: &guard, reset: Some(&reset), before: flow(&before), clock };
        let columns = saltation_matrix(&crossing);
        let rises = kick - e * v;
        let expected = [[rises / v, -(1.0 + e) * G / v], [0.0, -e]];
        for (column, expected) in columns.iter().zip(&expected) {
            for (a, b) in column.iter().zip(expected) {
                assert_abs_diff_eq!(*a, *b, epsilon = 1e-12);
            }
        }
    }
}
