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
pub const PARAMETERS: usize = 3;
/// Number of time integrals.
pub const INTEGRALS: usize = 2;

/// The compiled model `cart`: 3 states, 3 parameters, 2 time integrals.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cart;

/// Names, units and structure.
static INFO: model::ModelInfo = model::ModelInfo {
    name: "cart",
    fingerprint: "a3ced0d1d61fab657eaee32073930c4dbb427008f2068dd8c7a89bba230ad820",
    parameters: &[
        model::Quantity {
            name: "m",
            si: "1",
        },
        model::Quantity {
            name: "l",
            si: "m",
        },
        model::Quantity {
            name: "g",
            si: "m/s^2",
        },
    ],
    states: &[
        model::Quantity {
            name: "v",
            si: "m/s",
        },
        model::Quantity {
            name: "w",
            si: "s^-1",
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
    transitions: &[
        model::TransitionInfo {
            name: "turn",
            from: 0,
            to: 0,
            direction: model::Direction::Rising,
            also_zero: &[
                model::AlsoZero {
                    text: "height",
                    si: "m",
                    start: 6,
                    end: 7,
                    rate: 8,
                },
                model::AlsoZero {
                    text: "1 + cos(phi)",
                    si: "1",
                    start: 9,
                    end: 10,
                    rate: 11,
                },
            ],
        },
    ],
    switches: &[],
    coordinates: &[0, 1],
    section: ::core::option::Option::Some(model::Section::After(0)),
    returning: &[2],
    symmetric: false,
    functionals: &[
        model::Functional::Maximum(0),
        model::Functional::Mean(0),
        model::Functional::Integral(1),
        model::Functional::End(1),
        model::Functional::Start(1),
        model::Functional::End(2),
        model::Functional::Start(3),
        model::Functional::End(3),
        model::Functional::End(4),
        model::Functional::Start(5),
        model::Functional::End(5),
        model::Functional::End(6),
    ],
    measures: &[
        model::Quantity {
            name: "push",
            si: "m/s^2",
        },
        model::Quantity {
            name: "lift",
            si: "m/s",
        },
        model::Quantity {
            name: "change",
            si: "m/s",
        },
        model::Quantity {
            name: "square",
            si: "s^-1",
        },
    ],
    uses_time: true,
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
    type Clock<S: scalar::Scalar> = [S; CLOCK_TERMS];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn clock<S: scalar::Scalar>(
        mode: usize,
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; CLOCK_TERMS] {
        let _ = (mode, env);
        [nan(); CLOCK_TERMS]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn clock_lane<S: scalar::Real>(
        clock: &[S; CLOCK_TERMS],
        lane: usize,
    ) -> [f64; CLOCK_TERMS] {
        clock.map(|term| term.lane(lane))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn variational_at<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        dx: &[[S; STATES]; C],
        clock: &[S; CLOCK_TERMS],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; STATES], [[S; STATES]; C]) {
        let _ = (mode, x, dx, clock, env);
        (nan_state(), [nan_state(); C])
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
        match mode {
            0 => integrands(x, k, env),
            _ => [nan(); INTEGRALS],
        }
    }
    #[inline]
    fn integrands_along<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
        match mode {
            0 => tangent_integrands(x, k, along, env),
            _ => ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]),
        }
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
        match transition {
            0 => guard_turn(x, env),
            _ => nan(),
        }
    }
    fn guard_gradient<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        match transition {
            0 => d_guard_turn(x, env),
            _ => nan_gradient(),
        }
    }
    fn when<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        let _ = (x, env);
        match transition {
            0 => S::constant(1.0),
            _ => nan(),
        }
    }
    fn reset<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
        memory: &mut [S],
    ) -> [S; STATES] {
        if memory.len() != 0 {
            memory.fill(nan());
            return nan_state();
        }
        let (state, after): ([S; STATES], [S; 0]) = match transition {
            0 => reset_turn(x, env),
            _ => (nan_state(), [nan(); 0]),
        };
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
        match transition {
            0 => d_reset_turn(x, env),
            _ => nan_jacobian(),
        }
    }
    fn embed<S: scalar::Scalar>(z: &[S], p: &[S; PARAMETERS]) -> [S; STATES] {
        embed(z, p)
    }
    fn embed_jacobian<S: scalar::Scalar>(
        z: &[S],
        p: &[S; PARAMETERS],
        dz: &mut [[S; STATES]],
    ) -> [[S; STATES]; PARAMETERS] {
        if dz.len() != 2 {
            dz.fill(nan_state());
            return [nan_state(); PARAMETERS];
        }
        let (columns, dp): ([[S; STATES]; 2], [[S; STATES]; PARAMETERS]) = d_embed(z, p);
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
        match (index, mode) {
            (0, 0) => observable_0(x, k, env),
            (1, 0) => observable_1(x, k, env),
            (2, 0) => observable_2(x, k, env),
            (3, 0) => observable_3(x, k, env),
            (4, 0) => observable_4(x, k, env),
            (5, 0) => observable_5(x, k, env),
            (6, 0) => observable_6(x, k, env),
            _ => nan(),
        }
    }
    fn observable_gradient<S: scalar::Scalar>(
        index: usize,
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::RateGradient<S, STATES, PARAMETERS> {
        match (index, mode) {
            (0, 0) => d_observable_0(x, k, env),
            (1, 0) => d_observable_1(x, k, env),
            (2, 0) => d_observable_2(x, k, env),
            (3, 0) => d_observable_3(x, k, env),
            (4, 0) => d_observable_4(x, k, env),
            (5, 0) => d_observable_5(x, k, env),
            (6, 0) => d_observable_6(x, k, env),
            _ => nan_rate_gradient(),
        }
    }
    fn measures<S: scalar::Scalar>(
        functionals: &[S],
        p: &[S; PARAMETERS],
        out: &mut [S],
    ) {
        if out.len() != 4 {
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
        if dfunctionals.len() != 48 || dp.len() != 4 {
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
/// 1 addition, 5 multiplications, 4 fused multiply-adds, 1 function call.
fn residual_run<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[] = env.memory else { return nan_state() };
    let &[] = env.branch else { return nan_state() };
    let &[p_m, p_l, p_g] = env.p;
    let &[_, x_w, x_phi] = x;
    let &[k_v, k_w, k_phi] = k;
    let v0 = p_m * k_v;
    let (v2, v1) = x_phi.sin_cos();
    let v3 = p_l * v1;
    let v4 = v3.mul_add(k_w, v0);
    let v5 = x_w * x_w;
    let v6 = p_l * v5;
    let v7 = (-v6).mul_add(v2, v4);
    let v8 = p_l * k_w;
    let v9 = v1.mul_add(k_v, v8);
    let v10 = p_g.mul_add(v1, v9);
    let v11 = k_phi - x_w;
    [v7, v10, v11]
}

/// Guard of transition `turn`.
///
/// 1 addition.
fn guard_turn<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[_, _, x_phi] = x;
    let v0 = x_phi - S::constant(3.141592653589793);
    v0
}

/// State and memory after transition `turn`, from those before.
/// State: v [m s^-1], w [s^-1], phi [1].
///
/// 1 addition.
fn reset_turn<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 0]) {
    let &[] = env.memory else { return (nan_state(), [nan(); 0]) };
    let &[] = env.branch else { return (nan_state(), [nan(); 0]) };
    let &[x_v, x_w, x_phi] = x;
    let v0 = x_phi - S::constant(6.283185307179586);
    ([x_v, x_w, v0], [])
}

