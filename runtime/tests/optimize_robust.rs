//! Robust problems against closed-form worst cases.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where
#![allow(clippy::print_stdout)] // shown for failing tests only

mod optimize_support;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use gaitc_runtime::model::ModelInfo;
use gaitc_runtime::optimize::{
    ActiveKind, Bound, Constraint, ConstraintKind, Objective, Problem, ProblemError, RobustSolution, Sense, Shape,
    Status, Uncertain, Vary, solve, solve_robust,
};
use gaitc_runtime::return_map::{MapOutcome, MapRequest, RequestError, ReturnMap};
use optimize_support::{Closed, Dual, Formed, about, expression, margin, problem, spectral};
use std::sync::Mutex;

/// p0 is the design, p1 uncertain, p2 fixed. The gait of the machine is z = p0 - p1, its multiplier 0.4; measure: z.
fn difference() -> Closed {
    Closed::new(1, 3, 1, |z, p| Some((about(z, &[p[0] - p[1]], &[vec![Dual::constant(0.4)]]), vec![z[0]])))
}

/// The multiplier is p0 p1, and the measure p0.
fn product() -> Closed {
    Closed::new(1, 3, 1, |z, p| Some((about(z, &[p[0] + p[1]], &[vec![p[0] * p[1]]]), vec![p[0]])))
}

fn design<'a>(map: &'a Closed, sense: Sense, objective: Objective, start: [f64; 3]) -> Problem<'a> {
    let vary = vec![Vary { parameter: 0, lower: -1.0, upper: 2.0 }];
    Problem { vary, ..problem(map, sense, objective, &start, &[]) }
}

fn robust(problem: Problem<'_>, lower: f64, upper: f64) -> RobustSolution {
    let solution = solve_robust(problem, &[Uncertain { parameter: 1, lower, upper }]).expect("right as stated");
    println!("{solution:#?}");
    assert_eq!(solution.solution.status, Status::Optimal, "{}", solution.solution.message);
    solution
}

#[test]
fn the_best_design_for_two_machines_lies_between_them() {
    let map = difference();
    let objective = expression(|m, p| m[0] * m[0] + p[2]);
    let found = robust(design(&map, Sense::Minimize, objective, [0.0, 0.3, 0.5]), 0.2, 1.0);
    let s = &found.solution;
    assert_relative_eq!(s.parameters[0], 0.6, epsilon = 1e-7);
    assert_relative_eq!(s.objective, 0.16 + 0.5, epsilon = 1e-7);
    assert_relative_eq!(found.nominal, 0.5, epsilon = 1e-7);
    // The nominal machine and both ends; the ends are equally bad.
    let worst: Vec<(f64, bool)> = found.scenarios.iter().map(|s| (s.values[0], s.worst)).collect();
    assert_eq!(worst, [(0.3, false), (0.2, true), (1.0, true)]);
    assert_eq!((found.checked, found.rounds), (64, 0));
    assert!(found.exceptions.is_empty() && s.active.is_empty());
    // Two rows, two unknowns (design and t) besides the gaits.
    assert_eq!(s.curvature.as_ref().unwrap().shape, Shape::Vertex);
    // The reported gait is that of a worst machine, in its own parameters.
    assert_relative_eq!(s.section[0], s.parameters[0] - s.parameters[1], epsilon = 1e-9);
    assert_relative_eq!(s.measures[0].abs(), 0.4, epsilon = 1e-7);
    // What is uncertain has no sensitivity; what is fixed has that of the worst case.
    let slopes: Vec<(usize, f64)> = s.sensitivities.iter().map(|s| (s.parameter, s.derivative)).collect();
    assert_eq!(slopes.len(), 1);
    assert_eq!(slopes[0].0, 2);
    assert_relative_eq!(slopes[0].1, 1.0, epsilon = 1e-6);
    assert!(s.confirmation.as_ref().unwrap().disturbed.is_some());
}

