//! Many starts, restoration, conflicts, interruption and odd problems, on closed-form maps.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod optimize_support;

use approx::assert_relative_eq;
use gaitc_runtime::model::ModelInfo;
use gaitc_runtime::optimize::{
    Constraint, ConstraintKind, Expression, Interrupt, Objective, Problem, Sense, Solution, Status, Value, solve,
};
use gaitc_runtime::return_map::{MapOutcome, MapRequest, RequestError, ReturnMap};
use optimize_support::{Closed, Dual, Formed, about, expression, margin, problem, solved, spectral};

fn c(v: f64) -> Dual {
    Dual::constant(v)
}

/// Gait z = p0, multipliers 0.4 and p1.
fn plane() -> Closed {
    Closed::new(2, 2, 1, |z, p| {
        Some((about(z, &[p[0], p[1]], &[vec![c(0.4), c(0.0)], vec![c(0.0), p[1]]]), vec![z[0]]))
    })
}

/// sin(7 p0) cos(5 p1) and a slope: many hills, one highest.
fn hills() -> Objective {
    expression(|m, p| (m[0] * 7.0).sin() * (p[1] * 5.0).cos() + p[0] * 0.1)
}

fn bits(solution: &Solution) -> Vec<u64> {
    let optima =
        solution.optima.iter().flat_map(|o| [vec![o.objective, o.starts as f64], o.parameters.clone()].concat());
    let values = [vec![solution.objective], solution.parameters.clone(), solution.section.clone()].concat();
    values.into_iter().chain(optima).map(f64::to_bits).collect()
}

#[test]
fn any_number_of_threads_gives_the_same_bits_and_a_seed_other_starts() {
    let map = plane();
    let run = |threads, seed| {
        let mut problem = problem(&map, Sense::Maximize, hills(), &[0.1, 0.1], &[(0.0, 3.0), (0.0, 0.9)]);
        (problem.settings.starts, problem.settings.threads, problem.settings.seed) = (24, threads, seed);
        solved(&problem)
    };
    let one = run(1, 3);
    assert_eq!((one.starts.run, one.starts.converged), (24, 24));
    for threads in [0, 2, 5] {
        let other = run(threads, 3);
        assert_eq!(bits(&one), bits(&other));
        assert_eq!((&one.message, one.starts), (&other.message, other.starts));
    }
    let other = run(2, 4);
    assert_relative_eq!(other.objective, one.objective, max_relative = 1e-9);
    assert_ne!(bits(&one), bits(&other));
}

#[test]
fn distinct_optima_are_listed_best_first() {
    let map = plane();
    let objective = expression(|m, _| {
        (-((m[0] - 0.5) * (m[0] - 0.5) * 30.0)).exp() + (-((m[0] - 2.5) * (m[0] - 2.5) * 30.0)).exp() * 2.0
    });
    let mut problem = problem(&map, Sense::Maximize, objective, &[0.4, 0.1], &[(0.3, 2.7), (0.1, 0.1)]);
    problem.settings.starts = 16;
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    // Between the hills it is flat: what ends there is an optimum of its own, of a value near 0.
    let hills: Vec<_> = solution.optima.iter().filter(|o| o.objective > 0.5).collect();
    assert_eq!(hills.len(), 2, "{:?}", solution.optima);
    assert_relative_eq!(hills[0].parameters[0], 2.5, epsilon = 1e-4);
    assert_relative_eq!(hills[1].parameters[0], 0.5, epsilon = 1e-4);
    assert!(hills.iter().all(|hill| hill.starts >= 2), "{hills:?}");
    assert_eq!(solution.optima.iter().map(|o| o.starts).sum::<usize>(), solution.starts.converged);
    assert_eq!(solution.optima[0].objective.to_bits(), solution.objective.to_bits());
}

/// Constraints of which the first and the third exclude each other, the second can always hold.
fn excluded(map: &Closed) -> Problem<'_> {
    let objective = expression(|m, p| m[0] + p[1]);
    let mut problem = problem(map, Sense::Maximize, objective, &[0.5, 0.5], &[(0.0, 2.0), (0.0, 0.9)]);
    problem.constraints.push(margin("p0 >= 1.5", |m, _| m[0] - 1.5));
    problem.constraints.push(margin("p1 >= 0.1", |_, p| p[1] - 0.1));
    problem.constraints.push(margin("p0 + p1 <= 1.2", |_, p| -p[0] - p[1] + 1.2));
    problem
}

