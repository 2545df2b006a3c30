//! Runtime of gaitc: integrates compiled hybrid models, linearises their return maps exactly, finds and optimises gaits.

pub mod model;
pub mod optimize;
pub mod probe;
pub mod registry;
pub mod return_map;
pub mod scalar;
