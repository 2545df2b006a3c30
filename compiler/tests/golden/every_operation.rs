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
/// 32 additions, 12 multiplications, 7 divisions, 21 function calls, 5 selections.
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
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = x_x * v27;
    let v36 = v27 + v35;
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v27 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v27;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v27;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57 * v59;
    let v61 = v51 + v60;
    let v62 = v61 - x_x;
    let v63 = x_x.sqrt();
    let v64 = x_x * v63;
    let v65 = v63 + v64;
    let v66 = S::select(b0, v65, v52);
    let v67 = x_x * x_Y;
    let v68 = S::select(b0, v67, v0);
    let v69 = S::select(b1, x_x, x_Y);
    let v70 = S::select(b2, x_x, p_a);
    let v71 = v69 + v70;
    let v72 = S::select(b3, v68, v71);
    let v73 = v66 + v72;
    let v74 = S::constant(-1.0).pow(n_n);
    let v75 = v74 * tau;
    let v76 = v73 + v75;
    [v34, v62, v76]
}

/// State derivative f and integrands of mode `first`.
///
/// 32 additions, 13 multiplications, 7 divisions, 21 function calls, 5 selections.
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
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = x_x * v27;
    let v36 = v27 + v35;
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v27 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v27;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v27;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57 * v59;
    let v61 = v51 + v60;
    let v62 = v61 - x_x;
    let v63 = x_x.sqrt();
    let v64 = x_x * v63;
    let v65 = v63 + v64;
    let v66 = S::select(b0, v65, v52);
    let v67 = x_x * x_Y;
    let v68 = S::select(b0, v67, v0);
    let v69 = S::select(b1, x_x, x_Y);
    let v70 = S::select(b2, x_x, p_a);
    let v71 = v69 + v70;
    let v72 = S::select(b3, v68, v71);
    let v73 = v66 + v72;
    let v74 = S::constant(-1.0).pow(n_n);
    let v75 = v74 * tau;
    let v76 = v73 + v75;
    let v77 = v34 * x_Y;
    ([v34, v62, v76], [v67, v77])
}

