//! What one unit of work costs: a return map with its exact Jacobian, at the gait of every model in `specs/`, by an adaptive
//! run, by the replay of a plan that was made nearby, and by replays of many points in lanes.
//! `cargo bench --bench units`; a word after `--` picks the models whose names contain it, a number is the wanted error.
//!
//! Each runs at the loosest tolerance at which image, Jacobian and duration are within the wanted error of a run at the
//! tightest one: a tolerance means something else for each model and way, an error does not. Times are medians.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout)] // its result

use gaitc::load::embedded;
use gaitc::models::MODELS;
use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::registry::Entry;
use gaitc_runtime::return_map::{Accuracy, Images, MapOutcome, MapRequest, MapResult, Plan, Points, Sensitivity};
use std::hint::black_box;
use std::time::Instant;

/// Wanted error of models with an explicit flow, and of those with a mass matrix.
const ERRORS: [f64; 2] = [1e-10, 1e-8];
/// Relative tolerances that are tried, the loosest first; absolute tolerances (SI units) are a tenth of them.
const TOLERANCES: [f64; 15] =
    [1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12, 1e-12];
/// Relative tolerance of the run that the others are compared with.
const TIGHTEST: f64 = 1e-14;
/// How far off the gait plans are made, relative to the coordinates.
const NEAR: f64 = 1e-4;
/// So many points are replayed in one call.
const MANY: usize = 64;
/// How long each model is timed.
const SECONDS: f64 = 0.5;

/// A model at its gait.
struct Unit {
    entry: &'static Entry,
    coordinates: Vec<f64>,
    parameters: Vec<f64>,
    memory: Vec<f64>,
    wanted: f64,
}

impl Unit {
    fn of(entry: &'static Entry, wanted: Option<f64>) -> Self {
        let loaded = embedded(entry).expect("the embedded spec is the compiled one");
        let (parameters, memory) = (loaded.parameters(), loaded.memory());
        let outcome = find_gait(entry.compiled, &GaitRequest::new(&parameters, &memory), &loaded.start()).unwrap();
        let coordinates = outcome.gait.expect("every model has a gait").coordinates.as_slice().to_vec();
        let wanted = wanted.unwrap_or(ERRORS[usize::from(!entry.compiled.info().explicit)]);
        Self { entry, coordinates, parameters, memory, wanted }
    }

    fn request(&self, relative: f64) -> MapRequest<'_> {
        MapRequest {
            coordinates: &self.coordinates,
            parameters: &self.parameters,
            memory: &self.memory,
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() },
        }
    }

    fn run(&self, relative: f64) -> MapResult {
        match self.entry.compiled.evaluate(&self.request(relative)).unwrap() {
            MapOutcome::Completed(map) => *map,
            MapOutcome::Stopped(stop) => panic!("{}: {stop:?}", self.entry.compiled.info().name),
        }
    }

    /// The loosest tolerance with the wanted error, the error, and the map there.
    fn loosest(&self, exact: &MapResult) -> (f64, f64, MapResult) {
        let tried = TOLERANCES.into_iter().map(|relative| {
            let map = self.run(relative);
            (relative, deviation(&map, exact), map)
        });
        tried.into_iter().find(|(_, error, _)| *error <= self.wanted).expect("some tolerance is tight enough")
    }

    /// A plan made a little way off the gait, at the loosest tolerance at which its replay at the gait has the wanted error.
    fn plan(&self, exact: &MapResult) -> Option<(f64, f64, Plan)> {
        let near: Vec<f64> = self.coordinates.iter().map(|z| z * (1.0 + NEAR) + 1e-3 * NEAR).collect();
        TOLERANCES.into_iter().find_map(|relative| {
            let request = MapRequest { coordinates: &near, ..self.request(relative) };
            let (_, plan) = self.entry.compiled.plan(&request).unwrap();
            let images = self.replay(plan.as_ref()?, &self.coordinates, &self.parameters);
            let error = images.held[0].then(|| difference_of(&images, exact))?;
            (error <= self.wanted).then(|| (relative, error, plan.unwrap()))
        })
    }

    fn replay(&self, plan: &Plan, coordinates: &[f64], parameters: &[f64]) -> Images {
        let mut images = Images::default();
        self.entry.compiled.replay(plan, Points { coordinates, parameters }, &mut images).unwrap();
        images
    }

    /// Median times of a replay, one at a time and one of many (us).
    fn time_replays(&self, plan: &Plan) -> (f64, f64) {
        let mut images = Images::default();
        let one = Points { coordinates: &self.coordinates, parameters: &self.parameters };
        let single = median(|| {
            for _ in 0..MANY {
                self.entry.compiled.replay(plan, black_box(one), &mut images).unwrap();
                black_box(&images);
            }
        });
        let off = |i: usize| 1.0 + 1e-6 * i as f64;
        let coordinates: Vec<f64> = (0..MANY).flat_map(|i| self.coordinates.iter().map(move |z| z * off(i))).collect();
        let parameters: Vec<f64> = (0..MANY).flat_map(|i| self.parameters.iter().map(move |p| p * off(i))).collect();
        let many = Points { coordinates: &coordinates, parameters: &parameters };
        let lanes = median(|| {
            self.entry.compiled.replay(plan, black_box(many), &mut images).unwrap();
            black_box(&images);
        });
        assert!(images.held.iter().all(|held| *held), "{}", self.entry.compiled.info().name);
        (single / MANY as f64, lanes / MANY as f64)
    }

    /// The median time of a map (us).
    fn time(&self, relative: f64) -> f64 {
        median(|| {
            black_box(self.run(black_box(relative)));
        })
    }
}