#[test]
fn a_conflict_is_irreducible_and_says_how_far_each_gets() {
    let map = plane();
    let solution = solved(&excluded(&map));
    assert_eq!(solution.status, Status::Infeasible, "{}", solution.message);
    let conflict = solution.conflict.unwrap();
    assert_eq!(conflict.members.iter().map(|m| m.constraint).collect::<Vec<_>>(), [0, 2]);
    // p1 may be 0: without the second constraint 1.2 is what p0 can be.
    assert_relative_eq!(conflict.members[0].margin, 1.2 - 1.5, epsilon = 1e-6);
    assert_relative_eq!(conflict.members[1].margin, 1.2 - 1.5, epsilon = 1e-6);
    assert!(conflict.agreeing >= 2);
    let said = &solution.message;
    assert!(said.contains("`p0 >= 1.5` and `p0 + p1 <= 1.2` cannot hold together"), "{said}");
    assert!(!said.contains("p1 >= 0.1"), "{said}");
}

#[test]
fn three_constraints_of_which_any_two_can_hold() {
    let map = plane();
    let objective = expression(|m, p| m[0] + p[1]);
    let mut problem = problem(&map, Sense::Maximize, objective, &[0.5, 0.5], &[(-2.0, 2.0), (-0.9, 0.9)]);
    problem.constraints.push(margin("a", |_, p| p[1] - 0.3));
    problem.constraints.push(margin("b", |m, p| m[0] - p[1]));
    problem.constraints.push(margin("c", |m, p| -m[0] - p[1]));
    let conflict = solved(&problem).conflict.unwrap();
    assert_eq!(conflict.members.iter().map(|m| m.constraint).collect::<Vec<_>>(), [0, 1, 2]);
    // Between b and c the best p1 is 0; with a kept, b and c get to p0 = 0.3 and -0.3: 0.6 away from the other.
    assert_relative_eq!(conflict.members[0].margin, -0.3, epsilon = 1e-6);
    assert_relative_eq!(conflict.members[1].margin, -0.6, epsilon = 1e-6);
    assert_relative_eq!(conflict.members[2].margin, -0.6, epsilon = 1e-6);
}

#[test]
fn stability_can_be_in_conflict() {
    let map = plane();
    let objective = expression(|m, _| m[0]);
    let mut problem = problem(&map, Sense::Maximize, objective, &[0.5, 0.5], &[(0.0, 2.0), (0.0, 2.0)]);
    problem.constraints.push(spectral(0.9));
    problem.constraints.push(margin("p1 >= 1.5", |_, p| p[1] - 1.5));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Infeasible, "{}", solution.message);
    let conflict = solution.conflict.unwrap();
    assert_relative_eq!(conflict.members[0].spectral_radius, 1.5, epsilon = 1e-6);
    assert_relative_eq!(conflict.members[1].margin, 0.9 - 1.5, epsilon = 1e-6);
}

#[test]
fn a_bad_start_alone_is_no_reason_for_no_optimum() {
    // The violation has a local minimum at p0 = 0, where the given start leads; the constraint holds beyond p0 = 2.
    let map = plane();
    let objective = expression(|m, _| -m[0]);
    let mut problem = problem(&map, Sense::Maximize, objective, &[0.2, 0.1], &[(-0.5, 3.0), (0.1, 0.1)]);
    problem.constraints.push(margin("in the far valley", |m, _| m[0] * m[0] * (m[0] - 1.5) - 2.0));
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal, "{}", solution.message);
    let p = solution.parameters[0];
    assert_relative_eq!(p * p * (p - 1.5), 2.0, epsilon = 1e-6);
    assert!(solution.notes.iter().any(|note| note.contains("another start")), "{:?}", solution.notes);
}

#[test]
fn a_gait_that_cannot_be_followed_all_the_way_is_still_a_start() {
    // There are gaits for p0 < 0.7 only; starts beyond end on the edge, and their searches lead back.
    let map =
        Closed::new(1, 1, 1, |z, p| (p[0].v < 0.7).then(|| (about(z, &[p[0].sin()], &[vec![c(0.4)]]), vec![z[0]])));
    let objective = expression(|_, p| (p[0] - 0.3) * (p[0] - 0.3));
    let mut problem = problem(&map, Sense::Minimize, objective, &[0.1], &[(0.0, 5.0)]);
    problem.settings.starts = 16;
    let solution = solved(&problem);
    assert_eq!((solution.starts.run, solution.starts.converged), (16, 16));
    assert_eq!(solution.optima.len(), 1, "{:?}", solution.optima);
}

