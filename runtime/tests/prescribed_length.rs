//! M_L: closed forms of its return map's Jacobian, its gait, its stability.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

mod common;

use common::climbers::{M_L, parameters};
use common::{check_derivatives, completed, request};
use gaitc_runtime::return_map::{MapRequest, Sensitivity};

#[test]
fn determinant_is_the_closed_form() {
    for psi in [5.0, 18.0, 25.0, 35.0, 39.0, 39.5, 44.0] {
        for z in [[-0.35, -0.2], [-0.6, 0.4], [0.1, -0.9]] {
            let p = parameters(psi);
            let r = completed(
                &M_L,
                &MapRequest {
                    memory: &[0.0],
                    ..request(&z, &p, Sensitivity::Coordinates)
                },
            );
            let exact = (2.0 * p[3]).cos() * (p[1] + p[0]) / p[1];
            println!(
                "{psi} {:e} {:?}",
                r.jacobian.determinant() - exact,
                r.statistics
            );
            approx::assert_abs_diff_eq!(r.jacobian.determinant(), exact, epsilon = 1e-12);
        }
    }
}

#[test]
fn all_derivatives_agree_with_differences() {
    let p = parameters(25.0);
    let z = [-0.35, -0.2];
    let base = MapRequest {
        memory: &[0.0],
        ..request(&z, &p, Sensitivity::None)
    };
    check_derivatives(&M_L, &base, &[0, 1, 2, 3, 4, 5], 2e-9);
    check_derivatives(
        &M_L,
        &MapRequest { period: 2, ..base },
        &[0, 1, 2, 3, 4, 5],
        1e-8,
    );
}
