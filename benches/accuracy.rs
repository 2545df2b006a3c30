//! How many digits of multipliers, Jacobians and second derivatives are right, for every model in `specs/` at its gait, and how
//! the error falls with the tolerance. `cargo bench --bench accuracy`; docs/accuracy.md has the tables and what limits them.
//!
//! Each number is computed by two routes that share as little as possible; digits are -log10 of the largest difference,
//! relative to the largest number of its kind. An absolute tolerance (SI units) is a tenth of the relative one.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a bench may fail loudly
#![allow(clippy::print_stdout)] // its result

#[path = "../tests/crank_slider/mod.rs"]
mod crank_slider;
#[path = "../tests/maps/mod.rs"]
mod maps;

use crank_slider::gait::Method as Collocation;
use crank_slider::machine::Machine as Crank;
use gaitc::models::MODELS;
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::{
    Accuracy, MapOutcome, MapRequest, MapResult, Method, Points, RequestError, Sensitivity,
};
use maps::Machine;
use nalgebra::{Complex, DMatrix};

/// The tightest useful relative tolerance.
const TIGHT: f64 = 1e-14;
/// That of Radau's method with 3 stages, which takes very many steps beyond.
const TIGHT_OF_LOW_ORDER: f64 = 1e-13;
/// Steps of differences, relative to the variable: truncation and rounding are in balance somewhere between.
const STEPS: [f64; 6] = [3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4];
/// A variable below this counts as this large.
const SMALL: f64 = 0.01;
/// Weights of the central difference of order 8 at 1, 2, 3 and 4 steps.
const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

fn accuracy(relative: f64, method: Method) -> Accuracy {
    Accuracy { relative, absolute: 0.1 * relative, method, ..Accuracy::default() }
}

/// A model at the gait that the tightest tolerance gives.
struct At {
    machine: Machine,
    gait: Gait,
}

impl At {
    fn new(machine: Machine) -> Self {
        let start = machine.gait(None).coordinates.as_slice().to_vec();
        let gait = search(&machine, &start, accuracy(TIGHT, Method::Automatic), 1).expect("single shooting");
        Self { machine, gait }
    }

    fn explicit(&self) -> bool {
        self.machine.model.compiled.info().explicit
    }

    fn z(&self) -> &[f64] {
        self.gait.coordinates.as_slice()
    }

    fn ask<R>(&self, z: &[f64], p: &[f64], accuracy: Accuracy, answer: impl FnOnce(&MapRequest<'_>) -> R) -> R {
        answer(&MapRequest {
            coordinates: z,
            parameters: p,
            memory: &self.machine.model.memory(),
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy,
        })
    }

    fn run(&self, z: &[f64], p: &[f64], accuracy: Accuracy) -> MapResult {
        self.try_run(z, p, accuracy).expect("a step")
    }

    /// `None` where there is no next step.
    fn try_run(&self, z: &[f64], p: &[f64], accuracy: Accuracy) -> Option<MapResult> {
        match self.ask(z, p, accuracy, |request| self.machine.model.compiled.evaluate(request).unwrap()) {
            MapOutcome::Completed(map) => Some(*map),
            MapOutcome::Stopped(_) => None,
        }
    }

    /// The gait at another tolerance, by another method, or in segments; `None` where the model has no plan to cut.
    fn again(&self, accuracy: Accuracy, segments: usize) -> Option<Gait> {
        search(&self.machine, self.z(), accuracy, segments)
    }
}

fn search(machine: &Machine, start: &[f64], accuracy: Accuracy, segments: usize) -> Option<Gait> {
    let memory = machine.model.memory();
    let usual = GaitRequest::new(&machine.parameters, &memory);
    let request = GaitRequest { accuracy, segments, measures: false, ..usual };
    match find_gait(machine.model.compiled, &request, start) {
        Err(RequestError::NoPlan(_)) => None,
        outcome => {
            let outcome = outcome.unwrap();
            assert_eq!(outcome.status, GaitStatus::Converged, "{}", outcome.message);
            outcome.gait
        }
    }
}

/// The largest difference relative to the largest number.
fn error(a: &[f64], b: &[f64]) -> f64 {
    let scale = b.iter().map(|b| b.abs()).fold(0.0, f64::max);
    let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(
        0.0,
        |worst, x: f64| {
            if x > worst || x.is_nan() { x } else { worst }
        },
    );
    if worst == 0.0 { 0.0 } else { worst / scale }
}

/// Each multiplier against the next of the others.
fn multipliers(a: &[Complex<f64>], b: &[Complex<f64>]) -> f64 {
    let scale = b.iter().map(|b| b.norm()).fold(0.0, f64::max);
    let next = |a: &Complex<f64>| b.iter().map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min);
    a.iter().map(next).fold(0.0, f64::max) / scale
}

