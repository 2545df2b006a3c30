//! Compiled model `prescribed_length`.
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
pub const STATES: usize = 2;
/// Number of parameters.
pub const PARAMETERS: usize = 6;
/// Number of time integrals.
pub const INTEGRALS: usize = 3;

/// The compiled model `prescribed_length`: 2 states, 6 parameters, 3 time integrals.
#[derive(Clone, Copy, Debug, Default)]
pub struct PrescribedLength;

/// Names, units and structure.
static INFO: model::ModelInfo = model::ModelInfo {
    name: "prescribed_length",
    fingerprint: "2cd771d0aea87d635135942e9063e9e68578c929d342cd888a5c0bf48824c0ac",
    parameters: &[
        model::Quantity {
            name: "l_s",
            si: "m",
        },
        model::Quantity {
            name: "l_b",
            si: "m",
        },
        model::Quantity {
            name: "m",
            si: "kg",
        },
        model::Quantity {
            name: "g",
            si: "m/s^2",
        },
        model::Quantity {
            name: "psi",
            si: "1",
        },
        model::Quantity {
            name: "omega",
            si: "s^-1",
        },
    ],
    states: &[
        model::Quantity {
            name: "q_theta",
            si: "1",
        },
        model::Quantity {
            name: "p_theta",
            si: "m/s",
        },
    ],
    memory: &["n"],
    modes: &[
        model::ModeInfo {
            name: "stance",
            switches: &[0],
            measured_switches: &[0, 1, 2, 3],
        },
    ],
    transitions: &[
        model::TransitionInfo {
            name: "step",
            from: 0,
            to: 0,
            direction: model::Direction::Falling,
            also_zero: &[],
        },
    ],
    switches: &["tau <= pi/omega", "abs(v_x)", "abs(rho_a)", "max(power, 0)"],
    coordinates: &[0, 1],
    section: ::core::option::Option::Some(model::Section::After(0)),
    returning: &[],
    symmetric: true,
    functionals: &[
        model::Functional::Mean(0),
        model::Functional::Mean(1),
        model::Functional::Duration,
        model::Functional::Integral(0),
        model::Functional::Maximum(0),
        model::Functional::Mean(2),
    ],
    measures: &[
        model::Quantity {
            name: "climb_speed",
            si: "m/s",
        },
        model::Quantity {
            name: "lateral_speed",
            si: "m/s",
        },
        model::Quantity {
            name: "stride_frequency",
            si: "s^-1",
        },
        model::Quantity {
            name: "step_length",
            si: "m",
        },
        model::Quantity {
            name: "peak_force",
            si: "N",
        },
        model::Quantity {
            name: "mean_power",
            si: "W",
        },
        model::Quantity {
            name: "cost_of_transport",
            si: "1",
        },
    ],
    uses_time: false,
    explicit: true,
};

impl model::Model<STATES, PARAMETERS, INTEGRALS> for PrescribedLength {
    const INFO: &'static model::ModelInfo = &INFO;
    #[inline]
    fn flow<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; STATES] {
        match mode {
            0 => flow_stance(x, env),
            _ => nan_state(),
        }
    }
    fn flow_jacobian<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        match mode {
            0 => d_flow_stance(x, env),
            _ => nan_jacobian(),
        }
    }
    #[inline]
    fn variational<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        dx: &[[S; STATES]; C],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; STATES], [[S; STATES]; C]) {
        match mode {
            0 => tangent_flow_stance(x, dx, env),
            _ => (nan_state(), [nan_state(); C]),
        }
    }
    #[inline]
    fn integrated<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; STATES], [S; INTEGRALS]) {
        match mode {
            0 => integrated_stance(x, env),
            _ => (nan_state(), [nan(); INTEGRALS]),
        }
    }
    #[inline]
    fn integrated_variational<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        dx: &[[S; STATES]; C],
        dp: &[[S; PARAMETERS]; C],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Integrated<S, STATES, INTEGRALS, C> {
        match mode {
            0 => tangent_integrated_stance(x, dx, dp, env),
            _ => {
                model::Integrated {
                    flow: nan_state(),
                    integrands: [nan(); INTEGRALS],
                    dflow: [nan_state(); C],
                    dintegrands: [[nan(); INTEGRALS]; C],
                }
            }
        }
    }
    fn residual<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; STATES] {
        match mode {
            0 => residual_stance(x, k, env),
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
            0 => d_residual_stance(x, k, env),
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
            0 => linearised_stance(x, k, env),
            _ => nan_linearised(),
        }
    }
    fn integrands<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        _k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; INTEGRALS] {
        match mode {
            0 => integrands(x, env),
            _ => [nan(); INTEGRALS],
        }
    }
    #[inline]
    fn integrands_along<S: scalar::Scalar, const C: usize>(
        mode: usize,
        x: &[S; STATES],
        _k: &[S; STATES],
        along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
        match mode {
            0 => tangent_integrands(x, along, env),
            _ => ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]),
        }
    }
    fn switch<S: scalar::Scalar>(
        index: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        match index {
            0 => switch_0(x, env),
            1 => switch_1(x, env),
            2 => switch_2(x, env),
            3 => switch_3(x, env),
            _ => nan(),
        }
    }
    fn switch_gradient<S: scalar::Scalar>(
        index: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        match index {
            0 => d_switch_0(x, env),
            1 => d_switch_1(x, env),
            2 => d_switch_2(x, env),
            3 => d_switch_3(x, env),
            _ => nan_gradient(),
        }
    }
    fn guard<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        match transition {
            0 => guard_step(x, env),
            _ => nan(),
        }
    }
    fn guard_gradient<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        match transition {
            0 => d_guard_step(x, env),
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
        if memory.len() != 1 {
            memory.fill(nan());
            return nan_state();
        }
        let (state, after): ([S; STATES], [S; 1]) = match transition {
            0 => reset_step(x, env),
            _ => (nan_state(), [nan(); 1]),
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
            0 => d_reset_step(x, env),
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
        symmetry(x, p)
    }
    fn symmetry_jacobian<S: scalar::Scalar>(
        x: &[S; STATES],
        p: &[S; PARAMETERS],
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        d_symmetry(x, p)
    }
    fn observable<S: scalar::Scalar>(
        index: usize,
        mode: usize,
        x: &[S; STATES],
        _k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        match (index, mode) {
            (0, 0) => observable_0(x, env),
            _ => nan(),
        }
    }
    fn observable_gradient<S: scalar::Scalar>(
        index: usize,
        mode: usize,
        x: &[S; STATES],
        _k: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::RateGradient<S, STATES, PARAMETERS> {
        match (index, mode) {
            (0, 0) => d_observable_0(x, env),
            _ => nan_rate_gradient(),
        }
    }
    fn measures<S: scalar::Scalar>(
        functionals: &[S],
        p: &[S; PARAMETERS],
        out: &mut [S],
    ) {
        if out.len() != 7 {
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
        if dfunctionals.len() != 42 || dp.len() != 7 {
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

/// State derivative f of mode `stance`.
/// Rates of q_theta [s^-1], p_theta [m s^-2].
///
/// 5 additions, 6 multiplications, 3 divisions, 3 function calls, 2 selections.
fn flow_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_] = env.memory else { return nan_state() };
    let &[b0, _, _, _] = env.branch else { return nan_state() };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = x_q_theta.sin();
    let v9 = p_g * v8;
    let v10 = v1.sin();
    let v11 = v10 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = v9 + v16;
    let v18 = -v17;
    [v7, v18]
}

/// State derivative f and integrands of mode `stance`.
///
/// 12 additions, 19 multiplications, 4 divisions, 4 function calls, 8 selections.
fn integrated_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; INTEGRALS]) {
    let &[_] = env.memory else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[b0, b1, _, b3] = env.branch else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = x_q_theta.sin();
    let v9 = p_g * v8;
    let v10 = v1.sin();
    let v11 = v10 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = v9 + v16;
    let v18 = -v17;
    let v19 = x_p_theta * v8;
    let v20 = x_q_theta.cos();
    let v21 = v12 * v20;
    let v22 = -v21;
    let v23 = S::select(b0, v22, S::constant(0.0));
    let v24 = v19 - v23;
    let v25 = v12 * v8;
    let v26 = -v25;
    let v27 = S::select(b0, v26, S::constant(0.0));
    let v28 = x_p_theta * v20;
    let v29 = v27 + v28;
    let v30 = -v29;
    let v31 = S::select(b1, v29, v30);
    let v32 = v2 * p_omega;
    let v33 = p_omega * v32;
    let v34 = v0 * v33;
    let v35 = p_m * v34;
    let v36 = S::select(b0, v35, S::constant(0.0));
    let v37 = p_m * p_g;
    let v38 = v37 * v20;
    let v39 = v36 + v38;
    let v40 = x_p_theta * x_p_theta;
    let v41 = p_m * v40;
    let v42 = v41 / v6;
    let v43 = v39 + v42;
    let v44 = v43 * v12;
    let v45 = S::select(b0, v44, S::constant(0.0));
    let v46 = S::select(b3, v45, S::constant(0.0));
    ([v7, v18], [v24, v31, v46])
}

/// Residual F = M k - f of mode `stance`, k the rates of the states.
///
/// 6 additions, 6 multiplications, 3 divisions, 3 function calls, 2 selections.
fn residual_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_] = env.memory else { return nan_state() };
    let &[b0, _, _, _] = env.branch else { return nan_state() };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let &[k_q_theta, k_p_theta] = k;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = k_q_theta - v7;
    let v9 = x_q_theta.sin();
    let v10 = p_g * v9;
    let v11 = v1.sin();
    let v12 = v11 * p_omega;
    let v13 = v0 * v12;
    let v14 = v13 * x_p_theta;
    let v15 = -v14;
    let v16 = S::select(b0, v15, S::constant(0.0));
    let v17 = v16 / v6;
    let v18 = v10 + v17;
    let v19 = k_p_theta + v18;
    [v8, v19]
}

