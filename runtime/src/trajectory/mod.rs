//! Trajectories: a run of the real machine from any start, through any number of events, sampled on its way.
//!
//! Unlike a return map, a trajectory keeps the memory from event to event, applies no symmetry and never goes back to section
//! coordinates: all states, also those that the section leaves out, are those that the flow and the resets make.
//!
//! **Samples.** A step of the explicit method (order 8) has a dense output of order 7, and the polynomial of an implicit step is of
//! lower order inside the step than at its end. A sample is therefore not read off such a polynomial: it is the end of a step
//! of its own, from where the step around it started, and so as accurate as the ends of steps are. Its rate is the flow
//! there, or, of a model with a mass matrix, what the last stage of that step solves for, finite also near dead centres, where
//! the matrix vanishes. Sampling never changes the motion: it has the same bits for any interval.

mod request;
mod result;
pub(crate) mod trace;

pub use request::{FollowRequest, MOST_VALUES, Sampling, Start, Until};
pub use result::{Beyond, Event, Sample, Samples, Segment, Trajectory};
