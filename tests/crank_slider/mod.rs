//! A second formulation of the self-exciting climber with its crank-slider, to test gaitc against: the crank angle as
//! independent variable, solved by collocation. It shares nothing with gaitc but the physics.
//!
//! In time the equation for the crank speed Omega is singular at both dead centres. Over the crank angle phi the step is the fixed
//! interval from 0 to pi, without an event; the equation is singular at its ends alone, where it reads Omega = omega_nl/G.

#![allow(dead_code, unreachable_pub)] // shared by tests and benches, none of which uses all of it

pub mod chebyshev;
pub mod gait;
pub mod machine;
pub mod measures;
pub mod step;

/// The machines that gaitc is compared on: sprawl, gear ratio and spring over the range of interest. At low gear ratios
/// the crank overspeeds in a thin layer before the dead centre.
pub fn cases() -> Vec<machine::Machine> {
    let mut all = Vec::new();
    for degrees in [15.0, 20.0, 25.0, 30.0] {
        for gear in [15.0, 20.0, 30.0, 56.57, 100.0] {
            for stiffness in [0.0, 200.0] {
                all.push(machine::Machine::new(degrees, gear, stiffness));
            }
        }
    }
    all
}
