//! First derivatives of a run with respect to section coordinates and parameters.
//!
//! Inside a segment: the variational equations, advanced with the state. Across an event: [`saltation_matrix`].

mod dual;
mod saltation;

pub use dual::Dual;
pub use saltation::{Clock, Crossing, saltation_matrix};
pub(crate) use saltation::{dot, through};
