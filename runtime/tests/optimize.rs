//! The optimizer against closed-form optima.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod optimize_support;

use approx::assert_relative_eq;
use gaitc_runtime::optimize::{ActiveKind, ProblemError, Sense, Status, solve};
use optimize_support::{Closed, Dual, about, expression, margin, problem, solved, spectral};

/// A stable one-dimensional map whose gait is z = sin(p0); measure: z.
fn sine() -> Closed {
    Closed::new(1, 2, 1, |z, p| {
        let next = about(z, &[p[0].sin()], &[vec![Dual::constant(0.4)]]);
        Some((next, vec![z[0]]))
    })
}

/// A section of dimension zero; the measure is p0 + p1.
fn point() -> Closed {
    Closed::new(0, 2, 1, |_, p| Some((vec![], vec![p[0] + p[1]])))
}

#[test]
fn interior_optimum() {
    let map = sine();
    let objective = expression(|m, p| m[0] * 2.0 - m[0] * m[0] - (p[1] - 0.4) * (p[1] - 0.4));
    let solution = solved(&problem(&map, Sense::Maximize, objective, &[0.2, 0.9], &[(0.0, 3.0), (-1.0, 1.0)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], std::f64::consts::FRAC_PI_2, epsilon = 2e-2); // degenerate: fourth order
    assert_relative_eq!(solution.parameters[1], 0.4, epsilon = 1e-6);
    assert_relative_eq!(solution.objective, 1.0, epsilon = 1e-6);
    assert!(solution.active.is_empty() && solution.kink.is_none());
    assert!(solution.kkt_residual <= 1e-7);
}

#[test]
fn optimum_on_a_bound() {
    let map = sine();
    let objective = expression(|m, p| m[0] - p[1] * p[1]);
    let solution = solved(&problem(&map, Sense::Maximize, objective, &[0.2, 0.5], &[(0.0, 1.0), (-1.0, 1.0)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_eq!(solution.parameters[0], 1.0);
    assert_eq!(solution.active.len(), 1);
    assert_eq!(solution.active[0].kind, ActiveKind::UpperBound(0));
    assert_relative_eq!(solution.active[0].multiplier, 1.0f64.cos(), epsilon = 1e-6);
}

#[test]
fn optimum_on_a_curved_margin() {
    let map = sine();
    let mut problem =
        problem(&map, Sense::Maximize, expression(|_, p| p[0] + p[1]), &[0.1, 0.1], &[(-2.0, 2.0), (-2.0, 2.0)]);
    problem.constraints.push(margin("inside the circle", |_, p| -(p[0] * p[0]) - p[1] * p[1] + 1.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.5f64.sqrt(), epsilon = 1e-7);
    assert_relative_eq!(solution.parameters[1], 0.5f64.sqrt(), epsilon = 1e-7);
    assert_eq!(solution.active[0].kind, ActiveKind::Constraint(0));
    // The objective is sqrt(2 (1 + e)) when the margin is relaxed by e.
    assert_relative_eq!(solution.active[0].multiplier, 0.5f64.sqrt(), epsilon = 1e-6);
    assert!(solution.message.contains("inside the circle"));
}

#[test]
fn rosenbrock_valley() {
    let map = sine();
    let objective = expression(|_, p| {
        let (a, b) = (-p[0] + 1.0, p[1] - p[0] * p[0]);
        a * a + b * b * 100.0
    });
    let solution = solved(&problem(&map, Sense::Minimize, objective, &[-1.2, 1.0], &[(-2.0, 2.0), (-2.0, 2.0)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 1.0, epsilon = 1e-4);
    assert_relative_eq!(solution.parameters[1], 1.0, epsilon = 1e-4);
}

#[test]
fn maratos_example() {
    // Full steps along the circle raise objective and violation; only the second-order correction takes them.
    let map = sine();
    let objective = expression(|_, p| (p[0] * p[0] + p[1] * p[1] - 1.0) * 2.0 - p[0]);
    let mut problem = problem(&map, Sense::Minimize, objective, &[0.6, 0.8], &[(-2.0, 2.0), (-2.0, 2.0)]);
    problem.constraints.push(margin("outside", |_, p| p[0] * p[0] + p[1] * p[1] - 1.0));
    problem.constraints.push(margin("inside", |_, p| -(p[0] * p[0]) - p[1] * p[1] + 1.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 1.0, epsilon = 1e-6);
    assert!(solution.iterations < 40, "{} iterations", solution.iterations);
}

#[test]
fn infeasible_margin_is_named() {
    let map = sine();
    let mut problem = problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1], &[(0.0, 1.0), (0.0, 1.0)]);
    problem.constraints.push(margin("p0 >= 2", |_, p| p[0] - 2.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.message.contains("`p0 >= 2`"), "{}", solution.message);
    assert!(solution.active.is_empty() && solution.confirmation.is_none());
    assert_relative_eq!(solution.parameters[0], 1.0, epsilon = 1e-6);
}

#[test]
fn constant_objective() {
    let map = sine();
    let solution = solved(&problem(
        &map,
        Sense::Maximize,
        expression(|_, _| Dual::constant(3.0)),
        &[0.1, 0.1],
        &[(0.0, 1.0), (0.0, 1.0)],
    ));
    assert_eq!(solution.status, Status::Optimal);
    assert_eq!(solution.objective, 3.0);
    assert!(solution.active.is_empty());
}

#[test]
fn fixed_range() {
    let map = sine();
    let solution =
        solved(&problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1], &[(0.3, 0.3), (0.5, 0.5)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, 0.3f64.sin(), epsilon = 1e-12);
}

#[test]
fn section_without_coordinates() {
    let map = point();
    let mut problem = problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1], &[(0.0, 1.0), (0.0, 2.0)]);
    problem.constraints.push(spectral(0.9));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.objective, 3.0, epsilon = 1e-12);
    assert_eq!(solution.spectral_radius, 0.0);
    assert_eq!(solution.active.len(), 2);
    problem.vary.iter_mut().for_each(|vary| vary.upper = vary.lower);
    assert_eq!(solved(&problem).status, Status::Optimal);
    (problem.sense, problem.objective) = (Sense::Minimize, gaitc_runtime::optimize::Objective::SpectralRadius);
    let solution = solved(&problem);
    assert_eq!((solution.status, solution.objective), (Status::Optimal, 0.0));
}

#[test]
fn start_outside_the_bounds_is_projected() {
    let map = sine();
    let solution =
        solved(&problem(&map, Sense::Minimize, expression(|_, p| p[0] + p[1]), &[7.0, 0.5], &[(0.0, 1.0), (0.0, 1.0)]));
    assert_eq!(solution.status, Status::Optimal);
    assert!(solution.notes.iter().any(|note| note.contains("`p0`")), "{:?}", solution.notes);
    assert_eq!(solution.parameters, [0.0, 0.0]);
}

#[test]
fn a_map_that_stops_in_part_of_the_ranges() {
    let map = Closed::new(1, 1, 1, |z, p| {
        (p[0].v < 0.7).then(|| (about(z, &[p[0].sin()], &[vec![Dual::constant(0.4)]]), vec![z[0]]))
    });
    // The optimum lies on this side of the edge ...
    let inside = solved(&problem(
        &map,
        Sense::Minimize,
        expression(|_, p| (p[0] - 0.69) * (p[0] - 0.69)),
        &[0.1],
        &[(0.0, 5.0)],
    ));
    assert_eq!(inside.status, Status::Optimal);
    assert_relative_eq!(inside.parameters[0], 0.69, epsilon = 1e-6);
    // ... or beyond it: there is no optimum, and the message says so.
    let beyond = solved(&problem(&map, Sense::Maximize, expression(|_, p| p[0]), &[0.1], &[(0.0, 5.0)]));
    assert_eq!(beyond.status, Status::Stalled);
    assert_relative_eq!(beyond.parameters[0], 0.7, epsilon = 1e-6);
}

#[test]
fn badly_scaled_parameters() {
    let map = Closed::new(2, 2, 1, |z, p| {
        let center = [p[0] * 1e-3, p[1] * 1e3];
        let j = [[Dual::constant(0.3), Dual::constant(2e5)], [Dual::constant(-1e-6), Dual::constant(0.2)]];
        let e = [z[0] - center[0], z[1] - center[1]];
        let next = vec![center[0] + j[0][0] * e[0] + j[0][1] * e[1], center[1] + j[1][0] * e[0] + j[1][1] * e[1]];
        let (a, b) = (z[0] * 1e-6 - 0.4, z[1] - 0.25);
        Some((next, vec![a * a + b * b]))
    });
    let solution =
        solved(&problem(&map, Sense::Minimize, expression(|m, _| m[0]), &[9e8, 9e-4], &[(0.0, 1e9), (0.0, 1e-3)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 4e8, max_relative = 1e-5);
    assert_relative_eq!(solution.parameters[1], 2.5e-4, max_relative = 1e-5);
}

#[test]
fn many_starts_reach_the_same_optimum() {
    let map = sine();
    for k in 0..12 {
        let start = [0.2 * f64::from(k), 1.0 - 0.17 * f64::from(k)];
        let objective = expression(|m, p| m[0] - (p[1] - 0.3) * (p[1] - 0.3) - m[0] * p[1]);
        let mut problem = problem(&map, Sense::Maximize, objective, &start, &[(0.0, 3.0), (-1.0, 1.0)]);
        problem.constraints.push(margin("p0 + p1 <= 1", |_, p| -p[0] - p[1] + 1.0));
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Optimal);
        assert_relative_eq!(solution.parameters[0] + solution.parameters[1], 1.0, epsilon = 1e-8);
        // Stationarity along the constraint: (1 - q) cos(p) + 2 (q - 0.3) + sin(p) = 0 with p = 1 - q.
        let (p, q) = (solution.parameters[0], solution.parameters[1]);
        assert_relative_eq!((1.0 - q) * p.cos() + 2.0 * (q - 0.3) + p.sin(), 0.0, epsilon = 1e-6);
    }
}

#[test]
fn multistart_finds_the_better_of_two_optima_and_is_deterministic() {
    let map = sine();
    let hills = || {
        expression(|_, p| {
            (-((p[0] - 0.5) * (p[0] - 0.5) * 30.0)).exp() + (-((p[0] - 2.5) * (p[0] - 2.5) * 30.0)).exp() * 2.0
        })
    };
    let mut problem = problem(&map, Sense::Maximize, hills(), &[0.4, 0.0], &[(0.0, 3.0), (0.0, 1.0)]);
    assert_relative_eq!(solved(&problem).parameters[0], 0.5, epsilon = 1e-4);
    problem.settings.starts = 12;
    let (a, b) = (solved(&problem), solved(&problem));
    assert_relative_eq!(a.parameters[0], 2.5, epsilon = 1e-4);
    assert_eq!(a.parameters, b.parameters);
    assert_eq!(a.starts, b.starts);
    assert_eq!(a.starts.run, 12);
    assert!(a.starts.converged >= 2);
}

#[test]
fn no_gait_is_a_result() {
    let map = Closed::new(1, 1, 1, |z, p| Some((vec![z[0] + p[0] * p[0] + 1.0], vec![z[0]])));
    let solution = solved(&problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1], &[(0.0, 1.0)]));
    assert_eq!(solution.status, Status::NoGait);
    assert!(solution.message.contains("no periodic gait"), "{}", solution.message);
    assert!(solution.objective.is_nan());
}

#[test]
fn unbounded_objective() {
    let map = sine();
    let pole = expression(|_, p| Dual::constant(1.0) / p[0]);
    let solution = solved(&problem(&map, Sense::Maximize, pole, &[0.5, 0.0], &[(0.0, 1.0), (0.0, 1.0)]));
    assert_eq!(solution.status, Status::Unbounded);
}

#[test]
fn a_gait_that_the_simulation_does_not_confirm_is_not_optimal() {
    // The Jacobian that this map gives is wrong: it claims to contract, but the map expands from its gait at 0.
    let map = Closed::new(1, 1, 1, |z, p| {
        let mut next = z[0] * 1.5;
        next.d[0] = 0.5 + 0.0 * p[0].v;
        Some((vec![next], vec![z[0]]))
    });
    let solution = solved(&problem(&map, Sense::Maximize, expression(|_, p| p[0]), &[0.0], &[(0.0, 1.0)]));
    assert_eq!(solution.status, Status::Unconfirmed);
    assert!(solution.message.contains("the Jacobian differs"), "{}", solution.message);
    assert!(solution.confirmation.is_none());
}

/// An expression whose derivatives have the wrong length.
struct TooShort;

impl gaitc_runtime::optimize::Expression for TooShort {
    fn evaluate(&self, _: &[f64], _: &[f64]) -> gaitc_runtime::optimize::Value {
        gaitc_runtime::optimize::Value { value: 0.0, dmeasures: vec![0.0], dparameters: vec![] }
    }
}

#[test]
fn wrong_problems_are_errors() {
    let map = sine();
    let right = || problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1], &[(0.0, 1.0), (0.0, 1.0)]);
    let mut wrong = right();
    wrong.vary[1].lower = 2.0;
    let error = solve(&wrong).unwrap_err();
    assert!(matches!(error, ProblemError::EmptyRange { name: "p1", .. }));
    assert!(error.to_string().contains("`p1`"));
    let mut wrong = right();
    wrong.vary[1].parameter = 0;
    assert_eq!(solve(&wrong).unwrap_err(), ProblemError::VariedTwice("p0"));
    let mut wrong = right();
    wrong.vary[1].parameter = 9;
    assert!(matches!(solve(&wrong).unwrap_err(), ProblemError::UnknownParameter { index: 9, count: 2 }));
    let mut wrong = right();
    wrong.vary.clear();
    assert_eq!(solve(&wrong).unwrap_err(), ProblemError::NothingToVary);
    let mut wrong = right();
    wrong.start = vec![f64::NAN];
    assert!(matches!(solve(&wrong).unwrap_err(), ProblemError::NotFinite(_)));
    let mut wrong = right();
    wrong.parameters.pop();
    assert!(matches!(solve(&wrong).unwrap_err(), ProblemError::Length { expected: 2, got: 1, .. }));
    let mut wrong = right();
    wrong.constraints.push(spectral(0.0));
    assert!(matches!(solve(&wrong).unwrap_err(), ProblemError::SpectralBound { .. }));
    let mut wrong = right();
    wrong.settings.feasibility = 0.0;
    assert!(matches!(solve(&wrong).unwrap_err(), ProblemError::Setting { setting: "feasibility", .. }));
    let mut wrong = right();
    wrong.objective = gaitc_runtime::optimize::Objective::Expression(Box::new(TooShort));
    assert!(matches!(solve(&wrong).unwrap_err(), ProblemError::Length { expected: 2, got: 0, .. }));
    let mut wrong = right();
    wrong.objective = gaitc_runtime::optimize::Objective::SpectralRadius;
    assert_eq!(solve(&wrong).unwrap_err(), ProblemError::MaximizeSpectralRadius);
}

#[test]
fn the_search_begins_elsewhere_when_there_is_no_gait_at_the_start() {
    let map = Closed::new(1, 1, 1, |z, p| {
        (p[0].v > 0.5).then(|| (about(z, &[p[0]], &[vec![Dual::constant(0.4)]]), vec![z[0]]))
    });
    let objective = expression(|_, p| (p[0] - 0.8) * (p[0] - 0.8));
    let solution = solved(&problem(&map, Sense::Minimize, objective, &[0.1], &[(0.0, 1.0)]));
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.8, epsilon = 1e-6);
    assert!(solution.notes.iter().any(|note| note.contains("began elsewhere")), "{:?}", solution.notes);
}

#[test]
fn the_edge_of_existence_of_a_gait_is_an_optimum() {
    // Gaits at +-sqrt(p0) meet in a fold at p0 = 0, where dP/dz - 1 is singular.
    let map = Closed::new(1, 1, 1, |z, p| Some((vec![z[0] + (p[0] - z[0] * z[0]) * 0.5], vec![z[0]])));
    let mut problem = problem(&map, Sense::Minimize, expression(|_, p| p[0]), &[0.49], &[(-1.0, 1.0)]);
    problem.start = vec![0.6];
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_relative_eq!(solution.parameters[0], 0.0, epsilon = 1e-8);
    assert_relative_eq!(solution.spectral_radius, 1.0, epsilon = 1e-4);
    assert!(solution.message.contains("a multiplier is 1"), "{}", solution.message);
}
