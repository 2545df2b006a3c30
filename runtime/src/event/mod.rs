//! Events: where a guard or a switching function passes zero, found in a step and located to rounding error.
//!
//! [`Surface`] is what is watched, [`Side`] where the run is relative to it, `arming` decides that at the start of a
//! segment, `selectors` likewise for the branch selectors, `crossing` finds passages on the dense output, `locate` makes
//! them exact by re-stepping, `watch` puts it together.

mod arming;
mod crossing;
mod locate;
mod root;
pub(crate) mod selectors;
mod surface;
mod watch;

pub(crate) use root::root;
pub(crate) use surface::{NOTHING, Reading, Side, Surface, gradient, read, value};
pub(crate) use watch::{Found, Watched, first_events, watch};
