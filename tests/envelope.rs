//! The sensitivity of an optimum to the parameters that are held fixed, against problems solved again with these moved.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly
#![allow(clippy::print_stdout)] // shown for failing tests only

use gaitc::load::{Loaded, load};
use gaitc::problem::{Start, assemble};
use gaitc_runtime::optimize::{Settings, Shape, Solution, Status, solve};

/// Part of its value by which a parameter is moved to both sides.
const MOVE: f64 = 1e-3;
/// Central differences leave the square of that, times what the slope bends by, and solutions their own error.
const TOLERANCE: f64 = 2e-4;

fn optimum(model: &Loaded, problem: &str, parameters: Vec<f64>, section: Vec<f64>) -> Solution {
    let problem = model.spec.problems.iter().find(|p| p.name == problem).unwrap();
    let start = Start { parameters, section, settings: Settings::default() };
    let solution = solve(&assemble(model, &model.spec, problem, start)).unwrap();
    assert_eq!(solution.status, Status::Optimal, "{}: {}", model.spec.name, solution.message);
    solution
}

/// Every fixed parameter that changes the optimum by more than rounding, or the few that are named.
fn check(name: &str, problem: &str, only: &[&str]) {
    let model = load(name, None).unwrap();
    let best = optimum(&model, problem, model.parameters(), model.start());
    assert!(best.confirmation.as_ref().unwrap().independent.is_some());
    assert_ne!(best.curvature.as_ref().unwrap().shape, Shape::Saddle);
    let share = |i: usize| best.sensitivities[i].derivative * best.parameters[best.sensitivities[i].parameter];
    let largest = share(0).abs();
    let mut compared = 0;
    for (i, sensitivity) in best.sensitivities.iter().enumerate() {
        let (parameter, value) = (sensitivity.parameter, best.parameters[sensitivity.parameter]);
        let known = &model.spec.parameters[parameter].name;
        if value == 0.0 || !(only.is_empty() || only.contains(&known.as_str())) {
            continue;
        }
        let moved = |by: f64| {
            let mut parameters = best.parameters.clone();
            parameters[parameter] = value * (1.0 + by);
            optimum(&model, problem, parameters, best.section.clone()).objective
        };
        let slope = (moved(MOVE) - moved(-MOVE)) / (2.0 * MOVE);
        println!("{name} {known}: {} {slope}", share(i));
        assert!(
            (share(i) - slope).abs() <= TOLERANCE * slope.abs().max(0.1 * largest),
            "{name}, {known}: {} by prices, {slope} by problems solved again",
            share(i)
        );
        compared += 1;
    }
    assert!(compared >= 2, "{name}: {compared} compared");
}

#[test]
fn prescribed_length() {
    check("prescribed_length", "fastest_stable", &[]);
}

#[test]
fn rimless_wheel() {
    check("rimless_wheel", "fastest", &[]);
}

#[test]
fn slip_runner() {
    check("slip_runner", "smoothest", &[]);
}

#[test]
fn template() {
    check("fg_template", "fastest", &["L_0", "hold", "z"]);
}

#[test]
fn self_exciting() {
    check("self_exciting", "fastest", &["m", "l_crank", "omega_nl", "l_coupler"]);
}
