//! A segment between two events: what it holds constant, and its start: rates, typical step, selectors, surfaces.

use super::run::Run;
use crate::event::{Found, first_events, selectors, watch};
use crate::integrate::{Carried, Frame, Held, Method, Typical, state_step};
use crate::model::{Env, Model};
use crate::ode::Tolerance;
use crate::return_map::StopReason;

/// What stays constant while the clock tau runs.
#[derive(Clone, Debug)]
pub(crate) struct Segment<'a, const P: usize, const C: usize> {
    /// Index of the mode.
    pub(crate) mode: usize,
    /// Time since the start of the run at which tau was 0 (s).
    pub(crate) start: f64,
    /// Parameters.
    pub(crate) p: &'a [f64; P],
    /// Memory.
    pub(crate) memory: Vec<f64>,
    /// Frozen branch selectors.
    pub(crate) branch: Vec<bool>,
    /// Variations of the parameters, one array a column.
    pub(crate) dp: [[f64; P]; C],
    /// Variations of `start`, one a column.
    pub(crate) dstart: [f64; C],
    /// How many of the columns are in use; the others are zeros.
    pub(crate) columns: usize,
    /// Tolerance of the integration.
    pub(crate) tolerance: Tolerance,
}

impl<const P: usize, const C: usize> Segment<'_, P, C> {
    /// What does not depend on the columns.
    pub(crate) fn frame(&self) -> Frame<'_, P> {
        let Self { mode, start, p, ref memory, ref branch, tolerance, .. } = *self;
        Frame { mode, start, p, memory, branch, tolerance }
    }

    /// The same with the columns.
    pub(crate) fn held(&self) -> Held<'_, P, C> {
        Held { frame: self.frame(), dp: &self.dp, dstart: &self.dstart, columns: self.columns }
    }

    /// The environment at `tau`.
    #[inline(always)]
    pub(crate) fn env(&self, tau: f64) -> Env<'_, f64, P> {
        Env { tau, t: self.start + tau, p: self.p, memory: &self.memory, branch: &self.branch }
    }
}

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
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
        self.begin_rates()?;
        let free: Vec<usize> = switches.iter().copied().filter(|i| !switched.unwrap_or(&[]).contains(i)).collect();
        let (rate, frame) = (self.step.start_rates.x, self.segment.frame());
        if !free.is_empty() {
            let branch = selectors::by_derivative::<X, M, N, P, Q>(frame, &free, tau, (&x, &rate), self.h);
            if branch != self.segment.branch {
                self.segment.branch = branch;
                self.begin_rates()?;
            }
        }
        let (rate, frame) = (self.step.start_rates.x, self.segment.frame());
        self.watched = watch::<X, M, N, P, Q>(frame, switches, tau, (&x, &rate), self.h, (&self.watched, &self.fired))?;
        Ok(())
    }

    /// Rates where the run is, and a step size, if none is known.
    pub(crate) fn begin_rates(&mut self) -> Result<(), StopReason> {
        let typical = if self.h > 0.0 { Typical::Size(self.h) } else { Typical::Longest(self.accuracy.time_limit) };
        let (segment, tolerance) = (&self.segment, self.segment.tolerance);
        let evaluations = &mut self.statistics.evaluations;
        let size = X::begin::<M, R, N, P, Q, W, C>(
            &segment.held(),
            &mut self.step,
            typical,
            tolerance,
            &mut self.work,
            evaluations,
        );
        let finite = self.step.start.x.iter().chain(&self.step.start_rates.x).all(|v| v.is_finite());
        match size {
            Some(size) if finite => {
                self.h = size.min(self.accuracy.time_limit);
                Ok(())
            }
            None if X::defined::<M, N, P, Q>(segment.frame(), self.step.tau, &self.step.start.x, &[0.0; N]) => {
                Err(StopReason::Inconsistent)
            }
            _ => Err(StopReason::NotFinite),
        }
    }

    /// The events that come first in the current step, the one to take foremost; empty (and the surfaces advanced to
    /// the end of the step) when there is none.
    pub(crate) fn first_events(&mut self) -> Vec<Found> {
        let mut found = Vec::new();
        if self.watched.iter().any(|w| w.suspicious(self.step.h)) {
            let (frame, step) = (self.segment.frame(), state_step::<X, N, W, C>(&self.step));
            let (work, warnings, statistics) = (&mut self.work, &mut self.warnings, &mut self.statistics);
            let mut shorter = step;
            let steps = (&step, &mut shorter);
            found = first_events::<X, M, N, P, Q>(frame, steps, &self.watched, warnings, work, statistics);
            X::expect(&mut self.step.stages, &shorter.stages);
        }
        if found.is_empty() {
            self.watched.iter_mut().for_each(|w| w.move_on());
        }
        found
    }
}
