//! What a run went through.

use crate::return_map::{Method, Statistics, StopReason, Warning};

/// A run, up to where it was to go or to where it stopped. SI units; N is the number of states.
#[derive(Clone, Debug)]
pub struct Trajectory {
    /// The state at the start, as it was given or as the embedding makes it: before the first reset where the section stands before
    /// a transition.
    pub start: Vec<f64>,
    /// The stretches between transitions, in order of time.
    pub segments: Vec<Segment>,
    /// Places on the way, in order of time.
    pub samples: Samples,
    /// The transitions that were made, in order of time.
    pub events: Vec<Event>,
    /// When the run ended (s) ...
    pub time: f64,
    /// ... and the state there; after the reset where it ended with a transition.
    pub end: Vec<f64>,
    /// Why it ended before it was to; `None` where it went all the way.
    pub stop: Option<StopReason>,
    /// The work of the integration, without that of sampling.
    pub statistics: Statistics,
    /// The method that was used; never `Automatic`.
    pub method: Method,
    /// Grazing and ties on the way.
    pub warnings: Vec<Warning>,
    /// The guards of the first mode that the start is beyond.
    pub beyond: Vec<Beyond>,
}

/// A guard that has a direction, where a run starts on the far side of it: where its transition would be over. It cannot fire
/// before the run has come back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beyond {
    /// Index into `info().transitions`.
    pub transition: usize,
    /// The guard at the start, in its SI unit.
    pub value: f64,
    /// Its time derivative there, in its SI unit per second.
    pub rate: f64,
    /// Whether it is zero to rounding, so that only the rate leads beyond: so do runs start that have just fired it.
    pub at_zero: bool,
}

/// A stretch between two transitions. What is constant on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Index into `info().modes`.
    pub mode: usize,
    /// Memory, in the order of `info().memory`.
    pub memory: Vec<f64>,
    /// When it starts (s since the start of the run).
    pub t: f64,
    /// Time since the last transition there (s): 0 but for a run that was started elsewhere.
    pub tau: f64,
}

/// A transition that was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Index into `info().transitions`.
    pub transition: usize,
    /// Time since the start of the run (s).
    pub time: f64,
    /// Time derivative of the guard along the flow just before it fired, in the guard's unit per second.
    pub transversality: f64,
    /// The state before the reset, length N.
    pub before: Vec<f64>,
    /// The state after it, length N.
    pub after: Vec<f64>,
    /// The memory after it.
    pub memory: Vec<f64>,
}

/// A place on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<'a> {
    /// Time since the start of the run (s).
    pub t: f64,
    /// Time since the last transition (s).
    pub tau: f64,
    /// Index into [`Trajectory::segments`].
    pub segment: usize,
    /// The state, length N.
    pub state: &'a [f64],
    /// Its rate, length N; not a number where the run stopped because it has none.
    pub rate: &'a [f64],
}

/// Samples. At a transition there are two at one time, the end of a segment and the start of the next one; at a switch inside a
/// segment, where rates may jump, two as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Number of states.
    pub(crate) width: usize,
    /// Time since the start of the run (s), one a sample.
    pub t: Vec<f64>,
    /// Time since the last transition (s), one a sample.
    pub tau: Vec<f64>,
    /// Index into [`Trajectory::segments`], one a sample.
    pub segment: Vec<usize>,
    /// States, one row of N after the other.
    pub states: Vec<f64>,
    /// Rates, one row of N after the other.
    pub rates: Vec<f64>,
}

impl Samples {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }

    /// Sample number `i`, counted from 0.
    pub fn get(&self, i: usize) -> Option<Sample<'_>> {
        let row = self.width * i..self.width * (i + 1);
        let (state, rate) = (self.states.get(row.clone())?, self.rates.get(row)?);
        Some(Sample { t: *self.t.get(i)?, tau: *self.tau.get(i)?, segment: *self.segment.get(i)?, state, rate })
    }

    /// All of them in order.
    pub fn iter(&self) -> impl Iterator<Item = Sample<'_>> {
        (0..self.len()).filter_map(|i| self.get(i))
    }
}
