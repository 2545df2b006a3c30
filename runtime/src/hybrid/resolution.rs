//! Whether a step is short enough to see what guards, switching functions and observables do inside it.
//!
//! The error control knows the flow only: where the flow is simple (free flight), steps may be longer than the time in
//! which a guard goes through zero and back. A function counts as resolved where, at a few places inside the step, it
//! is close to the cubic through its values and rates at both ends.

use super::extremum::slope;
use super::run::Run;
use crate::event::value;
use crate::integrate::{Carried, Frame, Method, Point, state_step};
use crate::model::Model;
use crate::scalar::filled;

/// Places inside a step, as fractions of it; uneven, so that a periodic function does not hide behind them.
pub(crate) const PLACES: [f64; 4] = [0.13, 0.37, 0.61, 0.87];
/// Largest distance from the cubic, relative to the range of the values seen in the step.
pub(crate) const MISFIT: f64 = 0.1;
/// A function that stays this many ranges away from zero needs no closer look: it has no event nearby.
pub(crate) const FAR: f64 = 2.0;

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Whether all surfaces and observables are resolved in the current step; notes where a surface is on its other
    /// side inside the step.
    pub(crate) fn resolved(&mut self) -> bool {
        if self.functionals.extrema.is_empty() {
            let of_clock = self.watched.iter().all(|w| w.clock_only());
            let inside = if of_clock { [self.step.start.x; PLACES.len()] } else { self.states_inside() };
            return self.surfaces_resolved(&inside);
        }
        let points = self.points_inside();
        self.surfaces_resolved(&filled([0.0; N], |i| points[i].x)) && self.extrema_resolved(&points)
    }

    /// States at [`PLACES`].
    #[inline(never)]
    fn states_inside(&mut self) -> [[f64; N]; PLACES.len()] {
        let step = state_step::<X, N, W, C>(&self.step);
        let dense = X::dense::<M, N, P, Q>(self.segment.frame(), &step, &mut self.statistics.evaluations);
        filled([0.0; N], |i| X::state(&dense, PLACES[i]))
    }

    /// States and rates at [`PLACES`].
    #[inline(never)]
    fn points_inside(&mut self) -> [Point<N>; PLACES.len()] {
        let (frame, step) = (self.segment.frame(), state_step::<X, N, W, C>(&self.step));
        let dense = X::dense::<M, N, P, Q>(frame, &step, &mut self.statistics.evaluations);
        let blank = Point { x: [0.0; N], k: [0.0; N], bend: [0.0; N] };
        filled(blank, |i| X::point::<M, N, P, Q>(frame, &step, &dense, PLACES[i]))
    }

    fn surfaces_resolved(&mut self, inside: &[[f64; N]; PLACES.len()]) -> bool {
        let (frame, tau, h): (Frame<'_, P>, f64, f64) = (self.segment.frame(), self.step.tau, self.step.h);
        for w in &mut self.watched {
            let at = |i: usize| value::<M, N, P, Q>(w.surface, &inside[i], &frame.env(tau + PLACES[i] * h));
            let values: [f64; PLACES.len()] = filled(0.0, at);
            let ends = Ends { start: (w.start.value, h * w.start.rate), end: (w.end.value, h * w.end.rate) };
            let noise = w.start.rounding.max(w.end.rounding);
            if !ends.explain(&values, noise) && !ends.far_from_zero(&values) {
                return false;
            }
            let beyond = |v: &f64| w.side.sign() * v < -noise;
            w.dip = values.iter().position(beyond).map(|i| (PLACES[i], values[i]));
        }
        true
    }

    fn extrema_resolved(&self, inside: &[Point<N>; PLACES.len()]) -> bool {
        let (frame, step) = (self.segment.frame(), &self.step);
        let (tau, h) = (step.tau, step.h);
        let start = Point { x: step.start.x, k: step.start_rates.x, bend: X::bend(step, 0.0) };
        let end = Point { x: step.end.x, k: step.end_rates.x, bend: X::bend(step, 1.0) };
        self.functionals.extrema.iter().all(|extremum| {
            let o = extremum.observable;
            let value = |i: usize| {
                let Point { x, k, .. } = &inside[i];
                M::observable(o, frame.mode, x, k, &frame.env(tau + PLACES[i] * h))
            };
            let values: [f64; PLACES.len()] = filled(0.0, value);
            let slope = |at: &Point<N>, tau: f64| {
                let s = slope::<M, N, P, Q>(o, frame, tau, at);
                ((s.value, h * s.rate), s.rounding)
            };
            let ((start, noise), (end, more)) = (slope(&start, tau), slope(&end, tau + h));
            Ends { start, end }.explain(&values, noise.max(more))
        })
    }
}

/// Value and change over the step at its rate, at both ends.
#[derive(Clone, Copy, Debug)]
struct Ends {
    start: (f64, f64),
    end: (f64, f64),
}

impl Ends {
    /// Whether the cubic through both ends is close to the values at [`PLACES`]. Values that are not finite explain
    /// nothing.
    fn explain(&self, values: &[f64; PLACES.len()], noise: f64) -> bool {
        let allowed = (MISFIT * self.range(values)).max(noise);
        values.iter().zip(PLACES).all(|(value, u)| (value - self.cubic(u)).abs() <= allowed)
    }

    fn cubic(&self, u: f64) -> f64 {
        let ((v0, d0), (v1, d1)) = (self.start, self.end);
        let w = 1.0 - u;
        v0 * w * w * (1.0 + 2.0 * u) + v1 * u * u * (1.0 + 2.0 * w) + u * w * (d0 * w - d1 * u)
    }

    fn range(&self, values: &[f64; PLACES.len()]) -> f64 {
        let all = || values.iter().copied().chain([self.start.0, self.end.0]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    }

    fn far_from_zero(&self, values: &[f64; PLACES.len()]) -> bool {
        let all = || values.iter().copied().chain([self.start.0, self.end.0]);
        let one_side = all().all(|v| v > 0.0) || all().all(|v| v < 0.0);
        one_side && all().map(f64::abs).fold(f64::INFINITY, f64::min) > FAR * self.range(values)
    }
}

#[cfg(test)]
mod tests {
    use super::{Ends, PLACES};

    fn ends(f: impl Fn(f64) -> f64, rate: impl Fn(f64) -> f64) -> (Ends, [f64; 4]) {
        (Ends { start: (f(0.0), rate(0.0)), end: (f(1.0), rate(1.0)) }, PLACES.map(f))
    }

    #[test]
    fn a_cubic_is_resolved_and_several_periods_are_not() {
        let (cubic, values) = ends(|u| 1.0 - 3.0 * u + u * u * u, |u| -3.0 + 3.0 * u * u);
        assert!(cubic.explain(&values, 1e-15));
        for k in [6.0_f64, 10.0, 37.0, 1000.0, 628.3] {
            let (wave, values) = ends(|u| (k * u).sin(), |u| k * (k * u).cos());
            assert!(!wave.explain(&values, 1e-12) && !wave.far_from_zero(&values), "{k}");
        }
        let (high, values) = ends(|u| 10.0 + (50.0 * u).sin(), |u| 50.0 * (50.0 * u).cos());
        assert!(!high.explain(&values, 1e-12) && high.far_from_zero(&values));
    }

    #[test]
    fn values_that_are_not_finite_are_not_resolved() {
        let (ends, _) = ends(|u| u, |_| 1.0);
        assert!(!ends.explain(&[0.1, f64::NAN, 0.2, 0.3], 1.0));
    }
}
