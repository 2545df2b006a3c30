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
    type Clock<S: scalar::Scalar> = [S; CLOCK_TERMS];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn clock<S: scalar::Scalar>(
        mode: usize,
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; CLOCK_TERMS] {
        match mode {
            0 => clock_stance(env),
            _ => [nan(); CLOCK_TERMS],
        }
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
        match mode {
            0 => staged_flow_stance(x, dx, clock, env),
            _ => (nan_state(), [nan_state(); C]),
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
/// 3 additions, 4 multiplications, 2 fused multiply-adds, 3 divisions, 2 function calls, 2 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = x_q_theta.sin();
    let v9 = v3 * p_omega;
    let v10 = v0 * v9;
    let v11 = v10 * x_p_theta;
    let v12 = -v11;
    let v13 = S::select(b0, v12, S::constant(0.0));
    let v14 = v13 / v6;
    let v15 = p_g.mul_add(v8, v14);
    let v16 = -v15;
    [v7, v16]
}

/// State derivative f and integrands of mode `stance`.
///
/// 7 additions, 14 multiplications, 5 fused multiply-adds, 4 divisions, 2 function calls, 8 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let (v8, v9) = x_q_theta.sin_cos();
    let v10 = v3 * p_omega;
    let v11 = v0 * v10;
    let v12 = v11 * x_p_theta;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = v14 / v6;
    let v16 = p_g.mul_add(v8, v15);
    let v17 = -v16;
    let v18 = v11 * v9;
    let v19 = -v18;
    let v20 = S::select(b0, v19, S::constant(0.0));
    let v21 = x_p_theta.mul_add(v8, -v20);
    let v22 = v11 * v8;
    let v23 = -v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = x_p_theta.mul_add(v9, v24);
    let v26 = -v25;
    let v27 = S::select(b1, v25, v26);
    let v28 = v2 * p_omega;
    let v29 = p_omega * v28;
    let v30 = v0 * v29;
    let v31 = p_m * v30;
    let v32 = S::select(b0, v31, S::constant(0.0));
    let v33 = p_m * p_g;
    let v34 = v33.mul_add(v9, v32);
    let v35 = x_p_theta * x_p_theta;
    let v36 = p_m * v35;
    let v37 = v36 / v6;
    let v38 = v34 + v37;
    let v39 = v38 * v11;
    let v40 = S::select(b0, v39, S::constant(0.0));
    let v41 = S::select(b3, v40, S::constant(0.0));
    ([v7, v17], [v21, v27, v41])
}

/// Residual F = M k - f of mode `stance`, k the rates of the states.
///
/// 4 additions, 4 multiplications, 2 fused multiply-adds, 3 divisions, 2 function calls, 2 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = k_q_theta - v7;
    let v9 = x_q_theta.sin();
    let v10 = v3 * p_omega;
    let v11 = v0 * v10;
    let v12 = v11 * x_p_theta;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = v14 / v6;
    let v16 = p_g.mul_add(v9, v15);
    let v17 = k_p_theta + v16;
    [v8, v17]
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
/// 1 addition, 4 multiplications, 1 fused multiply-add, 1 division, 2 function calls, 1 selection.
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
    let (v5, v6) = x_q_theta.sin_cos();
    let v7 = v4 * v5;
    let v8 = -v7;
    let v9 = S::select(b0, v8, S::constant(0.0));
    let v10 = x_p_theta.mul_add(v6, v9);
    v10
}

/// Switching function 2, not negative where `abs(rho_a)`.
///
/// 2 additions, 8 multiplications, 2 fused multiply-adds, 2 divisions, 2 function calls, 2 selections.
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
    let v10 = v8.mul_add(v9, v7);
    let v11 = x_p_theta * x_p_theta;
    let v12 = p_m * v11;
    let v13 = S::constant(1.0) + v2;
    let v14 = v0.mul_add(v13, p_l_b);
    let v15 = S::select(b0, v14, p_l_b);
    let v16 = v12 / v15;
    let v17 = v10 + v16;
    v17
}

