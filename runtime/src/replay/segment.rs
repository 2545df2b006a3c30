//! What a replay holds constant while the clock runs, and the rates of state and variations under it.

use super::moving::Moving;
use super::number::Number;
use crate::event::Surface;
use crate::model::{Env, Gradient, Model};
use crate::scalar::{LaneMask, Lanes, Scalar, filled};
use crate::sensitivity::{Dual, dot};
use smallvec::SmallVec;

/// So many numbers of a kind need no allocation.
pub(crate) const ROOM: usize = 8;

/// Mode, start of the clock, parameters, memory, selectors: numbers S, P parameters, C columns.
#[derive(Clone, Debug)]
pub(crate) struct Segment<'a, S: Number, const P: usize, const C: usize> {
    /// Index of the mode.
    pub(crate) mode: usize,
    /// Parameters.
    pub(crate) p: &'a [S; P],
    /// Memory.
    pub(crate) memory: SmallVec<[S; ROOM]>,
    /// Branch selectors.
    pub(crate) branch: SmallVec<[S::Mask; ROOM]>,
    /// Memory and selectors again, the same in all lanes: for terms of the clock, where numbers are single.
    pub(crate) wide_memory: SmallVec<[Lanes; ROOM]>,
    pub(crate) wide_branch: SmallVec<[LaneMask; ROOM]>,
    /// Time since the start of the replay at which the clock was 0, ...
    pub(crate) start: S,
    /// ... and its variations.
    pub(crate) dstart: [S; C],
}

impl<'a, S: Number, const P: usize, const C: usize> Segment<'a, S, P, C> {
    /// Nothing yet.
    pub(crate) fn new(p: &'a [S; P]) -> Self {
        let zero = S::constant(0.0);
        Self {
            mode: usize::MAX,
            p,
            memory: SmallVec::new(),
            branch: SmallVec::new(),
            wide_memory: SmallVec::new(),
            wide_branch: SmallVec::new(),
            start: zero,
            dstart: [zero; C],
        }
    }

