//! Periodic orbits: gaits as fixed points of the return map, and their multipliers.
//!
//! [`find_gait`] solves P(z) = z; [`multipliers`] are the eigenvalues of dP/dz there. A gait is stable where all of
//! them are smaller than 1 in magnitude.

pub(crate) mod follow;
mod gait;
mod message;
mod multiple;
mod multipliers;
mod newton;
mod shooting;

pub use gait::{Gait, GaitOutcome, GaitRequest, GaitStatus};
pub use message::why;
pub use multipliers::{multipliers, spectral_radius};
pub use newton::find_gait;