#[test]
fn a_constraint_holds_for_all_machines_at_the_price_of_the_worst() {
    let map = difference();
    let mut nominal = design(&map, Sense::Maximize, expression(|_, p| p[0]), [0.1, 1.0, 0.0]);
    nominal.constraints.push(margin("p0 p1 <= 1", |_, p| -(p[0] * p[1]) + 1.0));
    assert_relative_eq!(solve(&nominal).unwrap().parameters[0], 1.0, epsilon = 1e-7);
    let found = robust(nominal, 0.5, 2.0);
    assert_relative_eq!(found.solution.parameters[0], 0.5, epsilon = 1e-7);
    assert_eq!(found.solution.active.len(), 1);
    assert_eq!(found.solution.active[0].kind, ActiveKind::Constraint(0));
    assert_relative_eq!(found.solution.active[0].multiplier, 0.5, epsilon = 1e-6);
    let limits: Vec<(f64, Vec<usize>)> = found.scenarios.iter().map(|s| (s.values[0], s.limits.clone())).collect();
    assert_eq!(limits, [(1.0, vec![]), (0.5, vec![]), (2.0, vec![0])]);
}

#[test]
fn stability_holds_for_all_machines() {
    let map = product();
    let mut nominal = design(&map, Sense::Maximize, expression(|m, _| m[0]), [0.1, 1.0, 0.0]);
    nominal.constraints.push(spectral(0.9));
    let found = robust(nominal, 0.8, 1.2);
    let s = &found.solution;
    assert_relative_eq!(s.parameters[0], 0.75, epsilon = 1e-7);
    // d p0/d bound = 1/1.2
    assert_relative_eq!(s.active[0].multiplier, 1.0 / 1.2, epsilon = 1e-5);
    assert_eq!(found.scenarios.iter().filter(|s| s.limits == [0]).count(), 1);
    let radius = |s: &gaitc_runtime::optimize::Scenario| s.spectral_radius;
    assert_relative_eq!(found.scenarios.iter().map(radius).fold(0.0, f64::max), 0.9, epsilon = 1e-7);
}

#[test]
fn the_smallest_spectral_radius_of_the_worst_machine() {
    let map = Closed::new(1, 3, 1, |z, p| Some((about(z, &[p[0]], &[vec![p[0] - p[1]]]), vec![p[0]])));
    let found = robust(design(&map, Sense::Minimize, Objective::SpectralRadius, [0.5, 0.9, 0.0]), 0.8, 1.2);
    assert_relative_eq!(found.solution.parameters[0], 1.0, epsilon = 1e-6);
    assert_relative_eq!(found.solution.objective, 0.2, epsilon = 1e-6);
    assert_relative_eq!(found.solution.spectral_radius, 0.2, epsilon = 1e-6);
    let worst: Vec<bool> = found.scenarios.iter().map(|s| s.worst).collect();
    assert_eq!(worst, [false, true, true]);
}

#[test]
fn a_machine_inside_that_is_worse_than_the_corners_becomes_a_scenario() {
    let map = difference();
    // Worst at p1 = 0.4, whatever the design; the corners alone would promise 0.16.
    let objective = expression(|_, p| (p[1] - 0.4) * (p[1] - 0.4) - (p[0] - p[1]) * (p[0] - p[1]) * 0.1);
    let found = robust(design(&map, Sense::Maximize, objective, [0.0, 0.9, 0.0]), 0.0, 1.0);
    assert!(found.rounds >= 1 && found.scenarios.len() > 3 && found.exceptions.is_empty());
    // F = (q - 0.4)^2 - 0.1 (p - q)^2: the best p for q near 0.4 is q itself.
    assert_abs_diff_eq!(found.solution.objective, 0.0, epsilon = 1e-3);
    assert_abs_diff_eq!(found.solution.parameters[0], 0.4, epsilon = 5e-2);
    assert_abs_diff_eq!(found.solution.parameters[1], 0.4, epsilon = 5e-2);
}

#[test]
fn a_range_without_the_nominal_value() {
    let map = difference();
    let objective = expression(|m, _| m[0] * m[0]);
    let found = robust(design(&map, Sense::Minimize, objective, [0.0, -0.5, 0.0]), 0.2, 1.0);
    assert_relative_eq!(found.solution.parameters[0], 0.6, epsilon = 1e-7);
    assert_eq!(found.scenarios.len(), 2);
}

