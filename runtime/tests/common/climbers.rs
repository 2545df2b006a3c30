//! The climbers of prescribed leg length: M_L (a step lasts half a period) and M_A (a step ends at an angle).
//!
//! Parameters: l_s, l_b, g, psi, omega, m (M_L and M_A alike).

use super::auto::{Auto, Equations, c};
use core::f64::consts::PI;
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::model::{Direction, Env, Functional, ModeInfo, ModelInfo, Quantity, Section, TransitionInfo};
use gaitc_runtime::scalar::Scalar;

pub const fn quantity(name: &'static str) -> Quantity {
    Quantity { name, si: "1" }
}

const PARAMETERS: &[Quantity] =
    &[quantity("l_s"), quantity("l_b"), quantity("g"), quantity("psi"), quantity("omega"), quantity("m")];

/// Parameter values of the thesis at a sprawl angle in degrees.
pub fn parameters(psi_degrees: f64) -> [f64; 6] {
    [0.13, 0.5, 9.81, psi_degrees.to_radians(), 2.0 * PI * 3.0, 2.6]
}

/// An empty description to fill in.
pub const BLANK: ModelInfo = ModelInfo {
    name: "blank",
    fingerprint: "",
    parameters: &[],
    states: &[],
    memory: &[],
    modes: &[],
    transitions: &[],
    switches: &[],
    coordinates: &[],
    section: Some(Section::After(0)),
    symmetric: false,
    functionals: &[],
    measures: &[],
    returning: &[],
    uses_time: false,
    explicit: true,
};

/// The length r(tau) and its first two derivatives; `moving` is the selector of tau <= pi/omega.
fn leg<S: Scalar, const P: usize>(env: &Env<'_, S, P>) -> [S; 3] {
    let (l_s, l_b, omega) = (env.p[0], env.p[1], env.p[4]);
    let (half, phase) = (l_s * c(0.5), omega * env.tau);
    let moving = env.branch[0];
    let zero = c(0.0);
    let pick = |a: S, b: S| S::select(moving, a, b);
    [
        pick(l_b + half * (c::<S>(1.0) + phase.cos()), l_b),
        pick(-(half * omega * phase.sin()), zero),
        pick(-(half * omega * omega * phase.cos()), zero),
    ]
}

fn pendulum<S: Scalar, const P: usize>(x: &[S; 2], env: &Env<'_, S, P>) -> [S; 2] {
    let [r, v, _] = leg(env);
    [x[1] / r, -(env.p[2] * x[0].sin()) - v * x[1] / r]
}

fn pendulum_variational<S: Scalar, const C: usize, const P: usize>(
    x: &[S; 2],
    dx: &[[S; 2]; C],
    env: &Env<'_, S, P>,
) -> ([S; 2], [[S; 2]; C]) {
    let [r, v, _] = leg(env);
    let inverse = c::<S>(1.0) / r;
    let (sin, cos) = (x[0].sin(), x[0].cos());
    let (pull, drag) = (-(env.p[2] * cos), -(v * inverse));
    let flow = [x[1] * inverse, drag * x[1] - env.p[2] * sin];
    (flow, core::array::from_fn(|k| [dx[k][1] * inverse, pull * dx[k][0] + drag * dx[k][1]]))
}

fn force<S: Scalar, const P: usize>(x: &[S; 2], env: &Env<'_, S, P>) -> S {
    let [r, _, a] = leg(env);
    let m = env.p[5];
    -(m * a) + m * env.p[2] * x[0].cos() + m * x[1] * x[1] / r
}

/// M_L with the measures of its spec.
#[derive(Clone, Copy, Debug, Default)]
pub struct PrescribedLength;

pub static M_L: Hybrid<Auto<PrescribedLength>, 2, 6, 3> = Hybrid::new();

