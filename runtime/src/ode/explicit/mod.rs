//! The explicit Runge-Kutta method of order 8 by Dormand and Prince, with dense output of order 7.

mod coefficients;
mod dense;
mod step;

pub use dense::Dense;
pub use step::{ERROR_WEIGHTS, NODES, Rates, Stages, attempt, error, stage_times, stiffness};

/// The error estimate behaves like h to this power.
pub const ERROR_ORDER: f64 = 8.0;

#[cfg(test)]
mod tests;
