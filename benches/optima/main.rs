//! The optimizer against brute force: each problem solved from 20 random starts, and by a dense grid with polishing.
//! `cargo bench --bench optima`; a word after `--` picks the problems whose title contains it, and `starts` leaves the
//! brute force out and takes the recorded optima.
//!
//! A start counts as converged when it ends as an optimum. That is right when it is the best one of brute force to 1e-6 of
//! it, or when brute force finds nothing better beside it: another local optimum.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout, clippy::print_stderr, unreachable_pub)] // its result

mod brute;
mod instance;
mod problems;
mod starts;

use gaitc_runtime::optimize::Status;
use instance::{Instance, Sample};
use problems::{CASES, Case};
use starts::Run;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::time::Instant;

const STARTS: usize = 20;
const SEED: u64 = 2026;
/// Largest difference of an objective from an optimum, relative to it.
const SAME: f64 = 1e-6;
/// How far around an optimum that is not the best one brute force looks for something better, in fractions of the ranges.
const AROUND: f64 = 0.01;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let only_starts = words.iter().any(|word| word == "starts");
    let wanted = |case: &&Case| {
        let mut named = words.iter().filter(|word| *word != "starts").peekable();
        named.peek().is_none() || named.any(|word| case.title().contains(word.as_str()))
    };
    println!("| problem | optimum | at | converged | at the best | worst deviation | iterations | time (ms) |");
    println!("|---|---|---|---|---|---|---|---|");
    let mut notes = Vec::new();
    for case in CASES.iter().filter(wanted) {
        notes.extend(compare(case, only_starts));
        std::io::stdout().flush().expect("standard output takes the row");
    }
    for note in notes {
        println!("- {note}");
    }
}

/// Prints a row; what else there is to say comes back.
fn compare(case: &Case, only_starts: bool) -> Vec<String> {
    let instance = Instance::of(case);
    let clock = Instant::now();
    let optima = if only_starts { Vec::new() } else { brute::optima(&instance) };
    eprintln!("{}: brute force took {:.1} s", case.title(), clock.elapsed().as_secs_f64());
    let recorded = |k: usize| case.optima.get(k).copied().unwrap_or(f64::NAN);
    let best = optima.first().map_or(recorded(0), |sample| sample.objective);
    let (runs, without) = starts::run(&instance, STARTS, SEED);
    let converged: Vec<&Run> = runs.iter().filter(|run| run.solution.status == Status::Optimal).collect();
    let off = |run: &Run| (run.solution.objective - best).abs() / best.abs();
    let at_best: Vec<&&Run> = converged.iter().filter(|run| off(run) <= SAME).collect();
    let worst = at_best.iter().map(|run| off(run)).fold(0.0, f64::max);
    let middle = |mut numbers: Vec<f64>| {
        numbers.sort_by(f64::total_cmp);
        numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
    };
    println!(
        "| {} | {best:.10} | {} | {} of {} | {} | {worst:.1e} | {} | {:.1} |",
        case.title(),
        optima.first().map_or(String::new(), |sample| place(&instance, &sample.at)),
        converged.len(),
        runs.len(),
        at_best.len(),
        middle(runs.iter().map(|run| run.solution.iterations as f64).collect()),
        middle(runs.iter().map(|run| run.time.as_secs_f64() * 1e3).collect()),
    );
    let mut notes: Vec<String> = Vec::new();
    if without > 0 {
        notes.push(format!("{}: {without} random points without a gait were drawn again", case.title()));
    }
    for run in &runs {
        if run.solution.status != Status::Optimal {
            let solution = &run.solution;
            notes.push(format!(
                "{}: start {:.3?}: {:?}: {}",
                case.title(),
                run.from,
                solution.status,
                solution.message
            ));
        }
    }
    let elsewhere = converged.iter().filter(|run| off(run) > SAME);
    let mut groups: BTreeMap<String, usize> = BTreeMap::new();
    for run in elsewhere {
        let said = elsewhere_said(&instance, run);
        *groups.entry(said).or_default() += 1;
    }
    notes.extend(groups.into_iter().map(|(said, count)| format!("{}: {count} starts at {said}", case.title())));
    notes
}

/// What brute force says of an optimum that is not its best.
fn elsewhere_said(instance: &Instance, run: &Run) -> String {
    let at = instance.fractions(&run.solution.parameters);
    let here = match instance.sample(&at, &run.solution.section) {
        Some(sample) => sample,
        None => return "a point where brute force finds no gait: WRONG".to_owned(),
    };
    let place = place(instance, &at);
    let value = run.solution.objective;
    // Rounding in the fractions can cost the last digits of a bound.
    if here.violation > 1e-7 || (here.objective - value).abs() > SAME * value.abs() {
        return format!(
            "{value:.8} ({place}), which brute force does not confirm (violation {:.1e}): WRONG",
            here.violation
        );
    }
    let near = Sample { violation: 0.0, ..here };
    match brute::polish(instance, &near, AROUND) {
        Some(better) if better.gain(&near) > SAME * value.abs() => {
            format!("{value:.8} ({place}), {:.8} is beside it: WRONG", better.objective)
        }
        _ => format!("the local optimum {value:.8} ({place})"),
    }
}

/// Varied parameters with their names, SI units.
fn place(instance: &Instance, at: &[f64]) -> String {
    let parameters = instance.parameters(at);
    let one = |v: &gaitc_compiler::ir::Vary| {
        format!("{} = {:.6}", instance.spec.parameters[v.parameter].name, parameters[v.parameter])
    };
    instance.problem.vary.iter().map(one).collect::<Vec<_>>().join(", ")
}
