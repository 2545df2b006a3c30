//! Largest and smallest values of observables over a map, exact in value and derivative.
//!
//! Candidates are the ends of segments and the places inside steps where the observable's rate o_x f + o_tau + o_t
//! changes sign. The latter are found on the dense output and then made exact: one Newton step on the true rate, and a
//! re-step of state and variations to that place.

use super::functionals::{Variation, Varied, along, observe};
use super::passing::Place;
use super::rates::Rates;
use super::run::Run;
use super::segment::state_step;
use crate::event::{Frame, StateStep, root};
use crate::model::Model;
use crate::ode::Dense;
use crate::sensitivity::dot;

impl<M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize> Run<'_, M, R, N, P, Q, W, C>
where
    M: Model<N, P, Q>,
    R: Rates<M, N, P, Q, W, C>,
{
    /// Value and rate of an observable.
    fn slope(&self, observable: usize, tau: f64, x: &[f64; N], flow: &[f64; N]) -> (f64, f64) {
        let g = M::observable_gradient(observable, self.segment.mode, x, &self.segment.env(tau));
        (g.value, dot(&g.dx, flow) + g.dtau + g.dt)
    }

    /// Offers the place where the run is, an end of a segment.
    pub(crate) fn observe_boundary(&mut self, place: &Place<N, C>) {
        let (segment, x, tau) = (&self.segment, &self.step.start.x, self.step.tau);
        for extremum in &mut self.functionals.extrema {
            let candidate =
                observe::<M, N, P, Q, C>(extremum.observable, segment.mode, x, &segment.env(tau), |g, c| {
                    along(g, Variation { dx: &place.dx[c], dp: &segment.dp[c], dtau: place.dtau[c], dt: place.dt[c] })
                });
            extremum.offer(candidate);
        }
    }

    /// Offers the start of a segment and starts to look for extrema inside its steps.
    pub(crate) fn begin_extrema(&mut self, place: &Place<N, C>) {
        self.observe_boundary(place);
        for e in 0..self.functionals.extrema.len() {
            let extremum = self.functionals.extrema[e];
            let (value, rate) =
                self.slope(extremum.observable, self.step.tau, &self.step.start.x, &self.step.stages[0].x);
            self.functionals.extrema[e].last = (extremum.sense * value, extremum.sense * rate);
        }
    }

    /// Looks for extrema inside the current step.
    pub(crate) fn examine_extrema(&mut self) {
        let end_tau = self.step.tau + self.step.h;
        for e in 0..self.functionals.extrema.len() {
            let extremum = self.functionals.extrema[e];
            let (o, sense, start) = (extremum.observable, extremum.sense, extremum.last);
            let (value, rate) = self.slope(o, end_tau, &self.step.end.x, &self.step.end_rates.x);
            let end = (sense * value, sense * rate);
            self.functionals.extrema[e].last = end;
            let Some(bracket) = bracket(start, end, self.step.h) else {
                continue;
            };
            let better_than = extremum.best.map_or(f64::NEG_INFINITY, |best| sense * best.value);
            let better_than = better_than - 1e-6 * (start.0.abs() + end.0.abs());
            let peak = Peak { observable: o, sense, bracket, better_than };
            let step = state_step(&self.step);
            let found = peak.find::<M, N, P, Q>(self.segment.frame(), &step, (start.1, end.1));
            self.statistics.evaluations += 3;
            if let Some(h) = found {
                let candidate = self.observe_inside(o, h);
                self.functionals.extrema[e].offer(candidate);
                self.statistics.evaluations += 23;
            }
        }
    }

    /// An observable with its derivatives `h` after the start of the step, where it is extremal: its place does not
    /// matter to first order.
    fn observe_inside(&self, observable: usize, h: f64) -> Varied<C> {
        let (segment, tau) = (&self.segment, self.step.tau + h);
        let mut k = self.step.stages;
        let y = Self::attempt(segment, self.step.tau, h, &self.step.start, &mut k);
        observe::<M, N, P, Q, C>(observable, segment.mode, &y.x, &segment.env(tau), |g, c| {
            along(g, Variation { dx: &y.dx[c], dp: &segment.dp[c], dtau: 0.0, dt: segment.dstart[c] })
        })
    }
}

