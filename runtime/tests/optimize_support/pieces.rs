//! Extrema over a path whose place jumps at the optimum, against brute force that knows no derivative.

use super::optimize_support::{Closed, Dual, about, expression, margin, problem, solved};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use gaitc_runtime::model::ModelInfo;
use gaitc_runtime::optimize::{Problem, Sense, Solution, Status, Vary};
use gaitc_runtime::return_map::{Candidate, MapOutcome, MapRequest, MapResult, RequestError, ReturnMap};
use nalgebra::{DMatrix, DVector};

/// A map whose measure 0 is the largest of the first three of a closed form, each taken at a place of its own; the fourth is as it is.
struct Peaks {
    closed: Closed,
    /// Whether the map says where else the largest could have been taken.
    telling: bool,
}

impl Peaks {
    /// The map as if measure 0 had been taken at place `place`.
    fn taken(&self, map: &MapResult, place: usize) -> (DVector<f64>, DMatrix<f64>) {
        let (mut measures, mut jacobian) = (map.measures.clone(), map.measures_jacobian.clone());
        measures[0] = map.measures[place];
        jacobian.set_row(0, &map.measures_jacobian.row(place));
        (measures, jacobian)
    }
}

impl ReturnMap for Peaks {
    fn info(&self) -> &'static ModelInfo {
        self.closed.info()
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        Ok(self.candidates(request)?.0)
    }

    fn candidates(&self, request: &MapRequest<'_>) -> Result<(MapOutcome, Vec<Candidate>), RequestError> {
        let outcome = self.closed.evaluate(request)?;
        let MapOutcome::Completed(mut map) = outcome else { return Ok((outcome, Vec::new())) };
        if map.measures.is_empty() {
            return Ok((MapOutcome::Completed(map), Vec::new()));
        }
        let candidate = |place: usize| {
            let (measures, measures_jacobian) = self.taken(&map, place);
            Candidate { functional: 0, phase: 0.3 * place as f64, measures, measures_jacobian }
        };
        let candidates = if self.telling { (0..3).map(candidate).collect() } else { Vec::new() };
        let largest = (0..3).max_by(|a, b| map.measures[*a].total_cmp(&map.measures[*b])).unwrap();
        (map.measures, map.measures_jacobian) = self.taken(&map, largest);
        Ok((MapOutcome::Completed(map), candidates))
    }
}

fn c(v: f64) -> Dual {
    Dual::constant(v)
}

/// Gait z = (p0, p1). Three bowls about corners of a triangle, and a measure that grows towards one side.
fn bowls() -> Closed {
    Closed::new(2, 3, 4, |z, p| {
        let bowl = |x: f64, y: f64, a: f64, b: f64| {
            let (u, v) = (z[0] - x, z[1] - y);
            u * u * a + v * v * b + (u * 1.5).sin() * v * 0.3
        };
        let measures = vec![
            bowl(0.1, 0.2, 1.0, 2.0),
            bowl(1.4, 0.5, 2.0, 1.0) + p[2],
            bowl(0.5, 1.6, 1.5, 1.0),
            z[0] + z[1] * 0.5,
        ];
        Some((about(z, &[p[0], p[1]], &[vec![c(0.4), c(0.1)], vec![c(-0.2), c(0.3)]]), measures))
    })
}

fn peaks(telling: bool) -> Peaks {
    Peaks { closed: bowls(), telling }
}

fn asked<'a>(map: &'a Peaks, sense: Sense, start: [f64; 2]) -> Problem<'a> {
    let objective = match sense {
        Sense::Minimize => expression(|m, _| m[0]),
        Sense::Maximize => expression(|m, _| m[3]),
    };
    let parameters = [start[0], start[1], 0.1];
    let ranges = vec![Vary { parameter: 0, lower: -1.0, upper: 3.0 }, Vary { parameter: 1, lower: -1.0, upper: 3.0 }];
    Problem { map, vary: ranges, ..problem(&map.closed, sense, objective, &parameters, &[]) }
}

/// The measures on the gait at (x, y), the largest of the bowls first.
fn at(map: &Peaks, x: f64, y: f64) -> [f64; 2] {
    let request = MapRequest {
        coordinates: &[x, y],
        parameters: &[x, y, 0.1],
        memory: &[],
        period: 1,
        sensitivity: gaitc_runtime::return_map::Sensitivity::None,
        measures: true,
        accuracy: gaitc_runtime::return_map::Accuracy::default(),
    };
    match map.evaluate(&request).unwrap() {
        MapOutcome::Completed(map) => [map.measures[0], map.measures[3]],
        MapOutcome::Stopped(_) => panic!("a closed form does not stop"),
    }
}

