//! Plans of the suite's rows: their second derivatives against those of the closed form, and replays of them, in one number and
//! in lanes, near and far from where the plan was made, against runs with error control.

use crate::check::{FAMILY, Row, near};
use crate::family::{Exact, Second, exact};
use gaitc_runtime::return_map::{Images, MapOutcome, Method, Plan, Points, ReturnMap, SecondOrder, Sensitivity};
use gaitc_runtime::sensitivity::Dual;

/// All states of the start, then all parameters.
const DIRECTIONS: usize = 9;
/// How far the points of a batch are from the row's own, relative to max(0.1, |value|). The first is its own.
const AWAY: [f64; 9] = [0.0, 1e-9, -1e-6, 1e-4, -1e-3, 0.01, -0.05, 0.2, -0.5];
/// By how much a replay that held may be off the run, relative to what each may be off the solution.
const SAME: f64 = 30.0;
/// A second derivative may be off by more than a first one, by this factor: that of 1/sqrt(d) is as sensitive to d as its
/// power -3/2, three times as much.
const SECOND: f64 = 3.0;

/// Checks what can be replayed of a row, and says what is wrong; whether the row has a plan.
pub fn replayed(row: &Row, say: &mut impl FnMut(String)) -> bool {
    let made = row.ask(Method::Explicit, Sensitivity::Coordinates, |request| FAMILY.plan(request));
    let Ok((MapOutcome::Completed(_), Some(plan))) = made else {
        return false;
    };
    if !row.once {
        second_derivatives(row, &plan, say);
    }
    batches(row, &plan, say);
    true
}

fn second_derivatives(row: &Row, plan: &Plan, say: &mut impl FnMut(String)) {
    let points = Points { coordinates: &row.start, parameters: &row.p };
    let Ok(Some(found)) = FAMILY.second_order(plan, points, &[0, 1, 2, 3, 4, 5]) else {
        return say("no second derivatives".to_owned());
    };
    let expected = closed_form(row);
    let Some((_, duration)) = expected.events.last() else {
        return say("has no end".to_owned());
    };
    let all: Vec<(usize, &Second)> = expected.end.iter().chain([duration]).enumerate().collect();
    // Rounding is that of the largest; second derivatives are made from products of first ones.
    let first = all.iter().flat_map(|(_, v)| v.derivative).map(|d| d.value.abs());
    let second = all.iter().flat_map(|(_, v)| v.derivative).flat_map(|d| d.derivative).map(f64::abs);
    let first = first.fold(1.0, f64::max);
    let second = second.fold(first, f64::max);
    for (i, value) in all {
        for j in 0..DIRECTIONS {
            let (got, exact) = (entry(&found, i, j, None), value.derivative[j].value);
            if !near(got, exact, first, row.derivatives) {
                say(format!("first derivative ({i}, {j}) is {got}, expected {exact}, off by {:e}", got - exact));
            }
            for k in 0..DIRECTIONS {
                let (got, exact) = (entry(&found, i, j, Some(k)), value.derivative[j].derivative[k]);
                if !near(got, exact, second, SECOND * row.derivatives) {
                    say(format!(
                        "second derivative ({i}, {j}, {k}) is {got}, expected {exact}, off by {:e}, largest {second:e}",
                        got - exact
                    ));
                }
            }
        }
    }
}

/// A derivative of state `i` of the end, or, for i = 3, of the duration: the first along `j`, or the second along `j` and `k`.
fn entry(found: &SecondOrder, i: usize, j: usize, k: Option<usize>) -> f64 {
    match (i, k) {
        (3, None) => found.duration_gradient[j],
        (3, Some(k)) => found.duration_second[(j, k)],
        (_, None) => found.jacobian[(i, j)],
        (_, Some(k)) => found.second[j][(i, k)],
    }
}