/// Switching function 3, not negative where `max(power, 0)`.
///
/// 2 additions, 11 multiplications, 2 fused multiply-adds, 2 divisions, 2 function calls, 3 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = v2 * p_omega;
    let v5 = p_omega * v4;
    let v6 = v0 * v5;
    let v7 = p_m * v6;
    let v8 = S::select(b0, v7, S::constant(0.0));
    let v9 = p_m * p_g;
    let v10 = x_q_theta.cos();
    let v11 = v9.mul_add(v10, v8);
    let v12 = x_p_theta * x_p_theta;
    let v13 = p_m * v12;
    let v14 = S::constant(1.0) + v2;
    let v15 = v0.mul_add(v14, p_l_b);
    let v16 = S::select(b0, v15, p_l_b);
    let v17 = v13 / v16;
    let v18 = v11 + v17;
    let v19 = v3 * p_omega;
    let v20 = v0 * v19;
    let v21 = v18 * v20;
    let v22 = S::select(b0, v21, S::constant(0.0));
    v22
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
/// 2 additions, 1 multiplication, 1 fused multiply-add, 2 function calls.
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
    let v2 = v0.mul_add(v1, x_q_theta);
    let v3 = v0.cos();
    let v4 = v3 * x_p_theta;
    let v5 = n_n + S::constant(1.0);
    ([v2, v4], [v5])
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
/// 9 additions, 22 multiplications, 6 fused multiply-adds, 10 divisions, 2 function calls, 10 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let (v8, v9) = x_q_theta.sin_cos();
    let v10 = v3 * p_omega;
    let v11 = v0 * v10;
    let v12 = v11 * x_p_theta;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = v14 / v6;
    let v16 = p_g.mul_add(v8, v15);
    let v17 = -v16;
    let v18 = p_g * v9;
    let v19 = -v18;
    let v20 = S::constant(1.0) / v6;
    let v21 = v11 / v6;
    let v22 = S::select(b0, v21, S::constant(0.0));
    let v23 = v7 / v6;
    let v24 = S::constant(0.5) * v4;
    let v25 = v23 * v24;
    let v26 = -v25;
    let v27 = S::select(b0, v26, S::constant(0.0));
    let v28 = S::constant(0.5) * v10;
    let v29 = x_p_theta * v28;
    let v30 = v29 / v6;
    let v31 = v15 / v6;
    let v32 = v31.mul_add(v24, v30);
    let v33 = S::select(b0, v32, S::constant(0.0));
    let v34 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v35 = v23 * v34;
    let v36 = -v35;
    let v37 = v31 * v34;
    let v38 = -v8;
    let v39 = v3 * tau;
    let v40 = v0 * v39;
    let v41 = v23 * v40;
    let v42 = S::select(b0, v41, S::constant(0.0));
    let v43 = v2 * tau;
    let v44 = p_omega.mul_add(v43, v3);
    let v45 = v0 * v44;
    let v46 = x_p_theta * v45;
    let v47 = v46 / v6;
    let v48 = v31.mul_add(v40, -v47);
    let v49 = -v48;
    let v50 = S::select(b0, v49, S::constant(0.0));
    let v51 = v23 * v11;
    let v52 = S::select(b0, v51, S::constant(0.0));
    let v53 = v2 * p_omega;
    let v54 = p_omega * v53;
    let v55 = v0 * v54;
    let v56 = x_p_theta * v55;
    let v57 = v56 / v6;
    let v58 = v31.mul_add(v11, -v57);
    let v59 = -v58;
    let v60 = S::select(b0, v59, S::constant(0.0));
    model::Jacobian {
        value: [v7, v17],
        dx: [[S::constant(0.0), v19], [v20, v22]],
        dp: [
            [v27, v33],
            [v36, v37],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v38],
            [S::constant(0.0), S::constant(0.0)],
            [v42, v50],
        ],
        dtau: [v52, v60],
        dt: [S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `stance` with all first derivatives, by columns.
///
/// 10 additions, 22 multiplications, 6 fused multiply-adds, 10 divisions, 2 function calls, 10 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = k_q_theta - v7;
    let (v9, v10) = x_q_theta.sin_cos();
    let v11 = v3 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = p_g.mul_add(v9, v16);
    let v18 = k_p_theta + v17;
    let v19 = p_g * v10;
    let v20 = S::constant(1.0) / v6;
    let v21 = -v20;
    let v22 = v12 / v6;
    let v23 = -v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = v7 / v6;
    let v26 = S::constant(0.5) * v4;
    let v27 = v25 * v26;
    let v28 = S::select(b0, v27, S::constant(0.0));
    let v29 = S::constant(0.5) * v11;
    let v30 = x_p_theta * v29;
    let v31 = v30 / v6;
    let v32 = v16 / v6;
    let v33 = v32.mul_add(v26, v31);
    let v34 = -v33;
    let v35 = S::select(b0, v34, S::constant(0.0));
    let v36 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v37 = v25 * v36;
    let v38 = v32 * v36;
    let v39 = -v38;
    let v40 = v3 * tau;
    let v41 = v0 * v40;
    let v42 = v25 * v41;
    let v43 = -v42;
    let v44 = S::select(b0, v43, S::constant(0.0));
    let v45 = v2 * tau;
    let v46 = p_omega.mul_add(v45, v3);
    let v47 = v0 * v46;
    let v48 = x_p_theta * v47;
    let v49 = v48 / v6;
    let v50 = v32.mul_add(v41, -v49);
    let v51 = S::select(b0, v50, S::constant(0.0));
    let v52 = v25 * v12;
    let v53 = -v52;
    let v54 = S::select(b0, v53, S::constant(0.0));
    let v55 = v2 * p_omega;
    let v56 = p_omega * v55;
    let v57 = v0 * v56;
    let v58 = x_p_theta * v57;
    let v59 = v58 / v6;
    let v60 = v32.mul_add(v12, -v59);
    let v61 = S::select(b0, v60, S::constant(0.0));
    model::ResidualJacobian {
        value: [v8, v18],
        dx: [[S::constant(0.0), v19], [v21, v24]],
        dk: [[S::constant(1.0), S::constant(0.0)], [S::constant(0.0), S::constant(1.0)]],
        dp: [
            [v28, v35],
            [v37, v39],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v9],
            [S::constant(0.0), S::constant(0.0)],
            [v44, v51],
        ],
        dtau: [v54, v61],
        dt: [S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `stance` with its derivatives by state and rate, by columns.
///
/// 6 additions, 5 multiplications, 2 fused multiply-adds, 5 divisions, 2 function calls, 3 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let v8 = k_q_theta - v7;
    let (v9, v10) = x_q_theta.sin_cos();
    let v11 = v3 * p_omega;
    let v12 = v0 * v11;
    let v13 = v12 * x_p_theta;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = v15 / v6;
    let v17 = p_g.mul_add(v9, v16);
    let v18 = k_p_theta + v17;
    let v19 = p_g * v10;
    let v20 = S::constant(1.0) / v6;
    let v21 = -v20;
    let v22 = v12 / v6;
    let v23 = -v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    model::Linearised {
        value: [v8, v18],
        dx: [[S::constant(0.0), v19], [v21, v24]],
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
/// 5 additions, 14 multiplications, 3 fused multiply-adds, 1 division, 2 function calls, 5 selections.
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
    let (v2, v3) = v1.sin_cos();
    let v4 = v2 * p_omega;
    let v5 = v0 * v4;
    let (v6, v7) = x_q_theta.sin_cos();
    let v8 = v5 * v6;
    let v9 = -v8;
    let v10 = S::select(b0, v9, S::constant(0.0));
    let v11 = x_p_theta.mul_add(v7, v10);
    let v12 = v5 * v7;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = (-x_p_theta).mul_add(v6, v14);
    let v16 = S::constant(0.5) * v4;
    let v17 = v6 * v16;
    let v18 = -v17;
    let v19 = S::select(b0, v18, S::constant(0.0));
    let v20 = v3 * tau;
    let v21 = p_omega.mul_add(v20, v2);
    let v22 = v0 * v21;
    let v23 = v6 * v22;
    let v24 = -v23;
    let v25 = S::select(b0, v24, S::constant(0.0));
    let v26 = v3 * p_omega;
    let v27 = p_omega * v26;
    let v28 = v0 * v27;
    let v29 = v6 * v28;
    let v30 = -v29;
    let v31 = S::select(b0, v30, S::constant(0.0));
    model::Gradient {
        value: v11,
        dx: [v15, v7],
        dp: [
            v19,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v25,
        ],
        dtau: v31,
        dt: S::constant(0.0),
    }
}

/// Switching function 2 with all first derivatives.
///
/// 8 additions, 27 multiplications, 6 fused multiply-adds, 5 divisions, 2 function calls, 7 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = v2 * p_omega;
    let v5 = p_omega * v4;
    let v6 = v0 * v5;
    let v7 = p_m * v6;
    let v8 = S::select(b0, v7, S::constant(0.0));
    let v9 = p_m * p_g;
    let (v11, v10) = x_q_theta.sin_cos();
    let v12 = v9.mul_add(v10, v8);
    let v13 = x_p_theta * x_p_theta;
    let v14 = p_m * v13;
    let v15 = S::constant(1.0) + v2;
    let v16 = v0.mul_add(v15, p_l_b);
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v14 / v17;
    let v19 = v12 + v18;
    let v20 = v9 * v11;
    let v21 = -v20;
    let v22 = x_p_theta + x_p_theta;
    let v23 = p_m * v22;
    let v24 = v23 / v17;
    let v25 = S::constant(0.5) * v5;
    let v26 = p_m * v25;
    let v27 = v18 / v17;
    let v28 = S::constant(0.5) * v15;
    let v29 = v27 * v28;
    let v30 = v26 - v29;
    let v31 = S::select(b0, v30, S::constant(0.0));
    let v32 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v33 = v27 * v32;
    let v34 = -v33;
    let v35 = S::select(b0, v6, S::constant(0.0));
    let v36 = v10.mul_add(p_g, v35);
    let v37 = v13 / v17;
    let v38 = v36 + v37;
    let v39 = v10 * p_m;
    let v40 = v3 * tau;
    let v41 = (-p_omega).mul_add(v40, v2);
    let v42 = p_omega.mul_add(v41, v4);
    let v43 = v0 * v42;
    let v44 = p_m * v43;
    let v45 = v0 * v40;
    let v46 = v27.mul_add(v45, v44);
    let v47 = S::select(b0, v46, S::constant(0.0));
    let v48 = v3 * p_omega;
    let v49 = v0 * v48;
    let v50 = v27 * v49;
    let v51 = p_omega * v48;
    let v52 = p_omega * v51;
    let v53 = v0 * v52;
    let v54 = p_m * v53;
    let v55 = v50 - v54;
    let v56 = S::select(b0, v55, S::constant(0.0));
    model::Gradient {
        value: v19,
        dx: [v21, v24],
        dp: [v31, v34, v38, v39, S::constant(0.0), v47],
        dtau: v56,
        dt: S::constant(0.0),
    }
}

/// Switching function 3 with all first derivatives.
///
/// 8 additions, 39 multiplications, 10 fused multiply-adds, 5 divisions, 2 function calls, 16 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = v2 * p_omega;
    let v5 = p_omega * v4;
    let v6 = v0 * v5;
    let v7 = p_m * v6;
    let v8 = S::select(b0, v7, S::constant(0.0));
    let v9 = p_m * p_g;
    let (v11, v10) = x_q_theta.sin_cos();
    let v12 = v9.mul_add(v10, v8);
    let v13 = x_p_theta * x_p_theta;
    let v14 = p_m * v13;
    let v15 = S::constant(1.0) + v2;
    let v16 = v0.mul_add(v15, p_l_b);
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v14 / v17;
    let v19 = v12 + v18;
    let v20 = v3 * p_omega;
    let v21 = v0 * v20;
    let v22 = v19 * v21;
    let v23 = S::select(b0, v22, S::constant(0.0));
    let v24 = v9 * v11;
    let v25 = v21 * v24;
    let v26 = -v25;
    let v27 = S::select(b0, v26, S::constant(0.0));
    let v28 = x_p_theta + x_p_theta;
    let v29 = p_m * v28;
    let v30 = v29 / v17;
    let v31 = v21 * v30;
    let v32 = S::select(b0, v31, S::constant(0.0));
    let v33 = S::constant(0.5) * v5;
    let v34 = p_m * v33;
    let v35 = v18 / v17;
    let v36 = S::constant(0.5) * v15;
    let v37 = v35 * v36;
    let v38 = v34 - v37;
    let v39 = v21 * v38;
    let v40 = S::select(b0, v39, S::constant(0.0));
    let v41 = S::constant(0.5) * v20;
    let v42 = v19.mul_add(v41, v40);
    let v43 = S::select(b0, v42, S::constant(0.0));
    let v44 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v45 = v35 * v44;
    let v46 = v21 * v45;
    let v47 = -v46;
    let v48 = S::select(b0, v47, S::constant(0.0));
    let v49 = S::select(b0, v6, S::constant(0.0));
    let v50 = v10.mul_add(p_g, v49);
    let v51 = v13 / v17;
    let v52 = v50 + v51;
    let v53 = v21 * v52;
    let v54 = S::select(b0, v53, S::constant(0.0));
    let v55 = v10 * p_m;
    let v56 = v21 * v55;
    let v57 = S::select(b0, v56, S::constant(0.0));
    let v58 = v3 * tau;
    let v59 = (-p_omega).mul_add(v58, v2);
    let v60 = p_omega.mul_add(v59, v4);
    let v61 = v0 * v60;
    let v62 = p_m * v61;
    let v63 = v0 * v58;
    let v64 = v35.mul_add(v63, v62);
    let v65 = v21 * v64;
    let v66 = S::select(b0, v65, S::constant(0.0));
    let v67 = v2 * tau;
    let v68 = p_omega.mul_add(v67, v3);
    let v69 = v0 * v68;
    let v70 = v19.mul_add(v69, v66);
    let v71 = S::select(b0, v70, S::constant(0.0));
    let v72 = v35 * v21;
    let v73 = p_omega * v20;
    let v74 = p_omega * v73;
    let v75 = v0 * v74;
    let v76 = p_m * v75;
    let v77 = v72 - v76;
    let v78 = v21 * v77;
    let v79 = S::select(b0, v78, S::constant(0.0));
    let v80 = v19.mul_add(v6, v79);
    let v81 = S::select(b0, v80, S::constant(0.0));
    model::Gradient {
        value: v23,
        dx: [v27, v32],
        dp: [v43, v48, v54, v57, S::constant(0.0), v71],
        dtau: v81,
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
/// 4 additions, 2 multiplications, 1 fused multiply-add, 2 function calls.
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
    let v2 = v0.mul_add(v1, x_q_theta);
    let (v4, v3) = v0.sin_cos();
    let v5 = v3 * x_p_theta;
    let v6 = v1 + v1;
    let v7 = -v4;
    let v8 = v7 - v4;
    let v9 = x_p_theta * v8;
    model::Jacobian {
        value: [v2, v5],
        dx: [[S::constant(1.0), S::constant(0.0)], [S::constant(0.0), v3]],
        dp: [
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0)],
            [v6, v9],
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
/// 5 additions, 13 multiplications, 4 fused multiply-adds, 2 divisions, 2 function calls, 7 selections.
fn integrands<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; INTEGRALS] {
    let &[_] = env.memory else { return [nan(); INTEGRALS] };
    let &[b0, b1, _, b3] = env.branch else { return [nan(); INTEGRALS] };
    let &[p_l_s, p_l_b, p_m, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let &[x_q_theta, x_p_theta] = x;
    let (v0, v1) = x_q_theta.sin_cos();
    let v2 = p_l_s / S::constant(2.0);
    let v3 = p_omega * tau;
    let (v4, v5) = v3.sin_cos();
    let v6 = v4 * p_omega;
    let v7 = v2 * v6;
    let v8 = v7 * v1;
    let v9 = -v8;
    let v10 = S::select(b0, v9, S::constant(0.0));
    let v11 = x_p_theta.mul_add(v0, -v10);
    let v12 = v7 * v0;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = x_p_theta.mul_add(v1, v14);
    let v16 = -v15;
    let v17 = S::select(b1, v15, v16);
    let v18 = v5 * p_omega;
    let v19 = p_omega * v18;
    let v20 = v2 * v19;
    let v21 = p_m * v20;
    let v22 = S::select(b0, v21, S::constant(0.0));
    let v23 = p_m * p_g;
    let v24 = v23.mul_add(v1, v22);
    let v25 = x_p_theta * x_p_theta;
    let v26 = p_m * v25;
    let v27 = S::constant(1.0) + v5;
    let v28 = v2.mul_add(v27, p_l_b);
    let v29 = S::select(b0, v28, p_l_b);
    let v30 = v26 / v29;
    let v31 = v24 + v30;
    let v32 = v31 * v7;
    let v33 = S::select(b0, v32, S::constant(0.0));
    let v34 = S::select(b3, v33, S::constant(0.0));
    [v11, v17, v34]
}

/// Observable 0.
///
/// 3 additions, 8 multiplications, 2 fused multiply-adds, 2 divisions, 2 function calls, 3 selections.
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
    let v10 = v8.mul_add(v9, v7);
    let v11 = x_p_theta * x_p_theta;
    let v12 = p_m * v11;
    let v13 = S::constant(1.0) + v2;
    let v14 = v0.mul_add(v13, p_l_b);
    let v15 = S::select(b0, v14, p_l_b);
    let v16 = v12 / v15;
    let v17 = v10 + v16;
    let v18 = -v17;
    let v19 = S::select(b2, v17, v18);
    v19
}

/// Observable 0 with all first derivatives.
///
/// 15 additions, 27 multiplications, 6 fused multiply-adds, 5 divisions, 2 function calls, 19 selections.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = v2 * p_omega;
    let v5 = p_omega * v4;
    let v6 = v0 * v5;
    let v7 = p_m * v6;
    let v8 = S::select(b0, v7, S::constant(0.0));
    let v9 = p_m * p_g;
    let (v11, v10) = x_q_theta.sin_cos();
    let v12 = v9.mul_add(v10, v8);
    let v13 = x_p_theta * x_p_theta;
    let v14 = p_m * v13;
    let v15 = S::constant(1.0) + v2;
    let v16 = v0.mul_add(v15, p_l_b);
    let v17 = S::select(b0, v16, p_l_b);
    let v18 = v14 / v17;
    let v19 = v12 + v18;
    let v20 = -v19;
    let v21 = S::select(b2, v19, v20);
    let v22 = v9 * v11;
    let v23 = -v22;
    let v24 = S::select(b2, v23, v22);
    let v25 = x_p_theta + x_p_theta;
    let v26 = p_m * v25;
    let v27 = v26 / v17;
    let v28 = -v27;
    let v29 = S::select(b2, v27, v28);
    let v30 = S::constant(0.5) * v5;
    let v31 = p_m * v30;
    let v32 = v18 / v17;
    let v33 = S::constant(0.5) * v15;
    let v34 = v32 * v33;
    let v35 = v31 - v34;
    let v36 = S::select(b0, v35, S::constant(0.0));
    let v37 = -v35;
    let v38 = S::select(b0, v37, S::constant(0.0));
    let v39 = S::select(b2, v36, v38);
    let v40 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v41 = v32 * v40;
    let v42 = -v41;
    let v43 = S::select(b2, v42, v41);
    let v44 = S::select(b0, v6, S::constant(0.0));
    let v45 = v10.mul_add(p_g, v44);
    let v46 = v13 / v17;
    let v47 = v45 + v46;
    let v48 = -v47;
    let v49 = S::select(b2, v47, v48);
    let v50 = v10 * p_m;
    let v51 = -v50;
    let v52 = S::select(b2, v50, v51);
    let v53 = v3 * tau;
    let v54 = (-p_omega).mul_add(v53, v2);
    let v55 = p_omega.mul_add(v54, v4);
    let v56 = v0 * v55;
    let v57 = p_m * v56;
    let v58 = v0 * v53;
    let v59 = v32.mul_add(v58, v57);
    let v60 = S::select(b0, v59, S::constant(0.0));
    let v61 = -v59;
    let v62 = S::select(b0, v61, S::constant(0.0));
    let v63 = S::select(b2, v60, v62);
    let v64 = v3 * p_omega;
    let v65 = v0 * v64;
    let v66 = v32 * v65;
    let v67 = p_omega * v64;
    let v68 = p_omega * v67;
    let v69 = v0 * v68;
    let v70 = p_m * v69;
    let v71 = v66 - v70;
    let v72 = S::select(b0, v71, S::constant(0.0));
    let v73 = -v71;
    let v74 = S::select(b0, v73, S::constant(0.0));
    let v75 = S::select(b2, v72, v74);
    model::RateGradient {
        value: v21,
        dx: [v24, v29],
        dk: [S::constant(0.0), S::constant(0.0)],
        dp: [v39, v43, v49, v52, S::constant(0.0), v63],
        dtau: v75,
        dt: S::constant(0.0),
    }
}

