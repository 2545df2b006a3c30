//! The equations of one segment in the form the integrator takes: flow, integrands and their variational columns.
//!
//! With x' = f(x, tau, t, p), t = start + tau and a column (v, w, s) of variations of state, parameters and start:
//! v' = f_x v + f_p w + f_t s, and likewise for the integrands.

use crate::event::Frame;
use crate::model::{Env, Model};
use crate::ode::Bundle;
use crate::sensitivity::Dual;

/// What stays constant while the clock tau runs: everything that the flow depends on besides state and tau.
#[derive(Clone, Debug)]
pub(crate) struct Segment<'a, const P: usize, const C: usize> {
    /// Index of the mode.
    pub(crate) mode: usize,
    /// Time since the start of the run at which tau was 0 (s).
    pub(crate) start: f64,
    /// Parameters.
    pub(crate) p: &'a [f64; P],
    /// Memory.
    pub(crate) memory: Vec<f64>,
    /// Frozen branch selectors.
    pub(crate) branch: Vec<bool>,
    /// Variations of the parameters, one array a column.
    pub(crate) dp: [[f64; P]; C],
    /// Variations of `start`, one a column.
    pub(crate) dstart: [f64; C],
}

impl<const P: usize, const C: usize> Segment<'_, P, C> {
    /// What does not depend on the columns.
    pub(crate) fn frame(&self) -> Frame<'_, P> {
        Frame { mode: self.mode, start: self.start, p: self.p, memory: &self.memory, branch: &self.branch }
    }

    /// The environment at `tau`.
    #[inline(always)]
    pub(crate) fn env(&self, tau: f64) -> Env<'_, f64, P> {
        Env { tau, t: self.start + tau, p: self.p, memory: &self.memory, branch: &self.branch }
    }
}

/// Which of a model's functions make up the right-hand side; W is the number of integrals that are carried.
pub(crate) trait Rates<
    M: Model<N, P, Q>,
    const N: usize,
    const P: usize,
    const Q: usize,
    const W: usize,
    const C: usize,
>
{
    /// Whether functionals are carried, so that their switches have to be located too.
    const MEASURED: bool;

    /// Time derivative of everything that is carried.
    fn rates(segment: &Segment<'_, P, C>, tau: f64, y: &Bundle<N, W, C>) -> Bundle<N, W, C>;
}

/// State and its variations with respect to the start only: the fast path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bare;

/// State, integrals and their variations, also with respect to parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole;

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize> Rates<M, N, P, Q, 0, C>
    for Bare
{
    const MEASURED: bool = false;

    #[inline]
    fn rates(segment: &Segment<'_, P, C>, tau: f64, y: &Bundle<N, 0, C>) -> Bundle<N, 0, C> {
        let (x, mut dx) = M::variational(segment.mode, &y.x, &y.dx, &segment.env(tau));
        if M::INFO.uses_time && C > 0 {
            add_time_columns::<M, N, P, Q, C>(segment, tau, &y.x, &mut dx, &mut [[0.0; Q]; C]);
        }
        Bundle { x, q: [], dx, dq: [[]; C] }
    }
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize> Rates<M, N, P, Q, Q, C>
    for Whole
{
    const MEASURED: bool = true;

    #[inline]
    fn rates(segment: &Segment<'_, P, C>, tau: f64, y: &Bundle<N, Q, C>) -> Bundle<N, Q, C> {
        let mut r = M::integrated_variational(segment.mode, &y.x, &y.dx, &segment.dp, &segment.env(tau));
        if M::INFO.uses_time && C > 0 {
            add_time_columns::<M, N, P, Q, C>(segment, tau, &y.x, &mut r.dflow, &mut r.dintegrands);
        }
        Bundle { x: r.flow, q: r.integrands, dx: r.dflow, dq: r.dintegrands }
    }
}

/// Adds the terms f_t s and i_t s of models whose equations use t.
#[cold]
#[inline(never)]
fn add_time_columns<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    segment: &Segment<'_, P, C>,
    tau: f64,
    x: &[f64; N],
    dx: &mut [[f64; N]; C],
    dq: &mut [[f64; Q]; C],
) {
    if segment.dstart.iter().all(|s| *s == 0.0) {
        return;
    }
    let constant = |value: f64| Dual { value, derivative: 0.0 };
    let memory: Vec<Dual> = segment.memory.iter().map(|m| constant(*m)).collect();
    let env = Env {
        tau: constant(tau),
        t: Dual { value: segment.start + tau, derivative: 1.0 },
        p: &segment.p.map(constant),
        memory: &memory,
        branch: &segment.branch,
    };
    let (flow, integrands) = M::integrated(segment.mode, &x.map(constant), &env);
    for c in 0..C {
        for i in 0..N {
            dx[c][i] += flow[i].derivative * segment.dstart[c];
        }
        for i in 0..Q {
            dq[c][i] += integrands[i].derivative * segment.dstart[c];
        }
    }
}