/// The closed form with all its second derivatives.
fn closed_form(row: &Row) -> Exact<Second> {
    let seed = |direction: usize, value: f64| -> Second {
        let unit = |i: usize| if i == direction { 1.0 } else { 0.0 };
        let value = Dual { value, derivative: core::array::from_fn(unit) };
        Dual { value, derivative: core::array::from_fn(|i| Dual { value: unit(i), derivative: [0.0; DIRECTIONS] }) }
    };
    let x = core::array::from_fn(|i| seed(i, row.start[i]));
    let p = core::array::from_fn(|i| seed(3 + i, row.p[i]));
    exact(row.of, &x, &p).expect("has a closed form")
}

/// A point at the distance `away` of the row's own. Only what no system takes for a number of something is varied.
fn moved(row: &Row, away: f64) -> Row {
    let mut moved = row.clone();
    let by = |value: f64, i: usize| value + away * value.abs().max(0.1) * (1.0 + 0.37 * i as f64).sin();
    for i in 0..3 {
        moved.start[i] = by(row.start[i], i);
    }
    for i in [0, 1, 5] {
        moved.p[i] = by(row.p[i], 3 + i);
    }
    moved
}

fn batches(row: &Row, plan: &Plan, say: &mut impl FnMut(String)) {
    let rows = AWAY.map(|away| moved(row, away));
    let (z, p) = (rows.iter().map(|r| r.start), rows.iter().map(|r| r.p));
    let (z, p): (Vec<[f64; 3]>, Vec<[f64; 6]>) = (z.collect(), p.collect());
    let mut batch = Images::default();
    let points = Points { coordinates: z.as_flattened(), parameters: p.as_flattened() };
    FAMILY.replay(plan, points, &mut batch).expect("a batch of nine");
    if !batch.held[0] {
        say("does not hold where it was made".to_owned());
    }
    for (i, row) in rows.iter().enumerate() {
        let mut single = Images::default();
        let point = Points { coordinates: &row.start, parameters: &row.p };
        FAMILY.replay(plan, point, &mut single).expect("one point");
        if bits(&single, 0) != bits(&batch, i) {
            say(format!("point {i} is {:?} alone, {:?} in lanes", bits(&single, 0), bits(&batch, i)));
        }
        if single.held[0] {
            against_run(row, &single, &mut |what| say(format!("{:e} away: {what}", AWAY[i])));
        }
    }
}

/// Whether the plan held, and all numbers of an image.
fn bits(images: &Images, i: usize) -> (bool, Vec<u64>) {
    let parts = [
        &images.coordinates[3 * i..3 * i + 3],
        &images.jacobians[9 * i..9 * i + 9],
        &images.durations[i..=i],
        &images.duration_gradients[3 * i..3 * i + 3],
    ];
    // What did not hold is not a number of one kind or another.
    let bits = parts.concat().iter().map(|v| if v.is_nan() { u64::MAX } else { v.to_bits() }).collect();
    (images.held[i], bits)
}

fn against_run(row: &Row, image: &Images, say: &mut impl FnMut(String)) {
    let run = match row.run(Method::Explicit, Sensitivity::Coordinates) {
        MapOutcome::Completed(run) => run,
        MapOutcome::Stopped(stop) => return say(format!("held, but the run stops: {stop:?}")),
    };
    let jacobian = image.jacobian(0, 3);
    let pairs = [
        ("state", image.coordinates.as_slice(), run.coordinates.as_slice()),
        ("jacobian", jacobian.as_slice(), run.jacobian.as_slice()),
        ("duration", image.durations.as_slice(), &[run.duration]),
        ("its derivative", image.duration_gradients.as_slice(), run.duration_gradient.as_slice()),
    ];
    let derivatives = run.jacobian.amax().max(run.duration_gradient.amax()).max(1.0);
    for (what, replay, run) in pairs {
        let within = if what == "state" || what == "duration" {
            row.times * run.iter().fold(1.0, |a: f64, b| a.max(b.abs()))
        } else {
            row.derivatives * derivatives
        };
        for (i, (a, b)) in replay.iter().zip(run).enumerate() {
            if !near(*a, *b, within, SAME) {
                say(format!("held, but {what} {i} is {a}, and {b} in the run, off by {:e}", a - b));
            }
        }
    }
}