/// Digits of a number with this relative error; those of a `f64` where there is no difference.
fn digits(error: f64) -> String {
    format!("{:.1}", -error.max(f64::EPSILON).log10())
}

fn or_none(digits: Option<String>) -> String {
    digits.unwrap_or_else(|| "-".to_owned())
}

fn main() {
    routes();
    tolerances();
    cranks();
}

fn routes() {
    println!(
        "| model | largest multiplier | implicit: multipliers | Jacobian | 5 segments: multipliers | Jacobian | known otherwise | second \
         derivatives |\n|---|---|---|---|---|---|---|---|"
    );
    for entry in MODELS {
        let name = entry.compiled.info().name;
        let at = At::new(Machine::new(name, &[]));
        if at.z().is_empty() {
            println!("| {name} | no coordinates | | | | | | |");
            continue;
        }
        let other =
            if at.explicit() { accuracy(TIGHT, Method::Radau5) } else { accuracy(TIGHT_OF_LOW_ORDER, Method::Radau3) };
        let implicit = at.again(other, 1).expect("single shooting");
        let same_place = at.run(at.z(), &at.machine.parameters, other);
        let exact = at.run(at.z(), &at.machine.parameters, accuracy(TIGHT, Method::Automatic));
        let segments = at.again(accuracy(TIGHT, Method::Automatic), 5);
        println!(
            "| {name} | {:.2e} | {} | {} | {} | {} | {} | {} |",
            at.gait.spectral_radius,
            digits(multipliers(&implicit.multipliers, &at.gait.multipliers)),
            digits(error(same_place.jacobian.as_slice(), exact.jacobian.as_slice())),
            or_none(segments.as_ref().map(|s| digits(multipliers(&s.multipliers, &at.gait.multipliers)))),
            or_none(segments.as_ref().map(|s| digits(error(s.map.jacobian.as_slice(), exact.jacobian.as_slice())))),
            or_none(known(&at).map(digits)),
            or_none(second_derivatives(&at).map(digits)),
        );
    }
    println!();
}

/// The error of what is known of a gait without an integrator of ours: multipliers in closed form or by collocation, or the
/// determinant of the Jacobian.
fn known(at: &At) -> Option<f64> {
    let (value, found) = (|name: &str| at.machine.value(name), &at.gait);
    let single = |exact: f64| Some((found.multipliers[0].re - exact).abs() / exact.abs());
    match at.machine.model.compiled.info().name {
        "bouncing_ball" => single(value("e")),
        "rimless_wheel" => {
            let mu = 1.0 + value("lambda").powi(2) * ((2.0 * value("alpha")).cos() - 1.0);
            single(mu * mu)
        }
        "prescribed_length" => {
            let exact = (2.0 * value("psi")).cos() * (value("l_b") + value("l_s")) / value("l_b");
            Some((found.map.jacobian.determinant() - exact).abs() / exact)
        }
        "rotational" => {
            let exact = (value("l_b") + value("l_s")) / value("l_b");
            Some((found.map.jacobian.determinant() - exact).abs() / exact)
        }
        "self_exciting" => {
            let exact = Collocation::default().gait(&Crank::nominal())?;
            Some(multipliers(&found.multipliers, &exact.multipliers))
        }
        "self_exciting_rotor" => {
            let crank = Crank { rotor: value("I_r"), ..Crank::nominal() };
            let exact = Collocation::default().gait(&crank)?;
            Some(multipliers(&found.multipliers, &exact.multipliers))
        }
        _ => None,
    }
}

