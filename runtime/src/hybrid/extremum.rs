//! Largest and smallest values of observables over a map, exact in value and derivative.
//!
//! Candidates are the ends of segments and the places inside steps where the observable's rate o_x f + o_tau + o_t
//! changes sign. The latter are found on the dense output and then made exact: one Newton step on the true rate, and a
//! re-step of state and variations to that place.

use super::functionals::{Variation, Varied, along, observe};
use super::passing::Place;
use super::rates::Rates;
use super::resolution::PLACES;
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
        let g = M::observable_gradient(observable, self.segment.mode, x, flow, &self.segment.env(tau));
        (g.value, dot(&g.dx, flow) + g.dtau + g.dt)
    }

    /// Offers the place where the run is, an end of a segment.
    pub(crate) fn observe_boundary(&mut self, place: &Place<N, C>) {
        let (segment, x, tau) = (&self.segment, (&self.step.start.x, &self.step.stages[0].x), self.step.tau);
        for extremum in &mut self.functionals.extrema {
            let candidate =
                observe::<M, N, P, Q, C>(extremum.observable, segment.mode, x, &segment.env(tau), |g, c| {
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

    /// Looks for extrema inside the current step, between its ends and the places of [`PLACES`].
    pub(crate) fn examine_extrema(&mut self) {
        if self.functionals.extrema.is_empty() {
            return;
        }
        let step = state_step(&self.step);
        for e in 0..self.functionals.extrema.len() {
            let extremum = self.functionals.extrema[e];
            let peak = Peak { observable: extremum.observable, sense: extremum.sense };
            let end_tau = self.step.tau + self.step.h;
            let (value, rate) = self.slope(peak.observable, end_tau, &self.step.end.x, &self.step.end_rates.x);
            let end = (peak.sense * value, peak.sense * rate);
            self.functionals.extrema[e].last = end;
            let best = extremum.best.map_or(f64::NEG_INFINITY, |best| peak.sense * best.value);
            let better_than = best - 1e-6 * (extremum.last.0.abs() + end.0.abs());
            let found = peak.find::<M, N, P, Q>(self.segment.frame(), &step, (extremum.last, end), better_than);
            self.statistics.evaluations += 3 + PLACES.len();
            if let Some(h) = found {
                let candidate = self.observe_inside(peak.observable, h);
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
        let rate = self.segment.frame().flow::<M, N, Q>(tau, &y.x);
        observe::<M, N, P, Q, C>(observable, segment.mode, (&y.x, &rate), &segment.env(tau), |g, c| {
            along(g, Variation { dx: &y.dx[c], dk: &[0.0; N], dp: &segment.dp[c], dtau: 0.0, dt: segment.dstart[c] })
        })
    }
}

/// What is largest: `sense` times an observable.
#[derive(Clone, Copy, Debug)]
struct Peak {
    observable: usize,
    sense: f64,
}

/// Value and rate of a function at a fraction of a step.
type Knot = (f64, (f64, f64));

impl Peak {
    /// The time after the start of the step of the largest interior maximum, from the dense output and one Newton step
    /// on the true rate; `None` when there is none that is larger than `better_than`.
    #[inline(never)]
    fn find<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        &self,
        frame: Frame<'_, P>,
        step: &StateStep<N>,
        (start, end): ((f64, f64), (f64, f64)),
        better_than: f64,
    ) -> Option<f64> {
        let flow = |tau: f64, x: &[f64; N]| frame.flow::<M, N, Q>(tau, x);
        let dense: Dense<N> = Dense::new(step, &flow);
        let read = |tau: f64, x: &[f64; N]| {
            let rate = flow(tau, x);
            let g = M::observable_gradient(self.observable, frame.mode, x, &rate, &frame.env(tau));
            (self.sense * g.value, self.sense * (dot(&g.dx, &rate) + g.dtau + g.dt))
        };
        let inside = |u: f64| read(step.tau + u * step.h, &dense.at(u));
        let rate = |u: f64| inside(u).1;
        let mut knots: [Knot; PLACES.len() + 2] = [(0.0, start); PLACES.len() + 2];
        for (knot, u) in knots.iter_mut().skip(1).zip(PLACES) {
            *knot = (u, inside(u));
        }
        knots[PLACES.len() + 1] = (1.0, end);
        let maxima = knots.windows(2).filter_map(|pair| maximum_between(pair[0], pair[1], step.h, &rate));
        let values = maxima.map(|u| (u, inside(u).0));
        // NaN compares as largest and is looked at.
        let (u, value) = values.max_by(|a, b| a.1.total_cmp(&b.1))?;
        if value < better_than {
            return None;
        }
        let near = (1e-4_f64).min(0.5 * u.min(1.0 - u)).max(1e-9);
        let bend = (rate(u + near) - rate(u - near)) / (2.0 * near * step.h);
        let h = u * step.h;
        let correction = read(step.tau + h, &frame.restep::<M, N, Q>(step, h)).1 / bend;
        // The correction is of the size of the dense output's error; anything else means that there is no bend.
        Some(if correction.abs() <= 1e-3 * step.h { h - correction } else { h })
    }
}

/// The place of a maximum between two knots, if values and rates there tell of one.
fn maximum_between((a, at_a): Knot, (b, at_b): Knot, h: f64, rate: &impl Fn(f64) -> f64) -> Option<f64> {
    let (mut low, mut high) = ((a, at_a.1), (b, at_b.1));
    if !(low.1 > 0.0 && high.1 < 0.0) {
        let inner = a + (b - a) * inner_turn(at_a, at_b, (b - a) * h)?;
        let middle = (inner, rate(inner));
        if low.1 > 0.0 { high = middle } else { low = middle }
    }
    (low.1 > 0.0 && high.1 < 0.0).then(|| root(rate, low.0, low.1, high.0, high.1))
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
