//! A replay in progress: the loop from section to section along a plan, in any number.
//!
//! State and variations are integrated on the plan's mesh; each leg ends at its event, located anew (`landing`). Along the
//! way it is checked, lane by lane, that the error of each step is within the tolerance and that all surfaces are on the
//! plan's sides (`watching`); a lane for which that is not so is declined: what it holds is no result.

use super::moving::{Moving, within};
use super::number::{Number, STEPS};
use super::plan::{Checks, Leg, Plan};
use super::segment::{ROOM, Segment};
use crate::model::{Model, Section};
use crate::ode::explicit::{Rates, Stages, attempt, stage_times};
use crate::ode::{OdeState, Tolerance};
use crate::scalar::filled;
use crate::sensitivity::through;
use core::marker::PhantomData;
use smallvec::SmallVec;

/// A replay of a plan of model M: numbers S, N states, P parameters, C columns of variations.
pub(crate) struct Course<'a, M, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize> {
    /// The plan.
    pub(crate) plan: &'a Plan,
    /// What is constant in the leg.
    pub(crate) segment: Segment<'a, S, P, C>,
    /// By how much the steps of the leg are longer than the plan's.
    pub(crate) scale: S,
    /// State and variations where the replay is, ...
    pub(crate) at: Moving<S, N, C>,
    /// ... and their rates.
    pub(crate) rates: Moving<S, N, C>,
    /// Clock of the segment.
    pub(crate) tau: S,
    /// Stages of the last step.
    pub(crate) stages: Stages<Moving<S, N, C>>,
    /// Lanes that are not declined.
    pub(crate) valid: S::Mask,
    /// Readings (value and rate) of the watched surfaces where the replay is.
    pub(crate) readings: SmallVec<[(S, S); ROOM]>,
    /// Where the section stands, ...
    pub(crate) section: Section,
    /// ... and, if it stands before a transition, state and variations there.
    pub(crate) on_section: Moving<S, N, C>,
    kind: PhantomData<M>,
}

