//! Studies: the same question asked at many points. What is found at a point depends on the point alone, neither on its neighbours
//! nor on the number of threads, so that a study can be cut, interrupted and spread as one likes.

pub mod basin;
mod design;
mod pool;
pub mod sweep;

pub use design::{Axis, Design};
pub use pool::Pool;
