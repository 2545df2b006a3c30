//! What an optimum is said to be: its second-order condition and how it follows fixed parameters, against problems whose
//! answers are known.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod optimize_support;

use approx::assert_relative_eq;
use gaitc_runtime::optimize::{ActiveKind, Curvature, Objective, Problem, Sense, Shape, Solution, Status};
use optimize_support::{Closed, Dual, about, expression, margin, problem, solved, spectral};

fn c(v: f64) -> Dual {
    Dual::constant(v)
}

/// A stable gait at z = sin(p0), four parameters.
fn sine() -> Closed {
    Closed::new(1, 4, 1, |z, p| Some((about(z, &[p[0].sin()], &[vec![c(0.4)]]), vec![z[0]])))
}

/// A complex pair of magnitude p0 p2; the gait moves with p0 and p1.
fn pair() -> Closed {
    Closed::new(2, 3, 1, |z, p| {
        let (cos, sin) = (p[0] * p[2] * 0.6, p[0] * p[2] * 0.8);
        let next = about(z, &[p[0].sin(), p[1] * p[0]], &[vec![cos, -sin * 3.0], vec![sin * (1.0 / 3.0), cos]]);
        Some((next, vec![z[0]]))
    })
}

/// Multipliers of sum p1 and product p0 p1: they meet where 4 p0 = p1, at p1/2.
fn meeting() -> Closed {
    Closed::new(2, 2, 1, |z, p| {
        Some((about(z, &[p[0], c(0.1)], &[vec![p[1], -(p[0] * p[1])], vec![c(1.0), c(0.0)]]), vec![z[0]]))
    })
}

/// The first two parameters vary between -2 and 2.
fn plane<'a>(map: &'a Closed, sense: Sense, objective: Objective, start: &[f64]) -> Problem<'a> {
    let mut problem = problem(map, sense, objective, start, &[(-2.0, 2.0), (-2.0, 2.0)]);
    problem.vary.truncate(2);
    problem
}

fn curvature(solution: &Solution) -> &Curvature {
    solution.curvature.as_ref().unwrap()
}

fn sensitivity(solution: &Solution, parameter: usize) -> f64 {
    solution.sensitivities.iter().find(|s| s.parameter == parameter).unwrap().derivative
}

#[test]
fn a_bowl_is_strict_and_its_eigenvalues_are_those_of_the_objective() {
    // Without coordinates the unknowns are the two parameters alone.
    let map = Closed::new(0, 3, 1, |_, p| Some((vec![], vec![p[0]])));
    let objective = expression(|_, p| p[0] * p[0] + p[1] * p[1] * 3.0 + p[0] * p[1] * p[2]);
    let solution = solved(&plane(&map, Sense::Minimize, objective, &[1.0, 0.7, 0.5]));
    assert_eq!(solution.status, Status::Optimal);
    let found = curvature(&solution);
    assert_eq!((found.shape, found.directions, found.constraints, found.weak), (Shape::Strict, 2, 0, 0));
    assert!(found.along.is_empty());
    // In units of ranges (4 each) and of the largest slope at the start: 4 (6 * 0.7 + 0.5 * 1) = 18.8.
    let exact = 16.0 * (4.0 - (4.0_f64 + 0.25).sqrt()) / 18.8;
    assert_relative_eq!(found.smallest, exact, max_relative = 1e-6);
    assert!(found.error < 1e-6);
}

#[test]
fn a_maximum_on_a_curved_margin_is_strict() {
    let map = sine();
    let mut problem = plane(&map, Sense::Maximize, expression(|_, p| p[0] + p[1]), &[0.1, 0.1, 1.0, 1.0]);
    problem.constraints.push(margin("inside", |_, p| p[2] - p[0] * p[0] - p[1] * p[1]));
    let solution = solved(&problem);
    let found = curvature(&solution);
    assert_eq!((found.shape, found.directions, found.constraints), (Shape::Strict, 1, 1));
    // The best sum is sqrt(2 p2); p3 matters to nothing.
    assert_relative_eq!(sensitivity(&solution, 2), 0.5_f64.sqrt(), epsilon = 1e-6);
    assert_eq!(sensitivity(&solution, 3), 0.0);
    assert_eq!(solution.sensitivities[0].parameter, 2);
}

#[test]
fn as_many_constraints_as_parameters_make_a_vertex() {
    let map = pair();
    let mut problem =
        problem(&map, Sense::Maximize, expression(|_, p| p[0] + p[1]), &[0.3, 0.2, 1.1], &[(0.0, 2.0), (0.0, 1.0)]);
    problem.constraints.push(spectral(0.95));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    let found = curvature(&solution);
    assert_eq!((found.shape, found.directions, found.constraints), (Shape::Vertex, 0, 2));
    assert!(solution.active.iter().any(|a| a.kind == ActiveKind::UpperBound(1)));
    // p0 = 0.95/p2.
    assert_relative_eq!(sensitivity(&solution, 2), -0.95 / 1.1 / 1.1, epsilon = 1e-6);
}

#[test]
fn what_does_not_matter_is_flat_and_named() {
    let map = pair();
    let mut problem =
        problem(&map, Sense::Maximize, expression(|_, p| p[0]), &[0.3, 0.2, 1.0], &[(0.0, 2.0), (0.0, 1.0)]);
    problem.constraints.push(spectral(0.95));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    let found = curvature(&solution);
    assert_eq!((found.shape, found.directions), (Shape::Flat, 1));
    assert_eq!(found.along, [1]);
}