/// Residual F = M k - f of mode `first`, k the rates of the states.
///
/// 35 additions, 12 multiplications, 7 divisions, 21 function calls, 5 selections.
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
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = k_x - v34;
    let v36 = x_x * v27;
    let v37 = v27 + v36;
    let v38 = x_x + S::constant(5.0);
    let v39 = v38 * v38;
    let v40 = S::constant(1.0) / v39;
    let v41 = v40 / S::constant(100.0);
    let v42 = v37 + v41;
    let v43 = v27 + S::constant(1.0);
    let v44 = v43.sqrt();
    let v45 = v42 + v44;
    let v46 = v43.pow(S::constant(2.5));
    let v47 = v45 + v46;
    let v48 = v43.pow(p_c);
    let v49 = v47 + v48;
    let v50 = S::constant(1.0) / v44;
    let v51 = v49 + v50;
    let v52 = v51 / S::constant(10.0);
    let v53 = -v27;
    let v54 = v53.exp();
    let v55 = S::constant(1.0) + v27;
    let v56 = v55 + p_type;
    let v57 = v56.ln();
    let v58 = v54 + v57;
    let v59 = S::constant(3.0) * t;
    let v60 = v59.cos();
    let v61 = v58 * v60;
    let v62 = v52 + v61;
    let v63 = v62 - x_x;
    let v64 = k_Y - v63;
    let v65 = x_x.sqrt();
    let v66 = x_x * v65;
    let v67 = v65 + v66;
    let v68 = S::select(b0, v67, v53);
    let v69 = x_x * x_Y;
    let v70 = S::select(b0, v69, v0);
    let v71 = S::select(b1, x_x, x_Y);
    let v72 = S::select(b2, x_x, p_a);
    let v73 = v71 + v72;
    let v74 = S::select(b3, v70, v73);
    let v75 = v68 + v74;
    let v76 = S::constant(-1.0).pow(n_n);
    let v77 = v76 * tau;
    let v78 = v75 + v77;
    let v79 = k_self - v78;
    [v35, v64, v79]
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
/// 3 additions, 1 multiplication.
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
    let v2 = x_Y * x_self;
    let v3 = k_self - v2;
    [v0, v1, v3]
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
/// 4 additions, 3 multiplications, 2 function calls, 1 selection.
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
    let v1 = p_a * v0;
    let v2 = x_x - v1;
    let v3 = x_x.sqrt();
    let v4 = x_x * v3;
    let v5 = v3 + v4;
    let v6 = x_x * x_x;
    let v7 = -v6;
    let v8 = S::select(b0, v5, v7);
    let v9 = v2 + v8;
    v9
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
/// 5 additions, 3 multiplications, 2 function calls, 4 selections.
fn reset_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 2]) {
    let &[n_n, n_v0] = env.memory else { return (nan_state(), [nan(); 2]) };
    let &[b0, b1, b2, b3] = env.branch else { return (nan_state(), [nan(); 2]) };
    let &[p_a, p_b, _, p_type] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_self * p_b;
    let v1 = x_x + v0;
    let v2 = x_x * x_Y;
    let v3 = x_x.sin();
    let v4 = S::select(b0, v2, v3);
    let v5 = S::select(b1, x_x, x_Y);
    let v6 = S::select(b2, x_x, p_a);
    let v7 = v5 + v6;
    let v8 = S::select(b3, v4, v7);
    let v9 = S::constant(-1.0).pow(n_n);
    let v10 = v9 * p_type;
    let v11 = n_n + S::constant(1.0);
    let v12 = n_n + n_n;
    let v13 = n_v0 + v12;
    ([v1, v8, v10], [v11, v13])
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
/// 2 additions, 3 multiplications, 1 selection.
fn embed<S: scalar::Scalar>(z: &[S], p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_self, x_x] = z else { return nan_state() };
    let &[p_a, p_b, _, _] = p;
    let v0 = x_x * x_x;
    let v1 = p_a * v0;
    let v2 = p_b - x_x;
    let v3 = S::constant(0.0).less_equal(v2);
    let v4 = S::select(v3, p_b, x_x);
    let v5 = x_self * v4;
    let v6 = v1 + v5;
    [x_x, v6, x_self]
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
/// 1 addition, 2 multiplications, 2 divisions.
fn measures<S: scalar::Scalar>(functionals: &[S], p: &[S; PARAMETERS]) -> [S; 5] {
    let &[f0, f1, f2, f3, f4, f5, f6, _] = functionals else { return [nan(); 5] };
    let &[p_a, _, _, _] = p;
    let v0 = f3 * f3;
    let v1 = p_a + v0;
    let v2 = f2 / v1;
    let v3 = f4 * f5;
    let v4 = v3 / f0;
    [f0, f1, v2, v4, f6]
}

/// State derivative f of mode `first` with all first derivatives.
/// Components: x, Y, self; derivatives by columns.
///
/// 76 additions, 52 multiplications, 29 divisions, 35 function calls, 15 selections.
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
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = x_x * v27;
    let v36 = v27 + v35;
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v27 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v27;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v27;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57 * v59;
    let v61 = v51 + v60;
    let v62 = v61 - x_x;
    let v63 = x_x.sqrt();
    let v64 = x_x * v63;
    let v65 = v63 + v64;
    let v66 = S::select(b0, v65, v52);
    let v67 = x_x * x_Y;
    let v68 = S::select(b0, v67, v0);
    let v69 = S::select(b1, x_x, x_Y);
    let v70 = S::select(b2, x_x, p_a);
    let v71 = v69 + v70;
    let v72 = S::select(b3, v68, v71);
    let v73 = v66 + v72;
    let v74 = S::constant(-1.0).pow(n_n);
    let v75 = v74 * tau;
    let v76 = v73 + v75;
    let v77 = x_x.cos();
    let v78 = v2.cos();
    let v79 = v78 * v78;
    let v80 = p_a / v79;
    let v81 = v1 * v80;
    let v82 = v77 + v81;
    let v83 = S::constant(0.25) * p_a;
    let v84 = v6 * v6;
    let v85 = S::constant(1.0) - v84;
    let v86 = v85.sqrt();
    let v87 = v83 / v86;
    let v88 = v82 + v87;
    let v89 = v13 * v13;
    let v90 = S::constant(1.0) + v89;
    let v91 = p_b / v90;
    let v92 = v88 + v91;
    let v93 = v16 * v16;
    let v94 = v17 * v17;
    let v95 = v93 + v94;
    let v96 = v17 / v95;
    let v97 = v92 + v96;
    let v98 = v2.cosh();
    let v99 = v98 * p_a;
    let v100 = v90.sqrt();
    let v101 = p_b / v100;
    let v102 = v99 + v101;
    let v103 = v28 - S::constant(1.0);
    let v104 = v103.sqrt();
    let v105 = S::constant(1.0) / v104;
    let v106 = v28 + S::constant(1.0);
    let v107 = v106.sqrt();
    let v108 = v105 / v107;
    let v109 = x_x + x_x;
    let v110 = v108 * v109;
    let v111 = v102 + v110;
    let v112 = v83 / v85;
    let v113 = v111 + v112;
    let v114 = S::constant(0.1) * v113;
    let v115 = v97 + v114;
    let v116 = x_x * v109;
    let v117 = v27 + v116;
    let v118 = v109 + v117;
    let v119 = v39 / v38;
    let v120 = v37 + v37;
    let v121 = v119 * v120;
    let v122 = S::constant(0.01) * v121;
    let v123 = v118 - v122;
    let v124 = x_x / v43;
    let v125 = v123 + v124;
    let v126 = v42.pow(S::constant(1.5));
    let v127 = S::constant(2.5) * v126;
    let v128 = v127 * v109;
    let v129 = v125 + v128;
    let v130 = p_c - S::constant(1.0);
    let v131 = v42.pow(v130);
    let v132 = p_c * v131;
    let v133 = v132 * v109;
    let v134 = v129 + v133;
    let v135 = v49 / v43;
    let v136 = v135 * v124;
    let v137 = v134 - v136;
    let v138 = S::constant(0.1) * v137;
    let v139 = v109 / v55;
    let v140 = v53 * v109;
    let v141 = v139 - v140;
    let v142 = v59 * v141;
    let v143 = v138 + v142;
    let v144 = v143 + S::constant(-1.0);
    let v145 = v63 + v63;
    let v146 = S::constant(1.0) / v145;
    let v147 = x_x / v145;
    let v148 = v63 + v147;
    let v149 = v146 + v148;
    let v150 = -v109;
    let v151 = S::select(b0, v149, v150);
    let v152 = S::select(b0, x_Y, v77);
    let v153 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v154 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v155 = v153 + v154;
    let v156 = S::select(b3, v152, v155);
    let v157 = v151 + v156;
    let v158 = v9.sinh();
    let v159 = v158 * p_a;
    let v160 = S::constant(0.1) * v159;
    let v161 = x_Y.sin();
    let v162 = v3 * v161;
    let v163 = v10 * v10;
    let v164 = S::constant(1.0) - v163;
    let v165 = v164.sqrt();
    let v166 = S::constant(-1.0) / v165;
    let v167 = v166 * v83;
    let v168 = v162 + v167;
    let v169 = v16 / v95;
    let v170 = v168 + v169;
    let v171 = v160 - v170;
    let v172 = S::select(b0, x_x, S::constant(0.0));
    let v173 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v174 = S::select(b3, v172, v173);
    let v175 = v23 * v23;
    let v176 = S::constant(1.0) - v175;
    let v177 = S::constant(0.1) * v176;
    let v178 = x_x / v79;
    let v179 = v1 * v178;
    let v180 = S::constant(0.25) * x_x;
    let v181 = v180 / v86;
    let v182 = v179 + v181;
    let v183 = S::constant(0.25) * x_Y;
    let v184 = v166 * v183;
    let v185 = v182 - v184;
    let v186 = v98 * x_x;
    let v187 = v158 * x_Y;
    let v188 = v186 + v187;
    let v189 = v180 / v85;
    let v190 = v188 + v189;
    let v191 = S::constant(0.1) * v190;
    let v192 = v185 + v191;
    let v193 = S::select(b2, S::constant(0.0), S::constant(1.0));
    let v194 = S::select(b3, S::constant(0.0), v193);
    let v195 = x_x / v90;
    let v196 = x_x / v100;
    let v197 = S::constant(0.1) * v196;
    let v198 = v195 + v197;
    let v199 = v42.ln();
    let v200 = v199 * v47;
    let v201 = S::constant(0.1) * v200;
    let v202 = v59 / v55;
    let v203 = v58.sin();
    let v204 = S::constant(3.0) * v203;
    let v205 = v57 * v204;
    let v206 = -v205;
    model::Jacobian {
        value: [v34, v62, v76],
        dx: [
            [v115, v144, v157],
            [v171, S::constant(0.0), v174],
            [v177, S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [v192, S::constant(0.0), v194],
            [v198, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v201, S::constant(0.0)],
            [S::constant(0.0), v202, S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), v74],
        dt: [S::constant(0.0), v206, S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `first` with all first derivatives, by columns.
///
/// 89 additions, 52 multiplications, 29 divisions, 35 function calls, 15 selections.
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
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = k_x - v34;
    let v36 = x_x * v27;
    let v37 = v27 + v36;
    let v38 = x_x + S::constant(5.0);
    let v39 = v38 * v38;
    let v40 = S::constant(1.0) / v39;
    let v41 = v40 / S::constant(100.0);
    let v42 = v37 + v41;
    let v43 = v27 + S::constant(1.0);
    let v44 = v43.sqrt();
    let v45 = v42 + v44;
    let v46 = v43.pow(S::constant(2.5));
    let v47 = v45 + v46;
    let v48 = v43.pow(p_c);
    let v49 = v47 + v48;
    let v50 = S::constant(1.0) / v44;
    let v51 = v49 + v50;
    let v52 = v51 / S::constant(10.0);
    let v53 = -v27;
    let v54 = v53.exp();
    let v55 = S::constant(1.0) + v27;
    let v56 = v55 + p_type;
    let v57 = v56.ln();
    let v58 = v54 + v57;
    let v59 = S::constant(3.0) * t;
    let v60 = v59.cos();
    let v61 = v58 * v60;
    let v62 = v52 + v61;
    let v63 = v62 - x_x;
    let v64 = k_Y - v63;
    let v65 = x_x.sqrt();
    let v66 = x_x * v65;
    let v67 = v65 + v66;
    let v68 = S::select(b0, v67, v53);
    let v69 = x_x * x_Y;
    let v70 = S::select(b0, v69, v0);
    let v71 = S::select(b1, x_x, x_Y);
    let v72 = S::select(b2, x_x, p_a);
    let v73 = v71 + v72;
    let v74 = S::select(b3, v70, v73);
    let v75 = v68 + v74;
    let v76 = S::constant(-1.0).pow(n_n);
    let v77 = v76 * tau;
    let v78 = v75 + v77;
    let v79 = k_self - v78;
    let v80 = x_x.cos();
    let v81 = v2.cos();
    let v82 = v81 * v81;
    let v83 = p_a / v82;
    let v84 = v1 * v83;
    let v85 = v80 + v84;
    let v86 = S::constant(0.25) * p_a;
    let v87 = v6 * v6;
    let v88 = S::constant(1.0) - v87;
    let v89 = v88.sqrt();
    let v90 = v86 / v89;
    let v91 = v85 + v90;
    let v92 = v13 * v13;
    let v93 = S::constant(1.0) + v92;
    let v94 = p_b / v93;
    let v95 = v91 + v94;
    let v96 = v16 * v16;
    let v97 = v17 * v17;
    let v98 = v96 + v97;
    let v99 = v17 / v98;
    let v100 = v95 + v99;
    let v101 = v2.cosh();
    let v102 = v101 * p_a;
    let v103 = v93.sqrt();
    let v104 = p_b / v103;
    let v105 = v102 + v104;
    let v106 = v28 - S::constant(1.0);
    let v107 = v106.sqrt();
    let v108 = S::constant(1.0) / v107;
    let v109 = v28 + S::constant(1.0);
    let v110 = v109.sqrt();
    let v111 = v108 / v110;
    let v112 = x_x + x_x;
    let v113 = v111 * v112;
    let v114 = v105 + v113;
    let v115 = v86 / v88;
    let v116 = v114 + v115;
    let v117 = S::constant(0.1) * v116;
    let v118 = v100 + v117;
    let v119 = -v118;
    let v120 = x_x * v112;
    let v121 = v27 + v120;
    let v122 = v112 + v121;
    let v123 = v40 / v39;
    let v124 = v38 + v38;
    let v125 = v123 * v124;
    let v126 = S::constant(0.01) * v125;
    let v127 = v122 - v126;
    let v128 = x_x / v44;
    let v129 = v127 + v128;
    let v130 = v43.pow(S::constant(1.5));
    let v131 = S::constant(2.5) * v130;
    let v132 = v131 * v112;
    let v133 = v129 + v132;
    let v134 = p_c - S::constant(1.0);
    let v135 = v43.pow(v134);
    let v136 = p_c * v135;
    let v137 = v136 * v112;
    let v138 = v133 + v137;
    let v139 = v50 / v44;
    let v140 = v139 * v128;
    let v141 = v138 - v140;
    let v142 = S::constant(0.1) * v141;
    let v143 = v112 / v56;
    let v144 = v54 * v112;
    let v145 = v143 - v144;
    let v146 = v60 * v145;
    let v147 = v142 + v146;
    let v148 = v147 + S::constant(-1.0);
    let v149 = -v148;
    let v150 = v65 + v65;
    let v151 = S::constant(1.0) / v150;
    let v152 = x_x / v150;
    let v153 = v65 + v152;
    let v154 = v151 + v153;
    let v155 = -v112;
    let v156 = S::select(b0, v154, v155);
    let v157 = S::select(b0, x_Y, v80);
    let v158 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v159 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v160 = v158 + v159;
    let v161 = S::select(b3, v157, v160);
    let v162 = v156 + v161;
    let v163 = -v162;
    let v164 = v9.sinh();
    let v165 = v164 * p_a;
    let v166 = S::constant(0.1) * v165;
    let v167 = x_Y.sin();
    let v168 = v3 * v167;
    let v169 = v10 * v10;
    let v170 = S::constant(1.0) - v169;
    let v171 = v170.sqrt();
    let v172 = S::constant(-1.0) / v171;
    let v173 = v172 * v86;
    let v174 = v168 + v173;
    let v175 = v16 / v98;
    let v176 = v174 + v175;
    let v177 = v166 - v176;
    let v178 = -v177;
    let v179 = S::select(b0, x_x, S::constant(0.0));
    let v180 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v181 = S::select(b3, v179, v180);
    let v182 = -v181;
    let v183 = v23 * v23;
    let v184 = S::constant(1.0) - v183;
    let v185 = S::constant(0.1) * v184;
    let v186 = -v185;
    let v187 = x_x / v82;
    let v188 = v1 * v187;
    let v189 = S::constant(0.25) * x_x;
    let v190 = v189 / v89;
    let v191 = v188 + v190;
    let v192 = S::constant(0.25) * x_Y;
    let v193 = v172 * v192;
    let v194 = v191 - v193;
    let v195 = v101 * x_x;
    let v196 = v164 * x_Y;
    let v197 = v195 + v196;
    let v198 = v189 / v88;
    let v199 = v197 + v198;
    let v200 = S::constant(0.1) * v199;
    let v201 = v194 + v200;
    let v202 = -v201;
    let v203 = S::select(b2, S::constant(0.0), S::constant(-1.0));
    let v204 = S::select(b3, S::constant(0.0), v203);
    let v205 = x_x / v93;
    let v206 = x_x / v103;
    let v207 = S::constant(0.1) * v206;
    let v208 = v205 + v207;
    let v209 = -v208;
    let v210 = v43.ln();
    let v211 = v210 * v48;
    let v212 = S::constant(0.1) * v211;
    let v213 = -v212;
    let v214 = v60 / v56;
    let v215 = -v214;
    let v216 = -v76;
    let v217 = v59.sin();
    let v218 = S::constant(3.0) * v217;
    let v219 = v58 * v218;
    model::ResidualJacobian {
        value: [v35, v64, v79],
        dx: [
            [v119, v149, v163],
            [v178, S::constant(0.0), v182],
            [v186, S::constant(0.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [v202, S::constant(0.0), v204],
            [v209, S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v213, S::constant(0.0)],
            [S::constant(0.0), v215, S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), v216],
        dt: [S::constant(0.0), v219, S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `first` with its derivatives by state and rate, by columns.
///
/// 78 additions, 40 multiplications, 23 divisions, 33 function calls, 13 selections.
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
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = k_x - v34;
    let v36 = x_x * v27;
    let v37 = v27 + v36;
    let v38 = x_x + S::constant(5.0);
    let v39 = v38 * v38;
    let v40 = S::constant(1.0) / v39;
    let v41 = v40 / S::constant(100.0);
    let v42 = v37 + v41;
    let v43 = v27 + S::constant(1.0);
    let v44 = v43.sqrt();
    let v45 = v42 + v44;
    let v46 = v43.pow(S::constant(2.5));
    let v47 = v45 + v46;
    let v48 = v43.pow(p_c);
    let v49 = v47 + v48;
    let v50 = S::constant(1.0) / v44;
    let v51 = v49 + v50;
    let v52 = v51 / S::constant(10.0);
    let v53 = -v27;
    let v54 = v53.exp();
    let v55 = S::constant(1.0) + v27;
    let v56 = v55 + p_type;
    let v57 = v56.ln();
    let v58 = v54 + v57;
    let v59 = S::constant(3.0) * t;
    let v60 = v59.cos();
    let v61 = v58 * v60;
    let v62 = v52 + v61;
    let v63 = v62 - x_x;
    let v64 = k_Y - v63;
    let v65 = x_x.sqrt();
    let v66 = x_x * v65;
    let v67 = v65 + v66;
    let v68 = S::select(b0, v67, v53);
    let v69 = x_x * x_Y;
    let v70 = S::select(b0, v69, v0);
    let v71 = S::select(b1, x_x, x_Y);
    let v72 = S::select(b2, x_x, p_a);
    let v73 = v71 + v72;
    let v74 = S::select(b3, v70, v73);
    let v75 = v68 + v74;
    let v76 = S::constant(-1.0).pow(n_n);
    let v77 = v76 * tau;
    let v78 = v75 + v77;
    let v79 = k_self - v78;
    let v80 = x_x.cos();
    let v81 = v2.cos();
    let v82 = v81 * v81;
    let v83 = p_a / v82;
    let v84 = v1 * v83;
    let v85 = v80 + v84;
    let v86 = S::constant(0.25) * p_a;
    let v87 = v6 * v6;
    let v88 = S::constant(1.0) - v87;
    let v89 = v88.sqrt();
    let v90 = v86 / v89;
    let v91 = v85 + v90;
    let v92 = v13 * v13;
    let v93 = S::constant(1.0) + v92;
    let v94 = p_b / v93;
    let v95 = v91 + v94;
    let v96 = v16 * v16;
    let v97 = v17 * v17;
    let v98 = v96 + v97;
    let v99 = v17 / v98;
    let v100 = v95 + v99;
    let v101 = v2.cosh();
    let v102 = v101 * p_a;
    let v103 = v93.sqrt();
    let v104 = p_b / v103;
    let v105 = v102 + v104;
    let v106 = v28 - S::constant(1.0);
    let v107 = v106.sqrt();
    let v108 = S::constant(1.0) / v107;
    let v109 = v28 + S::constant(1.0);
    let v110 = v109.sqrt();
    let v111 = v108 / v110;
    let v112 = x_x + x_x;
    let v113 = v111 * v112;
    let v114 = v105 + v113;
    let v115 = v86 / v88;
    let v116 = v114 + v115;
    let v117 = S::constant(0.1) * v116;
    let v118 = v100 + v117;
    let v119 = -v118;
    let v120 = x_x * v112;
    let v121 = v27 + v120;
    let v122 = v112 + v121;
    let v123 = v40 / v39;
    let v124 = v38 + v38;
    let v125 = v123 * v124;
    let v126 = S::constant(0.01) * v125;
    let v127 = v122 - v126;
    let v128 = x_x / v44;
    let v129 = v127 + v128;
    let v130 = v43.pow(S::constant(1.5));
    let v131 = S::constant(2.5) * v130;
    let v132 = v131 * v112;
    let v133 = v129 + v132;
    let v134 = p_c - S::constant(1.0);
    let v135 = v43.pow(v134);
    let v136 = p_c * v135;
    let v137 = v136 * v112;
    let v138 = v133 + v137;
    let v139 = v50 / v44;
    let v140 = v139 * v128;
    let v141 = v138 - v140;
    let v142 = S::constant(0.1) * v141;
    let v143 = v112 / v56;
    let v144 = v54 * v112;
    let v145 = v143 - v144;
    let v146 = v60 * v145;
    let v147 = v142 + v146;
    let v148 = v147 + S::constant(-1.0);
    let v149 = -v148;
    let v150 = v65 + v65;
    let v151 = S::constant(1.0) / v150;
    let v152 = x_x / v150;
    let v153 = v65 + v152;
    let v154 = v151 + v153;
    let v155 = -v112;
    let v156 = S::select(b0, v154, v155);
    let v157 = S::select(b0, x_Y, v80);
    let v158 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v159 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v160 = v158 + v159;
    let v161 = S::select(b3, v157, v160);
    let v162 = v156 + v161;
    let v163 = -v162;
    let v164 = v9.sinh();
    let v165 = v164 * p_a;
    let v166 = S::constant(0.1) * v165;
    let v167 = x_Y.sin();
    let v168 = v3 * v167;
    let v169 = v10 * v10;
    let v170 = S::constant(1.0) - v169;
    let v171 = v170.sqrt();
    let v172 = S::constant(-1.0) / v171;
    let v173 = v172 * v86;
    let v174 = v168 + v173;
    let v175 = v16 / v98;
    let v176 = v174 + v175;
    let v177 = v166 - v176;
    let v178 = -v177;
    let v179 = S::select(b0, x_x, S::constant(0.0));
    let v180 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v181 = S::select(b3, v179, v180);
    let v182 = -v181;
    let v183 = v23 * v23;
    let v184 = S::constant(1.0) - v183;
    let v185 = S::constant(0.1) * v184;
    let v186 = -v185;
    model::Linearised {
        value: [v35, v64, v79],
        dx: [
            [v119, v149, v163],
            [v178, S::constant(0.0), v182],
            [v186, S::constant(0.0), S::constant(0.0)],
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
/// 5 additions, 1 multiplication.
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
    let v2 = x_Y * x_self;
    let v3 = k_self - v2;
    let v4 = -x_self;
    let v5 = -x_Y;
    model::ResidualJacobian {
        value: [v0, v1, v3],
        dx: [
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(-1.0), S::constant(0.0), v4],
            [S::constant(0.0), S::constant(0.0), v5],
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
/// 5 additions, 1 multiplication.
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
    let v2 = x_Y * x_self;
    let v3 = k_self - v2;
    let v4 = -x_self;
    let v5 = -x_Y;
    model::Linearised {
        value: [v0, v1, v3],
        dx: [
            [S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(-1.0), S::constant(0.0), v4],
            [S::constant(0.0), S::constant(0.0), v5],
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
/// 11 additions, 4 multiplications, 2 divisions, 3 function calls, 2 selections.
fn d_guard_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_gradient() };
    let &[p_a, _, _, _] = env.p;
    let t = env.t;
    let &[x_x, _, _] = x;
    let v0 = t.cos();
    let v1 = p_a * v0;
    let v2 = x_x - v1;
    let v3 = x_x.sqrt();
    let v4 = x_x * v3;
    let v5 = v3 + v4;
    let v6 = x_x * x_x;
    let v7 = -v6;
    let v8 = S::select(b0, v5, v7);
    let v9 = v2 + v8;
    let v10 = v3 + v3;
    let v11 = S::constant(1.0) / v10;
    let v12 = x_x / v10;
    let v13 = v3 + v12;
    let v14 = v11 + v13;
    let v15 = x_x + x_x;
    let v16 = -v15;
    let v17 = S::select(b0, v14, v16);
    let v18 = S::constant(1.0) + v17;
    let v19 = -v0;
    let v20 = t.sin();
    let v21 = p_a * v20;
    model::Gradient {
        value: v9,
        dx: [v18, S::constant(0.0), S::constant(0.0)],
        dp: [v19, S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: v21,
    }
}

/// State after transition `go` with all first derivatives.
/// Components: x, Y, self; derivatives by columns.
///
/// 3 additions, 3 multiplications, 3 function calls, 13 selections.
fn d_reset_go<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[n_n, _] = env.memory else { return nan_jacobian() };
    let &[b0, b1, b2, b3] = env.branch else { return nan_jacobian() };
    let &[p_a, p_b, _, p_type] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_self * p_b;
    let v1 = x_x + v0;
    let v2 = x_x * x_Y;
    let v3 = x_x.sin();
    let v4 = S::select(b0, v2, v3);
    let v5 = S::select(b1, x_x, x_Y);
    let v6 = S::select(b2, x_x, p_a);
    let v7 = v5 + v6;
    let v8 = S::select(b3, v4, v7);
    let v9 = S::constant(-1.0).pow(n_n);
    let v10 = v9 * p_type;
    let v11 = x_x.cos();
    let v12 = S::select(b0, x_Y, v11);
    let v13 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v14 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v15 = v13 + v14;
    let v16 = S::select(b3, v12, v15);
    let v17 = S::select(b0, x_x, S::constant(0.0));
    let v18 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v19 = S::select(b3, v17, v18);
    let v20 = S::select(b2, S::constant(0.0), S::constant(1.0));
    let v21 = S::select(b3, S::constant(0.0), v20);
    model::Jacobian {
        value: [v1, v8, v10],
        dx: [
            [S::constant(1.0), v16, S::constant(0.0)],
            [S::constant(0.0), v19, S::constant(0.0)],
            [p_b, S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), v21, S::constant(0.0)],
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
/// 3 additions, 2 multiplications, 3 selections.
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
    let v5 = p_a * v4;
    let v6 = S::select(v2, S::constant(0.0), x_self);
    let v7 = v5 + v6;
    let v8 = S::select(v2, x_self, S::constant(0.0));
    (
        [
            [S::constant(0.0), v3, S::constant(1.0)],
            [S::constant(1.0), v7, S::constant(0.0)],
        ],
        [
            [S::constant(0.0), v0, S::constant(0.0)],
            [S::constant(0.0), v8, S::constant(0.0)],
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
/// 5 additions, 3 multiplications, 7 divisions.
fn d_measures<S: scalar::Scalar>(
    functionals: &[S],
    p: &[S; PARAMETERS],
) -> ([S; 40], [[S; PARAMETERS]; 5]) {
    let &[f0, _, f2, f3, f4, f5, _, _] = functionals else {
        return ([nan(); 40], [[nan(); PARAMETERS]; 5])
    };
    let &[p_a, _, _, _] = p;
    let v0 = f3 * f3;
    let v1 = p_a + v0;
    let v2 = f2 / v1;
    let v3 = f4 * f5;
    let v4 = v3 / f0;
    let v5 = v4 / f0;
    let v6 = -v5;
    let v7 = S::constant(1.0) / v1;
    let v8 = v2 / v1;
    let v9 = f3 + f3;
    let v10 = v8 * v9;
    let v11 = -v10;
    let v12 = f5 / f0;
    let v13 = f4 / f0;
    let v14 = -v8;
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
            v7,
            v11,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v6,
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            v12,
            v13,
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
            [v14, S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// The integrands in mode `first`.
///
/// 14 additions, 7 multiplications, 3 divisions, 13 function calls.
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
    let v5 = v2 * v4;
    let v6 = v1 + v5;
    let v7 = v3 / S::constant(4.0);
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
    let v21 = v3.sinh();
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
    let v36 = v35 * x_Y;
    [v0, v36]
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
/// 3 additions, 2 multiplications, 1 function call, 1 selection.
fn observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_, _] = env.memory else { return nan() };
    let &[b0, _, _, _] = env.branch else { return nan() };
    let &[x_x, _, _] = x;
    let v0 = x_x.sqrt();
    let v1 = x_x * v0;
    let v2 = v0 + v1;
    let v3 = x_x * x_x;
    let v4 = -v3;
    let v5 = S::select(b0, v2, v4);
    let v6 = x_x + v5;
    v6
}

/// Observable 0 with all first derivatives.
///
/// 9 additions, 2 multiplications, 2 divisions, 1 function call, 2 selections.
fn d_observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[b0, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[x_x, _, _] = x;
    let v0 = x_x.sqrt();
    let v1 = x_x * v0;
    let v2 = v0 + v1;
    let v3 = x_x * x_x;
    let v4 = -v3;
    let v5 = S::select(b0, v2, v4);
    let v6 = x_x + v5;
    let v7 = v0 + v0;
    let v8 = S::constant(1.0) / v7;
    let v9 = x_x / v7;
    let v10 = v0 + v9;
    let v11 = v8 + v10;
    let v12 = x_x + x_x;
    let v13 = -v12;
    let v14 = S::select(b0, v11, v13);
    let v15 = S::constant(1.0) + v14;
    model::RateGradient {
        value: v6,
        dx: [v15, S::constant(0.0), S::constant(0.0)],
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
/// 14 additions, 5 multiplications, 3 divisions, 13 function calls.
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
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    v34
}

/// Observable 3 in mode `first` with all first derivatives.
///
/// 39 additions, 30 multiplications, 18 divisions, 23 function calls.
fn d_observable_3_first<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_, _] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _, _] = env.branch else { return nan_rate_gradient() };
    let &[p_a, p_b, _, _] = env.p;
    let &[x_x, x_Y, x_self] = x;
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = x_x.cos();
    let v36 = v2.cos();
    let v37 = v36 * v36;
    let v38 = p_a / v37;
    let v39 = v1 * v38;
    let v40 = v35 + v39;
    let v41 = S::constant(0.25) * p_a;
    let v42 = v6 * v6;
    let v43 = S::constant(1.0) - v42;
    let v44 = v43.sqrt();
    let v45 = v41 / v44;
    let v46 = v40 + v45;
    let v47 = v13 * v13;
    let v48 = S::constant(1.0) + v47;
    let v49 = p_b / v48;
    let v50 = v46 + v49;
    let v51 = v16 * v16;
    let v52 = v17 * v17;
    let v53 = v51 + v52;
    let v54 = v17 / v53;
    let v55 = v50 + v54;
    let v56 = v2.cosh();
    let v57 = v56 * p_a;
    let v58 = v48.sqrt();
    let v59 = p_b / v58;
    let v60 = v57 + v59;
    let v61 = v28 - S::constant(1.0);
    let v62 = v61.sqrt();
    let v63 = S::constant(1.0) / v62;
    let v64 = v28 + S::constant(1.0);
    let v65 = v64.sqrt();
    let v66 = v63 / v65;
    let v67 = x_x + x_x;
    let v68 = v66 * v67;
    let v69 = v60 + v68;
    let v70 = v41 / v43;
    let v71 = v69 + v70;
    let v72 = S::constant(0.1) * v71;
    let v73 = v55 + v72;
    let v74 = v9.sinh();
    let v75 = v74 * p_a;
    let v76 = S::constant(0.1) * v75;
    let v77 = x_Y.sin();
    let v78 = v3 * v77;
    let v79 = v10 * v10;
    let v80 = S::constant(1.0) - v79;
    let v81 = v80.sqrt();
    let v82 = S::constant(-1.0) / v81;
    let v83 = v82 * v41;
    let v84 = v78 + v83;
    let v85 = v16 / v53;
    let v86 = v84 + v85;
    let v87 = v76 - v86;
    let v88 = v23 * v23;
    let v89 = S::constant(1.0) - v88;
    let v90 = S::constant(0.1) * v89;
    let v91 = x_x / v37;
    let v92 = v1 * v91;
    let v93 = S::constant(0.25) * x_x;
    let v94 = v93 / v44;
    let v95 = v92 + v94;
    let v96 = S::constant(0.25) * x_Y;
    let v97 = v82 * v96;
    let v98 = v95 - v97;
    let v99 = v56 * x_x;
    let v100 = v74 * x_Y;
    let v101 = v99 + v100;
    let v102 = v93 / v43;
    let v103 = v101 + v102;
    let v104 = S::constant(0.1) * v103;
    let v105 = v98 + v104;
    let v106 = x_x / v48;
    let v107 = x_x / v58;
    let v108 = S::constant(0.1) * v107;
    let v109 = v106 + v108;
    model::RateGradient {
        value: v34,
        dx: [v73, v87, v90],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [v105, v109, S::constant(0.0), S::constant(0.0)],
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
/// Once: 69 additions, 40 multiplications, 23 divisions, 33 function calls, 13 selections. A column, at most: 3 additions, 6 multiplications.
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
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = x_x * v27;
    let v36 = v27 + v35;
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v27 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v27;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v27;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57 * v59;
    let v61 = v51 + v60;
    let v62 = v61 - x_x;
    let v63 = x_x.sqrt();
    let v64 = x_x * v63;
    let v65 = v63 + v64;
    let v66 = S::select(b0, v65, v52);
    let v67 = x_x * x_Y;
    let v68 = S::select(b0, v67, v0);
    let v69 = S::select(b1, x_x, x_Y);
    let v70 = S::select(b2, x_x, p_a);
    let v71 = v69 + v70;
    let v72 = S::select(b3, v68, v71);
    let v73 = v66 + v72;
    let v74 = S::constant(-1.0).pow(n_n);
    let v75 = v74 * tau;
    let v76 = v73 + v75;
    let v77 = x_x.cos();
    let v78 = v2.cos();
    let v79 = v78 * v78;
    let v80 = p_a / v79;
    let v81 = v1 * v80;
    let v82 = v77 + v81;
    let v83 = S::constant(0.25) * p_a;
    let v84 = v6 * v6;
    let v85 = S::constant(1.0) - v84;
    let v86 = v85.sqrt();
    let v87 = v83 / v86;
    let v88 = v82 + v87;
    let v89 = v13 * v13;
    let v90 = S::constant(1.0) + v89;
    let v91 = p_b / v90;
    let v92 = v88 + v91;
    let v93 = v16 * v16;
    let v94 = v17 * v17;
    let v95 = v93 + v94;
    let v96 = v17 / v95;
    let v97 = v92 + v96;
    let v98 = v2.cosh();
    let v99 = v98 * p_a;
    let v100 = v90.sqrt();
    let v101 = p_b / v100;
    let v102 = v99 + v101;
    let v103 = v28 - S::constant(1.0);
    let v104 = v103.sqrt();
    let v105 = S::constant(1.0) / v104;
    let v106 = v28 + S::constant(1.0);
    let v107 = v106.sqrt();
    let v108 = v105 / v107;
    let v109 = x_x + x_x;
    let v110 = v108 * v109;
    let v111 = v102 + v110;
    let v112 = v83 / v85;
    let v113 = v111 + v112;
    let v114 = S::constant(0.1) * v113;
    let v115 = v97 + v114;
    let v116 = x_x * v109;
    let v117 = v27 + v116;
    let v118 = v109 + v117;
    let v119 = v39 / v38;
    let v120 = v37 + v37;
    let v121 = v119 * v120;
    let v122 = S::constant(0.01) * v121;
    let v123 = v118 - v122;
    let v124 = x_x / v43;
    let v125 = v123 + v124;
    let v126 = v42.pow(S::constant(1.5));
    let v127 = S::constant(2.5) * v126;
    let v128 = v127 * v109;
    let v129 = v125 + v128;
    let v130 = p_c - S::constant(1.0);
    let v131 = v42.pow(v130);
    let v132 = p_c * v131;
    let v133 = v132 * v109;
    let v134 = v129 + v133;
    let v135 = v49 / v43;
    let v136 = v135 * v124;
    let v137 = v134 - v136;
    let v138 = S::constant(0.1) * v137;
    let v139 = v109 / v55;
    let v140 = v53 * v109;
    let v141 = v139 - v140;
    let v142 = v59 * v141;
    let v143 = v138 + v142;
    let v144 = v143 + S::constant(-1.0);
    let v145 = v63 + v63;
    let v146 = S::constant(1.0) / v145;
    let v147 = x_x / v145;
    let v148 = v63 + v147;
    let v149 = v146 + v148;
    let v150 = -v109;
    let v151 = S::select(b0, v149, v150);
    let v152 = S::select(b0, x_Y, v77);
    let v153 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v154 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v155 = v153 + v154;
    let v156 = S::select(b3, v152, v155);
    let v157 = v151 + v156;
    let v158 = v9.sinh();
    let v159 = v158 * p_a;
    let v160 = S::constant(0.1) * v159;
    let v161 = x_Y.sin();
    let v162 = v3 * v161;
    let v163 = v10 * v10;
    let v164 = S::constant(1.0) - v163;
    let v165 = v164.sqrt();
    let v166 = S::constant(-1.0) / v165;
    let v167 = v166 * v83;
    let v168 = v162 + v167;
    let v169 = v16 / v95;
    let v170 = v168 + v169;
    let v171 = v160 - v170;
    let v172 = S::select(b0, x_x, S::constant(0.0));
    let v173 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v174 = S::select(b3, v172, v173);
    let v175 = v23 * v23;
    let v176 = S::constant(1.0) - v175;
    let v177 = S::constant(0.1) * v176;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[dx_x, dx_Y, dx_self] = column;
        *product = [
            v115 * dx_x + v171 * dx_Y + v177 * dx_self,
            v144 * dx_x,
            v157 * dx_x + v174 * dx_Y,
        ];
    }
    ([v34, v62, v76], products)
}

/// State derivative f and integrands of mode `first` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 76 additions, 56 multiplications, 29 divisions, 34 function calls, 15 selections. A column, at most: 13 additions, 18 multiplications.
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
    let v0 = x_x.sin();
    let v1 = x_Y.cos();
    let v2 = p_a * x_x;
    let v3 = v2.tan();
    let v4 = v1 * v3;
    let v5 = v0 + v4;
    let v6 = v2 / S::constant(4.0);
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
    let v20 = v2.sinh();
    let v21 = v9.cosh();
    let v22 = v20 + v21;
    let v23 = x_self.tanh();
    let v24 = v22 + v23;
    let v25 = v13.asinh();
    let v26 = v24 + v25;
    let v27 = x_x * x_x;
    let v28 = S::constant(2.0) + v27;
    let v29 = v28.acosh();
    let v30 = v26 + v29;
    let v31 = v6.atanh();
    let v32 = v30 + v31;
    let v33 = v32 / S::constant(10.0);
    let v34 = v19 + v33;
    let v35 = x_x * v27;
    let v36 = v27 + v35;
    let v37 = x_x + S::constant(5.0);
    let v38 = v37 * v37;
    let v39 = S::constant(1.0) / v38;
    let v40 = v39 / S::constant(100.0);
    let v41 = v36 + v40;
    let v42 = v27 + S::constant(1.0);
    let v43 = v42.sqrt();
    let v44 = v41 + v43;
    let v45 = v42.pow(S::constant(2.5));
    let v46 = v44 + v45;
    let v47 = v42.pow(p_c);
    let v48 = v46 + v47;
    let v49 = S::constant(1.0) / v43;
    let v50 = v48 + v49;
    let v51 = v50 / S::constant(10.0);
    let v52 = -v27;
    let v53 = v52.exp();
    let v54 = S::constant(1.0) + v27;
    let v55 = v54 + p_type;
    let v56 = v55.ln();
    let v57 = v53 + v56;
    let v58 = S::constant(3.0) * t;
    let v59 = v58.cos();
    let v60 = v57 * v59;
    let v61 = v51 + v60;
    let v62 = v61 - x_x;
    let v63 = x_x.sqrt();
    let v64 = x_x * v63;
    let v65 = v63 + v64;
    let v66 = S::select(b0, v65, v52);
    let v67 = x_x * x_Y;
    let v68 = S::select(b0, v67, v0);
    let v69 = S::select(b1, x_x, x_Y);
    let v70 = S::select(b2, x_x, p_a);
    let v71 = v69 + v70;
    let v72 = S::select(b3, v68, v71);
    let v73 = v66 + v72;
    let v74 = S::constant(-1.0).pow(n_n);
    let v75 = v74 * tau;
    let v76 = v73 + v75;
    let v77 = v34 * x_Y;
    let v78 = x_x.cos();
    let v79 = v2.cos();
    let v80 = v79 * v79;
    let v81 = p_a / v80;
    let v82 = v1 * v81;
    let v83 = v78 + v82;
    let v84 = S::constant(0.25) * p_a;
    let v85 = v6 * v6;
    let v86 = S::constant(1.0) - v85;
    let v87 = v86.sqrt();
    let v88 = v84 / v87;
    let v89 = v83 + v88;
    let v90 = v13 * v13;
    let v91 = S::constant(1.0) + v90;
    let v92 = p_b / v91;
    let v93 = v89 + v92;
    let v94 = v16 * v16;
    let v95 = v17 * v17;
    let v96 = v94 + v95;
    let v97 = v17 / v96;
    let v98 = v93 + v97;
    let v99 = v2.cosh();
    let v100 = v99 * p_a;
    let v101 = v91.sqrt();
    let v102 = p_b / v101;
    let v103 = v100 + v102;
    let v104 = v28 - S::constant(1.0);
    let v105 = v104.sqrt();
    let v106 = S::constant(1.0) / v105;
    let v107 = v28 + S::constant(1.0);
    let v108 = v107.sqrt();
    let v109 = v106 / v108;
    let v110 = x_x + x_x;
    let v111 = v109 * v110;
    let v112 = v103 + v111;
    let v113 = v84 / v86;
    let v114 = v112 + v113;
    let v115 = S::constant(0.1) * v114;
    let v116 = v98 + v115;
    let v117 = x_x * v110;
    let v118 = v27 + v117;
    let v119 = v110 + v118;
    let v120 = v39 / v38;
    let v121 = v37 + v37;
    let v122 = v120 * v121;
    let v123 = S::constant(0.01) * v122;
    let v124 = v119 - v123;
    let v125 = x_x / v43;
    let v126 = v124 + v125;
    let v127 = v42.pow(S::constant(1.5));
    let v128 = S::constant(2.5) * v127;
    let v129 = v128 * v110;
    let v130 = v126 + v129;
    let v131 = p_c - S::constant(1.0);
    let v132 = v42.pow(v131);
    let v133 = p_c * v132;
    let v134 = v133 * v110;
    let v135 = v130 + v134;
    let v136 = v49 / v43;
    let v137 = v136 * v125;
    let v138 = v135 - v137;
    let v139 = S::constant(0.1) * v138;
    let v140 = v110 / v55;
    let v141 = v53 * v110;
    let v142 = v140 - v141;
    let v143 = v59 * v142;
    let v144 = v139 + v143;
    let v145 = v144 + S::constant(-1.0);
    let v146 = v63 + v63;
    let v147 = S::constant(1.0) / v146;
    let v148 = x_x / v146;
    let v149 = v63 + v148;
    let v150 = v147 + v149;
    let v151 = -v110;
    let v152 = S::select(b0, v150, v151);
    let v153 = S::select(b0, x_Y, v78);
    let v154 = S::select(b1, S::constant(1.0), S::constant(0.0));
    let v155 = S::select(b2, S::constant(1.0), S::constant(0.0));
    let v156 = v154 + v155;
    let v157 = S::select(b3, v153, v156);
    let v158 = v152 + v157;
    let v159 = x_Y * v116;
    let v160 = v9.sinh();
    let v161 = v160 * p_a;
    let v162 = S::constant(0.1) * v161;
    let v163 = x_Y.sin();
    let v164 = v3 * v163;
    let v165 = v10 * v10;
    let v166 = S::constant(1.0) - v165;
    let v167 = v166.sqrt();
    let v168 = S::constant(-1.0) / v167;
    let v169 = v168 * v84;
    let v170 = v164 + v169;
    let v171 = v16 / v96;
    let v172 = v170 + v171;
    let v173 = v162 - v172;
    let v174 = S::select(b0, x_x, S::constant(0.0));
    let v175 = S::select(b1, S::constant(0.0), S::constant(1.0));
    let v176 = S::select(b3, v174, v175);
    let v177 = x_Y * v173;
    let v178 = v177 + v34;
    let v179 = v23 * v23;
    let v180 = S::constant(1.0) - v179;
    let v181 = S::constant(0.1) * v180;
    let v182 = x_Y * v181;
    let v183 = x_x / v80;
    let v184 = v1 * v183;
    let v185 = S::constant(0.25) * x_x;
    let v186 = v185 / v87;
    let v187 = v184 + v186;
    let v188 = S::constant(0.25) * x_Y;
    let v189 = v168 * v188;
    let v190 = v187 - v189;
    let v191 = v99 * x_x;
    let v192 = v160 * x_Y;
    let v193 = v191 + v192;
    let v194 = v185 / v86;
    let v195 = v193 + v194;
    let v196 = S::constant(0.1) * v195;
    let v197 = v190 + v196;
    let v198 = S::select(b2, S::constant(0.0), S::constant(1.0));
    let v199 = S::select(b3, S::constant(0.0), v198);
    let v200 = x_Y * v197;
    let v201 = x_x / v91;
    let v202 = x_x / v101;
    let v203 = S::constant(0.1) * v202;
    let v204 = v201 + v203;
    let v205 = x_Y * v204;
    let v206 = v42.ln();
    let v207 = v206 * v47;
    let v208 = S::constant(0.1) * v207;
    let v209 = v59 / v55;
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[dx_x, dx_Y, dx_self] = dx;
        let &[dp_a, dp_b, dp_c, dp_type] = dp;
        *dflow = [
            v116 * dx_x + v173 * dx_Y + v181 * dx_self + v197 * dp_a + v204 * dp_b,
            v145 * dx_x + v208 * dp_c + v209 * dp_type,
            v158 * dx_x + v176 * dx_Y + v199 * dp_a,
        ];
        *dintegrands = [
            x_Y * dx_x + x_x * dx_Y,
            v159 * dx_x + v178 * dx_Y + v182 * dx_self + v200 * dp_a + v205 * dp_b,
        ];
    }
    model::Integrated {
        flow: [v34, v62, v76],
        integrands: [v67, v77],
        dflow,
        dintegrands,
    }
}

/// State derivative f of mode `second` and, for each column v, (df/dx) v.
///
/// Once: 1 addition, 1 multiplication. A column, at most: 1 addition, 4 multiplications.
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
        *product = [dx_Y, -dx_x, x_self * dx_Y + x_Y * dx_self];
    }
    ([x_Y, v0, v1], products)
}

/// State derivative f and integrands of mode `second` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 2 additions, 3 multiplications. A column, at most: 2 additions, 7 multiplications.
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
        *dflow = [dx_Y, -dx_x, x_self * dx_Y + x_Y * dx_self];
        *dintegrands = [x_Y * dx_x + x_x * dx_Y, v4 * dx_Y];
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
/// Once: 40 additions, 37 multiplications, 18 divisions, 23 function calls. A column, at most: 5 additions, 7 multiplications.
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
    let v1 = x_x.sin();
    let v2 = x_Y.cos();
    let v3 = p_a * x_x;
    let v4 = v3.tan();
    let v5 = v2 * v4;
    let v6 = v1 + v5;
    let v7 = v3 / S::constant(4.0);
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
    let v21 = v3.sinh();
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
    let v36 = v35 * x_Y;
    let v37 = x_x.cos();
    let v38 = v3.cos();
    let v39 = v38 * v38;
    let v40 = p_a / v39;
    let v41 = v2 * v40;
    let v42 = v37 + v41;
    let v43 = S::constant(0.25) * p_a;
    let v44 = v7 * v7;
    let v45 = S::constant(1.0) - v44;
    let v46 = v45.sqrt();
    let v47 = v43 / v46;
    let v48 = v42 + v47;
    let v49 = v14 * v14;
    let v50 = S::constant(1.0) + v49;
    let v51 = p_b / v50;
    let v52 = v48 + v51;
    let v53 = v17 * v17;
    let v54 = v18 * v18;
    let v55 = v53 + v54;
    let v56 = v18 / v55;
    let v57 = v52 + v56;
    let v58 = v3.cosh();
    let v59 = v58 * p_a;
    let v60 = v50.sqrt();
    let v61 = p_b / v60;
    let v62 = v59 + v61;
    let v63 = v29 - S::constant(1.0);
    let v64 = v63.sqrt();
    let v65 = S::constant(1.0) / v64;
    let v66 = v29 + S::constant(1.0);
    let v67 = v66.sqrt();
    let v68 = v65 / v67;
    let v69 = x_x + x_x;
    let v70 = v68 * v69;
    let v71 = v62 + v70;
    let v72 = v43 / v45;
    let v73 = v71 + v72;
    let v74 = S::constant(0.1) * v73;
    let v75 = v57 + v74;
    let v76 = x_Y * v75;
    let v77 = v10.sinh();
    let v78 = v77 * p_a;
    let v79 = S::constant(0.1) * v78;
    let v80 = x_Y.sin();
    let v81 = v4 * v80;
    let v82 = v11 * v11;
    let v83 = S::constant(1.0) - v82;
    let v84 = v83.sqrt();
    let v85 = S::constant(-1.0) / v84;
    let v86 = v85 * v43;
    let v87 = v81 + v86;
    let v88 = v17 / v55;
    let v89 = v87 + v88;
    let v90 = v79 - v89;
    let v91 = x_Y * v90;
    let v92 = v91 + v35;
    let v93 = v24 * v24;
    let v94 = S::constant(1.0) - v93;
    let v95 = S::constant(0.1) * v94;
    let v96 = x_Y * v95;
    let v97 = x_x / v39;
    let v98 = v2 * v97;
    let v99 = S::constant(0.25) * x_x;
    let v100 = v99 / v46;
    let v101 = v98 + v100;
    let v102 = S::constant(0.25) * x_Y;
    let v103 = v85 * v102;
    let v104 = v101 - v103;
    let v105 = v58 * x_x;
    let v106 = v77 * x_Y;
    let v107 = v105 + v106;
    let v108 = v99 / v45;
    let v109 = v107 + v108;
    let v110 = S::constant(0.1) * v109;
    let v111 = v104 + v110;
    let v112 = x_Y * v111;
    let v113 = x_x / v50;
    let v114 = x_x / v60;
    let v115 = S::constant(0.1) * v114;
    let v116 = v113 + v115;
    let v117 = x_Y * v116;
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (product, (((&[dx_x, dx_Y, dx_self], _), &[dp_a, dp_b, _, _]), _)) in products
        .iter_mut()
        .zip(directions)
    {
        *product = [
            x_Y * dx_x + x_x * dx_Y,
            v76 * dx_x + v92 * dx_Y + v96 * dx_self + v112 * dp_a + v117 * dp_b,
        ];
    }
    ([v0, v36], products)
}

/// The integrands in mode `second` and their derivatives along each direction.
///
/// Once: 1 addition, 2 multiplications. A column, at most: 1 addition, 3 multiplications.
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
        *product = [x_Y * dx_x + x_x * dx_Y, v2 * dx_Y];
    }
    ([v0, v1], products)
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
