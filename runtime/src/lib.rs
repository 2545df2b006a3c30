//! Runtime of gaitc: integrates compiled hybrid models, linearises their return maps exactly, finds and optimises gaits.

pub(crate) mod also_zero;
pub mod batch;
pub(crate) mod closing;
pub(crate) mod collocation;
pub(crate) mod event;
pub mod hybrid;
pub(crate) mod integrate;
pub mod interrupt;
pub mod model;
pub mod ode;
pub mod optimize;
pub mod orbit;
pub mod probe;
pub mod random;
pub mod registry;
pub mod replay;
pub mod return_map;
pub mod scalar;
pub mod sensitivity;
pub mod study;
pub mod trajectory;
