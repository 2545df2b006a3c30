//! The ABI from plain equations, with derivatives by dual numbers.

use core::marker::PhantomData;
use gaitc_runtime::model::{
    Directions, Env, Gradient, Integrated, Jacobian, Linearised, Model, ModelInfo, RateGradient, ResidualJacobian,
};
use gaitc_runtime::scalar::{Real, Scalar};
use gaitc_runtime::sensitivity::Dual;

/// A constant.
pub fn c<S: Scalar>(value: f64) -> S {
    S::constant(value)
}

/// The equations of a model, without derivatives.
pub trait Equations<const N: usize, const P: usize, const Q: usize>: Copy + Default + Send + Sync + 'static {
    const INFO: &'static ModelInfo;
    fn flow<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> [S; N];
    fn guard<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> S;
    fn reset<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>, memory: &mut [S]) -> [S; N];
    fn embed<S: Scalar>(z: &[S], p: &[S; P]) -> [S; N];
    fn integrands<S: Scalar>(_mode: usize, _x: &[S; N], _env: &Env<'_, S, P>) -> [S; Q] {
        [c(0.0); Q]
    }
    /// F = M k - f; by default M is the identity.
    fn residual<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> [S; N] {
        let f = Self::flow(mode, x, env);
        core::array::from_fn(|i| k[i] - f[i])
    }
    /// Integrands that depend on rates.
    fn integrands_with_rate<S: Scalar>(mode: usize, x: &[S; N], _k: &[S; N], env: &Env<'_, S, P>) -> [S; Q] {
        Self::integrands(mode, x, env)
    }
    /// Observables that depend on rates.
    fn observable_with_rate<S: Scalar>(i: usize, mode: usize, x: &[S; N], _k: &[S; N], env: &Env<'_, S, P>) -> S {
        Self::observable(i, mode, x, env)
    }
    fn switch<S: Scalar>(_index: usize, _x: &[S; N], _env: &Env<'_, S, P>) -> S {
        c(f64::NAN)
    }
    fn when<S: Scalar>(_transition: usize, _x: &[S; N], _env: &Env<'_, S, P>) -> S {
        c(1.0)
    }
    fn symmetry<S: Scalar>(x: &[S; N], _p: &[S; P]) -> [S; N] {
        *x
    }
    fn observable<S: Scalar>(_index: usize, _mode: usize, _x: &[S; N], _env: &Env<'_, S, P>) -> S {
        c(f64::NAN)
    }
    /// By default every functional is a measure.
    fn measures<S: Scalar>(functionals: &[S], _p: &[S; P], out: &mut [S]) {
        out.copy_from_slice(&functionals[..out.len()]);
    }
    fn variational<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        env: &Env<'_, S, P>,
    ) -> ([S; N], [[S; N]; C]) {
        let zero = [c(0.0); P];
        let columns = core::array::from_fn(|k| {
            along(x, &dx[k], env, &zero, c(0.0), c(0.0), |x, env| Self::flow(mode, x, env)).map(|d| d.derivative[0])
        });
        (Self::flow(mode, x, env), columns)
    }
}

/// The full ABI for some equations.
#[derive(Clone, Copy, Debug, Default)]
pub struct Auto<E>(PhantomData<E>);

fn lift<S: Scalar, const L: usize>(value: &[S; L], derivative: &[S; L]) -> [Dual<S>; L] {
    core::array::from_fn(|i| Dual { value: value[i], derivative: [derivative[i]] })
}

