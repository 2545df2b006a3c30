//! Radau IIA collocation with S stages (order 2S - 1, stiffly accurate) for F(tau, x, x') = 0, where dF/dx' may be
//! singular at points.
//!
//! A step of size h solves F(tau + c_i h, x_i, k_i) = 0 with x_i = x + h sum_j a_ij k_j for the rates k_i of its S
//! stages. The unknowns are the rates: nothing is ever divided by the mass matrix, and no rate at the start of the step
//! is needed, so a step may start and end where the mass matrix vanishes. The last node is 1: state and rate at the end are
//! those of the last stage.
//!
//! `coefficients` has the methods, `stages` solves for the rates of the state, `variations` differentiates the solution,
//! `polynomial` is the collocation polynomial (dense output, prediction), `error` the error estimate, `elimination`, `inverse` and
//! `fused` the linear algebra.

mod coefficients;
mod elimination;
mod error;
mod fused;
mod inverse;
mod polynomial;
mod stages;
mod variations;

pub use coefficients::{RADAU3, RADAU5, Tableau};
pub use error::{size, tolerance_of_estimate};
pub use polynomial::{Polynomial, weighted};
pub use stages::{Implicit, Rates, Workspace, solve};

#[cfg(test)]
mod tests;
