//! Studies: questions about many gaits at once. They see a model only through its return map.
//!
//! `sweep` and `basin` ask the same question at many points. What is found at a point depends on the point alone, neither on its
//! neighbours nor on the number of threads, so that a study can be cut, interrupted and spread as one likes. `continuation` follows one
//! gait.

pub mod basin;
pub mod continuation;
mod design;
mod pool;
pub mod sweep;

pub use design::{Axis, Design};
pub use pool::Pool;
