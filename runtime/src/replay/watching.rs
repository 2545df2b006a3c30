//! Whether surfaces do in a replay what they did in the plan, judged by their values and rates at the ends of steps.
//!
//! A surface has to be on the plan's side at the start of a leg and at the end of each step, and the cubic through values and
//! rates at both ends has to keep away from zero in between. That a cubic tells enough of a surface was made sure when the
//! plan was made: the run's steps were short enough for that, and a mesh that is not the run's is tried first, with a look
//! inside its steps.

use super::course::Course;
use super::landing::Landed;
use super::number::Number;
use super::plan::{Checks, Leg, Sides};
use crate::event::{Side, Surface};
use crate::hybrid::{FAR, MISFIT, PLACES};
use crate::model::Model;
use crate::scalar::filled;
use crate::sensitivity::dot;

/// Between its ends the cubic may come closer to zero than the closer end, by this factor.
const NEAR: f64 = 0.25;
/// A surface that is zero to rounding may be off by this many times what it was off in the plan.
const NOISE: f64 = 8.0;

impl<M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize>
    Course<'_, M, S, N, P, Q, C>
{
    /// Reads the watched surfaces at the start of a leg, and declines lanes in which one is on its other side.
    pub(crate) fn read_start(&mut self, leg: &Leg) {
        self.readings.clear();
        if const { S::ORDER > 0 } {
            return;
        }
        let last = !leg.end.surfaces.is_empty() && leg.sizes.len() == 1;
        for sides in &leg.watched {
            let g = self.segment.gradient::<M, N, Q>(sides.surface, &self.at.x, self.tau);
            let decides = last && leg.end.surfaces.first() == Some(&sides.surface);
            let after = if decides { leg.end.from } else { sides.at.get(1).copied().unwrap_or(Side::Unknown) };
            let sign = after.sign();
            let (zero, noise) = (S::constant(0.0), S::constant(NOISE * sides.noise));
            let rounding = self.rounding(&g, &self.at.x, self.tau);
            let rounding = S::select(rounding.less(noise), noise, rounding);
            let on_side = zero.less_equal(g.value.times(sign) + rounding);
            if counts::<M, N, P, Q>(sides.surface, after.opposite()) {
                self.valid = S::and(self.valid, on_side);
            }
            // On the other side by rounding is on the surface.
            let value = S::select(S::and(on_side, g.value.times(sign).less(zero)), zero, g.value);
            self.readings.push((value, dot(&g.dx, &self.rates.x) + g.dtau + g.dt));
        }
    }

    /// Declines lanes in which a watched surface does something else in step number `step`, which was taken to a state with
    /// its rates.
    pub(crate) fn watch(&mut self, leg: &Leg, step: usize, h: S, to: (&[S; N], &[S; N])) {
        let inside = (self.plan.checks == Checks::Trial).then(|| self.states_inside(h));
        for (i, sides) in leg.watched.iter().enumerate() {
            let (Some(&after), Some(&start)) = (sides.at.get(step + 1), self.readings.get(i)) else {
                self.valid = S::mask(false);
                return;
            };
            let end = self.read(sides, to, self.tau + h);
            if let Some(slot) = self.readings.get_mut(i) {
                *slot = end;
            }
            if after == Side::Unknown {
                continue;
            }
            self.valid = S::and(self.valid, S::constant(0.0).less(end.0.times(after.sign())));
            if !sides.clock_only {
                self.valid = S::and(self.valid, no_event::<M, S, N, P, Q>(sides.surface, after, h, (start, end)));
            }
            self.resolve(sides, h, (start, end), inside.as_ref());
        }
    }

    /// The same inside the step to the event. The surface that decides must not have been passed before; on which sides the
    /// others are at the end has been looked at.
    pub(crate) fn watch_last(&mut self, leg: &Leg, landed: &Landed<S, N, C>) {
        let h = landed.tau - self.tau;
        let inside = (self.plan.checks == Checks::Trial).then(|| self.states_inside(h));
        for (i, sides) in leg.watched.iter().enumerate() {
            let Some(&start) = self.readings.get(i) else {
                self.valid = S::mask(false);
                return;
            };
            let mut from = sides.at.last().copied().unwrap_or(Side::Unknown);
            if sides.clock_only || from == Side::Unknown {
                continue;
            }
            let mut end = self.read(sides, (&landed.at.x, &landed.before), landed.tau);
            if leg.end.surfaces.contains(&sides.surface) {
                end.0 = S::constant(0.0);
            }
            if leg.end.surfaces.first() == Some(&sides.surface) {
                from = leg.end.from;
            }
            self.valid = S::and(self.valid, no_event::<M, S, N, P, Q>(sides.surface, from, h, (start, end)));
            self.resolve(sides, h, (start, end), inside.as_ref());
        }
    }

    /// Value and rate of a surface at a state with its rates. The rate of a function of the clock is not asked for.
    fn read(&self, sides: &Sides, (x, rates): (&[S; N], &[S; N]), tau: S) -> (S, S) {
        let segment = &self.segment;
        if sides.clock_only {
            return (self.segment.value::<M, N, Q>(sides.surface, x, tau), S::constant(0.0));
        }
        let g = segment.gradient::<M, N, Q>(sides.surface, x, tau);
        (g.value, dot(&g.dx, rates) + g.dtau + g.dt)
    }

    /// States at [`PLACES`] of the step of size `h`, each by a step of its own.
    #[inline(never)]
    fn states_inside(&mut self, h: S) -> [[S; N]; PLACES.len()] {
        filled([S::constant(0.0); N], |i| self.step(h.times(PLACES[i])).0.x)
    }

    /// Declines lanes in which a surface is not resolved by the cubic, by the rule that runs have for their steps.
    fn resolve(&mut self, sides: &Sides, h: S, ends: ((S, S), (S, S)), inside: Option<&[[S; N]; PLACES.len()]>) {
        let Some(inside) = inside.filter(|_| !sides.clock_only) else {
            return;
        };
        let tau = self.tau;
        let values: [S; PLACES.len()] = filled(S::constant(0.0), |i| {
            self.segment.value::<M, N, Q>(sides.surface, &inside[i], tau + h.times(PLACES[i]))
        });
        let ((v0, d0), (v1, d1)) = ends;
        let (mut low, mut high) = (smaller(v0, v1), smaller(-v0, -v1));
        for value in values {
            (low, high) = (smaller(low, value), smaller(high, -value));
        }
        let range = -high - low;
        let nearest = S::select(S::constant(0.0).less(low), low, high);
        let mut resolved = S::mask(true);
        for (value, u) in values.into_iter().zip(PLACES) {
            let misfit = (value - cubic(u, (v0, h * d0), (v1, h * d1))).abs();
            resolved = S::and(resolved, misfit.less_equal(range.times(MISFIT)));
        }
        let far = range.times(FAR).less(nearest);
        self.valid = S::and(self.valid, S::or(resolved, far));
    }
}

