//! The fastest climbers with a crank-slider, against scans with gaits alone: the unbounded gear, one optimum from any start,
//! and the bounded problem of the spec.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use approx::assert_abs_diff_eq;
use gaitc::load::{Loaded, load};
use gaitc::problem::{Start, assemble};
use gaitc_compiler::front::flags::{parse_constraint, parse_objective, parse_quantity, parse_range};
use gaitc_compiler::ir::{Model, Problem, Sense, Vary};
use gaitc_runtime::optimize::{ActiveKind, Settings, Solution, Status, solve};
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::Accuracy;
use rayon::prelude::*;

/// Looser than by default, which is more than a speed to 1e-6 m/s needs.
fn accuracy() -> Accuracy {
    Accuracy { relative: 1e-10, absolute: 1e-11, ..Accuracy::default() }
}

fn model() -> Loaded {
    load("self_exciting", None).unwrap()
}

/// The spec's parameters with some replaced, quantities as on the command line.
fn parameters(model: &Loaded, set: &[(&str, &str)]) -> Vec<f64> {
    let mut parameters = model.parameters();
    for (name, quantity) in set {
        let index = model.parameter(name).unwrap();
        parameters[index] = parse_quantity(quantity, model.spec.parameters[index].dimension).unwrap();
    }
    parameters
}

/// The gait at some parameters, from a guess of its coordinates.
fn gait(model: &Loaded, parameters: &[f64], guess: &[f64]) -> Gait {
    let memory = model.memory();
    let request = GaitRequest { accuracy: accuracy(), tolerance: 1e-9, ..GaitRequest::new(parameters, &memory) };
    let outcome = find_gait(model.compiled, &request, guess).unwrap();
    assert_eq!(outcome.status, GaitStatus::Converged, "{parameters:?}: {}", outcome.message);
    outcome.gait.unwrap()
}

fn measure(model: &Loaded, gait: &Gait, name: &str) -> f64 {
    gait.map.measures[model.spec.measures.iter().position(|m| m.name == name).unwrap()]
}

fn optimum(model: &Loaded, spec: &Model, problem: &Problem, parameters: Vec<f64>) -> Solution {
    let settings = Settings { accuracy: accuracy(), ..Settings::default() };
    let start = Start { parameters, section: model.start(), settings };
    let solution = solve(&assemble(model, spec, problem, start)).unwrap();
    assert_eq!(solution.status, Status::Optimal, "{}", solution.message);
    solution
}

fn problem<'a>(model: &'a Loaded, name: &str) -> &'a Problem {
    model.spec.problems.iter().find(|p| p.name == name).unwrap()
}

/// Where a unimodal function has its maximum in an interval, by the golden section.
fn golden(f: impl Fn(f64) -> f64, (mut a, mut b): (f64, f64)) -> f64 {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut c, mut d) = (b - ratio * (b - a), a + ratio * (b - a));
    let (mut at_c, mut at_d) = (f(c), f(d));
    while b - a > 1e-3 {
        if at_c > at_d {
            (b, d, at_d) = (d, c, at_c);
            c = b - ratio * (b - a);
            at_c = f(c);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + ratio * (b - a);
            at_d = f(d);
        }
    }
    0.5 * (a + b)
}

#[test]
fn the_fastest_unbounded_gear_is_that_of_a_scan() {
    let model = model();
    let index = model.parameter("G").unwrap();
    let at = |gear: f64| {
        let mut parameters = model.parameters();
        parameters[index] = gear;
        parameters
    };
    // From the spec's own gear outwards, each gait the next one's guess.
    let nominal = gait(&model, &model.parameters(), &model.start());
    let mut scan: Vec<(f64, f64, Gait)> = Vec::new();
    for gears in [(15..=56).rev().collect::<Vec<_>>(), (57..=120).collect()] {
        let mut last = nominal.clone();
        for gear in gears.into_iter().map(f64::from) {
            last = gait(&model, &at(gear), last.coordinates.as_slice());
            scan.push((gear, measure(&model, &last, "climb_speed"), last.clone()));
        }
    }
    let (coarse, _, near) = scan.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    let speed = |gear: f64| measure(&model, &gait(&model, &at(gear), near.coordinates.as_slice()), "climb_speed");
    let gear = golden(speed, (coarse - 1.0, coarse + 1.0));

    let solution = optimum(&model, &model.spec, problem(&model, "fastest_unbounded"), model.parameters());
    assert_abs_diff_eq!(solution.objective, speed(gear), epsilon = 1e-6);
    assert_abs_diff_eq!(solution.parameters[index], gear, epsilon = 1e-2);
    assert!(solution.active.is_empty(), "{}", solution.message);
}

