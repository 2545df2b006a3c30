//! The start of a segment (selectors, sides, first step) and the first event inside a step.

use super::rates::{Rates, Segment};
use super::run::{Run, Watched};
use crate::event::arming::{arm, ends_at_once};
use crate::event::crossing::{Passage, passage, suspicious};
use crate::event::locate::{locate, restep, short_step};
use crate::event::{Reading, Side, Surface, read};
use crate::model::{Direction, Model};
use crate::ode::{Dense, first_step};
use crate::return_map::{StopReason, Warning};

/// An event inside the current step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// Index into the watched surfaces.
    pub(crate) watched: usize,
    /// When, after the start of the step [s].
    pub(crate) h: f64,
    /// How well that is known [s].
    uncertainty: f64,
}

impl<M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, M, R, N, P, Q, W, C>
where
    M: Model<N, P, Q>,
    R: Rates<M, N, P, Q, W, C>,
{
    /// Prepares the segment that starts where the run is. `switched` are the switches that have just been located
    /// (with their new selectors set already); `None` says that a transition has just been made.
    pub(crate) fn enter(&mut self, switched: Option<&[usize]>) -> Result<(), StopReason> {
        let Some(mode) = M::INFO.modes.get(self.segment.mode) else {
            return Err(StopReason::NotFinite);
        };
        let fixed = switched.unwrap_or(&[]);
        if switched.is_none() {
            self.guess_selectors(mode.switches);
        }
        self.guess_step()?;
        self.settle_selectors(mode.switches, fixed)?;
        let previous = core::mem::take(&mut self.watched);
        let from = self.segment.mode;
        for (i, transition) in M::INFO
            .transitions
            .iter()
            .enumerate()
            .filter(|(_, t)| t.from == from)
        {
            let surface = Surface::Transition(i);
            let kept = previous
                .iter()
                .find(|w| switched.is_some() && w.surface == surface);
            self.watch(surface, transition.direction, kept)?;
        }
        for &i in mode.switches {
            let surface = Surface::Switch(i);
            let kept = previous
                .iter()
                .find(|w| switched.is_some() && w.surface == surface);
            self.watch(surface, Direction::Either, kept)?;
        }
        let tau = self.step.tau;
        self.step.stages[0] = R::rates(&self.segment, tau, &self.step.start);
        self.statistics.evaluations += 1;
        let finite = self
            .step
            .start
            .x
            .iter()
            .chain(&self.step.stages[0].x)
            .all(|v| v.is_finite());
        if finite {
            Ok(())
        } else {
            Err(StopReason::NotFinite)
        }
    }

    /// A typical step size, if none is known.
    fn guess_step(&mut self) -> Result<(), StopReason> {
        if self.h > 0.0 {
            return Ok(());
        }
        let segment = &self.segment;
        let flow = |tau: f64, x: &[f64; N]| Self::flow(segment, tau, x);
        let (tau, x) = (self.step.tau, &self.step.start.x);
        let rate = flow(tau, x);
        if !rate.iter().all(|v| v.is_finite()) {
            return Err(StopReason::NotFinite);
        }
        self.h = first_step(
            &flow,
            tau,
            x,
            &rate,
            self.tolerance(),
            self.accuracy.time_limit,
        );
        self.statistics.evaluations += 2;
        Ok(())
    }

    /// Selectors by the plain sign of the switching functions.
    fn guess_selectors(&mut self, switches: &[usize]) {
        // Selectors may depend on each other: each round settles at least one more of a chain.
        for _ in 0..=switches.len() {
            let mut changed = false;
            for &i in switches {
                let value = M::switch(i, &self.step.start.x, &self.segment.env(self.step.tau));
                changed |= set(&mut self.segment.branch, i, value >= 0.0);
            }
            if !changed {
                break;
            }
        }
    }

    /// Selectors where the sign alone does not decide: by the first derivative that is not zero. Those in `fixed` stay.
    fn settle_selectors(&mut self, switches: &[usize], fixed: &[usize]) -> Result<(), StopReason> {
        for _ in 0..=switches.len() {
            let mut changed = false;
            for &i in switches.iter().filter(|i| !fixed.contains(i)) {
                let surface = Surface::Switch(i);
                let reading = self.read_start(surface);
                let side = self.arm_surface(surface, &reading);
                let selected = side != Side::Negative;
                changed |= set(&mut self.segment.branch, i, selected);
            }
            if !changed {
                break;
            }
        }
        Ok(())
    }

    fn read_start(&self, surface: Surface) -> Reading {
        let (tau, x) = (self.step.tau, &self.step.start.x);
        let flow = Self::flow(&self.segment, tau, x);
        read::<M, N, P, Q>(surface, x, &flow, &self.segment.env(tau))
    }

    fn arm_surface(&self, surface: Surface, reading: &Reading) -> Side {
        self.start_side(surface, reading).side
    }

    fn start_side(&self, surface: Surface, reading: &Reading) -> crate::event::arming::Start {
        let (segment, tau, x) = (&self.segment, self.step.tau, &self.step.start.x);
        let flow = |tau: f64, x: &[f64; N]| Self::flow(segment, tau, x);
        let ahead = |d: f64| {
            let later = short_step(&flow, tau, x, &flow(tau, x), d);
            read::<M, N, P, Q>(surface, &later, &[0.0; N], &segment.env(tau + d)).value
        };
        arm(reading, self.h, &ahead)
    }

    /// Starts to watch a surface. After a switch (`kept`) a guard that is zero keeps its side.
    fn watch(
        &mut self,
        surface: Surface,
        direction: Direction,
        kept: Option<&Watched>,
    ) -> Result<(), StopReason> {
        let reading = self.read_start(surface);
        if !reading.value.is_finite() {
            return Err(StopReason::NotFinite);
        }
        let start = self.start_side(surface, &reading);
        let zero = reading.value.abs() <= reading.rounding;
        let side = match (surface, kept) {
            (Surface::Switch(i), _) if zero && self.segment.branch.get(i) == Some(&true) => {
                Side::Positive
            }
            (Surface::Switch(_), _) if zero => Side::Negative,
            (Surface::Transition(_), Some(kept)) if zero => kept.side,
            (Surface::Transition(_), None) if zero && ends_at_once(start, direction) => {
                return Err(StopReason::Zeno);
            }
            _ => start.side,
        };
        let largest = kept.map_or(0.0, |k| k.largest).max(reading.value.abs());
        let fastest = kept.map_or(0.0, |k| k.fastest).max(reading.rate.abs());
        self.watched.push(Watched {
            surface,
            direction,
            side,
            start: reading,
            end: reading,
            largest,
            fastest,
        });
        Ok(())
    }

    /// The events that come first in the current step, the one to take foremost; empty (and the surfaces advanced to
    /// the end of the step) when there is none.
    pub(crate) fn first_events(&mut self) -> Vec<Found> {
        let h = self.step.h;
        let mut found = Vec::new();
        if self
            .watched
            .iter()
            .any(|w| suspicious(w.side, h, &w.start, &w.end))
        {
            found = self.locate_all();
        }
        if found.is_empty() {
            for watched in &mut self.watched {
                watched.start = watched.end;
                if watched.end.value.abs() > watched.end.rounding {
                    watched.side = Side::of(watched.end.value);
                }
                watched.largest = watched.largest.max(watched.end.value.abs());
                watched.fastest = watched.fastest.max(watched.end.rate.abs());
            }
        }
        found
    }

    fn locate_all(&mut self) -> Vec<Found> {
        let (segment, step, watched, warnings) =
            (&self.segment, &self.step, &self.watched, &mut self.warnings);
        let (tau, h) = (step.tau, step.h);
        let flow = |tau: f64, x: &[f64; N]| Self::flow(segment, tau, x);
        let dense = Dense::new(step, &flow);
        let mut evaluations = 3;
        let mut found = Vec::new();
        for (i, w) in watched
            .iter()
            .enumerate()
            .filter(|(_, w)| suspicious(w.side, h, &w.start, &w.end))
        {
            let on_dense = |u: f64| {
                let x = if w.start.clock_only && w.end.clock_only {
                    step.start.x
                } else {
                    dense.at(u)
                };
                let at = tau + u * h;
                read::<M, N, P, Q>(w.surface, &x, &flow(at, &x), &segment.env(at))
            };
            let largest = w.largest.max(w.end.value.abs());
            match passage(
                w.side,
                w.direction,
                (&w.start, &w.end, h),
                largest,
                &|u| on_dense(u).value,
                &|u| on_dense(u).rate,
            ) {
                Some(Passage::Crossing {
                    low,
                    high,
                    at,
                    from,
                }) => {
                    let reading = |d: f64| {
                        let x = if w.start.clock_only && w.end.clock_only {
                            step.start.x
                        } else {
                            restep(&flow, step, d)
                        };
                        read::<M, N, P, Q>(w.surface, &x, &flow(tau + d, &x), &segment.env(tau + d))
                    };
                    let (at, count) = locate(&reading, tau, (low * h, high * h), at * h, from);
                    if !(w.start.clock_only && w.end.clock_only) {
                        evaluations += 12 * count;
                    }
                    if !enabled::<M, N, P, Q, C>(
                        w.surface,
                        &restep(&flow, step, at),
                        segment,
                        tau + at,
                    ) {
                        continue;
                    }
                    let last = on_dense((at / h).clamp(0.0, 1.0));
                    let uncertainty = 8.0 * f64::EPSILON * (tau + at)
                        + last.rounding / last.rate.abs().max(f64::MIN_POSITIVE);
                    found.push(Found {
                        watched: i,
                        h: at,
                        uncertainty: uncertainty.min(1e-9 * (tau + at)),
                    });
                }
                Some(Passage::Touch { at }) => {
                    if let Surface::Transition(transition) = w.surface {
                        let time = segment.start + tau + at * h;
                        warnings.push(Warning::Grazing {
                            transition,
                            time,
                            transversality: on_dense(at).rate,
                        });
                    }
                }
                None => {}
            }
        }
        self.statistics.evaluations += evaluations;
        self.order(found)
    }

    /// Keeps the events that come first to rounding: transitions in the order of the spec before switches.
    fn order(&self, mut found: Vec<Found>) -> Vec<Found> {
        let Some(first) = found.iter().min_by(|a, b| a.h.total_cmp(&b.h)).copied() else {
            return found;
        };
        // `watched` lists transitions in the order of the spec, then switches, and `found` follows it.
        found.retain(|f| f.h - first.h <= f.uncertainty + first.uncertainty);
        found
    }
}

/// Sets a selector; whether that changed it.
fn set(branch: &mut [bool], i: usize, value: bool) -> bool {
    match branch.get_mut(i) {
        Some(slot) if *slot != value => {
            *slot = value;
            true
        }
        _ => false,
    }
}

fn enabled<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    surface: Surface,
    x: &[f64; N],
    segment: &Segment<'_, P, C>,
    tau: f64,
) -> bool {
    match surface {
        Surface::Transition(i) => M::when(i, x, &segment.env(tau)) >= 0.0,
        Surface::Switch(_) => true,
    }
}