/// Whether a passage of a surface that leaves `side` counts.
fn counts<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(surface: Surface, side: Side) -> bool {
    match surface {
        Surface::Transition(i) => M::INFO.transitions.get(i).is_none_or(|t| side.leaves(t.direction)),
        Surface::Switch(_) => true,
    }
}

/// Whether a surface that is on the side `after` at the end of a step of size `h`, or comes to zero from there, makes no passage
/// in it that counts: it has been there all the time, or came there once from the other side, if that does not count.
fn no_event<M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize>(
    surface: Surface,
    after: Side,
    h: S,
    (start, end): ((S, S), (S, S)),
) -> S::Mask {
    let sign = after.sign();
    let stays = keeps_away(sign, h, start, end);
    if counts::<M, N, P, Q>(surface, after.opposite()) {
        return stays;
    }
    let elsewhere = start.0.times(sign).less_equal(S::constant(0.0));
    S::or(stays, S::and(elsewhere, passes_once(sign, h, start, end)))
}

fn smaller<S: Number>(a: S, b: S) -> S {
    S::select(a.less(b), a, b)
}

/// The cubic with these values and slopes at 0 and 1.
fn cubic<S: Number>(u: f64, (v0, d0): (S, S), (v1, d1): (S, S)) -> S {
    let w = 1.0 - u;
    v0.times(w * w * (1.0 + 2.0 * u))
        .plus_times(u * u * (1.0 + 2.0 * w), v1)
        .plus_times(u * w * w, d0)
        .plus_times(-u * u * w, d1)
}