/// Switching function 0, not negative where `tau <= pi/omega`.
///
/// 1 addition, 1 division.
fn switch_0<S: scalar::Scalar>(
    _x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[_, _, _, _, _, p_omega] = env.p;
    let tau = env.tau;
    let v0 = S::constant(3.141592653589793) / p_omega;
    let v1 = v0 - tau;
    v1
}

/// Switching function 1, not negative where `abs(v_x)`.
///
/// 2 additions, 5 multiplications, 1 division, 3 function calls, 1 selection.
fn switch_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[b0, _, _, _] = env.branch else { return nan() };
    let &[p_l_s, _, _, _, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.sin();
    let v3 = v2 * p_omega;
    let v4 = v0 * v3;
    let v5 = x_q_theta.sin();
    let v6 = v4 * v5;
    let v7 = -v6;
    let v8 = S::select(b0, v7, S::constant(0.0));
    let v9 = x_q_theta.cos();
    let v10 = x_p_theta * v9;
    let v11 = v8 + v10;
    v11
}

/// Switching function 2, not negative where `abs(rho_a)`.
///
/// 4 additions, 10 multiplications, 2 divisions, 2 function calls, 2 selections.
fn switch_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[b0, _, _, _] = env.branch else { return nan() };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = v2 * p_omega;
    let v4 = p_omega * v3;
    let v5 = v0 * v4;
    let v6 = p_m * v5;
    let v7 = S::select(b0, v6, S::constant(0.0));
    let v8 = p_m * p_g;
    let v9 = x_q_theta.cos();
    let v10 = v8 * v9;
    let v11 = v7 + v10;
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0 * v14;
    let v16 = p_l_b + v15;
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v13 / v17;
    let v19 = v11 + v18;
    v19
}

/// Switching function 3, not negative where `max(power, 0)`.
///
/// 4 additions, 13 multiplications, 2 divisions, 3 function calls, 3 selections.
fn switch_3<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[b0, _, _, _] = env.branch else { return nan() };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = v2 * p_omega;
    let v4 = p_omega * v3;
    let v5 = v0 * v4;
    let v6 = p_m * v5;
    let v7 = S::select(b0, v6, S::constant(0.0));
    let v8 = p_m * p_g;
    let v9 = x_q_theta.cos();
    let v10 = v8 * v9;
    let v11 = v7 + v10;
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0 * v14;
    let v16 = p_l_b + v15;
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v13 / v17;
    let v19 = v11 + v18;
    let v20 = v1.sin();
    let v21 = v20 * p_omega;
    let v22 = v0 * v21;
    let v23 = v19 * v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    v24
}

/// Guard of transition `step`.
///
/// 1 addition, 1 division.
fn guard_step<S: scalar::Scalar>(
    _x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[_, _, _, _, _, p_omega] = env.p;
    let tau = env.tau;
    let v0 = S::constant(3.141592653589793) / p_omega;
    let v1 = v0 - tau;
    v1
}

/// State and memory after transition `step`, from those before.
/// State: q_theta [1], p_theta [m s^-1].
///
/// 3 additions, 2 multiplications, 2 function calls.
fn reset_step<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 1]) {
    let &[n_n] = env.memory else { return (nan_state(), [nan(); 1]) };
    let &[_, _, _, _] = env.branch else { return (nan_state(), [nan(); 1]) };
    let &[_, _, _, _, p_psi, _] = env.p;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_psi + p_psi;
    let v1 = S::constant(-1.0).pow(n_n);
    let v2 = v0 * v1;
    let v3 = x_q_theta + v2;
    let v4 = v0.cos();
    let v5 = v4 * x_p_theta;
    let v6 = n_n + S::constant(1.0);
    ([v3, v5], [v6])
}

/// Full state on the section from its coordinates.
///
/// No operations.
fn embed<S: scalar::Scalar>(z: &[S], _p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_q_theta, x_p_theta] = z else { return nan_state() };
    [x_q_theta, x_p_theta]
}

