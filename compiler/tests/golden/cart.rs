//! Compiled model `cart`.
//!
//! Each function is straight-line code; `v0`, `v1`, ... are its shared subexpressions. SI units throughout.
#![allow(non_snake_case, reason = "names of the spec appear as they are written there")]
#![allow(clippy::let_and_return, reason = "straight-line code names every value")]
#![allow(
    clippy::len_zero,
    clippy::match_single_binding,
    clippy::zero_repeat_side_effects,
    reason = "a size or a list of cases is printed in the same way where it is empty"
)]
#![allow(
    clippy::approx_constant,
    reason = "constants are printed exactly as CasADi computed them"
)]

use ::gaitc_runtime::{model, scalar};

/// Number of states.
pub const STATES: usize = 3;
/// Number of parameters.
pub const PARAMETERS: usize = 2;
/// Number of time integrals.
pub const INTEGRALS: usize = 0;

/// The compiled model `cart`: 3 states, 2 parameters, 0 time integrals.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cart;

/// Names, units and structure.
static INFO: model::ModelInfo = model::ModelInfo {
    name: "cart",
    fingerprint: "85009c615da9bf02875d77c04563b16b1f9d17e6e29ca675811c6bfac2f3a06a",
    parameters: &[
        model::Quantity {
            name: "m",
            si: "1",
        },
        model::Quantity {
            name: "l",
            si: "1",
        },
    ],
    states: &[
        model::Quantity {
            name: "v",
            si: "1",
        },
        model::Quantity {
            name: "w",
            si: "1",
        },
        model::Quantity {
            name: "phi",
            si: "1",
        },
    ],
    memory: &[],
    modes: &[
        model::ModeInfo {
            name: "run",
            switches: &[],
            measured_switches: &[],
        },
    ],
    transitions: &[],
    switches: &[],
    coordinates: &[],
    section_after: ::core::option::Option::None,
    symmetric: false,
    functionals: &[],
    measures: &[],
    uses_time: false,
    explicit: false,
};

impl model::Model<STATES, PARAMETERS, INTEGRALS> for Cart {
    const INFO: &'static model::ModelInfo = &INFO;
    #[inline]
    fn flow<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; STATES] {
        let _ = (mode, x, env);
        nan_state()
    }
    fn flow_jacobian<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        let _ = (mode, x, env);
        nan_jacobian()
    }
    #[inline]
    fn variational<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        dx: &[[S; STATES]; C],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; STATES], [[S; STATES]; C]) {
        let _ = (mode, x, dx, env);
        (nan_state(), [nan_state(); C])
    }
    #[inline]
    fn integrated<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; STATES], [S; INTEGRALS]) {
        let _ = (mode, x, env);
        (nan_state(), [nan(); INTEGRALS])
    }
    #[inline]
    fn integrated_variational<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        dx: &[[S; STATES]; C],
        dp: &[[S; PARAMETERS]; C],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Integrated<S, STATES, INTEGRALS, C> {
        let _ = (mode, x, dx, dp, env);
        model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    }
    fn residual<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; STATES] {
        match mode {
            0 => residual_run(x, k, env),
            _ => nan_state(),
        }
    }
    fn residual_jacobian<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
        match mode {
            0 => d_residual_run(x, k, env),
            _ => nan_residual_jacobian(),
        }
    }
    fn residual_linearised<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Linearised<S, STATES> {
        match mode {
            0 => linearised_run(x, k, env),
            _ => nan_linearised(),
        }
    }
    fn integrands<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; INTEGRALS] {
        let _ = (mode, x, k, env);
        [nan(); INTEGRALS]
    }
    #[inline]
    fn integrands_along<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
        let _ = (mode, x, k, along, env);
        ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    }
    fn switch<S: scalar::Scalar>(
        index: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        let _ = (index, x, env);
        nan()
    }
    fn switch_gradient<S: scalar::Scalar>(
        index: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        let _ = (index, x, env);
        nan_gradient()
    }
    fn guard<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        let _ = (transition, x, env);
        nan()
    }
    fn guard_gradient<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        let _ = (transition, x, env);
        nan_gradient()
    }
    fn when<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        let _ = (x, env);
        match transition {
            _ => nan(),
        }
    }
    fn reset<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
        memory: &mut [S],
    ) -> [S; STATES] {
        let _ = (transition, x, env);
        if memory.len() != 0 {
            memory.fill(nan());
            return nan_state();
        }
        let (state, after): ([S; STATES], [S; 0]) = (nan_state(), [nan(); 0]);
        for (slot, value) in memory.iter_mut().zip(after) {
            *slot = value;
        }
        state
    }
    fn reset_jacobian<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        let _ = (transition, x, env);
        nan_jacobian()
    }
    fn embed<S: scalar::Scalar>(z: &[S], p: &[S; PARAMETERS]) -> [S; STATES] {
        let _ = (z, p);
        nan_state()
    }
    fn embed_jacobian<S: scalar::Scalar>(
        z: &[S],
        p: &[S; PARAMETERS],
        dz: &mut [[S; STATES]],
    ) -> [[S; STATES]; PARAMETERS] {
        let _ = (z, p);
        if dz.len() != 0 {
            dz.fill(nan_state());
            return [nan_state(); PARAMETERS];
        }
        let (columns, dp): ([[S; STATES]; 0], [[S; STATES]; PARAMETERS]) = (
            [nan_state(); 0],
            [nan_state(); PARAMETERS],
        );
        for (slot, column) in dz.iter_mut().zip(columns) {
            *slot = column;
        }
        dp
    }
    fn symmetry<S: scalar::Scalar>(x: &[S; STATES], p: &[S; PARAMETERS]) -> [S; STATES] {
        let _ = p;
        *x
    }
    fn symmetry_jacobian<S: scalar::Scalar>(
        x: &[S; STATES],
        p: &[S; PARAMETERS],
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        let _ = p;
        let one = S::constant(1.0);
        let zero = S::constant(0.0);
        model::Jacobian {
            value: *x,
            dx: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
            dp: [[zero; STATES]; PARAMETERS],
            dtau: [zero; STATES],
            dt: [zero; STATES],
        }
    }
    fn observable<S: scalar::Scalar>(
        index: usize,
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        let _ = (index, mode, x, k, env);
        nan()
    }
    fn observable_gradient<S: scalar::Scalar>(
        index: usize,
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::RateGradient<S, STATES, PARAMETERS> {
        let _ = (index, mode, x, k, env);
        nan_rate_gradient()
    }
    fn measures<S: scalar::Scalar>(
        functionals: &[S],
        p: &[S; PARAMETERS],
        out: &mut [S],
    ) {
        if out.len() != 0 {
            return out.fill(nan());
        }
        for (slot, value) in out.iter_mut().zip(measures(functionals, p)) {
            *slot = value;
        }
    }
    fn measures_jacobian<S: scalar::Scalar>(
        functionals: &[S],
        p: &[S; PARAMETERS],
        dfunctionals: &mut [S],
        dp: &mut [[S; PARAMETERS]],
    ) {
        if dfunctionals.len() != 0 || dp.len() != 0 {
            dfunctionals.fill(nan());
            return dp.fill([nan(); PARAMETERS]);
        }
        let (rows, columns) = d_measures(functionals, p);
        for (slot, value) in dfunctionals.iter_mut().zip(rows) {
            *slot = value;
        }
        for (slot, value) in dp.iter_mut().zip(columns) {
            *slot = value;
        }
    }
}

