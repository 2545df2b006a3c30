//! Clarabel's settings compared on the subproblems of the reference suite: `cargo bench --bench clarabel`; words after `--` pick
//! the problems whose title contains one of them.
//!
//! Each row changes one setting of those in use. All problems are solved from random starts with it; the table has what Clarabel
//! did, and what became of the searches.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout, unreachable_pub, dead_code)] // its result; shared with another bench

#[path = "../optima/instance.rs"]
mod instance;
#[path = "../optima/problems.rs"]
mod problems;
#[path = "../optima/starts.rs"]
mod starts;

use gaitc_runtime::optimize::{Clarabel, Settings, Status, Tally};
use instance::Instance;
use problems::{CASES, Case};
use std::io::Write as _;

const STARTS: usize = 3;
const SEED: u64 = 2027;
/// Largest difference of an objective from an optimum of brute force, relative to it.
const SAME: f64 = 1e-6;

fn variants() -> Vec<(&'static str, Clarabel)> {
    let used = || Clarabel::USED;
    vec![
        ("in use", used()),
        ("tolerance 1e-6", Clarabel { tolerance: 1e-6, ..used() }),
        ("tolerance 1e-10", Clarabel { tolerance: 1e-10, ..used() }),
        ("tolerance 1e-12", Clarabel { tolerance: 1e-12, ..used() }),
        ("no equilibration", Clarabel { equilibrate: false, ..used() }),
        ("static regularisation 1e-6", Clarabel { static_regularisation: 1e-6, ..used() }),
        ("static regularisation 1e-10", Clarabel { static_regularisation: 1e-10, ..used() }),
        ("no static regularisation", Clarabel { static_regularisation: 0.0, ..used() }),
        ("no dynamic regularisation", Clarabel { dynamic_regularisation: 0.0, ..used() }),
        ("no iterative refinement", Clarabel { refinements: 0, ..used() }),
        ("at most 50 iterations", Clarabel { iterations: 50, ..used() }),
        ("at most 15 iterations", Clarabel { iterations: 15, ..used() }),
    ]
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let wanted = |case: &&Case| {
        let named = words.is_empty() || words.iter().any(|word| case.title().contains(word.as_str()));
        named && !case.optima.is_empty()
    };
    let instances: Vec<(&Case, Instance)> =
        CASES.iter().filter(wanted).map(|case| (case, Instance::of(case))).collect();
    println!(
        "| setting | subproblems | iterations of each | asked again | insufficient progress | numerical error | \
         almost solved | most iterations | searches | right | worst KKT residual |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for (name, clarabel) in variants() {
        println!("{}", row(name, clarabel, &instances));
        std::io::stdout().flush().expect("standard output takes the row");
    }
}

fn row(name: &str, clarabel: Clarabel, instances: &[(&Case, Instance)]) -> String {
    let tally = Tally::new();
    let settings = Settings { clarabel, tally: tally.clone(), long_tests: false, ..Settings::default() };
    let (mut searches, mut right, mut worst) = (0, 0, 0.0_f64);
    for (case, instance) in instances {
        for run in starts::run_with(instance, STARTS, SEED, &settings).0 {
            searches += 1;
            let found = &run.solution;
            let is = |optimum: &f64| (found.objective - optimum).abs() <= SAME * optimum.abs();
            if found.status == Status::Optimal && case.optima.iter().any(is) {
                right += 1;
                worst = worst.max(found.kkt_residual);
            }
        }
    }
    let counts = tally.counts();
    format!(
        "| {name} | {} | {:.1} | {} | {} | {} | {} | {} | {searches} | {right} | {worst:.0e} |",
        counts.subproblems,
        counts.iterations as f64 / counts.subproblems.max(1) as f64,
        counts.again,
        counts.insufficient_progress,
        counts.numerical_error,
        counts.almost_solved,
        counts.max_iterations,
    )
}