/// Full state on the section from its coordinates.
///
/// No operations.
fn embed<S: scalar::Scalar>(z: &[S], _p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_v, x_w] = z else { return nan_state() };
    [x_v, x_w, S::constant(-3.141592653589793)]
}

/// Measures from the values of the functionals.
/// Measures: push [m s^-2], lift [m s^-1], change [m s^-1], square [s^-1].
///
/// 2 additions.
fn measures<S: scalar::Scalar>(functionals: &[S], _p: &[S; PARAMETERS]) -> [S; 4] {
    let &[f0, f1, f2, f3, f4, f5, _, _, _, _, _, _] = functionals else {
        return [nan(); 4]
    };
    let v0 = f2 - f3;
    let v1 = v0 + f4;
    [f0, f1, v1, f5]
}

/// Residual F = M k - f of mode `run` with all first derivatives, by columns.
///
/// 6 additions, 12 multiplications, 6 fused multiply-adds, 1 function call.
fn d_residual_run<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_residual_jacobian() };
    let &[] = env.branch else { return nan_residual_jacobian() };
    let &[p_m, p_l, p_g] = env.p;
    let &[_, x_w, x_phi] = x;
    let &[k_v, k_w, k_phi] = k;
    let v0 = p_m * k_v;
    let (v2, v1) = x_phi.sin_cos();
    let v3 = p_l * v1;
    let v4 = v3.mul_add(k_w, v0);
    let v5 = x_w * x_w;
    let v6 = p_l * v5;
    let v7 = (-v6).mul_add(v2, v4);
    let v8 = p_l * k_w;
    let v9 = v1.mul_add(k_v, v8);
    let v10 = p_g.mul_add(v1, v9);
    let v11 = k_phi - x_w;
    let v12 = x_w + x_w;
    let v13 = p_l * v12;
    let v14 = v2 * v13;
    let v15 = -v14;
    let v16 = p_l * v2;
    let v17 = v6 * v1;
    let v18 = k_w.mul_add(v16, v17);
    let v19 = -v18;
    let v20 = k_v * v2;
    let v21 = p_g.mul_add(v2, v20);
    let v22 = -v21;
    let v23 = k_w * v1;
    let v24 = v2 * v5;
    let v25 = v23 - v24;
    model::ResidualJacobian {
        value: [v7, v10, v11],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [v15, S::constant(0.0), S::constant(-1.0)],
            [v19, v22, S::constant(0.0)],
        ],
        dk: [
            [p_m, v1, S::constant(0.0)],
            [v3, p_l, S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [k_v, S::constant(0.0), S::constant(0.0)],
            [v25, k_w, S::constant(0.0)],
            [S::constant(0.0), v1, S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `run` with its derivatives by state and rate, by columns.
///
/// 5 additions, 10 multiplications, 6 fused multiply-adds, 1 function call.
fn linearised_run<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[] = env.memory else { return nan_linearised() };
    let &[] = env.branch else { return nan_linearised() };
    let &[p_m, p_l, p_g] = env.p;
    let &[_, x_w, x_phi] = x;
    let &[k_v, k_w, k_phi] = k;
    let v0 = p_m * k_v;
    let (v2, v1) = x_phi.sin_cos();
    let v3 = p_l * v1;
    let v4 = v3.mul_add(k_w, v0);
    let v5 = x_w * x_w;
    let v6 = p_l * v5;
    let v7 = (-v6).mul_add(v2, v4);
    let v8 = p_l * k_w;
    let v9 = v1.mul_add(k_v, v8);
    let v10 = p_g.mul_add(v1, v9);
    let v11 = k_phi - x_w;
    let v12 = x_w + x_w;
    let v13 = p_l * v12;
    let v14 = v2 * v13;
    let v15 = -v14;
    let v16 = p_l * v2;
    let v17 = v6 * v1;
    let v18 = k_w.mul_add(v16, v17);
    let v19 = -v18;
    let v20 = k_v * v2;
    let v21 = p_g.mul_add(v2, v20);
    let v22 = -v21;
    model::Linearised {
        value: [v7, v10, v11],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [v15, S::constant(0.0), S::constant(-1.0)],
            [v19, v22, S::constant(0.0)],
        ],
        dk: [
            [p_m, v1, S::constant(0.0)],
            [v3, p_l, S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
    }
}

/// Guard of transition `turn` with all first derivatives.
///
/// 1 addition.
fn d_guard_turn<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_gradient() };
    let &[] = env.branch else { return nan_gradient() };
    let &[_, _, x_phi] = x;
    let v0 = x_phi - S::constant(3.141592653589793);
    model::Gradient {
        value: v0,
        dx: [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State after transition `turn` with all first derivatives.
/// Components: v, w, phi; derivatives by columns.
///
/// 1 addition.
fn d_reset_turn<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_jacobian() };
    let &[] = env.branch else { return nan_jacobian() };
    let &[x_v, x_w, x_phi] = x;
    let v0 = x_phi - S::constant(6.283185307179586);
    model::Jacobian {
        value: [x_v, x_w, v0],
        dx: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Derivatives of the embedding by section coordinates and parameters, by columns.
///
/// No operations.
fn d_embed<S: scalar::Scalar>(
    z: &[S],
    _p: &[S; PARAMETERS],
) -> ([[S; STATES]; 2], [[S; STATES]; PARAMETERS]) {
    let &[_, _] = z else { return ([nan_state(); 2], [nan_state(); PARAMETERS]) };
    (
        [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        ],
        [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// Derivatives of the 4 measures: by the 12 functionals, one row a measure, and by the parameters.
///
/// No operations.
fn d_measures<S: scalar::Scalar>(
    functionals: &[S],
    _p: &[S; PARAMETERS],
) -> ([S; 48], [[S; PARAMETERS]; 4]) {
    let &[_, _, _, _, _, _, _, _, _, _, _, _] = functionals else {
        return ([nan(); 48], [[nan(); PARAMETERS]; 4])
    };
    (
        [
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(1.0),
            S::constant(-1.0),
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
        ],
        [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// The integrands.
///
/// 1 addition, 4 multiplications, 1 fused multiply-add, 2 function calls.
fn integrands<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; INTEGRALS] {
    let &[] = env.memory else { return [nan(); INTEGRALS] };
    let &[] = env.branch else { return [nan(); INTEGRALS] };
    let &[_, p_l, _] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_v, _, x_phi] = x;
    let &[k_v, _, k_phi] = k;
    let v0 = tau * k_v;
    let v1 = x_phi.cos();
    let v2 = p_l * v1;
    let v3 = v2.mul_add(k_phi, v0);
    let v4 = v3 + x_v;
    let v5 = S::constant(3.0) * t;
    let v6 = v5.cos();
    let v7 = v4 * v6;
    [v7, k_v]
}

/// Observable 0.
///
/// 1 multiplication.
fn observable_0<S: scalar::Scalar>(
    _x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[p_m, _, _] = env.p;
    let &[k_v, _, _] = k;
    let v0 = p_m * k_v;
    v0
}

/// Observable 0 with all first derivatives.
///
/// 1 multiplication.
fn d_observable_0<S: scalar::Scalar>(
    _x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[p_m, _, _] = env.p;
    let &[k_v, _, _] = k;
    let v0 = p_m * k_v;
    model::RateGradient {
        value: v0,
        dx: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dk: [p_m, S::constant(0.0), S::constant(0.0)],
        dp: [k_v, S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 1.
///
/// No operations.
fn observable_1<S: scalar::Scalar>(
    x: &[S; STATES],
    _k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[x_v, _, _] = x;
    x_v
}

/// Observable 1 with all first derivatives.
///
/// No operations.
fn d_observable_1<S: scalar::Scalar>(
    x: &[S; STATES],
    _k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[x_v, _, _] = x;
    model::RateGradient {
        value: x_v,
        dx: [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 2.
///
/// 2 multiplications, 1 fused multiply-add, 1 division, 1 function call.
fn observable_2<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[_, p_l, _] = env.p;
    let tau = env.tau;
    let &[_, _, x_phi] = x;
    let &[_, k_w, k_phi] = k;
    let v0 = x_phi.sin();
    let v1 = p_l * v0;
    let v2 = k_phi * v1;
    let v3 = v2 / p_l;
    let v4 = k_w.mul_add(tau, -v3);
    v4
}

/// Observable 2 with all first derivatives.
///
/// 4 additions, 5 multiplications, 1 fused multiply-add, 4 divisions, 1 function call.
fn d_observable_2<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[_, p_l, _] = env.p;
    let tau = env.tau;
    let &[_, _, x_phi] = x;
    let &[_, k_w, k_phi] = k;
    let (v0, v1) = x_phi.sin_cos();
    let v2 = p_l * v0;
    let v3 = k_phi * v2;
    let v4 = v3 / p_l;
    let v5 = k_w.mul_add(tau, -v4);
    let v6 = p_l * v1;
    let v7 = k_phi * v6;
    let v8 = v7 / p_l;
    let v9 = -v8;
    let v10 = -v0;
    let v11 = k_phi * v0;
    let v12 = v11 / p_l;
    let v13 = v4 / p_l;
    let v14 = v12 - v13;
    let v15 = -v14;
    model::RateGradient {
        value: v5,
        dx: [S::constant(0.0), S::constant(0.0), v9],
        dk: [S::constant(0.0), tau, v10],
        dp: [S::constant(0.0), v15, S::constant(0.0)],
        dtau: k_w,
        dt: S::constant(0.0),
    }
}

/// Observable 3.
///
/// 1 multiplication, 1 function call.
fn observable_3<S: scalar::Scalar>(
    x: &[S; STATES],
    _k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[_, p_l, _] = env.p;
    let &[_, _, x_phi] = x;
    let v0 = x_phi.sin();
    let v1 = p_l * v0;
    v1
}

/// Observable 3 with all first derivatives.
///
/// 2 multiplications, 1 function call.
fn d_observable_3<S: scalar::Scalar>(
    x: &[S; STATES],
    _k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[_, p_l, _] = env.p;
    let &[_, _, x_phi] = x;
    let (v0, v1) = x_phi.sin_cos();
    let v2 = p_l * v0;
    let v3 = p_l * v1;
    model::RateGradient {
        value: v2,
        dx: [S::constant(0.0), S::constant(0.0), v3],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), v0, S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 4.
///
/// 2 multiplications, 1 function call.
fn observable_4<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[_, p_l, _] = env.p;
    let &[_, _, x_phi] = x;
    let &[_, _, k_phi] = k;
    let v0 = x_phi.cos();
    let v1 = p_l * v0;
    let v2 = v1 * k_phi;
    v2
}

/// Observable 4 with all first derivatives.
///
/// 1 addition, 5 multiplications, 1 function call.
fn d_observable_4<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[_, p_l, _] = env.p;
    let &[_, _, x_phi] = x;
    let &[_, _, k_phi] = k;
    let (v1, v0) = x_phi.sin_cos();
    let v2 = p_l * v0;
    let v3 = v2 * k_phi;
    let v4 = p_l * v1;
    let v5 = k_phi * v4;
    let v6 = -v5;
    let v7 = k_phi * v0;
    model::RateGradient {
        value: v3,
        dx: [S::constant(0.0), S::constant(0.0), v6],
        dk: [S::constant(0.0), S::constant(0.0), v2],
        dp: [S::constant(0.0), v7, S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 5.
///
/// 1 addition, 1 function call.
fn observable_5<S: scalar::Scalar>(
    x: &[S; STATES],
    _k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[_, _, x_phi] = x;
    let v0 = x_phi.cos();
    let v1 = S::constant(1.0) + v0;
    v1
}

/// Observable 5 with all first derivatives.
///
/// 2 additions, 1 function call.
fn d_observable_5<S: scalar::Scalar>(
    x: &[S; STATES],
    _k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[_, _, x_phi] = x;
    let (v1, v0) = x_phi.sin_cos();
    let v2 = S::constant(1.0) + v0;
    let v3 = -v1;
    model::RateGradient {
        value: v2,
        dx: [S::constant(0.0), S::constant(0.0), v3],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 6.
///
/// 1 addition, 1 multiplication, 1 function call.
fn observable_6<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[] = env.memory else { return nan() };
    let &[] = env.branch else { return nan() };
    let &[_, _, x_phi] = x;
    let &[_, _, k_phi] = k;
    let v0 = x_phi.sin();
    let v1 = v0 * k_phi;
    let v2 = -v1;
    v2
}

/// Observable 6 with all first derivatives.
///
/// 3 additions, 2 multiplications, 1 function call.
fn d_observable_6<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[] = env.memory else { return nan_rate_gradient() };
    let &[] = env.branch else { return nan_rate_gradient() };
    let &[_, _, x_phi] = x;
    let &[_, _, k_phi] = k;
    let (v0, v1) = x_phi.sin_cos();
    let v2 = v0 * k_phi;
    let v3 = -v2;
    let v4 = k_phi * v1;
    let v5 = -v4;
    let v6 = -v0;
    model::RateGradient {
        value: v3,
        dx: [S::constant(0.0), S::constant(0.0), v5],
        dk: [S::constant(0.0), S::constant(0.0), v6],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// The integrands and their derivatives along each direction.
///
/// Once: 3 additions, 13 multiplications, 1 fused multiply-add, 2 function calls. A column: 1 multiplication, 5 fused multiply-adds.
#[inline]
fn tangent_integrands<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    k: &[S; STATES],
    along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
    let &[] = env.memory else { return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]) };
    let &[] = env.branch else { return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]) };
    let &[_, p_l, _] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_v, _, x_phi] = x;
    let &[k_v, _, k_phi] = k;
    let v0 = tau * k_v;
    let (v2, v1) = x_phi.sin_cos();
    let v3 = p_l * v1;
    let v4 = v3.mul_add(k_phi, v0);
    let v5 = v4 + x_v;
    let v6 = S::constant(3.0) * t;
    let (v8, v7) = v6.sin_cos();
    let v9 = v5 * v7;
    let v10 = p_l * v2;
    let v11 = k_phi * v10;
    let v12 = v7 * v11;
    let v13 = -v12;
    let v14 = v7 * tau;
    let v15 = v7 * v3;
    let v16 = k_phi * v1;
    let v17 = v7 * v16;
    let v18 = S::constant(3.0) * v8;
    let v19 = v5 * v18;
    let v20 = -v19;
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (product, (((&[dx_v, _, dx_phi], &[dk_v, _, dk_phi]), &[_, dp_l, _]), &dt)) in products
        .iter_mut()
        .zip(directions)
    {
        *product = [
            v20
                .mul_add(
                    dt,
                    v17
                        .mul_add(
                            dp_l,
                            v15
                                .mul_add(
                                    dk_phi,
                                    v14.mul_add(dk_v, v13.mul_add(dx_phi, v7 * dx_v)),
                                ),
                        ),
                ),
            dk_v,
        ];
    }
    ([v9, k_v], products)
}

/// Number of terms that depend only on the clock, on parameters, memory and selectors: the most of any mode.
const CLOCK_TERMS: usize = 0;

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
