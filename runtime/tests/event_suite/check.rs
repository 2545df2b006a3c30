//! Rows: a system with a start and parameters, and what must come of it by each method.

use crate::common::auto::Auto;
use crate::family::{Exact, Family, Of, exact};
use crate::replays::replayed;
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::return_map::{
    Accuracy, MapOutcome, MapRequest, MapResult, Method, ReturnMap, Sensitivity, StopReason, Warning,
};
use gaitc_runtime::sensitivity::Dual;

/// The one map of the suite.
pub static FAMILY: Hybrid<Auto<Family>, 3, 6, 0> = Hybrid::new();

/// A warning without its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Warned {
    /// Of this transition.
    Grazing(usize),
    /// The one taken, and the other.
    Tie(usize, usize),
}

/// One case of the suite.
#[derive(Clone, Debug)]
pub struct Row {
    name: String,
    /// The system.
    pub of: Of,
    /// Its start.
    pub start: [f64; 3],
    /// Its parameters.
    pub p: [f64; 6],
    warned: Vec<Warned>,
    stops: Option<(StopReason, f64, f64)>,
    accuracy: Accuracy,
    /// Tolerance of times and states.
    pub times: f64,
    /// Tolerance of derivatives.
    pub derivatives: f64,
    implicit: f64,
    /// Whether it need not have a plan.
    planless: bool,
    /// Whether it has first derivatives only.
    pub once: bool,
}

impl Row {
    /// Completes without warnings as its closed form says: times to 1e-12 of themselves, states to 1e-12, derivatives to 1e-11 of
    /// max(1, the largest of their column), and by the implicit method all of it to 1e-9.
    pub fn new(name: &str, of: Of, start: [f64; 3], p: [f64; 6]) -> Self {
        let accuracy = Accuracy { relative: 1e-13, absolute: 1e-14, method: Method::Explicit, ..Accuracy::default() };
        let (warned, name) = (Vec::new(), name.to_owned());
        let (times, derivatives, implicit) = (1e-12, 1e-11, 1e-9);
        let (planless, once) = (false, false);
        Self { name, of, start, p, warned, stops: None, accuracy, times, derivatives, implicit, planless, once }
    }

    /// With these warnings.
    pub fn warns(self, warned: &[Warned]) -> Self {
        Self { warned: warned.to_vec(), ..self }
    }

    /// Stops instead, at this time, to within `tolerance` of it.
    pub fn stops(self, reason: StopReason, time: f64, tolerance: f64) -> Self {
        Self { stops: Some((reason, time, tolerance)), ..self }
    }

    /// With this time limit (s).
    pub fn limit(self, time_limit: f64) -> Self {
        Self { accuracy: Accuracy { time_limit, ..self.accuracy }, ..self }
    }

    /// With these tolerances for times and states, for derivatives, and for the implicit method.
    pub fn within(self, times: f64, derivatives: f64, implicit: f64) -> Self {
        Self { times, derivatives, implicit, ..self }
    }

    /// Without a plan, or perhaps without: guards pass zero and do not fire, or almost touch it.
    pub fn planless(self) -> Self {
        Self { planless: true, ..self }
    }

    /// With first derivatives only.
    pub fn once(self) -> Self {
        Self { once: true, ..self }
    }

    /// Only by this method.
    pub fn method(self, method: Method) -> Self {
        Self { accuracy: Accuracy { method, ..self.accuracy }, ..self }
    }

    /// Evaluates the map of this row.
    pub fn run(&self, method: Method, sensitivity: Sensitivity<'_>) -> MapOutcome {
        self.ask(method, sensitivity, |request| FAMILY.evaluate(request)).unwrap()
    }

    /// What `answer` makes of the request that evaluates the map of this row.
    pub fn ask<R>(&self, method: Method, sensitivity: Sensitivity<'_>, answer: impl FnOnce(&MapRequest<'_>) -> R) -> R {
        let accuracy = Accuracy { method, ..self.accuracy };
        // The implicit method's order makes tolerances below this a waste.
        let loose = Accuracy { relative: 1e-12, absolute: 1e-13, ..accuracy };
        let memory = [self.of as usize as f64, 0.0];
        answer(&MapRequest {
            coordinates: &self.start,
            parameters: &self.p,
            memory: &memory,
            period: 1,
            sensitivity,
            measures: false,
            accuracy: if method == Method::Explicit { accuracy } else { loose },
        })
    }
}

const ALL: Sensitivity<'static> = Sensitivity::CoordinatesAndParameters(&[0, 1, 2, 3, 4, 5]);

