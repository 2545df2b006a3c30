//! The end of a leg: its last step, the event located on it, and how state and variations pass it.
//!
//! The last step is taken with the plan's size, corrected by Newton's method on the true guard until the event is so close
//! that a Taylor polynomial of degree 2 leads there exactly: with delta the time that is left,
//!
//! ```text
//! x(T + delta) = x + f delta + (f_x f + f_tau + f_t) delta^2 / 2 + O(delta^3).
//! ```
//!
//! In numbers that carry derivatives delta varies although its value is zero to rounding; products of more than two
//! variations vanish, so that the polynomial is exact then, and gives the first- and second-order terms of the saltation
//! (docs/mathematics.md). In plain numbers the columns of variations pass by the saltation matrix.

use super::course::Course;
use super::moving::Moving;
use super::number::Number;
use super::plan::{End, Leg};
use crate::event::Surface;
use crate::hybrid::GRAZING;
use crate::model::{Gradient, Model, Section};
use crate::scalar::filled;
use crate::sensitivity::{Clock, Crossing};

/// Steps to the event before the replay gives up.
const ATTEMPTS: usize = 8;
/// The Taylor polynomial leads over this part of a step in plain numbers: what is left out is its square in the variations.
const SHORT: f64 = 1e-7;
/// The same in numbers with derivatives, whose own variations must not mix with what is left out.
const SHORT_WITH_DERIVATIVES: f64 = 1e-13;
/// Corrections on the polynomial. In plain numbers they converge quadratically from a start that is close; ...
const CORRECTIONS: usize = 2;
/// ... in numbers with derivatives each makes one more order of variations exact.
const CORRECTIONS_WITH_DERIVATIVES: usize = 4;
/// By how much the last step may be longer than the plan's.
const LONGEST: f64 = 1.5;
/// Values of other surfaces at the event that are zero to rounding: units in the last place of their terms.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// The place of an event.
pub(crate) struct Landed<S, const N: usize, const C: usize> {
    /// State and variations at the event's own time (not at the varied one).
    pub(crate) at: Moving<S, N, C>,
    /// The flow just before.
    pub(crate) before: [S; N],
    /// The clock.
    pub(crate) tau: S,
}