/// Image of a state under the section's symmetry.
///
/// 2 additions.
fn symmetry<S: scalar::Scalar>(x: &[S; STATES], _p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_q_theta, x_p_theta] = x;
    let v0 = -x_q_theta;
    let v1 = -x_p_theta;
    [v0, v1]
}

/// Measures from the values of the functionals.
/// Measures: climb_speed [m s^-1], lateral_speed [m s^-1], stride_frequency [s^-1], step_length [m], peak_force [m kg s^-2], mean_power [m^2 kg s^-3], cost_of_transport [1].
///
/// 1 addition, 2 multiplications, 2 divisions.
fn measures<S: scalar::Scalar>(functionals: &[S], p: &[S; PARAMETERS]) -> [S; 7] {
    let &[f0, f1, f2, f3, f4, f5] = functionals else { return [nan(); 7] };
    let &[_, _, p_m, p_g, _, _] = p;
    let v0 = f2 + f2;
    let v1 = S::constant(1.0) / v0;
    let v2 = p_m * p_g;
    let v3 = v2 * f0;
    let v4 = f5 / v3;
    [f0, f1, v1, f3, f4, f5, v4]
}

/// State derivative f of mode `stance` with all first derivatives.
/// Components: q_theta, p_theta; derivatives by columns.
///
/// 15 additions, 28 multiplications, 10 divisions, 4 function calls, 10 selections.
fn d_flow_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_jacobian() };
    let &[b0, _, _, _] = env.branch else { return nan_jacobian() };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = x_q_theta.sin();
    let v9 = p_g * v8;
    let v10 = v1.sin();
    let v11 = v10 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = v9 + v16;
    let v18 = -v17;
    let v19 = x_q_theta.cos();
    let v20 = p_g * v19;
    let v21 = -v20;
    let v22 = S::constant(1.0) / v6;
    let v23 = v12 / v6;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = v7 / v6;
    let v26 = S::constant(0.5) * v3;
    let v27 = v25 * v26;
    let v28 = -v27;
    let v29 = S::select(b0, v28, S::constant(0.0));
    let v30 = S::constant(0.5) * v11;
    let v31 = x_p_theta * v30;
    let v32 = v31 / v6;
    let v33 = v16 / v6;
    let v34 = v33 * v26;
    let v35 = v32 + v34;
    let v36 = S::select(b0, v35, S::constant(0.0));
    let v37 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v38 = v25 * v37;
    let v39 = -v38;
    let v40 = v33 * v37;
    let v41 = -v8;
    let v42 = v10 * tau;
    let v43 = v0 * v42;
    let v44 = v25 * v43;
    let v45 = S::select(b0, v44, S::constant(0.0));
    let v46 = v33 * v43;
    let v47 = v2 * tau;
    let v48 = p_omega * v47;
    let v49 = v48 + v10;
    let v50 = v0 * v49;
    let v51 = x_p_theta * v50;
    let v52 = v51 / v6;
    let v53 = v46 - v52;
    let v54 = -v53;
    let v55 = S::select(b0, v54, S::constant(0.0));
    let v56 = v25 * v12;
    let v57 = S::select(b0, v56, S::constant(0.0));
    let v58 = v33 * v12;
    let v59 = v2 * p_omega;
    let v60 = p_omega * v59;
    let v61 = v0 * v60;
    let v62 = x_p_theta * v61;
    let v63 = v62 / v6;
    let v64 = v58 - v63;
    let v65 = -v64;
    let v66 = S::select(b0, v65, S::constant(0.0));
    model::Jacobian {
        value: [v7, v18],
        dx: [[S::constant(0.0), v21], [v22, v24]],
        dp: [
            [v29, v36],
            [v39, v40],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v41],
            [S::constant(0.0), S::constant(0.0)],
            [v45, v55],
        ],
        dtau: [v57, v66],
        dt: [S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `stance` with all first derivatives, by columns.
///
/// 16 additions, 28 multiplications, 10 divisions, 4 function calls, 10 selections.
fn d_residual_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_residual_jacobian() };
    let &[b0, _, _, _] = env.branch else { return nan_residual_jacobian() };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let &[k_q_theta, k_p_theta] = k;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = k_q_theta - v7;
    let v9 = x_q_theta.sin();
    let v10 = p_g * v9;
    let v11 = v1.sin();
    let v12 = v11 * p_omega;
    let v13 = v0 * v12;
    let v14 = v13 * x_p_theta;
    let v15 = -v14;
    let v16 = S::select(b0, v15, S::constant(0.0));
    let v17 = v16 / v6;
    let v18 = v10 + v17;
    let v19 = k_p_theta + v18;
    let v20 = x_q_theta.cos();
    let v21 = p_g * v20;
    let v22 = S::constant(1.0) / v6;
    let v23 = -v22;
    let v24 = v13 / v6;
    let v25 = -v24;
    let v26 = S::select(b0, v25, S::constant(0.0));
    let v27 = v7 / v6;
    let v28 = S::constant(0.5) * v3;
    let v29 = v27 * v28;
    let v30 = S::select(b0, v29, S::constant(0.0));
    let v31 = S::constant(0.5) * v12;
    let v32 = x_p_theta * v31;
    let v33 = v32 / v6;
    let v34 = v17 / v6;
    let v35 = v34 * v28;
    let v36 = v33 + v35;
    let v37 = -v36;
    let v38 = S::select(b0, v37, S::constant(0.0));
    let v39 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v40 = v27 * v39;
    let v41 = v34 * v39;
    let v42 = -v41;
    let v43 = v11 * tau;
    let v44 = v0 * v43;
    let v45 = v27 * v44;
    let v46 = -v45;
    let v47 = S::select(b0, v46, S::constant(0.0));
    let v48 = v34 * v44;
    let v49 = v2 * tau;
    let v50 = p_omega * v49;
    let v51 = v50 + v11;
    let v52 = v0 * v51;
    let v53 = x_p_theta * v52;
    let v54 = v53 / v6;
    let v55 = v48 - v54;
    let v56 = S::select(b0, v55, S::constant(0.0));
    let v57 = v27 * v13;
    let v58 = -v57;
    let v59 = S::select(b0, v58, S::constant(0.0));
    let v60 = v34 * v13;
    let v61 = v2 * p_omega;
    let v62 = p_omega * v61;
    let v63 = v0 * v62;
    let v64 = x_p_theta * v63;
    let v65 = v64 / v6;
    let v66 = v60 - v65;
    let v67 = S::select(b0, v66, S::constant(0.0));
    model::ResidualJacobian {
        value: [v8, v19],
        dx: [[S::constant(0.0), v21], [v23, v26]],
        dk: [[S::constant(1.0), S::constant(0.0)], [S::constant(0.0), S::constant(1.0)]],
        dp: [
            [v30, v38],
            [v40, v42],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v9],
            [S::constant(0.0), S::constant(0.0)],
            [v47, v56],
        ],
        dtau: [v59, v67],
        dt: [S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `stance` with its derivatives by state and rate, by columns.
///
/// 8 additions, 7 multiplications, 5 divisions, 4 function calls, 3 selections.
fn linearised_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[_] = env.memory else { return nan_linearised() };
    let &[b0, _, _, _] = env.branch else { return nan_linearised() };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let &[k_q_theta, k_p_theta] = k;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = k_q_theta - v7;
    let v9 = x_q_theta.sin();
    let v10 = p_g * v9;
    let v11 = v1.sin();
    let v12 = v11 * p_omega;
    let v13 = v0 * v12;
    let v14 = v13 * x_p_theta;
    let v15 = -v14;
    let v16 = S::select(b0, v15, S::constant(0.0));
    let v17 = v16 / v6;
    let v18 = v10 + v17;
    let v19 = k_p_theta + v18;
    let v20 = x_q_theta.cos();
    let v21 = p_g * v20;
    let v22 = S::constant(1.0) / v6;
    let v23 = -v22;
    let v24 = v13 / v6;
    let v25 = -v24;
    let v26 = S::select(b0, v25, S::constant(0.0));
    model::Linearised {
        value: [v8, v19],
        dx: [[S::constant(0.0), v21], [v23, v26]],
        dk: [[S::constant(1.0), S::constant(0.0)], [S::constant(0.0), S::constant(1.0)]],
    }
}