#[test]
fn corners_of_two_ranges() {
    let map = difference();
    let objective = expression(|m, p| m[0] * m[0] + p[2] * p[2]);
    let nominal = design(&map, Sense::Minimize, objective, [0.0, 0.3, 0.1]);
    let uncertain =
        [Uncertain { parameter: 1, lower: 0.2, upper: 1.0 }, Uncertain { parameter: 2, lower: -0.5, upper: 0.25 }];
    let found = solve_robust(nominal, &uncertain).unwrap();
    assert_eq!(found.solution.status, Status::Optimal, "{}", found.solution.message);
    assert_eq!(found.scenarios.len(), 5);
    assert_relative_eq!(found.solution.parameters[0], 0.6, epsilon = 1e-6);
    assert_relative_eq!(found.solution.objective, 0.16 + 0.25, epsilon = 1e-7);
}

#[test]
fn without_a_common_design_the_constraint_is_named() {
    let map = difference();
    let mut nominal = design(&map, Sense::Maximize, expression(|_, p| p[0]), [0.3, 0.3, 0.0]);
    nominal.constraints.push(margin("p0 close to p1", |m, _| -(m[0] * m[0]) + 0.01));
    let found = solve_robust(nominal, &[Uncertain { parameter: 1, lower: 0.0, upper: 1.0 }]).unwrap();
    assert_eq!(found.solution.status, Status::InfeasibleLocally, "{}", found.solution.message);
    assert!(found.solution.message.contains("p0 close to p1"), "{}", found.solution.message);
    // The best design lies between the machines, half a unit from each end, where 0.01 - 0.25 is left.
    let in_the_way = found.in_the_way.expect("a reason");
    assert_eq!(in_the_way.reached.constraint, 0);
    assert!([0.0, 1.0].contains(&in_the_way.values[0]) && in_the_way.limits.is_empty(), "{in_the_way:?}");
    assert_relative_eq!(in_the_way.reached.margin, -0.24, epsilon = 1e-6);
}

/// What limits the constraint in the way is named with it, and what has nothing to do with it is not.
#[test]
fn the_constraint_in_the_way_comes_with_what_limits_it() {
    let map = product();
    let mut nominal = design(&map, Sense::Maximize, expression(|m, _| m[0]), [0.5, 1.0, 0.0]);
    nominal.constraints.push(margin("p0 >= 0.6", |_, p| p[0] - 0.6));
    nominal.constraints.push(margin("p0 <= 1.9", |_, p| -p[0] + 1.9));
    nominal.constraints.push(spectral(0.9));
    let found = solve_robust(nominal, &[Uncertain { parameter: 1, lower: 0.5, upper: 2.0 }]).unwrap();
    assert_eq!(found.solution.status, Status::InfeasibleLocally, "{}", found.solution.message);
    let in_the_way = found.in_the_way.expect("a reason");
    assert_eq!((in_the_way.values.as_slice(), in_the_way.limits.as_slice()), (&[2.0][..], &[0][..]), "{in_the_way:?}");
    assert_eq!(in_the_way.reached.constraint, 2);
    // p0 = 0.6 at p1 = 2.
    assert_relative_eq!(in_the_way.reached.spectral_radius, 1.2, epsilon = 1e-6);
}

/// The nominal optimum is feasible for no other machine; the way to a common design leads through both constraints.
#[test]
fn a_common_design_far_from_the_nominal_one_is_found() {
    let map = difference();
    let mut nominal = design(&map, Sense::Maximize, expression(|_, p| p[0]), [1.5, 0.0, 0.0]);
    nominal.constraints.push(margin("p0 <= 2 - 2 p1", |_, p| -p[0] - p[1] * 2.0 + 2.0));
    nominal.constraints.push(margin("(p0 + p1) p1 <= 0.5", |_, p| -((p[0] + p[1]) * p[1]) + 0.5));
    let found = robust(nominal, 0.0, 1.0);
    assert_relative_eq!(found.solution.parameters[0], -0.5, epsilon = 1e-7);
    assert!(found.in_the_way.is_none());
}