impl<'a, M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize>
    Course<'a, M, S, N, P, Q, C>
{
    /// A replay that has not started.
    #[inline(always)]
    pub(crate) fn new(plan: &'a Plan, section: Section, p: &'a [S; P]) -> Self {
        let (zero, none) = (S::constant(0.0), Moving::zero());
        Self {
            plan,
            segment: Segment::new(p),
            scale: S::constant(1.0),
            at: none,
            rates: none,
            tau: zero,
            stages: [none; 12],
            valid: S::mask(true),
            readings: SmallVec::new(),
            section,
            on_section: none,
            kind: PhantomData,
        }
    }

    /// Replays the whole map from section coordinates `z` with variations `dz`; returns where it ends.
    pub(crate) fn map(&mut self, z: &[S], dz: &[[S; N]; C]) -> Moving<S, N, C> {
        let mut coordinates = Moving { x: [S::constant(0.0); N], dx: *dz };
        for (slot, z) in coordinates.x.iter_mut().zip(z) {
            *slot = *z;
        }
        for turn in &self.plan.turns {
            self.embed(&coordinates);
            self.tau = S::constant(0.0);
            self.leave(turn);
            let start = self.segment.start;
            self.go(turn);
            let limit = self.plan.accuracy.time_limit * (1.0 + 4.0 * f64::EPSILON);
            let in_time = (self.segment.start - start).less_equal(S::constant(limit));
            self.valid = S::and(self.valid, in_time);
            coordinates = self.project();
        }
        coordinates
    }

    /// Goes through legs, one after the other.
    pub(crate) fn go(&mut self, legs: &[Leg]) {
        for (i, leg) in legs.iter().enumerate() {
            self.begin(leg);
            self.steps(leg);
            if !leg.end.surfaces.is_empty() {
                self.land(leg, legs.get(i + 1));
            }
        }
    }

    /// State on the section and its variations.
    pub(crate) fn embed(&mut self, coordinates: &Moving<S, N, C>) {
        let z = coordinates.x.get(..M::INFO.coordinates.len()).unwrap_or(&[]);
        self.at.x = M::embed(z, self.segment.p);
        if const { C == 0 } {
            return;
        }
        let mut by_z = [[S::constant(0.0); N]; N];
        M::embed_jacobian(z, self.segment.p, by_z.get_mut(..z.len()).unwrap_or(&mut []));
        for c in 0..C {
            for i in 0..N {
                let mut sum = S::constant(0.0);
                for j in 0..z.len() {
                    sum = by_z[j][i].mul_add(coordinates.dx[c][j], sum);
                }
                self.at.dx[c][i] = sum;
            }
        }
    }

    /// Makes the transition that follows a section which stands before one.
    pub(crate) fn leave(&mut self, turn: &[Leg]) {
        let (Section::Before(i), Some(leg)) = (self.section, turn.first()) else {
            return;
        };
        self.segment.set_branch(&leg.branch);
        self.segment.set_memory(&leg.memory);
        let zero = S::constant(0.0);
        let x = self.at.x;
        if const { C > 0 } {
            let reset = M::reset_jacobian(i, &x, &self.segment.env(zero));
            for c in 0..C {
                self.at.dx[c] = through(&reset, &self.at.dx[c], &[zero; P], self.segment.dstart[c], zero);
            }
        }
        self.at.x = self.segment.reset::<M, N, Q>(i, &x, zero);
    }

    /// Starts a leg where the replay is.
    fn begin(&mut self, leg: &Leg) {
        self.segment.mode = leg.mode;
        self.segment.set_memory(&leg.memory);
        self.segment.set_branch(&leg.branch);
        self.rates = self.segment.rates::<M, N, Q>(self.tau, &self.at);
        self.scale = self.scale(leg);
        self.valid = S::and(self.valid, S::constant(0.0).less(self.scale));
        self.read_start(leg);
    }

    /// Takes the steps of a leg, but for the one that ends at an event.
    fn steps(&mut self, leg: &Leg) {
        let to_event = usize::from(!leg.end.surfaces.is_empty());
        let sizes = leg.sizes.get(..leg.sizes.len().saturating_sub(to_event)).unwrap_or(&[]);
        for (step, size) in sizes.iter().enumerate() {
            if self.plan.accuracy.interrupt.requested() {
                self.valid = S::mask(false);
                return;
            }
            let h = self.scale.times(*size);
            let (end, rates) = self.step(h);
            self.check_error(h, &end);
            if const { S::ORDER == 0 } {
                self.watch(leg, step, h, (&end.x, &rates.x));
            }
            end.put(&mut self.at);
            rates.put(&mut self.rates);
            self.tau = self.tau + h;
        }
    }

    /// Declines lanes in which the error of the last step, of size `h` to `end`, is not within the tolerance.
    pub(crate) fn check_error(&mut self, h: S, end: &Moving<S, N, C>) {
        if const { S::ORDER == 0 } {
            let accuracy = &self.plan.accuracy;
            let tolerance = Tolerance { relative: accuracy.relative, absolute: accuracy.absolute };
            self.valid = S::and(
                self.valid,
                within(h, &self.at, end, &self.stages, tolerance, self.plan.checks != Checks::State),
            );
        }
    }

    /// One step of size `h` from where the replay is; its end, and the rates there.
    #[inline(never)]
    pub(crate) fn step(&mut self, h: S) -> (Moving<S, N, C>, Moving<S, N, C>) {
        let Self { segment, stages, tau, at, .. } = self;
        let times = stage_times(*tau, h);
        let clocks = S::clocks::<M, N, P, Q, C>(segment, *tau, h);
        let at_end = match &clocks {
            Some(clocks) => clocks[STEPS - 1],
            None => M::clock(segment.mode, &segment.env(times[STEPS - 1])),
        };
        let rates = AtStages::<M, S, N, P, Q, C> { segment, times: &times, clocks: &clocks, at_end };
        self.rates.put(&mut stages[0]);
        let end = attempt(&rates, h, at, stages);
        let last = rates.at(STEPS, &end);
        (end, last)
    }

    /// Applies the symmetry to the state on the section and takes its coordinates.
    pub(crate) fn project(&self) -> Moving<S, N, C> {
        let mut state = if matches!(self.section, Section::Before(_)) { self.on_section } else { self.at };
        if M::INFO.symmetric {
            if const { C > 0 } {
                let by = M::symmetry_jacobian(&state.x, self.segment.p).dx;
                let (zero, dx) = (S::constant(0.0), state.dx);
                state.dx = filled([zero; N], |c| {
                    filled(zero, |i| (0..N).fold(zero, |sum, j| by[j][i].mul_add(dx[c][j], sum)))
                });
            }
            state.x = M::symmetry(&state.x, self.segment.p);
        }
        let mut result = Moving::zero();
        for (k, &i) in M::INFO.coordinates.iter().enumerate().filter(|(k, i)| *k < N && **i < N) {
            result.x[k] = state.x[i];
            for c in 0..C {
                result.dx[c][k] = state.dx[c][i];
            }
        }
        result
    }
}

/// The flow at the stages of a step.
struct AtStages<'a, M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize> {
    segment: &'a Segment<'a, S, P, C>,
    times: &'a [S; STEPS],
    /// The terms of the clock, where they are known beforehand, ...
    clocks: &'a Option<[M::Clock<S>; STEPS]>,
    /// ... and those at the end of the step, which the last stage and the next step share.
    at_end: M::Clock<S>,
}

impl<M: Model<N, P, Q>, S: Number, const N: usize, const P: usize, const Q: usize, const C: usize>
    Rates<Moving<S, N, C>> for AtStages<'_, M, S, N, P, Q, C>
{
    #[inline(always)]
    fn at(&self, i: usize, y: &Moving<S, N, C>) -> Moving<S, N, C> {
        let i = (i - 1).min(STEPS - 1);
        let (segment, tau) = (self.segment, self.times[i]);
        if const { S::ORDER > 0 } {
            return segment.rates::<M, N, Q>(tau, y);
        }
        let clock = match self.clocks {
            Some(clocks) => clocks[i],
            None if i == STEPS - 1 => self.at_end,
            None => M::clock(segment.mode, &segment.env(tau)),
        };
        segment.rates_with::<M, N, Q>(tau, &clock, y)
    }
}
