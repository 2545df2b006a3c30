//! The climber's return map and Jacobian by diffsol.
//!
//! diffsol takes mass matrices M(t) that do not depend on the state, so the equations are written over the crank angle phi, with
//! y = (Omega, q_theta, p_theta, t) and M = diag(m r'^2, 1, 1, 1), singular at phi = 0 and pi:
//!
//!   m r'^2 Omega' = (r' F + tau_crank)/Omega - m r' r'' Omega,   q_theta' = p_theta/(r Omega),
//!   p_theta' = -g sin(q_theta)/Omega - r' p_theta/r,   t' = 1/Omega
//!
//! That is in its favour: over phi the step ends at a known place and there is no event to locate. The other way, time with the
//! crank's acceleration as an algebraic unknown, has index 2 at the dead centres. Derivatives are by its forward sensitivities with an
//! analytic Jacobian. Of its implicit methods BDF is by far the fastest here: TR-BDF2 and ESDIRK34 need several times the time, and miss
//! 1e-7 or fail to converge at low gear ratios.

use crate::Mapped;
use crate::crank_slider::machine::Machine;
use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason, Vector,
};
use std::f64::consts::PI;

/// The map of section coordinates (q_theta, p_theta). The problem is set up once.
pub(crate) fn map(machine: Machine, relative: f64, absolute: f64) -> impl FnMut([f64; 2]) -> Mapped {
    let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .p([0.0, 0.0])
        .rtol(relative)
        .atol([absolute; 4])
        .rhs_sens_implicit(
            move |y, _p, phi, dy| right_hand_side(&machine, phi, y, dy),
            move |y, _p, phi, v, dy| along(&machine, phi, y, v, dy),
            |_y, _p, _phi, _v, dy| dy.fill(0.0),
        )
        .mass(move |v, _p, phi, beta, y| {
            let slope = machine.leg(phi)[1];
            for i in 0..4 {
                let mass = if i == 0 { machine.mass * slope * slope } else { 1.0 };
                y[i] = mass * v[i] + beta * y[i];
            }
        })
        .init_sens(
            move |p, _phi, y| y.copy_from_slice(&[machine.free(), p[0], p[1], 0.0]),
            |_p, _phi, v, y| y.copy_from_slice(&[0.0, v[0], v[1], 0.0]),
            4,
        )
        .build()
        .expect("the problem is well posed");
    let turn = 2.0 * machine.psi;
    let shrink = turn.cos();
    move |z| {
        let context = *problem.context();
        problem.eqn_mut().set_params(&NalgebraVec::from_vec(z.to_vec(), context));
        let mut solver = problem.bdf_sens::<NalgebraLU<f64>>().expect("the start is consistent");
        solver.set_stop_time(PI).expect("the stop lies ahead");
        while !matches!(solver.step().expect("steps succeed"), OdeSolverStopReason::TstopReached) {}
        let state = solver.state();
        // Sensitivities lie one after another: four components for each coordinate.
        let (y, s) = (state.y, state.s.clone_as_vec());
        Mapped {
            image: [-(y[1] + turn), -shrink * y[2]],
            jacobian: [-s[1], -s[5], -shrink * s[2], -shrink * s[6]],
            duration: y[3],
        }
    }
}

/// f(y, phi).
fn right_hand_side(machine: &Machine, phi: f64, y: &[f64], dy: &mut [f64]) {
    let [r, slope, bend] = machine.leg(phi);
    let [omega, q, p] = [y[0], y[1], y[2]];
    let force = slope * machine.pull_out(r, [omega, q, p]) + machine.torque(omega);
    dy[0] = force / omega - machine.mass * slope * bend * omega;
    dy[1] = p / (r * omega);
    dy[2] = -machine.gravity * q.sin() / omega - slope * p / r;
    dy[3] = 1.0 / omega;
}

/// df/dy v.
fn along(machine: &Machine, phi: f64, y: &[f64], v: &[f64], dy: &mut [f64]) {
    let [r, slope, bend] = machine.leg(phi);
    let [omega, q, p] = [y[0], y[1], y[2]];
    let (m, g) = (machine.mass, machine.gravity);
    let force = slope * machine.pull_out(r, [omega, q, p]) + machine.torque(omega);
    let pull = -m * g * q.sin() * v[1] + 2.0 * m * p / r * v[2];
    let with_force = slope * pull - machine.damping() * v[0];
    let squared = omega * omega;
    dy[0] = with_force / omega - force / squared * v[0] - m * slope * bend * v[0];
    dy[1] = v[2] / (r * omega) - p / (r * squared) * v[0];
    dy[2] = -g * q.cos() / omega * v[1] + g * q.sin() / squared * v[0] - slope * v[2] / r;
    dy[3] = -v[0] / squared;
}
