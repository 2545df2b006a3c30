//! How return maps with Jacobians scale over cores: replays of one plan at many points, in lanes, by 1, 2, 4 ... threads.
//! `cargo bench --bench scaling`; a word after `--` picks the models whose names contain it.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout)] // its result

use gaitc::load::embedded;
use gaitc::models::MODELS;
use gaitc_runtime::batch::batch;
use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::return_map::{Accuracy, MapRequest, Points, Sensitivity};
use std::hint::black_box;
use std::time::Instant;

/// Points of one batch.
const POINTS: usize = 65_536;
/// The best of so many batches counts.
const TURNS: usize = 5;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let cores = std::thread::available_parallelism().unwrap().get();
    let threads: Vec<usize> = (0..).map(|i| 1 << i).take_while(|n| *n <= cores).collect();
    println!("| model | threads | maps a second | times one thread | in full |\n|---|---|---|---|---|");
    for entry in MODELS {
        let name = entry.compiled.info().name;
        if !words.is_empty() && !words.iter().any(|word| name.contains(word.as_str())) {
            continue;
        }
        let loaded = embedded(entry).expect("the embedded spec is the compiled one");
        let (parameters, memory) = (loaded.parameters(), loaded.memory());
        let outcome = find_gait(entry.compiled, &GaitRequest::new(&parameters, &memory), &loaded.start()).unwrap();
        let gait = outcome.gait.expect("every model has a gait").coordinates.as_slice().to_vec();
        let request = MapRequest {
            coordinates: &gait,
            parameters: &parameters,
            memory: &memory,
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: Accuracy { relative: 1e-8, absolute: 1e-9, ..Accuracy::default() },
        };
        let Some(plan) = entry.compiled.plan(&request).unwrap().1 else {
            continue;
        };
        let coordinates: Vec<f64> =
            (0..POINTS).flat_map(|i| gait.iter().map(move |z| z * (1.0 + 1e-8 * i as f64))).collect();
        let points = Points { coordinates: &coordinates, parameters: &parameters };
        let mut alone = 0.0;
        for count in &threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(*count).build().unwrap();
            let mut best = f64::INFINITY;
            let mut in_full = 0;
            for _ in 0..TURNS {
                let start = Instant::now();
                let found = pool.install(|| batch(entry.compiled, Some(&plan), &request, black_box(points))).unwrap();
                best = best.min(start.elapsed().as_secs_f64());
                in_full = found.in_full;
            }
            let rate = POINTS as f64 / best;
            if *count == 1 {
                alone = rate;
            }
            println!("| {name} | {count} | {:.2} million | {:.2} | {in_full} |", rate / 1e6, rate / alone);
        }
    }
}
