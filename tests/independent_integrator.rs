//! The prescribed-length climber's return map and Jacobian against another formulation by hand and another integrator:
//! DOP853 of the crate differential-equations, whose code shares nothing with ours.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use approx::assert_abs_diff_eq;
use differential_equations::methods::ExplicitRungeKutta;
use differential_equations::prelude::{IVP, ODE};
use gaitc::load::load;
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, Sensitivity};
use std::f64::consts::PI;

/// Angle and tangential velocity, then two columns of their variations.
struct Swing {
    omega: f64,
}

impl ODE<f64, [f64; 6]> for Swing {
    fn diff(&self, tau: f64, y: &[f64; 6], dy: &mut [f64; 6]) {
        let (l_s, l_b, g) = (0.13, 0.5, 9.81);
        let r = l_b + l_s / 2.0 * (1.0 + (self.omega * tau).cos());
        let v = -l_s / 2.0 * self.omega * (self.omega * tau).sin();
        dy[0] = y[1] / r;
        dy[1] = -g * y[0].sin() - v * y[1] / r;
        for c in [2, 4] {
            dy[c] = y[c + 1] / r;
            dy[c + 1] = -g * y[0].cos() * y[c] - v * y[c + 1] / r;
        }
    }
}

/// Map and Jacobian (row-major) of mirror o S_L o flow, eqs. 6.2.4, 6.3.5, 6.3.6, written by hand.
fn by_hand(z: [f64; 2], psi: f64, omega: f64) -> ([f64; 2], [f64; 4]) {
    let swing = Swing { omega };
    let method = ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-14);
    let solution = IVP::ode(&swing, 0.0, PI / omega, [z[0], z[1], 1.0, 0.0, 0.0, 1.0]).method(method).solve().unwrap();
    let y = *solution.y.last().unwrap();
    let shrink = (2.0 * psi).cos();
    ([-(y[0] + 2.0 * psi), -shrink * y[1]], [-y[2], -y[4], -shrink * y[3], -shrink * y[5]])
}

#[test]
fn map_and_jacobian_agree_with_another_integrator() {
    let loaded = load("prescribed_length", None).unwrap();
    let (i, j) = (loaded.parameter("psi").unwrap(), loaded.parameter("omega").unwrap());
    let cases =
        [(20.0_f64, 3.0, [-0.35, -0.25]), (39.5, 2.0, [-0.85, -0.3]), (8.0, 4.0, [0.2, 0.9]), (25.0, 2.5, [-0.1, 0.4])];
    for (degrees, hertz, z) in cases {
        let (psi, omega) = (degrees.to_radians(), 2.0 * PI * hertz);
        let mut parameters = loaded.parameters();
        (parameters[i], parameters[j]) = (psi, omega);
        let outcome = loaded.compiled.evaluate(&MapRequest {
            coordinates: &z,
            parameters: &parameters,
            memory: &loaded.memory(),
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: Accuracy::default(),
        });
        let MapOutcome::Completed(map) = outcome.unwrap() else { panic!("the step ends") };
        let (expected, jacobian) = by_hand(z, psi, omega);
        for r in 0..2 {
            assert_abs_diff_eq!(map.coordinates[r], expected[r], epsilon = 1e-9);
            for c in 0..2 {
                assert_abs_diff_eq!(map.jacobian[(r, c)], jacobian[2 * r + c], epsilon = 1e-9);
            }
        }
    }
}

/// Measures of one step by the classical Runge-Kutta method and the trapezoidal rule on a fine grid.
/// In the order climb speed, lateral speed, peak force, mean positive power.
fn measures_by_hand(z: [f64; 2], omega: f64) -> [f64; 4] {
    let (l_s, l_b, g, m) = (0.13, 0.5, 9.81, 2.6);
    let leg = |tau: f64| {
        let (sin, cos) = (omega * tau).sin_cos();
        (l_b + l_s / 2.0 * (1.0 + cos), -l_s / 2.0 * omega * sin, -l_s / 2.0 * omega * omega * cos)
    };
    let rate = |tau: f64, [q, p]: [f64; 2]| {
        let (r, v, _) = leg(tau);
        [p / r, -g * q.sin() - v * p / r]
    };
    let outputs = |tau: f64, [q, p]: [f64; 2]| {
        let (r, v, a) = leg(tau);
        let rho = -m * a + m * g * q.cos() + m * p * p / r;
        [-v * q.cos() + p * q.sin(), (v * q.sin() + p * q.cos()).abs(), rho.abs(), (-rho * v).max(0.0)]
    };
    let along = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
    let steps = 200_000;
    let h = PI / omega / f64::from(steps);
    let (mut y, mut result) = (z, [0.0_f64; 4]);
    for i in 0..steps {
        let tau = h * f64::from(i);
        let k1 = rate(tau, y);
        let k2 = rate(tau + h / 2.0, along(y, k1, h / 2.0));
        let k3 = rate(tau + h / 2.0, along(y, k2, h / 2.0));
        let k4 = rate(tau + h, along(y, k3, h));
        let next = std::array::from_fn(|j| y[j] + h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]));
        let (a, b) = (outputs(tau, y), outputs(tau + h, next));
        for j in [0, 1, 3] {
            result[j] += (a[j] + b[j]) / 2.0 / f64::from(steps);
        }
        result[2] = result[2].max(a[2]).max(b[2]);
        y = next;
    }
    result
}

#[test]
fn measures_agree_with_a_fixed_grid() {
    let loaded = load("prescribed_length", None).unwrap();
    let i = loaded.parameter("omega").unwrap();
    for (hertz, z) in [(3.0, [-0.35, -0.25]), (2.0, [-0.85, -0.3]), (4.0, [0.2, 0.9])] {
        let mut parameters = loaded.parameters();
        parameters[i] = 2.0 * PI * hertz;
        let outcome = loaded.compiled.evaluate(&MapRequest {
            coordinates: &z,
            parameters: &parameters,
            memory: &loaded.memory(),
            period: 1,
            sensitivity: Sensitivity::None,
            measures: true,
            accuracy: Accuracy::default(),
        });
        let MapOutcome::Completed(map) = outcome.unwrap() else { panic!("the step ends") };
        let expected = measures_by_hand(z, parameters[i]);
        for (name, expected) in ["climb_speed", "lateral_speed", "peak_force", "mean_power"].iter().zip(expected) {
            let j = loaded.spec.measures.iter().position(|m| m.name == *name).unwrap();
            assert_abs_diff_eq!(map.measures[j], expected, epsilon = 1e-8 * expected.abs().max(1.0));
        }
    }
}