/// State derivative f of mode `stance` and, for each column v, (df/dx) v.
///
/// Once: 4 additions, 5 multiplications, 2 fused multiply-adds, 5 divisions, 2 function calls, 3 selections. A column: 2 multiplications, 1 fused multiply-add.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let (v8, v9) = x_q_theta.sin_cos();
    let v10 = v3 * p_omega;
    let v11 = v0 * v10;
    let v12 = v11 * x_p_theta;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = v14 / v6;
    let v16 = p_g.mul_add(v8, v15);
    let v17 = -v16;
    let v18 = p_g * v9;
    let v19 = -v18;
    let v20 = S::constant(1.0) / v6;
    let v21 = v11 / v6;
    let v22 = S::select(b0, v21, S::constant(0.0));
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_q_theta, dx_p_theta] = column;
        *product = [v20 * dx_p_theta, v22.mul_add(dx_p_theta, v19 * dx_q_theta)];
    }
    ([v7, v17], products)
}

/// State derivative f and integrands of mode `stance` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 25 additions, 49 multiplications, 12 fused multiply-adds, 13 divisions, 2 function calls, 41 selections. A column: 5 multiplications, 20 fused multiply-adds.
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
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = x_p_theta / v6;
    let (v8, v9) = x_q_theta.sin_cos();
    let v10 = v3 * p_omega;
    let v11 = v0 * v10;
    let v12 = v11 * x_p_theta;
    let v13 = -v12;
    let v14 = S::select(b0, v13, S::constant(0.0));
    let v15 = v14 / v6;
    let v16 = p_g.mul_add(v8, v15);
    let v17 = -v16;
    let v18 = x_p_theta * v8;
    let v19 = v11 * v9;
    let v20 = -v19;
    let v21 = S::select(b0, v20, S::constant(0.0));
    let v22 = v18 - v21;
    let v23 = v11 * v8;
    let v24 = -v23;
    let v25 = S::select(b0, v24, S::constant(0.0));
    let v26 = x_p_theta * v9;
    let v27 = v25 + v26;
    let v28 = -v27;
    let v29 = S::select(b1, v27, v28);
    let v30 = v2 * p_omega;
    let v31 = p_omega * v30;
    let v32 = v0 * v31;
    let v33 = p_m * v32;
    let v34 = S::select(b0, v33, S::constant(0.0));
    let v35 = p_m * p_g;
    let v36 = v35.mul_add(v9, v34);
    let v37 = x_p_theta * x_p_theta;
    let v38 = p_m * v37;
    let v39 = v38 / v6;
    let v40 = v36 + v39;
    let v41 = v40 * v11;
    let v42 = S::select(b0, v41, S::constant(0.0));
    let v43 = S::select(b3, v42, S::constant(0.0));
    let v44 = p_g * v9;
    let v45 = -v44;
    let v46 = v26 + v25;
    let v47 = v21 - v18;
    let v48 = -v47;
    let v49 = S::select(b1, v47, v48);
    let v50 = v35 * v8;
    let v51 = v11 * v50;
    let v52 = -v51;
    let v53 = S::select(b0, v52, S::constant(0.0));
    let v54 = S::select(b3, v53, S::constant(0.0));
    let v55 = S::constant(1.0) / v6;
    let v56 = v11 / v6;
    let v57 = S::select(b0, v56, S::constant(0.0));
    let v58 = -v9;
    let v59 = S::select(b1, v9, v58);
    let v60 = x_p_theta + x_p_theta;
    let v61 = p_m * v60;
    let v62 = v61 / v6;
    let v63 = v11 * v62;
    let v64 = S::select(b0, v63, S::constant(0.0));
    let v65 = S::select(b3, v64, S::constant(0.0));
    let v66 = v7 / v6;
    let v67 = S::constant(0.5) * v4;
    let v68 = v66 * v67;
    let v69 = -v68;
    let v70 = S::select(b0, v69, S::constant(0.0));
    let v71 = S::constant(0.5) * v10;
    let v72 = x_p_theta * v71;
    let v73 = v72 / v6;
    let v74 = v15 / v6;
    let v75 = v74.mul_add(v67, v73);
    let v76 = S::select(b0, v75, S::constant(0.0));
    let v77 = v9 * v71;
    let v78 = S::select(b0, v77, S::constant(0.0));
    let v79 = v8 * v71;
    let v80 = -v79;
    let v81 = S::select(b0, v80, S::constant(0.0));
    let v82 = S::select(b0, v79, S::constant(0.0));
    let v83 = S::select(b1, v81, v82);
    let v84 = S::constant(0.5) * v31;
    let v85 = p_m * v84;
    let v86 = v39 / v6;
    let v87 = v86 * v67;
    let v88 = v85 - v87;
    let v89 = v11 * v88;
    let v90 = S::select(b0, v89, S::constant(0.0));
    let v91 = v40.mul_add(v71, v90);
    let v92 = S::select(b0, v91, S::constant(0.0));
    let v93 = S::select(b3, v92, S::constant(0.0));
    let v94 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v95 = v66 * v94;
    let v96 = -v95;
    let v97 = v74 * v94;
    let v98 = v86 * v94;
    let v99 = v11 * v98;
    let v100 = -v99;
    let v101 = S::select(b0, v100, S::constant(0.0));
    let v102 = S::select(b3, v101, S::constant(0.0));
    let v103 = S::select(b0, v32, S::constant(0.0));
    let v104 = v9.mul_add(p_g, v103);
    let v105 = v37 / v6;
    let v106 = v104 + v105;
    let v107 = v11 * v106;
    let v108 = S::select(b0, v107, S::constant(0.0));
    let v109 = S::select(b3, v108, S::constant(0.0));
    let v110 = -v8;
    let v111 = v9 * p_m;
    let v112 = v11 * v111;
    let v113 = S::select(b0, v112, S::constant(0.0));
    let v114 = S::select(b3, v113, S::constant(0.0));
    let v115 = v3 * tau;
    let v116 = v0 * v115;
    let v117 = v66 * v116;
    let v118 = S::select(b0, v117, S::constant(0.0));
    let v119 = v2 * tau;
    let v120 = p_omega.mul_add(v119, v3);
    let v121 = v0 * v120;
    let v122 = x_p_theta * v121;
    let v123 = v122 / v6;
    let v124 = v74.mul_add(v116, -v123);
    let v125 = -v124;
    let v126 = S::select(b0, v125, S::constant(0.0));
    let v127 = v9 * v121;
    let v128 = S::select(b0, v127, S::constant(0.0));
    let v129 = v8 * v121;
    let v130 = -v129;
    let v131 = S::select(b0, v130, S::constant(0.0));
    let v132 = S::select(b0, v129, S::constant(0.0));
    let v133 = S::select(b1, v131, v132);
    let v134 = (-p_omega).mul_add(v115, v2);
    let v135 = p_omega.mul_add(v134, v30);
    let v136 = v0 * v135;
    let v137 = p_m * v136;
    let v138 = v86.mul_add(v116, v137);
    let v139 = v11 * v138;
    let v140 = S::select(b0, v139, S::constant(0.0));
    let v141 = v40.mul_add(v121, v140);
    let v142 = S::select(b0, v141, S::constant(0.0));
    let v143 = S::select(b3, v142, S::constant(0.0));
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[dx_q_theta, dx_p_theta] = dx;
        let &[dp_l_s, dp_l_b, dp_m, dp_g, _, dp_omega] = dp;
        *dflow = [
            v118
                .mul_add(
                    dp_omega,
                    v96.mul_add(dp_l_b, v70.mul_add(dp_l_s, v55 * dx_p_theta)),
                ),
            v126
                .mul_add(
                    dp_omega,
                    v110
                        .mul_add(
                            dp_g,
                            v97
                                .mul_add(
                                    dp_l_b,
                                    v76
                                        .mul_add(dp_l_s, v57.mul_add(dx_p_theta, v45 * dx_q_theta)),
                                ),
                        ),
                ),
        ];
        *dintegrands = [
            v128
                .mul_add(
                    dp_omega,
                    v78.mul_add(dp_l_s, v8.mul_add(dx_p_theta, v46 * dx_q_theta)),
                ),
            v133
                .mul_add(
                    dp_omega,
                    v83.mul_add(dp_l_s, v59.mul_add(dx_p_theta, v49 * dx_q_theta)),
                ),
            v143
                .mul_add(
                    dp_omega,
                    v114
                        .mul_add(
                            dp_g,
                            v109
                                .mul_add(
                                    dp_m,
                                    v102
                                        .mul_add(
                                            dp_l_b,
                                            v93
                                                .mul_add(dp_l_s, v65.mul_add(dx_p_theta, v54 * dx_q_theta)),
                                        ),
                                ),
                        ),
                ),
        ];
    }
    model::Integrated {
        flow: [v7, v17],
        integrands: [v22, v29, v43],
        dflow,
        dintegrands,
    }
}