/// Between the corners lies a range of machines without a gait: the worst case of the corners is not that of all.
#[test]
fn machines_without_a_gait_inside_the_box_leave_the_answer_unconfirmed() {
    let map = Closed::new(1, 3, 1, |z, p| {
        let gap = (p[1].v - 0.5).abs() < 0.05;
        (!gap).then(|| (about(z, &[p[0] - p[1]], &[vec![Dual::constant(0.4)]]), vec![z[0]]))
    });
    let problem = design(&map, Sense::Minimize, expression(|m, _| m[0] * m[0]), [0.0, 0.3, 0.0]);
    let found = solve_robust(problem, &[Uncertain { parameter: 1, lower: 0.2, upper: 1.0 }]).unwrap();
    assert_relative_eq!(found.solution.objective, 0.16, epsilon = 1e-7);
    assert_eq!(found.solution.status, Status::Unconfirmed, "{}", found.solution.message);
    assert!(!found.exceptions.is_empty());
    assert!(found.exceptions.iter().all(|e| (e.values[0] - 0.5).abs() < 0.05), "{:?}", found.exceptions);
    assert!(found.solution.message.contains("`p1` = 0."), "{}", found.solution.message);
}

/// A map without a step for machines beyond p1 = 0.8, which notes how long its runs there would be allowed to take.
struct Endless {
    closed: Closed,
    longest: Mutex<f64>,
}

impl ReturnMap for Endless {
    fn info(&self) -> &'static ModelInfo {
        self.closed.info()
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        if request.parameters[1] > 0.8 {
            let mut longest = self.longest.lock().unwrap();
            *longest = longest.max(request.accuracy.time_limit);
        }
        self.closed.evaluate(request)
    }
}

/// Where no gait leads to a machine, that machine is named, nothing else is shown as if it were the answer, and the runs from which no
/// step ends were given up long before the time limit of a single map.
#[test]
fn a_machine_without_a_gait_is_named_early() {
    let closed = Closed::new(1, 3, 1, |z, p| {
        (p[1].v <= 0.8).then(|| (about(z, &[p[0] - p[1]], &[vec![Dual::constant(0.4)]]), vec![z[0]]))
    });
    let map = Endless { closed, longest: Mutex::new(0.0) };
    let nominal = design(&map.closed, Sense::Minimize, expression(|m, _| m[0] * m[0]), [0.0, 0.3, 0.0]);
    let nominal = Problem { map: &map, ..nominal };
    let limit = nominal.settings.accuracy.time_limit;
    let found = solve_robust(nominal, &[Uncertain { parameter: 1, lower: 0.2, upper: 1.0 }]).unwrap();
    assert_eq!(found.solution.status, Status::NoGait, "{}", found.solution.message);
    assert_eq!(found.lost.expect("a machine").values, [1.0]);
    assert!(found.solution.message.contains("cannot be followed to `p1` = 1"), "{}", found.solution.message);
    assert!(found.solution.measures.is_empty() && found.solution.objective.is_nan(), "{:?}", found.solution);
    assert_abs_diff_eq!(found.nominal, 0.0, epsilon = 1e-9);
    // Its gaits take a second.
    let longest = *map.longest.lock().unwrap();
    assert!(longest > 0.0 && longest <= 20.0 && longest < limit, "{longest} s");
}

#[test]
fn what_is_wrong_is_said() {
    let map = difference();
    let nominal = || design(&map, Sense::Minimize, expression(|m, _| m[0] * m[0]), [0.0, 0.3, 0.0]);
    let refused = |problem: Problem<'_>, uncertain: &[Uncertain]| solve_robust(problem, uncertain).unwrap_err();
    let range = |parameter, lower, upper| Uncertain { parameter, lower, upper };
    assert_eq!(refused(nominal(), &[]), ProblemError::NothingUncertain);
    assert_eq!(refused(nominal(), &[range(0, 0.0, 1.0)]), ProblemError::VariedAndUncertain("p0"));
    let twice = [range(1, 0.0, 1.0), range(1, 0.0, 2.0)];
    assert_eq!(refused(nominal(), &twice), ProblemError::UncertainTwice("p1"));
    let empty = ProblemError::EmptyRange { name: "p1", lower: 1.0, upper: 0.0 };
    assert_eq!(refused(nominal(), &[range(1, 1.0, 0.0)]), empty);
    assert_eq!(refused(nominal(), &[range(7, 0.0, 1.0)]), ProblemError::UnknownParameter { index: 7, count: 3 });
    let mut bounded = nominal();
    bounded.constraints.push(Constraint {
        name: "rho".to_owned(),
        kind: ConstraintKind::SpectralRadius { bound: Bound::Expression(Box::new(Formed(|_, p| p[1]))) },
    });
    assert_eq!(refused(bounded, &[range(1, 0.0, 1.0)]), ProblemError::RobustBound("rho".to_owned()));
}
