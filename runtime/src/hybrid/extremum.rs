//! Largest and smallest values of observables over a map, exact in value and derivative.
//!
//! Candidates are the ends of segments and the places inside steps where the observable's rate o_x k + o_k k' + o_tau + o_t
//! changes sign. The latter are found on the dense output and then made exact: one Newton step on the true rate, and a
//! re-step of state and variations to that place.

use super::functionals::{Variation, Varied, along, observe};
use super::landing::stand_at;
use super::passing::Place;
use super::resolution::PLACES;
use super::run::Run;
use super::segment::Segment;
use crate::event::{NOTHING, root};
use crate::integrate::{Bare, Carried, Frame, Held, Method, Point, StateStep, StepOf, state_step};
use crate::model::Model;
use crate::sensitivity::dot;

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Offers the place where the run is, an end of a segment.
    pub(crate) fn observe_boundary(&mut self, place: &Place<N, C>) {
        let (segment, x, tau) = (&self.segment, (&self.step.start.x, &self.step.start_rates.x), self.step.tau);
        for e in 0..self.functionals.extrema.len() {
            let observable = self.functionals.extrema[e].observable;
            let candidate = observe::<M, N, P, Q, C>(observable, segment.mode, x, &segment.env(tau), |g, c| {
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
            self.functionals.offer(e, segment.start + tau, candidate);
        }
    }

    /// Looks for extrema inside the current step, between its ends and the places of [`PLACES`].
    pub(crate) fn examine_extrema(&mut self) {
        if self.functionals.extrema.is_empty() {
            return;
        }
        let (frame, step) = (self.segment.frame(), state_step::<X, N, W, C>(&self.step));
        let start = Point { x: step.start.x, k: step.start_rates.x, bend: X::bend(&step, 0.0) };
        let end = Point { x: step.end.x, k: step.end_rates.x, bend: X::bend(&step, 1.0) };
        for e in 0..self.functionals.extrema.len() {
            let extremum = self.functionals.extrema[e];
            let peak = Peak { observable: extremum.observable, sense: extremum.sense };
            let ends = (
                peak.read::<M, N, P, Q>(frame, step.tau, &start),
                peak.read::<M, N, P, Q>(frame, step.tau + step.h, &end),
            );
            let best = extremum.best.map_or(f64::NEG_INFINITY, |best| peak.sense * best.value);
            // Where all places are wanted, the largest of each step is one.
            let better_than = match self.functionals.offered {
                Some(_) => f64::NEG_INFINITY,
                None => best - 1e-6 * (ends.0.0.abs() + ends.1.0.abs()),
            };
            let (work, evaluations) = (&mut self.work, &mut self.statistics.evaluations);
            if let Some(h) = peak.find::<X, M, N, P, Q>(frame, &step, ends, better_than, work, evaluations) {
                let candidate = Self::observe_inside(&self.segment, &self.step, peak.observable, h, work, evaluations);
                self.functionals.offer(e, self.segment.start + self.step.tau + h, candidate);
            }
        }
    }

    /// An observable with its derivatives `h` after the start of the step, where it is extremal: its place does not
    /// matter to first order.
    fn observe_inside(
        segment: &Segment<'_, P, C>,
        step: &StepOf<X, N, W, C>,
        observable: usize,
        h: f64,
        work: &mut X::Workspace<N>,
        evaluations: &mut usize,
    ) -> Varied<C> {
        let y = stand_at::<X, M, R, N, P, Q, W, C>(&segment.held(), step, h, work, evaluations);
        let (at, env) = ((&y.end.x, &y.end_rates.x), segment.env(step.tau + h));
        observe::<M, N, P, Q, C>(observable, segment.mode, at, &env, |g, c| {
            let (dx, dk) = (&y.end.dx[c], &y.end_rates.dx[c]);
            along(g, Variation { dx, dk, dp: &segment.dp[c], dtau: 0.0, dt: segment.dstart[c] })
        })
    }
}

/// Newton corrections of the place of an extremum.
const CORRECTIONS: usize = 2;

/// An observable at a point of a solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    /// Its value.
    pub(crate) value: f64,
    /// Its time derivative.
    pub(crate) rate: f64,
    /// What rounding makes of the value.
    pub(crate) rounding: f64,
}

/// Value and rate o_x k + o_k k' + o_tau + o_t of an observable.
pub(crate) fn slope<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    observable: usize,
    frame: Frame<'_, P>,
    tau: f64,
    at: &Point<N>,
) -> Slope {
    let g = M::observable_gradient(observable, frame.mode, &at.x, &at.k, &frame.env(tau));
    let (mut size, mut rate) = (g.value.abs(), dot(&g.dx, &at.k) + g.dtau + g.dt);
    for i in 0..N {
        size += (g.dx[i] * at.x[i]).abs();
        // A rate that does not matter need not be known.
        if g.dk[i] != 0.0 {
            size += (g.dk[i] * at.k[i]).abs();
            rate += g.dk[i] * at.bend[i];
        }
    }
    Slope { value: g.value, rate, rounding: (64.0 * f64::EPSILON * size).max(NOTHING) }
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
    /// `sense` times value and rate.
    fn read<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        &self,
        frame: Frame<'_, P>,
        tau: f64,
        at: &Point<N>,
    ) -> (f64, f64) {
        let slope = slope::<M, N, P, Q>(self.observable, frame, tau, at);
        (self.sense * slope.value, self.sense * slope.rate)
    }

    /// The time after the start of the step of the largest interior maximum, from the dense output and one Newton step
    /// on the true rate; `None` when there is none that is larger than `better_than`.
    #[inline(never)]
    fn find<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
        &self,
        frame: Frame<'_, P>,
        step: &StateStep<X, N>,
        (start, end): ((f64, f64), (f64, f64)),
        better_than: f64,
        work: &mut X::Workspace<N>,
        evaluations: &mut usize,
    ) -> Option<f64> {
        let dense = X::dense::<M, N, P, Q>(frame, step, evaluations);
        let place = |u: f64| X::point::<M, N, P, Q>(frame, step, &dense, u);
        let inside = |u: f64| self.read::<M, N, P, Q>(frame, step.tau + u * step.h, &place(u));
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
        let mut at = u * step.h;
        // The place enters the derivatives of the extremum to first order: it has to be that of the true solution.
        for _ in 0..CORRECTIONS {
            let held = Held { frame, dp: &[], dstart: &[], columns: 0 };
            let y = stand_at::<X, M, Bare, N, P, Q, 0, 0>(&held, step, at, work, evaluations);
            let exact = Point { x: y.end.x, k: y.end_rates.x, bend: X::bend(&y, 1.0) };
            let correction = self.read::<M, N, P, Q>(frame, step.tau + at, &exact).1 / bend;
            // It is of the size of the dense output's error; anything else means that there is no bend.
            if correction.is_nan() || correction.abs() > 1e-3 * step.h {
                break;
            }
            at -= correction;
        }
        Some(at)
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
