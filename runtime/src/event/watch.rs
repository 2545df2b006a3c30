//! The surfaces of a mode while it runs: on which side each one is, and the first events inside a step.

use super::arming::{ends_at_once, start_side};
use super::crossing::{Passage, passages, suspicious};
use super::locate::locate;
use super::surface::{Reading, Side, Surface, read};
use crate::integrate::{Frame, Method, StateStep, restep};
use crate::model::{Direction, Model};
use crate::return_map::{Statistics, StopReason, Warning};

/// A surface that is watched in the current segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watched {
    /// Which.
    pub(crate) surface: Surface,
    /// The passages that count.
    pub(crate) direction: Direction,
    /// Where the run is.
    pub(crate) side: Side,
    /// Reading at the start of the current step.
    pub(crate) start: Reading,
    /// Reading at its end.
    pub(crate) end: Reading,
    /// Largest magnitude of the value in the segment.
    pub(crate) largest: f64,
    /// Largest magnitude of the rate in the segment.
    pub(crate) fastest: f64,
    /// The first place seen inside the current step (a fraction of it) where the function is on the other side, and its
    /// value there.
    pub(crate) dip: Option<(f64, f64)>,
}

/// An event inside the current step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// Index into the watched surfaces.
    pub(crate) watched: usize,
    /// When, after the start of the step (s).
    pub(crate) h: f64,
    /// How well that is known (s).
    uncertainty: f64,
}

impl Watched {
    /// Whether there may be an event in the current step, of size `h`.
    pub(crate) fn suspicious(&self, h: f64) -> bool {
        self.dip.is_some() || suspicious(self.side, h, &self.start, &self.end)
    }

    /// Goes on to the next step: there was no event.
    pub(crate) fn move_on(&mut self) {
        self.start = self.end;
        self.dip = None;
        if self.end.value.abs() > self.end.rounding {
            self.side = Side::of(self.end.value);
        }
        self.largest = self.largest.max(self.end.value.abs());
        self.fastest = self.fastest.max(self.end.rate.abs());
    }

    /// Whether the function depends on time and parameters only, as far as the current step shows.
    pub(crate) fn clock_only(&self) -> bool {
        self.start.clock_only && self.end.clock_only
    }
}

/// Starts to watch the guards of the mode of `frame` and its `switches`, at (`tau`, `x`) with rate `k`. After a switch, `previous` is what
/// was watched before it: a guard that is zero keeps its side then. `fired` are the surfaces that have just been passed, with
/// the size of what their values may be off by.
pub(crate) fn watch<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    switches: &[usize],
    tau: f64,
    (x, k): (&[f64; N], &[f64; N]),
    typical: f64,
    (previous, fired): (&[Watched], &[(Surface, f64)]),
) -> Result<Vec<Watched>, StopReason> {
    let guards = M::INFO.transitions.iter().enumerate().filter(|(_, t)| t.from == frame.mode);
    let guards = guards.map(|(i, t)| (Surface::Transition(i), t.direction));
    let switches = switches.iter().map(|i| (Surface::Switch(*i), Direction::Either));
    let mut watched = Vec::new();
    for (surface, direction) in guards.chain(switches) {
        let mut reading = read::<M, N, P, Q>(surface, x, k, &frame.env(tau));
        if let Some((_, noise)) = fired.iter().find(|(passed, _)| *passed == surface) {
            reading.rounding = reading.rounding.max(*noise);
        }
        if !reading.value.is_finite() {
            return Err(StopReason::NotFinite);
        }
        let kept = previous.iter().find(|w| w.surface == surface);
        let start = start_side::<X, M, N, P, Q>(frame, surface, &reading, tau, (x, k), typical);
        let side = match (surface, kept) {
            _ if reading.value.abs() > reading.rounding => start.side,
            (Surface::Switch(i), _) if frame.branch.get(i) == Some(&true) => Side::Positive,
            (Surface::Switch(_), _) => Side::Negative,
            (Surface::Transition(_), Some(kept)) => kept.side,
            (Surface::Transition(_), None) if ends_at_once(start, direction) => {
                return Err(StopReason::Zeno);
            }
            (Surface::Transition(_), None) => start.side,
        };
        let largest = kept.map_or(0.0, |k| k.largest).max(reading.value.abs());
        let fastest = kept.map_or(0.0, |k| k.fastest).max(reading.rate.abs());
        watched.push(Watched { surface, direction, side, start: reading, end: reading, largest, fastest, dip: None });
    }
    Ok(watched)
}

