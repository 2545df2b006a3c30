//! The climber of prescribed length without sprawl: it hangs, and its swing grows by exactly the stroke.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::assert_abs_diff_eq;
use common::{json, number};
use maps::{Machine, rk4};
use std::f64::consts::PI;

const G: f64 = 9.81;
const L_S: f64 = 0.13;
const L_B: f64 = 0.5;

/// The flow preserves area in (q_theta, r p_theta), and p_theta is kept while r grows by the stroke.
const DETERMINANT: f64 = (L_B + L_S) / L_B;

fn machine(omega: f64) -> Machine {
    Machine::new("rotational", &[("omega", omega)])
}

#[test]
fn determinant_of_the_return_map_is_the_closed_form_at_any_point() {
    for omega in [2.0 * PI, 6.0 * PI, 10.0 * PI] {
        for z in [[0.0, 0.0], [0.3, -0.4], [-1.2, 1.5], [2.0, 0.7]] {
            let map = machine(omega).map(&z);
            assert_abs_diff_eq!(map.jacobian.determinant(), DETERMINANT, epsilon = 2e-12);
            assert_abs_diff_eq!(map.duration, PI / omega, epsilon = 1e-13);
        }
    }
}

#[test]
fn the_gait_hangs_and_climbs_one_stroke_a_step() {
    let machine = machine(6.0 * PI);
    let gait = machine.gait(None);
    assert_abs_diff_eq!(gait.coordinates.amax(), 0.0, epsilon = 1e-12);
    assert_abs_diff_eq!(machine.measure(&gait.map, "climb_speed"), L_S * 6.0, epsilon = 1e-12);
    // The force is largest at touch-down: m (g + l_s omega^2/2).
    let force = 2.6 * (G + L_S / 2.0 * (6.0 * PI).powi(2));
    assert_abs_diff_eq!(machine.measure(&gait.map, "peak_force"), force, epsilon = 1e-9);
    assert_abs_diff_eq!(gait.spectral_radius, DETERMINANT.sqrt(), epsilon = 1e-12);
}

/// Both bounds limit the fastest one: the radius the stroke, 1.1^2 = 1 + l_s/l_b, and the force then the frequency.
#[test]
fn the_fastest_climber_is_the_closed_form() {
    let (code, best) = json(&["optimize", "rotational"]);
    assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{best:#}");
    let stroke = 0.21 * L_B;
    let omega = ((80.0 / 2.6 - G) * 2.0 / stroke).sqrt();
    assert_abs_diff_eq!(number(&best, "/parameters/l_s"), stroke, epsilon = 1e-7);
    assert_abs_diff_eq!(number(&best, "/parameters/omega"), omega, epsilon = 1e-5);
    assert_abs_diff_eq!(number(&best, "/objective/value"), stroke * omega / PI, epsilon = 1e-7);
}

/// Trace of the linearised map of the hanging state, by another integrator: a pendulum of varying length.
fn trace(omega: f64) -> f64 {
    let rate = |tau: f64, [q, p]: &[f64; 2]| {
        let (r, v) = (L_B + L_S / 2.0 * (1.0 + (omega * tau).cos()), -L_S / 2.0 * omega * (omega * tau).sin());
        [p / r, -G * q - v * p / r]
    };
    let steps = 4000;
    let h = PI / omega / f64::from(steps);
    let flow = |start| (0..steps).fold(start, |y, i| rk4(h * f64::from(i), y, h, &rate));
    flow([1.0, 0.0])[0] + flow([0.0, 1.0])[1]
}

/// The hanging state is a pair of complex multipliers, but where a step takes about half a swing: there pumping is in
/// resonance, the multipliers are real, and the larger grows beyond the root of the determinant.
#[test]
fn pumping_once_in_half_a_swing_is_in_resonance() {
    let mut resonant = Vec::new();
    for i in 0..40 {
        let omega = 2.5 + 0.1 * f64::from(i);
        let gait = machine(omega).gait(Some(&[0.0, 0.0]));
        let trace = trace(omega);
        assert_abs_diff_eq!(gait.map.jacobian.trace(), trace, epsilon = 1e-10);
        let discriminant = trace * trace / 4.0 - DETERMINANT;
        let real = gait.multipliers[0].im == 0.0;
        assert_eq!(real, discriminant >= 0.0, "{omega}: {:?}", gait.multipliers);
        assert_eq!(gait.spectral_radius > DETERMINANT.sqrt() + 1e-9, real);
        if real {
            assert_abs_diff_eq!(gait.spectral_radius, trace.abs() / 2.0 + discriminant.sqrt(), epsilon = 1e-9);
            resonant.push(omega);
        }
    }
    // Half a swing of a pendulum between the longest and the shortest leg.
    let [slow, fast] = [L_B + L_S, L_B].map(|length: f64| (G / length).sqrt());
    assert!(!resonant.is_empty() && resonant.iter().any(|omega| slow < *omega && *omega < fast), "{resonant:?}");
}