/// Switching function 0 with all first derivatives.
///
/// 2 additions, 2 divisions.
fn d_switch_0<S: scalar::Scalar>(
    _x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[_, _, _, _, _, p_omega] = env.p;
    let tau = env.tau;
    let v0 = S::constant(3.141592653589793) / p_omega;
    let v1 = v0 - tau;
    let v2 = v0 / p_omega;
    let v3 = -v2;
    model::Gradient {
        value: v1,
        dx: [S::constant(0.0), S::constant(0.0)],
        dp: [
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v3,
        ],
        dtau: S::constant(-1.0),
        dt: S::constant(0.0),
    }
}

/// Switching function 1 with all first derivatives.
///
/// 8 additions, 17 multiplications, 1 division, 4 function calls, 5 selections.
fn d_switch_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_l_s, _, _, _, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.sin();
    let v3 = v2 * p_omega;
    let v4 = v0 * v3;
    let v5 = x_q_theta.sin();
    let v6 = v4 * v5;
    let v7 = -v6;
    let v8 = S::select(b0, v7, S::constant(0.0));
    let v9 = x_q_theta.cos();
    let v10 = x_p_theta * v9;
    let v11 = v8 + v10;
    let v12 = v4 * v9;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = x_p_theta * v5;
    let v16 = v14 - v15;
    let v17 = S::constant(0.5) * v3;
    let v18 = v5 * v17;
    let v19 = -v18;
    let v20 = S::select(b0, v19, S::constant(0.0));
    let v21 = v1.cos();
    let v22 = v21 * tau;
    let v23 = p_omega * v22;
    let v24 = v23 + v2;
    let v25 = v0 * v24;
    let v26 = v5 * v25;
    let v27 = -v26;
    let v28 = S::select(b0, v27, S::constant(0.0));
    let v29 = v21 * p_omega;
    let v30 = p_omega * v29;
    let v31 = v0 * v30;
    let v32 = v5 * v31;
    let v33 = -v32;
    let v34 = S::select(b0, v33, S::constant(0.0));
    model::Gradient {
        value: v11,
        dx: [v16, v9],
        dp: [
            v20,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v28,
        ],
        dtau: v34,
        dt: S::constant(0.0),
    }
}

/// Switching function 2 with all first derivatives.
///
/// 14 additions, 33 multiplications, 5 divisions, 4 function calls, 7 selections.
fn d_switch_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = v2 * p_omega;
    let v4 = p_omega * v3;
    let v5 = v0 * v4;
    let v6 = p_m * v5;
    let v7 = S::select(b0, v6, S::constant(0.0));
    let v8 = p_m * p_g;
    let v9 = x_q_theta.cos();
    let v10 = v8 * v9;
    let v11 = v7 + v10;
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0 * v14;
    let v16 = p_l_b + v15;
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v13 / v17;
    let v19 = v11 + v18;
    let v20 = x_q_theta.sin();
    let v21 = v8 * v20;
    let v22 = -v21;
    let v23 = x_p_theta + x_p_theta;
    let v24 = p_m * v23;
    let v25 = v24 / v17;
    let v26 = S::constant(0.5) * v4;
    let v27 = p_m * v26;
    let v28 = v18 / v17;
    let v29 = S::constant(0.5) * v14;
    let v30 = v28 * v29;
    let v31 = v27 - v30;
    let v32 = S::select(b0, v31, S::constant(0.0));
    let v33 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v34 = v28 * v33;
    let v35 = -v34;
    let v36 = S::select(b0, v5, S::constant(0.0));
    let v37 = v9 * p_g;
    let v38 = v36 + v37;
    let v39 = v12 / v17;
    let v40 = v38 + v39;
    let v41 = v9 * p_m;
    let v42 = v1.sin();
    let v43 = v42 * tau;
    let v44 = p_omega * v43;
    let v45 = v2 - v44;
    let v46 = p_omega * v45;
    let v47 = v3 + v46;
    let v48 = v0 * v47;
    let v49 = p_m * v48;
    let v50 = v0 * v43;
    let v51 = v28 * v50;
    let v52 = v49 + v51;
    let v53 = S::select(b0, v52, S::constant(0.0));
    let v54 = v42 * p_omega;
    let v55 = v0 * v54;
    let v56 = v28 * v55;
    let v57 = p_omega * v54;
    let v58 = p_omega * v57;
    let v59 = v0 * v58;
    let v60 = p_m * v59;
    let v61 = v56 - v60;
    let v62 = S::select(b0, v61, S::constant(0.0));
    model::Gradient {
        value: v19,
        dx: [v22, v25],
        dp: [v32, v35, v40, v41, S::constant(0.0), v53],
        dtau: v62,
        dt: S::constant(0.0),
    }
}

