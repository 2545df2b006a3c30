//! Integration of smooth pieces: one step, its error, its dense output, the step size; by an explicit method of order 8
//! for y' = f(tau, y), and by Radau IIA for F(tau, x, x') = 0.
//!
//! What is integrated is a [`Bundle`]: state, integrals and the variations of both. Nothing here knows of guards or
//! resets; the implicit method sees a model through [`radau::Implicit`] only.

mod bundle;
mod control;
pub mod explicit;
pub mod radau;
mod step;

pub use bundle::{Blocks, Bundle, OdeState};
pub use control::{Controller, first_step};
pub use step::{Step, Tolerance};
