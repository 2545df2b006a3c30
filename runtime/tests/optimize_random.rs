//! The optimizer on many random problems: never worse than a grid, always feasible, never optimal without reason.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

mod optimize_support;
#[path = "optimize_support/pieces.rs"]
mod pieces;

use gaitc_runtime::optimize::{Expression, Objective, Sense, Status, Value};
use optimize_support::{Closed, Dual, about, margin, problem, solved, spectral};
use proptest::prelude::*;

/// a . p + p' diag(b) p + c sin(3 p0 p1): smooth, not convex.
#[derive(Clone, Debug)]
struct Hilly([f64; 5]);

impl Hilly {
    fn at(&self, p: &[f64]) -> f64 {
        let [a, b, c, d, e] = self.0;
        a * p[0] + b * p[1] + c * p[0] * p[0] + d * p[1] * p[1] + e * (3.0 * p[0] * p[1]).sin()
    }
}

impl Expression for Hilly {
    fn evaluate(&self, measures: &[f64], p: &[f64]) -> Value {
        let [a, b, c, d, e] = self.0;
        let slope = 3.0 * e * (3.0 * p[0] * p[1]).cos();
        let dparameters = vec![a + 2.0 * c * p[0] + slope * p[1], b + 2.0 * d * p[1] + slope * p[0]];
        Value { value: self.at(p), dmeasures: vec![0.0; measures.len()], dparameters }
    }
}

/// Two pairs and a real multiplier, mixed by a similarity; magnitudes p0, p1 and (p0 + p1)/2, a section of dimension 5.
fn five() -> Closed {
    Closed::new(5, 2, 1, |z, p| {
        let zero = Dual::constant(0.0);
        let (a, b) = ((p[0] * 0.8, p[0] * 0.6), (p[1] * -0.28, p[1] * 0.96));
        let j = [
            vec![a.0, -a.1, Dual::constant(0.3), zero, zero],
            vec![a.1, a.0, zero, Dual::constant(0.5), zero],
            vec![zero, zero, b.0, -b.1, p[0]],
            vec![zero, zero, b.1, b.0, p[1]],
            vec![zero, zero, zero, zero, (p[0] + p[1]) * 0.5],
        ];
        Some((about(z, &[p[0], p[1], p[0] * p[1], p[0].sin(), p[1].cos()], &j), vec![z[2]]))
    })
}

/// The best value on a grid.
fn grid_best(objective: &Hilly, allowed: impl Fn(f64, f64) -> bool) -> f64 {
    let mut best = f64::NEG_INFINITY;
    for i in 0..=200 {
        for k in 0..=200 {
            let p = [f64::from(i) / 100.0, f64::from(k) / 100.0];
            if allowed(p[0], p[1]) {
                best = best.max(objective.at(&p));
            }
        }
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn never_worse_than_a_grid(
        coefficients in prop::array::uniform5(-1.0..1.0f64),
        start in prop::array::uniform2(0.0..2.0f64),
        bound in 0.4..1.2f64,
    ) {
        let map = five();
        let objective = Hilly(coefficients);
        let mut problem = problem(
            &map,
            Sense::Maximize,
            Objective::Expression(Box::new(objective.clone())),
            &start,
            &[(0.0, 2.0), (0.0, 2.0)],
        );
        problem.constraints.push(spectral(bound));
        problem.constraints.push(margin("p0 + 2 p1 >= 0.3", |_, p| p[0] + p[1] * 2.0 - 0.3));
        problem.settings.starts = 8;
        let solution = solved(&problem);
        prop_assert_eq!(solution.status, Status::Optimal);
        prop_assert!(solution.spectral_radius <= bound * (1.0 + 1e-9));
        prop_assert!(solution.parameters[0] + 2.0 * solution.parameters[1] >= 0.3);
        // Also where the best point is a corner at which both pairs stand on the circle.
        let best = grid_best(&objective, |a, b| a.max(b) <= bound && a + 2.0 * b >= 0.3);
        prop_assert!(solution.objective >= best - 1e-9, "{} < {best}", solution.objective);
    }
}

/// Both pairs stand on the circle at the best point, from every start: the corner converges to all digits, but for the part
/// of the tolerance by which constraints are made to hold strictly.
#[test]
fn two_pairs_reach_the_circle_together() {
    let map = five();
    for (coefficients, bound) in
        [([1.0, 1.0, 0.0, 0.0, 0.0], 0.9), ([1.0, 0.2, 0.0, 0.0, 0.0], 0.5), ([0.5, 0.9, -0.1, 0.1, 0.0], 1.1)]
    {
        let objective = Hilly(coefficients);
        for start in [[0.1, 0.4], [1.9, 1.7], [0.3, 1.9], [bound, 0.2]] {
            let goal = Objective::Expression(Box::new(objective.clone()));
            let mut problem = problem(&map, Sense::Maximize, goal, &start, &[(0.0, 2.0), (0.0, 2.0)]);
            problem.constraints.push(spectral(bound));
            let solution = solved(&problem);
            assert_eq!(solution.status, Status::Optimal, "from {start:?}: {}", solution.message);
            for p in &solution.parameters {
                assert!((p - bound).abs() <= 1e-9, "from {start:?} to {:?}", solution.parameters);
            }
            // The price is the slope of the optimum, which moves along the diagonal.
            let h = 1e-5;
            let slope = (objective.at(&[bound + h; 2]) - objective.at(&[bound - h; 2])) / (2.0 * h);
            assert!((solution.active[0].multiplier - slope).abs() <= 1e-6, "{:?} for {slope}", solution.active);
        }
    }
}
