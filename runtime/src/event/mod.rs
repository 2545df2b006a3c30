//! Events: where a guard or a switching function passes zero, found in a step and located to rounding error.
//!
//! [`Surface`] is what is watched, [`Side`] where the run is relative to it, [`arming`] decides that at the start of a
//! segment, [`crossing`] finds passages on the dense output, [`locate`] makes them exact by re-stepping.

pub(crate) mod arming;
pub(crate) mod crossing;
pub(crate) mod locate;
mod root;
mod surface;

pub(crate) use root::root;
pub(crate) use surface::gradient;
pub(crate) use surface::{Reading, Side, Surface, read};
