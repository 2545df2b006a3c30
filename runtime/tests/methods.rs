//! The same models by different methods; stiffness; starts that contradict the equations.

#![allow(clippy::unwrap_used)] // a failed expectation is a failed test

mod common;
#[path = "trajectory/climbers.rs"]
mod followed;
mod trajectory;

use approx::assert_abs_diff_eq;
use common::auto::{Auto, Equations, c};
use common::climbers::{BLANK, M_A, M_L, parameters, quantity};
use common::crank::M_S;
use common::{check_derivatives, completed, request, stopped};
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::model::{Direction, Env, Functional, ModeInfo, ModelInfo, TransitionInfo};
use gaitc_runtime::return_map::{Accuracy, MapResult, Method, RequestError, ReturnMap, Sensitivity, StopReason};
use gaitc_runtime::scalar::Scalar;

fn by(method: Method) -> Accuracy {
    Accuracy { method, ..Accuracy::default() }
}

fn assert_same(a: &MapResult, b: &MapResult, tolerance: f64) {
    let pairs = a.coordinates.iter().zip(&b.coordinates).chain(a.jacobian.iter().zip(&b.jacobian));
    let pairs =
        pairs.chain(a.measures.iter().zip(&b.measures)).chain(a.measures_jacobian.iter().zip(&b.measures_jacobian));
    for (a, b) in pairs {
        assert!((a - b).abs() <= tolerance * (1.0 + a.abs()), "{a} {b}");
    }
    assert_abs_diff_eq!(a.duration, b.duration, epsilon = tolerance);
}

#[test]
fn explicit_and_implicit_methods_agree_on_the_climbers() {
    for (map, z, psi) in [(&M_L as &dyn ReturnMap, &[-0.4, -0.3][..], 25.0), (&M_A, &[1.3][..], 10.0)] {
        let p = parameters(psi);
        let measures = !map.info().measures.is_empty();
        let sensitivity = Sensitivity::CoordinatesAndParameters(&[1, 3]);
        let memory = vec![0.0; map.info().memory.len()];
        let with = |method| {
            let accuracy = by(method);
            completed(
                map,
                &gaitc_runtime::return_map::MapRequest {
                    accuracy,
                    measures,
                    memory: &memory,
                    ..request(z, &p, sensitivity)
                },
            )
        };
        let explicit = with(Method::Explicit);
        let five = with(Method::Radau5);
        assert_eq!((explicit.method, five.method), (Method::Explicit, Method::Radau5));
        assert_same(&explicit, &five, 1e-10);
        assert_eq!(with(Method::Automatic).method, Method::Explicit);
    }
}

#[test]
fn the_third_method_is_there_for_mass_matrices() {
    let (p, memory) = (parameters(25.0), [0.0]);
    let mut wanted =
        gaitc_runtime::return_map::MapRequest { memory: &memory, ..request(&[-0.4, -0.3], &p, Sensitivity::None) };
    wanted.accuracy = by(Method::Radau3);
    assert_eq!(M_L.evaluate(&wanted).unwrap_err(), RequestError::NoMassMatrix(M_L.info().name));
}

#[test]
fn the_explicit_method_needs_an_explicit_flow() {
    let p = common::crank::parameters(56.57, 58.0, 20.0);
    let mut wanted = request(&[-0.35, -0.2], &p, Sensitivity::None);
    wanted.accuracy = by(Method::Explicit);
    assert_eq!(M_S.evaluate(&wanted).unwrap_err(), RequestError::NoExplicitFlow("crank_slider"));
}

/// A state that follows cos(tau) at the rate p_0: stiff when that is large; a map after 3 s.
#[derive(Clone, Copy, Debug, Default)]
struct Follower;

static FOLLOWER: Hybrid<Auto<Follower>, 2, 1, 1> = Hybrid::new();

impl Equations<2, 1, 1> for Follower {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "follower",
        parameters: &[quantity("rate")],
        states: &[quantity("x"), quantity("y")],
        modes: &[ModeInfo { name: "only", switches: &[], measured_switches: &[] }],
        transitions: &[TransitionInfo { name: "turn", from: 0, to: 0, direction: Direction::Falling, also_zero: &[] }],
        coordinates: &[0, 1],
        functionals: &[Functional::Integral(0), Functional::Duration],
        measures: &[quantity("area"), quantity("duration")],
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 1>) -> [S; 2] {
        [env.p[0] * (env.tau.cos() - x[0]), x[0]]
    }
    fn integrands<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 1>) -> [S; 1] {
        [x[0] * x[0]]
    }
    fn guard<S: Scalar>(_: usize, _: &[S; 2], env: &Env<'_, S, 1>) -> S {
        c::<S>(3.0) - env.tau
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 2], _: &Env<'_, S, 1>, _: &mut [S]) -> [S; 2] {
        *x
    }
    fn embed<S: Scalar>(z: &[S], _: &[S; 1]) -> [S; 2] {
        [z[0], z[1]]
    }
}

