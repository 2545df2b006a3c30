//! The optimizer on M_L, the prescribed-length climber: its stability limit is known in closed form.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod common;
mod optimize_support;

use approx::assert_relative_eq;
use common::climbers::{M_L, parameters};
use gaitc_runtime::optimize::{
    ActiveKind, Constraint, ConstraintKind, Objective, Problem, Sense, Settings, Status, Vary,
};
use optimize_support::{Formed, expression, solved, spectral};
use std::f64::consts::PI;

const PSI: usize = 3;
const OMEGA: usize = 4;
const CLIMB_SPEED: usize = 0;
const PEAK_FORCE: usize = 3;

fn climber(psi_degrees: f64, sense: Sense, objective: Objective) -> Problem<'static> {
    Problem {
        map: &M_L,
        memory: vec![0.0],
        parameters: parameters(psi_degrees).to_vec(),
        period: 1,
        vary: vec![Vary { parameter: PSI, lower: 0.0, upper: 45f64.to_radians() }],
        sense,
        objective,
        constraints: vec![],
        start: vec![-20f64.to_radians(), -0.2],
        settings: Settings::default(),
    }
}

/// While the multipliers are a complex pair, |lambda|^2 = cos(2 psi) (l_b + l_s)/l_b.
fn sprawl_at(spectral_radius: f64) -> f64 {
    0.5 * (spectral_radius * spectral_radius * 0.5 / 0.63).acos()
}

#[test]
fn the_fastest_stable_climber_stands_where_the_closed_form_says() {
    for start in [20.0, 30.0, 10.0] {
        let mut problem = climber(start, Sense::Maximize, expression(|m, _| m[CLIMB_SPEED]));
        problem.constraints.push(spectral(0.95));
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Optimal);
        assert_relative_eq!(solution.parameters[PSI], sprawl_at(0.95), epsilon = 1e-9);
        assert!(solution.spectral_radius <= 0.95);
        assert_eq!(solution.active[0].kind, ActiveKind::Constraint(0));
    }
}

#[test]
fn maps_of_low_accuracy_lose_digits_but_not_the_optimum() {
    for relative in [1e-10, 1e-8] {
        let mut problem = climber(25.0, Sense::Maximize, expression(|m, _| m[CLIMB_SPEED]));
        problem.constraints.push(spectral(0.95));
        problem.settings.accuracy.relative = relative;
        problem.settings.accuracy.absolute = relative;
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Optimal);
        assert_relative_eq!(solution.parameters[PSI], sprawl_at(0.95), epsilon = 30.0 * relative);
    }
}

#[test]
fn a_gait_of_two_steps_has_the_squared_multipliers() {
    let mut problem = climber(20.0, Sense::Maximize, expression(|m, _| m[CLIMB_SPEED]));
    problem.period = 2;
    problem.constraints.push(spectral(0.95 * 0.95));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[PSI], sprawl_at(0.95), epsilon = 1e-9);
}

#[test]
fn the_price_of_stability_is_the_slope_of_resolved_problems() {
    let speed = |bound: f64| {
        let mut problem = climber(20.0, Sense::Maximize, expression(|m, _| m[CLIMB_SPEED]));
        problem.constraints.push(spectral(bound));
        solved(&problem)
    };
    let h = 1e-3;
    let slope = (speed(0.95 + h).objective - speed(0.95 - h).objective) / (2.0 * h);
    assert_relative_eq!(speed(0.95).active[0].multiplier, slope, max_relative = 1e-4);
}

#[test]
fn the_most_stable_climber_is_at_the_kink() {
    for start in [25.0, 43.0] {
        let solution = solved(&climber(start, Sense::Minimize, Objective::SpectralRadius));
        assert_eq!(solution.status, Status::Optimal);
        let psi = solution.parameters[PSI];
        assert!((38f64.to_radians()..40f64.to_radians()).contains(&psi), "{} deg", psi.to_degrees());
        let kink = solution.kink.expect("the complex pair becomes real here");
        assert_relative_eq!(kink.multiplier.norm(), ((2.0 * psi).cos() * 1.26).sqrt(), epsilon = 1e-4);
    }
}

#[test]
fn the_fastest_climber_within_a_force_is_the_same_from_all_starts() {
    let mut problem = climber(20.0, Sense::Maximize, expression(|m, _| m[CLIMB_SPEED]));
    problem.vary[0].lower = 5f64.to_radians();
    problem.vary.push(Vary { parameter: OMEGA, lower: 2.0 * PI * 2.0, upper: 2.0 * PI * 4.0 });
    problem.constraints.push(Constraint {
        name: "peak_force <= 120 N".to_owned(),
        kind: ConstraintKind::Margin { margin: Box::new(Formed(|m, _| -m[PEAK_FORCE] + 120.0)), scale: 120.0 },
    });
    problem.constraints.push(spectral(0.95));
    let first = solved(&problem);
    assert_eq!(first.status, Status::Optimal);
    assert!(first.measures[PEAK_FORCE] <= 120.0);
    problem.settings.starts = 6;
    let many = solved(&problem);
    assert_eq!(many.status, Status::Optimal);
    assert_eq!(many.starts.run, 6);
    assert!(many.starts.converged >= 5, "{:?}", many.starts);
    assert_relative_eq!(many.objective, first.objective, max_relative = 1e-7);
}