/// Switching function 3 with all first derivatives.
///
/// 18 additions, 49 multiplications, 5 divisions, 4 function calls, 16 selections.
fn d_switch_3<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = v2 * p_omega;
    let v4 = p_omega * v3;
    let v5 = v0 * v4;
    let v6 = p_m * v5;
    let v7 = S::select(b0, v6, S::constant(0.0));
    let v8 = p_m * p_g;
    let v9 = x_q_theta.cos();
    let v10 = v8 * v9;
    let v11 = v7 + v10;
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0 * v14;
    let v16 = p_l_b + v15;
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v13 / v17;
    let v19 = v11 + v18;
    let v20 = v1.sin();
    let v21 = v20 * p_omega;
    let v22 = v0 * v21;
    let v23 = v19 * v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = x_q_theta.sin();
    let v26 = v8 * v25;
    let v27 = v22 * v26;
    let v28 = -v27;
    let v29 = S::select(b0, v28, S::constant(0.0));
    let v30 = x_p_theta + x_p_theta;
    let v31 = p_m * v30;
    let v32 = v31 / v17;
    let v33 = v22 * v32;
    let v34 = S::select(b0, v33, S::constant(0.0));
    let v35 = S::constant(0.5) * v4;
    let v36 = p_m * v35;
    let v37 = v18 / v17;
    let v38 = S::constant(0.5) * v14;
    let v39 = v37 * v38;
    let v40 = v36 - v39;
    let v41 = v22 * v40;
    let v42 = S::select(b0, v41, S::constant(0.0));
    let v43 = S::constant(0.5) * v21;
    let v44 = v19 * v43;
    let v45 = v42 + v44;
    let v46 = S::select(b0, v45, S::constant(0.0));
    let v47 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v48 = v37 * v47;
    let v49 = v22 * v48;
    let v50 = -v49;
    let v51 = S::select(b0, v50, S::constant(0.0));
    let v52 = S::select(b0, v5, S::constant(0.0));
    let v53 = v9 * p_g;
    let v54 = v52 + v53;
    let v55 = v12 / v17;
    let v56 = v54 + v55;
    let v57 = v22 * v56;
    let v58 = S::select(b0, v57, S::constant(0.0));
    let v59 = v9 * p_m;
    let v60 = v22 * v59;
    let v61 = S::select(b0, v60, S::constant(0.0));
    let v62 = v20 * tau;
    let v63 = p_omega * v62;
    let v64 = v2 - v63;
    let v65 = p_omega * v64;
    let v66 = v3 + v65;
    let v67 = v0 * v66;
    let v68 = p_m * v67;
    let v69 = v0 * v62;
    let v70 = v37 * v69;
    let v71 = v68 + v70;
    let v72 = v22 * v71;
    let v73 = S::select(b0, v72, S::constant(0.0));
    let v74 = v2 * tau;
    let v75 = p_omega * v74;
    let v76 = v75 + v20;
    let v77 = v0 * v76;
    let v78 = v19 * v77;
    let v79 = v73 + v78;
    let v80 = S::select(b0, v79, S::constant(0.0));
    let v81 = v37 * v22;
    let v82 = p_omega * v21;
    let v83 = p_omega * v82;
    let v84 = v0 * v83;
    let v85 = p_m * v84;
    let v86 = v81 - v85;
    let v87 = v22 * v86;
    let v88 = S::select(b0, v87, S::constant(0.0));
    let v89 = v19 * v5;
    let v90 = v88 + v89;
    let v91 = S::select(b0, v90, S::constant(0.0));
    model::Gradient {
        value: v24,
        dx: [v29, v34],
        dp: [v46, v51, v58, v61, S::constant(0.0), v80],
        dtau: v91,
        dt: S::constant(0.0),
    }
}

/// Guard of transition `step` with all first derivatives.
///
/// 2 additions, 2 divisions.
fn d_guard_step<S: scalar::Scalar>(
    _x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[_, _, _, _, _, p_omega] = env.p;
    let tau = env.tau;
    let v0 = S::constant(3.141592653589793) / p_omega;
    let v1 = v0 - tau;
    let v2 = v0 / p_omega;
    let v3 = -v2;
    model::Gradient {
        value: v1,
        dx: [S::constant(0.0), S::constant(0.0)],
        dp: [
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v3,
        ],
        dtau: S::constant(-1.0),
        dt: S::constant(0.0),
    }
}