#[test]
fn a_measure_that_nothing_changes_is_said_to_be_one() {
    let map = Closed::new(1, 2, 1, |z, p| Some((about(z, &[p[0]], &[vec![c(0.4)]]), vec![z[0] * 0.0 + 2.0])));
    let constant = problem(&map, Sense::Maximize, expression(|m, _| m[0]), &[0.1, 0.1], &[(0.0, 1.0), (0.0, 1.0)]);
    let solution = solved(&constant);
    assert_eq!((solution.status, solution.objective), (Status::Optimal, 2.0));
    assert!(solution.message.contains("does not change with `p0` and `p1`"), "{}", solution.message);
    // One that begins at its optimum does change.
    let top = expression(|_, p| -((p[0] - 0.5) * (p[0] - 0.5)) - (p[1] - 0.5) * (p[1] - 0.5) + 2.0);
    let solution = solved(&problem(&map, Sense::Maximize, top, &[0.5, 0.5], &[(0.0, 1.0), (0.0, 1.0)]));
    assert!(solution.message.contains("nothing limits it"), "{}", solution.message);
}

#[test]
fn an_objective_without_a_value_at_the_start() {
    let map = plane();
    // Not a number below p0 = 0.5 ...
    let gap = |m: &[Dual], _: &[Dual]| if m[0].v < 0.5 { c(f64::NAN) } else { m[0] };
    let run = |start: f64, upper: f64| {
        solved(&problem(&map, Sense::Maximize, expression(gap), &[start, 0.1], &[(0.0, upper), (0.1, 0.1)]))
    };
    // ... where the given start lies: another one is found, or there is none.
    let solution = run(0.2, 2.0);
    assert_eq!(solution.status, Status::Optimal, "{}", solution.message);
    assert_relative_eq!(solution.objective, 2.0, epsilon = 1e-6);
    let solution = run(0.2, 0.4);
    assert_eq!(solution.status, Status::Undefined);
    assert!(solution.message.contains("the objective is not defined"), "{}", solution.message);
}

/// A parameter of 1e9 beside one of 1e-3, margins of 0.5 and 1e-3, from many starts.
#[test]
fn a_gigapascal_beside_a_millimetre() {
    let map = Closed::new(2, 2, 2, |z, p| {
        let center = [p[0] * 1e-3, p[1] * 1e3];
        let j = [[c(0.3), c(2e5)], [c(-1e-6), c(0.2)]];
        let e = [z[0] - center[0], z[1] - center[1]];
        let next = vec![center[0] + j[0][0] * e[0] + j[0][1] * e[1], center[1] + j[1][0] * e[0] + j[1][1] * e[1]];
        Some((next, vec![p[0] * p[1] * 1e-6, p[0] * p[1] * p[1]]))
    });
    let objective = expression(|m, _| m[1]);
    let mut problem = problem(&map, Sense::Maximize, objective, &[9e8, 9e-5], &[(1e8, 2e9), (1e-5, 1e-3)]);
    let scaled = |name: &str, f: fn(&[Dual], &[Dual]) -> Dual, scale: f64| Constraint {
        name: name.to_owned(),
        kind: ConstraintKind::Margin { margin: Box::new(Formed(f)), scale },
    };
    problem.constraints.push(scaled("stiffness", |m, _| -m[0] + 0.5, 0.5));
    problem.constraints.push(scaled("thickness", |_, p| -p[1] + 8e-4, 8e-4));
    problem.settings.starts = 20;
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal);
    assert_eq!(solution.starts.converged, 20);
    // p0 p1 <= 5e5 and p1 <= 8e-4: p0 p1^2 = 5e5 * 8e-4.
    assert_relative_eq!(solution.objective, 400.0, max_relative = 1e-8);
    assert_relative_eq!(solution.parameters[0], 6.25e8, max_relative = 1e-6);
}

/// Asks to stop when it has been evaluated so many times.
struct Stopping(Formed, Interrupt, std::sync::atomic::AtomicUsize);

impl Expression for Stopping {
    fn evaluate(&self, measures: &[f64], parameters: &[f64]) -> Value {
        if self.2.fetch_sub(1, std::sync::atomic::Ordering::Relaxed) == 1 {
            self.1.request();
        }
        self.0.evaluate(measures, parameters)
    }
}

#[test]
fn an_interruption_leaves_the_best_gait_so_far() {
    let map = plane();
    let run = |evaluations: usize| {
        let interrupt = Interrupt::new();
        let valley = Formed(|_, p| {
            let (a, b) = (-p[0] + 1.0, p[1] - p[0] * p[0]);
            a * a + b * b * 100.0
        });
        let objective = Objective::Expression(Box::new(Stopping(valley, interrupt, evaluations.into())));
        let mut problem = problem(&map, Sense::Minimize, objective, &[-1.2, 0.5], &[(-2.0, 2.0), (-0.9, 0.99)]);
        problem.settings.starts = 4;
        problem.settings.threads = 1;
        problem.settings.interrupt = interrupt;
        solve(&problem).unwrap()
    };
    let whole = run(usize::MAX);
    assert_eq!(whole.status, Status::Optimal);
    let mut before = f64::INFINITY;
    for evaluations in [1, 8, 20] {
        let solution = run(evaluations);
        assert_eq!(solution.status, Status::Interrupted);
        assert!(solution.message.contains("not an optimum"), "{}", solution.message);
        assert!(solution.objective.is_finite() && solution.objective > whole.objective);
        assert!(solution.objective <= before, "{} {before}", solution.objective);
        before = solution.objective;
    }
}

