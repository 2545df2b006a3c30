//! Whether surfaces do in a replay what they did in the plan, judged by their values and rates at the ends of steps.
//!
//! A surface has to be on the plan's side at the end of each step, and the cubic through values and rates at both ends has
//! to keep away from zero in between; the plan's own steps were short enough to see what surfaces do inside them.

use super::course::Course;
use super::number::Number;
use super::plan::{Leg, Sides};
use crate::event::{Side, Surface};
use crate::hybrid::PLACES;
use crate::model::Model;
use crate::sensitivity::dot;

/// Between its ends the cubic may come closer to zero than the closer end, by this factor.
const NEAR: f64 = 0.25;

impl<M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize>
    Course<'_, M, S, N, P, Q, C>
{
    /// Reads the watched surfaces at the start of a leg.
    pub(crate) fn read_start(&mut self, leg: &Leg) {
        self.readings.clear();
        if const { S::ORDER > 0 } {
            return;
        }
        for sides in &leg.watched {
            let reading = self.read(sides);
            self.readings.push(reading);
        }
    }

    /// Declines lanes in which a watched surface does something else in step number `step`, which has just been taken.
    pub(crate) fn watch(&mut self, leg: &Leg, step: usize, h: S) {
        if const { S::ORDER > 0 } {
            return;
        }
        for (i, sides) in leg.watched.iter().enumerate() {
            let (Some(&from), Some(&to), Some(&start)) =
                (sides.at.get(step), sides.at.get(step + 1), self.readings.get(i))
            else {
                self.valid = S::mask(false);
                return;
            };
            let end = self.read(sides);
            if let Some(slot) = self.readings.get_mut(i) {
                *slot = end;
            }
            if to == Side::Unknown {
                continue;
            }
            let sign = to.sign();
            self.valid = S::and(self.valid, S::constant(0.0).less(end.0.times(sign)));
            if from == to && !sides.clock_only {
                self.valid = S::and(self.valid, keeps_away(sign, h, start, end));
            }
        }
    }

    /// Value and rate of a surface where the replay is. The rate of a function of the clock is not asked for.
    fn read(&self, sides: &Sides) -> (S, S) {
        let (x, segment) = (&self.at.x, &self.segment);
        if sides.clock_only {
            let value = match sides.surface {
                Surface::Transition(i) => M::guard(i, x, &segment.env(self.tau)),
                Surface::Switch(i) => M::switch(i, x, &segment.env(self.tau)),
            };
            return (value, S::constant(0.0));
        }
        let g = segment.gradient::<M, N, Q>(sides.surface, x, self.tau);
        (g.value, dot(&g.dx, &self.rates.x) + g.dtau + g.dt)
    }
}

/// Whether the cubic through values and rates at both ends stays on the side `sign`, and not close to zero.
fn keeps_away<S: Number>(sign: f64, h: S, start: (S, S), end: (S, S)) -> S::Mask {
    let (v0, v1) = (start.0.times(sign), end.0.times(sign));
    let (d0, d1) = (h * start.1.times(sign), h * end.1.times(sign));
    let zero = S::constant(0.0);
    let lower = S::select(v0.less(v1), v0, v1).times(NEAR);
    let lower = S::select(lower.less(zero), zero, lower);
    PLACES.iter().fold(S::mask(true), |all, &u| {
        let w = 1.0 - u;
        let cubic = v0
            .times(w * w * (1.0 + 2.0 * u))
            .plus_times(u * u * (1.0 + 2.0 * w), v1)
            .plus_times(u * w * w, d0)
            .plus_times(-u * u * w, d1);
        S::and(all, lower.less(cubic))
    })
}
