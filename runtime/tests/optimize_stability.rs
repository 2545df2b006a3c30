//! The optimizer where stability limits it: bounds on the spectral radius, its kinks, its shadow price.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod optimize_support;

use approx::assert_relative_eq;
use gaitc_runtime::optimize::{ActiveKind, Bound, Constraint, ConstraintKind, Objective, Problem, Sense, Status};
use optimize_support::{Closed, Dual, Formed, about, expression, margin, problem, solved, spectral};

fn c(v: f64) -> Dual {
    Dual::constant(v)
}

/// A complex pair of magnitude p0 and angle 1 + p1; the gait moves with both.
fn pair() -> Closed {
    Closed::new(2, 2, 1, |z, p| {
        let (cos, sin) = ((p[1] + 1.0).cos() * p[0], (p[1] + 1.0).sin() * p[0]);
        let next = about(z, &[p[0].sin(), p[1] * p[0]], &[vec![cos, -sin * 3.0], vec![sin * (1.0 / 3.0), cos]]);
        Some((next, vec![z[0]]))
    })
}

/// Multipliers p0 and 0.3.
fn plus() -> Closed {
    Closed::new(2, 1, 1, |z, p| {
        Some((about(z, &[p[0], c(0.5)], &[vec![p[0], c(0.7)], vec![c(0.0), c(0.3)]]), vec![z[0]]))
    })
}

/// Multipliers -p0 and 0.3.
fn minus() -> Closed {
    Closed::new(2, 1, 1, |z, p| {
        Some((about(z, &[p[0], c(0.5)], &[vec![-p[0], c(0.7)], vec![c(0.0), c(0.3)]]), vec![z[0]]))
    })
}

/// Sum 1 and product p0: they meet at p0 = 1/4, where the spectral radius is 1/2.
fn meeting() -> Closed {
    Closed::new(2, 1, 1, |z, p| {
        Some((about(z, &[p[0], c(0.1)], &[vec![c(1.0), -p[0]], vec![c(1.0), c(0.0)]]), vec![z[0]]))
    })
}

/// A pair of magnitude p0 and a real multiplier p1.
fn three() -> Closed {
    Closed::new(3, 2, 1, |z, p| {
        let (cos, sin) = (p[0] * 0.6, p[0] * 0.8);
        let j = [vec![cos, -sin, c(0.4)], vec![sin, cos, c(-0.2)], vec![c(0.0), c(0.0), p[1]]];
        Some((about(z, &[p[0], p[1], p[0] * p[1]], &j), vec![z[2]]))
    })
}

fn bounded<'a>(map: &'a Closed, start: &[f64], bound: f64) -> Problem<'a> {
    let ranges = vec![(0.0, 2.0); start.len()];
    let mut problem = problem(map, Sense::Maximize, expression(|_, p| p[0]), start, &ranges);
    problem.constraints.push(spectral(bound));
    problem
}

#[test]
fn complex_pair_limits() {
    let map = pair();
    let solution = solved(&bounded(&map, &[0.3, 0.2], 0.95));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.95, epsilon = 1e-9);
    assert!(solution.spectral_radius <= 0.95);
    assert_eq!(solution.active[0].kind, ActiveKind::Constraint(0));
    assert_relative_eq!(solution.active[0].multiplier, 1.0, epsilon = 1e-6);
    let confirmation = solution.confirmation.unwrap();
    assert!(confirmation.maps > 50 && confirmation.remaining < 0.1);
}

#[test]
fn a_start_that_is_not_stable_enough_is_brought_back() {
    let map = pair();
    let solution = solved(&bounded(&map, &[1.7, 0.2], 0.95));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.95, epsilon = 1e-9);
}

#[test]
fn real_multipliers_limit_on_both_sides() {
    for map in [plus(), minus()] {
        let solution = solved(&bounded(&map, &[0.5], 0.9));
        assert_eq!(solution.status, Status::Optimal);
        assert_relative_eq!(solution.parameters[0], 0.9, epsilon = 1e-9);
        assert_relative_eq!(solution.active[0].multiplier, 1.0, epsilon = 1e-6);
    }
}

#[test]
fn three_dimensional_section() {
    let map = three();
    let mut problem = bounded(&map, &[0.4, 0.2], 0.8);
    problem.objective = expression(|_, p| p[0] + p[1] * 0.5);
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.8, epsilon = 1e-8);
    assert_relative_eq!(solution.parameters[1], 0.8, epsilon = 1e-8);
    assert_relative_eq!(solution.active[0].multiplier, 1.5, epsilon = 1e-5);
}

#[test]
fn one_dimensional_section() {
    let map = Closed::new(1, 1, 1, |z, p| Some((about(z, &[p[0]], &[vec![-p[0] * p[0]]]), vec![z[0]])));
    let solution = solved(&bounded(&map, &[0.5], 0.64));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.8, epsilon = 1e-9);
    assert_relative_eq!(solution.active[0].multiplier, 1.0 / 1.6, epsilon = 1e-6);
}

