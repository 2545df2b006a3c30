//! A run in progress: the state of everything, and the integration of one smooth step.
//!
//! The other files of this folder add to [`Run`]: `segment` (start of a segment, events in a step), `passing` (switches
//! and transitions), `extremum`, `map` (the loop from section to section).

use super::functionals::Functionals;
use super::rates::{Rates, Segment};
use crate::event::{Watched, read};
use crate::model::Model;
use crate::ode::{Bundle, Controller, Stages, Step, Tolerance, attempt, error};
use crate::return_map::{Accuracy, Event, Statistics, StopReason, Warning};
use core::marker::PhantomData;

/// Steps in a row that may fail before the run gives up.
const MOST_REJECTIONS: usize = 80;

/// By how much the largest allowed step grows after each step that was short enough.
const CEILING_GROWTH: f64 = 1.25;

/// A run: model M, right-hand side R, N states, P parameters, Q integrals of the model, W that are carried, C columns.
pub(crate) struct Run<'a, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize> {
    /// How accurately and how far.
    pub(crate) accuracy: Accuracy,
    /// What is constant in the segment.
    pub(crate) segment: Segment<'a, P, C>,
    /// The step that was taken last; its start is where the run is.
    pub(crate) step: Step<Bundle<N, W, C>>,
    /// Step size control.
    pub(crate) controller: Controller,
    /// Size of the next step; 0 before the first.
    pub(crate) h: f64,
    /// Largest step that surfaces and observables allow; grows while they are resolved.
    pub(crate) ceiling: f64,
    /// Surfaces of the current mode.
    pub(crate) watched: Vec<Watched>,
    /// Functionals other than integrals.
    pub(crate) functionals: Functionals<C>,
    /// What happened.
    pub(crate) events: Vec<Event>,
    /// What the user has to know.
    pub(crate) warnings: Vec<Warning>,
    /// Work done.
    pub(crate) statistics: Statistics,
    /// Time since the start of the run after which no step is taken (s).
    pub(crate) deadline: f64,
    /// Events in a row that followed almost at once.
    pub(crate) hasty: usize,
    pub(crate) kind: PhantomData<(M, R)>,
}

impl<'a, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'a, M, R, N, P, Q, W, C>
where
    M: Model<N, P, Q>,
    R: Rates<M, N, P, Q, W, C>,
{
    /// A run that has not started.
    pub(crate) fn new(accuracy: Accuracy, p: &'a [f64; P], dp: [[f64; P]; C], functionals: Functionals<C>) -> Self {
        let zero = Bundle::ZERO;
        let step = Step { tau: 0.0, h: 0.0, start: zero, stages: [zero; 12], end: zero, end_rates: zero };
        let (memory, branch) = (Vec::new(), vec![false; M::INFO.switches.len()]);
        Self {
            accuracy,
            segment: Segment { mode: 0, start: 0.0, p, memory, branch, dp, dstart: [0.0; C] },
            step,
            controller: Controller::default(),
            h: 0.0,
            ceiling: f64::INFINITY,
            watched: Vec::new(),
            functionals,
            events: Vec::new(),
            warnings: Vec::new(),
            statistics: Statistics::default(),
            deadline: accuracy.time_limit,
            hasty: 0,
            kind: PhantomData,
        }
    }

    /// Tolerance of the local error.
    pub(crate) fn tolerance(&self) -> Tolerance {
        Tolerance { relative: self.accuracy.relative, absolute: self.accuracy.absolute }
    }

    /// Time since the start of the run.
    pub(crate) fn time(&self) -> f64 {
        self.segment.start + self.step.tau
    }

    /// Takes one step that satisfies the error control, and reads all surfaces at its end.
    pub(crate) fn advance(&mut self) -> Result<(), StopReason> {
        let tolerance = self.tolerance();
        let mut failure = StopReason::StepTooSmall;
        for _ in 0..MOST_REJECTIONS {
            let rest = self.deadline - self.time();
            if rest <= f64::EPSILON * self.deadline {
                return Err(StopReason::NoEvent);
            }
            if self.statistics.steps + self.statistics.rejected >= self.accuracy.step_limit {
                return Err(StopReason::StepLimit);
            }
            let h = self.h.min(rest);
            if h <= 2.0 * f64::EPSILON * self.step.tau || h.is_nan() || h == 0.0 {
                break;
            }
            self.try_step(h);
            let mut size = error(h, &self.step.start, &self.step.end, &self.step.stages, tolerance);
            if size <= 1.0 && !self.finish_step() {
                size = f64::NAN;
            }
            if size <= 1.0 && !self.resolved() {
                self.ceiling = 0.5 * h;
                self.h = self.ceiling;
                self.statistics.rejected += 1;
                continue;
            }
            let (accepted, next) = self.controller.judge(size, h);
            self.h = next.min(self.ceiling);
            if accepted {
                self.ceiling *= CEILING_GROWTH;
                self.statistics.steps += 1;
                return Ok(());
            }
            failure = if size.is_finite() { StopReason::StepTooSmall } else { StopReason::NotFinite };
            self.statistics.rejected += 1;
        }
        Err(if self.domain_ends() { StopReason::NotFinite } else { failure })
    }

    /// Whether the flow is not defined a short way ahead along its tangent. At the edge of a domain (a square root near
    /// zero) the error control alone asks for ever smaller steps that all stay inside.
    fn domain_ends(&self) -> bool {
        let ahead = 1e-6 * self.time();
        let mut x = self.step.start.x;
        for i in 0..N {
            x[i] += ahead * self.step.stages[0].x[i];
        }
        let flow = self.segment.frame().flow::<M, N, Q>(self.step.tau + ahead, &x);
        !flow.iter().all(|v| v.is_finite())
    }

    fn try_step(&mut self, h: f64) {
        self.step.h = h;
        self.step.end = Self::attempt(&self.segment, self.step.tau, h, &self.step.start, &mut self.step.stages);
        self.statistics.evaluations += 11;
    }

    /// One step of everything; the one place where the method is compiled for this model and number of columns.
    #[inline(never)]
    pub(crate) fn attempt(
        segment: &Segment<'_, P, C>,
        tau: f64,
        h: f64,
        start: &Bundle<N, W, C>,
        stages: &mut Stages<Bundle<N, W, C>>,
    ) -> Bundle<N, W, C> {
        attempt(&|tau: f64, y: &Bundle<N, W, C>| R::rates(segment, tau, y), tau, h, start, stages)
    }

    /// Flow and surfaces at the end of the step; false when any is not finite.
    fn finish_step(&mut self) -> bool {
        let tau = self.step.tau + self.step.h;
        self.step.end_rates = R::rates(&self.segment, tau, &self.step.end);
        self.statistics.evaluations += 1;
        let (x, flow) = (&self.step.end.x, &self.step.end_rates.x);
        let env = self.segment.env(tau);
        let mut finite = flow.iter().all(|v| v.is_finite());
        for watched in &mut self.watched {
            watched.end = read::<M, N, P, Q>(watched.surface, x, flow, &env);
            finite &= watched.end.value.is_finite();
        }
        finite
    }

    /// Replaces the step by a shorter one from the same start that ends at an event.
    pub(crate) fn shorten(&mut self, h: f64) {
        self.try_step(h);
        let tau = self.step.tau + h;
        self.step.end_rates = R::rates(&self.segment, tau, &self.step.end);
        self.statistics.evaluations += 1;
    }

    /// Makes the end of the step the place where the run is.
    pub(crate) fn move_on(&mut self) {
        self.step.tau += self.step.h;
        self.step.start = self.step.end;
        self.step.stages[0] = self.step.end_rates;
    }
}
