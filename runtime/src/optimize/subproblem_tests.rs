//! Random subproblems over many orders of magnitude: always solved, and to rounding after refinement.

use super::super::active_set::refine;
use super::*;
use proptest::prelude::*;

/// Data of a random subproblem that owns its matrices.
#[derive(Clone, Debug)]
struct Owned {
    hessian: DMatrix<f64>,
    gradient: DVector<f64>,
    equality: DMatrix<f64>,
    h: DVector<f64>,
    inequality: DMatrix<f64>,
    c: DVector<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    radius: f64,
    penalty: f64,
    clarabel: Clarabel,
    tally: Tally,
}

impl Owned {
    fn subproblem(&self) -> Subproblem<'_> {
        Subproblem {
            hessian: &self.hessian,
            gradient: &self.gradient,
            equality: &self.equality,
            h: self.h.clone(),
            inequality: &self.inequality,
            c: self.c.clone(),
            lower: &self.lower,
            upper: &self.upper,
            radius: self.radius,
            penalty: self.penalty,
            tie: self.penalty,
            clarabel: &self.clarabel,
            tally: &self.tally,
        }
    }
}

fn numbers(count: usize) -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(-1.0..1.0f64, count)
}

fn random() -> impl Strategy<Value = Owned> {
    (1usize..=5, 0usize..=2, 0usize..=4).prop_flat_map(|(n, d, k)| {
        let data = numbers(n * n + n + d * n + d + k * n + k + 2 * n);
        (data, -9.0..0.5f64, 0.0..7.0f64, -9.0..0.0f64).prop_map(move |(data, radius, penalty, offsets)| {
            let mut data = data.into_iter();
            let mut take = |count: usize| -> Vec<f64> { data.by_ref().take(count).collect() };
            let root = DMatrix::from_vec(n, n, take(n * n));
            let offset = 10f64.powf(offsets);
            Owned {
                hessian: root.transpose() * root + DMatrix::identity(n, n) * 0.1,
                gradient: DVector::from_vec(take(n)),
                equality: DMatrix::from_vec(d, n, take(d * n)),
                h: DVector::from_vec(take(d)) * offset,
                inequality: DMatrix::from_vec(k, n, take(k * n)),
                c: DVector::from_vec(take(k)) * offset,
                // Some bounds are infinite, some are met.
                lower: take(n).iter().map(|x| if *x > 0.5 { f64::NEG_INFINITY } else { x.min(0.0) }).collect(),
                upper: take(n).iter().map(|x| if *x < -0.5 { f64::INFINITY } else { x.max(0.0) }).collect(),
                radius: 10f64.powf(radius),
                penalty: 10f64.powf(penalty),
                clarabel: Clarabel::USED,
                tally: Tally::new(),
            }
        })
    })
}

/// Model plus penalty: what the step minimises.
fn value(problem: &Subproblem<'_>, s: &DVector<f64>) -> f64 {
    problem.model(s) + problem.penalty * problem.violation(s)
}

proptest! {
    #[test]
    fn every_subproblem_is_solved(data in random(), directions in proptest::collection::vec(numbers(5), 8)) {
        let problem = data.subproblem();
        let step = problem.solve();
        prop_assert!(step.is_ok(), "{step:?}");
        if let Ok(step) = step {
            prop_assert!(step.s.norm() <= data.radius * (1.0 + 1e-6));
            let best = value(&problem, &step.s);
            for direction in directions {
                // No allowed step nearby is better than Clarabel's tolerance admits.
                let other = DVector::from_fn(step.s.len(), |j, _| {
                    (step.s[j] + 0.1 * data.radius * direction[j]).clamp(data.lower[j], data.upper[j])
                });
                if other.norm() <= data.radius {
                    let slack = 1e-6 * data.radius * (1.0 + data.penalty);
                    prop_assert!(best <= value(&problem, &other) + slack);
                }
            }
        }
    }

    #[test]
    fn a_refined_step_is_stationary_to_rounding(data in random()) {
        let problem = data.subproblem();
        if let Some(step) = problem.solve().ok().and_then(|step| refine(&problem, &step)) {
            let m = &step.multipliers;
            let pull = problem.equality.tr_mul(&m.equality) + problem.inequality.tr_mul(&m.inequality);
            let residual = problem.gradient + problem.hessian * &step.s - pull - &m.low + &m.high;
            prop_assert!(residual.amax() <= 1e-7 * (1.0 + m.largest()), "{residual}");
        }
    }
}

/// One interior-point iteration solves nothing: every attempt fails with `MaxIterations`, and what is said names each.
#[test]
fn what_clarabel_cannot_solve_is_tried_in_every_way() {
    let short = Owned {
        hessian: DMatrix::identity(2, 2),
        gradient: nalgebra::dvector![1.0, -0.4],
        equality: DMatrix::zeros(0, 2),
        h: DVector::zeros(0),
        inequality: nalgebra::dmatrix![0.7, 0.2],
        c: nalgebra::dvector![-0.3],
        lower: vec![f64::NEG_INFINITY; 2],
        upper: vec![0.5, f64::INFINITY],
        radius: 1.0,
        penalty: 10.0,
        clarabel: Clarabel { iterations: 1, ..Clarabel::USED },
        tally: Tally::new(),
    };
    let unsolved = short.subproblem().solve().err().map(|Unsolved(words)| words);
    assert_eq!(unsolved, Some(["MaxIterations"; 5].join(", ")));
    let counts = short.tally.counts();
    assert_eq!((counts.subproblems, counts.again, counts.unsolved, counts.max_iterations), (1, 1, 1, 5));
    // With iterations enough, the first attempt does it.
    let long = Owned { clarabel: Clarabel::USED, tally: Tally::new(), ..short };
    assert!(long.subproblem().solve().is_ok());
    assert_eq!((long.tally.counts().again, long.tally.counts().unsolved), (0, 0));
}
