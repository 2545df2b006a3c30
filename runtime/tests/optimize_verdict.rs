//! What an optimum is said to be: its second-order condition and how it follows fixed parameters, against problems whose
//! answers are known.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod common;
mod optimize_support;

use approx::assert_relative_eq;
use common::climbers::{self, M_L};
use common::crank::{self, M_S};
use gaitc_runtime::model::ModelInfo;
use gaitc_runtime::optimize::{
    ActiveKind, Curvature, Disturbed, Objective, Problem, Route, Sense, Settings, Shape, Solution, Status, Vary,
};
use gaitc_runtime::return_map::{MapOutcome, MapRequest, Method, RequestError, ReturnMap};
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
    assert_eq!((curvature(&solution).shape, curvature(&solution).constraints), (Shape::Vertex, 1));
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
fn a_largest_value_at_both_ends_of_a_map_has_one_sensitivity() {
    // On a gait start and end are the same, and rounding decides which of them is the larger.
    let map = Closed::new(1, 2, 1, |z, p| {
        let next = about(z, &[p[0] * 0.7 + p[1] * 0.3], &[vec![c(0.4)]]);
        let largest = if next[0].v > z[0].v { next[0] } else { z[0] };
        Some((next, vec![largest]))
    });
    for start in [0.05, 0.1, 0.15, 0.2, 0.25, 0.3] {
        let objective = expression(|m, p| m[0] * 10.0 - p[0] * p[0] * 7.0);
        let mut problem = problem(&map, Sense::Maximize, objective, &[start, start], &[(-1.0, 1.0)]);
        problem.vary.truncate(1);
        let solution = solved(&problem);
        assert_eq!(solution.status, Status::Optimal);
        assert_relative_eq!(solution.parameters[0], 0.5, epsilon = 1e-6);
        assert_relative_eq!(sensitivity(&solution, 1), 3.0, epsilon = 1e-6);
        assert_eq!(curvature(&solution).shape, Shape::Strict);
    }
}

#[test]
fn without_an_optimum_there_is_no_verdict_on_it() {
    let map = sine();
    let mut problem = plane(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1, 0.0, 0.0]);
    problem.constraints.push(margin("p0 >= 3", |_, p| p[0] - 3.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.curvature.is_none() && solution.sensitivities.is_empty());
}

/// M_L varied over its sprawl, for the speed or for stability.
fn climber(map: &dyn ReturnMap) -> Problem<'_> {
    Problem {
        map,
        memory: vec![0.0],
        parameters: climbers::parameters(20.0).to_vec(),
        period: 1,
        vary: vec![Vary { parameter: 3, lower: 0.0, upper: 45f64.to_radians() }],
        sense: Sense::Maximize,
        objective: expression(|m, _| m[0]),
        constraints: vec![spectral(0.95)],
        start: vec![-20f64.to_radians(), -0.2],
        settings: Settings::default(),
    }
}

#[test]
fn a_stable_gait_stays_under_disturbances_and_another_method_agrees() {
    let confirmation = solved(&climber(&M_L)).confirmation.unwrap();
    let Some(Disturbed::Stays { maps, level, nonlinear, spread, sampling, memory }) = confirmation.disturbed else {
        panic!("{confirmation:?}")
    };
    assert_eq!(maps, 1000);
    assert!(level > 1e-7 && level <= 1e-5 && nonlinear < 1e-3);
    // 0.95 to the power of 19.5 is 1/e; half the variance's error is that of the standard deviation.
    assert_relative_eq!(memory, -1.0 / 0.95_f64.ln(), max_relative = 1e-6);
    assert!(sampling > 0.03 && sampling < 0.2 && spread < 5.0 * sampling, "{spread} {sampling}");
    let other = confirmation.independent.unwrap();
    assert_eq!(other.route, Route::Method(Method::Radau5));
    assert!(other.image < 1e-10 && other.jacobian < 1e-9 && other.multipliers < 1e-9, "{other:?}");
}

