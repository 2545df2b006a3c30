//! Saltation matrices as literals: the derivative of a map at a fixed time is the product of flows and saltation matrices.

use crate::check::Row;
use crate::family::{EITHER, Of};
use approx::assert_abs_diff_eq;
use gaitc_runtime::return_map::{MapOutcome, MapResult, Method, Sensitivity};
use nalgebra::{DMatrix, Matrix3};

fn map(row: &Row) -> [MapResult; 2] {
    [Method::Explicit, Method::Radau5].map(|method| match row.run(method, Sensitivity::Coordinates) {
        MapOutcome::Completed(result) => *result,
        MapOutcome::Stopped(stop) => panic!("{stop:?}"),
    })
}

fn same(row: &Row, exact: &Matrix3<f64>) {
    let exact = DMatrix::from_fn(3, 3, |i, j| exact[(i, j)]);
    let [explicit, implicit] = map(row);
    assert_abs_diff_eq!(explicit.jacobian, exact, epsilon = 1e-12);
    assert_abs_diff_eq!(implicit.jacobian, exact, epsilon = 1e-10);
}

fn flight(t: f64) -> Matrix3<f64> {
    Matrix3::new(1.0, t, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
}

/// Xi = [[-e, 0], [-(1 + e) g/v, -e]].
#[test]
fn impact() {
    let (g, e, y, v, last) = (9.81_f64, 0.7, 1.0, 0.5, 0.8);
    let impact = -(v * v + 2.0 * g * y).sqrt();
    let t = (v - impact) / g;
    let xi = Matrix3::new(-e, 0.0, 0.0, -(1.0 + e) * g / impact, -e, 0.0, 0.0, 0.0, 1.0);
    let row = Row::new("impact", Of::Ball, [y, v, 0.0], [g, e, 0.0, 0.0, 0.0, last]);
    same(&row, &(flight(last - t) * xi * flight(t)));
}

/// On a floor that moves with u: Xi = [[-e, 0], [-(1 + e) g/(v - u), -e]], by g_t in the transversality.
#[test]
fn impact_on_a_moving_floor() {
    let (g, e, u, y, v, last) = (9.81_f64, 0.7, 0.3, 1.0, 0.5, 0.8);
    let impact = -((v - u) * (v - u) + 2.0 * g * y).sqrt();
    let t = (v - u - impact) / g;
    let xi = Matrix3::new(-e, 0.0, 0.0, -(1.0 + e) * g / impact, -e, 0.0, 0.0, 0.0, 1.0);
    let row = Row::new("floor", Of::Ball, [y, v, 0.0], [g, e, u, 0.0, 0.0, last]);
    same(&row, &(flight(last - t) * xi * flight(t)));
}

/// The flow jumps by J = (0, d - c, 0) at h = a + b y - x: Xi = 1 + J h_x/(h_x f-).
#[test]
fn jump_of_the_flow() {
    let (a, b, before, after) = (0.5, 0.3, 0.4, -0.7);
    let slope = -1.0 + b * before;
    let jump = (after - before) / slope;
    let xi = Matrix3::new(1.0, 0.0, 0.0, -jump, 1.0 + b * jump, 0.0, 0.0, 0.0, 1.0);
    let row = Row::new("jump", Of::Jump, [0.1, 0.2, 0.0], [a, b, before, after, 0.0, 1.0]);
    same(&row, &xi);
}

/// A surface that changes nothing: Xi = 1, and the map is the rotation.
#[test]
fn surface_without_effect() {
    let (sin, cos) = 12.0_f64.sin_cos();
    let rotation = Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0);
    let row = Row::new("surface", Of::Harmonic, [0.6, 0.8, 0.1], [0.3, 0.0, EITHER as f64, 0.0, 0.0, 12.0]);
    let [explicit, _] = map(&row);
    assert_eq!(explicit.events.len(), 4);
    same(&row, &rotation);
}

/// A time event at tau = a with the reset z + x t: Xi = R_x, the flow jumps by nothing but R_t.
#[test]
fn time_event() {
    let (a, last) = (0.7, 1.0);
    let row = Row::new("clock", Of::Clocks, [0.1, -0.2, 0.3], [a, 9.0, 0.4, 0.5, 0.0, last]);
    let xi = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, a, 0.0, 1.0);
    same(&row, &(flight(last - a) * xi * flight(a)));
}
