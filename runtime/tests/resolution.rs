//! Where the flow is simple and a guard or an observable is not, steps follow the guard and the observable.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

mod common;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::auto::{Auto, Equations, c};
use common::climbers::{BLANK, quantity};
use common::{completed, request};
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::model::{Direction, Env, Functional, ModeInfo, ModelInfo, TransitionInfo};
use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::return_map::{Accuracy, MapRequest, Sensitivity};
use gaitc_runtime::scalar::Scalar;
use std::f64::consts::{PI, TAU};

const ONE_MODE: &[ModeInfo] = &[ModeInfo { name: "flow", switches: &[], measured_switches: &[] }];

/// Ball on a table A sin(phi), phi' = 2 pi f. Section: (v, phi) just after the impact. Parameters g, A, f, e.
#[derive(Clone, Copy, Debug, Default)]
struct Table;
static TABLE: Hybrid<Auto<Table>, 3, 4, 0> = Hybrid::new();

impl Equations<3, 4, 0> for Table {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "table",
        parameters: &[quantity("g"), quantity("A"), quantity("f"), quantity("e")],
        states: &[quantity("h"), quantity("v"), quantity("phi")],
        modes: ONE_MODE,
        transitions: &[TransitionInfo {
            name: "impact",
            from: 0,
            to: 0,
            direction: Direction::Falling,
            also_zero: &[],
        }],
        coordinates: &[1, 2],
        symmetric: true,
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, x: &[S; 3], env: &Env<'_, S, 4>) -> [S; 3] {
        [x[1], -env.p[0], c::<S>(TAU) * env.p[2]]
    }
    fn guard<S: Scalar>(_: usize, x: &[S; 3], env: &Env<'_, S, 4>) -> S {
        x[0] - env.p[1] * x[2].sin()
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 3], env: &Env<'_, S, 4>, _: &mut [S]) -> [S; 3] {
        let [_, a, f, e] = *env.p;
        let table = a * c::<S>(TAU) * f * x[2].cos();
        [x[0], table - e * (x[1] - table), x[2]]
    }
    fn embed<S: Scalar>(z: &[S], p: &[S; 4]) -> [S; 3] {
        [p[1] * z[1].sin(), z[0], z[1]]
    }
    fn symmetry<S: Scalar>(x: &[S; 3], _: &[S; 4]) -> [S; 3] {
        [x[0], x[1], x[2] - c(TAU)]
    }
}

/// One impact in each period of the table: v = g/(2 f), and the table moves with v (1 - e)/(1 + e) at the impact.
#[test]
fn a_table_that_moves_faster_than_the_ball_is_not_flown_through() {
    let (g, a, e) = (9.81, 0.005, 0.8);
    for f in [20.0, 25.0, 40.0] {
        let v = g / (2.0 * f);
        let z = [v, (v * (1.0 - e) / (1.0 + e) / (a * TAU * f)).acos()];
        let p = [g, a, f, e];
        for relative in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
            let accuracy = Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() };
            let r = completed(&TABLE, &MapRequest { accuracy, ..request(&z, &p, Sensitivity::Coordinates) });
            assert_relative_eq!(r.duration, 1.0 / f, max_relative = 1e-11);
            assert_abs_diff_eq!(r.coordinates[0], z[0], epsilon = 1e-11);
            assert_abs_diff_eq!(r.coordinates[1], z[1], epsilon = 1e-9);
            assert_relative_eq!(r.jacobian.determinant(), e * e, max_relative = 1e-8);
        }
        let gait = find_gait(&TABLE, &GaitRequest::new(&p, &[]), &[1.0001 * z[0], z[1] + 1e-4]).unwrap().gait.unwrap();
        assert_abs_diff_eq!(gait.coordinates[1], z[1], epsilon = 1e-9);
    }
}

/// x' = phi' = 10, one turn of phi; the largest x + sin(k phi). Parameter k.
#[derive(Clone, Copy, Debug, Default)]
struct Clock;
static CLOCK: Hybrid<Auto<Clock>, 2, 1, 0> = Hybrid::new();

impl Equations<2, 1, 0> for Clock {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "clock",
        parameters: &[quantity("k")],
        states: &[quantity("x"), quantity("phi")],
        modes: ONE_MODE,
        transitions: &[TransitionInfo { name: "tick", from: 0, to: 0, direction: Direction::Rising, also_zero: &[] }],
        coordinates: &[0],
        functionals: &[Functional::Maximum(0), Functional::Minimum(0)],
        measures: &[quantity("highest"), quantity("lowest")],
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, _: &[S; 2], _: &Env<'_, S, 1>) -> [S; 2] {
        [c(10.0), c(10.0)]
    }
    fn guard<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 1>) -> S {
        x[1] - c(TAU)
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 1>, _: &mut [S]) -> [S; 2] {
        [x[0] * c(0.5), x[1] - c(TAU)]
    }
    fn embed<S: Scalar>(z: &[S], _: &[S; 1]) -> [S; 2] {
        [z[0], c(0.0)]
    }
    fn observable<S: Scalar>(_: usize, _: usize, x: &[S; 2], env: &Env<'_, S, 1>) -> S {
        x[0] + (env.p[0] * x[1]).sin()
    }
}

#[test]
fn extrema_are_found_where_the_flow_alone_allows_one_step() {
    for k in [2.0_f64, 10.0, 13.0, 40.0] {
        let r = completed(&CLOCK, &MapRequest { measures: true, ..request(&[0.0], &[k], Sensitivity::Coordinates) });
        // 1 + k cos(k phi) = 0; the last maximum and the first minimum of the turn, or its ends.
        let bend = (-1.0 / k).acos();
        let highest = (bend + TAU * (k - 1.0)) / k + bend.sin();
        let lowest = (TAU - bend) / k - bend.sin();
        assert_abs_diff_eq!(r.measures[0], highest.max(TAU), epsilon = 1e-10);
        assert_abs_diff_eq!(r.measures[1], lowest.min(0.0), epsilon = 1e-10);
        assert_abs_diff_eq!(r.duration, PI / 5.0, epsilon = 1e-13);
    }
}