/// The integrands and their derivatives along each direction.
///
/// Once: 18 additions, 41 multiplications, 9 fused multiply-adds, 5 divisions, 2 function calls, 35 selections. A column: 3 multiplications, 12 fused multiply-adds.
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
    let (v0, v1) = x_q_theta.sin_cos();
    let v2 = x_p_theta * v0;
    let v3 = p_l_s / S::constant(2.0);
    let v4 = p_omega * tau;
    let (v5, v6) = v4.sin_cos();
    let v7 = v5 * p_omega;
    let v8 = v3 * v7;
    let v9 = v8 * v1;
    let v10 = -v9;
    let v11 = S::select(b0, v10, S::constant(0.0));
    let v12 = v2 - v11;
    let v13 = v8 * v0;
    let v14 = -v13;
    let v15 = S::select(b0, v14, S::constant(0.0));
    let v16 = x_p_theta * v1;
    let v17 = v15 + v16;
    let v18 = -v17;
    let v19 = S::select(b1, v17, v18);
    let v20 = v6 * p_omega;
    let v21 = p_omega * v20;
    let v22 = v3 * v21;
    let v23 = p_m * v22;
    let v24 = S::select(b0, v23, S::constant(0.0));
    let v25 = p_m * p_g;
    let v26 = v25.mul_add(v1, v24);
    let v27 = x_p_theta * x_p_theta;
    let v28 = p_m * v27;
    let v29 = S::constant(1.0) + v6;
    let v30 = v3.mul_add(v29, p_l_b);
    let v31 = S::select(b0, v30, p_l_b);
    let v32 = v28 / v31;
    let v33 = v26 + v32;
    let v34 = v33 * v8;
    let v35 = S::select(b0, v34, S::constant(0.0));
    let v36 = S::select(b3, v35, S::constant(0.0));
    let v37 = v16 + v15;
    let v38 = v11 - v2;
    let v39 = -v38;
    let v40 = S::select(b1, v38, v39);
    let v41 = v25 * v0;
    let v42 = v8 * v41;
    let v43 = -v42;
    let v44 = S::select(b0, v43, S::constant(0.0));
    let v45 = S::select(b3, v44, S::constant(0.0));
    let v46 = -v1;
    let v47 = S::select(b1, v1, v46);
    let v48 = x_p_theta + x_p_theta;
    let v49 = p_m * v48;
    let v50 = v49 / v31;
    let v51 = v8 * v50;
    let v52 = S::select(b0, v51, S::constant(0.0));
    let v53 = S::select(b3, v52, S::constant(0.0));
    let v54 = S::constant(0.5) * v7;
    let v55 = v1 * v54;
    let v56 = S::select(b0, v55, S::constant(0.0));
    let v57 = v0 * v54;
    let v58 = -v57;
    let v59 = S::select(b0, v58, S::constant(0.0));
    let v60 = S::select(b0, v57, S::constant(0.0));
    let v61 = S::select(b1, v59, v60);
    let v62 = S::constant(0.5) * v21;
    let v63 = p_m * v62;
    let v64 = v32 / v31;
    let v65 = S::constant(0.5) * v29;
    let v66 = v64 * v65;
    let v67 = v63 - v66;
    let v68 = v8 * v67;
    let v69 = S::select(b0, v68, S::constant(0.0));
    let v70 = v33.mul_add(v54, v69);
    let v71 = S::select(b0, v70, S::constant(0.0));
    let v72 = S::select(b3, v71, S::constant(0.0));
    let v73 = S::select(b0, S::constant(1.0), S::constant(1.0));
    let v74 = v64 * v73;
    let v75 = v8 * v74;
    let v76 = -v75;
    let v77 = S::select(b0, v76, S::constant(0.0));
    let v78 = S::select(b3, v77, S::constant(0.0));
    let v79 = S::select(b0, v22, S::constant(0.0));
    let v80 = v1.mul_add(p_g, v79);
    let v81 = v27 / v31;
    let v82 = v80 + v81;
    let v83 = v8 * v82;
    let v84 = S::select(b0, v83, S::constant(0.0));
    let v85 = S::select(b3, v84, S::constant(0.0));
    let v86 = v1 * p_m;
    let v87 = v8 * v86;
    let v88 = S::select(b0, v87, S::constant(0.0));
    let v89 = S::select(b3, v88, S::constant(0.0));
    let v90 = v6 * tau;
    let v91 = p_omega.mul_add(v90, v5);
    let v92 = v3 * v91;
    let v93 = v1 * v92;
    let v94 = S::select(b0, v93, S::constant(0.0));
    let v95 = v0 * v92;
    let v96 = -v95;
    let v97 = S::select(b0, v96, S::constant(0.0));
    let v98 = S::select(b0, v95, S::constant(0.0));
    let v99 = S::select(b1, v97, v98);
    let v100 = v5 * tau;
    let v101 = (-p_omega).mul_add(v100, v6);
    let v102 = p_omega.mul_add(v101, v20);
    let v103 = v3 * v102;
    let v104 = p_m * v103;
    let v105 = v3 * v100;
    let v106 = v64.mul_add(v105, v104);
    let v107 = v8 * v106;
    let v108 = S::select(b0, v107, S::constant(0.0));
    let v109 = v33.mul_add(v92, v108);
    let v110 = S::select(b0, v109, S::constant(0.0));
    let v111 = S::select(b3, v110, S::constant(0.0));
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (
        product,
        (((&[dx_q_theta, dx_p_theta], _), &[dp_l_s, dp_l_b, dp_m, dp_g, _, dp_omega]), _),
    ) in products.iter_mut().zip(directions) {
        *product = [
            v94
                .mul_add(
                    dp_omega,
                    v56.mul_add(dp_l_s, v0.mul_add(dx_p_theta, v37 * dx_q_theta)),
                ),
            v99
                .mul_add(
                    dp_omega,
                    v61.mul_add(dp_l_s, v47.mul_add(dx_p_theta, v40 * dx_q_theta)),
                ),
            v111
                .mul_add(
                    dp_omega,
                    v89
                        .mul_add(
                            dp_g,
                            v85
                                .mul_add(
                                    dp_m,
                                    v78
                                        .mul_add(
                                            dp_l_b,
                                            v72
                                                .mul_add(dp_l_s, v53.mul_add(dx_p_theta, v45 * dx_q_theta)),
                                        ),
                                ),
                        ),
                ),
        ];
    }
    ([v12, v19, v36], products)
}