#[test]
fn a_constant_is_flat_everywhere() {
    let map = sine();
    let solution = solved(&plane(&map, Sense::Maximize, expression(|_, _| c(3.0)), &[0.1, 0.1, 0.0, 0.0]));
    assert_eq!(solution.status, Status::Optimal);
    assert_eq!((curvature(&solution).shape, curvature(&solution).directions), (Shape::Flat, 2));
    assert!(solution.sensitivities.iter().all(|s| s.derivative == 0.0));
}

#[test]
fn a_saddle_is_left() {
    // At p1 = 0 there is no slope along p1: first derivatives alone end there, at 0 instead of -1/4.
    let map = sine();
    let objective = expression(|_, p| p[0] * p[0] - p[1] * p[1] + p[1] * p[1] * p[1] * p[1]);
    let solution = solved(&plane(&map, Sense::Minimize, objective, &[0.8, 0.0, 0.0, 0.0]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, -0.25, epsilon = 1e-9);
    assert_eq!(curvature(&solution).shape, Shape::Strict);
}

#[test]
fn a_saddle_on_a_constraint_is_left() {
    // Farthest from (0.3, 0) on the unit circle, begun at the nearest point's opposite: (1, 0) is a local maximum no more
    // than (-1, 0) is: along the circle the distance falls there.
    let map = sine();
    let objective = expression(|_, p| (p[0] + 0.3) * (p[0] + 0.3) + p[1] * p[1]);
    let mut problem = plane(&map, Sense::Maximize, objective, &[-1.0, 0.0, 0.0, 0.0]);
    problem.constraints.push(margin("inside", |_, p| -(p[0] * p[0]) - p[1] * p[1] + 1.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, 1.69, epsilon = 1e-7);
}

#[test]
fn a_saddle_without_an_optimum_beside_it_is_no_optimum() {
    let map = Closed::new(1, 2, 1, |z, p| {
        (p[1].v.abs() < 0.3).then(|| (about(z, &[p[0].sin()], &[vec![c(0.4)]]), vec![z[0]]))
    });
    let objective = expression(|_, p| p[0] * p[0] - p[1] * p[1]);
    let solution = solved(&problem(&map, Sense::Minimize, objective, &[0.8, 0.0], &[(-2.0, 2.0), (-2.0, 2.0)]));
    assert_eq!(solution.status, Status::Saddle);
    assert_eq!(curvature(&solution).along, [1]);
    assert!(solution.message.contains("along `p1`"), "{}", solution.message);
    assert!(solution.confirmation.is_none());
}

#[test]
fn constraints_without_a_price_are_half_spaces() {
    // Indefinite, but positive where p0 and p1 are not negative, which is all that their bounds allow.
    let map = sine();
    let objective = expression(|_, p| p[0] * p[0] + p[0] * p[1] * 3.0 + p[1] * p[1]);
    let mut bounded = plane(&map, Sense::Minimize, objective, &[0.0, 0.0, 0.0, 0.0]);
    bounded.vary.iter_mut().for_each(|vary| vary.lower = 0.0);
    let solution = solved(&bounded);
    assert_eq!(solution.status, Status::Optimal);
    let found = curvature(&solution);
    assert_eq!((found.shape, found.constraints, found.weak), (Shape::Strict, 0, 2));
    // With the sign of the mixed term turned, it falls into the quadrant.
    let objective = expression(|_, p| p[0] * p[0] - p[0] * p[1] * 3.0 + p[1] * p[1]);
    let mut bounded = plane(&map, Sense::Minimize, objective, &[0.0, 0.0, 0.0, 0.0]);
    bounded.vary.iter_mut().for_each(|vary| vary.lower = 0.0);
    let solution = solved(&bounded);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, -4.0, epsilon = 1e-6);
    assert_ne!(curvature(&solution).shape, Shape::Saddle);
}

#[test]
fn the_least_spectral_radius_is_a_vertex_where_multipliers_meet() {
    let map = meeting();
    let mut problem = problem(&map, Sense::Minimize, Objective::SpectralRadius, &[0.1, 0.9], &[(0.0, 1.0)]);
    problem.vary.truncate(1);
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, 0.45, epsilon = 1e-5);
    assert_eq!((curvature(&solution).shape, curvature(&solution).constraints), (Shape::Vertex, 2));
    assert_relative_eq!(sensitivity(&solution, 1), 0.5, epsilon = 1e-4);
}

#[test]
fn a_parameter_without_a_derivative_is_left_out() {
    let map = Closed::new(1, 3, 1, |z, p| {
        let odd = Dual { v: p[2].v, d: p[2].d.map(|d| if d == 0.0 { 0.0 } else { f64::NAN }) };
        Some((about(z, &[p[0] + odd + p[1] * 2.0], &[vec![c(0.4)]]), vec![z[0]]))
    });
    let mut problem = problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.2, 0.3], &[(0.0, 1.0)]);
    problem.vary.truncate(1);
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_eq!(solution.sensitivities.len(), 1);
    assert_relative_eq!(sensitivity(&solution, 1), 2.0, epsilon = 1e-9);
}

#[test]
fn without_an_optimum_there_is_no_verdict_on_it() {
    let map = sine();
    let mut problem = plane(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1, 0.0, 0.0]);
    problem.constraints.push(margin("p0 >= 3", |_, p| p[0] - 3.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::InfeasibleLocally);
    assert!(solution.curvature.is_none() && solution.sensitivities.is_empty());
}