/// Evaluates with dual numbers along one direction.
fn along<S: Scalar, R, const N: usize, const P: usize>(
    x: &[S; N],
    dx: &[S; N],
    env: &Env<'_, S, P>,
    dp: &[S; P],
    dtau: S,
    dt: S,
    f: impl Fn(&[Dual<S>; N], &Env<'_, Dual<S>, P>) -> R,
) -> R {
    let memory: Vec<Dual<S>> = env.memory.iter().map(|m| Dual { value: *m, derivative: [c(0.0)] }).collect();
    let p = lift(env.p, dp);
    let (tau, t) = (Dual { value: env.tau, derivative: [dtau] }, Dual { value: env.t, derivative: [dt] });
    f(&lift(x, dx), &Env { tau, t, p: &p, memory: &memory, branch: env.branch })
}

fn unit<S: Scalar, const L: usize>(i: usize) -> [S; L] {
    core::array::from_fn(|k| c(if k == i { 1.0 } else { 0.0 }))
}

fn gradient<S: Scalar, const N: usize, const P: usize>(
    x: &[S; N],
    env: &Env<'_, S, P>,
    f: impl Fn(&[Dual<S>; N], &Env<'_, Dual<S>, P>) -> Dual<S>,
) -> Gradient<S, N, P> {
    let (zx, zp, zero, one) = ([c(0.0); N], [c(0.0); P], c(0.0), c(1.0));
    Gradient {
        value: along(x, &zx, env, &zp, zero, zero, &f).value,
        dx: core::array::from_fn(|i| along(x, &unit(i), env, &zp, zero, zero, &f).derivative[0]),
        dp: core::array::from_fn(|i| along(x, &zx, env, &unit(i), zero, zero, &f).derivative[0]),
        dtau: along(x, &zx, env, &zp, one, zero, &f).derivative[0],
        dt: along(x, &zx, env, &zp, zero, one, &f).derivative[0],
    }
}

fn jacobian<S: Scalar, const N: usize, const P: usize>(
    x: &[S; N],
    env: &Env<'_, S, P>,
    f: impl Fn(&[Dual<S>; N], &Env<'_, Dual<S>, P>) -> [Dual<S>; N],
) -> Jacobian<S, N, P> {
    let (zx, zp, zero, one) = ([c(0.0); N], [c(0.0); P], c(0.0), c(1.0));
    let d = |v: [Dual<S>; N]| v.map(|d| d.derivative[0]);
    Jacobian {
        value: along(x, &zx, env, &zp, zero, zero, &f).map(|d| d.value),
        dx: core::array::from_fn(|i| d(along(x, &unit(i), env, &zp, zero, zero, &f))),
        dp: core::array::from_fn(|i| d(along(x, &zx, env, &unit(i), zero, zero, &f))),
        dtau: d(along(x, &zx, env, &zp, one, zero, &f)),
        dt: d(along(x, &zx, env, &zp, zero, one, &f)),
    }
}

/// An environment for functions of state and parameters only.
fn bare<S: Scalar, const P: usize>(p: &[S; P]) -> Env<'_, S, P> {
    Env { tau: c(0.0), t: c(0.0), p, memory: &[], branch: &[] }
}

impl<E: Equations<N, P, Q>, const N: usize, const P: usize, const Q: usize> Model<N, P, Q> for Auto<E> {
    const INFO: &'static ModelInfo = E::INFO;

    fn flow<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> [S; N] {
        E::flow(mode, x, env)
    }
    fn flow_jacobian<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> Jacobian<S, N, P> {
        jacobian(x, env, |x, env| E::flow(mode, x, env))
    }
    fn variational<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        env: &Env<'_, S, P>,
    ) -> ([S; N], [[S; N]; C]) {
        E::variational(mode, x, dx, env)
    }
    type Clock<S: Scalar> = ();
    fn clock<S: Scalar>(_: usize, _: &Env<'_, S, P>) {}
    fn clock_lane<S: Real>((): &(), _: usize) {}
    fn variational_at<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        (): &(),
        env: &Env<'_, S, P>,
    ) -> ([S; N], [[S; N]; C]) {
        E::variational(mode, x, dx, env)
    }
    fn integrated<S: Scalar>(mode: usize, x: &[S; N], env: &Env<'_, S, P>) -> ([S; N], [S; Q]) {
        (E::flow(mode, x, env), E::integrands(mode, x, env))
    }
    fn integrated_variational<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        dx: &[[S; N]; C],
        dp: &[[S; P]; C],
        env: &Env<'_, S, P>,
    ) -> Integrated<S, N, Q, C> {
        let (flow, integrands) = Self::integrated(mode, x, env);
        let (mut dflow, mut dintegrands) = ([[c(0.0); N]; C], [[c(0.0); Q]; C]);
        for k in 0..C {
            let (f, i) = along(x, &dx[k], env, &dp[k], c(0.0), c(0.0), |x, env| {
                (E::flow(mode, x, env), E::integrands(mode, x, env))
            });
            dflow[k] = f.map(|d| d.derivative[0]);
            dintegrands[k] = i.map(|d| d.derivative[0]);
        }
        Integrated { flow, integrands, dflow, dintegrands }
    }
    fn residual<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> [S; N] {
        E::residual(mode, x, k, env)
    }
    fn residual_jacobian<S: Scalar>(
        mode: usize,
        x: &[S; N],
        k: &[S; N],
        env: &Env<'_, S, P>,
    ) -> ResidualJacobian<S, N, P> {
        let (still, held) = (lift(k, &[c(0.0); N]), [c(0.0); N]);
        let j = jacobian(x, env, |x, env| E::residual(mode, x, &still, env));
        let dk = core::array::from_fn(|i| {
            let moved = lift(k, &unit(i));
            along(x, &held, env, &[c(0.0); P], c(0.0), c(0.0), |x, env| E::residual(mode, x, &moved, env))
                .map(|d| d.derivative[0])
        });
        ResidualJacobian { value: j.value, dx: j.dx, dk, dp: j.dp, dtau: j.dtau, dt: j.dt }
    }
    fn residual_linearised<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> Linearised<S, N> {
        let ResidualJacobian { value, dx, dk, .. } = Self::residual_jacobian(mode, x, k, env);
        Linearised { value, dx, dk }
    }
    fn integrands<S: Scalar>(mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> [S; Q] {
        E::integrands_with_rate(mode, x, k, env)
    }
    fn integrands_along<S: Scalar, const C: usize>(
        mode: usize,
        x: &[S; N],
        k: &[S; N],
        d: &Directions<'_, S, N, P, C>,
        env: &Env<'_, S, P>,
    ) -> ([S; Q], [[S; Q]; C]) {
        let one = |i: usize| {
            let k = lift(k, &d.dk[i]);
            along(x, &d.dx[i], env, &d.dp[i], c(0.0), d.dt[i], |x, env| E::integrands_with_rate(mode, x, &k, env))
                .map(|d| d.derivative[0])
        };
        (E::integrands_with_rate(mode, x, k, env), core::array::from_fn(one))
    }
    fn switch<S: Scalar>(index: usize, x: &[S; N], env: &Env<'_, S, P>) -> S {
        E::switch(index, x, env)
    }
    fn switch_gradient<S: Scalar>(index: usize, x: &[S; N], env: &Env<'_, S, P>) -> Gradient<S, N, P> {
        gradient(x, env, |x, env| E::switch(index, x, env))
    }
    fn guard<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> S {
        E::guard(transition, x, env)
    }
    fn guard_gradient<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> Gradient<S, N, P> {
        gradient(x, env, |x, env| E::guard(transition, x, env))
    }
    fn when<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> S {
        E::when(transition, x, env)
    }
    fn reset<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>, memory: &mut [S]) -> [S; N] {
        E::reset(transition, x, env, memory)
    }
    fn reset_jacobian<S: Scalar>(transition: usize, x: &[S; N], env: &Env<'_, S, P>) -> Jacobian<S, N, P> {
        jacobian(x, env, |x, env| E::reset(transition, x, env, &mut env.memory.to_vec()))
    }
    fn embed<S: Scalar>(z: &[S], p: &[S; P]) -> [S; N] {
        E::embed(z, p)
    }
    fn embed_jacobian<S: Scalar>(z: &[S], p: &[S; P], dz: &mut [[S; N]]) -> [[S; N]; P] {
        let zero = [c(0.0); P];
        let at = |j: usize, dp: &[S; P]| {
            let z: Vec<Dual<S>> = z
                .iter()
                .enumerate()
                .map(|(k, v)| Dual { value: *v, derivative: [c(if k == j { 1.0 } else { 0.0 })] })
                .collect();
            E::embed(&z, &lift(p, dp)).map(|d| d.derivative[0])
        };
        for (j, column) in dz.iter_mut().enumerate() {
            *column = at(j, &zero);
        }
        core::array::from_fn(|j| at(usize::MAX, &unit(j)))
    }
    fn symmetry<S: Scalar>(x: &[S; N], p: &[S; P]) -> [S; N] {
        E::symmetry(x, p)
    }
    fn symmetry_jacobian<S: Scalar>(x: &[S; N], p: &[S; P]) -> Jacobian<S, N, P> {
        jacobian(x, &bare(p), |x, env| E::symmetry(x, env.p))
    }
    fn observable<S: Scalar>(index: usize, mode: usize, x: &[S; N], k: &[S; N], env: &Env<'_, S, P>) -> S {
        E::observable_with_rate(index, mode, x, k, env)
    }
    fn observable_gradient<S: Scalar>(
        index: usize,
        mode: usize,
        x: &[S; N],
        k: &[S; N],
        env: &Env<'_, S, P>,
    ) -> RateGradient<S, N, P> {
        let still = lift(k, &[c(0.0); N]);
        let Gradient { value, dx, dp, dtau, dt } =
            gradient(x, env, |x, env| E::observable_with_rate(index, mode, x, &still, env));
        let dk = core::array::from_fn(|i| {
            let k = lift(k, &unit(i));
            let f = |x: &[Dual<S>; N], env: &Env<'_, Dual<S>, P>| E::observable_with_rate(index, mode, x, &k, env);
            along(x, &[c(0.0); N], env, &[c(0.0); P], c(0.0), c(0.0), f).derivative[0]
        });
        RateGradient { value, dx, dk, dp, dtau, dt }
    }
    fn measures<S: Scalar>(functionals: &[S], p: &[S; P], out: &mut [S]) {
        E::measures(functionals, p, out);
    }
    fn measures_jacobian<S: Scalar>(functionals: &[S], p: &[S; P], dfunctionals: &mut [S], dp: &mut [[S; P]]) {
        let (m, f) = (dp.len(), functionals.len());
        for j in 0..f + P {
            let values: Vec<Dual<S>> = functionals
                .iter()
                .enumerate()
                .map(|(k, v)| Dual { value: *v, derivative: [c(if k == j { 1.0 } else { 0.0 })] })
                .collect();
            let p: [Dual<S>; P] =
                core::array::from_fn(|k| Dual { value: p[k], derivative: [c(if k + f == j { 1.0 } else { 0.0 })] });
            let mut out = vec![c::<Dual<S>>(0.0); m];
            E::measures(&values, &p, &mut out);
            for i in 0..m {
                if j < f {
                    dfunctionals[i * f + j] = out[i].derivative[0];
                } else {
                    dp[i][j - f] = out[i].derivative[0];
                }
            }
        }
    }
}
