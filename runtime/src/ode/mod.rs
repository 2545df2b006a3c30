//! Integration of smooth pieces: one explicit Runge-Kutta step of order 8, its error, its dense output, the step size.
//!
//! The equation is y' = f(tau, y) with y a [`Bundle`]: state, integrals and the variations of both. Nothing here knows
//! of models, guards or resets.

mod bundle;
mod coefficients;
mod control;
mod dense;
mod step;

pub use bundle::{Bundle, OdeState};
pub use control::{Controller, first_step};
pub use dense::Dense;
pub use step::{Stages, Step, Tolerance, attempt, error};

#[cfg(test)]
mod tests;
