//! Whether a step is short enough to see what guards, switching functions and observables do inside it.
//!
//! The error control knows the flow only: where the flow is simple (free flight), steps may be longer than the time in
//! which a guard goes through zero and back. A function counts as resolved where, at a few places inside the step, it
//! is close to the cubic through its values and rates at both ends.

use super::rates::Rates;
use super::run::Run;
use super::segment::state_step;
use crate::event::{Frame, Surface};
use crate::model::Model;
use crate::ode::Dense;
use crate::sensitivity::dot;

/// Places inside a step, as fractions of it; uneven, so that a periodic function does not hide behind them.
pub(crate) const PLACES: [f64; 4] = [0.13, 0.37, 0.61, 0.87];
/// Largest distance from the cubic, relative to the range of the values seen in the step.
const MISFIT: f64 = 0.1;
/// A function that stays this many ranges away from zero needs no closer look: it has no event nearby.
const FAR: f64 = 2.0;

impl<M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize> Run<'_, M, R, N, P, Q, W, C>
where
    M: Model<N, P, Q>,
    R: Rates<M, N, P, Q, W, C>,
{
    /// Whether all surfaces and observables are resolved in the current step; notes where a surface is on its other
    /// side inside the step.
    pub(crate) fn resolved(&mut self) -> bool {
        let of_clock = self.functionals.extrema.is_empty() && self.watched.iter().all(|w| w.clock_only());
        let inside = if of_clock { [self.step.start.x; PLACES.len()] } else { self.inside() };
        self.surfaces_resolved(&inside) && self.extrema_resolved(&inside)
    }

    /// States at [`PLACES`].
    #[inline(never)]
    fn inside(&mut self) -> [[f64; N]; PLACES.len()] {
        let frame = self.segment.frame();
        let dense = Dense::new(&state_step(&self.step), &|tau, x: &[f64; N]| frame.flow::<M, N, Q>(tau, x));
        self.statistics.evaluations += 3;
        PLACES.map(|u| dense.at(u))
    }

    fn surfaces_resolved(&mut self, inside: &[[f64; N]; PLACES.len()]) -> bool {
        let (frame, tau, h): (Frame<'_, P>, f64, f64) = (self.segment.frame(), self.step.tau, self.step.h);
        for w in &mut self.watched {
            let value = |i: usize| {
                let env = frame.env(tau + PLACES[i] * h);
                match w.surface {
                    Surface::Transition(transition) => M::guard(transition, &inside[i], &env),
                    Surface::Switch(switch) => M::switch(switch, &inside[i], &env),
                }
            };
            let values: [f64; PLACES.len()] = core::array::from_fn(value);
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

    fn extrema_resolved(&self, inside: &[[f64; N]; PLACES.len()]) -> bool {
        let (tau, h) = (self.step.tau, self.step.h);
        self.functionals.extrema.iter().all(|extremum| {
            let (o, mode) = (extremum.observable, self.segment.mode);
            let value = |i: usize| {
                let at = tau + PLACES[i] * h;
                let rate = self.segment.frame().flow::<M, N, Q>(at, &inside[i]);
                M::observable(o, mode, &inside[i], &rate, &self.segment.env(at))
            };
            let values: [f64; PLACES.len()] = core::array::from_fn(value);
            let slope = |x: &[f64; N], flow: &[f64; N], tau: f64| {
                let g = M::observable_gradient(o, mode, x, flow, &self.segment.env(tau));
                let size = (0..N).map(|i| (g.dx[i] * x[i]).abs()).sum::<f64>() + g.value.abs();
                ((g.value, h * (dot(&g.dx, flow) + g.dtau + g.dt)), 64.0 * f64::EPSILON * size)
            };
            let (start, noise) = slope(&self.step.start.x, &self.step.stages[0].x, tau);
            let (end, more) = slope(&self.step.end.x, &self.step.end_rates.x, tau + h);
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
