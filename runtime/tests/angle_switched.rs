//! M_A: an event whose time depends on the state; unstable gaits at small sprawl; steps of no length.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

mod common;

use common::climbers::{M_A, parameters};
use common::{check_derivatives, request, stopped};
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{Sensitivity, StopReason};

#[test]
fn published_multipliers() {
    for (psi, multiplier) in [(5.0, 1.142), (10.0, 1.120), (15.0, 1.054)] {
        let p = parameters(psi);
        let found = [0.2, 0.5, 0.8, 1.2, 2.0].iter().any(|guess| {
            let outcome = find_gait(&M_A, &GaitRequest::new(&p, &[]), &[*guess]).unwrap();
            let Some(gait) = outcome.gait.filter(|_| outcome.status == GaitStatus::Converged) else {
                return false;
            };
            gait.coordinates[0] > 0.05 && (gait.multipliers[0].re - multiplier).abs() < 5e-4
        });
        assert!(found, "no gait with multiplier {multiplier} at {psi} deg");
    }
}

#[test]
fn derivatives_agree_with_differences() {
    let p = parameters(10.0);
    check_derivatives(&M_A, &request(&[0.9], &p, Sensitivity::None), &[0, 1, 2, 3, 4], 1e-8);
}

#[test]
fn a_step_of_no_length_is_named() {
    let p = parameters(10.0);
    for speed in [0.0, 1e-14] {
        let stop = stopped(&M_A, &request(&[speed], &p, Sensitivity::Coordinates));
        assert_eq!(stop.reason, StopReason::Zeno);
        assert_eq!(stop.time, 0.0);
    }
}