#[test]
fn an_interruption_before_anything_holds_says_so() {
    let map = plane();
    let mut problem = excluded(&map);
    problem.settings.interrupt = Interrupt::new();
    assert!(!problem.settings.interrupt.request());
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Interrupted);
    assert!(solution.message.contains("before any gait met all constraints"), "{}", solution.message);
    assert!(solution.conflict.is_none());
}

/// A map whose step takes as long as its second measure says.
struct Lasting(Closed);

impl ReturnMap for Lasting {
    fn info(&self) -> &'static ModelInfo {
        self.0.info()
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        let outcome = self.0.evaluate(&MapRequest { measures: true, ..*request })?;
        Ok(match outcome {
            MapOutcome::Completed(mut map) => {
                map.duration = map.measures[1];
                MapOutcome::Completed(map)
            }
            stopped => stopped,
        })
    }
}

#[test]
fn a_step_of_no_length_is_not_the_closest_gait() {
    let formula = Closed::new(1, 1, 2, |z, p| Some((about(z, &[p[0]], &[vec![c(0.4)]]), vec![-z[0] + 0.8, z[0]])));
    let map = Lasting(formula);
    let mut problem = problem(&map.0, Sense::Minimize, expression(|m, _| m[0]), &[0.5], &[(1e-9, 1.0)]);
    (problem.map, problem.start) = (&map, vec![0.5]);
    problem.constraints.push(margin("m0 >= 0.9", |m, _| m[0] - 0.9));
    let solution = solved(&problem);
    assert!(matches!(solution.status, Status::Infeasible | Status::InfeasibleLocally | Status::Stalled));
    let reached = solution.conflict.iter().flat_map(|conflict| &conflict.members).map(|member| member.parameters[0]);
    for p in reached.chain([solution.parameters[0]]) {
        assert!(p >= 1e-3 * 0.2, "{p}");
    }
}

#[test]
fn a_bound_far_away_in_the_parameters_own_size_does_not_limit_it() {
    let stops =
        |z: &[Dual], p: &[Dual]| (p[0].v >= 15.0).then(|| (about(z, &[p[0] * 0.01], &[vec![c(0.4)]]), vec![p[0]]));
    let map = Closed::new(1, 1, 1, stops);
    let at = |upper: f64| {
        let mut problem = problem(&map, Sense::Minimize, expression(|m, _| m[0]), &[20.0], &[(1.0, upper)]);
        problem.start = vec![0.2];
        solved(&problem)
    };
    let wide = at(1e9);
    assert_eq!(wide.status, Status::Unconfirmed, "{}", wide.message);
    assert!(wide.message.contains("the range of `p0` is too wide"), "{}", wide.message);
    // In a range of its size it is seen that the map stops before the bound.
    assert_eq!(at(100.0).status, Status::Stalled);
}

#[test]
fn the_best_optimum_that_passes_the_long_tests_wins() {
    // On the higher hill the map has a kink at its gait: differences to both sides do not show it, disturbed maps do.
    let map = Closed::new(1, 1, 1, |z, p| {
        let apart = z[0] - p[0];
        let kink = if p[0].v > 1.5 { 0.2 } else { 0.0 };
        Some((vec![p[0] + apart * 0.4 + c(kink * apart.v.abs())], vec![z[0]]))
    });
    let objective = expression(|m, _| {
        (-((m[0] - 0.5) * (m[0] - 0.5) * 30.0)).exp() + (-((m[0] - 2.5) * (m[0] - 2.5) * 30.0)).exp() * 2.0
    });
    let mut problem = problem(&map, Sense::Maximize, objective, &[0.4], &[(0.3, 2.7)]);
    problem.start = vec![0.4];
    problem.settings.starts = 16;
    let solution = solved(&problem);
    assert_eq!(solution.status, Status::Optimal, "{}", solution.message);
    assert_relative_eq!(solution.parameters[0], 0.5, epsilon = 1e-4);
    assert!(solution.notes.iter().any(|note| note.contains("did not pass the long tests")), "{:?}", solution.notes);
    assert_eq!(solution.optima[0].objective.to_bits(), solution.objective.to_bits());
    problem.settings.long_tests = false;
    assert_relative_eq!(solved(&problem).parameters[0], 2.5, epsilon = 1e-4);
}
