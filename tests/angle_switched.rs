//! The angle-switched climber: the multipliers of the thesis, and where its gait ends.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::assert_abs_diff_eq;
use common::json;
use maps::{Machine, rk4, until};
use std::f64::consts::PI;

const G: f64 = 9.81;
const L_S: f64 = 0.13;
const L_B: f64 = 0.5;
const OMEGA: f64 = 6.0 * PI;

/// eqs. 6.2.4 and 6.3.5; the leg shortens until pi/omega.
fn rate(tau: f64, [q, p]: &[f64; 2]) -> [f64; 2] {
    let moving = tau <= PI / OMEGA;
    let (sin, cos) = (OMEGA * tau).sin_cos();
    let (r, v) = if moving { (L_B + L_S / 2.0 * (1.0 + cos), -L_S / 2.0 * OMEGA * sin) } else { (L_B, 0.0) };
    [p / r, -G * q.sin() - v * p / r]
}

/// The map p+ = cos(2 psi) |p_end| and its derivative, by another integrator. On the grid the shortening ends at a grid point.
fn map(p: f64, psi: f64) -> [f64; 2] {
    let h = PI / OMEGA / 1000.0;
    let image = |p: f64| {
        let (_, end) = until([psi, p], h, &rate, &|_, y| y[0] - psi);
        (2.0 * psi).cos() * end[1].abs()
    };
    let d = 1e-4;
    [image(p), (8.0 * (image(p + d) - image(p - d)) - image(p + 2.0 * d) + image(p - 2.0 * d)) / (12.0 * d)]
}

#[test]
fn multipliers_are_those_of_the_thesis() {
    for (degrees, published) in [(5.0_f64, 1.142), (10.0, 1.120), (15.0, 1.054)] {
        let psi = degrees.to_radians();
        let gait = Machine::new("angle_switched", &[("psi", psi)]).gait(None);
        assert_abs_diff_eq!(gait.multipliers[0].re, published, epsilon = 5e-4);
        assert!(gait.spectral_radius > 1.0);
        let [image, slope] = map(gait.coordinates[0], psi);
        assert_abs_diff_eq!(gait.coordinates[0], image, epsilon = 1e-9);
        assert_abs_diff_eq!(gait.multipliers[0].re, slope, epsilon = 1e-8);
    }
}

/// The speed at touch-down with which the leg just comes to stand upright: faster ones tip over. After the leg has become
/// short the energy is constant, so that the leg is then on p^2/2 - g l_b cos(q) = g l_b.
fn tipping_speed(psi: f64) -> f64 {
    let h = PI / OMEGA / 1000.0;
    let excess = |p: f64| {
        let [q, p] = (0..1000).fold([psi, p], |y, i| rk4(h * f64::from(i), y, h, &rate));
        p * p / 2.0 - G * L_B * (1.0 + q.cos())
    };
    bisect(excess, 2.0, 6.0)
}

/// A zero of a function that grows.
fn bisect(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    assert!(f(low) < 0.0 && f(high) > 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The gait swings the wider the larger the sprawl, and ends where it swings up to the vertical. There the leg comes back with
/// p^2/2 = g l_b (1 + cos(psi)), a closed form, and the next step has to begin with the tipping speed.
fn last_sprawl() -> f64 {
    let lack = |psi: f64| tipping_speed(psi) - (2.0 * psi).cos() * (2.0 * G * L_B * (1.0 + psi.cos())).sqrt();
    bisect(lack, 0.1, 0.5)
}

#[test]
fn the_gait_ends_where_the_leg_tips_over() {
    let limit = last_sprawl();
    assert!((16.0..18.0).contains(&limit.to_degrees()), "{}", limit.to_degrees());
    let psi = limit - 0.02_f64.to_radians();
    let machine = Machine::new("angle_switched", &[("psi", psi)]);
    let gait = machine.gait(Some(&[tipping_speed(psi) - 0.02]));
    assert!(gait.coordinates[0] < tipping_speed(psi));
    assert!(machine.measure(&gait.map, "swing") > 2.5);
    // Beyond it the map is below the diagonal up to the tipping speed.
    let psi = limit + 0.02_f64.to_radians();
    for i in 1..100 {
        let p = tipping_speed(psi) * f64::from(i) / 100.0;
        let image = Machine::new("angle_switched", &[("psi", psi)]).map(&[p]).coordinates[0];
        assert!(image < p, "{p} {image}");
    }
}

#[test]
fn without_a_gait_the_step_of_zero_length_is_the_reason() {
    for degrees in ["16.5", "18", "20", "30", "44"] {
        let (code, value) = json(&["gait", "angle_switched", "--set", &format!("psi={degrees} deg")]);
        assert_eq!((code, value["status"].as_str()), (2, Some("zeno")), "{value:#}");
        assert!(value["message"].as_str().unwrap().contains("a step of zero length"), "{value:#}");
        assert!(value["stopped"]["time"].as_f64().unwrap() < 1e-5);
        assert!(value["section"].is_null());
    }
    // There is nothing else at p_theta = 0, and a gait of normal length where there is one.
    let (code, value) = json(&["gait", "angle_switched", "--guess", "p_theta=0 m/s"]);
    assert_eq!((code, value["status"].as_str()), (2, Some("zeno")), "{value:#}");
}
