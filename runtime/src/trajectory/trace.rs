//! Notes a run as a trajectory, while it goes on.

use super::request::MOST_VALUES;
use super::result::{Beyond, Event, Samples, Segment};
use crate::return_map;

/// A time of the grid this near to another sample, as a fraction of the interval, is left out.
const SAME: f64 = 1e-9;

/// What has been noted so far.
#[derive(Clone, Debug)]
pub(crate) struct Trace {
    /// Time between two samples (s); infinite where only segments' ends are wanted.
    interval: f64,
    /// The next sample of the grid is at this multiple of it.
    next: u64,
    /// How many values there may still be.
    room: usize,
    /// Whether there were to be more.
    pub(crate) full: bool,
    /// The state at the end of the step that leads to an event.
    before: Vec<f64>,
    pub(crate) segments: Vec<Segment>,
    pub(crate) samples: Samples,
    pub(crate) events: Vec<Event>,
    /// Guards that the start is beyond.
    pub(crate) beyond: Vec<Beyond>,
}

impl Trace {
    /// Nothing yet, of `width` states.
    pub(crate) fn new(width: usize, interval: f64) -> Self {
        Self {
            interval,
            next: 1,
            room: MOST_VALUES,
            full: false,
            before: Vec::new(),
            segments: Vec::new(),
            samples: Samples { width, ..Samples::default() },
            events: Vec::new(),
            beyond: Vec::new(),
        }
    }

    /// A segment begins; its first sample follows.
    pub(crate) fn segment(&mut self, mode: usize, memory: &[f64], t: f64, tau: f64) {
        if self.reserve(memory.len() + 3) {
            self.segments.push(Segment { mode, memory: memory.to_vec(), t, tau });
        }
    }

    /// The next time of the grid before `end`, if there is one; times that have a sample are passed over.
    pub(crate) fn next_before(&mut self, end: f64) -> Option<f64> {
        let same = SAME * self.interval;
        if self.full || !self.interval.is_finite() {
            return None;
        }
        let last = self.samples.t.last().copied().unwrap_or(0.0);
        let passed = ((last + same) / self.interval).floor();
        if passed >= self.next as f64 {
            self.next = (passed as u64).saturating_add(1);
        }
        let t = self.next as f64 * self.interval;
        (t < end - same).then_some(t)
    }

    /// Takes the sample that the grid asks for.
    pub(crate) fn grid_sample(&mut self, t: f64, tau: f64, point: (&[f64], &[f64])) {
        self.next = self.next.saturating_add(1);
        self.sample(t, tau, point);
    }

    /// Takes a sample.
    pub(crate) fn sample(&mut self, t: f64, tau: f64, (state, rate): (&[f64], &[f64])) {
        if self.reserve(2 * state.len() + 3) {
            let samples = &mut self.samples;
            samples.t.push(t);
            samples.tau.push(tau);
            samples.segment.push(self.segments.len().saturating_sub(1));
            samples.states.extend_from_slice(state);
            samples.rates.extend_from_slice(rate);
        }
    }

    /// The run stands at an event, just before it.
    pub(crate) fn arrive(&mut self, t: f64, tau: f64, (state, rate): (&[f64], &[f64])) {
        self.before.clear();
        self.before.extend_from_slice(state);
        self.sample(t, tau, (state, rate));
    }

    /// A transition was made.
    pub(crate) fn passed(&mut self, event: &return_map::Event, after: &[f64], memory: &[f64]) {
        let return_map::Event { transition, time, transversality, .. } = *event;
        if self.reserve(self.before.len() + after.len() + memory.len() + 3) {
            let (before, after, memory) = (self.before.clone(), after.to_vec(), memory.to_vec());
            self.events.push(Event { transition, time, transversality, before, after, memory });
        }
    }

    fn reserve(&mut self, values: usize) -> bool {
        self.full |= self.room < values;
        self.room = self.room.saturating_sub(values);
        !self.full
    }
}
