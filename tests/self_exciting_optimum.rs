//! The fastest crank-slider climbers that `optimize` finds, against the reference in `crank_slider`.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
mod crank_slider;

use approx::assert_abs_diff_eq;
use common::{json, number};
use crank_slider::gait::Method;
use crank_slider::machine::Machine;
use crank_slider::measures::golden;
use serde_json::Value;

/// Spectral radius and climb speed of a machine's gait by the reference.
fn reference(machine: Machine) -> (f64, f64) {
    let method = Method::default();
    let gait = method.gait(&machine).unwrap();
    (gait.multipliers[0].norm(), method.climb_speed(&machine, &gait.map.step))
}

fn optimal(args: &[&str]) -> Value {
    let (code, best) = json(args);
    assert_eq!((code, best["status"].as_str()), (0, Some("optimal")), "{args:?}: {best:#}");
    best
}

#[test]
fn the_fastest_unbounded_gear_is_that_of_a_search_by_the_reference() {
    let speed = |gear: f64| reference(Machine { gear, ..Machine::nominal() }).1;
    let gear = golden(&speed, 15.0, 40.0, 25);
    let best = optimal(&["optimize", "self_exciting", "--problem", "fastest_unbounded"]);
    assert_abs_diff_eq!(number(&best, "/objective/value"), speed(gear), epsilon = 1e-7);
    // The optimum is flat: a hundredth in the gear ratio changes the speed by less than a millionth.
    assert_abs_diff_eq!(number(&best, "/parameters/G"), gear, epsilon = 1e-2);
    assert_abs_diff_eq!(speed(number(&best, "/parameters/G")), number(&best, "/objective/value"), epsilon = 1e-8);
}

/// The sprawl (deg) at which the reference's gait has a spectral radius of 0.95, by the secant method.
fn limit(gear: f64, stiffness: f64) -> f64 {
    let excess = |degrees: f64| reference(Machine::new(degrees, gear, stiffness)).0 - 0.95;
    let (mut a, mut b) = (22.0, 22.2);
    let (mut at_a, mut at_b) = (excess(a), excess(b));
    while at_b.abs() > 1e-12 && at_a != at_b {
        let c = b - at_b * (b - a) / (at_b - at_a);
        (a, at_a, b, at_b) = (b, at_b, c, excess(c));
    }
    b
}

/// Fastest over gear, sprawl and spring with a spectral radius of at most 0.95.
fn fastest_stable() -> Value {
    let mut args = vec!["optimize", "self_exciting", "--maximize", "climb_speed"];
    args.extend(["--vary", "G=15..120", "--vary", "psi=1..45 deg", "--vary", "k=0..200 N/m"]);
    args.extend(["--subject-to", "spectral_radius <= 0.95"]);
    optimal(&args)
}

#[test]
fn the_fastest_stable_climber_is_the_reference_s_optimum() {
    let best = fastest_stable();
    let [gear, psi, stiffness] = ["G", "psi", "k"].map(|name| number(&best, &format!("/parameters/{name}")));
    let value = number(&best, "/objective/value");
    // The stiffest spring helps, and stability is what limits the sprawl.
    assert_abs_diff_eq!(stiffness, 200.0, epsilon = 1e-5);
    assert_abs_diff_eq!(psi.to_degrees(), limit(gear, 200.0), epsilon = 1e-6);
    // Along that limit: the vertex of the parabola through the speeds at three gears.
    let speed = |gear: f64| reference(Machine::new(limit(gear, 200.0), gear, 200.0)).1;
    let (below, here, above) = (speed(gear - 0.05), speed(gear), speed(gear + 0.05));
    assert_abs_diff_eq!(here, value, epsilon = 1e-7);
    let (slope, bend) = (0.5 * (above - below), above - 2.0 * here + below);
    assert!(bend < 0.0, "{below} {here} {above}");
    let gain = -0.5 * slope * slope / bend;
    assert!(gain < 1e-7, "a gear beside {gear} climbs faster by {gain:e} m/s");
}