/// Number of terms that depend only on the clock, on parameters, memory and selectors: the most of any mode.
const CLOCK_TERMS: usize = 4;

/// The terms of mode `stance`'s flow that do not depend on the state.
///
/// 4 additions, 5 multiplications, 1 fused multiply-add, 2 divisions, 1 function call, 3 selections.
#[cfg_attr(not(debug_assertions), inline(always))]
fn clock_stance<S: scalar::Scalar>(
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; CLOCK_TERMS] {
    let &[_] = env.memory else { return [nan(); CLOCK_TERMS] };
    let &[b0, _, _, _] = env.branch else { return [nan(); CLOCK_TERMS] };
    let &[p_l_s, p_l_b, _, p_g, _, p_omega] = env.p;
    let tau = env.tau;
    let v0 = p_l_s / S::constant(2.0);
    let v1 = p_omega * tau;
    let (v3, v2) = v1.sin_cos();
    let v4 = S::constant(1.0) + v2;
    let v5 = v0.mul_add(v4, p_l_b);
    let v6 = S::select(b0, v5, p_l_b);
    let v7 = S::constant(1.0) / v6;
    let v8 = v3 * p_omega;
    let v9 = v0 * v8;
    let v10 = -v9;
    let v11 = S::select(b0, v10, S::constant(0.0));
    let v12 = v11 * v7;
    let v13 = -p_g;
    let v14 = -v12;
    let v15 = v9 * v7;
    let v16 = S::select(b0, v15, S::constant(0.0));
    [v7, v13, v14, v16]
}

/// State derivative f of mode `stance` and, for each column v, (df/dx) v, from the terms
/// that do not depend on the state.
///
/// Once: 3 multiplications, 1 fused multiply-add, 1 function call. A column: 2 multiplications, 1 fused multiply-add.
#[cfg_attr(not(debug_assertions), inline(always))]
fn staged_flow_stance<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    clock: &[S; CLOCK_TERMS],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[x_q_theta, x_p_theta] = x;
    let &[c0, c1, c2, c3] = clock;
    let (v0, v1) = x_q_theta.sin_cos();
    let v2 = c2 * x_p_theta;
    let v3 = c1.mul_add(v0, v2);
    let v4 = c0 * x_p_theta;
    let v5 = c1 * v1;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_q_theta, dx_p_theta] = column;
        *product = [c0 * dx_p_theta, c3.mul_add(dx_p_theta, v5 * dx_q_theta)];
    }
    ([v4, v3], products)
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