/// The events that come first in a step, at the same time to rounding: transitions in the order of the spec, then
/// switches. Empty when there is none after all. `shorter` becomes a step from the same start to near the event that was
/// looked at last.
#[inline(never)]
pub(crate) fn first_events<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    (step, shorter): (&StateStep<X, N>, &mut StateStep<X, N>),
    watched: &[Watched],
    warnings: &mut Vec<Warning>,
    work: &mut X::Workspace<N>,
    statistics: &mut Statistics,
) -> Vec<Found> {
    let dense = X::dense::<M, N, P, Q>(frame, step, &mut statistics.evaluations);
    let (mut found, mut touches) = (Vec::new(), Vec::new());
    for (i, w) in watched.iter().enumerate().filter(|(_, w)| w.suspicious(step.h)) {
        let touches = &mut touches;
        if let Some((h, last)) =
            first_passage::<X, M, N, P, Q>(frame, (step, shorter), &dense, w, touches, work, statistics)
        {
            let tau = step.tau + h;
            let uncertainty = 8.0 * f64::EPSILON * tau + last.rounding / last.rate.abs().max(f64::MIN_POSITIVE);
            found.push(Found { watched: i, h, uncertainty: uncertainty.min(1e-9 * tau).max(0.0) });
        }
    }
    let first = found.iter().copied().min_by(|a, b| a.h.total_cmp(&b.h));
    for (surface, h, transversality) in touches {
        // What follows the first event is not part of the run.
        if let Surface::Transition(transition) = surface
            && first.is_none_or(|first| h < first.h)
        {
            let time = frame.start + step.tau + h;
            warnings.push(Warning::Grazing { transition, time, transversality });
        }
    }
    if let Some(first) = first {
        // The order of `watched` (transitions as in the spec, then switches) is kept.
        found.retain(|f| f.h - first.h <= f.uncertainty + first.uncertainty);
    }
    found
}

/// The first passage of a surface that counts: when, after the start of the step, and the surface's reading near it. Notes
/// touches, with their times and rates.
fn first_passage<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    (step, shorter): (&StateStep<X, N>, &mut StateStep<X, N>),
    dense: &X::Dense<N>,
    w: &Watched,
    touches: &mut Vec<(Surface, f64, f64)>,
    work: &mut X::Workspace<N>,
    statistics: &mut Statistics,
) -> Option<(f64, Reading)> {
    let on_dense = |u: f64| {
        let at = X::point::<M, N, P, Q>(frame, step, dense, u);
        read::<M, N, P, Q>(w.surface, &at.x, &at.k, &frame.env(step.tau + u * step.h))
    };
    let ends = (&w.start, &w.end, step.h, w.dip);
    for passage in passages(w.side, w.direction, ends, w.largest, &|u| on_dense(u).value, &|u| on_dense(u).rate) {
        let (h, last) = match passage {
            Passage::Crossing { low, high, at, from } => {
                let bracket = (low * step.h, high * step.h);
                exact::<X, M, N, P, Q>(frame, shorter, w, bracket, (at * step.h, from), work, statistics)
            }
            Passage::Touch { at } => (at * step.h, on_dense(at)),
        };
        // One that does not count is passed over; there may be another one in the same step.
        if !enabled::<X, M, N, P, Q>(frame, shorter, w.surface, h, work, statistics) {
            continue;
        }
        match passage {
            Passage::Crossing { .. } => return Some((h, last)),
            Passage::Touch { .. } => touches.push((w.surface, h, last.rate)),
        }
    }
    None
}

/// The time of a crossing after the start of the step, exact to rounding, and the surface's reading near it.
fn exact<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    step: &mut StateStep<X, N>,
    watched: &Watched,
    bracket: (f64, f64),
    (guess, from): (f64, Side),
    work: &mut X::Workspace<N>,
    statistics: &mut Statistics,
) -> (f64, Reading) {
    let mut last = watched.end;
    let (tau, at) = (step.tau, (step.start.x, step.start_rates.x));
    let mut reading = |h: f64| {
        let evaluations = &mut statistics.evaluations;
        let (x, k) = if watched.clock_only() { at } else { restep::<X, M, N, P, Q>(frame, step, h, work, evaluations) };
        last = read::<M, N, P, Q>(watched.surface, &x, &k, &frame.env(tau + h));
        last
    };
    let h = locate(&mut reading, tau, bracket, guess, from);
    (h, last)
}

/// Whether a transition's `when` holds after `h`.
fn enabled<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    step: &mut StateStep<X, N>,
    surface: Surface,
    h: f64,
    work: &mut X::Workspace<N>,
    statistics: &mut Statistics,
) -> bool {
    match surface {
        Surface::Switch(_) => true,
        Surface::Transition(i) => {
            let (x, _) = restep::<X, M, N, P, Q>(frame, step, h, work, &mut statistics.evaluations);
            M::when(i, &x, &frame.env(step.tau + h)) >= 0.0
        }
    }
}
