//! The rimless wheel: energy between impacts and angular momentum through them give its gait in closed form.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::json;
use gaitc_runtime::return_map::{MapOutcome, StopReason};
use maps::Machine;

const G: f64 = 9.81;

/// What an impact leaves of the angular rate.
fn mu(lambda: f64, alpha: f64) -> f64 {
    1.0 + lambda * lambda * ((2.0 * alpha).cos() - 1.0)
}

/// The rate after an impact in the gait: w^2 = mu^2 (w^2 + 4 lambda^2 g/l sin(alpha) sin(gamma)).
fn rate(lambda: f64, alpha: f64, gamma: f64) -> f64 {
    let mu = mu(lambda, alpha);
    (4.0 * lambda * lambda * G * alpha.sin() * gamma.sin() * mu * mu / (1.0 - mu * mu)).sqrt()
}

#[test]
fn fixed_point_and_multiplier_are_closed_forms() {
    for (lambda, alpha, gamma) in
        [(0.9, 15.0, 5.0), (1.0, 15.0, 3.0), (0.6, 22.5, 9.0), (1.0, 30.0, 16.0), (0.75, 8.0, 1.5)]
    {
        let (alpha, gamma) = (f64::to_radians(alpha), f64::to_radians(gamma));
        let machine = Machine::new("rimless_wheel", &[("lambda", lambda), ("alpha", alpha), ("gamma", gamma)]);
        let gait = machine.gait(None);
        assert_abs_diff_eq!(gait.coordinates[0], rate(lambda, alpha, gamma), epsilon = 1e-11);
        assert_abs_diff_eq!(gait.multipliers[0].re, mu(lambda, alpha).powi(2), epsilon = 1e-12);
        // The slowest moment is the one with the spoke upright.
        let top = rate(lambda, alpha, gamma).powi(2) - 2.0 * lambda * lambda * G * (1.0 - (alpha - gamma).cos());
        assert_relative_eq!(machine.measure(&gait.map, "least_rate"), top.sqrt(), max_relative = 1e-8);
        // Away from the gait: the map itself, and its slope mu^2 w/w+.
        let (w, mu) = (rate(lambda, alpha, gamma) * 1.3, mu(lambda, alpha));
        let next = mu * (w * w + 4.0 * lambda * lambda * G * alpha.sin() * gamma.sin()).sqrt();
        let map = machine.map(&[w]);
        assert_abs_diff_eq!(map.coordinates[0], next, epsilon = 1e-11);
        assert_abs_diff_eq!(map.jacobian[(0, 0)], mu * mu * w / next, epsilon = 1e-12);
    }
}

/// The gait exists while the wheel gets over its upright spoke. On a gentler slope it rocks to rest in ever shorter steps.
#[test]
fn on_too_gentle_a_slope_the_wheel_rocks_to_rest() {
    let (lambda, alpha) = (0.9, 15.0_f64.to_radians());
    let excess =
        |gamma: f64| rate(lambda, alpha, gamma).powi(2) - 2.0 * lambda * lambda * G * (1.0 - (alpha - gamma).cos());
    let (mut low, mut high) = (0.0, 5.0_f64.to_radians());
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    let gait = |gamma: f64| json(&["gait", "rimless_wheel", "--set", &format!("gamma={gamma} rad")]);
    let (code, value) = gait(high * 1.001);
    assert_eq!((code, value["status"].as_str()), (0, Some("converged")), "{value:#}");
    // Just below, the search may also end near the gait that is about to appear.
    assert_eq!(gait(high * 0.999).0, 2);
    let (code, value) = gait(high * 0.2);
    assert_eq!((code, value["status"].as_str()), (2, Some("zeno")), "{value:#}");
    // The run itself: the wheel rocks from spoke to spoke, back and forth.
    let machine = Machine::new("rimless_wheel", &[("gamma", high * 0.2)]);
    let MapOutcome::Completed(map) = machine.run(&[0.5], 1) else { panic!("it rocks") };
    assert_eq!(map.events.iter().map(|e| e.transition).collect::<Vec<_>>(), [1, 0]);
    let MapOutcome::Stopped(stop) = machine.run(&[0.5], 1000) else { panic!("it rocks for ever") };
    assert_eq!(stop.reason, StopReason::Zeno);
}