#[test]
fn smallest_spectral_radius_is_at_the_kink() {
    let map = meeting();
    for start in [0.05, 0.6, 0.9] {
        let solution = solved(&problem(&map, Sense::Minimize, Objective::SpectralRadius, &[start], &[(0.0, 1.0)]));
        assert_eq!(solution.status, Status::Optimal);
        assert_relative_eq!(solution.parameters[0], 0.25, epsilon = 1e-7);
        assert_relative_eq!(solution.objective, 0.5, epsilon = 1e-4);
        let kink = solution.kink.expect("multipliers meet at 1/2");
        assert_relative_eq!(kink.multiplier.re, 0.5, epsilon = 1e-3);
        assert!(solution.notes.iter().any(|note| note.contains("kink")));
    }
}

#[test]
fn bound_on_the_spectral_radius_at_a_kink() {
    // Largest product with the multipliers within 1/2: exactly where they meet, the only point that is allowed.
    let map = meeting();
    let mut problem = bounded(&map, &[0.4], 0.6);
    problem.sense = Sense::Minimize;
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    // 0.6 + 0.4 = 1
    assert_relative_eq!(solution.parameters[0], 0.24, epsilon = 1e-8);
}

#[test]
fn smallest_spectral_radius_of_a_deadbeat_map_is_zero() {
    // Multipliers +-sqrt(p0 - 0.3): not Lipschitz at the optimum.
    let map = Closed::new(2, 1, 1, |z, p| {
        Some((about(z, &[p[0], c(0.2)], &[vec![c(0.0), p[0] - 0.3], vec![c(1.0), c(0.0)]]), vec![z[0]]))
    });
    let solution = solved(&problem(&map, Sense::Minimize, Objective::SpectralRadius, &[0.9], &[(0.0, 1.0)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.3, epsilon = 1e-7);
    assert!(solution.spectral_radius < 1e-3);
    // Its digits say nothing, and that is said.
    assert!(solution.notes.iter().any(|note| note.contains("deadbeat")), "{:?}", solution.notes);
}

#[test]
fn smallest_spectral_radius_within_a_margin() {
    let map = pair();
    let mut problem = problem(&map, Sense::Minimize, Objective::SpectralRadius, &[0.9, 0.2], &[(0.0, 1.0), (0.0, 1.0)]);
    problem.constraints.push(margin("p0 >= 0.4", |_, p| p[0] - 0.4));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, 0.4, epsilon = 1e-8);
    assert_relative_eq!(solution.active[0].multiplier, 1.0, epsilon = 1e-6);
}

#[test]
fn a_bound_that_cannot_be_met_is_named() {
    let map = meeting();
    let solution = solved(&bounded(&map, &[0.7], 0.3));
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.message.contains("`spectral_radius <= 0.3`"), "{}", solution.message);
}

#[test]
fn a_bound_that_depends_on_a_parameter() {
    let map = pair();
    let mut problem = bounded(&map, &[0.3, 0.2], 1.0);
    problem.constraints[0] = Constraint {
        name: "spectral_radius <= 1 - p1/4".to_owned(),
        kind: ConstraintKind::SpectralRadius { bound: Bound::Expression(Box::new(Formed(|_, p| p[1] * -0.25 + 1.0))) },
    };
    problem.objective = expression(|_, p| p[0] + p[1] * 0.1);
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 1.0, epsilon = 1e-7);
    assert_relative_eq!(solution.parameters[1], 0.0, epsilon = 1e-7);
}

#[test]
fn shadow_price_of_stability_is_the_slope_of_resolved_problems() {
    let map = pair();
    let at = |bound: f64| {
        let mut problem = bounded(&map, &[0.3, 0.2], bound);
        problem.objective = expression(|m, p| m[0] * 2.0 + p[0] * p[1] - p[1] * p[1] * 0.7);
        solved(&problem)
    };
    let h = 1e-4;
    let slope = (at(0.9 + h).objective - at(0.9 - h).objective) / (2.0 * h);
    let solution = at(0.9);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.active[0].multiplier, slope, max_relative = 1e-5);
}

#[test]
fn random_starts_reach_the_same_stable_optimum() {
    let map = three();
    for k in 0..10 {
        let start = [0.1 + 0.17 * f64::from(k), 1.9 - 0.19 * f64::from(k)];
        let mut problem = bounded(&map, &start, 0.8);
        problem.objective = expression(|_, p| p[0] - (p[1] - 0.1) * (p[1] - 0.1));
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Optimal, "from {start:?}");
        assert_relative_eq!(solution.parameters[0], 0.8, epsilon = 1e-8);
        assert_relative_eq!(solution.parameters[1], 0.1, epsilon = 1e-6);
    }
}