    /// The environment at `tau`.
    #[inline(always)]
    pub(crate) fn env(&self, tau: S) -> Env<'_, S, P> {
        Env { tau, t: self.start + tau, p: self.p, memory: &self.memory, branch: &self.branch }
    }

    /// Takes these selectors.
    pub(crate) fn set_branch(&mut self, branch: &[bool]) {
        self.branch.clear();
        self.branch.extend(branch.iter().map(|b| S::mask(*b)));
        if S::ORDER == 0 && S::LANES == 1 {
            self.wide_branch.clear();
            self.wide_branch.extend(branch.iter().map(|b| Lanes::mask(*b)));
        }
    }

    /// Takes this memory.
    pub(crate) fn set_memory(&mut self, memory: &[f64]) {
        self.memory.clear();
        self.memory.extend(memory.iter().map(|m| S::constant(*m)));
        if S::ORDER == 0 && S::LANES == 1 {
            self.wide_memory.clear();
            self.wide_memory.extend(memory.iter().map(|m| Lanes::constant(*m)));
        }
    }

    /// State after a transition; the memory becomes that after it.
    pub(crate) fn reset<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &mut self,
        transition: usize,
        x: &[S; N],
        tau: S,
    ) -> [S; N] {
        let mut memory = self.memory.clone();
        let after = M::reset(transition, x, &self.env(tau), &mut memory);
        self.memory = memory;
        after
    }

    /// A surface's function with its derivatives.
    pub(crate) fn gradient<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        surface: Surface,
        x: &[S; N],
        tau: S,
    ) -> Gradient<S, N, P> {
        match surface {
            Surface::Transition(i) => M::guard_gradient(i, x, &self.env(tau)),
            Surface::Switch(i) => M::switch_gradient(i, x, &self.env(tau)),
        }
    }

    /// A surface's function.
    pub(crate) fn value<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        surface: Surface,
        x: &[S; N],
        tau: S,
    ) -> S {
        match surface {
            Surface::Transition(i) => M::guard(i, x, &self.env(tau)),
            Surface::Switch(i) => M::switch(i, x, &self.env(tau)),
        }
    }

    /// The rate of a surface's function where the state has the rate `f`; numbers that carry derivatives get its value alone.
    pub(crate) fn slope<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        surface: Surface,
        x: &[S; N],
        tau: S,
        f: &[S; N],
    ) -> S {
        if const { S::ORDER == 0 } {
            let g = self.gradient::<M, N, Q>(surface, x, tau);
            return dot(&g.dx, f) + g.dtau + g.dt;
        }
        S::from_values(|lane| {
            let (x, f) = (filled(0.0, |i| x[i].lane(lane)), filled(0.0, |i| f[i].lane(lane)));
            self.plain(lane, |segment| segment.slope::<M, N, Q>(surface, &x, tau.lane(lane), &f))
        })
    }

    /// The second derivative of the state with time, where its first is `f`; numbers that carry derivatives get its value alone.
    pub(crate) fn bend<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        tau: S,
        x: &[S; N],
        f: &[S; N],
    ) -> [S; N] {
        if const { S::ORDER == 0 } {
            return self.along_time::<M, N, Q>(tau, x, S::constant(1.0), f);
        }
        let in_lane = |lane: usize| {
            let (x, f) = (filled(0.0, |i| x[i].lane(lane)), filled(0.0, |i| f[i].lane(lane)));
            self.plain(lane, |segment| segment.along_time::<M, N, Q>(tau.lane(lane), &x, 1.0, &f))
        };
        filled(S::constant(0.0), |i| S::from_values(|lane| in_lane(lane)[i]))
    }

    /// The values of everything in one lane, in plain numbers.
    fn plain<R>(&self, lane: usize, use_it: impl FnOnce(&Segment<'_, f64, P, 0>) -> R) -> R {
        let p = filled(0.0, |i| self.p[i].lane(lane));
        use_it(&Segment {
            mode: self.mode,
            p: &p,
            memory: self.memory.iter().map(|m| m.lane(lane)).collect(),
            branch: self.branch.iter().map(|b| S::holds(*b, lane)).collect(),
            wide_memory: SmallVec::new(),
            wide_branch: SmallVec::new(),
            start: self.start.lane(lane),
            dstart: [],
        })
    }

    /// Rates of state and variations.
    pub(crate) fn rates<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        tau: S,
        y: &Moving<S, N, C>,
    ) -> Moving<S, N, C> {
        self.rates_with::<M, N, Q>(tau, &M::clock(self.mode, &self.env(tau)), y)
    }

    /// The same, where the terms of the clock are known.
    #[inline(always)]
    pub(crate) fn rates_with<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        tau: S,
        clock: &M::Clock<S>,
        y: &Moving<S, N, C>,
    ) -> Moving<S, N, C> {
        let (x, mut dx) = M::variational_at(self.mode, &y.x, &y.dx, clock, &self.env(tau));
        if const { M::INFO.uses_time && C > 0 } {
            let by_t = self.along_time::<M, N, Q>(tau, &y.x, S::constant(0.0), &[S::constant(0.0); N]);
            for c in 0..C {
                for i in 0..N {
                    dx[c][i] = by_t[i].mul_add(self.dstart[c], dx[c][i]);
                }
            }
        }
        Moving { x, dx }
    }

    /// The derivative of the flow with t, with the clock at the rate `dtau`, and with the state at the rate `dx`.
    #[inline(never)]
    pub(crate) fn along_time<M: Model<N, P, Q>, const N: usize, const Q: usize>(
        &self,
        tau: S,
        x: &[S; N],
        dtau: S,
        dx: &[S; N],
    ) -> [S; N] {
        let fixed = |value: S| Dual { value, derivative: [S::constant(0.0)] };
        let memory: SmallVec<[Dual<S>; ROOM]> = self.memory.iter().map(|m| fixed(*m)).collect();
        // A loop: `map` of arrays is not inlined here.
        let mut p = [fixed(S::constant(0.0)); P];
        for i in 0..P {
            p[i] = fixed(self.p[i]);
        }
        let env = Env {
            tau: Dual { value: tau, derivative: [dtau] },
            t: Dual::variable(self.start + tau, 0),
            p: &p,
            memory: &memory,
            branch: &self.branch,
        };
        let x = filled(Dual::constant(0.0), |i| Dual { value: x[i], derivative: [dx[i]] });
        let rates = M::flow(self.mode, &x, &env);
        filled(S::constant(0.0), |i| rates[i].derivative[0])
    }
}
