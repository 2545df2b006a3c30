//! The F-G template, against a second formulation: the mass in Cartesian coordinates about the foot, flight in closed form.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::json;
use maps::{Machine, differences, rk4};
use std::f64::consts::PI;

const G: f64 = 9.81;

/// The map of (p_r, p_theta) and the mean speed upward in the step.
fn map(machine: &Machine, z: [f64; 2]) -> ([f64; 2], f64) {
    let value = |name| machine.value(name);
    let (m, length, z_0, k, b, f) = (value("m"), value("L_0"), value("z"), value("k"), value("b"), value("f"));
    let (beta, hold) = (value("beta"), value("hold"));
    let (sin, cos) = beta.sin_cos();
    let longest = length * (1.0 + z_0);
    let start = [longest * sin, -longest * cos, z[0] * sin + z[1] * cos, -z[0] * cos + z[1] * sin];
    let rate = |tau: f64, [x, y, u, w]: &[f64; 4]| {
        let r = x.hypot(*y);
        let phase = 2.0 * PI * f * tau;
        let (target, speed) = (length * (1.0 + z_0 * phase.cos()), -length * z_0 * 2.0 * PI * f * phase.sin());
        let pull = k * (r - target) + b * ((x * u + y * w) / r - speed);
        [*u, *w, -pull / m * x / r, -pull / m * y / r - G]
    };
    let steps = 4000;
    let h = hold / f / f64::from(steps);
    let [_, y, u, w] = (0..steps).fold(start, |s, i| rk4(h * f64::from(i), s, h, &rate));
    let flight = (0.5 - hold) / f;
    let height = y - start[1] + w * flight - G * flight * flight / 2.0;
    let w = w - G * flight;
    // The new leg leans to the other side; the mirror image of its step is taken.
    ([-u * sin - w * cos, -(u * cos - w * sin)], height / (0.5 / f))
}

fn cases() -> [Machine; 3] {
    [&[][..], &[("beta", 0.4), ("f", 12.0)], &[("z", 0.3), ("k", 12.0), ("hold", 0.4)]]
        .map(|set| Machine::new("fg_template", set))
}

#[test]
fn map_and_jacobian_agree_with_cartesian_coordinates() {
    for machine in cases() {
        for z in [[-0.33, 0.19], [-0.1, -0.1]] {
            let found = machine.map(&z);
            let ((image, speed), jacobian) = (map(&machine, z), differences(z, 1e-3, &|z| map(&machine, z).0));
            assert_relative_eq!(found.duration, 0.5 / machine.value("f"), max_relative = 1e-13);
            assert_abs_diff_eq!(machine.measure(&found, "climb_speed"), speed, epsilon = 1e-9);
            for i in 0..2 {
                assert_abs_diff_eq!(found.coordinates[i], image[i], epsilon = 1e-9);
                for j in 0..2 {
                    assert_abs_diff_eq!(found.jacobian[(i, j)], jacobian[i][j], epsilon = 1e-8);
                }
            }
        }
    }
}

#[test]
fn the_gait_is_stable_and_passes_through_both_modes() {
    for machine in cases() {
        let gait = machine.gait(None);
        let (image, _) = map(&machine, [gait.coordinates[0], gait.coordinates[1]]);
        assert_abs_diff_eq!(gait.coordinates[0], image[0], epsilon = 1e-9);
        assert_abs_diff_eq!(gait.coordinates[1], image[1], epsilon = 1e-9);
        assert!(gait.spectral_radius < 1.0);
        let taken: Vec<_> = gait.map.events.iter().map(|e| e.transition).collect();
        assert_eq!(taken, [0, 1]);
    }
}

#[test]
fn no_leg_pulls_in_flight() {
    let (code, answer) = json(&["simulate", "fg_template", "--gait", "--steps", "1", "--show", "leg_force"]);
    assert_eq!(code, 0, "{answer:#}");
    let list = |path: &str| answer.pointer(path).unwrap().as_array().unwrap().clone();
    let (modes, forces) = (list("/samples/mode"), list("/samples/observed/leg_force"));
    let flying: Vec<_> = modes.iter().zip(&forces).filter(|(mode, _)| *mode == "flight").collect();
    assert!(!flying.is_empty() && flying.iter().all(|(_, force)| force.as_f64() == Some(0.0)), "{flying:?}");
}
