//! Compiled model `every_operation`.
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
pub const PARAMETERS: usize = 4;
/// Number of time integrals.
pub const INTEGRALS: usize = 2;

/// The compiled model `every_operation`: 3 states, 4 parameters, 2 time integrals.
#[derive(Clone, Copy, Debug, Default)]
pub struct EveryOperation;

/// Names, units and structure.
static INFO: model::ModelInfo = model::ModelInfo {
    name: "every_operation",
    fingerprint: "377941fc2cae6e1023c9d7bdc70c7639623eaaddcd746162b52c676ab73fbb2e",
    parameters: &[
        model::Quantity {
            name: "a",
            si: "1",
        },
        model::Quantity {
            name: "b",
            si: "1",
        },
        model::Quantity {
            name: "c",
            si: "1",
        },
        model::Quantity {
            name: "type",
            si: "1",
        },
    ],
    states: &[
        model::Quantity {
            name: "x",
            si: "1",
        },
        model::Quantity {
            name: "Y",
            si: "1",
        },
        model::Quantity {
            name: "self",
            si: "1",
        },
    ],
    memory: &["n", "v0"],
    modes: &[
        model::ModeInfo {
            name: "first",
            switches: &[0, 1, 2, 3],
            measured_switches: &[0, 1, 2, 3],
        },
        model::ModeInfo {
            name: "second",
            switches: &[],
            measured_switches: &[0],
        },
    ],
    transitions: &[
        model::TransitionInfo {
            name: "go",
            from: 0,
            to: 1,
            direction: model::Direction::Rising,
            also_zero: &[],
        },
        model::TransitionInfo {
            name: "back",
            from: 1,
            to: 0,
            direction: model::Direction::Either,
            also_zero: &[],
        },
    ],
    switches: &["x >= 0", "max(x, Y)", "min(x, a)", "Y >= a"],
    coordinates: &[2, 0],
    section: ::core::option::Option::Some(model::Section::After(0)),
    returning: &[1],
    symmetric: true,
    functionals: &[
        model::Functional::Integral(0),
        model::Functional::Maximum(0),
        model::Functional::Start(1),
        model::Functional::End(2),
        model::Functional::Mean(0),
        model::Functional::Duration,
        model::Functional::Minimum(3),
        model::Functional::Integral(1),
    ],
    measures: &[
        model::Quantity {
            name: "area",
            si: "s",
        },
        model::Quantity {
            name: "top",
            si: "1",
        },
        model::Quantity {
            name: "first_x",
            si: "1",
        },
        model::Quantity {
            name: "average",
            si: "1",
        },
        model::Quantity {
            name: "slowest",
            si: "s",
        },
    ],
    uses_time: true,
    explicit: true,
};

impl model::Model<STATES, PARAMETERS, INTEGRALS> for EveryOperation {
    const INFO: &'static model::ModelInfo = &INFO;
    #[inline]
    fn flow<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; STATES] {
        match mode {
            0 => flow_first(x, env),
            1 => flow_second(x, env),
            _ => nan_state(),
        }
    }
    fn flow_jacobian<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        match mode {
            0 => d_flow_first(x, env),
            1 => d_flow_second(x, env),
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
            0 => tangent_flow_first(x, dx, env),
            1 => tangent_flow_second(x, dx, env),
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
            0 => integrated_first(x, env),
            1 => integrated_second(x, env),
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
            0 => tangent_integrated_first(x, dx, dp, env),
            1 => tangent_integrated_second(x, dx, dp, env),
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
            0 => clock_first(env),
            1 => clock_second(env),
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
            0 => staged_flow_first(x, dx, clock, env),
            1 => staged_flow_second(x, dx, clock, env),
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
            0 => residual_first(x, k, env),
            1 => residual_second(x, k, env),
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
            0 => d_residual_first(x, k, env),
            1 => d_residual_second(x, k, env),
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
            0 => linearised_first(x, k, env),
            1 => linearised_second(x, k, env),
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
            0 => integrands_first(x, env),
            1 => integrands_second(x, env),
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
            0 => tangent_integrands_first(x, along, env),
            1 => tangent_integrands_second(x, along, env),
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
            0 => guard_go(x, env),
            1 => guard_back(x, env),
            _ => nan(),
        }
    }
    fn guard_gradient<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        match transition {
            0 => d_guard_go(x, env),
            1 => d_guard_back(x, env),
            _ => nan_gradient(),
        }
    }
    fn when<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        match transition {
            0 => when_go(x, env),
            1 => S::constant(1.0),
            _ => nan(),
        }
    }
    fn reset<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
        memory: &mut [S],
    ) -> [S; STATES] {
        if memory.len() != 2 {
            memory.fill(nan());
            return nan_state();
        }
        let (state, after): ([S; STATES], [S; 2]) = match transition {
            0 => reset_go(x, env),
            1 => reset_back(x, env),
            _ => (nan_state(), [nan(); 2]),
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
            0 => d_reset_go(x, env),
            1 => d_reset_back(x, env),
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
            (0, 0 | 1) => observable_0(x, env),
            (1, 0 | 1) => observable_1(x, env),
            (2, 0 | 1) => observable_2(x, env),
            (3, 0) => observable_3_first(x, env),
            (3, 1) => observable_3_second(x, env),
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
            (0, 0 | 1) => d_observable_0(x, env),
            (1, 0 | 1) => d_observable_1(x, env),
            (2, 0 | 1) => d_observable_2(x, env),
            (3, 0) => d_observable_3_first(x, env),
            (3, 1) => d_observable_3_second(x, env),
            _ => nan_rate_gradient(),
        }
    }
    fn measures<S: scalar::Scalar>(
        functionals: &[S],
        p: &[S; PARAMETERS],
        out: &mut [S],
    ) {
        if out.len() != 5 {
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
        if dfunctionals.len() != 40 || dp.len() != 5 {
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

/// State derivative f of mode `first`.
/// Rates of x [s^-1], Y [s^-1], self [s^-1].
///
/// 27 additions, 7 multiplications, 5 fused multiply-adds, 7 divisions, 21 function calls, 5 selections.
fn flow_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[n_n, _] = env.memory else { return nan_state() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_state() };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1.mul_add(v3, v0);
    let v5 = v2 / S::constant(4.0);
    let v6 = v5.asin();
    let v7 = v4 + v6;
    let v8 = p_a * x_Y;
    let v9 = v8 / S::constant(4.0);
    let v10 = v9.acos();
    let v11 = v7 - v10;
    let v12 = p_b * x_x;
    let v13 = v12.atan();
    let v14 = v11 + v13;
    let v15 = x_x + S::constant(2.0);
    let v16 = x_Y + S::constant(3.0);
    let v17 = v15.atan2(v16);
    let v18 = v14 + v17;
    let v19 = v2.sinh();
    let v20 = v8.cosh();
    let v21 = v19 + v20;
    let v22 = x_self.tanh();
    let v23 = v21 + v22;
    let v24 = v12.asinh();
    let v25 = v23 + v24;
    let v26 = x_x * x_x;
    let v27 = S::constant(2.0) + v26;
    let v28 = v27.acosh();
    let v29 = v25 + v28;
    let v30 = v5.atanh();
    let v31 = v29 + v30;
    let v32 = v31 / S::constant(10.0);
    let v33 = v18 + v32;
    let v34 = x_x.mul_add(v26, v26);
    let v35 = x_x + S::constant(5.0);
    let v36 = v35 * v35;
    let v37 = S::constant(1.0) / v36;
    let v38 = v37 / S::constant(100.0);
    let v39 = v34 + v38;
    let v40 = v26 + S::constant(1.0);
    let v41 = v40.sqrt();
    let v42 = v39 + v41;
    let v43 = v40.pow(S::constant(2.5));
    let v44 = v42 + v43;
    let v45 = v40.pow(p_c);
    let v46 = v44 + v45;
    let v47 = S::constant(1.0) / v41;
    let v48 = v46 + v47;
    let v49 = v48 / S::constant(10.0);
    let v50 = -v26;
    let v51 = v50.exp();
    let v52 = S::constant(1.0) + v26;
    let v53 = v52 + p_type;
    let v54 = v53.ln();
    let v55 = v51 + v54;
    let v56 = S::constant(3.0) * t;
    let v57 = v56.cos();
    let v58 = v55.mul_add(v57, v49);
    let v59 = v58 - x_x;
    let v60 = x_x.sqrt();
    let v61 = x_x.mul_add(v60, v60);
    let v62 = S::select(b0, v61, v50);
    let v63 = x_x * x_Y;
    let v64 = S::select(b0, v63, v0);
    let v65 = S::select(b1, x_x, x_Y);
    let v66 = S::select(b2, x_x, p_a);
    let v67 = v65 + v66;
    let v68 = S::select(b3, v64, v67);
    let v69 = v62 + v68;
    let v70 = S::constant(-1.0).pow(n_n);
    let v71 = v70.mul_add(tau, v69);
    [v33, v59, v71]
}

/// State derivative f and integrands of mode `first`.
///
/// 27 additions, 8 multiplications, 5 fused multiply-adds, 7 divisions, 21 function calls, 5 selections.
fn integrated_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; INTEGRALS]) {
    let &[n_n, _] = env.memory else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[b0, b1, b2, b3] = env.branch else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1.mul_add(v3, v0);
    let v5 = v2 / S::constant(4.0);
    let v6 = v5.asin();
    let v7 = v4 + v6;
    let v8 = p_a * x_Y;
    let v9 = v8 / S::constant(4.0);
    let v10 = v9.acos();
    let v11 = v7 - v10;
    let v12 = p_b * x_x;
    let v13 = v12.atan();
    let v14 = v11 + v13;
    let v15 = x_x + S::constant(2.0);
    let v16 = x_Y + S::constant(3.0);
    let v17 = v15.atan2(v16);
    let v18 = v14 + v17;
    let v19 = v2.sinh();
    let v20 = v8.cosh();
    let v21 = v19 + v20;
    let v22 = x_self.tanh();
    let v23 = v21 + v22;
    let v24 = v12.asinh();
    let v25 = v23 + v24;
    let v26 = x_x * x_x;
    let v27 = S::constant(2.0) + v26;
    let v28 = v27.acosh();
    let v29 = v25 + v28;
    let v30 = v5.atanh();
    let v31 = v29 + v30;
    let v32 = v31 / S::constant(10.0);
    let v33 = v18 + v32;
    let v34 = x_x.mul_add(v26, v26);
    let v35 = x_x + S::constant(5.0);
    let v36 = v35 * v35;
    let v37 = S::constant(1.0) / v36;
    let v38 = v37 / S::constant(100.0);
    let v39 = v34 + v38;
    let v40 = v26 + S::constant(1.0);
    let v41 = v40.sqrt();
    let v42 = v39 + v41;
    let v43 = v40.pow(S::constant(2.5));
    let v44 = v42 + v43;
    let v45 = v40.pow(p_c);
    let v46 = v44 + v45;
    let v47 = S::constant(1.0) / v41;
    let v48 = v46 + v47;
    let v49 = v48 / S::constant(10.0);
    let v50 = -v26;
    let v51 = v50.exp();
    let v52 = S::constant(1.0) + v26;
    let v53 = v52 + p_type;
    let v54 = v53.ln();
    let v55 = v51 + v54;
    let v56 = S::constant(3.0) * t;
    let v57 = v56.cos();
    let v58 = v55.mul_add(v57, v49);
    let v59 = v58 - x_x;
    let v60 = x_x.sqrt();
    let v61 = x_x.mul_add(v60, v60);
    let v62 = S::select(b0, v61, v50);
    let v63 = x_x * x_Y;
    let v64 = S::select(b0, v63, v0);
    let v65 = S::select(b1, x_x, x_Y);
    let v66 = S::select(b2, x_x, p_a);
    let v67 = v65 + v66;
    let v68 = S::select(b3, v64, v67);
    let v69 = v62 + v68;
    let v70 = S::constant(-1.0).pow(n_n);
    let v71 = v70.mul_add(tau, v69);
    let v72 = v33 * x_Y;
    ([v33, v59, v71], [v63, v72])
}

