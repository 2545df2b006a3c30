//! The start of a segment: typical step, selectors, surfaces, first stage.

use super::rates::Rates;
use super::run::Run;
use crate::event::{Found, Frame, StateStep, first_events, selectors, watch};
use crate::model::Model;
use crate::ode::{Bundle, Step, first_step};
use crate::return_map::StopReason;

impl<M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize> Run<'_, M, R, N, P, Q, W, C>
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
        let switches = if R::MEASURED { mode.measured_switches } else { mode.switches };
        let (tau, x) = (self.step.tau, self.step.start.x);
        if switched.is_none() {
            self.watched.clear();
            if !switches.is_empty() {
                self.segment.branch = selectors::by_sign::<M, N, P, Q>(self.segment.frame(), switches, tau, &x);
            }
        }
        self.guess_step()?;
        let free: Vec<usize> = switches.iter().copied().filter(|i| !switched.unwrap_or(&[]).contains(i)).collect();
        if !free.is_empty() {
            self.segment.branch = selectors::by_derivative::<M, N, P, Q>(self.segment.frame(), &free, tau, &x, self.h);
        }
        self.watched = watch::<M, N, P, Q>(self.segment.frame(), switches, tau, &x, self.h, &self.watched)?;
        self.step.stages[0] = R::rates(&self.segment, tau, &self.step.start);
        self.statistics.evaluations += 1;
        let finite = x.iter().chain(&self.step.stages[0].x).all(|v| v.is_finite());
        if finite { Ok(()) } else { Err(StopReason::NotFinite) }
    }

    /// A typical step size, if none is known.
    fn guess_step(&mut self) -> Result<(), StopReason> {
        if self.h > 0.0 {
            return Ok(());
        }
        let frame = self.segment.frame();
        let (tau, x) = (self.step.tau, &self.step.start.x);
        let rate = frame.flow::<M, N, Q>(tau, x);
        if !rate.iter().all(|v| v.is_finite()) {
            return Err(StopReason::NotFinite);
        }
        let flow = |tau: f64, x: &[f64; N]| frame.flow::<M, N, Q>(tau, x);
        self.h = first_step(&flow, tau, x, &rate, self.tolerance(), self.accuracy.time_limit);
        self.statistics.evaluations += 2;
        Ok(())
    }

    /// The events that come first in the current step, the one to take foremost; empty (and the surfaces advanced to
    /// the end of the step) when there is none.
    pub(crate) fn first_events(&mut self) -> Vec<Found> {
        let mut found = Vec::new();
        if self.watched.iter().any(|w| w.suspicious(self.step.h)) {
            let (frame, step): (Frame<'_, P>, StateStep<N>) = (self.segment.frame(), state_step(&self.step));
            found = first_events::<M, N, P, Q>(frame, &step, &self.watched, &mut self.warnings, &mut self.statistics);
        }
        if found.is_empty() {
            self.watched.iter_mut().for_each(|w| w.move_on());
        }
        found
    }
}

/// The part of a step that concerns the state alone.
pub(crate) fn state_step<const N: usize, const W: usize, const C: usize>(step: &Step<Bundle<N, W, C>>) -> StateStep<N> {
    let state = |b: &Bundle<N, W, C>| Bundle::<N, 0, 0> { x: b.x, q: [], dx: [], dq: [] };
    Step {
        tau: step.tau,
        h: step.h,
        start: state(&step.start),
        stages: core::array::from_fn(|s| state(&step.stages[s])),
        end: state(&step.end),
        end_rates: state(&step.end_rates),
    }
}
