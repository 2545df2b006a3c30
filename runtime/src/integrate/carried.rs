//! What is integrated along with the state: nothing, or integrals and variations with respect to parameters.
//!
//! With x' = f(x, tau, t, p), t = start + tau and a column (v, w, s) of variations of state, parameters and start:
//! v' = f_x v + f_p w + f_t s, and likewise for the integrands. In residual form F(x, x', ...) = 0 the variation of F that
//! does not come from the state is F_p w + F_t s.

use super::frame::Held;
use crate::model::{Directions, Env, Model};
use crate::ode::Bundle;
use crate::scalar::filled;
use crate::sensitivity::Dual;

/// Which of a model's functions make up the right-hand side; W is the number of integrals that are carried.
pub(crate) trait Carried<
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

    /// Time derivative of everything that is carried, by the explicit flow.
    fn rates(held: &Held<'_, P, C>, tau: f64, y: &Bundle<N, W, C>) -> Bundle<N, W, C>;

    /// The variations of the residual at state and rate (`x`, `k`) that come from parameters and start.
    fn forced(held: &Held<'_, P, C>, tau: f64, x: &[f64; N], k: &[f64; N]) -> [[f64; N]; C];

    /// Integrands and their variations at state and rate (`x`, `k`) with variations (`dx`, `dk`).
    fn integrands(
        held: &Held<'_, P, C>,
        tau: f64,
        point: (&[f64; N], &[f64; N]),
        columns: (&[[f64; N]; C], &[[f64; N]; C]),
    ) -> ([f64; W], [[f64; W]; C]);
}

/// State and its variations with respect to the start only: the fast path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bare;

/// State, integrals and their variations, also with respect to parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole;

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize> Carried<M, N, P, Q, 0, C>
    for Bare
{
    const MEASURED: bool = false;

    #[inline]
    fn rates(held: &Held<'_, P, C>, tau: f64, y: &Bundle<N, 0, C>) -> Bundle<N, 0, C> {
        let (x, mut dx) = M::variational(held.frame.mode, &y.x, &y.dx, &held.frame.env(tau));
        if M::INFO.uses_time && C > 0 {
            add_time_columns::<M, N, P, Q, C>(held, tau, &y.x, &mut dx, &mut [[0.0; Q]; C]);
        }
        Bundle { x, q: [], dx, dq: [[]; C] }
    }

    #[inline]
    fn forced(held: &Held<'_, P, C>, tau: f64, x: &[f64; N], k: &[f64; N]) -> [[f64; N]; C] {
        if M::INFO.uses_time && held.columns > 0 { forced::<M, N, P, Q, C>(held, tau, x, k) } else { [[0.0; N]; C] }
    }

    #[inline]
    fn integrands(
        _: &Held<'_, P, C>,
        _: f64,
        _: (&[f64; N], &[f64; N]),
        _: (&[[f64; N]; C], &[[f64; N]; C]),
    ) -> ([f64; 0], [[f64; 0]; C]) {
        ([], [[]; C])
    }
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize> Carried<M, N, P, Q, Q, C>
    for Whole
{
    const MEASURED: bool = true;

    // Called twelve times a step: inlined, it would be most of what there is to compile.
    #[inline(never)]
    fn rates(held: &Held<'_, P, C>, tau: f64, y: &Bundle<N, Q, C>) -> Bundle<N, Q, C> {
        let mut r = M::integrated_variational(held.frame.mode, &y.x, &y.dx, held.dp, &held.frame.env(tau));
        if M::INFO.uses_time && C > 0 {
            add_time_columns::<M, N, P, Q, C>(held, tau, &y.x, &mut r.dflow, &mut r.dintegrands);
        }
        Bundle { x: r.flow, q: r.integrands, dx: r.dflow, dq: r.dintegrands }
    }

    #[inline]
    fn forced(held: &Held<'_, P, C>, tau: f64, x: &[f64; N], k: &[f64; N]) -> [[f64; N]; C] {
        if held.columns > 0 { forced::<M, N, P, Q, C>(held, tau, x, k) } else { [[0.0; N]; C] }
    }

    #[inline(never)]
    fn integrands(
        held: &Held<'_, P, C>,
        tau: f64,
        (x, k): (&[f64; N], &[f64; N]),
        (dx, dk): (&[[f64; N]; C], &[[f64; N]; C]),
    ) -> ([f64; Q], [[f64; Q]; C]) {
        let along = Directions { dx, dk, dp: held.dp, dt: held.dstart };
        M::integrands_along(held.frame.mode, x, k, &along, &held.frame.env(tau))
    }
}

fn forced<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    held: &Held<'_, P, C>,
    tau: f64,
    x: &[f64; N],
    k: &[f64; N],
) -> [[f64; N]; C] {
    let all = M::residual_jacobian(held.frame.mode, x, k, &held.frame.env(tau));
    core::array::from_fn(|c| {
        let mut sum = filled(0.0, |i| all.dt[i] * held.dstart[c]);
        for (column, w) in all.dp.iter().zip(&held.dp[c]) {
            // Most columns vary one parameter.
            if *w != 0.0 {
                for i in 0..N {
                    sum[i] += column[i] * w;
                }
            }
        }
        sum
    })
}

/// Adds the terms f_t s and i_t s of models whose equations use t.
#[cold]
#[inline(never)]
fn add_time_columns<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    held: &Held<'_, P, C>,
    tau: f64,
    x: &[f64; N],
    dx: &mut [[f64; N]; C],
    dq: &mut [[f64; Q]; C],
) {
    if held.dstart.iter().all(|s| *s == 0.0) {
        return;
    }
    let constant = |value: f64| Dual { value, derivative: [0.0] };
    let frame = held.frame;
    let memory: Vec<Dual> = frame.memory.iter().map(|m| constant(*m)).collect();
    let env = Env {
        tau: constant(tau),
        t: Dual { value: frame.start + tau, derivative: [1.0] },
        p: &filled(constant(0.0), |i| constant(frame.p[i])),
        memory: &memory,
        branch: frame.branch,
    };
    let (flow, integrands) = M::integrated(frame.mode, &filled(constant(0.0), |i| constant(x[i])), &env);
    for c in 0..C {
        for i in 0..N {
            dx[c][i] += flow[i].derivative[0] * held.dstart[c];
        }
        for i in 0..Q {
            dq[c][i] += integrands[i].derivative[0] * held.dstart[c];
        }
    }
}