#[test]
fn an_unstable_gait_is_left_as_predicted() {
    let mut problem = climber(&M_L);
    problem.constraints.clear();
    problem.vary[0] = Vary { parameter: 3, lower: 8f64.to_radians(), upper: 12f64.to_radians() };
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert!(solution.spectral_radius > 1.0);
    let Some(Disturbed::Grows { maps, grown, expected }) = solution.confirmation.unwrap().disturbed else { panic!() };
    assert!(maps > 10 && expected > 1e3);
    assert_relative_eq!(grown, expected, max_relative = 1e-2);
}

#[test]
fn through_dead_centres_collocation_agrees() {
    let mut problem = climber(&M_S);
    problem.memory = vec![];
    problem.parameters = crank::parameters(56.57, 58.0, 20.0).to_vec();
    let psi = (0..10).find(|i| (problem.parameters[*i] - 20f64.to_radians()).abs() < 1e-12).unwrap();
    problem.vary[0] = Vary { parameter: psi, lower: 15f64.to_radians(), upper: 30f64.to_radians() };
    problem.settings.accuracy.relative = 1e-10;
    problem.settings.accuracy.absolute = 1e-11;
    problem.objective = Objective::SpectralRadius;
    problem.sense = Sense::Minimize;
    problem.constraints.clear();
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    let other = solution.confirmation.unwrap().independent.unwrap();
    assert!(matches!(other.route, Route::Collocation { .. }), "{other:?}");
    assert!(other.image < 1e-8 && other.jacobian < 1e-7, "{other:?}");
}

/// A map that says something else when it is asked by the second route.
struct TwoFaced {
    map: &'static dyn ReturnMap,
    image: f64,
    jacobian: f64,
}

impl ReturnMap for TwoFaced {
    fn info(&self) -> &'static ModelInfo {
        self.map.info()
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        let mut outcome = self.map.evaluate(request)?;
        if let (MapOutcome::Completed(map), Method::Radau5) = (&mut outcome, request.accuracy.method) {
            map.coordinates[0] += self.image;
            if map.jacobian.ncols() > 0 {
                map.jacobian[(1, 0)] += self.jacobian;
            }
        }
        Ok(outcome)
    }
}

#[test]
fn a_second_route_that_disagrees_is_named() {
    for (image, jacobian, what) in [(1e-6, 0.0, "the map differs"), (0.0, 1e-4, "the Jacobian differs")] {
        let map = TwoFaced { map: &M_L, image, jacobian };
        let solution = solved(&climber(&map));
        assert_eq!(solution.status, Status::Unconfirmed);
        assert!(solution.message.contains(what) && solution.message.contains("Radau IIA"), "{}", solution.message);
    }
    let map = TwoFaced { map: &M_L, image: 0.0, jacobian: 0.0 };
    assert_eq!(solved(&climber(&map)).status, Status::Optimal);
}

#[test]
fn a_kink_at_the_gait_shows_under_disturbances() {
    // What neither a central difference nor one disturbed start can see: the map bends at the gait itself.
    let map = Closed::new(1, 1, 1, |z, p| {
        let e = z[0] - p[0].sin();
        let bend = if e.v < 0.0 { 0.3 } else { -0.3 };
        let slope = if e.v.abs() < 1e-9 { 0.0 } else { bend };
        Some((vec![p[0].sin() + e * (0.4 + slope)], vec![z[0]]))
    });
    let solution = solved(&problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.2], &[(0.0, 1.0)]));
    assert_eq!(solution.status, Status::Unconfirmed);
    assert!(solution.message.contains("disturbed maps differ"), "{}", solution.message);
}

#[test]
fn a_map_that_bends_strongly_is_disturbed_less() {
    let map = Closed::new(1, 1, 1, |z, p| {
        let apart = z[0] - p[0];
        Some((vec![p[0] + apart * 0.5 + apart * apart * 2000.0], vec![z[0]]))
    });
    let objective = expression(|m, _| (m[0] - 1.0) * (m[0] - 1.0));
    let mut problem = problem(&map, Sense::Minimize, objective, &[0.9], &[(0.5, 1.5)]);
    problem.start = vec![0.9];
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal, "{}", solution.message);
    let Some(Disturbed::Stays { level, nonlinear, .. }) = solution.confirmation.and_then(|found| found.disturbed)
    else {
        panic!("not tested under disturbances");
    };
    assert!(level < 1e-6 && nonlinear < 1e-2, "{level} {nonlinear}");
}
