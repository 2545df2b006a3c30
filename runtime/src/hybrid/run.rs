//! A run in progress: the state of everything, and the integration of one smooth step.
//!
//! The other files of this folder add to [`Run`]: `segment` (start of a segment, events in a step), `passing` (switches
//! and transitions), `extremum`, `map` (the loop from section to section).

use super::functionals::Functionals;
use super::segment::Segment;
use crate::event::{Surface, Watched, read};
use crate::integrate::{Carried, Method, Purpose, StepOf};
use crate::model::Model;
use crate::ode::{Bundle, Controller, Step, Tolerance};
use crate::replay::Record;
use crate::return_map::{Accuracy, Event, Statistics, StopReason, Warning};
use crate::trajectory::trace::Trace;
use core::marker::PhantomData;

/// Steps in a row that may fail before the run gives up.
const MOST_REJECTIONS: usize = 80;

/// Runs of fewer steps are not looked at for stiffness.
const UNSUSPICIOUS: usize = 100;
/// Steps near the method's stability limit: the step size hovers around it.
const NEAR_THE_LIMIT: f64 = 0.75;
/// So many of them make a run stiff; ...
const STIFF_STEPS: usize = 30;
/// ... so many others in a row start the count again.
const FREE_STEPS: usize = 6;

/// By how much the largest allowed step grows after each step that was short enough.
const CEILING_GROWTH: f64 = 1.25;

/// A run: method X, model M, right-hand side R, N states, P parameters, Q integrals of the model, W that are carried, C columns.
pub(crate) struct Run<
    'a,
    X: Method,
    M,
    R,
    const N: usize,
    const P: usize,
    const Q: usize,
    const W: usize,
    const C: usize,
> {
    /// How accurately and how far.
    pub(crate) accuracy: Accuracy,
    /// What is constant in the segment.
    pub(crate) segment: Segment<'a, P, C>,
    /// The step that was taken last; its start is where the run is.
    pub(crate) step: StepOf<X, N, W, C>,
    /// Room for the method.
    pub(crate) work: X::Workspace<N>,
    /// Step size control.
    pub(crate) controller: Controller,
    /// Size of the next step; 0 before the first.
    pub(crate) h: f64,
    /// Largest step that surfaces and observables allow; grows while they are resolved.
    pub(crate) ceiling: f64,
    /// Surfaces of the current mode.
    pub(crate) watched: Vec<Watched>,
    /// Surfaces that have just been passed, with the size of what their values may be off by there.
    pub(crate) fired: Vec<(Surface, f64)>,
    /// The transition before which the section stands, if it stands before one, ...
    pub(crate) ahead: Option<usize>,
    /// ... and state and variations of the place where that transition was made last.
    pub(crate) on_section: ([f64; N], [[f64; N]; C]),
    /// Functionals other than integrals.
    pub(crate) functionals: Functionals<C>,
    /// What happened.
    pub(crate) events: Vec<Event>,
    /// What the user has to know.
    pub(crate) warnings: Vec<Warning>,
    /// Work done.
    pub(crate) statistics: Statistics,
    /// What a plan is made of, where one is wanted.
    pub(crate) record: Option<Record>,
    /// Where the run is noted as a trajectory, if that is wanted.
    pub(crate) trace: Option<Box<Trace>>,
    /// Error of the last accepted step, relative to the tolerance.
    pub(crate) error: f64,
    /// Time since the start of the run after which no step is taken (s).
    pub(crate) deadline: f64,
    /// Events in a row that followed almost at once.
    pub(crate) hasty: usize,
    /// Steps that stability limited, not accuracy, ...
    pub(crate) limited: usize,
    /// ... and steps in a row since that it did not limit.
    pub(crate) unlimited: usize,
    pub(crate) kind: PhantomData<(M, R)>,
}

