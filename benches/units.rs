//! What one unit of work costs: a return map with its exact Jacobian, at the gait of every model in `specs/`.
//! `cargo bench --bench units`; a word after `--` picks the models whose names contain it.
//!
//! Each model runs at the loosest tolerance at which image, Jacobian and duration are within the wanted error of a run at the
//! tightest one: a tolerance means something else for each model, an error does not. Times are medians.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout)] // its result

use gaitc::load::embedded;
use gaitc::models::MODELS;
use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::registry::Entry;
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, Sensitivity};
use std::hint::black_box;
use std::time::Instant;

/// Wanted error of models with an explicit flow, and of those with a mass matrix.
const ERRORS: [f64; 2] = [1e-10, 1e-8];
/// Relative tolerances that are tried, the loosest first; absolute tolerances (SI units) are a tenth of them.
const TOLERANCES: [f64; 15] =
    [1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12, 1e-12];
/// Relative tolerance of the run that the others are compared with.
const TIGHTEST: f64 = 1e-14;
/// How long each model is timed.
const SECONDS: f64 = 0.5;

/// A model at its gait.
struct Unit {
    entry: &'static Entry,
    coordinates: Vec<f64>,
    parameters: Vec<f64>,
    memory: Vec<f64>,
}

impl Unit {
    fn of(entry: &'static Entry) -> Self {
        let loaded = embedded(entry).expect("the embedded spec is the compiled one");
        let (parameters, memory) = (loaded.parameters(), loaded.memory());
        let outcome = find_gait(entry.compiled, &GaitRequest::new(&parameters, &memory), &loaded.start()).unwrap();
        let coordinates = outcome.gait.expect("every model has a gait").coordinates.as_slice().to_vec();
        Self { entry, coordinates, parameters, memory }
    }

    fn run(&self, relative: f64) -> MapResult {
        let outcome = self.entry.compiled.evaluate(&MapRequest {
            coordinates: &self.coordinates,
            parameters: &self.parameters,
            memory: &self.memory,
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() },
        });
        match outcome.unwrap() {
            MapOutcome::Completed(map) => *map,
            MapOutcome::Stopped(stop) => panic!("{}: {stop:?}", self.entry.compiled.info().name),
        }
    }

    /// The loosest tolerance with the wanted error, the error, and the map there.
    fn loosest(&self) -> (f64, f64, MapResult) {
        let wanted = if self.entry.compiled.info().explicit { ERRORS[0] } else { ERRORS[1] };
        let exact = self.run(TIGHTEST);
        let tried = TOLERANCES.into_iter().map(|relative| {
            let map = self.run(relative);
            (relative, deviation(&map, &exact), map)
        });
        tried.into_iter().find(|(_, error, _)| *error <= wanted).expect("some tolerance is tight enough")
    }

    /// The median time of a map (us).
    fn time(&self, relative: f64) -> f64 {
        let start = Instant::now();
        let mut times = Vec::new();
        while start.elapsed().as_secs_f64() < SECONDS {
            let one = Instant::now();
            black_box(self.run(black_box(relative)));
            times.push(one.elapsed().as_secs_f64() * 1e6);
        }
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    }
}

/// Largest difference of image, Jacobian and duration, each relative to 1 or its size.
fn deviation(map: &MapResult, exact: &MapResult) -> f64 {
    let numbers = |m: &MapResult| [m.coordinates.as_slice(), m.jacobian.as_slice(), &[m.duration]].concat();
    let pairs = numbers(map).into_iter().zip(numbers(exact));
    pairs
        .map(|(a, b)| (a - b).abs() / b.abs().max(1.0))
        .fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
}

fn main() {
    // cargo passes `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    println!("| model | tolerance | error | steps | evaluations | median |\n|---|---|---|---|---|---|");
    for entry in MODELS {
        let name = entry.compiled.info().name;
        if !words.is_empty() && !words.iter().any(|word| name.contains(word.as_str())) {
            continue;
        }
        let unit = Unit::of(entry);
        let (relative, error, map) = unit.loosest();
        let s = map.statistics;
        let time = unit.time(relative);
        println!(
            "| {name} | {relative:.0e} | {error:.1e} | {} | {} | {time:.1} us |",
            s.steps + s.rejected,
            s.evaluations
        );
    }
}