/// Residual F = M k - f of mode `first`, k the rates of the states.
///
/// 30 additions, 7 multiplications, 5 fused multiply-adds, 7 divisions, 21 function calls, 5 selections.
fn residual_first<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[n_n, _] = env.memory else { return nan_state() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_state() };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let &[k_x, k_Y, k_self] = k;
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1.mul_add(v3, v0);
    let v5 = v2 / S::constant(4.0);
    let v6 = v5.asin();
    let v7 = v4 + v6;
    let v8 = p_a * x_Y;
    let v9 = v8 / S::constant(4.0);
    let v10 = v9.acos();
    let v11 = v7 - v10;
    let v12 = p_b * x_x;
    let v13 = v12.atan();
    let v14 = v11 + v13;
    let v15 = x_x + S::constant(2.0);
    let v16 = x_Y + S::constant(3.0);
    let v17 = v15.atan2(v16);
    let v18 = v14 + v17;
    let v19 = v2.sinh();
    let v20 = v8.cosh();
    let v21 = v19 + v20;
    let v22 = x_self.tanh();
    let v23 = v21 + v22;
    let v24 = v12.asinh();
    let v25 = v23 + v24;
    let v26 = x_x * x_x;
    let v27 = S::constant(2.0) + v26;
    let v28 = v27.acosh();
    let v29 = v25 + v28;
    let v30 = v5.atanh();
    let v31 = v29 + v30;
    let v32 = v31 / S::constant(10.0);
    let v33 = v18 + v32;
    let v34 = k_x - v33;
    let v35 = x_x.mul_add(v26, v26);
    let v36 = x_x + S::constant(5.0);
    let v37 = v36 * v36;
    let v38 = S::constant(1.0) / v37;
    let v39 = v38 / S::constant(100.0);
    let v40 = v35 + v39;
    let v41 = v26 + S::constant(1.0);
    let v42 = v41.sqrt();
    let v43 = v40 + v42;
    let v44 = v41.pow(S::constant(2.5));
    let v45 = v43 + v44;
    let v46 = v41.pow(p_c);
    let v47 = v45 + v46;
    let v48 = S::constant(1.0) / v42;
    let v49 = v47 + v48;
    let v50 = v49 / S::constant(10.0);
    let v51 = -v26;
    let v52 = v51.exp();
    let v53 = S::constant(1.0) + v26;
    let v54 = v53 + p_type;
    let v55 = v54.ln();
    let v56 = v52 + v55;
    let v57 = S::constant(3.0) * t;
    let v58 = v57.cos();
    let v59 = v56.mul_add(v58, v50);
    let v60 = v59 - x_x;
    let v61 = k_Y - v60;
    let v62 = x_x.sqrt();
    let v63 = x_x.mul_add(v62, v62);
    let v64 = S::select(b0, v63, v51);
    let v65 = x_x * x_Y;
    let v66 = S::select(b0, v65, v0);
    let v67 = S::select(b1, x_x, x_Y);
    let v68 = S::select(b2, x_x, p_a);
    let v69 = v67 + v68;
    let v70 = S::select(b3, v66, v69);
    let v71 = v64 + v70;
    let v72 = S::constant(-1.0).pow(n_n);
    let v73 = v72.mul_add(tau, v71);
    let v74 = k_self - v73;
    [v34, v61, v74]
}

/// State derivative f of mode `second`.
/// Rates of x [s^-1], Y [s^-1], self [s^-1].
///
/// 1 addition, 1 multiplication.
fn flow_second<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_, _] = env.memory else { return nan_state() };
    let &[_, _, _, _] = env.branch else { return nan_state() };
    let &[x_x, x_Y, x_self] = x;
    let v0 = -x_x;
    let v1 = x_Y * x_self;
    [x_Y, v0, v1]
}

/// State derivative f and integrands of mode `second`.
///
/// 1 addition, 3 multiplications.
fn integrated_second<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; INTEGRALS]) {
    let &[_, _] = env.memory else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[_, _, _, _] = env.branch else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[x_x, x_Y, x_self] = x;
    let v0 = -x_x;
    let v1 = x_Y * x_self;
    let v2 = x_x * x_Y;
    let v3 = x_Y * x_Y;
    ([x_Y, v0, v1], [v2, v3])
}

/// Residual F = M k - f of mode `second`, k the rates of the states.
///
/// 2 additions, 1 fused multiply-add.
fn residual_second<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_, _] = env.memory else { return nan_state() };
    let &[_, _, _, _] = env.branch else { return nan_state() };
    let &[x_x, x_Y, x_self] = x;
    let &[k_x, k_Y, k_self] = k;
    let v0 = k_x - x_Y;
    let v1 = k_Y + x_x;
    let v2 = (-x_Y).mul_add(x_self, k_self);
    [v0, v1, v2]
}

/// Switching function 0, not negative where `x >= 0`.
///
/// No operations.
fn switch_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[x_x, _, _] = x;
    x_x
}

/// Switching function 1, not negative where `max(x, Y)`.
///
/// 1 addition.
fn switch_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[x_x, x_Y, _] = x;
    let v0 = x_x - x_Y;
    v0
}

/// Switching function 2, not negative where `min(x, a)`.
///
/// 1 addition.
fn switch_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[p_a, _, _, _] = env.p;
    let &[x_x, _, _] = x;
    let v0 = p_a - x_x;
    v0
}

/// Switching function 3, not negative where `Y >= a`.
///
/// 1 addition.
fn switch_3<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[p_a, _, _, _] = env.p;
    let &[_, x_Y, _] = x;
    let v0 = x_Y - p_a;
    v0
}

/// Guard of transition `go`.
///
/// 2 additions, 1 multiplication, 2 fused multiply-adds, 2 function calls, 1 selection.
fn guard_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[b0, _, _, _] = env.branch else { return nan() };
    let &[p_a, _, _, _] = env.p;
    let t = env.t;
    let &[x_x, _, _] = x;
    let v0 = t.cos();
    let v1 = (-p_a).mul_add(v0, x_x);
    let v2 = x_x.sqrt();
    let v3 = x_x.mul_add(v2, v2);
    let v4 = x_x * x_x;
    let v5 = -v4;
    let v6 = S::select(b0, v3, v5);
    let v7 = v1 + v6;
    v7
}

/// Transition `go` is enabled where this is not negative.
///
/// No operations.
fn when_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[_, x_Y, _] = x;
    x_Y
}

/// State and memory after transition `go`, from those before.
/// State: x [1], Y [1], self [1].
///
/// 4 additions, 2 multiplications, 1 fused multiply-add, 2 function calls, 4 selections.
fn reset_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 2]) {
    let &[n_n, n_v0] = env.memory else { return (nan_state(), [nan(); 2]) };
    let &[b0, b1, b2, b3] = env.branch else { return (nan_state(), [nan(); 2]) };
    let &[p_a, p_b, _, p_type] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_self.mul_add(p_b, x_x);
    let v1 = x_x * x_Y;
    let v2 = x_x.sin();
    let v3 = S::select(b0, v1, v2);
    let v4 = S::select(b1, x_x, x_Y);
    let v5 = S::select(b2, x_x, p_a);
    let v6 = v4 + v5;
    let v7 = S::select(b3, v3, v6);
    let v8 = S::constant(-1.0).pow(n_n);
    let v9 = v8 * p_type;
    let v10 = n_n + S::constant(1.0);
    let v11 = n_n + n_n;
    let v12 = n_v0 + v11;
    ([v0, v7, v9], [v10, v12])
}

/// Guard of transition `back`.
///
/// No operations.
fn guard_back<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[_, x_Y, _] = x;
    x_Y
}

/// State and memory after transition `back`, from those before.
/// State: x [1], Y [1], self [1].
///
/// 5 additions, 1 multiplication.
fn reset_back<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 2]) {
    let &[n_n, n_v0] = env.memory else { return (nan_state(), [nan(); 2]) };
    let &[_, _, _, _] = env.branch else { return (nan_state(), [nan(); 2]) };
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x + x_Y;
    let v1 = -x_x;
    let v2 = x_Y * x_self;
    let v3 = n_n + S::constant(1.0);
    let v4 = n_n + n_n;
    let v5 = n_v0 + v4;
    ([v0, v1, v2], [v3, v5])
}

/// Full state on the section from its coordinates.
///
/// 1 addition, 2 multiplications, 1 fused multiply-add, 1 selection.
fn embed<S: scalar::Scalar>(z: &[S], p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_self, x_x] = z else { return nan_state() };
    let &[p_a, p_b, _, _] = p;
    let v0 = x_x * x_x;
    let v1 = p_a * v0;
    let v2 = p_b - x_x;
    let v3 = S::constant(0.0).less_equal(v2);
    let v4 = S::select(v3, p_b, x_x);
    let v5 = x_self.mul_add(v4, v1);
    [x_x, v5, x_self]
}

/// Image of a state under the section's symmetry.
///
/// 3 additions, 1 multiplication, 1 selection.
fn symmetry<S: scalar::Scalar>(x: &[S; STATES], p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_x, x_Y, x_self] = x;
    let &[_, p_b, _, _] = p;
    let v0 = x_x * p_b;
    let v1 = -v0;
    let v2 = -x_Y;
    let v3 = S::constant(0.0).less_equal(x_self);
    let v4 = -x_self;
    let v5 = S::select(v3, x_self, v4);
    [v1, v2, v5]
}

/// Measures from the values of the functionals.
/// Measures: area [s], top [1], first_x [1], average [1], slowest [s].
///
/// 1 multiplication, 1 fused multiply-add, 2 divisions.
fn measures<S: scalar::Scalar>(functionals: &[S], p: &[S; PARAMETERS]) -> [S; 5] {
    let &[f0, f1, f2, f3, f4, f5, f6, _] = functionals else { return [nan(); 5] };
    let &[p_a, _, _, _] = p;
    let v0 = f3.mul_add(f3, p_a);
    let v1 = f2 / v0;
    let v2 = f4 * f5;
    let v3 = v2 / f0;
    [f0, f1, v1, v3, f6]
}

