//! The self-exciting climber with rack and pinion, against a second formulation: the mass in Cartesian coordinates, which the
//! touch-down of the other foot does not change at all.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod maps;

use approx::assert_abs_diff_eq;
use maps::{Machine, differences, until};
use std::f64::consts::PI;

const G: f64 = 9.81;
const M: f64 = 2.6;
const L_S: f64 = 0.13;
const L_B: f64 = 0.5;
const K: f64 = 58.0;
/// Radius of the pinion: half a turn is one stroke.
const R_P: f64 = 0.13 / PI;

/// Pull along the leg of length r that changes at the rate v: motor behind pinion and gear, and spring.
fn pull(r: f64, v: f64, gear: f64) -> f64 {
    let motor_speed = -gear * v / R_P;
    gear / R_P * 0.321 * (1250.0 - motor_speed) / 1250.0 + K * (r - L_B)
}

/// The map of (p_r, q_theta, p_theta) and its duration, from the place of the mass relative to the foot. The mirror image of the
/// next step is taken, as in the spec.
fn map(z: [f64; 3], psi: f64, gear: f64) -> ([f64; 3], f64) {
    let [p_r, q, p_t] = z;
    let (sin, cos) = q.sin_cos();
    let start = [(L_B + L_S) * sin, -(L_B + L_S) * cos, p_r * sin + p_t * cos, -p_r * cos + p_t * sin];
    let rate = |_: f64, [x, y, u, w]: &[f64; 4]| {
        let r = x.hypot(*y);
        let a = pull(r, (x * u + y * w) / r, gear) / M / r;
        [*u, *w, -a * x, -a * y - G]
    };
    let (time, [x, y, u, w]) = until(start, 4e-5, &rate, &|_, y| y[0].hypot(y[1]) - L_B);
    // The new leg: the old one turned by the whole sprawl, about the mass.
    let q = x.atan2(-y) + 2.0 * psi;
    let (sin, cos) = q.sin_cos();
    ([u * sin - w * cos, -q, -(u * cos + w * sin)], time)
}

fn cases() -> [(f64, f64); 4] {
    [(20.0, 56.57), (10.0, 56.57), (20.0, 25.0), (40.0, 90.0)]
        .map(|(degrees, gear): (f64, f64)| (degrees.to_radians(), gear))
}

#[test]
fn map_and_jacobian_agree_with_cartesian_coordinates() {
    for (psi, gear) in cases() {
        let machine = Machine::new("self_exciting_rack", &[("psi", psi), ("G", gear)]);
        for z in [[-0.7, -0.35, -0.2], [-0.5, -0.1, 0.3]] {
            let found = machine.map(&z);
            let (image, duration) = map(z, psi, gear);
            let jacobian = differences(z, 1e-3, &|z| map(z, psi, gear).0);
            assert_abs_diff_eq!(found.duration, duration, epsilon = 1e-10);
            for i in 0..3 {
                assert_abs_diff_eq!(found.coordinates[i], image[i], epsilon = 1e-9);
                for j in 0..3 {
                    assert_abs_diff_eq!(found.jacobian[(i, j)], jacobian[i][j], epsilon = 1e-7);
                }
            }
        }
    }
}

/// In a gait the motor and the spring, which each touch-down stretches anew, pay for the height.
#[test]
fn work_of_motor_and_spring_is_the_height_gained() {
    for (psi, gear) in cases() {
        let machine = Machine::new("self_exciting_rack", &[("psi", psi), ("G", gear)]);
        let gait = machine.gait(None);
        let measure = |name| machine.measure(&gait.map, name);
        let motor = (measure("mean_power") - measure("regenerated_power")) * gait.map.duration;
        assert_abs_diff_eq!(motor + K * L_S * L_S / 2.0, M * G * measure("step_length"), epsilon = 1e-9);
    }
}