/// State after transition `step` with all first derivatives.
/// Components: q_theta, p_theta; derivatives by columns.
///
/// 5 additions, 3 multiplications, 3 function calls.
fn d_reset_step<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[n_n] = env.memory else { return nan_jacobian() };
    let &[_, _, _, _] = env.branch else { return nan_jacobian() };
    let &[_, _, _, _, p_psi, _] = env.p;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_psi + p_psi;
    let v1 = S::constant(-1.0).pow(n_n);
    let v2 = v0 * v1;
    let v3 = x_q_theta + v2;
    let v4 = v0.cos();
    let v5 = v4 * x_p_theta;
    let v6 = v1 + v1;
    let v7 = v0.sin();
    let v8 = -v7;
    let v9 = v8 - v7;
    let v10 = x_p_theta * v9;
    model::Jacobian {
        value: [v3, v5],
        dx: [[S::constant(1.0), S::constant(0.0)], [S::constant(0.0), v4]],
        dp: [
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [v6, v10],
            [S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0)],
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
        [[S::constant(1.0), S::constant(0.0)], [S::constant(0.0), S::constant(1.0)]],
        [
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// Symmetry with its derivatives by state and parameters, by columns.
///
/// 2 additions.
fn d_symmetry<S: scalar::Scalar>(
    x: &[S; STATES],
    _p: &[S; PARAMETERS],
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[x_q_theta, x_p_theta] = x;
    let v0 = -x_q_theta;
    let v1 = -x_p_theta;
    model::Jacobian {
        value: [v0, v1],
        dx: [
            [S::constant(-1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(-1.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0); STATES],
        dt: [S::constant(0.0); STATES],
    }
}

/// Derivatives of the 7 measures: by the 6 functionals, one row a measure, and by the parameters.
///
/// 6 additions, 7 multiplications, 5 divisions.
fn d_measures<S: scalar::Scalar>(
    functionals: &[S],
    p: &[S; PARAMETERS],
) -> ([S; 42], [[S; PARAMETERS]; 7]) {
    let &[f0, _, f2, _, _, f5] = functionals else {
        return ([nan(); 42], [[nan(); PARAMETERS]; 7])
    };
    let &[_, _, p_m, p_g, _, _] = p;
    let v0 = f2 + f2;
    let v1 = S::constant(1.0) / v0;
    let v2 = p_m * p_g;
    let v3 = v2 * f0;
    let v4 = f5 / v3;
    let v5 = v4 / v3;
    let v6 = v5 * v2;
    let v7 = -v6;
    let v8 = v1 / v0;
    let v9 = -v8;
    let v10 = v9 - v8;
    let v11 = S::constant(1.0) / v3;
    let v12 = f0 * p_g;
    let v13 = v5 * v12;
    let v14 = -v13;
    let v15 = f0 * p_m;
    let v16 = v5 * v15;
    let v17 = -v16;
    (
        [
            S::constant(1.0),
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
            v10,
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
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(1.0),
            v7,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v11,
        ],
        [
            [
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
            ],
            [
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
            ],
            [
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
            ],
            [
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
            ],
            [
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
            ],
            [
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
                S::constant(0.0),
            ],
            [
                S::constant(0.0),
                S::constant(0.0),
                v14,
                v17,
                S::constant(0.0),
                S::constant(0.0),
            ],
        ],
    )
}

/// The integrands.
///
/// 9 additions, 17 multiplications, 2 divisions, 4 function calls, 7 selections.
fn integrands<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; INTEGRALS] {
    let &[_] = env.memory else { return [nan(); INTEGRALS] };
    let &[b0, b1, _, b3] = env.branch else { return [nan(); INTEGRALS] };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = x_q_theta.sin();
    let v1 = x_p_theta * v0;
    let v2 = p_l_s / S::constant(2.0);
    let v3 = p_omega * tau;
    let v4 = v3.sin();
    let v5 = v4 * p_omega;
    let v6 = v2 * v5;
    let v7 = x_q_theta.cos();
    let v8 = v6 * v7;
    let v9 = -v8;
    let v10 = S::select(b0, v9, S::constant(0.0));
    let v11 = v1 - v10;
    let v12 = v6 * v0;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = x_p_theta * v7;
    let v16 = v14 + v15;
    let v17 = -v16;
    let v18 = S::select(b1, v16, v17);
    let v19 = v3.cos();
    let v20 = v19 * p_omega;
    let v21 = p_omega * v20;
    let v22 = v2 * v21;
    let v23 = p_m * v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = p_m * p_g;
    let v26 = v25 * v7;
    let v27 = v24 + v26;
    let v28 = x_p_theta * x_p_theta;
    let v29 = p_m * v28;
    let v30 = S::constant(1.0) + v19;
    let v31 = v2 * v30;
    let v32 = p_l_b + v31;
    let v33 = S::select(b0, v32, p_l_b);
    let v34 = v29 / v33;
    let v35 = v27 + v34;
    let v36 = v35 * v6;
    let v37 = S::select(b0, v36, S::constant(0.0));
    let v38 = S::select(b3, v37, S::constant(0.0));
    [v11, v18, v38]
}

/// Observable 0.
///
/// 5 additions, 10 multiplications, 2 divisions, 2 function calls, 3 selections.
fn observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[b0, _, b2, _] = env.branch else { return nan() };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = v2 * p_omega;
    let v4 = p_omega * v3;
    let v5 = v0 * v4;
    let v6 = p_m * v5;
    let v7 = S::select(b0, v6, S::constant(0.0));
    let v8 = p_m * p_g;
    let v9 = x_q_theta.cos();
    let v10 = v8 * v9;
    let v11 = v7 + v10;
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0 * v14;
    let v16 = p_l_b + v15;
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v13 / v17;
    let v19 = v11 + v18;
    let v20 = -v19;
    let v21 = S::select(b2, v19, v20);
    v21
}

/// Observable 0 with all first derivatives.
///
/// 21 additions, 33 multiplications, 5 divisions, 4 function calls, 19 selections.
fn d_observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_rate_gradient() };
    let &[b0, _, b2, _] = env.branch else { return nan_rate_gradient() };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = v2 * p_omega;
    let v4 = p_omega * v3;
    let v5 = v0 * v4;
    let v6 = p_m * v5;
    let v7 = S::select(b0, v6, S::constant(0.0));
    let v8 = p_m * p_g;
    let v9 = x_q_theta.cos();
    let v10 = v8 * v9;
    let v11 = v7 + v10;
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0 * v14;
    let v16 = p_l_b + v15;
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v13 / v17;
    let v19 = v11 + v18;
    let v20 = -v19;
    let v21 = S::select(b2, v19, v20);
    let v22 = x_q_theta.sin();
    let v23 = v8 * v22;
    let v24 = -v23;
    let v25 = S::select(b2, v24, v23);
    let v26 = x_p_theta + x_p_theta;
    let v27 = p_m * v26;
    let v28 = v27 / v17;
    let v29 = -v28;
    let v30 = S::select(b2, v28, v29);
    let v31 = S::constant(0.5) * v4;
    let v32 = p_m * v31;
    let v33 = v18 / v17;
    let v34 = S::constant(0.5) * v14;
    let v35 = v33 * v34;
    let v36 = v32 - v35;
    let v37 = S::select(b0, v36, S::constant(0.0));
    let v38 = -v36;
    let v39 = S::select(b0, v38, S::constant(0.0));
    let v40 = S::select(b2, v37, v39);
    let v41 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v42 = v33 * v41;
    let v43 = -v42;
    let v44 = S::select(b2, v43, v42);
    let v45 = S::select(b0, v5, S::constant(0.0));
    let v46 = v9 * p_g;
    let v47 = v45 + v46;
    let v48 = v12 / v17;
    let v49 = v47 + v48;
    let v50 = -v49;
    let v51 = S::select(b2, v49, v50);
    let v52 = v9 * p_m;
    let v53 = -v52;
    let v54 = S::select(b2, v52, v53);
    let v55 = v1.sin();
    let v56 = v55 * tau;
    let v57 = p_omega * v56;
    let v58 = v2 - v57;
    let v59 = p_omega * v58;
    let v60 = v3 + v59;
    let v61 = v0 * v60;
    let v62 = p_m * v61;
    let v63 = v0 * v56;
    let v64 = v33 * v63;
    let v65 = v62 + v64;
    let v66 = S::select(b0, v65, S::constant(0.0));
    let v67 = -v65;
    let v68 = S::select(b0, v67, S::constant(0.0));
    let v69 = S::select(b2, v66, v68);
    let v70 = v55 * p_omega;
    let v71 = v0 * v70;
    let v72 = v33 * v71;
    let v73 = p_omega * v70;
    let v74 = p_omega * v73;
    let v75 = v0 * v74;
    let v76 = p_m * v75;
    let v77 = v72 - v76;
    let v78 = S::select(b0, v77, S::constant(0.0));
    let v79 = -v77;
    let v80 = S::select(b0, v79, S::constant(0.0));
    let v81 = S::select(b2, v78, v80);
    model::RateGradient {
        value: v21,
        dx: [v25, v30],
        dk: [S::constant(0.0), S::constant(0.0)],
        dp: [v40, v44, v51, v54, S::constant(0.0), v69],
        dtau: v81,
        dt: S::constant(0.0),
    }
}

/// State derivative f of mode `stance` and, for each column v, (df/dx) v.
///
/// Once: 6 additions, 7 multiplications, 5 divisions, 4 function calls, 3 selections. A column, at most: 1 addition, 3 multiplications.
#[inline]
fn tangent_flow_stance<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[b0, _, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = x_q_theta.sin();
    let v9 = p_g * v8;
    let v10 = v1.sin();
    let v11 = v10 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = v9 + v16;
    let v18 = -v17;
    let v19 = x_q_theta.cos();
    let v20 = p_g * v19;
    let v21 = -v20;
    let v22 = S::constant(1.0) / v6;
    let v23 = v12 / v6;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_q_theta, dx_p_theta] = column;
        *product = [v22 * dx_p_theta, v21 * dx_q_theta + v24 * dx_p_theta];
    }
    ([v7, v18], products)
}