/// The worst of all second derivatives, along coordinates and all parameters, against differences of exact first ones. Along
/// each direction errors are relative to the largest, or to 1/variable where that is larger.
fn second_derivatives(at: &At) -> Option<f64> {
    let (map, p) = (at.machine.model.compiled, &at.machine.parameters);
    let tight = accuracy(TIGHT, Method::Automatic);
    let plan = at.ask(at.z(), p, tight, |request| map.plan(request).unwrap().1)?;
    let chosen: Vec<usize> = (0..p.len()).collect();
    let exact = map.second_order(&plan, Points { coordinates: at.z(), parameters: p }, &chosen).unwrap()?;
    let d = at.z().len();
    let mut worst = 0.0;
    for j in 0..d + p.len() {
        let value = if j < d { at.z()[j] } else { p[j - d] }.abs().max(SMALL);
        let at_offset = |offset: f64| {
            let (mut z, mut p) = (at.z().to_vec(), p.clone());
            *if j < d { &mut z[j] } else { &mut p[j - d] } += offset;
            at.try_run(&z, &p, tight).map(|map| stacked(&map))
        };
        let mut second = exact.second[j].columns(0, d).clone_owned().insert_row(d, 0.0);
        second.set_row(d, &exact.duration_second.row(j).columns(0, d));
        let of_step = |step: &f64| -> Option<f64> {
            let h = step * value;
            let mut slope = DMatrix::zeros(d + 1, d);
            for (k, weight) in (1..=4).zip(WEIGHTS) {
                slope += (at_offset(h * f64::from(k))? - at_offset(-h * f64::from(k))?) * (weight / h);
            }
            Some((&slope - &second).amax() / slope.amax().max(1.0 / value))
        };
        let best = STEPS.iter().filter_map(of_step).fold(f64::INFINITY, f64::min);
        worst = f64::max(worst, best);
    }
    Some(worst)
}

/// The Jacobian of a map with the derivatives of its duration below.
fn stacked(map: &MapResult) -> DMatrix<f64> {
    let d = map.coordinates.len();
    let mut all = map.jacobian.clone().insert_row(d, 0.0);
    all.set_row(d, &map.duration_gradient.transpose());
    all
}

/// Image, Jacobian and duration.
fn numbers(map: &MapResult) -> Vec<f64> {
    [map.coordinates.as_slice(), map.jacobian.as_slice(), &[map.duration]].concat()
}

fn tolerances() {
    println!(
        "| tolerance | prescribed_length: steps | error | determinant | angle_switched: steps | error | self_exciting: steps \
         | error |\n|---|---|---|---|---|---|---|---|"
    );
    let [length, angle, crank] =
        ["prescribed_length", "angle_switched", "self_exciting"].map(|name| At::new(Machine::new(name, &[])));
    let collocated = Collocation::default().map(&Crank::nominal(), &crank.gait.coordinates).expect("a step");
    let collocated =
        [collocated.image.as_slice(), collocated.jacobian.as_slice(), &[collocated.step.duration]].concat();
    let tightest = |at: &At| numbers(&at.run(at.z(), &at.machine.parameters, accuracy(TIGHT, Method::Automatic)));
    let references = [tightest(&length), tightest(&angle), collocated];
    for exponent in 6..=14 {
        let tolerance = 0.1_f64.powi(exponent);
        let runs = [&length, &angle, &crank]
            .map(|at| at.run(at.z(), &at.machine.parameters, accuracy(tolerance, Method::Automatic)));
        let steps = |i: usize| runs[i].statistics.steps;
        let off = |i: usize| format!("{:.1e}", error(&numbers(&runs[i]), &references[i]));
        let exact = {
            let value = |name: &str| length.machine.value(name);
            (2.0 * value("psi")).cos() * (value("l_b") + value("l_s")) / value("l_b")
        };
        let determinant = (runs[0].jacobian.determinant() - exact).abs() / exact;
        println!(
            "| 1e-{exponent} | {} | {} | {determinant:.1e} | {} | {} | {} | {} |",
            steps(0),
            off(0),
            steps(1),
            off(1),
            steps(2),
            off(2)
        );
    }
    println!();
}

fn cranks() {
    println!(
        "| gear ratio | steps | image, Jacobian, duration | multipliers | largest entry of the Jacobian |\n|---|---|---|---|---|"
    );
    let method = Collocation::default();
    for gear in [15.0, 20.0, 30.0, 56.57, 100.0] {
        let crank = Crank::new(20.0, gear, 58.0);
        let exact = method.gait(&crank).expect("a gait");
        let at = At::new(Machine::new("self_exciting", &[("G", gear)]));
        let map = at.run(exact.coordinates.as_slice(), &at.machine.parameters, accuracy(TIGHT, Method::Automatic));
        let expected = [exact.map.image.as_slice(), exact.map.jacobian.as_slice(), &[exact.map.step.duration]].concat();
        println!(
            "| {gear} | {} | {} | {} | {:.1} |",
            map.statistics.steps,
            digits(error(&numbers(&map), &expected)),
            digits(multipliers(&at.gait.multipliers, &exact.multipliers)),
            map.jacobian.amax()
        );
    }
}