/// Residual F = M k - f of mode `run`, k the rates of the states.
///
/// 5 additions, 8 multiplications, 2 function calls.
fn residual_run<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[] = env.memory else { return nan_state() };
    let &[] = env.branch else { return nan_state() };
    let &[p_m, p_l] = env.p;
    let &[_, x_w, x_phi] = x;
    let &[k_v, k_w, k_phi] = k;
    let v0 = p_m * k_v;
    let v1 = x_phi.cos();
    let v2 = p_l * v1;
    let v3 = v2 * k_w;
    let v4 = v0 + v3;
    let v5 = x_phi.sin();
    let v6 = x_w * x_w;
    let v7 = v5 * v6;
    let v8 = v7 * p_l;
    let v9 = v4 - v8;
    let v10 = v1 * k_v;
    let v11 = p_l * k_w;
    let v12 = v10 + v11;
    let v13 = v12 + v1;
    let v14 = k_phi - x_w;
    [v9, v13, v14]
}

/// Measures from the values of the functionals.
/// Measures: none.
///
/// No operations.
fn measures<S: scalar::Scalar>(functionals: &[S], _p: &[S; PARAMETERS]) -> [S; 0] {
    let &[] = functionals else { return [nan(); 0] };
    []
}

/// Residual F = M k - f of mode `run` with all first derivatives, by columns.
///
/// 12 additions, 16 multiplications, 2 function calls.
fn d_residual_run<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_residual_jacobian() };
    let &[] = env.branch else { return nan_residual_jacobian() };
    let &[p_m, p_l] = env.p;
    let &[_, x_w, x_phi] = x;
    let &[k_v, k_w, k_phi] = k;
    let v0 = p_m * k_v;
    let v1 = x_phi.cos();
    let v2 = p_l * v1;
    let v3 = v2 * k_w;
    let v4 = v0 + v3;
    let v5 = x_phi.sin();
    let v6 = x_w * x_w;
    let v7 = v5 * v6;
    let v8 = v7 * p_l;
    let v9 = v4 - v8;
    let v10 = v1 * k_v;
    let v11 = p_l * k_w;
    let v12 = v10 + v11;
    let v13 = v12 + v1;
    let v14 = k_phi - x_w;
    let v15 = x_w + x_w;
    let v16 = v5 * v15;
    let v17 = p_l * v16;
    let v18 = -v17;
    let v19 = p_l * v5;
    let v20 = k_w * v19;
    let v21 = v6 * v1;
    let v22 = p_l * v21;
    let v23 = v20 + v22;
    let v24 = -v23;
    let v25 = k_v * v5;
    let v26 = v25 + v5;
    let v27 = -v26;
    let v28 = k_w * v1;
    let v29 = v28 - v7;
    model::ResidualJacobian {
        value: [v9, v13, v14],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [v18, S::constant(0.0), S::constant(-1.0)],
            [v24, v27, S::constant(0.0)],
        ],
        dk: [
            [p_m, v1, S::constant(0.0)],
            [v2, p_l, S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [[k_v, S::constant(0.0), S::constant(0.0)], [v29, k_w, S::constant(0.0)]],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `run` with its derivatives by state and rate, by columns.
///
/// 11 additions, 15 multiplications, 2 function calls.
fn linearised_run<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[] = env.memory else { return nan_linearised() };
    let &[] = env.branch else { return nan_linearised() };
    let &[p_m, p_l] = env.p;
    let &[_, x_w, x_phi] = x;
    let &[k_v, k_w, k_phi] = k;
    let v0 = p_m * k_v;
    let v1 = x_phi.cos();
    let v2 = p_l * v1;
    let v3 = v2 * k_w;
    let v4 = v0 + v3;
    let v5 = x_phi.sin();
    let v6 = x_w * x_w;
    let v7 = v5 * v6;
    let v8 = v7 * p_l;
    let v9 = v4 - v8;
    let v10 = v1 * k_v;
    let v11 = p_l * k_w;
    let v12 = v10 + v11;
    let v13 = v12 + v1;
    let v14 = k_phi - x_w;
    let v15 = x_w + x_w;
    let v16 = v5 * v15;
    let v17 = p_l * v16;
    let v18 = -v17;
    let v19 = p_l * v5;
    let v20 = k_w * v19;
    let v21 = v6 * v1;
    let v22 = p_l * v21;
    let v23 = v20 + v22;
    let v24 = -v23;
    let v25 = k_v * v5;
    let v26 = v25 + v5;
    let v27 = -v26;
    model::Linearised {
        value: [v9, v13, v14],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [v18, S::constant(0.0), S::constant(-1.0)],
            [v24, v27, S::constant(0.0)],
        ],
        dk: [
            [p_m, v1, S::constant(0.0)],
            [v2, p_l, S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
    }
}

/// Derivatives of the 0 measures: by the 0 functionals, one row a measure, and by the parameters.
///
/// No operations.
fn d_measures<S: scalar::Scalar>(
    functionals: &[S],
    _p: &[S; PARAMETERS],
) -> ([S; 0], [[S; PARAMETERS]; 0]) {
    let &[] = functionals else { return ([nan(); 0], [[nan(); PARAMETERS]; 0]) };
    ([], [])
}

/// NaN.
fn nan<S: scalar::Scalar>() -> S {
    S::constant(f64::NAN)
}

/// A state of NaN.
fn nan_state<S: scalar::Scalar>() -> [S; STATES] {
    [nan(); STATES]
}

/// A gradient of NaN.
fn nan_gradient<S: scalar::Scalar>() -> model::Gradient<S, STATES, PARAMETERS> {
    model::Gradient {
        value: nan(),
        dx: [nan(); STATES],
        dp: [nan(); PARAMETERS],
        dtau: nan(),
        dt: nan(),
    }
}

/// A gradient by state and rate of NaN.
fn nan_rate_gradient<S: scalar::Scalar>() -> model::RateGradient<S, STATES, PARAMETERS> {
    model::RateGradient {
        value: nan(),
        dx: [nan(); STATES],
        dk: [nan(); STATES],
        dp: [nan(); PARAMETERS],
        dtau: nan(),
        dt: nan(),
    }
}

/// A Jacobian of NaN.
fn nan_jacobian<S: scalar::Scalar>() -> model::Jacobian<S, STATES, PARAMETERS> {
    model::Jacobian {
        value: nan_state(),
        dx: [nan_state(); STATES],
        dp: [nan_state(); PARAMETERS],
        dtau: nan_state(),
        dt: nan_state(),
    }
}

/// A linearised residual of NaN.
fn nan_linearised<S: scalar::Scalar>() -> model::Linearised<S, STATES> {
    model::Linearised {
        value: nan_state(),
        dx: [nan_state(); STATES],
        dk: [nan_state(); STATES],
    }
}

/// A residual Jacobian of NaN.
fn nan_residual_jacobian<S: scalar::Scalar>() -> model::ResidualJacobian<
    S,
    STATES,
    PARAMETERS,
> {
    model::ResidualJacobian {
        value: nan_state(),
        dx: [nan_state(); STATES],
        dk: [nan_state(); STATES],
        dp: [nan_state(); PARAMETERS],
        dtau: nan_state(),
        dt: nan_state(),
    }
}