/// State derivative f and integrands of mode `stance` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 37 additions, 61 multiplications, 13 divisions, 4 function calls, 41 selections. A column, at most: 20 additions, 25 multiplications.
#[inline]
fn tangent_integrated_stance<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    dx: &[[S; STATES]; C],
    dp: &[[S; PARAMETERS]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Integrated<S, STATES, INTEGRALS, C> {
    let &[_] = env.memory else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[b0, b1, _, b3] = env.branch else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let v2 = v1.cos();
    let v3 = S::constant(1.0) + v2;
    let v4 = v0 * v3;
    let v5 = p_l_b + v4;
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = x_q_theta.sin();
    let v9 = p_g * v8;
    let v10 = v1.sin();
    let v11 = v10 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = v9 + v16;
    let v18 = -v17;
    let v19 = x_p_theta * v8;
    let v20 = x_q_theta.cos();
    let v21 = v12 * v20;
    let v22 = -v21;
    let v23 = S::select(b0, v22, S::constant(0.0));
    let v24 = v19 - v23;
    let v25 = v12 * v8;
    let v26 = -v25;
    let v27 = S::select(b0, v26, S::constant(0.0));
    let v28 = x_p_theta * v20;
    let v29 = v27 + v28;
    let v30 = -v29;
    let v31 = S::select(b1, v29, v30);
    let v32 = v2 * p_omega;
    let v33 = p_omega * v32;
    let v34 = v0 * v33;
    let v35 = p_m * v34;
    let v36 = S::select(b0, v35, S::constant(0.0));
    let v37 = p_m * p_g;
    let v38 = v37 * v20;
    let v39 = v36 + v38;
    let v40 = x_p_theta * x_p_theta;
    let v41 = p_m * v40;
    let v42 = v41 / v6;
    let v43 = v39 + v42;
    let v44 = v43 * v12;
    let v45 = S::select(b0, v44, S::constant(0.0));
    let v46 = S::select(b3, v45, S::constant(0.0));
    let v47 = p_g * v20;
    let v48 = -v47;
    let v49 = v28 + v27;
    let v50 = v23 - v19;
    let v51 = -v50;
    let v52 = S::select(b1, v50, v51);
    let v53 = v37 * v8;
    let v54 = v12 * v53;
    let v55 = -v54;
    let v56 = S::select(b0, v55, S::constant(0.0));
    let v57 = S::select(b3, v56, S::constant(0.0));
    let v58 = S::constant(1.0) / v6;
    let v59 = v12 / v6;
    let v60 = S::select(b0, v59, S::constant(0.0));
    let v61 = -v20;
    let v62 = S::select(b1, v20, v61);
    let v63 = x_p_theta + x_p_theta;
    let v64 = p_m * v63;
    let v65 = v64 / v6;
    let v66 = v12 * v65;
    let v67 = S::select(b0, v66, S::constant(0.0));
    let v68 = S::select(b3, v67, S::constant(0.0));
    let v69 = v7 / v6;
    let v70 = S::constant(0.5) * v3;
    let v71 = v69 * v70;
    let v72 = -v71;
    let v73 = S::select(b0, v72, S::constant(0.0));
    let v74 = S::constant(0.5) * v11;
    let v75 = x_p_theta * v74;
    let v76 = v75 / v6;
    let v77 = v16 / v6;
    let v78 = v77 * v70;
    let v79 = v76 + v78;
    let v80 = S::select(b0, v79, S::constant(0.0));
    let v81 = v20 * v74;
    let v82 = S::select(b0, v81, S::constant(0.0));
    let v83 = v8 * v74;
    let v84 = -v83;
    let v85 = S::select(b0, v84, S::constant(0.0));
    let v86 = S::select(b0, v83, S::constant(0.0));
    let v87 = S::select(b1, v85, v86);
    let v88 = S::constant(0.5) * v33;
    let v89 = p_m * v88;
    let v90 = v42 / v6;
    let v91 = v90 * v70;
    let v92 = v89 - v91;
    let v93 = v12 * v92;
    let v94 = S::select(b0, v93, S::constant(0.0));
    let v95 = v43 * v74;
    let v96 = v94 + v95;
    let v97 = S::select(b0, v96, S::constant(0.0));
    let v98 = S::select(b3, v97, S::constant(0.0));
    let v99 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v100 = v69 * v99;
    let v101 = -v100;
    let v102 = v77 * v99;
    let v103 = v90 * v99;
    let v104 = v12 * v103;
    let v105 = -v104;
    let v106 = S::select(b0, v105, S::constant(0.0));
    let v107 = S::select(b3, v106, S::constant(0.0));
    let v108 = S::select(b0, v34, S::constant(0.0));
    let v109 = v20 * p_g;
    let v110 = v108 + v109;
    let v111 = v40 / v6;
    let v112 = v110 + v111;
    let v113 = v12 * v112;
    let v114 = S::select(b0, v113, S::constant(0.0));
    let v115 = S::select(b3, v114, S::constant(0.0));
    let v116 = -v8;
    let v117 = v20 * p_m;
    let v118 = v12 * v117;
    let v119 = S::select(b0, v118, S::constant(0.0));
    let v120 = S::select(b3, v119, S::constant(0.0));
    let v121 = v10 * tau;
    let v122 = v0 * v121;
    let v123 = v69 * v122;
    let v124 = S::select(b0, v123, S::constant(0.0));
    let v125 = v77 * v122;
    let v126 = v2 * tau;
    let v127 = p_omega * v126;
    let v128 = v127 + v10;
    let v129 = v0 * v128;
    let v130 = x_p_theta * v129;
    let v131 = v130 / v6;
    let v132 = v125 - v131;
    let v133 = -v132;
    let v134 = S::select(b0, v133, S::constant(0.0));
    let v135 = v20 * v129;
    let v136 = S::select(b0, v135, S::constant(0.0));
    let v137 = v8 * v129;
    let v138 = -v137;
    let v139 = S::select(b0, v138, S::constant(0.0));
    let v140 = S::select(b0, v137, S::constant(0.0));
    let v141 = S::select(b1, v139, v140);
    let v142 = p_omega * v121;
    let v143 = v2 - v142;
    let v144 = p_omega * v143;
    let v145 = v32 + v144;
    let v146 = v0 * v145;
    let v147 = p_m * v146;
    let v148 = v90 * v122;
    let v149 = v147 + v148;
    let v150 = v12 * v149;
    let v151 = S::select(b0, v150, S::constant(0.0));
    let v152 = v43 * v129;
    let v153 = v151 + v152;
    let v154 = S::select(b0, v153, S::constant(0.0));
    let v155 = S::select(b3, v154, S::constant(0.0));
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[dx_q_theta, dx_p_theta] = dx;
        let &[dp_l_s, dp_l_b, dp_m, dp_g, _, dp_omega] = dp;
        *dflow = [
            v58 * dx_p_theta + v73 * dp_l_s + v101 * dp_l_b + v124 * dp_omega,
            v48 * dx_q_theta + v60 * dx_p_theta + v80 * dp_l_s + v102 * dp_l_b
                + v116 * dp_g + v134 * dp_omega,
        ];
        *dintegrands = [
            v49 * dx_q_theta + v8 * dx_p_theta + v82 * dp_l_s + v136 * dp_omega,
            v52 * dx_q_theta + v62 * dx_p_theta + v87 * dp_l_s + v141 * dp_omega,
            v57 * dx_q_theta + v68 * dx_p_theta + v98 * dp_l_s + v107 * dp_l_b
                + v115 * dp_m + v120 * dp_g + v155 * dp_omega,
        ];
    }
    model::Integrated {
        flow: [v7, v18],
        integrands: [v24, v31, v46],
        dflow,
        dintegrands,
    }
}

