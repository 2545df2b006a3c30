//! The vertical climber with a muscle, against a second route: the speed as a function of the height, v dv/dy = rho_a/m - g.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod maps;

use approx::assert_abs_diff_eq;
use maps::{Machine, rk4};

const L_S: f64 = 0.13;

/// Acceleration at height y and speed v, and its derivative by v.
fn acceleration(machine: &Machine, y: f64, v: f64) -> [f64; 2] {
    let value = |name| machine.value(name);
    let (lever, c, v_max) = (value("r_m") / value("r_p"), value("c"), value("v_max"));
    // Hill: (F + c F_0)(u + c v_max) = (1 + c) c F_0 v_max with the speed u of shortening.
    let u = lever * v;
    let force = value("command") * value("F_0") * ((1.0 + c) * c * v_max / (u + c * v_max) - c);
    let slope = -value("command") * value("F_0") * (1.0 + c) * c * v_max / (u + c * v_max).powi(2) * lever;
    let pull = lever * force + value("k") * (L_S - y);
    [pull / value("m") - value("g"), lever * slope / value("m")]
}

/// Last speed, its derivative by the first and duration of a step that begins with the speed v.
fn step(machine: &Machine, v: f64) -> [f64; 3] {
    let rate = |y: f64, s: &[f64; 3]| {
        let [a, a_v] = acceleration(machine, y, s[0]);
        [a / s[0], (a_v / s[0] - a / (s[0] * s[0])) * s[1], 1.0 / s[0]]
    };
    let steps = 40_000;
    let h = L_S / f64::from(steps);
    (0..steps).fold([v, 1.0, 0.0], |s, i| rk4(h * f64::from(i), s, h, &rate))
}

#[test]
fn map_duration_and_derivative_agree_with_speed_over_height() {
    for (drum, spring) in [(0.08, 58.0), (0.03, 0.0), (0.02, 120.0), (0.15, 58.0)] {
        let machine = Machine::new("power_stroke_muscle", &[("r_m", drum), ("k", spring)]);
        for v in [0.4, 0.8, 1.5] {
            let map = machine.map(&[v]);
            let [end, slope, time] = step(&machine, v);
            assert_abs_diff_eq!(map.coordinates[0], end, epsilon = 1e-11);
            assert_abs_diff_eq!(map.jacobian[(0, 0)], slope, epsilon = 1e-11);
            assert_abs_diff_eq!(map.duration, time, epsilon = 1e-11);
        }
    }
}

#[test]
fn the_gait_is_stable_and_agrees_with_speed_over_height() {
    for (drum, spring) in [(0.08, 58.0), (0.03, 0.0), (0.02, 120.0), (0.15, 58.0)] {
        let machine = Machine::new("power_stroke_muscle", &[("r_m", drum), ("k", spring)]);
        let gait = machine.gait(None);
        let [end, slope, time] = step(&machine, gait.coordinates[0]);
        assert_abs_diff_eq!(gait.coordinates[0], end, epsilon = 1e-11);
        assert_abs_diff_eq!(gait.multipliers[0].re, slope, epsilon = 1e-11);
        assert_abs_diff_eq!(gait.map.duration, time, epsilon = 1e-11);
        assert!(slope.abs() < 1.0 && gait.spectral_radius < 1.0);
    }
}
