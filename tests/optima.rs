//! The optimizer against brute force, over problems of all kinds of models: from random starts it ends in an optimum that a
//! dense grid with polishing has found (any of those, where a problem has several). `cargo bench --bench optima` makes these optima, and has more starts.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly
#![allow(dead_code, unreachable_pub)] // shared with the bench

#[path = "../benches/optima/instance.rs"]
mod instance;
#[path = "../benches/optima/problems.rs"]
mod problems;
#[path = "../benches/optima/starts.rs"]
mod starts;

use gaitc_runtime::optimize::Status;
use instance::Instance;
use problems::CASES;

/// Starts of each problem.
const STARTS: usize = 4;
/// Largest difference of an objective from an optimum of brute force, relative to it.
const SAME: f64 = 1e-6;

#[test]
fn random_starts_end_in_optima_of_brute_force() {
    let (mut run, mut converged, mut said) = (0, 0, Vec::new());
    for case in CASES.iter().filter(|case| !case.optima.is_empty()) {
        let instance = Instance::of(case);
        let (runs, _) = starts::run(&instance, STARTS, 7);
        assert_eq!(runs.len(), STARTS, "{}: too few gaits to start from", case.title());
        for one in &runs {
            run += 1;
            let solution = &one.solution;
            if solution.status != Status::Optimal {
                said.push(format!("{} from {:.3?}: {}", case.title(), one.from, solution.message));
                continue;
            }
            converged += 1;
            let is = |optimum: &f64| (solution.objective - optimum).abs() <= SAME * optimum.abs();
            let known = case.optima.iter().any(is);
            assert!(known, "{} from {:.3?} ends at {}: no optimum", case.title(), one.from, solution.objective);
        }
    }
    assert!(converged * 100 >= 95 * run, "{converged} of {run} starts converged: {said:#?}");
}