impl<'a, X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'a, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// A run that has not started.
    pub(crate) fn new(
        accuracy: Accuracy,
        p: &'a [f64; P],
        (dp, columns): ([[f64; P]; C], usize),
        functionals: Functionals<C>,
    ) -> Self {
        let zero = Bundle::ZERO;
        let tolerance = Tolerance { relative: accuracy.relative, absolute: accuracy.absolute };
        let (stages, start_rates, end_rates) = (X::stages(), zero, zero);
        let step = Step { tau: 0.0, h: 0.0, start: zero, start_rates, stages, end: zero, end_rates };
        let (memory, branch) = (Vec::new(), vec![false; M::INFO.switches.len()]);
        Self {
            accuracy,
            segment: Segment { mode: 0, start: 0.0, p, memory, branch, dp, dstart: [0.0; C], columns, tolerance },
            step,
            work: X::Workspace::<N>::default(),
            controller: X::controller(),
            h: 0.0,
            ceiling: f64::INFINITY,
            watched: Vec::new(),
            fired: Vec::new(),
            ahead: None,
            on_section: ([0.0; N], [[0.0; N]; C]),
            functionals,
            events: Vec::new(),
            warnings: Vec::new(),
            statistics: Statistics::default(),
            record: None,
            trace: None,
            error: 0.0,
            deadline: accuracy.time_limit,
            hasty: 0,
            limited: 0,
            unlimited: 0,
            kind: PhantomData,
        }
    }

    /// Time since the start of the run.
    pub(crate) fn time(&self) -> f64 {
        self.segment.start + self.step.tau
    }

    /// Takes one step that satisfies the error control, and reads all surfaces at its end.
    pub(crate) fn advance(&mut self) -> Result<(), StopReason> {
        let mut failure = StopReason::StepTooSmall;
        for _ in 0..MOST_REJECTIONS {
            if self.accuracy.interrupt.requested() {
                return Err(StopReason::Interrupted);
            }
            let rest = self.deadline - self.time();
            if rest <= f64::EPSILON * self.deadline {
                return Err(StopReason::NoEvent);
            }
            if self.statistics.steps + self.statistics.rejected >= self.accuracy.step_limit || self.stiff() {
                return Err(StopReason::StepLimit);
            }
            let h = self.h.min(rest);
            if h <= 2.0 * f64::EPSILON * self.step.tau || h.is_nan() || h == 0.0 {
                break;
            }
            let mut size = self.attempt(h, Purpose::Advance);
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
                self.error = size;
                self.statistics.steps += 1;
                if self.statistics.steps > UNSUSPICIOUS {
                    self.watch_stiffness();
                }
                return Ok(());
            }
            failure = if size.is_nan() { StopReason::NotFinite } else { StopReason::StepTooSmall };
            self.statistics.rejected += 1;
        }
        Err(if self.domain_ends() { StopReason::NotFinite } else { failure })
    }

    /// Whether the equations are not defined a short way ahead along the tangent. At the edge of a domain (a square root
    /// near zero) the error control alone asks for ever smaller steps that all stay inside.
    fn domain_ends(&self) -> bool {
        let ahead = 1e-6 * self.time();
        let (mut x, k) = (self.step.start.x, &self.step.start_rates.x);
        for i in 0..N {
            x[i] += ahead * k[i];
        }
        !X::defined::<M, N, P, Q>(self.segment.frame(), self.step.tau + ahead, &x, k)
    }

    /// Whether the run is stiff: stability has limited many steps.
    pub(crate) fn stiff(&self) -> bool {
        self.limited >= STIFF_STEPS
    }

    /// Counts steps that stability limits; a few others in a row start the count again (as in the code DOP853 of Hairer and
    /// Wanner).
    fn watch_stiffness(&mut self) {
        if X::stiffness(&self.step) > NEAR_THE_LIMIT {
            (self.limited, self.unlimited) = (self.limited + 1, 0);
        } else {
            self.unlimited += 1;
            if self.unlimited >= FREE_STEPS {
                self.limited = 0;
            }
        }
    }

    pub(crate) fn attempt(&mut self, h: f64, purpose: Purpose) -> f64 {
        let (segment, tolerance) = (&self.segment, self.segment.tolerance);
        let evaluations = &mut self.statistics.evaluations;
        X::attempt::<M, R, N, P, Q, W, C>(
            &segment.held(),
            &mut self.step,
            h,
            purpose,
            tolerance,
            &mut self.work,
            evaluations,
        )
    }

    pub(crate) fn finish(&mut self) {
        let evaluations = &mut self.statistics.evaluations;
        X::finish::<M, R, N, P, Q, W, C>(&self.segment.held(), &mut self.step, evaluations);
    }

    /// Rates and surfaces at the end of the step; false when any is not finite.
    fn finish_step(&mut self) -> bool {
        self.finish();
        let (x, rate) = (&self.step.end.x, &self.step.end_rates.x);
        let env = self.segment.env(self.step.tau + self.step.h);
        let mut finite = rate.iter().all(|v| v.is_finite());
        for watched in &mut self.watched {
            watched.end = read::<M, N, P, Q>(watched.surface, x, rate, &env);
            finite &= watched.end.value.is_finite();
        }
        finite
    }

    /// Makes the end of the step the place where the run is.
    pub(crate) fn move_on(&mut self) {
        self.step.move_on();
    }
}