/// Whether the cubic through values and rates at both ends stays on the side `sign`, and not close to zero. It lies within
/// the hull of its control points, and closely within that of the control points of its quarters.
fn keeps_away<S: Number>(sign: f64, h: S, start: (S, S), end: (S, S)) -> S::Mask {
    let (v0, v1) = (start.0.times(sign), end.0.times(sign));
    let third = h.times(sign / 3.0);
    let zero = S::constant(0.0);
    let lower = smaller(v0, v1).times(NEAR);
    let lower = S::select(lower.less(zero), zero, lower);
    let whole = [v0, third.mul_add(start.1, v0), v1 - third * end.1, v1];
    let inner = |b: [S; 4]| S::and(lower.less_equal(b[1]), lower.less_equal(b[2]));
    let of_half = |b: [S; 4]| {
        let (left, right) = halves(b);
        S::and(inner(left), inner(right))
    };
    let (left, right) = halves(whole);
    S::and(of_half(left), of_half(right))
}

/// Whether the cubic, which is on the side `sign` at its end or comes to zero from there, and on the other at its start, passes
/// zero only once: its control points change sign only once.
fn passes_once<S: Number>(sign: f64, h: S, start: (S, S), end: (S, S)) -> S::Mask {
    let (third, zero) = (h.times(sign / 3.0), S::constant(0.0));
    let first = third.mul_add(start.1, start.0.times(sign));
    let second = end.0.times(sign) - third * end.1;
    let back_and_forth = S::and(zero.less(first), second.less(zero));
    let known = S::and(first.less_equal(first), second.less_equal(second));
    S::and(known, S::not(back_and_forth))
}

/// The control points of both halves of a cubic, by de Casteljau's construction.
fn halves<S: Number>([a, b, c, d]: [S; 4]) -> ([S; 4], [S; 4]) {
    let mean = |a: S, b: S| (a + b).times(0.5);
    let (ab, bc, cd) = (mean(a, b), mean(b, c), mean(c, d));
    let (abc, bcd) = (mean(ab, bc), mean(bc, cd));
    let middle = mean(abc, bcd);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

#[cfg(test)]
mod tests {
    use super::{cubic, keeps_away, passes_once};

    /// Whether a parabola around `low`, wherever its lowest point is, is seen to come down to it.
    #[test]
    fn a_dip_is_seen_wherever_it_is() {
        for i in 1..100 {
            let at = f64::from(i) / 100.0;
            let parabola = |low: f64| {
                let end = |u: f64| (low + (u - at).powi(2), 2.0 * (u - at));
                keeps_away(1.0, 1.0, end(0.0), end(1.0))
            };
            assert!(!parabola(-1e-9), "{at}");
            assert!(parabola(0.1), "{at}");
        }
    }

    #[test]
    fn a_surface_that_is_left_keeps_away_and_one_that_is_touched_does_not() {
        assert!(keeps_away(1.0, 0.5, (0.0, 1.0), (0.3, 0.2)));
        assert!(keeps_away(-1.0, 0.5, (0.0, -1.0), (-0.3, -0.2)));
        assert!(!keeps_away(1.0, 0.5, (0.0, -1.0), (0.3, 2.0)));
        // To the event, and to the event after a passage or two.
        assert!(keeps_away(1.0, 1.0, (1.0, -0.5), (0.0, -1.0)));
        assert!(!keeps_away(1.0, 1.0, (1.0, -9.0), (0.0, -3.0)));
        assert!(!keeps_away(1.0, 1.0, (1.0, f64::NAN), (1.0, 0.0)));
    }

    #[test]
    fn one_passage_is_told_from_three() {
        assert!(passes_once(1.0, 1.0, (-1.0, 2.0), (1.0, 2.0)));
        assert!(passes_once(-1.0, 1.0, (1.0, -2.0), (-1.0, -2.0)));
        assert!(!passes_once(1.0, 1.0, (-1.0, 12.0), (1.0, 12.0)));
        // Up, and down to the event.
        assert!(passes_once(1.0, 1.0, (-1.0, 9.0), (0.0, -3.0)));
        assert!(!passes_once(1.0, 1.0, (-1.0, f64::NAN), (1.0, 0.0)));
    }

    #[test]
    fn the_cubic_has_the_values_and_slopes_of_its_ends() {
        for u in [0.0, 0.3, 1.0] {
            let exact = 1.0 - 2.0 * u + 3.0 * u * u - 4.0 * u * u * u;
            assert!((cubic(u, (1.0, -2.0), (-2.0, -8.0)) - exact).abs() < 1e-14);
        }
    }
}