/// The place and value of the smallest value of a unimodal function.
fn golden(f: &dyn Fn(f64) -> f64, mut a: f64, mut b: f64) -> (f64, f64) {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    while b - a > 1e-10 {
        let (l, r) = (b - ratio * (b - a), a + ratio * (b - a));
        if f(l) < f(r) { b = r } else { a = l }
    }
    (0.5 * (a + b), f(0.5 * (a + b)))
}

const STARTS: [[f64; 2]; 5] = [[0.3, 0.4], [1.5, 1.5], [-0.5, 0.0], [2.5, -0.5], [0.0, 2.5]];

fn optimum(problem: &Problem<'_>) -> Solution {
    let solution = solved(problem);
    assert_eq!(solution.status, Status::Optimal, "{}", solution.message);
    solution
}

#[test]
fn the_smallest_maximum_lies_where_three_places_compete() {
    let map = peaks(true);
    let along = |x: f64| golden(&|y| at(&map, x, y)[0], -1.0, 3.0).1;
    let (x, least) = golden(&along, -1.0, 3.0);
    for start in STARTS {
        let solution = optimum(&asked(&map, Sense::Minimize, start));
        assert_relative_eq!(solution.objective, least, max_relative = 1e-8);
        assert_abs_diff_eq!(solution.parameters[0], x, epsilon = 1e-4);
        assert!(solution.notes.iter().any(|note| note.contains("several places at once")), "{:?}", solution.notes);
        // With p2 held elsewhere the second bowl is higher: the slope of the smallest maximum is its share.
        let slope = |p2: f64| {
            let mut other = asked(&map, Sense::Minimize, start);
            other.parameters[2] = p2;
            optimum(&other).objective
        };
        let sensitivity = solution.sensitivities.iter().find(|s| s.parameter == 2).unwrap().derivative;
        assert_relative_eq!(sensitivity, (slope(0.1005) - slope(0.0995)) / 1e-3, max_relative = 1e-4);
    }
}

#[test]
fn without_the_places_a_search_stalls_at_the_kink() {
    // What the pieces are for: were this to end at an optimum, they would not be needed.
    let map = peaks(false);
    let ends = STARTS.map(|start| solved(&asked(&map, Sense::Minimize, start)).status);
    assert!(ends.iter().all(|end| *end != Status::Optimal), "{ends:?}");
}

#[test]
fn a_bound_on_a_maximum_that_is_taken_at_two_places() {
    let map = peaks(true);
    type Below = fn(&[Dual], &[Dual]) -> Dual;
    let bounded = |below: Below, start: [f64; 2]| {
        let mut problem = asked(&map, Sense::Maximize, start);
        problem.constraints.push(margin("peak", below));
        optimum(&problem)
    };
    let (tight, loose): (Below, Below) = (|m, _| -m[0] + 0.999, |m, _| -m[0] + 1.001);
    // Brute force: the largest measure on a fine fan of rays out of the smallest maximum, each followed to the bound.
    let along = |x: f64| golden(&|y| at(&map, x, y)[0], -1.0, 3.0);
    let (x0, _) = golden(&|x| along(x).1, -1.0, 3.0);
    let y0 = along(x0).0;
    let reached = |angle: f64| {
        let (mut low, mut high) = (0.0, 3.0);
        while high - low > 1e-12 {
            let r = 0.5 * (low + high);
            if at(&map, x0 + r * angle.cos(), y0 + r * angle.sin())[0] <= 1.0 { low = r } else { high = r }
        }
        at(&map, x0 + low * angle.cos(), y0 + low * angle.sin())[1]
    };
    let turn = std::f64::consts::TAU / 64.0;
    let best = (0..64).max_by(|a, b| reached(turn * f64::from(*a)).total_cmp(&reached(turn * f64::from(*b)))).unwrap();
    let centre = turn * f64::from(best);
    let most = -golden(&|angle| -reached(angle), centre - turn, centre + turn).1;
    for start in STARTS {
        let solution = bounded(|m, _| -m[0] + 1.0, start);
        assert_relative_eq!(solution.objective, most, max_relative = 1e-7);
        let price = (bounded(loose, start).objective - bounded(tight, start).objective) / 0.002;
        assert_relative_eq!(solution.active[0].multiplier, price, max_relative = 1e-4);
    }
}

#[test]
fn a_maximum_that_is_maximised_needs_no_pieces() {
    let map = peaks(true);
    let mut problem = asked(&map, Sense::Minimize, [1.0, 0.6]);
    problem.sense = Sense::Maximize;
    let solution = optimum(&problem);
    // The corner that the search is led to is one of the four.
    let corners = [[-1.0, -1.0], [-1.0, 3.0], [3.0, -1.0], [3.0, 3.0]].map(|[x, y]| at(&map, x, y)[0]);
    assert!(
        corners.iter().any(|value| (solution.objective - value).abs() < 1e-8),
        "{} {corners:?}",
        solution.objective
    );
}
