//! The spring-mass runner: conservative, symmetric in time, and self-stable where that was published.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod maps;

use approx::assert_abs_diff_eq;
use common::json;
use maps::{Machine, until};

const G: f64 = 9.81;

/// The next apex height and the time until then, in polar coordinates about the foot during stance and closed form in flight.
fn map(machine: &Machine, y: f64) -> (f64, f64) {
    let value = |name| machine.value(name);
    let (rest, alpha, stiffness) = (value("l_0"), value("alpha"), value("k") / value("m"));
    let speed = (value("speed").powi(2) + 2.0 * G * (rest - y)).sqrt();
    let fall = y - rest * alpha.sin();
    let sinks = -(2.0 * G * fall).sqrt();
    // The leg's angle is counted from the upward vertical, positive forward.
    let angle = alpha - std::f64::consts::FRAC_PI_2;
    let (sin, cos) = angle.sin_cos();
    let start = [rest, angle, speed * sin + sinks * cos, (speed * cos - sinks * sin) / rest];
    let rate = |_: f64, [r, q, v, w]: &[f64; 4]| {
        [*v, *w, r * w * w - G * q.cos() + stiffness * (rest - r), (G * q.sin() - 2.0 * v * w) / r]
    };
    let (stance, [r, q, v, w]) = until(start, 2e-5, &rate, &|_, s| rest - s[0]);
    let (sin, cos) = q.sin_cos();
    let rises = v * cos - r * w * sin;
    (r * cos + rises * rises / (2.0 * G), -sinks / G + stance + rises / G)
}

fn cases() -> [Machine; 3] {
    [&[][..], &[("alpha", 1.1), ("k", 13_000.0)], &[("speed", 6.0), ("alpha", 1.1), ("k", 18_000.0)]]
        .map(|set| Machine::new("slip_runner", set))
}

#[test]
fn map_and_multiplier_agree_with_polar_coordinates() {
    for machine in cases() {
        let gait = machine.gait(None);
        let y = gait.coordinates[0];
        for y in [y, y + 0.01] {
            let found = machine.map(&[y]);
            let (image, duration) = map(&machine, y);
            assert_abs_diff_eq!(found.coordinates[0], image, epsilon = 1e-10);
            assert_abs_diff_eq!(found.duration, duration, epsilon = 1e-10);
            let d = 1e-4;
            let at = |d: f64| map(&machine, y + d).0;
            let slope = (8.0 * (at(d) - at(-d)) - at(2.0 * d) + at(-2.0 * d)) / (12.0 * d);
            assert_abs_diff_eq!(found.jacobian[(0, 0)], slope, epsilon = 1e-7);
        }
        assert!(gait.spectral_radius < 1.0, "{}", gait.spectral_radius);
    }
}

#[test]
fn energy_is_conserved_to_rounding() {
    for machine in cases() {
        for y in [0.95, 1.0, 1.05] {
            assert_abs_diff_eq!(machine.measure(&machine.map(&[y]), "energy_change"), 0.0, epsilon = 1e-13);
        }
    }
}

#[test]
fn the_gait_is_symmetric_in_time() {
    for machine in cases() {
        let gait = machine.gait(None);
        let [touch_down, lift_off, apex] = [0, 1, 2].map(|i| gait.map.events[i]);
        assert_eq!([touch_down, lift_off, apex].map(|e| e.transition), [0, 1, 2]);
        assert_abs_diff_eq!(touch_down.time, gait.map.duration - lift_off.time, epsilon = 1e-10);
        assert_abs_diff_eq!(apex.time, gait.map.duration, epsilon = 1e-15);
        let flight = (2.0 / G * (gait.coordinates[0] - machine.value("l_0") * machine.value("alpha").sin())).sqrt();
        assert_abs_diff_eq!(touch_down.time, flight, epsilon = 1e-12);
    }
}

/// A slow runner bounces back from its leg: the apex repeats in height, and the mirrored speed is what comes next.
#[test]
fn a_bounce_is_no_gait() {
    let (code, gait) = json(&["gait", "slip_runner", "--set", "speed=3 m/s"]);
    assert_eq!((code, gait["status"].as_str()), (2, Some("not_closed")), "{gait:#}");
    let message = gait["message"].as_str().unwrap();
    assert!(message.contains("`v_x` begins at 1.51") && message.contains("ends at -1.51"), "{message}");
    assert!(gait["multipliers"].is_null());
    let (code, best) = json(&[
        "optimize",
        "slip_runner",
        "--set",
        "speed=4 m/s",
        "--maximize",
        "step_frequency",
        "--vary",
        "k=15..25 kN/m",
    ]);
    // The search leaves the bounce for a runner that runs.
    assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{best:#}");
    assert!(best["measures"]["least_speed"].as_f64().unwrap() > 1.0, "{best:#}");
}