/// x = (L^2 cos t + L sin t)/(L^2 + 1) + (x_0 - L^2/(L^2 + 1)) e^(-L t).
fn follower(rate: f64, x: f64, t: f64) -> f64 {
    let n = rate * rate + 1.0;
    (rate * rate * t.cos() + rate * t.sin()) / n + (x - rate * rate / n) * (-rate * t).exp()
}

#[test]
fn stiff_runs_are_noticed_and_go_on_implicitly() {
    for (rate, expected) in [(1.0, Method::Explicit), (1e6, Method::Radau5)] {
        let p = [rate];
        let map = completed(&FOLLOWER, &request(&[0.3, 0.0], &p, Sensitivity::Coordinates));
        assert_eq!(map.method, expected);
        assert_abs_diff_eq!(map.coordinates[0], follower(rate, 0.3, 3.0), epsilon = 1e-11);
        assert_abs_diff_eq!(map.jacobian[(0, 0)], (-rate * 3.0).exp(), epsilon = 1e-12);
        assert!(map.statistics.steps < 200, "{:?}", map.statistics);
    }
    // By name it is what was asked for.
    let mut wanted = request(&[0.3, 0.0], &[1e4], Sensitivity::None);
    wanted.accuracy = Accuracy { relative: 1e-8, absolute: 1e-9, step_limit: 3000, ..by(Method::Explicit) };
    assert_eq!(stopped(&FOLLOWER, &wanted).reason, StopReason::StepLimit);
}

#[test]
fn parameters_of_a_stiff_run() {
    let mut wanted = request(&[0.3, 0.0], &[40.0], Sensitivity::None);
    wanted.accuracy = by(Method::Radau5);
    check_derivatives(&FOLLOWER, &wanted, &[0], 1e-8);
}

/// 0 x' = x - 1 at first, then an ordinary equation: (tau^2) x' = 1 - x has no solution from x(0) = 2.
#[derive(Clone, Copy, Debug, Default)]
struct Slaved;

static SLAVED: Hybrid<Auto<Slaved>, 1, 0, 0> = Hybrid::new();

impl Equations<1, 0, 0> for Slaved {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "slaved",
        states: &[quantity("x")],
        modes: &[ModeInfo { name: "only", switches: &[], measured_switches: &[] }],
        transitions: &[TransitionInfo { name: "turn", from: 0, to: 0, direction: Direction::Falling, also_zero: &[] }],
        coordinates: &[0],
        explicit: false,
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, _: &[S; 1], _: &Env<'_, S, 0>) -> [S; 1] {
        [c(f64::NAN)]
    }
    fn residual<S: Scalar>(_: usize, x: &[S; 1], k: &[S; 1], env: &Env<'_, S, 0>) -> [S; 1] {
        let mass = env.tau * env.tau;
        [mass * k[0] - env.tau.exp() * (mass + c(1.0)) + x[0]]
    }
    fn guard<S: Scalar>(_: usize, _: &[S; 1], env: &Env<'_, S, 0>) -> S {
        c::<S>(2.0) - env.tau
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 1], _: &Env<'_, S, 0>, _: &mut [S]) -> [S; 1] {
        *x
    }
    fn embed<S: Scalar>(z: &[S], _: &[S; 0]) -> [S; 1] {
        [z[0]]
    }
}

#[test]
fn a_start_that_contradicts_the_equations_is_named() {
    // The mass makes this state stiff nearly to the end, where the method has order 6 and not 10: its error falls like the
    // tolerance to the power 0.6.
    for relative in [1e-6, 1e-8, 1e-10, 1e-12] {
        let mut wanted = request(&[1.0], &[], Sensitivity::None);
        wanted.accuracy = Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() };
        let good = completed(&SLAVED, &wanted);
        assert_abs_diff_eq!(good.coordinates[0], 2f64.exp(), epsilon = 0.1 * relative.powf(0.6));
    }
    assert_eq!(stopped(&SLAVED, &request(&[2.0], &[], Sensitivity::None)).reason, StopReason::Inconsistent);
    assert_eq!(stopped(&SLAVED, &request(&[1e-300], &[], Sensitivity::None)).reason, StopReason::Inconsistent);
}
