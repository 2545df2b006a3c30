//! Passing an event: a switch (the flow changes, the state does not) or a transition (reset, new mode, clock at 0).

use super::functionals::{Variation, along, observe};
use super::run::Run;
use crate::event::{Found, Side, Surface, Watched, gradient, value};
use crate::integrate::{Carried, Method};
use crate::model::Model;
use crate::return_map::{Event, StopReason, Warning};
use crate::sensitivity::{Clock, Crossing};

/// A transversality below this fraction of the guard's largest rate in the segment is grazing: the linearisation then
/// holds for disturbances below its square only.
pub(crate) const GRAZING: f64 = 1e-4;
/// A segment shorter than this fraction of the time so far is hasty; so many in a row are a Zeno run.
const HASTY: f64 = 1e-10;
const MOST_HASTY: usize = 16;
/// How many units in the last place of what a surface's function goes through a place on it may be off by.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// By how much a reset that keeps what the guard measures may change what it is off by.
const KEPT: f64 = 8.0;

/// Derivatives of an event's place along the columns: of state and rate there, of tau and of the time since the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<const N: usize, const C: usize> {
    pub(crate) dx: [[f64; N]; C],
    pub(crate) dk: [[f64; N]; C],
    pub(crate) dtau: [f64; C],
    pub(crate) dt: [f64; C],
}

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Passes the first of `found`, at the end of the current step. The transition that was made, if any.
    pub(crate) fn pass(&mut self, found: &[Found], last: bool) -> Result<Option<usize>, StopReason> {
        let surfaces: Vec<Surface> =
            found.iter().filter_map(|f| self.watched.get(f.watched)).map(|w| w.surface).collect();
        let length = self.step.tau + self.step.h;
        self.note_fired(found);
        self.count_hasty(length, matches!(surfaces.first(), Some(Surface::Transition(_))))?;
        match surfaces.first() {
            Some(&Surface::Transition(i)) => {
                let fastest = found.first().and_then(|f| self.watched.get(f.watched)).map_or(0.0, |w| w.fastest);
                for other in &surfaces[1..] {
                    if let Surface::Transition(other) = *other {
                        let time = self.segment.start + length;
                        self.warnings.push(Warning::Tie { taken: i, other, time });
                    }
                }
                self.pass_transition(i, fastest, last)?;
                Ok(Some(i))
            }
            _ => {
                let switches: Vec<usize> =
                    surfaces.iter().filter_map(|s| if let Surface::Switch(i) = *s { Some(i) } else { None }).collect();
                self.pass_switches(&switches)?;
                Ok(None)
            }
        }
    }

    /// Notes the surfaces that are passed at the end of the step: their values are zero there but for rounding, of all that they
    /// and the state went through on the way, not of the little that is left.
    fn note_fired(&mut self, found: &[Found]) {
        self.fired.clear();
        let tau = self.step.tau + self.step.h;
        for w in found.iter().filter_map(|f| self.watched.get(f.watched)) {
            let left = value::<M, N, P, Q>(w.surface, &self.step.end.x, &self.segment.env(tau)).abs();
            let rounding = ROUNDING * w.largest.max(w.fastest * self.step.h).max(w.start.value.abs());
            self.fired.push((w.surface, rounding.max(KEPT * left)));
        }
    }

    /// A transition at once is a step of no length. A switch at once is only a selector that rounding had put on the
    /// other side; it counts when it goes on like that.
    fn count_hasty(&mut self, length: f64, transition: bool) -> Result<(), StopReason> {
        let time = self.segment.start + length;
        // At the beginning of a run the size of a step stands in for the time.
        let known = if self.segment.start > 0.0 { time } else { time.max(self.h) };
        if transition && length <= 4.0 * f64::EPSILON * known && self.step.tau == 0.0 {
            return Err(StopReason::Zeno);
        }
        let since_event = self.step.h;
        self.hasty = if since_event <= HASTY * time { self.hasty + 1 } else { 0 };
        if self.hasty > MOST_HASTY { Err(StopReason::Zeno) } else { Ok(()) }
    }

    /// Moves to the end of the step and says how that place depends on the columns.
    fn place(&mut self, crossing: &Crossing<'_, N, P>) -> Place<N, C> {
        let bend = X::bend(&self.step, 1.0);
        self.move_on();
        let y = &self.step;
        let mut place = Place { dx: y.start.dx, dk: y.start_rates.dx, dtau: [0.0; C], dt: self.segment.dstart };
        for c in 0..C {
            let dtau = crossing.time_derivative(&place.dx[c], &self.segment.dp[c], self.segment.dstart[c]);
            place.dtau[c] = dtau;
            place.dt[c] += dtau;
            for i in 0..N {
                place.dx[c][i] += crossing.before[i] * dtau;
                place.dk[c][i] += bend[i] * dtau;
            }
        }
        place
    }

    fn pass_transition(&mut self, i: usize, fastest: f64, last: bool) -> Result<(), StopReason> {
        let tau = self.step.tau + self.step.h;
        let (x, before, integrands) = (self.step.end.x, self.step.end_rates.x, self.step.end_rates.q);
        let guard = gradient::<M, N, P, Q>(Surface::Transition(i), &x, &self.segment.env(tau));
        let reset = M::reset_jacobian(i, &x, &self.segment.env(tau));
        let crossing = Crossing { guard: &guard, reset: Some(&reset), before, clock: Clock::Restarts };
        let (time, transversality) = (self.segment.start + tau, crossing.transversality());
        if transversality.abs() <= GRAZING * fastest {
            self.warnings.push(Warning::Grazing { transition: i, time, transversality });
        }
        let dstart = self.segment.dstart;
        let dx = self.step.end.dx;
        let place = self.place(&crossing);
        if self.ahead == Some(i) {
            self.on_section = (x, place.dx);
        }
        self.observe_boundary(&place);
        if last {
            self.record_end(&place);
        }
        for c in 0..C {
            self.step.start.dx[c] = crossing.pass(&dx[c], &self.segment.dp[c], dstart[c], place.dtau[c]);
            for k in 0..W {
                self.step.start.dq[c][k] += integrands[k] * place.dtau[c];
            }
        }
        let mut memory = self.segment.memory.clone();
        M::reset(i, &x, &self.segment.env(tau), &mut memory);
        self.step.start.x = reset.value;
        self.step.tau = 0.0;
        self.segment.memory = memory;
        self.segment.start = time;
        self.segment.dstart = place.dt;
        self.events.push(Event { transition: i, time, transversality, fastest: fastest.max(transversality.abs()) });
        self.segment.mode = M::INFO.transitions.get(i).map_or(usize::MAX, |t| t.to);
        self.check_finite()
    }

    /// Switches that are passed at one instant are passed one after the other, in the order of the spec: each changes the
    /// flow by its own part, and its own surface says how that moves.
    fn pass_switches(&mut self, switches: &[usize]) -> Result<(), StopReason> {
        let Some(&first) = switches.first() else {
            return Err(StopReason::NotFinite);
        };
        let tau = self.step.tau + self.step.h;
        let x = self.step.end.x;
        let (mut before, mut integrands) = (self.step.end_rates.x, self.step.end_rates.q);
        let guard = gradient::<M, N, P, Q>(Surface::Switch(first), &x, &self.segment.env(tau));
        let mut dx = self.step.end.dx;
        let place = self.place(&Crossing { guard: &guard, reset: None, before, clock: Clock::Restarts });
        self.observe_boundary(&place);
        let was_negative = |w: &Watched| (w.surface, w.side == Side::Negative);
        let selectors: Vec<(Surface, bool)> = self.watched.iter().map(was_negative).collect();
        for &i in switches {
            let guard = gradient::<M, N, P, Q>(Surface::Switch(i), &x, &self.segment.env(tau));
            if let Some((_, selector)) = selectors.iter().find(|(surface, _)| *surface == Surface::Switch(i))
                && let Some(slot) = self.segment.branch.get_mut(i)
            {
                *slot = *selector;
            }
            self.enter(Some(switches))?;
            let after = self.step.start_rates;
            let crossing = Crossing { guard: &guard, reset: None, before, clock: Clock::RunsOn(after.x) };
            for c in 0..C {
                let (dp, dstart) = (&self.segment.dp[c], self.segment.dstart[c]);
                let dtau = crossing.time_derivative(&dx[c], dp, dstart);
                dx[c] = crossing.pass(&dx[c], dp, dstart, dtau);
                for k in 0..W {
                    self.step.start.dq[c][k] += (integrands[k] - after.q[k]) * dtau;
                }
            }
            (before, integrands) = (after.x, after.q);
        }
        self.step.start.dx = dx;
        if C > 0 {
            self.begin_rates()?;
        }
        self.observe_boundary(&place);
        self.check_finite()
    }

    /// Whether state and variations are finite where the run is.
    pub(crate) fn check_finite(&self) -> Result<(), StopReason> {
        let y = &self.step.start;
        let finite = y.x.iter().chain(y.dx.iter().flatten()).all(|v| v.is_finite());
        if finite { Ok(()) } else { Err(StopReason::NotFinite) }
    }

    /// The `End` functionals, where the run is, just before a reset.
    fn record_end(&mut self, place: &Place<N, C>) {
        let (segment, x, tau) = (&self.segment, (&self.step.start.x, &self.step.start_rates.x), self.step.tau);
        self.functionals.record_end(M::INFO, |o| {
            observe::<M, N, P, Q, C>(o, segment.mode, x, &segment.env(tau), |g, c| {
                along(
                    g,
                    Variation {
                        dx: &place.dx[c],
                        dk: &place.dk[c],
                        dp: &segment.dp[c],
                        dtau: place.dtau[c],
                        dt: place.dt[c],
                    },
                )
            })
        });
    }
}