/// The median time of a call (us).
fn median(mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    let mut times = Vec::new();
    while start.elapsed().as_secs_f64() < SECONDS {
        let one = Instant::now();
        call();
        times.push(one.elapsed().as_secs_f64() * 1e6);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Image, Jacobian and duration, one after the other.
fn numbers(map: &MapResult) -> Vec<f64> {
    [map.coordinates.as_slice(), map.jacobian.as_slice(), &[map.duration]].concat()
}

/// Largest difference, each relative to 1 or its size.
fn largest(a: &[f64], b: &[f64]) -> f64 {
    let off = a.iter().zip(b).map(|(a, b)| (a - b).abs() / b.abs().max(1.0));
    off.fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
}

fn deviation(map: &MapResult, exact: &MapResult) -> f64 {
    largest(&numbers(map), &numbers(exact))
}

fn difference_of(images: &Images, exact: &MapResult) -> f64 {
    largest(&[&images.coordinates[..], &images.jacobians, &images.durations].concat(), &numbers(exact))
}

fn main() {
    // cargo passes `--bench`.
    let words = std::env::args().skip(1).filter(|word| !word.starts_with("--"));
    let (numbers, words): (Vec<String>, Vec<String>) = words.partition(|word| word.parse::<f64>().is_ok());
    let wanted = numbers.first().and_then(|word| word.parse().ok());
    println!(
        "| model | adaptive: tolerance, error | steps | median | replay: tolerance, error | steps | median | in lanes |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for entry in MODELS {
        let name = entry.compiled.info().name;
        if !words.is_empty() && !words.iter().any(|word| name.contains(word.as_str())) {
            continue;
        }
        let unit = Unit::of(entry, wanted);
        let exact = unit.run(TIGHTEST);
        let (relative, error, map) = unit.loosest(&exact);
        let steps = map.statistics.steps + map.statistics.rejected;
        let time = unit.time(relative);
        print!("| {name} | {relative:.0e}, {error:.1e} | {steps} | {time:.1} us |");
        match unit.plan(&exact) {
            Some((relative, error, plan)) => {
                let (single, lanes) = unit.time_replays(&plan);
                println!(" {relative:.0e}, {error:.1e} | {} | {single:.2} us | {lanes:.2} us |", plan.steps());
            }
            None => println!(" no plan | | | |"),
        }
    }
}