/// State derivative f of mode `first` with all first derivatives.
/// Components: x, Y, self; derivatives by columns.
///
/// 48 additions, 24 multiplications, 28 fused multiply-adds, 29 divisions, 32 function calls, 15 selections.
fn d_flow_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[n_n, _] = env.memory else { return nan_jacobian() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_jacobian() };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = v4 / S::constant(4.0);
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = p_a * x_Y;
    let v11 = v10 / S::constant(4.0);
    let v12 = v11.acos();
    let v13 = v9 - v12;
    let v14 = p_b * x_x;
    let v15 = v14.atan();
    let v16 = v13 + v15;
    let v17 = x_x + S::constant(2.0);
    let v18 = x_Y + S::constant(3.0);
    let v19 = v17.atan2(v18);
    let v20 = v16 + v19;
    let v21 = v4.sinh();
    let v22 = v10.cosh();
    let v23 = v21 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v14.asinh();
    let v27 = v25 + v26;
    let v28 = x_x * x_x;
    let v29 = S::constant(2.0) + v28;
    let v30 = v29.acosh();
    let v31 = v27 + v30;
    let v32 = v7.atanh();
    let v33 = v31 + v32;
    let v34 = v33 / S::constant(10.0);
    let v35 = v20 + v34;
    let v36 = x_x.mul_add(v28, v28);
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v28 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v28;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v28;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let (v60, v59) = v58.sin_cos();
    let v61 = v57.mul_add(v59, v51);
    let v62 = v61 - x_x;
    let v63 = x_x.sqrt();
    let v64 = x_x.mul_add(v63, v63);
    let v65 = S::select(b0, v64, v52);
    let v66 = x_x * x_Y;
    let v67 = S::select(b0, v66, v0);
    let v68 = S::select(b1, x_x, x_Y);
    let v69 = S::select(b2, x_x, p_a);
    let v70 = v68 + v69;
    let v71 = S::select(b3, v67, v70);
    let v72 = v65 + v71;
    let v73 = S::constant(-1.0).pow(n_n);
    let v74 = v73.mul_add(tau, v72);
    let v75 = v4.cos();
    let v76 = v75 * v75;
    let v77 = p_a / v76;
    let v78 = v2.mul_add(v77, v1);
    let v79 = S::constant(0.25) * p_a;
    let v80 = (-v7).mul_add(v7, S::constant(1.0));
    let v81 = v80.sqrt();
    let v82 = v79 / v81;
    let v83 = v78 + v82;
    let v84 = v14.mul_add(v14, S::constant(1.0));
    let v85 = p_b / v84;
    let v86 = v83 + v85;
    let v87 = v17 * v17;
    let v88 = v18.mul_add(v18, v87);
    let v89 = v18 / v88;
    let v90 = v86 + v89;
    let v91 = v4.cosh();
    let v92 = v84.sqrt();
    let v93 = p_b / v92;
    let v94 = v91.mul_add(p_a, v93);
    let v95 = v29 - S::constant(1.0);
    let v96 = v95.sqrt();
    let v97 = S::constant(1.0) / v96;
    let v98 = v29 + S::constant(1.0);
    let v99 = v98.sqrt();
    let v100 = v97 / v99;
    let v101 = x_x + x_x;
    let v102 = v100.mul_add(v101, v94);
    let v103 = v79 / v80;
    let v104 = v102 + v103;
    let v105 = S::constant(0.1).mul_add(v104, v90);
    let v106 = x_x.mul_add(v101, v28);
    let v107 = v101 + v106;
    let v108 = v39 / v38;
    let v109 = v37 + v37;
    let v110 = v108 * v109;
    let v111 = S::constant(-0.01).mul_add(v110, v107);
    let v112 = x_x / v43;
    let v113 = v111 + v112;
    let v114 = v42.pow(S::constant(1.5));
    let v115 = S::constant(2.5) * v114;
    let v116 = v115.mul_add(v101, v113);
    let v117 = p_c - S::constant(1.0);
    let v118 = v42.pow(v117);
    let v119 = p_c * v118;
    let v120 = v119.mul_add(v101, v116);
    let v121 = v49 / v43;
    let v122 = (-v121).mul_add(v112, v120);
    let v123 = v101 / v55;
    let v124 = (-v53).mul_add(v101, v123);
    let v125 = v59 * v124;
    let v126 = S::constant(0.1).mul_add(v122, v125);
    let v127 = v126 + S::constant(-1.0);
    let v128 = v63 + v63;
    let v129 = S::constant(1.0) / v128;
    let v130 = x_x / v128;
    let v131 = v63 + v130;
    let v132 = v129 + v131;
    let v133 = -v101;
    let v134 = S::select(b0, v132, v133);
    let v135 = S::select(b0, x_Y, v1);
    let v136 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v137 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v138 = v136 + v137;
    let v139 = S::select(b3, v135, v138);
    let v140 = v134 + v139;
    let v141 = v10.sinh();
    let v142 = v141 * p_a;
    let v143 = v5 * v3;
    let v144 = (-v11).mul_add(v11, S::constant(1.0));
    let v145 = v144.sqrt();
    let v146 = S::constant(-1.0) / v145;
    let v147 = v146.mul_add(v79, v143);
    let v148 = v17 / v88;
    let v149 = v147 + v148;
    let v150 = S::constant(0.1).mul_add(v142, -v149);
    let v151 = S::select(b0, x_x, S::constant(0.0));
    let v152 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v153 = S::select(b3, v151, v152);
    let v154 = (-v24).mul_add(v24, S::constant(1.0));
    let v155 = S::constant(0.1) * v154;
    let v156 = x_x / v76;
    let v157 = S::constant(0.25) * x_x;
    let v158 = v157 / v81;
    let v159 = v2.mul_add(v156, v158);
    let v160 = S::constant(0.25) * x_Y;
    let v161 = (-v146).mul_add(v160, v159);
    let v162 = v91 * x_x;
    let v163 = v141.mul_add(x_Y, v162);
    let v164 = v157 / v80;
    let v165 = v163 + v164;
    let v166 = S::constant(0.1).mul_add(v165, v161);
    let v167 = S::select(b2, S::constant(0.0), S::constant(1.0));
    let v168 = S::select(b3, S::constant(0.0), v167);
    let v169 = x_x / v84;
    let v170 = x_x / v92;
    let v171 = S::constant(0.1).mul_add(v170, v169);
    let v172 = v42.ln();
    let v173 = v172 * v47;
    let v174 = S::constant(0.1) * v173;
    let v175 = v59 / v55;
    let v176 = S::constant(3.0) * v60;
    let v177 = v57 * v176;
    let v178 = -v177;
    model::Jacobian {
        value: [v35, v62, v74],
        dx: [
            [v105, v127, v140],
            [v150, S::constant(0.0), v153],
            [v155, S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [v166, S::constant(0.0), v168],
            [v171, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v174, S::constant(0.0)],
            [S::constant(0.0), v175, S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), v73],
        dt: [S::constant(0.0), v178, S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `first` with all first derivatives, by columns.
///
/// 61 additions, 24 multiplications, 28 fused multiply-adds, 29 divisions, 32 function calls, 15 selections.
fn d_residual_first<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[n_n, _] = env.memory else { return nan_residual_jacobian() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_residual_jacobian() };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let &[k_x, k_Y, k_self] = k;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = v4 / S::constant(4.0);
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = p_a * x_Y;
    let v11 = v10 / S::constant(4.0);
    let v12 = v11.acos();
    let v13 = v9 - v12;
    let v14 = p_b * x_x;
    let v15 = v14.atan();
    let v16 = v13 + v15;
    let v17 = x_x + S::constant(2.0);
    let v18 = x_Y + S::constant(3.0);
    let v19 = v17.atan2(v18);
    let v20 = v16 + v19;
    let v21 = v4.sinh();
    let v22 = v10.cosh();
    let v23 = v21 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v14.asinh();
    let v27 = v25 + v26;
    let v28 = x_x * x_x;
    let v29 = S::constant(2.0) + v28;
    let v30 = v29.acosh();
    let v31 = v27 + v30;
    let v32 = v7.atanh();
    let v33 = v31 + v32;
    let v34 = v33 / S::constant(10.0);
    let v35 = v20 + v34;
    let v36 = k_x - v35;
    let v37 = x_x.mul_add(v28, v28);
    let v38 = x_x + S::constant(5.0);
    let v39 = v38 * v38;
    let v40 = S::constant(1.0) / v39;
    let v41 = v40 / S::constant(100.0);
    let v42 = v37 + v41;
    let v43 = v28 + S::constant(1.0);
    let v44 = v43.sqrt();
    let v45 = v42 + v44;
    let v46 = v43.pow(S::constant(2.5));
    let v47 = v45 + v46;
    let v48 = v43.pow(p_c);
    let v49 = v47 + v48;
    let v50 = S::constant(1.0) / v44;
    let v51 = v49 + v50;
    let v52 = v51 / S::constant(10.0);
    let v53 = -v28;
    let v54 = v53.exp();
    let v55 = S::constant(1.0) + v28;
    let v56 = v55 + p_type;
    let v57 = v56.ln();
    let v58 = v54 + v57;
    let v59 = S::constant(3.0) * t;
    let (v61, v60) = v59.sin_cos();
    let v62 = v58.mul_add(v60, v52);
    let v63 = v62 - x_x;
    let v64 = k_Y - v63;
    let v65 = x_x.sqrt();
    let v66 = x_x.mul_add(v65, v65);
    let v67 = S::select(b0, v66, v53);
    let v68 = x_x * x_Y;
    let v69 = S::select(b0, v68, v0);
    let v70 = S::select(b1, x_x, x_Y);
    let v71 = S::select(b2, x_x, p_a);
    let v72 = v70 + v71;
    let v73 = S::select(b3, v69, v72);
    let v74 = v67 + v73;
    let v75 = S::constant(-1.0).pow(n_n);
    let v76 = v75.mul_add(tau, v74);
    let v77 = k_self - v76;
    let v78 = v4.cos();
    let v79 = v78 * v78;
    let v80 = p_a / v79;
    let v81 = v2.mul_add(v80, v1);
    let v82 = S::constant(0.25) * p_a;
    let v83 = (-v7).mul_add(v7, S::constant(1.0));
    let v84 = v83.sqrt();
    let v85 = v82 / v84;
    let v86 = v81 + v85;
    let v87 = v14.mul_add(v14, S::constant(1.0));
    let v88 = p_b / v87;
    let v89 = v86 + v88;
    let v90 = v17 * v17;
    let v91 = v18.mul_add(v18, v90);
    let v92 = v18 / v91;
    let v93 = v89 + v92;
    let v94 = v4.cosh();
    let v95 = v87.sqrt();
    let v96 = p_b / v95;
    let v97 = v94.mul_add(p_a, v96);
    let v98 = v29 - S::constant(1.0);
    let v99 = v98.sqrt();
    let v100 = S::constant(1.0) / v99;
    let v101 = v29 + S::constant(1.0);
    let v102 = v101.sqrt();
    let v103 = v100 / v102;
    let v104 = x_x + x_x;
    let v105 = v103.mul_add(v104, v97);
    let v106 = v82 / v83;
    let v107 = v105 + v106;
    let v108 = S::constant(0.1).mul_add(v107, v93);
    let v109 = -v108;
    let v110 = x_x.mul_add(v104, v28);
    let v111 = v104 + v110;
    let v112 = v40 / v39;
    let v113 = v38 + v38;
    let v114 = v112 * v113;
    let v115 = S::constant(-0.01).mul_add(v114, v111);
    let v116 = x_x / v44;
    let v117 = v115 + v116;
    let v118 = v43.pow(S::constant(1.5));
    let v119 = S::constant(2.5) * v118;
    let v120 = v119.mul_add(v104, v117);
    let v121 = p_c - S::constant(1.0);
    let v122 = v43.pow(v121);
    let v123 = p_c * v122;
    let v124 = v123.mul_add(v104, v120);
    let v125 = v50 / v44;
    let v126 = (-v125).mul_add(v116, v124);
    let v127 = v104 / v56;
    let v128 = (-v54).mul_add(v104, v127);
    let v129 = v60 * v128;
    let v130 = S::constant(0.1).mul_add(v126, v129);
    let v131 = v130 + S::constant(-1.0);
    let v132 = -v131;
    let v133 = v65 + v65;
    let v134 = S::constant(1.0) / v133;
    let v135 = x_x / v133;
    let v136 = v65 + v135;
    let v137 = v134 + v136;
    let v138 = -v104;
    let v139 = S::select(b0, v137, v138);
    let v140 = S::select(b0, x_Y, v1);
    let v141 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v142 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v143 = v141 + v142;
    let v144 = S::select(b3, v140, v143);
    let v145 = v139 + v144;
    let v146 = -v145;
    let v147 = v10.sinh();
    let v148 = v147 * p_a;
    let v149 = v5 * v3;
    let v150 = (-v11).mul_add(v11, S::constant(1.0));
    let v151 = v150.sqrt();
    let v152 = S::constant(-1.0) / v151;
    let v153 = v152.mul_add(v82, v149);
    let v154 = v17 / v91;
    let v155 = v153 + v154;
    let v156 = S::constant(0.1).mul_add(v148, -v155);
    let v157 = -v156;
    let v158 = S::select(b0, x_x, S::constant(0.0));
    let v159 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v160 = S::select(b3, v158, v159);
    let v161 = -v160;
    let v162 = (-v24).mul_add(v24, S::constant(1.0));
    let v163 = S::constant(0.1) * v162;
    let v164 = -v163;
    let v165 = x_x / v79;
    let v166 = S::constant(0.25) * x_x;
    let v167 = v166 / v84;
    let v168 = v2.mul_add(v165, v167);
    let v169 = S::constant(0.25) * x_Y;
    let v170 = (-v152).mul_add(v169, v168);
    let v171 = v94 * x_x;
    let v172 = v147.mul_add(x_Y, v171);
    let v173 = v166 / v83;
    let v174 = v172 + v173;
    let v175 = S::constant(0.1).mul_add(v174, v170);
    let v176 = -v175;
    let v177 = S::select(b2, S::constant(0.0), S::constant(-1.0));
    let v178 = S::select(b3, S::constant(0.0), v177);
    let v179 = x_x / v87;
    let v180 = x_x / v95;
    let v181 = S::constant(0.1).mul_add(v180, v179);
    let v182 = -v181;
    let v183 = v43.ln();
    let v184 = v183 * v48;
    let v185 = S::constant(0.1) * v184;
    let v186 = -v185;
    let v187 = v60 / v56;
    let v188 = -v187;
    let v189 = -v75;
    let v190 = S::constant(3.0) * v61;
    let v191 = v58 * v190;
    model::ResidualJacobian {
        value: [v36, v64, v77],
        dx: [
            [v109, v132, v146],
            [v157, S::constant(0.0), v161],
            [v164, S::constant(0.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [v176, S::constant(0.0), v178],
            [v182, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v186, S::constant(0.0)],
            [S::constant(0.0), v188, S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), v189],
        dt: [S::constant(0.0), v191, S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `first` with its derivatives by state and rate, by columns.
///
/// 55 additions, 17 multiplications, 23 fused multiply-adds, 23 divisions, 31 function calls, 13 selections.
fn linearised_first<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[n_n, _] = env.memory else { return nan_linearised() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_linearised() };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let &[k_x, k_Y, k_self] = k;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = v4 / S::constant(4.0);
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = p_a * x_Y;
    let v11 = v10 / S::constant(4.0);
    let v12 = v11.acos();
    let v13 = v9 - v12;
    let v14 = p_b * x_x;
    let v15 = v14.atan();
    let v16 = v13 + v15;
    let v17 = x_x + S::constant(2.0);
    let v18 = x_Y + S::constant(3.0);
    let v19 = v17.atan2(v18);
    let v20 = v16 + v19;
    let v21 = v4.sinh();
    let v22 = v10.cosh();
    let v23 = v21 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v14.asinh();
    let v27 = v25 + v26;
    let v28 = x_x * x_x;
    let v29 = S::constant(2.0) + v28;
    let v30 = v29.acosh();
    let v31 = v27 + v30;
    let v32 = v7.atanh();
    let v33 = v31 + v32;
    let v34 = v33 / S::constant(10.0);
    let v35 = v20 + v34;
    let v36 = k_x - v35;
    let v37 = x_x.mul_add(v28, v28);
    let v38 = x_x + S::constant(5.0);
    let v39 = v38 * v38;
    let v40 = S::constant(1.0) / v39;
    let v41 = v40 / S::constant(100.0);
    let v42 = v37 + v41;
    let v43 = v28 + S::constant(1.0);
    let v44 = v43.sqrt();
    let v45 = v42 + v44;
    let v46 = v43.pow(S::constant(2.5));
    let v47 = v45 + v46;
    let v48 = v43.pow(p_c);
    let v49 = v47 + v48;
    let v50 = S::constant(1.0) / v44;
    let v51 = v49 + v50;
    let v52 = v51 / S::constant(10.0);
    let v53 = -v28;
    let v54 = v53.exp();
    let v55 = S::constant(1.0) + v28;
    let v56 = v55 + p_type;
    let v57 = v56.ln();
    let v58 = v54 + v57;
    let v59 = S::constant(3.0) * t;
    let v60 = v59.cos();
    let v61 = v58.mul_add(v60, v52);
    let v62 = v61 - x_x;
    let v63 = k_Y - v62;
    let v64 = x_x.sqrt();
    let v65 = x_x.mul_add(v64, v64);
    let v66 = S::select(b0, v65, v53);
    let v67 = x_x * x_Y;
    let v68 = S::select(b0, v67, v0);
    let v69 = S::select(b1, x_x, x_Y);
    let v70 = S::select(b2, x_x, p_a);
    let v71 = v69 + v70;
    let v72 = S::select(b3, v68, v71);
    let v73 = v66 + v72;
    let v74 = S::constant(-1.0).pow(n_n);
    let v75 = v74.mul_add(tau, v73);
    let v76 = k_self - v75;
    let v77 = v4.cos();
    let v78 = v77 * v77;
    let v79 = p_a / v78;
    let v80 = v2.mul_add(v79, v1);
    let v81 = S::constant(0.25) * p_a;
    let v82 = (-v7).mul_add(v7, S::constant(1.0));
    let v83 = v82.sqrt();
    let v84 = v81 / v83;
    let v85 = v80 + v84;
    let v86 = v14.mul_add(v14, S::constant(1.0));
    let v87 = p_b / v86;
    let v88 = v85 + v87;
    let v89 = v17 * v17;
    let v90 = v18.mul_add(v18, v89);
    let v91 = v18 / v90;
    let v92 = v88 + v91;
    let v93 = v4.cosh();
    let v94 = v86.sqrt();
    let v95 = p_b / v94;
    let v96 = v93.mul_add(p_a, v95);
    let v97 = v29 - S::constant(1.0);
    let v98 = v97.sqrt();
    let v99 = S::constant(1.0) / v98;
    let v100 = v29 + S::constant(1.0);
    let v101 = v100.sqrt();
    let v102 = v99 / v101;
    let v103 = x_x + x_x;
    let v104 = v102.mul_add(v103, v96);
    let v105 = v81 / v82;
    let v106 = v104 + v105;
    let v107 = S::constant(0.1).mul_add(v106, v92);
    let v108 = -v107;
    let v109 = x_x.mul_add(v103, v28);
    let v110 = v103 + v109;
    let v111 = v40 / v39;
    let v112 = v38 + v38;
    let v113 = v111 * v112;
    let v114 = S::constant(-0.01).mul_add(v113, v110);
    let v115 = x_x / v44;
    let v116 = v114 + v115;
    let v117 = v43.pow(S::constant(1.5));
    let v118 = S::constant(2.5) * v117;
    let v119 = v118.mul_add(v103, v116);
    let v120 = p_c - S::constant(1.0);
    let v121 = v43.pow(v120);
    let v122 = p_c * v121;
    let v123 = v122.mul_add(v103, v119);
    let v124 = v50 / v44;
    let v125 = (-v124).mul_add(v115, v123);
    let v126 = v103 / v56;
    let v127 = (-v54).mul_add(v103, v126);
    let v128 = v60 * v127;
    let v129 = S::constant(0.1).mul_add(v125, v128);
    let v130 = v129 + S::constant(-1.0);
    let v131 = -v130;
    let v132 = v64 + v64;
    let v133 = S::constant(1.0) / v132;
    let v134 = x_x / v132;
    let v135 = v64 + v134;
    let v136 = v133 + v135;
    let v137 = -v103;
    let v138 = S::select(b0, v136, v137);
    let v139 = S::select(b0, x_Y, v1);
    let v140 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v141 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v142 = v140 + v141;
    let v143 = S::select(b3, v139, v142);
    let v144 = v138 + v143;
    let v145 = -v144;
    let v146 = v10.sinh();
    let v147 = v146 * p_a;
    let v148 = v5 * v3;
    let v149 = (-v11).mul_add(v11, S::constant(1.0));
    let v150 = v149.sqrt();
    let v151 = S::constant(-1.0) / v150;
    let v152 = v151.mul_add(v81, v148);
    let v153 = v17 / v90;
    let v154 = v152 + v153;
    let v155 = S::constant(0.1).mul_add(v147, -v154);
    let v156 = -v155;
    let v157 = S::select(b0, x_x, S::constant(0.0));
    let v158 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v159 = S::select(b3, v157, v158);
    let v160 = -v159;
    let v161 = (-v24).mul_add(v24, S::constant(1.0));
    let v162 = S::constant(0.1) * v161;
    let v163 = -v162;
    model::Linearised {
        value: [v36, v63, v76],
        dx: [
            [v108, v131, v145],
            [v156, S::constant(0.0), v160],
            [v163, S::constant(0.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
    }
}

/// State derivative f of mode `second` with all first derivatives.
/// Components: x, Y, self; derivatives by columns.
///
/// 1 addition, 1 multiplication.
fn d_flow_second<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_jacobian() };
    let &[_, _, _, _] = env.branch else { return nan_jacobian() };
    let &[x_x, x_Y, x_self] = x;
    let v0 = -x_x;
    let v1 = x_Y * x_self;
    model::Jacobian {
        value: [x_Y, v0, v1],
        dx: [
            [S::constant(0.0), S::constant(-1.0), S::constant(0.0)],
            [S::constant(1.0), S::constant(0.0), x_self],
            [S::constant(0.0), S::constant(0.0), x_Y],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `second` with all first derivatives, by columns.
///
/// 4 additions, 1 fused multiply-add.
fn d_residual_second<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_residual_jacobian() };
    let &[_, _, _, _] = env.branch else { return nan_residual_jacobian() };
    let &[x_x, x_Y, x_self] = x;
    let &[k_x, k_Y, k_self] = k;
    let v0 = k_x - x_Y;
    let v1 = k_Y + x_x;
    let v2 = (-x_Y).mul_add(x_self, k_self);
    let v3 = -x_self;
    let v4 = -x_Y;
    model::ResidualJacobian {
        value: [v0, v1, v2],
        dx: [
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(-1.0), S::constant(0.0), v3],
            [S::constant(0.0), S::constant(0.0), v4],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `second` with its derivatives by state and rate, by columns.
///
/// 4 additions, 1 fused multiply-add.
fn linearised_second<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[_, _] = env.memory else { return nan_linearised() };
    let &[_, _, _, _] = env.branch else { return nan_linearised() };
    let &[x_x, x_Y, x_self] = x;
    let &[k_x, k_Y, k_self] = k;
    let v0 = k_x - x_Y;
    let v1 = k_Y + x_x;
    let v2 = (-x_Y).mul_add(x_self, k_self);
    let v3 = -x_self;
    let v4 = -x_Y;
    model::Linearised {
        value: [v0, v1, v2],
        dx: [
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(-1.0), S::constant(0.0), v3],
            [S::constant(0.0), S::constant(0.0), v4],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
    }
}

/// Switching function 0 with all first derivatives.
///
/// No operations.
fn d_switch_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[x_x, _, _] = x;
    model::Gradient {
        value: x_x,
        dx: [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Switching function 1 with all first derivatives.
///
/// 1 addition.
fn d_switch_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[x_x, x_Y, _] = x;
    let v0 = x_x - x_Y;
    model::Gradient {
        value: v0,
        dx: [S::constant(1.0), S::constant(-1.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Switching function 2 with all first derivatives.
///
/// 1 addition.
fn d_switch_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_a, _, _, _] = env.p;
    let &[x_x, _, _] = x;
    let v0 = p_a - x_x;
    model::Gradient {
        value: v0,
        dx: [S::constant(-1.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Switching function 3 with all first derivatives.
///
/// 1 addition.
fn d_switch_3<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_a, _, _, _] = env.p;
    let &[_, x_Y, _] = x;
    let v0 = x_Y - p_a;
    model::Gradient {
        value: v0,
        dx: [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        dp: [S::constant(-1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Guard of transition `go` with all first derivatives.
///
/// 9 additions, 2 multiplications, 2 fused multiply-adds, 2 divisions, 2 function calls, 2 selections.
fn d_guard_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_a, _, _, _] = env.p;
    let t = env.t;
    let &[x_x, _, _] = x;
    let (v1, v0) = t.sin_cos();
    let v2 = (-p_a).mul_add(v0, x_x);
    let v3 = x_x.sqrt();
    let v4 = x_x.mul_add(v3, v3);
    let v5 = x_x * x_x;
    let v6 = -v5;
    let v7 = S::select(b0, v4, v6);
    let v8 = v2 + v7;
    let v9 = v3 + v3;
    let v10 = S::constant(1.0) / v9;
    let v11 = x_x / v9;
    let v12 = v3 + v11;
    let v13 = v10 + v12;
    let v14 = x_x + x_x;
    let v15 = -v14;
    let v16 = S::select(b0, v13, v15);
    let v17 = S::constant(1.0) + v16;
    let v18 = -v0;
    let v19 = p_a * v1;
    model::Gradient {
        value: v8,
        dx: [v17, S::constant(0.0), S::constant(0.0)],
        dp: [v18, S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: v19,
    }
}

/// State after transition `go` with all first derivatives.
/// Components: x, Y, self; derivatives by columns.
///
/// 2 additions, 2 multiplications, 1 fused multiply-add, 2 function calls, 13 selections.
fn d_reset_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[n_n, _] = env.memory else { return nan_jacobian() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_jacobian() };
    let &[p_a, p_b, _, p_type] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_self.mul_add(p_b, x_x);
    let v1 = x_x * x_Y;
    let (v2, v3) = x_x.sin_cos();
    let v4 = S::select(b0, v1, v2);
    let v5 = S::select(b1, x_x, x_Y);
    let v6 = S::select(b2, x_x, p_a);
    let v7 = v5 + v6;
    let v8 = S::select(b3, v4, v7);
    let v9 = S::constant(-1.0).pow(n_n);
    let v10 = v9 * p_type;
    let v11 = S::select(b0, x_Y, v3);
    let v12 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v13 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v14 = v12 + v13;
    let v15 = S::select(b3, v11, v14);
    let v16 = S::select(b0, x_x, S::constant(0.0));
    let v17 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v18 = S::select(b3, v16, v17);
    let v19 = S::select(b2, S::constant(0.0), S::constant(1.0));
    let v20 = S::select(b3, S::constant(0.0), v19);
    model::Jacobian {
        value: [v0, v8, v10],
        dx: [
            [S::constant(1.0), v15, S::constant(0.0)],
            [S::constant(0.0), v18, S::constant(0.0)],
            [p_b, S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), v20, S::constant(0.0)],
            [x_self, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), v9],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Guard of transition `back` with all first derivatives.
///
/// No operations.
fn d_guard_back<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_gradient() };
    let &[_, x_Y, _] = x;
    model::Gradient {
        value: x_Y,
        dx: [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State after transition `back` with all first derivatives.
/// Components: x, Y, self; derivatives by columns.
///
/// 2 additions, 1 multiplication.
fn d_reset_back<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_jacobian() };
    let &[_, _, _, _] = env.branch else { return nan_jacobian() };
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x + x_Y;
    let v1 = -x_x;
    let v2 = x_Y * x_self;
    model::Jacobian {
        value: [v0, v1, v2],
        dx: [
            [S::constant(1.0), S::constant(-1.0), S::constant(0.0)],
            [S::constant(1.0), S::constant(0.0), x_self],
            [S::constant(0.0), S::constant(0.0), x_Y],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
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
/// 2 additions, 1 multiplication, 1 fused multiply-add, 3 selections.
fn d_embed<S: scalar::Scalar>(
    z: &[S],
    p: &[S; PARAMETERS],
) -> ([[S; STATES]; 2], [[S; STATES]; PARAMETERS]) {
    let &[x_self, x_x] = z else { return ([nan_state(); 2], [nan_state(); PARAMETERS]) };
    let &[p_a, p_b, _, _] = p;
    let v0 = x_x * x_x;
    let v1 = p_b - x_x;
    let v2 = S::constant(0.0).less_equal(v1);
    let v3 = S::select(v2, p_b, x_x);
    let v4 = x_x + x_x;
    let v5 = S::select(v2, S::constant(0.0), x_self);
    let v6 = p_a.mul_add(v4, v5);
    let v7 = S::select(v2, x_self, S::constant(0.0));
    (
        [
            [S::constant(0.0), v3, S::constant(1.0)],
            [S::constant(1.0), v6, S::constant(0.0)],
        ],
        [
            [S::constant(0.0), v0, S::constant(0.0)],
            [S::constant(0.0), v7, S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// Symmetry with its derivatives by state and parameters, by columns.
///
/// 5 additions, 1 multiplication, 2 selections.
fn d_symmetry<S: scalar::Scalar>(
    x: &[S; STATES],
    p: &[S; PARAMETERS],
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[x_x, x_Y, x_self] = x;
    let &[_, p_b, _, _] = p;
    let v0 = x_x * p_b;
    let v1 = -v0;
    let v2 = -x_Y;
    let v3 = S::constant(0.0).less_equal(x_self);
    let v4 = -x_self;
    let v5 = S::select(v3, x_self, v4);
    let v6 = -p_b;
    let v7 = S::select(v3, S::constant(1.0), S::constant(-1.0));
    let v8 = -x_x;
    model::Jacobian {
        value: [v1, v2, v5],
        dx: [
            [v6, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(-1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), v7],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [v8, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0); STATES],
        dt: [S::constant(0.0); STATES],
    }
}

/// Derivatives of the 5 measures: by the 8 functionals, one row a measure, and by the parameters.
///
/// 4 additions, 2 multiplications, 1 fused multiply-add, 7 divisions.
fn d_measures<S: scalar::Scalar>(
    functionals: &[S],
    p: &[S; PARAMETERS],
) -> ([S; 40], [[S; PARAMETERS]; 5]) {
    let &[f0, _, f2, f3, f4, f5, _, _] = functionals else {
        return ([nan(); 40], [[nan(); PARAMETERS]; 5])
    };
    let &[p_a, _, _, _] = p;
    let v0 = f3.mul_add(f3, p_a);
    let v1 = f2 / v0;
    let v2 = f4 * f5;
    let v3 = v2 / f0;
    let v4 = v3 / f0;
    let v5 = -v4;
    let v6 = S::constant(1.0) / v0;
    let v7 = v1 / v0;
    let v8 = f3 + f3;
    let v9 = v7 * v8;
    let v10 = -v9;
    let v11 = f5 / f0;
    let v12 = f4 / f0;
    let v13 = -v7;
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
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v6,
            v10,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v5,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v11,
            v12,
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
        ],
        [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [v13, S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// The integrands in mode `first`.
///
/// 12 additions, 5 multiplications, 2 fused multiply-adds, 3 divisions, 13 function calls.
fn integrands_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; INTEGRALS] {
    let &[_, _] = env.memory else { return [nan(); INTEGRALS] };
    let &[_, _, _, _] = env.branch else { return [nan(); INTEGRALS] };
    let &[p_a, p_b, _, _] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x * x_Y;
    let v1 = x_x.sin();
    let v2 = x_Y.cos();
    let v3 = p_a * x_x;
    let v4 = v3.tan();
    let v5 = v2.mul_add(v4, v1);
    let v6 = v3 / S::constant(4.0);
    let v7 = v6.asin();
    let v8 = v5 + v7;
    let v9 = p_a * x_Y;
    let v10 = v9 / S::constant(4.0);
    let v11 = v10.acos();
    let v12 = v8 - v11;
    let v13 = p_b * x_x;
    let v14 = v13.atan();
    let v15 = v12 + v14;
    let v16 = x_x + S::constant(2.0);
    let v17 = x_Y + S::constant(3.0);
    let v18 = v16.atan2(v17);
    let v19 = v15 + v18;
    let v20 = v3.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x.mul_add(x_x, S::constant(2.0));
    let v28 = v27.acosh();
    let v29 = v26 + v28;
    let v30 = v6.atanh();
    let v31 = v29 + v30;
    let v32 = v31 / S::constant(10.0);
    let v33 = v19 + v32;
    let v34 = v33 * x_Y;
    [v0, v34]
}

/// The integrands in mode `second`.
///
/// 2 multiplications.
fn integrands_second<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; INTEGRALS] {
    let &[_, _] = env.memory else { return [nan(); INTEGRALS] };
    let &[_, _, _, _] = env.branch else { return [nan(); INTEGRALS] };
    let &[x_x, x_Y, _] = x;
    let v0 = x_x * x_Y;
    let v1 = x_Y * x_Y;
    [v0, v1]
}

/// Observable 0.
///
/// 2 additions, 1 multiplication, 1 fused multiply-add, 1 function call, 1 selection.
fn observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[b0, _, _, _] = env.branch else { return nan() };
    let &[x_x, _, _] = x;
    let v0 = x_x.sqrt();
    let v1 = x_x.mul_add(v0, v0);
    let v2 = x_x * x_x;
    let v3 = -v2;
    let v4 = S::select(b0, v1, v3);
    let v5 = x_x + v4;
    v5
}

/// Observable 0 with all first derivatives.
///
/// 8 additions, 1 multiplication, 1 fused multiply-add, 2 divisions, 1 function call, 2 selections.
fn d_observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[x_x, _, _] = x;
    let v0 = x_x.sqrt();
    let v1 = x_x.mul_add(v0, v0);
    let v2 = x_x * x_x;
    let v3 = -v2;
    let v4 = S::select(b0, v1, v3);
    let v5 = x_x + v4;
    let v6 = v0 + v0;
    let v7 = S::constant(1.0) / v6;
    let v8 = x_x / v6;
    let v9 = v0 + v8;
    let v10 = v7 + v9;
    let v11 = x_x + x_x;
    let v12 = -v11;
    let v13 = S::select(b0, v10, v12);
    let v14 = S::constant(1.0) + v13;
    model::RateGradient {
        value: v5,
        dx: [v14, S::constant(0.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 1.
///
/// No operations.
fn observable_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[x_x, _, _] = x;
    x_x
}

/// Observable 1 with all first derivatives.
///
/// No operations.
fn d_observable_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[x_x, _, _] = x;
    model::RateGradient {
        value: x_x,
        dx: [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 2.
///
/// No operations.
fn observable_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[_, x_Y, _] = x;
    x_Y
}

/// Observable 2 with all first derivatives.
///
/// No operations.
fn d_observable_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[_, x_Y, _] = x;
    model::RateGradient {
        value: x_Y,
        dx: [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 3 in mode `first`.
///
/// 12 additions, 3 multiplications, 2 fused multiply-adds, 3 divisions, 13 function calls.
fn observable_3_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[p_a, p_b, _, _] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1.mul_add(v3, v0);
    let v5 = v2 / S::constant(4.0);
    let v6 = v5.asin();
    let v7 = v4 + v6;
    let v8 = p_a * x_Y;
    let v9 = v8 / S::constant(4.0);
    let v10 = v9.acos();
    let v11 = v7 - v10;
    let v12 = p_b * x_x;
    let v13 = v12.atan();
    let v14 = v11 + v13;
    let v15 = x_x + S::constant(2.0);
    let v16 = x_Y + S::constant(3.0);
    let v17 = v15.atan2(v16);
    let v18 = v14 + v17;
    let v19 = v2.sinh();
    let v20 = v8.cosh();
    let v21 = v19 + v20;
    let v22 = x_self.tanh();
    let v23 = v21 + v22;
    let v24 = v12.asinh();
    let v25 = v23 + v24;
    let v26 = x_x.mul_add(x_x, S::constant(2.0));
    let v27 = v26.acosh();
    let v28 = v25 + v27;
    let v29 = v5.atanh();
    let v30 = v28 + v29;
    let v31 = v30 / S::constant(10.0);
    let v32 = v18 + v31;
    v32
}

/// Observable 3 in mode `first` with all first derivatives.
///
/// 21 additions, 12 multiplications, 18 fused multiply-adds, 18 divisions, 21 function calls.
fn d_observable_3_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[p_a, p_b, _, _] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = v4 / S::constant(4.0);
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = p_a * x_Y;
    let v11 = v10 / S::constant(4.0);
    let v12 = v11.acos();
    let v13 = v9 - v12;
    let v14 = p_b * x_x;
    let v15 = v14.atan();
    let v16 = v13 + v15;
    let v17 = x_x + S::constant(2.0);
    let v18 = x_Y + S::constant(3.0);
    let v19 = v17.atan2(v18);
    let v20 = v16 + v19;
    let v21 = v4.sinh();
    let v22 = v10.cosh();
    let v23 = v21 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v14.asinh();
    let v27 = v25 + v26;
    let v28 = x_x.mul_add(x_x, S::constant(2.0));
    let v29 = v28.acosh();
    let v30 = v27 + v29;
    let v31 = v7.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v20 + v33;
    let v35 = v4.cos();
    let v36 = v35 * v35;
    let v37 = p_a / v36;
    let v38 = v2.mul_add(v37, v1);
    let v39 = S::constant(0.25) * p_a;
    let v40 = (-v7).mul_add(v7, S::constant(1.0));
    let v41 = v40.sqrt();
    let v42 = v39 / v41;
    let v43 = v38 + v42;
    let v44 = v14.mul_add(v14, S::constant(1.0));
    let v45 = p_b / v44;
    let v46 = v43 + v45;
    let v47 = v17 * v17;
    let v48 = v18.mul_add(v18, v47);
    let v49 = v18 / v48;
    let v50 = v46 + v49;
    let v51 = v4.cosh();
    let v52 = v44.sqrt();
    let v53 = p_b / v52;
    let v54 = v51.mul_add(p_a, v53);
    let v55 = v28 - S::constant(1.0);
    let v56 = v55.sqrt();
    let v57 = S::constant(1.0) / v56;
    let v58 = v28 + S::constant(1.0);
    let v59 = v58.sqrt();
    let v60 = v57 / v59;
    let v61 = x_x + x_x;
    let v62 = v60.mul_add(v61, v54);
    let v63 = v39 / v40;
    let v64 = v62 + v63;
    let v65 = S::constant(0.1).mul_add(v64, v50);
    let v66 = v10.sinh();
    let v67 = v66 * p_a;
    let v68 = v5 * v3;
    let v69 = (-v11).mul_add(v11, S::constant(1.0));
    let v70 = v69.sqrt();
    let v71 = S::constant(-1.0) / v70;
    let v72 = v71.mul_add(v39, v68);
    let v73 = v17 / v48;
    let v74 = v72 + v73;
    let v75 = S::constant(0.1).mul_add(v67, -v74);
    let v76 = (-v24).mul_add(v24, S::constant(1.0));
    let v77 = S::constant(0.1) * v76;
    let v78 = x_x / v36;
    let v79 = S::constant(0.25) * x_x;
    let v80 = v79 / v41;
    let v81 = v2.mul_add(v78, v80);
    let v82 = S::constant(0.25) * x_Y;
    let v83 = (-v71).mul_add(v82, v81);
    let v84 = v51 * x_x;
    let v85 = v66.mul_add(x_Y, v84);
    let v86 = v79 / v40;
    let v87 = v85 + v86;
    let v88 = S::constant(0.1).mul_add(v87, v83);
    let v89 = x_x / v44;
    let v90 = x_x / v52;
    let v91 = S::constant(0.1).mul_add(v90, v89);
    model::RateGradient {
        value: v34,
        dx: [v65, v75, v77],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [v88, v91, S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Observable 3 in mode `second`.
///
/// No operations.
fn observable_3_second<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[_, _, _, _] = env.branch else { return nan() };
    let &[_, x_Y, _] = x;
    x_Y
}

/// Observable 3 in mode `second` with all first derivatives.
///
/// No operations.
fn d_observable_3_second<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[_, x_Y, _] = x;
    model::RateGradient {
        value: x_Y,
        dx: [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State derivative f of mode `first` and, for each column v, (df/dx) v.
///
/// Once: 46 additions, 17 multiplications, 23 fused multiply-adds, 23 divisions, 31 function calls, 13 selections. A column: 3 multiplications, 3 fused multiply-adds.
#[inline]
fn tangent_flow_first<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[n_n, _] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[b0, b1, b2, b3] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = v4 / S::constant(4.0);
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = p_a * x_Y;
    let v11 = v10 / S::constant(4.0);
    let v12 = v11.acos();
    let v13 = v9 - v12;
    let v14 = p_b * x_x;
    let v15 = v14.atan();
    let v16 = v13 + v15;
    let v17 = x_x + S::constant(2.0);
    let v18 = x_Y + S::constant(3.0);
    let v19 = v17.atan2(v18);
    let v20 = v16 + v19;
    let v21 = v4.sinh();
    let v22 = v10.cosh();
    let v23 = v21 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v14.asinh();
    let v27 = v25 + v26;
    let v28 = x_x * x_x;
    let v29 = S::constant(2.0) + v28;
    let v30 = v29.acosh();
    let v31 = v27 + v30;
    let v32 = v7.atanh();
    let v33 = v31 + v32;
    let v34 = v33 / S::constant(10.0);
    let v35 = v20 + v34;
    let v36 = x_x.mul_add(v28, v28);
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v28 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v28;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v28;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57.mul_add(v59, v51);
    let v61 = v60 - x_x;
    let v62 = x_x.sqrt();
    let v63 = x_x.mul_add(v62, v62);
    let v64 = S::select(b0, v63, v52);
    let v65 = x_x * x_Y;
    let v66 = S::select(b0, v65, v0);
    let v67 = S::select(b1, x_x, x_Y);
    let v68 = S::select(b2, x_x, p_a);
    let v69 = v67 + v68;
    let v70 = S::select(b3, v66, v69);
    let v71 = v64 + v70;
    let v72 = S::constant(-1.0).pow(n_n);
    let v73 = v72.mul_add(tau, v71);
    let v74 = v4.cos();
    let v75 = v74 * v74;
    let v76 = p_a / v75;
    let v77 = v2.mul_add(v76, v1);
    let v78 = S::constant(0.25) * p_a;
    let v79 = (-v7).mul_add(v7, S::constant(1.0));
    let v80 = v79.sqrt();
    let v81 = v78 / v80;
    let v82 = v77 + v81;
    let v83 = v14.mul_add(v14, S::constant(1.0));
    let v84 = p_b / v83;
    let v85 = v82 + v84;
    let v86 = v17 * v17;
    let v87 = v18.mul_add(v18, v86);
    let v88 = v18 / v87;
    let v89 = v85 + v88;
    let v90 = v4.cosh();
    let v91 = v83.sqrt();
    let v92 = p_b / v91;
    let v93 = v90.mul_add(p_a, v92);
    let v94 = v29 - S::constant(1.0);
    let v95 = v94.sqrt();
    let v96 = S::constant(1.0) / v95;
    let v97 = v29 + S::constant(1.0);
    let v98 = v97.sqrt();
    let v99 = v96 / v98;
    let v100 = x_x + x_x;
    let v101 = v99.mul_add(v100, v93);
    let v102 = v78 / v79;
    let v103 = v101 + v102;
    let v104 = S::constant(0.1).mul_add(v103, v89);
    let v105 = x_x.mul_add(v100, v28);
    let v106 = v100 + v105;
    let v107 = v39 / v38;
    let v108 = v37 + v37;
    let v109 = v107 * v108;
    let v110 = S::constant(-0.01).mul_add(v109, v106);
    let v111 = x_x / v43;
    let v112 = v110 + v111;
    let v113 = v42.pow(S::constant(1.5));
    let v114 = S::constant(2.5) * v113;
    let v115 = v114.mul_add(v100, v112);
    let v116 = p_c - S::constant(1.0);
    let v117 = v42.pow(v116);
    let v118 = p_c * v117;
    let v119 = v118.mul_add(v100, v115);
    let v120 = v49 / v43;
    let v121 = (-v120).mul_add(v111, v119);
    let v122 = v100 / v55;
    let v123 = (-v53).mul_add(v100, v122);
    let v124 = v59 * v123;
    let v125 = S::constant(0.1).mul_add(v121, v124);
    let v126 = v125 + S::constant(-1.0);
    let v127 = v62 + v62;
    let v128 = S::constant(1.0) / v127;
    let v129 = x_x / v127;
    let v130 = v62 + v129;
    let v131 = v128 + v130;
    let v132 = -v100;
    let v133 = S::select(b0, v131, v132);
    let v134 = S::select(b0, x_Y, v1);
    let v135 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v136 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v137 = v135 + v136;
    let v138 = S::select(b3, v134, v137);
    let v139 = v133 + v138;
    let v140 = v10.sinh();
    let v141 = v140 * p_a;
    let v142 = v5 * v3;
    let v143 = (-v11).mul_add(v11, S::constant(1.0));
    let v144 = v143.sqrt();
    let v145 = S::constant(-1.0) / v144;
    let v146 = v145.mul_add(v78, v142);
    let v147 = v17 / v87;
    let v148 = v146 + v147;
    let v149 = S::constant(0.1).mul_add(v141, -v148);
    let v150 = S::select(b0, x_x, S::constant(0.0));
    let v151 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v152 = S::select(b3, v150, v151);
    let v153 = (-v24).mul_add(v24, S::constant(1.0));
    let v154 = S::constant(0.1) * v153;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_x, dx_Y, dx_self] = column;
        *product = [
            v154.mul_add(dx_self, v149.mul_add(dx_Y, v104 * dx_x)),
            v126 * dx_x,
            v152.mul_add(dx_Y, v139 * dx_x),
        ];
    }
    ([v35, v61, v73], products)
}

/// State derivative f and integrands of mode `first` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 47 additions, 27 multiplications, 29 fused multiply-adds, 29 divisions, 32 function calls, 15 selections. A column: 5 multiplications, 13 fused multiply-adds.
#[inline]
fn tangent_integrated_first<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    dx: &[[S; STATES]; C],
    dp: &[[S; PARAMETERS]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Integrated<S, STATES, INTEGRALS, C> {
    let &[n_n, _] = env.memory else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[b0, b1, b2, b3] = env.branch else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let tau = env.tau;
    let t = env.t;
    let &[x_x, x_Y, x_self] = x;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = v4 / S::constant(4.0);
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = p_a * x_Y;
    let v11 = v10 / S::constant(4.0);
    let v12 = v11.acos();
    let v13 = v9 - v12;
    let v14 = p_b * x_x;
    let v15 = v14.atan();
    let v16 = v13 + v15;
    let v17 = x_x + S::constant(2.0);
    let v18 = x_Y + S::constant(3.0);
    let v19 = v17.atan2(v18);
    let v20 = v16 + v19;
    let v21 = v4.sinh();
    let v22 = v10.cosh();
    let v23 = v21 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v14.asinh();
    let v27 = v25 + v26;
    let v28 = x_x * x_x;
    let v29 = S::constant(2.0) + v28;
    let v30 = v29.acosh();
    let v31 = v27 + v30;
    let v32 = v7.atanh();
    let v33 = v31 + v32;
    let v34 = v33 / S::constant(10.0);
    let v35 = v20 + v34;
    let v36 = x_x.mul_add(v28, v28);
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v28 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v28;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v28;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57.mul_add(v59, v51);
    let v61 = v60 - x_x;
    let v62 = x_x.sqrt();
    let v63 = x_x.mul_add(v62, v62);
    let v64 = S::select(b0, v63, v52);
    let v65 = x_x * x_Y;
    let v66 = S::select(b0, v65, v0);
    let v67 = S::select(b1, x_x, x_Y);
    let v68 = S::select(b2, x_x, p_a);
    let v69 = v67 + v68;
    let v70 = S::select(b3, v66, v69);
    let v71 = v64 + v70;
    let v72 = S::constant(-1.0).pow(n_n);
    let v73 = v72.mul_add(tau, v71);
    let v74 = v35 * x_Y;
    let v75 = v4.cos();
    let v76 = v75 * v75;
    let v77 = p_a / v76;
    let v78 = v2.mul_add(v77, v1);
    let v79 = S::constant(0.25) * p_a;
    let v80 = (-v7).mul_add(v7, S::constant(1.0));
    let v81 = v80.sqrt();
    let v82 = v79 / v81;
    let v83 = v78 + v82;
    let v84 = v14.mul_add(v14, S::constant(1.0));
    let v85 = p_b / v84;
    let v86 = v83 + v85;
    let v87 = v17 * v17;
    let v88 = v18.mul_add(v18, v87);
    let v89 = v18 / v88;
    let v90 = v86 + v89;
    let v91 = v4.cosh();
    let v92 = v84.sqrt();
    let v93 = p_b / v92;
    let v94 = v91.mul_add(p_a, v93);
    let v95 = v29 - S::constant(1.0);
    let v96 = v95.sqrt();
    let v97 = S::constant(1.0) / v96;
    let v98 = v29 + S::constant(1.0);
    let v99 = v98.sqrt();
    let v100 = v97 / v99;
    let v101 = x_x + x_x;
    let v102 = v100.mul_add(v101, v94);
    let v103 = v79 / v80;
    let v104 = v102 + v103;
    let v105 = S::constant(0.1).mul_add(v104, v90);
    let v106 = x_x.mul_add(v101, v28);
    let v107 = v101 + v106;
    let v108 = v39 / v38;
    let v109 = v37 + v37;
    let v110 = v108 * v109;
    let v111 = S::constant(-0.01).mul_add(v110, v107);
    let v112 = x_x / v43;
    let v113 = v111 + v112;
    let v114 = v42.pow(S::constant(1.5));
    let v115 = S::constant(2.5) * v114;
    let v116 = v115.mul_add(v101, v113);
    let v117 = p_c - S::constant(1.0);
    let v118 = v42.pow(v117);
    let v119 = p_c * v118;
    let v120 = v119.mul_add(v101, v116);
    let v121 = v49 / v43;
    let v122 = (-v121).mul_add(v112, v120);
    let v123 = v101 / v55;
    let v124 = (-v53).mul_add(v101, v123);
    let v125 = v59 * v124;
    let v126 = S::constant(0.1).mul_add(v122, v125);
    let v127 = v126 + S::constant(-1.0);
    let v128 = v62 + v62;
    let v129 = S::constant(1.0) / v128;
    let v130 = x_x / v128;
    let v131 = v62 + v130;
    let v132 = v129 + v131;
    let v133 = -v101;
    let v134 = S::select(b0, v132, v133);
    let v135 = S::select(b0, x_Y, v1);
    let v136 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v137 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v138 = v136 + v137;
    let v139 = S::select(b3, v135, v138);
    let v140 = v134 + v139;
    let v141 = x_Y * v105;
    let v142 = v10.sinh();
    let v143 = v142 * p_a;
    let v144 = v5 * v3;
    let v145 = (-v11).mul_add(v11, S::constant(1.0));
    let v146 = v145.sqrt();
    let v147 = S::constant(-1.0) / v146;
    let v148 = v147.mul_add(v79, v144);
    let v149 = v17 / v88;
    let v150 = v148 + v149;
    let v151 = S::constant(0.1).mul_add(v143, -v150);
    let v152 = S::select(b0, x_x, S::constant(0.0));
    let v153 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v154 = S::select(b3, v152, v153);
    let v155 = x_Y.mul_add(v151, v35);
    let v156 = (-v24).mul_add(v24, S::constant(1.0));
    let v157 = S::constant(0.1) * v156;
    let v158 = x_Y * v157;
    let v159 = x_x / v76;
    let v160 = S::constant(0.25) * x_x;
    let v161 = v160 / v81;
    let v162 = v2.mul_add(v159, v161);
    let v163 = S::constant(0.25) * x_Y;
    let v164 = (-v147).mul_add(v163, v162);
    let v165 = v91 * x_x;
    let v166 = v142.mul_add(x_Y, v165);
    let v167 = v160 / v80;
    let v168 = v166 + v167;
    let v169 = S::constant(0.1).mul_add(v168, v164);
    let v170 = S::select(b2, S::constant(0.0), S::constant(1.0));
    let v171 = S::select(b3, S::constant(0.0), v170);
    let v172 = x_Y * v169;
    let v173 = x_x / v84;
    let v174 = x_x / v92;
    let v175 = S::constant(0.1).mul_add(v174, v173);
    let v176 = x_Y * v175;
    let v177 = v42.ln();
    let v178 = v177 * v47;
    let v179 = S::constant(0.1) * v178;
    let v180 = v59 / v55;
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[dx_x, dx_Y, dx_self] = dx;
        let &[dp_a, dp_b, dp_c, dp_type] = dp;
        *dflow = [
            v175
                .mul_add(
                    dp_b,
                    v169
                        .mul_add(
                            dp_a,
                            v157.mul_add(dx_self, v151.mul_add(dx_Y, v105 * dx_x)),
                        ),
                ),
            v180.mul_add(dp_type, v179.mul_add(dp_c, v127 * dx_x)),
            v171.mul_add(dp_a, v154.mul_add(dx_Y, v140 * dx_x)),
        ];
        *dintegrands = [
            x_x.mul_add(dx_Y, x_Y * dx_x),
            v176
                .mul_add(
                    dp_b,
                    v172
                        .mul_add(
                            dp_a,
                            v158.mul_add(dx_self, v155.mul_add(dx_Y, v141 * dx_x)),
                        ),
                ),
        ];
    }
    model::Integrated {
        flow: [v35, v61, v73],
        integrands: [v65, v74],
        dflow,
        dintegrands,
    }
}

/// State derivative f of mode `second` and, for each column v, (df/dx) v.
///
/// Once: 1 addition, 1 multiplication. A column: 1 addition, 1 multiplication, 1 fused multiply-add.
#[inline]
fn tangent_flow_second<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_, _] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[x_x, x_Y, x_self] = x;
    let v0 = -x_x;
    let v1 = x_Y * x_self;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_x, dx_Y, dx_self] = column;
        *product = [dx_Y, -dx_x, x_Y.mul_add(dx_self, x_self * dx_Y)];
    }
    ([x_Y, v0, v1], products)
}

/// State derivative f and integrands of mode `second` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 2 additions, 3 multiplications. A column: 1 addition, 3 multiplications, 2 fused multiply-adds.
#[inline]
fn tangent_integrated_second<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    dx: &[[S; STATES]; C],
    dp: &[[S; PARAMETERS]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Integrated<S, STATES, INTEGRALS, C> {
    let &[_, _] = env.memory else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[_, _, _, _] = env.branch else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[x_x, x_Y, x_self] = x;
    let v0 = -x_x;
    let v1 = x_Y * x_self;
    let v2 = x_x * x_Y;
    let v3 = x_Y * x_Y;
    let v4 = x_Y + x_Y;
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[dx_x, dx_Y, dx_self] = dx;
        let &[_, _, _, _] = dp;
        *dflow = [dx_Y, -dx_x, x_Y.mul_add(dx_self, x_self * dx_Y)];
        *dintegrands = [x_x.mul_add(dx_Y, x_Y * dx_x), v4 * dx_Y];
    }
    model::Integrated {
        flow: [x_Y, v0, v1],
        integrands: [v2, v3],
        dflow,
        dintegrands,
    }
}

/// The integrands in mode `first` and their derivatives along each direction.
///
/// Once: 21 additions, 18 multiplications, 19 fused multiply-adds, 18 divisions, 21 function calls. A column: 2 multiplications, 5 fused multiply-adds.
#[inline]
fn tangent_integrands_first<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
    let &[_, _] = env.memory else {
        return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    };
    let &[_, _, _, _] = env.branch else {
        return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    };
    let &[p_a, p_b, _, _] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x * x_Y;
    let (v1, v2) = x_x.sin_cos();
    let (v4, v3) = x_Y.sin_cos();
    let v5 = p_a * x_x;
    let v6 = v5.tan();
    let v7 = v3.mul_add(v6, v1);
    let v8 = v5 / S::constant(4.0);
    let v9 = v8.asin();
    let v10 = v7 + v9;
    let v11 = p_a * x_Y;
    let v12 = v11 / S::constant(4.0);
    let v13 = v12.acos();
    let v14 = v10 - v13;
    let v15 = p_b * x_x;
    let v16 = v15.atan();
    let v17 = v14 + v16;
    let v18 = x_x + S::constant(2.0);
    let v19 = x_Y + S::constant(3.0);
    let v20 = v18.atan2(v19);
    let v21 = v17 + v20;
    let v22 = v5.sinh();
    let v23 = v11.cosh();
    let v24 = v22 + v23;
    let v25 = x_self.tanh();
    let v26 = v24 + v25;
    let v27 = v15.asinh();
    let v28 = v26 + v27;
    let v29 = x_x.mul_add(x_x, S::constant(2.0));
    let v30 = v29.acosh();
    let v31 = v28 + v30;
    let v32 = v8.atanh();
    let v33 = v31 + v32;
    let v34 = v33 / S::constant(10.0);
    let v35 = v21 + v34;
    let v36 = v35 * x_Y;
    let v37 = v5.cos();
    let v38 = v37 * v37;
    let v39 = p_a / v38;
    let v40 = v3.mul_add(v39, v2);
    let v41 = S::constant(0.25) * p_a;
    let v42 = (-v8).mul_add(v8, S::constant(1.0));
    let v43 = v42.sqrt();
    let v44 = v41 / v43;
    let v45 = v40 + v44;
    let v46 = v15.mul_add(v15, S::constant(1.0));
    let v47 = p_b / v46;
    let v48 = v45 + v47;
    let v49 = v18 * v18;
    let v50 = v19.mul_add(v19, v49);
    let v51 = v19 / v50;
    let v52 = v48 + v51;
    let v53 = v5.cosh();
    let v54 = v46.sqrt();
    let v55 = p_b / v54;
    let v56 = v53.mul_add(p_a, v55);
    let v57 = v29 - S::constant(1.0);
    let v58 = v57.sqrt();
    let v59 = S::constant(1.0) / v58;
    let v60 = v29 + S::constant(1.0);
    let v61 = v60.sqrt();
    let v62 = v59 / v61;
    let v63 = x_x + x_x;
    let v64 = v62.mul_add(v63, v56);
    let v65 = v41 / v42;
    let v66 = v64 + v65;
    let v67 = S::constant(0.1).mul_add(v66, v52);
    let v68 = x_Y * v67;
    let v69 = v11.sinh();
    let v70 = v69 * p_a;
    let v71 = v6 * v4;
    let v72 = (-v12).mul_add(v12, S::constant(1.0));
    let v73 = v72.sqrt();
    let v74 = S::constant(-1.0) / v73;
    let v75 = v74.mul_add(v41, v71);
    let v76 = v18 / v50;
    let v77 = v75 + v76;
    let v78 = S::constant(0.1).mul_add(v70, -v77);
    let v79 = x_Y.mul_add(v78, v35);
    let v80 = (-v25).mul_add(v25, S::constant(1.0));
    let v81 = S::constant(0.1) * v80;
    let v82 = x_Y * v81;
    let v83 = x_x / v38;
    let v84 = S::constant(0.25) * x_x;
    let v85 = v84 / v43;
    let v86 = v3.mul_add(v83, v85);
    let v87 = S::constant(0.25) * x_Y;
    let v88 = (-v74).mul_add(v87, v86);
    let v89 = v53 * x_x;
    let v90 = v69.mul_add(x_Y, v89);
    let v91 = v84 / v42;
    let v92 = v90 + v91;
    let v93 = S::constant(0.1).mul_add(v92, v88);
    let v94 = x_Y * v93;
    let v95 = x_x / v46;
    let v96 = x_x / v54;
    let v97 = S::constant(0.1).mul_add(v96, v95);
    let v98 = x_Y * v97;
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (product, (((&[dx_x, dx_Y, dx_self], _), &[dp_a, dp_b, _, _]), _)) in products
        .iter_mut()
        .zip(directions)
    {
        *product = [
            x_x.mul_add(dx_Y, x_Y * dx_x),
            v98
                .mul_add(
                    dp_b,
                    v94
                        .mul_add(
                            dp_a,
                            v82.mul_add(dx_self, v79.mul_add(dx_Y, v68 * dx_x)),
                        ),
                ),
        ];
    }
    ([v0, v36], products)
}

/// The integrands in mode `second` and their derivatives along each direction.
///
/// Once: 1 addition, 2 multiplications. A column: 2 multiplications, 1 fused multiply-add.
#[inline]
fn tangent_integrands_second<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
    let &[_, _] = env.memory else {
        return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    };
    let &[_, _, _, _] = env.branch else {
        return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    };
    let &[x_x, x_Y, _] = x;
    let v0 = x_x * x_Y;
    let v1 = x_Y * x_Y;
    let v2 = x_Y + x_Y;
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (product, (((&[dx_x, dx_Y, _], _), _), _)) in products.iter_mut().zip(directions)
    {
        *product = [x_x.mul_add(dx_Y, x_Y * dx_x), v2 * dx_Y];
    }
    ([v0, v1], products)
}

/// Number of terms that depend only on the clock, on parameters, memory and selectors: the most of any mode.
const CLOCK_TERMS: usize = 9;

/// The terms of mode `first`'s flow that do not depend on the state.
///
/// 2 additions, 5 multiplications, 2 function calls, 4 selections.
#[cfg_attr(not(debug_assertions), inline(always))]
fn clock_first<S: scalar::Scalar>(
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; CLOCK_TERMS] {
    let &[n_n, _] = env.memory else { return [nan(); CLOCK_TERMS] };
    let &[b0, b1, b2, _] = env.branch else { return [nan(); CLOCK_TERMS] };
    let &[p_a, _, p_c, _] = env.p;
    let tau = env.tau;
    let t = env.t;
    let v0 = p_a * S::constant(0.25);
    let v1 = S::constant(3.0) * t;
    let v2 = v1.cos();
    let v3 = S::constant(-1.0).pow(n_n);
    let v4 = v3 * tau;
    let v5 = S::constant(0.25) * p_a;
    let v6 = p_c - S::constant(1.0);
    let v7 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v8 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v9 = v7 + v8;
    let v10 = p_a * S::constant(0.1);
    let v11 = S::select(b0, S::constant(1.0), S::constant(0.0));
    let v12 = S::select(b1, S::constant(0.0), S::constant(1.0));
    [v0, v2, v4, v5, v6, v9, v10, v11, v12]
}

/// State derivative f of mode `first` and, for each column v, (df/dx) v, from the terms
/// that do not depend on the state.
///
/// Once: 40 additions, 21 multiplications, 27 fused multiply-adds, 13 divisions, 29 function calls, 9 selections. A column: 3 multiplications, 3 fused multiply-adds.
#[cfg_attr(not(debug_assertions), inline(always))]
fn staged_flow_first<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    clock: &[S; CLOCK_TERMS],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_, _] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[b0, b1, b2, b3] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[p_a, p_b, p_c, p_type] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let &[c0, c1, c2, c3, c4, c5, c6, c7, c8] = clock;
    let (v0, v1) = x_x.sin_cos();
    let (v3, v2) = x_Y.sin_cos();
    let v4 = p_a * x_x;
    let v5 = v4.tan();
    let v6 = v2.mul_add(v5, v0);
    let v7 = c0 * x_x;
    let v8 = v7.asin();
    let v9 = v6 + v8;
    let v10 = c0 * x_Y;
    let v11 = v10.acos();
    let v12 = v9 - v11;
    let v13 = p_b * x_x;
    let v14 = v13.atan();
    let v15 = v12 + v14;
    let v16 = x_x + S::constant(2.0);
    let v17 = x_Y + S::constant(3.0);
    let v18 = v16.atan2(v17);
    let v19 = v15 + v18;
    let v20 = v4.sinh();
    let v21 = p_a * x_Y;
    let v22 = v21.cosh();
    let v23 = v20 + v22;
    let v24 = x_self.tanh();
    let v25 = v23 + v24;
    let v26 = v13.asinh();
    let v27 = v25 + v26;
    let v28 = x_x * x_x;
    let v29 = S::constant(2.0) + v28;
    let v30 = v29.acosh();
    let v31 = v27 + v30;
    let v32 = v7.atanh();
    let v33 = v31 + v32;
    let v34 = S::constant(0.1).mul_add(v33, v19);
    let v35 = x_x.mul_add(v28, v28);
    let v36 = x_x + S::constant(5.0);
    let v37 = v36 * v36;
    let v38 = S::constant(1.0) / v37;
    let v39 = S::constant(0.01).mul_add(v38, v35);
    let v40 = v28 + S::constant(1.0);
    let v41 = v40.sqrt();
    let v42 = v39 + v41;
    let v43 = v40.pow(S::constant(2.5));
    let v44 = v42 + v43;
    let v45 = v40.pow(p_c);
    let v46 = v44 + v45;
    let v47 = S::constant(1.0) / v41;
    let v48 = v46 + v47;
    let v49 = -v28;
    let v50 = v49.exp();
    let v51 = S::constant(1.0) + v28;
    let v52 = v51 + p_type;
    let v53 = v52.ln();
    let v54 = v50 + v53;
    let v55 = c1 * v54;
    let v56 = S::constant(0.1).mul_add(v48, v55);
    let v57 = v56 - x_x;
    let v58 = x_x.sqrt();
    let v59 = x_x.mul_add(v58, v58);
    let v60 = S::select(b0, v59, v49);
    let v61 = x_x * x_Y;
    let v62 = S::select(b0, v61, v0);
    let v63 = S::select(b1, x_x, x_Y);
    let v64 = S::select(b2, x_x, p_a);
    let v65 = v63 + v64;
    let v66 = S::select(b3, v62, v65);
    let v67 = v60 + v66;
    let v68 = v67 + c2;
    let v69 = v4.cos();
    let v70 = v69 * v69;
    let v71 = p_a / v70;
    let v72 = v2.mul_add(v71, v1);
    let v73 = (-v7).mul_add(v7, S::constant(1.0));
    let v74 = v73.sqrt();
    let v75 = c3 / v74;
    let v76 = v72 + v75;
    let v77 = v13.mul_add(v13, S::constant(1.0));
    let v78 = p_b / v77;
    let v79 = v76 + v78;
    let v80 = v16 * v16;
    let v81 = v17.mul_add(v17, v80);
    let v82 = S::constant(1.0) / v81;
    let v83 = v17.mul_add(v82, v79);
    let v84 = v4.cosh();
    let v85 = v77.sqrt();
    let v86 = p_b / v85;
    let v87 = p_a.mul_add(v84, v86);
    let v88 = v29 - S::constant(1.0);
    let v89 = v88.sqrt();
    let v90 = S::constant(1.0) / v89;
    let v91 = v29 + S::constant(1.0);
    let v92 = v91.sqrt();
    let v93 = v90 / v92;
    let v94 = x_x + x_x;
    let v95 = v93.mul_add(v94, v87);
    let v96 = c3 / v73;
    let v97 = v95 + v96;
    let v98 = S::constant(0.1).mul_add(v97, v83);
    let v99 = x_x.mul_add(v94, v28);
    let v100 = v94 + v99;
    let v101 = v38 * v38;
    let v102 = v36 + v36;
    let v103 = v101 * v102;
    let v104 = S::constant(-0.01).mul_add(v103, v100);
    let v105 = x_x * v47;
    let v106 = v104 + v105;
    let v107 = v40.pow(S::constant(1.5));
    let v108 = v107 * v94;
    let v109 = S::constant(2.5).mul_add(v108, v106);
    let v110 = v40.pow(c4);
    let v111 = v110 * v94;
    let v112 = p_c.mul_add(v111, v109);
    let v113 = v47 * v47;
    let v114 = (-v113).mul_add(v105, v112);
    let v115 = v94 / v52;
    let v116 = (-v50).mul_add(v94, v115);
    let v117 = c1 * v116;
    let v118 = S::constant(0.1).mul_add(v114, v117);
    let v119 = v118 + S::constant(-1.0);
    let v120 = v58 + v58;
    let v121 = S::constant(1.0) / v120;
    let v122 = x_x.mul_add(v121, v58);
    let v123 = v121 + v122;
    let v124 = -v94;
    let v125 = S::select(b0, v123, v124);
    let v126 = S::select(b0, x_Y, v1);
    let v127 = S::select(b3, v126, c5);
    let v128 = v125 + v127;
    let v129 = v21.sinh();
    let v130 = v5 * v3;
    let v131 = (-v10).mul_add(v10, S::constant(1.0));
    let v132 = v131.sqrt();
    let v133 = S::constant(-1.0) / v132;
    let v134 = c3.mul_add(v133, v130);
    let v135 = v16.mul_add(v82, v134);
    let v136 = c6.mul_add(v129, -v135);
    let v137 = c7 * x_x;
    let v138 = S::select(b3, v137, c8);
    let v139 = (-v24).mul_add(v24, S::constant(1.0));
    let v140 = S::constant(0.1) * v139;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_x, dx_Y, dx_self] = column;
        *product = [
            v140.mul_add(dx_self, v136.mul_add(dx_Y, v98 * dx_x)),
            v119 * dx_x,
            v138.mul_add(dx_Y, v128 * dx_x),
        ];
    }
    ([v34, v57, v68], products)
}

/// The terms of mode `second`'s flow that do not depend on the state.
///
/// No operations.
#[cfg_attr(not(debug_assertions), inline(always))]
fn clock_second<S: scalar::Scalar>(
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; CLOCK_TERMS] {
    let &[_, _] = env.memory else { return [nan(); CLOCK_TERMS] };
    let &[_, _, _, _] = env.branch else { return [nan(); CLOCK_TERMS] };
    [
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
        S::constant(0.0),
    ]
}

/// State derivative f of mode `second` and, for each column v, (df/dx) v, from the terms
/// that do not depend on the state.
///
/// Once: 1 addition, 1 multiplication. A column: 1 addition, 1 multiplication, 1 fused multiply-add.
#[cfg_attr(not(debug_assertions), inline(always))]
fn staged_flow_second<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    clock: &[S; CLOCK_TERMS],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_, _] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[x_x, x_Y, x_self] = x;
    let &[_, _, _, _, _, _, _, _, _] = clock;
    let v0 = -x_x;
    let v1 = x_Y * x_self;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_x, dx_Y, dx_self] = column;
        *product = [dx_Y, -dx_x, x_Y.mul_add(dx_self, x_self * dx_Y)];
    }
    ([x_Y, v0, v1], products)
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