impl<M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize>
    Course<'_, M, S, N, P, Q, C>
{
    /// By how much the steps of a leg are longer than the plan's: where parameters alone decide when the leg ends, so that its
    /// mesh always fits.
    pub(crate) fn scale(&self, leg: &Leg) -> S {
        let one = S::constant(1.0);
        let Some(&surface) = leg.end.surfaces.first() else {
            return one;
        };
        if !leg.end.clock_only || leg.length() <= 0.0 {
            return one;
        }
        let (mut length, mut done) = (S::constant(leg.length()), S::mask(false));
        for _ in 0..ATTEMPTS {
            let (x, tau) = (&self.at.x, self.tau + length);
            let still = [S::constant(0.0); N];
            let excess =
                self.segment.value::<M, N, Q>(surface, x, tau) / self.segment.slope::<M, N, Q>(surface, x, tau, &still);
            // What one lane needs must not show in another.
            length = S::select(done, length, length - excess);
            let small = excess.abs().less_equal(length.abs().times(f64::EPSILON));
            done = S::or(done, small);
            if S::ORDER == 0 && S::all(done) {
                break;
            }
            if S::ORDER > 0 {
                done = S::mask(false);
            }
        }
        length.times(1.0 / leg.length())
    }

    fn gradient(&self, surface: Surface, x: &[S; N], tau: S) -> Gradient<S, N, P> {
        self.segment.gradient::<M, N, Q>(surface, x, tau)
    }

    /// Takes the last step of a leg and passes the event that ends it; `next` is the leg that follows in the same map.
    pub(crate) fn land(&mut self, leg: &Leg, next: Option<&Leg>) {
        let Some(&surface) = leg.end.surfaces.first() else {
            self.valid = S::mask(false);
            return;
        };
        let landed = self.locate(leg, surface);
        if const { S::ORDER == 0 } {
            self.check_end(leg, &landed);
            self.watch_last(leg, &landed);
        }
        match surface {
            Surface::Transition(i) => self.pass_transition(i, &landed),
            Surface::Switch(_) => self.pass_switches(&leg.end, next, &landed),
        }
    }

    /// The last step, to exactly the event.
    fn locate(&mut self, leg: &Leg, surface: Surface) -> Landed<S, N, C> {
        let planned = self.scale.times(leg.sizes.last().copied().unwrap_or(0.0));
        let short = if S::ORDER == 0 { SHORT } else { SHORT_WITH_DERIVATIVES };
        let mut h = planned;
        let mut attempt = 1;
        loop {
            let (end, rates) = self.step(h);
            let tau = self.tau + h;
            let delta = self.rest(surface, tau, &end.x, &rates.x);
            let near = delta.0.abs().less_equal(h.abs().times(short).plus_times(8.0 * f64::EPSILON, tau));
            if attempt == ATTEMPTS || S::all(S::or(near, S::not(self.valid))) {
                self.valid = S::and(self.valid, near);
                self.check_error(h, &end);
                return reach(tau, (end, rates), delta);
            }
            attempt += 1;
            let better = h + delta.0;
            let fits = S::and(S::constant(0.0).less(better), better.less(planned.times(LONGEST)));
            self.valid = S::and(self.valid, fits);
            h = S::select(S::and(fits, S::not(near)), better, h);
        }
    }

    /// The time that is left to the event from (`tau`, `x`), by the Taylor polynomial, and the rate of the flow there.
    fn rest(&self, surface: Surface, tau: S, x: &[S; N], f: &[S; N]) -> (S, [S; N]) {
        let bend = self.segment.bend::<M, N, Q>(tau, x, f);
        let mut delta = S::constant(0.0);
        for _ in 0..if S::ORDER == 0 { CORRECTIONS } else { CORRECTIONS_WITH_DERIVATIVES } {
            let there = taylor(x, f, &bend, delta);
            let rate = filled(S::constant(0.0), |i| bend[i].mul_add(delta, f[i]));
            let value = self.segment.value::<M, N, Q>(surface, &there, tau + delta);
            delta = delta - value / self.segment.slope::<M, N, Q>(surface, &there, tau + delta, &rate);
        }
        (delta, bend)
    }

    /// Declines lanes in which the event is not the plan's: grazing, not enabled, other surfaces elsewhere.
    fn check_end(&mut self, leg: &Leg, landed: &Landed<S, N, C>) {
        let Some(&first) = leg.end.surfaces.first() else {
            return;
        };
        let rate = self.segment.slope::<M, N, Q>(first, &landed.at.x, landed.tau, &landed.before);
        let away = rate.times(-leg.end.from.sign());
        let mut ok = S::constant(GRAZING * leg.end.fastest).less(away);
        if let Surface::Transition(i) = first {
            let margin = M::when(i, &landed.at.x, &self.segment.env(landed.tau));
            ok = S::and(ok, S::constant(0.0).less_equal(margin));
        }
        for sides in &leg.watched {
            let surfaces = &leg.end.surfaces;
            if sides.surface == first {
                continue;
            }
            let g = self.gradient(sides.surface, &landed.at.x, landed.tau);
            let holds = if surfaces.contains(&sides.surface) {
                g.value.abs().less_equal(self.rounding(&g, &landed.at.x, landed.tau))
            } else {
                let sign = sides.at.last().map_or(0.0, |side| side.sign());
                S::constant(0.0).less(g.value.times(sign))
            };
            ok = S::and(ok, holds);
        }
        self.valid = S::and(self.valid, ok);
    }

    /// Below this a function is zero to rounding: some units of the terms that it is made of.
    pub(crate) fn rounding(&self, g: &Gradient<S, N, P>, x: &[S; N], tau: S) -> S {
        let mut size = (g.dtau * tau).abs() + (g.dt * (self.segment.start + tau)).abs();
        for i in 0..N {
            size = size + (g.dx[i] * x[i]).abs();
        }
        for i in 0..P {
            size = size + (g.dp[i] * self.segment.p[i]).abs();
        }
        size.times(ROUNDING)
    }

    fn pass_transition(&mut self, i: usize, landed: &Landed<S, N, C>) {
        let (zero, Landed { at, before, tau }) = (S::constant(0.0), landed);
        let (still, mut dtau) = ([zero; P], [zero; C]);
        if const { C > 0 } {
            let guard = &self.gradient(Surface::Transition(i), &at.x, *tau);
            let reset = M::reset_jacobian(i, &at.x, &self.segment.env(*tau));
            let crossing = Crossing { guard, reset: Some(&reset), before: *before, clock: Clock::Restarts };
            for c in 0..C {
                dtau[c] = crossing.time_derivative(&at.dx[c], &still, self.segment.dstart[c]);
                self.at.dx[c] = crossing.pass(&at.dx[c], &still, self.segment.dstart[c], dtau[c]);
            }
        }
        if self.section == Section::Before(i) {
            self.on_section = *at;
            for c in 0..C {
                for k in 0..N {
                    self.on_section.dx[c][k] = before[k].mul_add(dtau[c], at.dx[c][k]);
                }
            }
        }
        self.at.x = self.segment.reset::<M, N, Q>(i, &at.x, *tau);
        self.segment.start = self.segment.start + *tau;
        self.tau = zero;
        for c in 0..C {
            self.segment.dstart[c] = self.segment.dstart[c] + dtau[c];
        }
    }

    /// Switches at one instant are passed one after the other, in the order of the plan; their selectors become those of the
    /// leg that follows.
    fn pass_switches(&mut self, end: &End, next: Option<&Leg>, landed: &Landed<S, N, C>) {
        let Some(next) = next else {
            self.valid = S::mask(false);
            return;
        };
        let (tau, mut before) = (landed.tau, landed.before);
        (self.at, self.tau) = (landed.at, tau);
        if const { S::ORDER > 0 } {
            return self.pass_one_by_one(end, next);
        }
        let zero = S::constant(0.0);
        for surface in &end.surfaces {
            let guard = self.gradient(*surface, &landed.at.x, tau);
            if let Surface::Switch(i) = *surface
                && let (Some(slot), Some(selector)) = (self.segment.branch.get_mut(i), next.branch.get(i))
            {
                *slot = S::mask(*selector);
            }
            let after = M::flow(self.segment.mode, &landed.at.x, &self.segment.env(tau));
            let crossing = Crossing { guard: &guard, reset: None, before, clock: Clock::RunsOn(after) };
            for c in 0..C {
                let dtau = crossing.time_derivative(&self.at.dx[c], &[zero; P], self.segment.dstart[c]);
                self.at.dx[c] = crossing.pass(&self.at.dx[c], &[zero; P], self.segment.dstart[c], dtau);
            }
            before = after;
        }
    }

    /// The same in numbers with derivatives. The times of the switches are equal, their variations are not: each is reached along
    /// the flow that the ones before it leave.
    fn pass_one_by_one(&mut self, end: &End, next: &Leg) {
        for (k, surface) in end.surfaces.iter().enumerate() {
            if k > 0 {
                let f = M::flow(self.segment.mode, &self.at.x, &self.segment.env(self.tau));
                let (delta, bend) = self.rest(*surface, self.tau, &self.at.x, &f);
                self.at.x = taylor(&self.at.x, &f, &bend, delta);
                self.tau = self.tau + delta;
            }
            if let Surface::Switch(i) = *surface
                && let (Some(slot), Some(selector)) = (self.segment.branch.get_mut(i), next.branch.get(i))
            {
                *slot = S::mask(*selector);
            }
        }
    }
}

/// State, variations and flow after `delta` more.
fn reach<S: Number, const N: usize, const C: usize>(
    tau: S,
    (end, rates): (Moving<S, N, C>, Moving<S, N, C>),
    (delta, bend): (S, [S; N]),
) -> Landed<S, N, C> {
    let mut at = Moving { x: taylor(&end.x, &rates.x, &bend, delta), dx: end.dx };
    for c in 0..C {
        for i in 0..N {
            at.dx[c][i] = rates.dx[c][i].mul_add(delta, at.dx[c][i]);
        }
    }
    let before = filled(S::constant(0.0), |i| bend[i].mul_add(delta, rates.x[i]));
    Landed { at, before, tau: tau + delta }
}

/// x + f delta + bend delta^2 / 2.
fn taylor<S: Number, const N: usize>(x: &[S; N], f: &[S; N], bend: &[S; N], delta: S) -> [S; N] {
    let half = delta.times(0.5);
    filled(S::constant(0.0), |i| bend[i].mul_add(half, f[i]).mul_add(delta, x[i]))
}