/// Where in a step a maximum of `sense` times an observable is looked for.
#[derive(Clone, Copy, Debug)]
struct Peak {
    observable: usize,
    sense: f64,
    bracket: Bracket,
    /// Smaller maxima do not matter.
    better_than: f64,
}

/// Between which fractions of the step the rate turns from positive to negative.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bracket {
    Whole,
    Until(f64),
    From(f64),
}

impl Peak {
    /// The time after the start of the step, from the dense output and one Newton step on the true rate.
    #[inline(never)]
    fn find<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        &self,
        frame: Frame<'_, P>,
        step: &StateStep<N>,
        (r0, r1): (f64, f64),
    ) -> Option<f64> {
        let flow = |tau: f64, x: &[f64; N]| frame.flow::<M, N, Q>(tau, x);
        let dense: Dense<N> = Dense::new(step, &flow);
        let rate_of = |tau: f64, x: &[f64; N]| {
            let g = M::observable_gradient(self.observable, frame.mode, x, &frame.env(tau));
            self.sense * (dot(&g.dx, &flow(tau, x)) + g.dtau + g.dt)
        };
        let rate = |u: f64| rate_of(step.tau + u * step.h, &dense.at(u));
        let (a, ra, b, rb) = match self.bracket {
            Bracket::Whole => (0.0, r0, 1.0, r1),
            Bracket::Until(u) => (0.0, r0, u, rate(u)),
            Bracket::From(u) => (u, rate(u), 1.0, r1),
        };
        if !(ra > 0.0 && rb < 0.0) {
            return None;
        }
        let u = root(rate, a, ra, b, rb);
        let value = M::observable(self.observable, frame.mode, &dense.at(u), &frame.env(step.tau + u * step.h));
        // Written so that NaN is looked at.
        if self.sense * value < self.better_than {
            return None;
        }
        let near = (1e-4_f64).min(0.5 * u.min(1.0 - u)).max(1e-9);
        let bend = (rate(u + near) - rate(u - near)) / (2.0 * near * step.h);
        let h = u * step.h;
        let correction = rate_of(step.tau + h, &frame.restep::<M, N, Q>(step, h)) / bend;
        // The correction is of the size of the dense output's error; anything else means that there is no bend.
        Some(if correction.abs() <= 1e-3 * step.h { h - correction } else { h })
    }
}

/// Whether a maximum may lie inside a step, from values and rates at its ends.
fn bracket((v0, r0): (f64, f64), (v1, r1): (f64, f64), h: f64) -> Option<Bracket> {
    if r0 > 0.0 && r1 < 0.0 {
        return Some(Bracket::Whole);
    }
    let inner = inner_turn((v0, r0), (v1, r1), h)?;
    Some(if r0 > 0.0 { Bracket::Until(inner) } else { Bracket::From(inner) })
}

/// Where the rate of the cubic through values and rates at both ends is smallest or largest, if it has a zero there that
/// the rates at the ends (of equal sign) do not show. A fraction of the step.
fn inner_turn((v0, r0): (f64, f64), (v1, r1): (f64, f64), h: f64) -> Option<f64> {
    if r0 * r1 <= 0.0 {
        return None;
    }
    // The rate is r0 + b u + c u^2 with the integral (v1 - v0)/h.
    let mean = (v1 - v0) / h;
    let c = 3.0 * (r0 + r1 - 2.0 * mean);
    let b = r1 - r0 - c;
    let u = -b / (2.0 * c);
    let extreme = r0 + 0.5 * b * u;
    (u > 0.0 && u < 1.0 && extreme * r0 < 0.0).then_some(u)
}
