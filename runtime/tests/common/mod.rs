//! Models written by hand for the tests, and helpers to evaluate their maps.
//!
//! A test model states its equations once ([`Equations`]); [`Auto`] turns them into the full ABI with derivatives by
//! dual numbers, a route that shares nothing with the compiler.

#![allow(dead_code, unreachable_pub, missing_docs)] // each test file uses a part of this
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

pub mod auto;
pub mod climbers;
pub mod crank;
pub mod formula;
pub mod toys;

use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, ReturnMap, Sensitivity, Stop};

/// A request with the defaults that most tests use.
pub fn request<'a>(z: &'a [f64], p: &'a [f64], sensitivity: Sensitivity<'a>) -> MapRequest<'a> {
    MapRequest {
        coordinates: z,
        parameters: p,
        memory: &[],
        period: 1,
        sensitivity,
        measures: false,
        accuracy: Accuracy::default(),
    }
}

/// The completed map.
pub fn completed(map: &dyn ReturnMap, request: &MapRequest<'_>) -> MapResult {
    match map.evaluate(request).unwrap() {
        MapOutcome::Completed(result) => *result,
        MapOutcome::Stopped(stop) => panic!("stopped: {stop:?}"),
    }
}

/// The stop.
pub fn stopped(map: &dyn ReturnMap, request: &MapRequest<'_>) -> Stop {
    match map.evaluate(request).unwrap() {
        MapOutcome::Completed(result) => panic!("completed: {result:?}"),
        MapOutcome::Stopped(stop) => stop,
    }
}

/// Compares all derivatives of a map (coordinates, duration, measures) with fourth-order central differences.
pub fn check_derivatives(map: &dyn ReturnMap, base: &MapRequest<'_>, parameters: &[usize], tolerance: f64) {
    check_derivatives_where(map, base, parameters, tolerance, |_| true);
}

/// The same for the rows (coordinates, duration, measures) that are wanted.
pub fn check_derivatives_where(
    map: &dyn ReturnMap,
    base: &MapRequest<'_>,
    parameters: &[usize],
    tolerance: f64,
    wanted: impl Fn(usize) -> bool,
) {
    let exact_request = MapRequest {
        sensitivity: Sensitivity::CoordinatesAndParameters(parameters),
        measures: !map.info().measures.is_empty(),
        ..*base
    };
    let exact = completed(map, &exact_request);
    let d = base.coordinates.len();
    for column in 0..d + parameters.len() {
        let at = |shift: f64| {
            let (mut z, mut p) = (base.coordinates.to_vec(), base.parameters.to_vec());
            if column < d {
                z[column] += shift;
            } else {
                p[parameters[column - d]] += shift;
            }
            let r = MapRequest { coordinates: &z, parameters: &p, sensitivity: Sensitivity::None, ..exact_request };
            let r = completed(map, &r);
            let mut all: Vec<f64> = r.coordinates.iter().copied().collect();
            all.push(r.duration);
            all.extend(r.measures.iter());
            all
        };
        let size = if column < d { base.coordinates[column] } else { base.parameters[parameters[column - d]] };
        let h = 3e-4 * size.abs().max(0.1);
        let (m2, m1, p1, p2) = (at(-2.0 * h), at(-h), at(h), at(2.0 * h));
        let mut exact_column: Vec<f64> = exact.jacobian.column(column).iter().copied().collect();
        exact_column.push(exact.duration_gradient[column]);
        exact_column.extend(exact.measures_jacobian.column(column).iter());
        for i in (0..exact_column.len()).filter(|&i| wanted(i)) {
            let difference = (m2[i] - 8.0 * m1[i] + 8.0 * p1[i] - p2[i]) / (12.0 * h);
            let scale = 1.0 + difference.abs();
            assert!(
                (exact_column[i] - difference).abs() <= tolerance * scale,
                "row {i}, column {column}: exact {} difference {difference}",
                exact_column[i]
            );
        }
    }
}