/// Fastest over gear, sprawl and spring, nothing bounded but stability.
fn fastest_stable(model: &Loaded) -> (Model, Problem) {
    let mut spec = model.spec.clone();
    let (objective, objective_dimension) = parse_objective(&mut spec, "climb_speed").unwrap();
    let constraint = parse_constraint(&mut spec, "spectral_radius <= 0.95").unwrap();
    let vary = |(name, range): (&str, &str)| {
        let parameter = model.parameter(name).unwrap();
        let (lower, upper) = parse_range(range, spec.parameters[parameter].dimension).unwrap();
        Vary { parameter, lower, upper }
    };
    let problem = Problem {
        name: String::new(),
        default: false,
        doc: String::new(),
        sense: Sense::Maximize,
        objective,
        objective_text: "climb_speed".to_owned(),
        objective_dimension,
        vary: [("G", "15..120"), ("psi", "1..45 deg"), ("k", "0..200 N/m")].into_iter().map(vary).collect(),
        robust: Vec::new(),
        constraints: vec![constraint],
        period: 1,
    };
    (spec, problem)
}

/// Uniform in [0, 1): splitmix64 (Steele, Lea, Flood 2014).
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn all_starts_come_to_the_same_optimum() {
    let model = model();
    let (spec, problem) = fastest_stable(&model);
    let mut starts = vec![model.parameters(), parameters(&model, &[("G", "25"), ("psi", "22 deg"), ("k", "150 N/m")])];
    let mut seed = 2026;
    for _ in 0..8 {
        let mut start = model.parameters();
        for vary in &problem.vary {
            start[vary.parameter] = vary.lower + uniform(&mut seed) * (vary.upper - vary.lower);
        }
        starts.push(start);
    }
    let solutions: Vec<Solution> =
        starts.into_par_iter().map(|start| optimum(&model, &spec, &problem, start)).collect();
    let first = &solutions[0];
    assert_abs_diff_eq!(first.spectral_radius, 0.95, epsilon = 1e-7);
    for solution in &solutions {
        assert_abs_diff_eq!(solution.objective, first.objective, epsilon = 1e-6);
        for vary in &problem.vary {
            let (a, b) = (solution.parameters[vary.parameter], first.parameters[vary.parameter]);
            assert_abs_diff_eq!(a, b, epsilon = 1e-3 * (vary.upper - vary.lower));
        }
    }
}

/// The bounds of `fastest_stable` as the spec states them: a measure and the most it may be.
const BOUNDS: [(&str, f64); 3] = [("peak_motor_speed", 1500.0), ("peak_pull", 200.0), ("peak_push", 100.0)];

#[test]
fn the_default_problem_is_solved_within_its_bounds_and_nothing_beside_it_is_faster() {
    let model = model();
    let bounded = problem(&model, "fastest_stable");
    assert!(bounded.default);
    let solution = optimum(&model, &model.spec, bounded, model.parameters());
    // A fresh gait at the optimum: every bound holds, and those that are active hold with equality.
    let best = gait(&model, &solution.parameters, &solution.section);
    let excess = |gait: &Gait| {
        let bounds = BOUNDS.iter().map(|(name, most)| measure(&model, gait, name) / most - 1.0);
        bounds.chain([gait.spectral_radius / 0.95 - 1.0]).collect::<Vec<f64>>()
    };
    let margins = excess(&best);
    assert!(margins.iter().all(|excess| *excess < 1e-7), "{margins:?}");
    let active = |text: &str| {
        let index = bounded.constraints.iter().position(|c| c.text.starts_with(text)).unwrap();
        solution.active.iter().any(|a| a.kind == ActiveKind::Constraint(index) && a.multiplier > 0.0)
    };
    let names = BOUNDS.map(|(name, _)| name).into_iter().chain(["spectral_radius"]);
    for (name, excess) in names.zip(&margins) {
        assert_eq!(active(name), excess.abs() < 1e-6, "{name}: {excess:e}; {}", solution.message);
    }
    for name in ["stability (`spectral_radius <= 0.95`)", "`peak_push <= 100 N`", "the upper bound of `k`"] {
        assert!(solution.message.contains(name), "{}", solution.message);
    }

    let (mut inside, speed) = (0, measure(&model, &best, "climb_speed"));
    for step in [1e-2, 1e-3] {
        for corner in 0..27 {
            let mut beside = solution.parameters.clone();
            for (vary, digit) in bounded.vary.iter().zip([corner % 3, corner / 3 % 3, corner / 9]) {
                let moved = beside[vary.parameter] + step * f64::from(digit - 1) * (vary.upper - vary.lower);
                beside[vary.parameter] = moved.clamp(vary.lower, vary.upper);
            }
            if beside == solution.parameters {
                continue;
            }
            let other = gait(&model, &beside, &solution.section);
            if excess(&other).iter().all(|excess| *excess <= 0.0) {
                inside += 1;
                assert!(measure(&model, &other, "climb_speed") < speed, "{beside:?}");
            }
        }
    }
    assert!(inside >= 6, "only {inside} of the points beside the optimum keep the bounds");
}
