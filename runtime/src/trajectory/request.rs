//! What to follow: from where, how far, and how densely sampled.

use crate::return_map::Accuracy;

/// The most numbers that a trajectory may hold, samples and events together (80 MB).
pub const MOST_VALUES: usize = 10_000_000;

/// A run to follow.
#[derive(Clone, Copy, Debug)]
pub struct FollowRequest<'a> {
    /// Where it starts.
    pub start: Start<'a>,
    /// All parameters, in the order of `info().parameters`, SI units.
    pub parameters: &'a [f64],
    /// Memory at the start, in the order of `info().memory`. It is kept from event to event.
    pub memory: &'a [f64],
    /// How far it goes.
    pub until: Until,
    /// Where it is sampled.
    pub sampling: Sampling,
    /// Accuracy. The time limit is that from one section crossing to the next (not used with [`Until::Time`]), and so is the
    /// limit on steps.
    pub accuracy: Accuracy,
}

/// Where a run starts; the time since the start of the run, t, is 0 there.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// On the section, at these coordinates, all other states by the embedding. Where the section stands before a transition, that
    /// transition is made at once.
    Section(&'a [f64]),
    /// At any state (length of `info().states`, SI units) in a mode (by index), `tau` (s) after the last transition.
    State {
        /// Index of the mode.
        mode: usize,
        /// The state.
        state: &'a [f64],
        /// Time since the last transition (s), at least 0.
        tau: f64,
    },
}

/// How far a run goes, unless it stops before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// So many crossings of the section, at least 1.
    Crossings(usize),
    /// So long (s).
    Time(f64),
}

/// Where a run is sampled, besides both sides of each event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling {
    /// At the multiples of this time (s) since the start of the run.
    Interval(f64),
    /// At so many equal times: the interval is the time of the whole run (for [`Until::Time`] that which was asked for) divided
    /// by this number, at least 1.
    Count(usize),
}
