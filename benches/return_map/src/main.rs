//! Return map and Jacobian of the crank-slider climber (self_exciting) to 1e-8, by gaitc and by diffsol.
//! `cargo run --release --manifest-path benches/return_map/Cargo.toml`; docs/performance.md says more.
//!
//! Each runs at the loosest tolerance at which its result is within 1e-8 of the reference of the tests (collocation over the
//! crank angle); a tolerance means something else in each code, an error does not.
//! After the table, the two are timed in turns, so that whatever else the computer does slows both alike, and the ratio of
//! their medians is printed.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout)] // its result

#[path = "../../../tests/crank_slider/mod.rs"]
mod crank_slider;
mod diffsol_map;

use crank_slider::gait::Method;
use crank_slider::machine::Machine;
use gaitc::load::load;
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, Sensitivity};
use std::fmt;
use std::hint::black_box;
use std::time::Instant;

/// How close both have to come to the reference.
const ERROR: f64 = 1e-8;
/// Relative tolerances that are tried, the loosest first; absolute tolerances (SI units) are a tenth of them.
const TOLERANCES: [f64; 13] = [1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9, 3e-10, 1e-10, 3e-11, 1e-11];
/// How often the two are timed in turns.
const TURNS: usize = 400;

/// A return map with its Jacobian (row-major) and the duration of the step (s).
#[derive(Clone, Copy, Debug)]
struct Mapped {
    image: [f64; 2],
    jacobian: [f64; 4],
    duration: f64,
}

/// A machine to time.
#[derive(Clone, Copy)]
enum Case {
    /// The thesis's: gear ratio 56.57.
    Nominal,
    /// At the gear ratio of the unbounded speed optimum, where the crank overspeeds before the dead centre.
    Fast,
}

const CASES: [Case; 2] = [Case::Nominal, Case::Fast];

impl Case {
    fn machine(self) -> Machine {
        match self {
            Case::Nominal => Machine::nominal(),
            Case::Fast => Machine::new(20.0, 20.26, 58.0),
        }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "G = {}", self.machine().gear)
    }
}

/// The machine's gait by the reference: section coordinates, and the map there.
fn reference(machine: &Machine) -> ([f64; 2], Mapped) {
    let gait = Method::default().gait(machine).expect("the reference finds a gait");
    let (z, map) = (&gait.coordinates, &gait.map);
    let jacobian = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|entry| map.jacobian[entry]);
    ([z[0], z[1]], Mapped { image: [map.image[0], map.image[1]], jacobian, duration: map.step.duration })
}

/// gaitc's map of a machine at a relative tolerance.
fn gaitc_map(machine: &Machine, relative: f64) -> Box<dyn FnMut([f64; 2]) -> Mapped> {
    let model = load("self_exciting", None).expect("the model is compiled in");
    let (mut parameters, memory) = (model.parameters(), model.memory());
    for (name, value) in [("psi", machine.psi), ("G", machine.gear), ("k", machine.stiffness)] {
        parameters[model.parameter(name).expect(name)] = value;
    }
    let accuracy = Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() };
    Box::new(move |z| {
        let outcome = model.compiled.evaluate(&MapRequest {
            coordinates: &z,
            parameters: &parameters,
            memory: &memory,
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy,
        });
        let MapOutcome::Completed(map) = outcome.expect("the request is right") else { panic!("the step ends") };
        let jacobian = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|entry| map.jacobian[entry]);
        Mapped { image: [map.coordinates[0], map.coordinates[1]], jacobian, duration: map.duration }
    })
}

/// diffsol's map of a machine at a relative tolerance.
fn diffsol_map(machine: &Machine, relative: f64) -> Box<dyn FnMut([f64; 2]) -> Mapped> {
    Box::new(diffsol_map::map(*machine, relative, 0.1 * relative))
}

/// A code that computes the map of a machine at a tolerance.
type Code = fn(&Machine, f64) -> Box<dyn FnMut([f64; 2]) -> Mapped>;

/// The loosest tolerance at which a code reaches the wanted error on a machine, and its error there.
fn loosest(code: Code, machine: &Machine) -> (f64, f64) {
    let (z, expected) = reference(machine);
    let reached = TOLERANCES.into_iter().map(|relative| (relative, deviation(&code(machine, relative)(z), &expected)));
    reached.into_iter().find(|(_, error)| *error <= ERROR).expect("some tolerance is tight enough")
}

#[divan::bench(args = CASES)]
fn gaitc(bencher: divan::Bencher<'_, '_>, case: Case) {
    let machine = case.machine();
    let (z, mut map) = (reference(&machine).0, gaitc_map(&machine, loosest(gaitc_map, &machine).0));
    bencher.bench_local(|| map(black_box(z)));
}

#[divan::bench(args = CASES)]
fn diffsol(bencher: divan::Bencher<'_, '_>, case: Case) {
    let machine = case.machine();
    let (z, mut map) = (reference(&machine).0, diffsol_map(&machine, loosest(diffsol_map, &machine).0));
    bencher.bench_local(|| map(black_box(z)));
}

/// Largest deviation from the reference.
fn deviation(map: &Mapped, expected: &Mapped) -> f64 {
    let numbers = |m: &Mapped| [&m.image[..], &m.jacobian, &[m.duration]].concat();
    let worst = numbers(map).into_iter().zip(numbers(expected)).map(|(a, b)| (a - b).abs());
    worst.fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
}

fn check(case: Case) {
    for (name, code) in [("gaitc", gaitc_map as Code), ("diffsol", diffsol_map)] {
        let (tolerance, error) = loosest(code, &case.machine());
        println!("{case}: {name} needs a relative tolerance of {tolerance:.0e} and has an error of {error:.1e}");
    }
}

/// Times both in turns and prints medians and their ratio.
fn compare(case: Case) {
    let machine = case.machine();
    let z = reference(&machine).0;
    let at_its_best = |code: Code| code(&machine, loosest(code, &machine).0);
    let (mut ours, mut theirs) = (at_its_best(gaitc_map), at_its_best(diffsol_map));
    let (mut our_times, mut their_times) = (Vec::new(), Vec::new());
    for _ in 0..TURNS {
        our_times.push(microseconds(|| ours(black_box(z))));
        their_times.push(microseconds(|| theirs(black_box(z))));
    }
    let (a, b) = (median(our_times), median(their_times));
    println!("{case}: gaitc {a:.1} us, diffsol {b:.1} us, {:.1} times (medians of {TURNS} in turns)", b / a);
}

fn microseconds(map: impl FnOnce() -> Mapped) -> f64 {
    let start = Instant::now();
    black_box(map());
    start.elapsed().as_secs_f64() * 1e6
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    CASES.into_iter().for_each(check);
    divan::main();
    CASES.into_iter().for_each(compare);
}
