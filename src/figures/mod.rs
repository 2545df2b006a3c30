//! Pictures of results: what a picture of each kind shows. Here models, gaits and runs become the plain data of
//! [`crate::picture`]; commands and the report choose among them.

mod motion;
mod multipliers;
mod published;
mod return_map;

pub use motion::Run;
pub use multipliers::multipliers;
pub use published::{mean, published};
pub use return_map::{Orbit, map_of, return_map};
