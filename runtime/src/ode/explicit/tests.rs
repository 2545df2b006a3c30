//! The method against its order conditions and against exact solutions.

use super::coefficients::{A, C, D, DENSE_STAGES, E3, E5, STAGES};
use super::*;
use crate::ode::{Bundle, Controller, Step, Tolerance};
use approx::assert_abs_diff_eq;

/// A rooted tree, as the list of its root's subtrees.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Tree(Vec<Tree>);

impl Tree {
    fn order(&self) -> usize {
        1 + self.0.iter().map(Tree::order).sum::<usize>()
    }

    /// The density: product of the orders of all subtrees.
    fn density(&self) -> f64 {
        self.order() as f64 * self.0.iter().map(Tree::density).product::<f64>()
    }

    /// The elementary weight at stage `i`, without the final weights.
    fn weight(&self, i: usize) -> f64 {
        let inner = |tree: &Tree| (0..i).map(|j| A[i][j] * tree.weight(j)).sum::<f64>();
        self.0.iter().map(inner).product()
    }
}

/// All rooted trees of an order: each arises from a smaller one by a new leaf somewhere.
fn trees(order: usize) -> Vec<Tree> {
    if order == 1 {
        return vec![Tree(Vec::new())];
    }
    let mut all: Vec<Tree> = trees(order - 1).iter().flat_map(with_leaf).collect();
    all.sort();
    all.dedup();
    all
}

fn with_leaf(tree: &Tree) -> Vec<Tree> {
    let sorted = |mut children: Vec<Tree>| {
        children.sort();
        Tree(children)
    };
    let mut all = vec![sorted([tree.0.as_slice(), &[Tree(Vec::new())]].concat())];
    for (i, child) in tree.0.iter().enumerate() {
        for grown in with_leaf(child) {
            let mut children = tree.0.clone();
            children[i] = grown;
            all.push(sorted(children));
        }
    }
    all
}

#[test]
fn rows_sum_to_the_nodes() {
    for i in 0..DENSE_STAGES {
        assert_abs_diff_eq!(A[i].iter().sum::<f64>(), C[i], epsilon = 2e-14);
    }
}

#[test]
fn order_conditions_hold_for_all_trees_up_to_order_8() {
    let counts: Vec<usize> = (1..=8).map(|order| trees(order).len()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115]);
    let sum = |weights: &[f64], tree: &Tree| (0..STAGES).map(|i| weights[i] * tree.weight(i)).sum::<f64>();
    for order in 1..=8 {
        for tree in trees(order) {
            assert_abs_diff_eq!(sum(&A[12], &tree), 1.0 / tree.density(), epsilon = 2e-14);
            // The embedded methods are of order 5 and 3: their differences to the step vanish up to there.
            if order <= 5 {
                assert_abs_diff_eq!(sum(&E5, &tree), 0.0, epsilon = 1e-13);
            }
            if order <= 3 {
                assert_abs_diff_eq!(sum(&E3, &tree), 0.0, epsilon = 1e-13);
            }
        }
    }
    // Not of order 9: the test can fail.
    let defect = trees(9).iter().map(|t| (sum(&A[12], t) - 1.0 / t.density()).abs()).fold(0.0, f64::max);
    assert!(defect > 1e-7);
    assert!(D.iter().all(|row| row.iter().all(|v| v.is_finite())));
}

type Plane = Bundle<2, 0, 0>;

fn plane(x: [f64; 2]) -> Plane {
    Bundle { x, q: [], dx: [], dq: [] }
}

/// A pendulum-like nonlinear field with the exact solution x = (tan tau, 1/cos tau).
fn field(_: f64, x: &[f64; 2]) -> [f64; 2] {
    [x[1] * x[1], x[0] * x[1]]
}

fn one_step(tau: f64, h: f64) -> Step<Plane, Stages<Plane>> {
    let rates = |tau: f64, y: &Plane| plane(field(tau, &y.x));
    let start = plane([tau.tan(), 1.0 / tau.cos()]);
    let mut stages = [start; 12];
    stages[0] = rates(tau, &start);
    let times = stage_times(tau, h);
    let end = attempt(&|i, y: &Plane| rates(times[i - 1], y), h, &start, &mut stages);
    Step { tau, h, start, start_rates: stages[0], stages, end, end_rates: rates(tau + h, &end) }
}

#[test]
fn one_step_errs_by_h_to_the_ninth_and_dense_output_by_h_to_the_eighth() {
    let errors = |h: f64| {
        let step = one_step(0.1, h);
        let exact = |u: f64| (0.1 + u * h).tan();
        let dense = Dense::new(&step, &field);
        let inside = (1..40).map(|i| f64::from(i) / 40.0).map(|u| (dense.at(u)[0] - exact(u)).abs());
        assert_abs_diff_eq!(dense.at(0.0)[0], step.start.x[0], epsilon = 1e-15);
        assert_abs_diff_eq!(dense.at(1.0)[0], step.end.x[0], epsilon = 1e-15);
        ((step.end.x[0] - exact(1.0)).abs(), inside.fold(0.0, f64::max))
    };
    let (coarse, fine) = (errors(0.4), errors(0.2));
    let (step, dense) = ((coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2());
    assert!((8.5..10.5).contains(&step), "order of the step {step}");
    // The leading term is not alone at these steps; smaller ones would measure rounding.
    assert!((7.2..9.5).contains(&dense), "order of the dense output {dense}");
}

#[test]
fn the_error_estimate_falls_like_h_to_the_eighth() {
    let tolerance = Tolerance { relative: 1e-9, absolute: 1e-9 };
    let estimate = |h: f64| {
        let step = one_step(0.1, h);
        error(h, &step.start, &step.end, &step.stages, tolerance)
    };
    let slope = (estimate(0.4) / estimate(0.2)).log2();
    assert!((slope - 8.0).abs() < 1.0, "slope {slope}");
    let (zero, nan) = (plane([0.0, 0.0]), plane([f64::NAN, 0.0]));
    assert!(error(0.1, &nan, &nan, &[nan; 12], tolerance).is_nan());
    assert!(error(0.1, &zero, &nan, &[zero; 12], tolerance).is_nan());
}

#[test]
fn the_controller_shrinks_on_errors_and_grows_without() {
    let mut controller = Controller::new(ERROR_ORDER);
    let (accepted, h) = controller.judge(300.0, 1.0);
    assert!(!accepted && h < 0.6);
    let (accepted, h) = controller.judge(f64::NAN, 1.0);
    assert!(!accepted && h == 0.25);
    let (accepted, h) = controller.judge(1e-9, 1.0);
    assert!(accepted && h <= 1.0, "no growth right after a rejection");
    let (accepted, h) = controller.judge(1e-9, 1.0);
    assert!(accepted && h > 2.0);
}
