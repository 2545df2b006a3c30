//! The crank-slider climber: through both dead centres, where the mass matrix vanishes.

#![allow(clippy::unwrap_used)] // a failed expectation is a failed test

mod common;

use approx::assert_relative_eq;
use common::crank::{M_S, parameters};
use common::{check_derivatives_where, completed, request};
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{Accuracy, Method, Sensitivity};

fn gait(p: &[f64; 10], accuracy: Accuracy, guess: &[f64]) -> Gait {
    let mut wanted = GaitRequest::new(p, &[]);
    wanted.accuracy = accuracy;
    let found = find_gait(&M_S, &wanted, guess).unwrap();
    assert_eq!(found.status, GaitStatus::Converged, "{p:?}: {}", found.message);
    found.gait.unwrap()
}

fn accuracy(relative: f64) -> Accuracy {
    Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() }
}

/// From a gear where the crank hardly overspeeds to one where it does so 13 times over.
#[test]
fn a_tighter_tolerance_changes_nothing() {
    for gear in [100.0, 56.57, 30.0, 20.0, 15.0] {
        let p = parameters(gear, 58.0, 20.0);
        let plain = gait(&p, accuracy(1e-12), &[-0.35, -0.2]);
        let tight = gait(&p, accuracy(1e-14), plain.coordinates.as_slice());
        let pairs = plain.coordinates.iter().zip(&tight.coordinates);
        for (a, b) in pairs.chain(plain.map.measures.iter().zip(&tight.map.measures)) {
            assert_relative_eq!(*a, *b, max_relative = 1e-9);
        }
        assert_relative_eq!(plain.map.duration, tight.map.duration, max_relative = 1e-11);
        for (a, b) in plain.multipliers.iter().zip(&tight.multipliers) {
            assert!((a - b).norm() < 1e-10, "{gear}: {a} {b}");
        }
        assert_eq!(plain.map.method, Method::Radau5);
    }
}

#[test]
fn both_methods_agree() {
    let p = parameters(56.57, 58.0, 20.0);
    let five = gait(&p, accuracy(1e-12), &[-0.35, -0.2]);
    let three = gait(&p, Accuracy { method: Method::Radau3, ..accuracy(1e-12) }, &[-0.35, -0.2]);
    assert_eq!(three.map.method, Method::Radau3);
    for (a, b) in five.coordinates.iter().zip(&three.coordinates) {
        assert_relative_eq!(*a, *b, max_relative = 1e-9);
    }
    for (a, b) in five.map.measures.iter().zip(&three.map.measures) {
        assert_relative_eq!(*a, *b, max_relative = 1e-6);
    }
    assert!(three.map.statistics.steps > 2 * five.map.statistics.steps);
}

/// Coordinates, duration and measures (among them extrema of the leg force, which needs the rate of Omega) with respect to
/// coordinates, gear, spring and sprawl.
#[test]
fn derivatives_agree_with_differences() {
    let (z, p) = ([-0.35, -0.22], parameters(45.0, 58.0, 20.0));
    let mut wanted = request(&z, &p, Sensitivity::None);
    wanted.accuracy = accuracy(1e-14);
    // The last row is the rate of Omega where the mass matrix vanishes: its value is a limit that is known well, the limit's
    // derivative is not (to some 1e-5).
    check_derivatives_where(&M_S, &wanted, &[0, 1, 2, 3, 6, 7, 8, 9], 2e-8, |row| row != 8);
}

/// Omega' = r'' Omega (F - m r'' Omega^2) omega_nl/(G^2 tau_stall) at a dead centre, where the equation reads 0/0.
#[test]
fn the_rate_at_a_dead_centre_is_its_limit() {
    let p = parameters(56.57, 58.0, 20.0);
    let [l_b, a, b, m, g, omega_nl, tau_stall, gear, spring, _] = p;
    let found = gait(&p, accuracy(1e-12), &[-0.35, -0.2]);
    // The state where the step ends: the reset undone.
    let z = &found.coordinates;
    let psi2 = 2.0 * p[9];
    let (q, speed) = (-z[0] - psi2, -z[1] / psi2.cos());
    let (omega, bend) = (omega_nl / gear, a - a * a / b);
    let force = m * g * q.cos() + m * speed * speed / l_b - spring * 0.0;
    let limit = bend * omega * (force - m * bend * omega * omega) * omega_nl / (gear * gear * tau_stall);
    assert_relative_eq!(found.map.measures[5], limit, max_relative = 3e-9);
}

/// At 45 degrees a step starts without tangential velocity: the sideways speed is zero, to rounding, where the mass matrix
/// vanishes, and its sign changes at once or never.
#[test]
fn a_switch_at_the_singular_start() {
    let psi = 45.0_f64.to_radians();
    for p_theta in [0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-13, -1e-13, 1e-10, -1e-10, 1e-7, -1e-7, 1e-5, -1e-5] {
        let mut p = parameters(56.57, 58.0, 45.0);
        p[9] = psi;
        let z = [-0.8, p_theta];
        let mut wanted = request(&z, &p, Sensitivity::Coordinates);
        let bare = completed(&M_S, &wanted);
        wanted.measures = true;
        for method in [Method::Radau5, Method::Radau3] {
            wanted.accuracy.method = method;
            let whole = completed(&M_S, &wanted);
            assert!(whole.measures.iter().all(|m| m.is_finite()), "{p_theta} {:?}", whole.measures);
            for (a, b) in bare.coordinates.iter().zip(&whole.coordinates) {
                assert!((a - b).abs() < 1e-9, "{p_theta}: {a} {b}");
            }
        }
    }
}

#[test]
fn the_work_is_what_it_was() {
    let (z, p) = ([-0.3548, -0.2294], parameters(56.57, 58.0, 20.0));
    let mut wanted = request(&z, &p, Sensitivity::Coordinates);
    wanted.accuracy = accuracy(1e-8);
    let statistics = completed(&M_S, &wanted).statistics;
    assert!(statistics.steps <= 15 && statistics.evaluations <= 400, "{statistics:?}");
}
