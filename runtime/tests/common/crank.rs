//! The climber with a crank-slider in crank-angle coordinates (phi, Omega, q_theta, p_theta): its mass matrix vanishes at
//! both dead centres, phi = 0 and phi = pi.
//!
//! m r'^2 Omega' = r' (m g cos q + m p^2/r - k (r - l_b)) + tau - m r' r'' Omega^2, tau = G tau_stall (1 - G Omega/omega_nl).

use super::auto::{Auto, Equations, c};
use super::climbers::{BLANK, quantity};
use core::f64::consts::PI;
use gaitc_runtime::hybrid::Hybrid;
use gaitc_runtime::model::{Direction, Env, Functional, ModeInfo, ModelInfo, Quantity, TransitionInfo};
use gaitc_runtime::scalar::Scalar;

/// l_b, l_crank, l_coupler, m, g, omega_nl, tau_stall, G, k, psi.
const PARAMETERS: &[Quantity] = &[
    quantity("l_b"),
    quantity("l_crank"),
    quantity("l_coupler"),
    quantity("m"),
    quantity("g"),
    quantity("omega_nl"),
    quantity("tau_stall"),
    quantity("G"),
    quantity("k"),
    quantity("psi"),
];

/// Parameter values of the thesis at a gear ratio, a spring (N/m) and a sprawl angle in degrees.
pub fn parameters(gear: f64, spring: f64, psi_degrees: f64) -> [f64; 10] {
    [0.5, 0.065, 0.195, 2.6, 9.81, 1250.0, 0.321, gear, spring, psi_degrees.to_radians()]
}

/// Leg length with two derivatives in the crank angle.
fn leg<S: Scalar>(phi: S, p: &[S; 10]) -> [S; 3] {
    let [l_b, a, b, ..] = *p;
    let (sin, cos) = (phi.sin(), phi.cos());
    let root = (b * b - a * a * sin * sin).sqrt();
    let (aa, cos2) = (a * a, cos * cos - sin * sin);
    let first = -(a * sin) - aa * sin * cos / root;
    let second = -(a * cos) - aa * cos2 / root - aa * aa * sin * sin * cos * cos / (root * root * root);
    [l_b + a * cos + root - (b - a), first, second]
}

fn torque<S: Scalar>(omega: S, p: &[S; 10]) -> S {
    p[7] * p[6] * (c::<S>(1.0) - p[7] * omega / p[5])
}

#[derive(Clone, Copy, Debug, Default)]
pub struct CrankSlider;

pub static M_S: Hybrid<Auto<CrankSlider>, 4, 10, 2> = Hybrid::new();

impl Equations<4, 10, 2> for CrankSlider {
    const INFO: &'static ModelInfo = &ModelInfo {
        name: "crank_slider",
        parameters: PARAMETERS,
        states: &[quantity("phi"), quantity("Omega"), quantity("q_theta"), quantity("p_theta")],
        modes: &[ModeInfo { name: "stance", switches: &[], measured_switches: &[0, 1] }],
        transitions: &[TransitionInfo { name: "step", from: 0, to: 0, direction: Direction::Falling, also_zero: &[] }],
        switches: &["max(power, 0)", "abs(v_x)"],
        coordinates: &[2, 3],
        symmetric: true,
        functionals: &[
            Functional::Mean(0),
            Functional::Mean(1),
            Functional::Maximum(0),
            Functional::Minimum(0),
            Functional::Maximum(1),
            Functional::End(2),
        ],
        measures: &[
            quantity("climb_speed"),
            quantity("mean_power"),
            quantity("peak_pull"),
            quantity("lowest_force"),
            quantity("peak_motor_speed"),
            quantity("last_rate"),
        ],
        explicit: false,
        ..BLANK
    };
    fn flow<S: Scalar>(_: usize, _: &[S; 4], _: &Env<'_, S, 10>) -> [S; 4] {
        [c(f64::NAN); 4]
    }
    fn residual<S: Scalar>(_: usize, x: &[S; 4], k: &[S; 4], env: &Env<'_, S, 10>) -> [S; 4] {
        let ([phi, omega, q, speed], p) = (*x, env.p);
        let [r, d, dd] = leg(phi, p);
        let (m, g) = (p[3], p[4]);
        let force = m * g * q.cos() + m * speed * speed / r - p[8] * (r - p[0]);
        [
            k[0] - omega,
            m * d * d * k[1] - d * force - torque(omega, p) + m * d * dd * omega * omega,
            k[2] - speed / r,
            k[3] + g * q.sin() + d * omega * speed / r,
        ]
    }
    fn integrands_with_rate<S: Scalar>(_: usize, x: &[S; 4], _: &[S; 4], env: &Env<'_, S, 10>) -> [S; 2] {
        let ([phi, omega, q, speed], p) = (*x, env.p);
        let v_r = leg(phi, p)[1] * omega;
        let power = torque(omega, p) * omega;
        [speed * q.sin() - v_r * q.cos(), S::select(env.branch[0], power, c(0.0))]
    }
    fn switch<S: Scalar>(i: usize, x: &[S; 4], env: &Env<'_, S, 10>) -> S {
        match i {
            0 => torque(x[1], env.p) * x[1],
            // The sideways speed; nothing depends on it, but it has to be located.
            _ => leg(x[0], env.p)[1] * x[1] * x[2].sin() + x[3] * x[2].cos(),
        }
    }
    fn observable_with_rate<S: Scalar>(i: usize, _: usize, x: &[S; 4], k: &[S; 4], env: &Env<'_, S, 10>) -> S {
        let ([phi, omega, q, speed], p) = (*x, env.p);
        let [r, d, dd] = leg(phi, p);
        match i {
            0 => p[3] * (p[4] * q.cos() + speed * speed / r - dd * omega * k[0] - d * k[1]),
            1 => p[7] * omega,
            _ => k[1],
        }
    }
    fn guard<S: Scalar>(_: usize, x: &[S; 4], _: &Env<'_, S, 10>) -> S {
        c::<S>(PI) - x[0]
    }
    fn reset<S: Scalar>(_: usize, x: &[S; 4], env: &Env<'_, S, 10>, _: &mut [S]) -> [S; 4] {
        let p = env.p;
        let delta = p[9] + p[9];
        let v_r = leg(x[0], p)[1] * x[1];
        [c(0.0), p[5] / p[7], x[2] + delta, delta.cos() * x[3] - delta.sin() * v_r]
    }
    fn embed<S: Scalar>(z: &[S], p: &[S; 10]) -> [S; 4] {
        [c(0.0), p[5] / p[7], z[0], z[1]]
    }
    fn symmetry<S: Scalar>(x: &[S; 4], _: &[S; 10]) -> [S; 4] {
        [x[0], x[1], -x[2], -x[3]]
    }
}