impl Equations<2, 6, 3> for PrescribedLength {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "prescribed_length",
        parameters: PARAMETERS,
        states: &[quantity("q_theta"), quantity("p_theta")],
        memory: &["n"],
        modes: &[ModeInfo { name: "stance", switches: &[0], measured_switches: &[0, 1, 2, 3] }],
        transitions: &[TransitionInfo { name: "step", from: 0, to: 0, direction: Direction::Falling, also_zero: &[] }],
        switches: &["tau <= pi/omega", "abs(v_x)", "abs(rho_a)", "max(power, 0)"],
        coordinates: &[0, 1],
        symmetric: true,
        functionals: &[
            Functional::Mean(0),
            Functional::Mean(1),
            Functional::Duration,
            Functional::Maximum(0),
            Functional::Mean(2),
            Functional::Minimum(1),
            Functional::Start(1),
            Functional::End(1),
        ],
        measures: &[
            quantity("climb_speed"),
            quantity("lateral_speed"),
            quantity("stride_frequency"),
            quantity("peak_force"),
            quantity("mean_power"),
            quantity("cost_of_transport"),
            quantity("lowest_speed"),
            quantity("start_speed"),
            quantity("end_speed"),
        ],
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 6>) -> [S; 2] {
        pendulum(x, env)
    }
    fn variational<S: Scalar, const C: usize>(
        _: usize,
        x: &[S; 2],
        dx: &[[S; 2]; C],
        env: &Env<'_, S, 6>,
    ) -> ([S; 2], [[S; 2]; C]) {
        pendulum_variational(x, dx, env)
    }
    fn guard<S: Scalar>(_: usize, _: &[S; 2], env: &Env<'_, S, 6>) -> S {
        c::<S>(PI) / env.p[4] - env.tau
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 6>, memory: &mut [S]) -> [S; 2] {
        let psi2 = env.p[3] * c(2.0);
        let delta = psi2 * c::<S>(-1.0).pow(env.memory[0]);
        memory[0] = env.memory[0] + c(1.0);
        [x[0] + delta, psi2.cos() * x[1]]
    }
    fn embed<S: Scalar>(z: &[S], _: &[S; 6]) -> [S; 2] {
        [z[0], z[1]]
    }
    fn symmetry<S: Scalar>(x: &[S; 2], _: &[S; 6]) -> [S; 2] {
        [-x[0], -x[1]]
    }
    fn integrands<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 6>) -> [S; 3] {
        let [_, v, _] = leg(env);
        let (sin, cos) = (x[0].sin(), x[0].cos());
        let v_x = v * sin + x[1] * cos;
        let power = -(force(x, env) * v);
        [-(v * cos) + x[1] * sin, S::select(env.branch[1], v_x, -v_x), S::select(env.branch[3], power, c(0.0))]
    }
    fn switch<S: Scalar>(i: usize, x: &[S; 2], env: &Env<'_, S, 6>) -> S {
        let [_, v, _] = leg(env);
        match i {
            0 => c::<S>(PI) / env.p[4] - env.tau,
            1 => v * x[0].sin() + x[1] * x[0].cos(),
            2 => force(x, env),
            _ => -(force(x, env) * v),
        }
    }
    fn observable<S: Scalar>(i: usize, _: usize, x: &[S; 2], env: &Env<'_, S, 6>) -> S {
        let f = force(x, env);
        if i == 0 { S::select(env.branch[2], f, -f) } else { x[1] }
    }
    fn measures<S: Scalar>(f: &[S], p: &[S; 6], out: &mut [S]) {
        out[0] = f[0];
        out[1] = f[1];
        out[2] = c::<S>(0.5) / f[2];
        out[3] = f[3];
        out[4] = f[4];
        out[5] = f[4] / (p[5] * p[2] * f[0]);
        out[6] = f[5];
        out[7] = f[6];
        out[8] = f[7];
    }
}

/// M_A: the step ends when the leg falls back to the sprawl angle.
#[derive(Clone, Copy, Debug, Default)]
pub struct AngleSwitched;

pub static M_A: Hybrid<Auto<AngleSwitched>, 2, 6, 0> = Hybrid::new();

impl Equations<2, 6, 0> for AngleSwitched {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "angle_switched",
        parameters: PARAMETERS,
        states: &[quantity("q_theta"), quantity("p_theta")],
        modes: &[ModeInfo { name: "stance", switches: &[0], measured_switches: &[0] }],
        transitions: &[TransitionInfo { name: "step", from: 0, to: 0, direction: Direction::Falling, also_zero: &[] }],
        switches: &["tau <= pi/omega"],
        coordinates: &[1],
        symmetric: true,
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 6>) -> [S; 2] {
        pendulum(x, env)
    }
    fn variational<S: Scalar, const C: usize>(
        _: usize,
        x: &[S; 2],
        dx: &[[S; 2]; C],
        env: &Env<'_, S, 6>,
    ) -> ([S; 2], [[S; 2]; C]) {
        pendulum_variational(x, dx, env)
    }
    fn guard<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 6>) -> S {
        x[0] - env.p[3]
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 2], env: &Env<'_, S, 6>, _: &mut [S]) -> [S; 2] {
        let psi2 = env.p[3] * c(2.0);
        [x[0] - psi2, psi2.cos() * x[1]]
    }
    fn embed<S: Scalar>(z: &[S], p: &[S; 6]) -> [S; 2] {
        [p[3], z[0]]
    }
    fn symmetry<S: Scalar>(x: &[S; 2], _: &[S; 6]) -> [S; 2] {
        [-x[0], -x[1]]
    }
    fn switch<S: Scalar>(_: usize, _: &[S; 2], env: &Env<'_, S, 6>) -> S {
        c::<S>(PI) / env.p[4] - env.tau
    }
}
