//! A machine in motion: what can be observed along a trajectory, and where its body goes.

mod observe;
mod path;
mod quadrature;

pub use observe::observe;
pub use path::{BodyPath, DrawnPath, body_path};
