//! The prescribed-length climber's return map and Jacobian against another formulation by hand and another integrator:
//! diffsol's explicit Runge-Kutta method of Tsitouras.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use approx::assert_abs_diff_eq;
use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use gaitc::load::load;
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, Sensitivity};
use std::f64::consts::PI;

/// Map and Jacobian (row-major) of mirror o S_L o flow, eqs. 6.2.4, 6.3.5, 6.3.6, written by hand.
fn by_hand(z: [f64; 2], psi: f64, omega: f64) -> ([f64; 2], [f64; 4]) {
    let (l_s, l_b, g) = (0.13, 0.5, 9.81);
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(1e-12)
        .atol([1e-13; 6])
        .rhs(move |y, _p, tau, dy| {
            let r = l_b + l_s / 2.0 * (1.0 + (omega * tau).cos());
            let v = -l_s / 2.0 * omega * (omega * tau).sin();
            dy[0] = y[1] / r;
            dy[1] = -g * y[0].sin() - v * y[1] / r;
            for c in [2, 4] {
                dy[c] = y[c + 1] / r;
                dy[c + 1] = -g * y[0].cos() * y[c] - v * y[c + 1] / r;
            }
        })
        .init(move |_p, _t, y| y.copy_from_slice(&[z[0], z[1], 1.0, 0.0, 0.0, 1.0]), 6)
        .build()
        .unwrap();
    let mut solver = problem.tsit45().unwrap();
    solver.set_stop_time(PI / omega).unwrap();
    while !matches!(solver.step().unwrap(), OdeSolverStopReason::TstopReached) {}
    let state = solver.state();
    let y: Vec<f64> = (0..6).map(|i| state.y[i]).collect();
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
