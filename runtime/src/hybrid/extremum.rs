//! Largest and smallest values of observables over a map, exact in value and derivative.
//!
//! Candidates are the ends of segments and the places inside steps where the observable's rate o_x f + o_tau + o_t
//! changes sign. The latter are found on the dense output and then made exact: one Newton step on the true rate, and a
//! re-step of state and variations to that place.

use super::functionals::{Variation, Varied, along, observe};
use super::passing::Place;
use super::rates::Rates;
use super::run::Run;
use crate::event::locate::restep;
use crate::event::root;
use crate::model::Model;
use crate::ode::{Bundle, Dense, attempt};
use crate::sensitivity::dot;

impl<M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, M, R, N, P, Q, W, C>
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
            let candidate = observe::<M, N, P, Q, C>(
                extremum.observable,
                segment.mode,
                x,
                &segment.env(tau),
                |g, c| {
                    along(
                        g,
                        Variation {
                            dx: &place.dx[c],
                            dp: &segment.dp[c],
                            dtau: place.dtau[c],
                            dt: place.dt[c],
                        },
                    )
                },
            );
            extremum.offer(candidate);
        }
    }

    /// Offers the start of a segment and starts to look for extrema inside its steps.
    pub(crate) fn begin_extrema(&mut self, place: &Place<N, C>) {
        self.observe_boundary(place);
        for e in 0..self.functionals.extrema.len() {
            let extremum = self.functionals.extrema[e];
            let (value, rate) = self.slope(
                extremum.observable,
                self.step.tau,
                &self.step.start.x,
                &self.step.stages[0].x,
            );
            self.functionals.extrema[e].last = (extremum.sense * value, extremum.sense * rate);
        }
    }

    /// Looks for extrema inside the current step.
    pub(crate) fn examine_extrema(&mut self) {
        let mut dense = None;
        for e in 0..self.functionals.extrema.len() {
            let extremum = self.functionals.extrema[e];
            let (o, sense, (v0, r0)) = (extremum.observable, extremum.sense, extremum.last);
            let end_tau = self.step.tau + self.step.h;
            let (value, rate) = self.slope(o, end_tau, &self.step.end.x, &self.step.end_rates.x);
            let (v1, r1) = (sense * value, sense * rate);
            self.functionals.extrema[e].last = (v1, r1);
            let inner = inner_turn((v0, r0), (v1, r1), self.step.h);
            if !(r0 > 0.0 && r1 < 0.0) && inner.is_none() {
                continue;
            }
            let segment = &self.segment;
            let flow = |tau: f64, x: &[f64; N]| Self::flow(segment, tau, x);
            let dense: &Dense<N> = dense.get_or_insert_with(|| Dense::new(&self.step, &flow));
            let rate_at = |u: f64| {
                let (x, tau) = (dense.at(u), self.step.tau + u * self.step.h);
                sense * self.slope(o, tau, &x, &flow(tau, &x)).1
            };
            // A maximum is where the rate turns from positive to negative.
            let bracket = match inner {
                _ if r0 > 0.0 && r1 < 0.0 => Some((0.0, r0, 1.0, r1)),
                Some(u) if r0 > 0.0 => Some((0.0, r0, u, rate_at(u))),
                Some(u) => Some((u, rate_at(u), 1.0, r1)),
                None => None,
            };
            let Some((a, ra, b, rb)) = bracket.filter(|(_, ra, _, rb)| *ra > 0.0 && *rb < 0.0)
            else {
                continue;
            };
            let u = root(rate_at, a, ra, b, rb);
            let value = M::observable(
                o,
                segment.mode,
                &dense.at(u),
                &segment.env(self.step.tau + u * self.step.h),
            );
            let margin = 1e-6 * (v0.abs() + v1.abs());
            if extremum
                .best
                .is_none_or(|best| sense * value > sense * best.value - margin)
            {
                let near = (1e-4_f64).min(0.5 * u.min(1.0 - u)).max(1e-9);
                let bend = (rate_at(u + near) - rate_at(u - near)) / (2.0 * near * self.step.h);
                let candidate = self.polish(o, sense, u * self.step.h, bend);
                self.functionals.extrema[e].offer(candidate);
                self.statistics.evaluations += 26;
            }
        }
    }

    /// Value and derivatives of an observable at its extremum near `h` after the start of the step; `bend` is the
    /// derivative of `sense` times its rate there.
    fn polish(&self, observable: usize, sense: f64, h: f64, bend: f64) -> Varied<C> {
        let (segment, tau) = (&self.segment, self.step.tau);
        let flow = |tau: f64, x: &[f64; N]| Self::flow(segment, tau, x);
        let x = restep(&flow, &self.step, h);
        let rate = sense * self.slope(observable, tau + h, &x, &flow(tau + h, &x)).1;
        let newton = h - rate / bend;
        // The correction is of the size of the dense output's error; anything else means that there is no bend.
        let h = if (newton - h).abs() <= 1e-3 * self.step.h {
            newton
        } else {
            h
        };
        let mut k = self.step.stages;
        let rates = |tau: f64, y: &Bundle<N, W, C>| R::rates(segment, tau, y);
        let y = attempt(&rates, tau, h, &self.step.start, &mut k);
        observe::<M, N, P, Q, C>(
            observable,
            segment.mode,
            &y.x,
            &segment.env(tau + h),
            |g, c| {
                along(
                    g,
                    Variation {
                        dx: &y.dx[c],
                        dp: &segment.dp[c],
                        dtau: 0.0,
                        dt: segment.dstart[c],
                    },
                )
            },
        )
    }
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