/// The integrands and their derivatives along each direction.
///
/// Once: 27 additions, 50 multiplications, 5 divisions, 4 function calls, 35 selections. A column, at most: 12 additions, 15 multiplications.
#[inline]
fn tangent_integrands<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
    let &[_] = env.memory else { return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]) };
    let &[b0, b1, _, b3] = env.branch else {
        return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let v0 = x_q_theta.sin();
    let v1 = x_p_theta * v0;
    let v2 = p_l_s / S::constant(2.0);
    let v3 = p_omega * tau;
    let v4 = v3.sin();
    let v5 = v4 * p_omega;
    let v6 = v2 * v5;
    let v7 = x_q_theta.cos();
    let v8 = v6 * v7;
    let v9 = -v8;
    let v10 = S::select(b0, v9, S::constant(0.0));
    let v11 = v1 - v10;
    let v12 = v6 * v0;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = x_p_theta * v7;
    let v16 = v14 + v15;
    let v17 = -v16;
    let v18 = S::select(b1, v16, v17);
    let v19 = v3.cos();
    let v20 = v19 * p_omega;
    let v21 = p_omega * v20;
    let v22 = v2 * v21;
    let v23 = p_m * v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = p_m * p_g;
    let v26 = v25 * v7;
    let v27 = v24 + v26;
    let v28 = x_p_theta * x_p_theta;
    let v29 = p_m * v28;
    let v30 = S::constant(1.0) + v19;
    let v31 = v2 * v30;
    let v32 = p_l_b + v31;
    let v33 = S::select(b0, v32, p_l_b);
    let v34 = v29 / v33;
    let v35 = v27 + v34;
    let v36 = v35 * v6;
    let v37 = S::select(b0, v36, S::constant(0.0));
    let v38 = S::select(b3, v37, S::constant(0.0));
    let v39 = v15 + v14;
    let v40 = v10 - v1;
    let v41 = -v40;
    let v42 = S::select(b1, v40, v41);
    let v43 = v25 * v0;
    let v44 = v6 * v43;
    let v45 = -v44;
    let v46 = S::select(b0, v45, S::constant(0.0));
    let v47 = S::select(b3, v46, S::constant(0.0));
    let v48 = -v7;
    let v49 = S::select(b1, v7, v48);
    let v50 = x_p_theta + x_p_theta;
    let v51 = p_m * v50;
    let v52 = v51 / v33;
    let v53 = v6 * v52;
    let v54 = S::select(b0, v53, S::constant(0.0));
    let v55 = S::select(b3, v54, S::constant(0.0));
    let v56 = S::constant(0.5) * v5;
    let v57 = v7 * v56;
    let v58 = S::select(b0, v57, S::constant(0.0));
    let v59 = v0 * v56;
    let v60 = -v59;
    let v61 = S::select(b0, v60, S::constant(0.0));
    let v62 = S::select(b0, v59, S::constant(0.0));
    let v63 = S::select(b1, v61, v62);
    let v64 = S::constant(0.5) * v21;
    let v65 = p_m * v64;
    let v66 = v34 / v33;
    let v67 = S::constant(0.5) * v30;
    let v68 = v66 * v67;
    let v69 = v65 - v68;
    let v70 = v6 * v69;
    let v71 = S::select(b0, v70, S::constant(0.0));
    let v72 = v35 * v56;
    let v73 = v71 + v72;
    let v74 = S::select(b0, v73, S::constant(0.0));
    let v75 = S::select(b3, v74, S::constant(0.0));
    let v76 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v77 = v66 * v76;
    let v78 = v6 * v77;
    let v79 = -v78;
    let v80 = S::select(b0, v79, S::constant(0.0));
    let v81 = S::select(b3, v80, S::constant(0.0));
    let v82 = S::select(b0, v22, S::constant(0.0));
    let v83 = v7 * p_g;
    let v84 = v82 + v83;
    let v85 = v28 / v33;
    let v86 = v84 + v85;
    let v87 = v6 * v86;
    let v88 = S::select(b0, v87, S::constant(0.0));
    let v89 = S::select(b3, v88, S::constant(0.0));
    let v90 = v7 * p_m;
    let v91 = v6 * v90;
    let v92 = S::select(b0, v91, S::constant(0.0));
    let v93 = S::select(b3, v92, S::constant(0.0));
    let v94 = v19 * tau;
    let v95 = p_omega * v94;
    let v96 = v95 + v4;
    let v97 = v2 * v96;
    let v98 = v7 * v97;
    let v99 = S::select(b0, v98, S::constant(0.0));
    let v100 = v0 * v97;
    let v101 = -v100;
    let v102 = S::select(b0, v101, S::constant(0.0));
    let v103 = S::select(b0, v100, S::constant(0.0));
    let v104 = S::select(b1, v102, v103);
    let v105 = v4 * tau;
    let v106 = p_omega * v105;
    let v107 = v19 - v106;
    let v108 = p_omega * v107;
    let v109 = v20 + v108;
    let v110 = v2 * v109;
    let v111 = p_m * v110;
    let v112 = v2 * v105;
    let v113 = v66 * v112;
    let v114 = v111 + v113;
    let v115 = v6 * v114;
    let v116 = S::select(b0, v115, S::constant(0.0));
    let v117 = v35 * v97;
    let v118 = v116 + v117;
    let v119 = S::select(b0, v118, S::constant(0.0));
    let v120 = S::select(b3, v119, S::constant(0.0));
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (
        product,
        (((&[dx_q_theta, dx_p_theta], _), &[dp_l_s, dp_l_b, dp_m, dp_g, _, dp_omega]), _),
    ) in products.iter_mut().zip(directions) {
        *product = [
            v39 * dx_q_theta + v0 * dx_p_theta + v58 * dp_l_s + v99 * dp_omega,
            v42 * dx_q_theta + v49 * dx_p_theta + v63 * dp_l_s + v104 * dp_omega,
            v47 * dx_q_theta + v55 * dx_p_theta + v75 * dp_l_s + v81 * dp_l_b
                + v89 * dp_m + v93 * dp_g + v120 * dp_omega,
        ];
    }
    ([v11, v18, v38], products)
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
