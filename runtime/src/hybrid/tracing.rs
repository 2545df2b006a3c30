//! What a run tells its trace, where it has one.
//!
//! Only the instances that [`super::follow`] uses can have one; for all others nothing of this is compiled.

use super::landing::{EARLY, LAST_PART};
use super::run::Run;
use crate::integrate::{Bare, Carried, Frame, Held, Method, Purpose, StateStep, state_step};
use crate::model::Model;
use crate::return_map::StopReason;
use crate::scalar::filled;
use crate::trajectory::trace::Trace;

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Whether runs of this kind can have a trace.
    const TRACED: bool = C == 0 || X::RATES_BY_POLYNOMIAL && R::MEASURED;

    /// The current step is complete: looks for extrema inside it, and takes samples.
    pub(crate) fn complete_step(&mut self) -> Result<(), StopReason> {
        self.examine_extrema();
        if Self::TRACED && self.trace.is_some() {
            let step = state_step::<X, N, W, C>(&self.step);
            if let Some(trace) = &mut self.trace {
                sample::<X, M, N, P, Q>(trace, self.segment.frame(), &step);
                // Whoever follows the run knows by the trace that it is full.
                return if trace.full { Err(StopReason::StepLimit) } else { Ok(()) };
            }
        }
        Ok(())
    }

    /// A segment has begun where the run is.
    pub(crate) fn note_begin(&mut self) {
        let (t, tau) = (self.time(), self.step.tau);
        if Self::TRACED
            && let Some(trace) = &mut self.trace
        {
            trace.segment(self.segment.mode, &self.segment.memory, t, tau);
            trace.sample(t, tau, (&self.step.start.x, &self.step.start_rates.x));
        }
    }

    /// The current step has led to an event.
    pub(crate) fn note_arrival(&mut self) {
        let tau = self.step.tau + self.step.h;
        if Self::TRACED
            && let Some(trace) = &mut self.trace
        {
            trace.arrive(self.segment.start + tau, tau, (&self.step.end.x, &self.step.end_rates.x));
        }
    }

    /// An event was passed: a transition, and the run is where its reset has put it; or a switch, and the flow is another one.
    pub(crate) fn note_passed(&mut self, transition: bool) {
        let (t, tau) = (self.time(), self.step.tau);
        let (state, rate) = (&self.step.start.x, &self.step.start_rates.x);
        if !Self::TRACED {
            return;
        }
        match (&mut self.trace, self.events.last()) {
            (Some(trace), Some(event)) if transition => trace.passed(event, state, &self.segment.memory),
            (Some(trace), _) => trace.sample(t, tau, (state, rate)),
            _ => {}
        }
    }

    /// The run is at its end; where it stopped on the way, that place is to be seen, too.
    pub(crate) fn note_end_of_run(&mut self, stopped: bool) {
        let (t, tau) = (self.time(), self.step.tau);
        let (state, mut rate) = (&self.step.start.x, self.step.start_rates.x);
        let Some(trace) = &mut self.trace else {
            return;
        };
        let (made, noted) = (self.events.len(), trace.events.len());
        if made > noted
            && let Some(event) = self.events.last()
        {
            trace.passed(event, state, &self.segment.memory);
        }
        let finite = state.iter().all(|v| v.is_finite());
        if stopped && finite && trace.events.len() >= trace.segments.len() {
            // Stopped where a segment was to begin: rates are not known there.
            trace.segment(self.segment.mode, &self.segment.memory, t, tau);
            rate = [f64::NAN; N];
        }
        let ahead = trace.samples.t.last().is_none_or(|last| t > *last);
        if finite && trace.events.len() < trace.segments.len() && (ahead || rate[..].iter().any(|v| v.is_nan())) {
            trace.sample(t, tau, (state, &rate));
        }
    }
}

/// Takes the samples whose times lie inside a step.
#[inline(never)]
fn sample<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    trace: &mut Trace,
    frame: Frame<'_, P>,
    step: &StateStep<X, N>,
) {
    let end = frame.start + step.tau + step.h;
    if trace.next_before(end).is_none() {
        return;
    }
    // Its own room: what the run's holds must not depend on where samples are.
    let mut work = X::Workspace::<N>::default();
    let dense = X::dense::<M, N, P, Q>(frame, step, &mut 0);
    let first = X::point::<M, N, P, Q>(frame, step, &dense, 0.0).k;
    while let Some(t) = trace.next_before(end) {
        let h = (t - frame.start - step.tau).clamp(0.0, step.h);
        let solved = if h < EARLY * step.h { None } else { stand::<X, M, N, P, Q>(frame, step, h, &mut work) };
        let (x, mut k) = solved.unwrap_or_else(|| {
            let at = X::point::<M, N, P, Q>(frame, step, &dense, h / step.h);
            // The rate at the start is known better than the polynomial's, which knows how it changes.
            (at.x, filled(0.0, |i| step.start_rates.x[i] + (at.k[i] - first[i])))
        });
        if const { M::INFO.explicit } {
            k = M::flow(frame.mode, &x, &frame.env(step.tau + h));
        }
        trace.grid_sample(t, step.tau + h, (&x, &k));
    }
}

/// State and rate `h` after the start of a step, as the end of a step of their own; `None` where that cannot be solved. Where rates
/// come from stages it is split as a step to an event is, see [`super::landing`].
fn stand<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    step: &StateStep<X, N>,
    h: f64,
    work: &mut X::Workspace<N>,
) -> Option<([f64; N], [f64; N])> {
    let held = Held { frame, dp: &[], dstart: &[], columns: 0 };
    let mut y = *step;
    let mut go = |y: &mut StateStep<X, N>, h: f64| {
        let tolerance = frame.tolerance;
        let error = X::attempt::<M, Bare, N, P, Q, 0, 0>(&held, y, h, Purpose::Land, tolerance, work, &mut 0);
        X::finish::<M, Bare, N, P, Q, 0, 0>(&held, y, &mut 0);
        error.is_finite()
    };
    let solved = if X::RATES_BY_POLYNOMIAL && const { !M::INFO.explicit } {
        let most = go(&mut y, (1.0 - LAST_PART) * h);
        y.move_on();
        most && go(&mut y, LAST_PART * h)
    } else {
        go(&mut y, h)
    };
    let (x, k) = (y.end.x, y.end_rates.x);
    (solved && x.iter().chain(&k).all(|v| v.is_finite())).then_some((x, k))
}
