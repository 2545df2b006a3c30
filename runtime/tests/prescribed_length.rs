//! M_L: closed forms of its return map's Jacobian, its gait, its stability.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

mod common;

use common::climbers::{M_L, parameters};
use common::{check_derivatives, completed, request};
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{Accuracy, MapRequest, Sensitivity};

#[test]
fn determinant_is_the_closed_form() {
    for psi in [5.0, 18.0, 25.0, 35.0, 39.0, 39.5, 44.0] {
        for z in [[-0.35, -0.2], [-0.6, 0.4], [0.1, -0.9]] {
            let p = parameters(psi);
            let r = completed(&M_L, &MapRequest { memory: &[0.0], ..request(&z, &p, Sensitivity::Coordinates) });
            let exact = (2.0 * p[3]).cos() * (p[1] + p[0]) / p[1];
            approx::assert_abs_diff_eq!(r.jacobian.determinant(), exact, epsilon = 1e-12);
        }
    }
}

#[test]
fn all_derivatives_agree_with_differences() {
    let p = parameters(25.0);
    let z = [-0.35, -0.2];
    let base = MapRequest { memory: &[0.0], ..request(&z, &p, Sensitivity::None) };
    check_derivatives(&M_L, &base, &[0, 1, 2, 3, 4, 5], 2e-9);
    check_derivatives(&M_L, &MapRequest { period: 2, ..base }, &[0, 1, 2, 3, 4, 5], 1e-8);
}

fn gait(psi: f64, guess: [f64; 2]) -> Gait {
    let p = parameters(psi);
    let outcome = find_gait(&M_L, &GaitRequest::new(&p, &[0.0]), &guess).unwrap();
    assert_eq!(outcome.status, GaitStatus::Converged, "{}", outcome.message);
    assert!(outcome.residual < 1e-13, "residual {}", outcome.residual);
    outcome.gait.unwrap()
}

#[test]
fn gaits_turn_stable_at_the_closed_form_sprawl() {
    // cos(2 psi) = l_b/(l_b + l_s)
    let turn = 0.5 * (0.5_f64 / 0.63).acos().to_degrees();
    approx::assert_abs_diff_eq!(turn, 18.7360, epsilon = 5e-5);
    let below = gait(turn - 1e-3, [-0.35, -0.2]);
    let above = gait(turn + 1e-3, [-0.35, -0.2]);
    assert!(below.spectral_radius > 1.0 && above.spectral_radius < 1.0);
    let at = gait(turn, [-0.35, -0.2]);
    approx::assert_abs_diff_eq!(at.spectral_radius, 1.0, epsilon = 1e-12);
    assert!(at.multipliers[0].im > 0.0);
}

#[test]
fn gait_at_25_degrees() {
    let g = gait(25.0, [-0.35, -0.2]);
    let square = g.multipliers[0].norm_sqr();
    approx::assert_abs_diff_eq!(square, (50.0_f64).to_radians().cos() * 0.63 / 0.5, epsilon = 1e-12);
    approx::assert_abs_diff_eq!(g.map.duration, 1.0 / 6.0, epsilon = 1e-15);
    let p = parameters(25.0);
    let two = GaitRequest { period: 2, ..GaitRequest::new(&p, &[0.0]) };
    let twice = find_gait(&M_L, &two, &[-0.35, -0.2]).unwrap().gait.unwrap();
    approx::assert_abs_diff_eq!(twice.spectral_radius, square, epsilon = 1e-11);
    approx::assert_abs_diff_eq!(twice.coordinates[0], g.coordinates[0], epsilon = 1e-11);
    approx::assert_abs_diff_eq!(twice.map.measures[0], g.map.measures[0], epsilon = 1e-11);
}

#[test]
fn a_far_guess_still_finds_a_gait() {
    for guess in [[0.0, 0.0], [-1.0, 1.0], [0.5, -2.0], [3.0, 0.0]] {
        let g = gait(30.0, guess);
        assert!(g.spectral_radius.is_finite());
    }
}

#[test]
fn work_stays_small() {
    let p = parameters(25.0);
    let r = completed(&M_L, &MapRequest { memory: &[0.0], ..request(&[-0.35, -0.2], &p, Sensitivity::Coordinates) });
    assert!(
        r.statistics.steps <= 15 && r.statistics.rejected <= 1 && r.statistics.evaluations <= 292,
        "{:?}",
        r.statistics
    );
}

/// `cargo test --release -- --ignored --nocapture how_long`: prints, judges nothing (machines differ).
#[test]
#[ignore = "prints timings"]
#[allow(clippy::print_stdout)] // that is its purpose
fn how_long_a_unit_takes() {
    let p = parameters(25.0);
    for relative in [1e-12, 1e-10] {
        let accuracy = Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() };
        let base = MapRequest { memory: &[0.0], accuracy, ..request(&[-0.35, -0.2], &p, Sensitivity::Coordinates) };
        let r = completed(&M_L, &base);
        let det = r.jacobian.determinant() - (2.0 * p[3]).cos() * (p[1] + p[0]) / p[1];
        let mut times: Vec<f64> = (0..2000)
            .map(|_| {
                let start = std::time::Instant::now();
                std::hint::black_box(completed(&M_L, std::hint::black_box(&base)));
                start.elapsed().as_secs_f64() * 1e6
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("{relative:e}: {} us, det error {det:e}, {:?}", times[1000], r.statistics);
    }
}

/// Without sprawl the leg hangs still: what Newton leaves of its angle can be as small as numbers get.
#[test]
fn a_gait_at_zero_has_its_measures() {
    let mut p = parameters(0.0);
    p[1] = 0.501;
    for z in [[5e-324, 3.5e-323], [-5e-324, 1e-320], [1e-310, -2e-309], [1e-200, 1e-199], [0.0, 0.0]] {
        let r = completed(&M_L, &MapRequest { memory: &[0.0], ..request(&z, &p, Sensitivity::Coordinates) });
        assert!(r.measures.iter().all(|m| m.is_finite()), "{z:?}: {}", r.measures);
    }
    for l_b in [0.5, 0.501, 0.52, 0.6, 0.7] {
        p[1] = l_b;
        let outcome = find_gait(&M_L, &GaitRequest::new(&p, &[0.0]), &[5.0_f64.to_radians(), 0.0]).unwrap();
        assert_eq!(outcome.status, GaitStatus::Converged, "{}", outcome.message);
        let gait = outcome.gait.unwrap();
        assert!(gait.coordinates.iter().all(|z| *z == 0.0 || z.abs() >= 1e-150), "{:e}", gait.coordinates);
        assert!(gait.map.measures.iter().all(|m| m.is_finite()), "{l_b}: {}", gait.map.measures);
    }
}
