//! The prescribed-length climber through the binary, against what is known of it in closed form.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use approx::assert_abs_diff_eq;
use common::{json, number};
use serde_json::Value;

/// det D(mirror o R) = cos(2 psi) (l_b + l_s)/l_b: the flow preserves area in (q_theta, r p_theta).
fn determinant(psi: f64) -> f64 {
    (2.0 * psi).cos() * (0.5 + 0.13) / 0.5
}

fn gait(degrees: f64) -> Value {
    let (code, gait) = json(&["gait", "prescribed_length", "--set", &format!("psi={degrees} deg")]);
    assert_eq!((code, gait["status"].as_str()), (0, Some("converged")), "{gait:#}");
    gait
}

#[test]
fn determinant_of_the_return_map_is_the_closed_form() {
    for degrees in [5.0_f64, 18.0, 25.0, 35.0, 39.0, 39.5, 44.0] {
        let gait = gait(degrees);
        let entry = |i: usize, j: usize| number(&gait, &format!("/jacobian/{i}/{j}"));
        let det = entry(0, 0) * entry(1, 1) - entry(0, 1) * entry(1, 0);
        assert_abs_diff_eq!(det, determinant(degrees.to_radians()), epsilon = 1e-12);
        assert_abs_diff_eq!(number(&gait, "/duration"), 1.0 / 6.0, epsilon = 1e-13);
        assert!(number(&gait, "/residual") < 1e-10);
    }
}

#[test]
fn the_gait_turns_stable_where_the_determinant_is_one() {
    // cos(2 psi) = l_b/(l_b + l_s)
    let turn = 0.5 * (0.5_f64 / 0.63).acos().to_degrees();
    assert_abs_diff_eq!(turn, 18.7360, epsilon = 5e-5);
    for (degrees, stable) in [(turn - 1e-7, false), (turn + 1e-7, true)] {
        let gait = gait(degrees);
        assert_eq!(gait["stable"].as_bool(), Some(stable), "{gait:#}");
        assert_abs_diff_eq!(number(&gait, "/spectral_radius"), 1.0, epsilon = 1e-8);
    }
}

/// At 45 degrees the gait has p_theta = 0 to rounding, so that the sideways speed starts with either sign.
#[test]
fn a_gait_has_all_its_measures_also_where_a_switch_starts_at_zero() {
    for degrees in [1.0, 20.0, 44.5, 45.0] {
        let gait = gait(degrees);
        for measure in ["climb_speed", "lateral_speed", "peak_force", "mean_power"] {
            assert!(number(&gait, &format!("/measures/{measure}")).is_finite());
        }
    }
}

#[test]
fn multipliers_are_a_complex_pair_until_they_meet_near_39_degrees() {
    let imaginary = |degrees| number(&gait(degrees), "/multipliers/0/1");
    assert!(imaginary(39.0) > 0.0);
    assert_eq!(imaginary(39.5), 0.0);
}

#[test]
fn the_fastest_stable_climber_is_limited_by_stability() {
    let (code, best) = json(&["optimize", "prescribed_length"]);
    assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{best:#}");
    let psi = number(&best, "/parameters/psi");
    assert_abs_diff_eq!(psi, 0.5 * (0.95_f64.powi(2) * 0.5 / 0.63).acos(), epsilon = 1e-6);
    assert_abs_diff_eq!(number(&best, "/spectral_radius"), 0.95, epsilon = 1e-8);
    let active = best["active"].as_array().unwrap();
    assert_eq!(active[0]["constraint"].as_str(), Some("spectral_radius <= 0.95"));
    let price = active[0]["multiplier"].as_f64().unwrap();
    // The price is the derivative of the best speed with respect to the bound: re-solve on both sides.
    let speed = |bound: f64| {
        let bound = format!("spectral_radius <= {bound}");
        let flags = ["--maximize", "climb_speed", "--vary", "psi=0..45 deg", "--subject-to", &bound];
        number(&json(&[&["optimize", "prescribed_length"], &flags[..]].concat()).1, "/objective/value")
    };
    assert_abs_diff_eq!(price, (speed(0.951) - speed(0.949)) / 0.002, epsilon = 1e-3 * price.abs());
}

#[test]
fn the_least_spectral_radius_is_where_multipliers_meet() {
    let vary = ["--vary", "psi=5..45 deg", "--vary", "omega=2*pi*2..2*pi*4 rad/s"];
    let (code, best) = json(&[&["optimize", "prescribed_length", "--minimize", "spectral_radius"], &vary[..]].concat());
    assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{best:#}");
    // There both multipliers are the root of the determinant.
    let radius = number(&best, "/spectral_radius");
    assert_abs_diff_eq!(radius * radius, determinant(number(&best, "/parameters/psi")), epsilon = 1e-6);
    assert_abs_diff_eq!(number(&best, "/kink/multiplier/1"), 0.0, epsilon = 1e-3);
    let said = best["message"].as_str().unwrap().to_owned() + &best["notes"].to_string();
    assert!(said.contains("kink"), "{best:#}");
}