/// Checks all rows, and tells all that is wrong.
pub fn check(rows: &[Row]) {
    let mut wrong = Vec::new();
    for row in rows {
        if row.accuracy.method == Method::Explicit {
            let tolerance = (row.times, row.derivatives);
            one(row, Method::Explicit, ALL, tolerance, &mut wrong);
            one(row, Method::Explicit, Sensitivity::Coordinates, tolerance, &mut wrong);
            one(row, Method::Radau5, ALL, (row.implicit, row.implicit), &mut wrong);
            let planned = replayed(row, &mut |what| wrong.push(format!("{} [replay]: {what}", row.name)));
            if !planned && row.stops.is_none() && row.warned.is_empty() && !row.planless {
                wrong.push(format!("{} has no plan", row.name));
            }
        } else {
            one(row, row.accuracy.method, ALL, (row.times, row.derivatives), &mut wrong);
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

fn one(row: &Row, method: Method, sensitivity: Sensitivity<'_>, tolerance: (f64, f64), wrong: &mut Vec<String>) {
    let mut say = |what: String| wrong.push(format!("{} [{method:?}]: {what}", row.name));
    match (row.run(method, sensitivity), row.stops) {
        (MapOutcome::Completed(_), Some(stop)) => say(format!("completed instead of {stop:?}")),
        (MapOutcome::Completed(result), None) => completed(row, &result, tolerance, &mut say),
        (MapOutcome::Stopped(stop), Some((reason, time, tolerance))) => {
            if stop.reason != reason || !near(stop.time, time, time.abs(), tolerance) {
                say(format!("{stop:?}, expected {reason:?} at {time}"));
            }
        }
        (MapOutcome::Stopped(stop), None) => say(format!("{stop:?}")),
    }
}

/// Written so that what is no number is not near.
pub fn near(got: f64, expected: f64, scale: f64, tolerance: f64) -> bool {
    (got - expected).abs() <= tolerance * scale
}

fn completed(row: &Row, r: &MapResult, (times, derivatives): (f64, f64), say: &mut impl FnMut(String)) {
    let Some(exact) = exact(row.of, &row.start, &row.p) else {
        return say(format!("has no closed form, got {r:?}"));
    };
    let transitions: Vec<usize> = r.events.iter().map(|e| e.transition).collect();
    let expected: Vec<usize> = exact.events.iter().map(|e| e.0).collect();
    if transitions != expected {
        return say(format!("events {:?}, expected {:?}", r.events, exact.events));
    }
    for (event, (_, time)) in r.events.iter().zip(&exact.events) {
        if !near(event.time, *time, *time, times) {
            say(format!(
                "event {} at {}, expected {time}, off by {:e}",
                event.transition,
                event.time,
                event.time - time
            ));
        }
    }
    for i in 0..3 {
        let (got, expected) = (r.coordinates[i], exact.end[i]);
        if !near(got, expected, expected.abs().max(1.0), times) {
            say(format!("state {i} is {got}, expected {expected}, off by {:e}", got - expected));
        }
    }
    let warned: Vec<Warned> = r.warnings.iter().map(plain).collect();
    if warned != row.warned {
        say(format!("warnings {:?}, expected {:?}", r.warnings, row.warned));
    }
    for column in 0..r.jacobian.ncols() {
        let d = derivative(row, column);
        let duration = d.events.last().map_or(f64::NAN, |e| e.1);
        let rows = (0..3).map(|i| (r.jacobian[(i, column)], d.end[i]));
        // Rounding is that of the largest.
        let scale = d.end.iter().fold(duration.abs().max(1.0), |largest, v| largest.max(v.abs()));
        for (i, (got, expected)) in rows.chain([(r.duration_gradient[column], duration)]).enumerate() {
            if !near(got, expected, scale, derivatives) {
                say(format!("derivative ({i}, {column}) is {got}, expected {expected}, off by {:e}", got - expected));
            }
        }
    }
}

/// The derivative of the closed form with respect to a state of the start or a parameter.
fn derivative(row: &Row, column: usize) -> Exact<f64> {
    let seed = |i: usize, value: f64| Dual { value, derivative: [if i == column { 1.0 } else { 0.0 }] };
    let x = core::array::from_fn(|i| seed(i, row.start[i]));
    let p = core::array::from_fn(|i| seed(i + 3, row.p[i]));
    let d = exact(row.of, &x, &p).expect("has a closed form");
    Exact { events: d.events.iter().map(|(i, t)| (*i, t.derivative[0])).collect(), end: d.end.map(|v| v.derivative[0]) }
}

/// A warning without its numbers.
pub fn plain(warning: &Warning) -> Warned {
    match *warning {
        Warning::Grazing { transition, .. } => Warned::Grazing(transition),
        Warning::Tie { taken, other, .. } => Warned::Tie(taken, other),
    }
}
