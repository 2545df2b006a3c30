//! Compiled model `hopper`.
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
pub const STATES: usize = 4;
/// Number of parameters.
pub const PARAMETERS: usize = 4;
/// Number of time integrals.
pub const INTEGRALS: usize = 1;

/// The compiled model `hopper`: 4 states, 4 parameters, 1 time integrals.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hopper;

/// Names, units and structure.
static INFO: model::ModelInfo = model::ModelInfo {
    name: "hopper",
    fingerprint: "7048029d7a2d2fab15835b05f2067880d6338df288fac5a561b0d8f85f17b78b",
    parameters: &[
        model::Quantity {
            name: "g",
            si: "m/s^2",
        },
        model::Quantity {
            name: "omega",
            si: "s^-1",
        },
        model::Quantity {
            name: "v_hard",
            si: "m/s",
        },
        model::Quantity {
            name: "c",
            si: "1",
        },
    ],
    states: &[
        model::Quantity {
            name: "y",
            si: "m",
        },
        model::Quantity {
            name: "v",
            si: "m/s",
        },
        model::Quantity {
            name: "q",
            si: "m",
        },
        model::Quantity {
            name: "u",
            si: "m/s",
        },
    ],
    memory: &["n"],
    modes: &[
        model::ModeInfo {
            name: "flight",
            switches: &[],
            measured_switches: &[1, 2],
        },
        model::ModeInfo {
            name: "stance",
            switches: &[0],
            measured_switches: &[0, 1, 2],
        },
    ],
    transitions: &[
        model::TransitionInfo {
            name: "soft",
            from: 0,
            to: 1,
            direction: model::Direction::Falling,
            also_zero: &[],
        },
        model::TransitionInfo {
            name: "hard",
            from: 0,
            to: 1,
            direction: model::Direction::Falling,
            also_zero: &[],
        },
        model::TransitionInfo {
            name: "lift",
            from: 1,
            to: 0,
            direction: model::Direction::Falling,
            also_zero: &[],
        },
    ],
    switches: &["n > 0", "abs(v)", "abs(u)"],
    coordinates: &[1],
    section: ::core::option::Option::Some(model::Section::After(2)),
    returning: &[0],
    symmetric: false,
    functionals: &[
        model::Functional::Maximum(0),
        model::Functional::Maximum(1),
        model::Functional::Integral(0),
    ],
    measures: &[
        model::Quantity {
            name: "top",
            si: "m",
        },
        model::Quantity {
            name: "deepest",
            si: "m",
        },
        model::Quantity {
            name: "travel",
            si: "m",
        },
    ],
    uses_time: false,
    explicit: true,
};

impl model::Model<STATES, PARAMETERS, INTEGRALS> for Hopper {
    const INFO: &'static model::ModelInfo = &INFO;
    #[inline]
    fn flow<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> [S; STATES] {
        match mode {
            0 => flow_flight(x, env),
            1 => flow_stance(x, env),
            _ => nan_state(),
        }
    }
    fn flow_jacobian<S: scalar::Scalar>(
        mode: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Jacobian<S, STATES, PARAMETERS> {
        match mode {
            0 => d_flow_flight(x, env),
            1 => d_flow_stance(x, env),
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
            0 => tangent_flow_flight(x, dx, env),
            1 => tangent_flow_stance(x, dx, env),
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
            0 => integrated_flight(x, env),
            1 => integrated_stance(x, env),
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
            0 => tangent_integrated_flight(x, dx, dp, env),
            1 => tangent_integrated_stance(x, dx, dp, env),
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
            0 => clock_flight(env),
            1 => clock_stance(env),
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
            0 => staged_flow_flight(x, dx, clock, env),
            1 => staged_flow_stance(x, dx, clock, env),
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
            0 => residual_flight(x, k, env),
            1 => residual_stance(x, k, env),
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
            0 => d_residual_flight(x, k, env),
            1 => d_residual_stance(x, k, env),
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
            0 => linearised_flight(x, k, env),
            1 => linearised_stance(x, k, env),
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
            0 | 1 => integrands(x, env),
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
            0 | 1 => tangent_integrands(x, along, env),
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
            _ => nan_gradient(),
        }
    }
    fn guard<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        match transition {
            0 => guard_soft(x, env),
            1 => guard_hard(x, env),
            2 => guard_lift(x, env),
            _ => nan(),
        }
    }
    fn guard_gradient<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> model::Gradient<S, STATES, PARAMETERS> {
        match transition {
            0 => d_guard_soft(x, env),
            1 => d_guard_hard(x, env),
            2 => d_guard_lift(x, env),
            _ => nan_gradient(),
        }
    }
    fn when<S: scalar::Scalar>(
        transition: usize,
        x: &[S; STATES],
        env: &model::Env<'_, S, PARAMETERS>,
    ) -> S {
        match transition {
            0 => when_soft(x, env),
            1 => when_hard(x, env),
            2 => S::constant(1.0),
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
            0 => reset_soft(x, env),
            1 => reset_hard(x, env),
            2 => reset_lift(x, env),
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
            0 => d_reset_soft(x, env),
            1 => d_reset_hard(x, env),
            2 => d_reset_lift(x, env),
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
        if dz.len() != 1 {
            dz.fill(nan_state());
            return [nan_state(); PARAMETERS];
        }
        let (columns, dp): ([[S; STATES]; 1], [[S; STATES]; PARAMETERS]) = d_embed(z, p);
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
            dx: [
                [one, zero, zero, zero],
                [zero, one, zero, zero],
                [zero, zero, one, zero],
                [zero, zero, zero, one],
            ],
            dp: [[zero; STATES]; PARAMETERS],
            dtau: [zero; STATES],
            dt: [zero; STATES],
        }
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
            _ => nan_rate_gradient(),
        }
    }
    fn measures<S: scalar::Scalar>(
        functionals: &[S],
        p: &[S; PARAMETERS],
        out: &mut [S],
    ) {
        if out.len() != 3 {
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
        if dfunctionals.len() != 9 || dp.len() != 3 {
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

/// State derivative f of mode `flight`.
/// Rates of y [m s^-1], v [m s^-2], q [m s^-1], u [m s^-2].
///
/// 1 addition.
fn flow_flight<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_] = env.memory else { return nan_state() };
    let &[_, _, _] = env.branch else { return nan_state() };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, _] = x;
    let v0 = -p_g;
    [x_v, v0, S::constant(0.0), S::constant(0.0)]
}

/// State derivative f and integrands of mode `flight`.
///
/// 4 additions, 2 selections.
fn integrated_flight<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; INTEGRALS]) {
    let &[_] = env.memory else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[_, b1, b2] = env.branch else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, x_u] = x;
    let v0 = -p_g;
    let v1 = -x_v;
    let v2 = S::select(b1, x_v, v1);
    let v3 = -x_u;
    let v4 = S::select(b2, x_u, v3);
    let v5 = v2 + v4;
    ([x_v, v0, S::constant(0.0), S::constant(0.0)], [v5])
}

/// Residual F = M k - f of mode `flight`, k the rates of the states.
///
/// 2 additions.
fn residual_flight<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_] = env.memory else { return nan_state() };
    let &[_, _, _] = env.branch else { return nan_state() };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, _] = x;
    let &[k_y, k_v, k_q, k_u] = k;
    let v0 = k_y - x_v;
    let v1 = k_v + p_g;
    [v0, v1, k_q, k_u]
}

/// State derivative f of mode `stance`.
/// Rates of y [m s^-1], v [m s^-2], q [m s^-1], u [m s^-2].
///
/// 1 addition, 2 multiplications.
fn flow_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_] = env.memory else { return nan_state() };
    let &[_, _, _] = env.branch else { return nan_state() };
    let &[_, p_omega, _, _] = env.p;
    let &[_, _, x_q, x_u] = x;
    let v0 = p_omega * p_omega;
    let v1 = v0 * x_q;
    let v2 = -v1;
    [S::constant(0.0), S::constant(0.0), x_u, v2]
}

/// State derivative f and integrands of mode `stance`.
///
/// 4 additions, 2 multiplications, 2 selections.
fn integrated_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; INTEGRALS]) {
    let &[_] = env.memory else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[_, b1, b2] = env.branch else { return (nan_state(), [nan(); INTEGRALS]) };
    let &[_, p_omega, _, _] = env.p;
    let &[_, x_v, x_q, x_u] = x;
    let v0 = p_omega * p_omega;
    let v1 = v0 * x_q;
    let v2 = -v1;
    let v3 = -x_v;
    let v4 = S::select(b1, x_v, v3);
    let v5 = -x_u;
    let v6 = S::select(b2, x_u, v5);
    let v7 = v4 + v6;
    ([S::constant(0.0), S::constant(0.0), x_u, v2], [v7])
}

/// Residual F = M k - f of mode `stance`, k the rates of the states.
///
/// 1 addition, 1 multiplication, 1 fused multiply-add.
fn residual_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; STATES] {
    let &[_] = env.memory else { return nan_state() };
    let &[_, _, _] = env.branch else { return nan_state() };
    let &[_, p_omega, _, _] = env.p;
    let &[_, _, x_q, x_u] = x;
    let &[k_y, k_v, k_q, k_u] = k;
    let v0 = k_q - x_u;
    let v1 = p_omega * p_omega;
    let v2 = v1.mul_add(x_q, k_u);
    [k_y, k_v, v0, v2]
}

/// Switching function 0, not negative where `n > 0`.
///
/// 1 addition.
fn switch_0<S: scalar::Scalar>(
    _x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[n_n] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let v0 = n_n - S::constant(0.5);
    v0
}

/// Switching function 1, not negative where `abs(v)`.
///
/// No operations.
fn switch_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[_, x_v, _, _] = x;
    x_v
}

/// Switching function 2, not negative where `abs(u)`.
///
/// No operations.
fn switch_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[_, _, _, x_u] = x;
    x_u
}

/// Guard of transition `soft`.
///
/// No operations.
fn guard_soft<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[x_y, _, _, _] = x;
    x_y
}

/// Transition `soft` is enabled where this is not negative.
///
/// 1 addition.
fn when_soft<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[_, _, p_v_hard, _] = env.p;
    let &[_, x_v, _, _] = x;
    let v0 = x_v + p_v_hard;
    v0
}

/// State and memory after transition `soft`, from those before.
/// State: y [m], v [m s^-1], q [m], u [m s^-1].
///
/// 1 addition.
fn reset_soft<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 1]) {
    let &[n_n] = env.memory else { return (nan_state(), [nan(); 1]) };
    let &[_, _, _] = env.branch else { return (nan_state(), [nan(); 1]) };
    let &[_, x_v, _, _] = x;
    let v0 = -x_v;
    ([S::constant(0.0), S::constant(0.0), S::constant(0.0), v0], [n_n])
}

/// Guard of transition `hard`.
///
/// No operations.
fn guard_hard<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[x_y, _, _, _] = x;
    x_y
}

/// Transition `hard` is enabled where this is not negative.
///
/// 2 additions.
fn when_hard<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[_, _, p_v_hard, _] = env.p;
    let &[_, x_v, _, _] = x;
    let v0 = x_v + p_v_hard;
    let v1 = -v0;
    v1
}

/// State and memory after transition `hard`, from those before.
/// State: y [m], v [m s^-1], q [m], u [m s^-1].
///
/// 2 additions, 1 division.
fn reset_hard<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 1]) {
    let &[n_n] = env.memory else { return (nan_state(), [nan(); 1]) };
    let &[_, _, _] = env.branch else { return (nan_state(), [nan(); 1]) };
    let &[_, x_v, _, _] = x;
    let v0 = x_v / S::constant(2.0);
    let v1 = -v0;
    let v2 = n_n + S::constant(1.0);
    ([S::constant(0.0), S::constant(0.0), S::constant(0.0), v1], [v2])
}

/// Guard of transition `lift`.
///
/// No operations.
fn guard_lift<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[_, _, x_q, _] = x;
    x_q
}

/// State and memory after transition `lift`, from those before.
/// State: y [m], v [m s^-1], q [m], u [m s^-1].
///
/// 1 addition, 1 multiplication, 1 selection.
fn reset_lift<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [S; 1]) {
    let &[n_n] = env.memory else { return (nan_state(), [nan(); 1]) };
    let &[b0, _, _] = env.branch else { return (nan_state(), [nan(); 1]) };
    let &[_, _, _, p_c] = env.p;
    let &[_, _, _, x_u] = x;
    let v0 = S::select(b0, S::constant(1.0), p_c);
    let v1 = x_u * v0;
    let v2 = -v1;
    ([S::constant(0.0), v2, S::constant(0.0), S::constant(0.0)], [n_n])
}

/// Full state on the section from its coordinates.
///
/// No operations.
fn embed<S: scalar::Scalar>(z: &[S], _p: &[S; PARAMETERS]) -> [S; STATES] {
    let &[x_v] = z else { return nan_state() };
    [S::constant(0.0), x_v, S::constant(0.0), S::constant(0.0)]
}

/// Measures from the values of the functionals.
/// Measures: top [m], deepest [m], travel [m].
///
/// No operations.
fn measures<S: scalar::Scalar>(functionals: &[S], _p: &[S; PARAMETERS]) -> [S; 3] {
    let &[f0, f1, f2] = functionals else { return [nan(); 3] };
    [f0, f1, f2]
}

/// State derivative f of mode `flight` with all first derivatives.
/// Components: y, v, q, u; derivatives by columns.
///
/// 1 addition.
fn d_flow_flight<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_jacobian() };
    let &[_, _, _] = env.branch else { return nan_jacobian() };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, _] = x;
    let v0 = -p_g;
    model::Jacobian {
        value: [x_v, v0, S::constant(0.0), S::constant(0.0)],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(-1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `flight` with all first derivatives, by columns.
///
/// 2 additions.
fn d_residual_flight<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_residual_jacobian() };
    let &[_, _, _] = env.branch else { return nan_residual_jacobian() };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, _] = x;
    let &[k_y, k_v, k_q, k_u] = k;
    let v0 = k_y - x_v;
    let v1 = k_v + p_g;
    model::ResidualJacobian {
        value: [v0, v1, k_q, k_u],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(-1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `flight` with its derivatives by state and rate, by columns.
///
/// 2 additions.
fn linearised_flight<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[_] = env.memory else { return nan_linearised() };
    let &[_, _, _] = env.branch else { return nan_linearised() };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, _] = x;
    let &[k_y, k_v, k_q, k_u] = k;
    let v0 = k_y - x_v;
    let v1 = k_v + p_g;
    model::Linearised {
        value: [v0, v1, k_q, k_u],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(-1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
    }
}

/// State derivative f of mode `stance` with all first derivatives.
/// Components: y, v, q, u; derivatives by columns.
///
/// 4 additions, 3 multiplications.
fn d_flow_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_jacobian() };
    let &[_, _, _] = env.branch else { return nan_jacobian() };
    let &[_, p_omega, _, _] = env.p;
    let &[_, _, x_q, x_u] = x;
    let v0 = p_omega * p_omega;
    let v1 = v0 * x_q;
    let v2 = -v1;
    let v3 = -v0;
    let v4 = p_omega + p_omega;
    let v5 = x_q * v4;
    let v6 = -v5;
    model::Jacobian {
        value: [S::constant(0.0), S::constant(0.0), x_u, v2],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), v3],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), v6],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `stance` with all first derivatives, by columns.
///
/// 2 additions, 2 multiplications, 1 fused multiply-add.
fn d_residual_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_residual_jacobian() };
    let &[_, _, _] = env.branch else { return nan_residual_jacobian() };
    let &[_, p_omega, _, _] = env.p;
    let &[_, _, x_q, x_u] = x;
    let &[k_y, k_v, k_q, k_u] = k;
    let v0 = k_q - x_u;
    let v1 = p_omega * p_omega;
    let v2 = v1.mul_add(x_q, k_u);
    let v3 = p_omega + p_omega;
    let v4 = x_q * v3;
    model::ResidualJacobian {
        value: [k_y, k_v, v0, v2],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), v1],
            [S::constant(0.0), S::constant(0.0), S::constant(-1.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), v4],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Residual F = M k - f of mode `stance` with its derivatives by state and rate, by columns.
///
/// 1 addition, 1 multiplication, 1 fused multiply-add.
fn linearised_stance<S: scalar::Scalar>(
    x: &[S; STATES],
    k: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Linearised<S, STATES> {
    let &[_] = env.memory else { return nan_linearised() };
    let &[_, _, _] = env.branch else { return nan_linearised() };
    let &[_, p_omega, _, _] = env.p;
    let &[_, _, x_q, x_u] = x;
    let &[k_y, k_v, k_q, k_u] = k;
    let v0 = k_q - x_u;
    let v1 = p_omega * p_omega;
    let v2 = v1.mul_add(x_q, k_u);
    model::Linearised {
        value: [k_y, k_v, v0, v2],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), v1],
            [S::constant(0.0), S::constant(0.0), S::constant(-1.0), S::constant(0.0)],
        ],
        dk: [
            [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        ],
    }
}

/// Switching function 0 with all first derivatives.
///
/// 1 addition.
fn d_switch_0<S: scalar::Scalar>(
    _x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[n_n] = env.memory else { return nan_gradient() };
    let &[_, _, _] = env.branch else { return nan_gradient() };
    let v0 = n_n - S::constant(0.5);
    model::Gradient {
        value: v0,
        dx: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Switching function 1 with all first derivatives.
///
/// No operations.
fn d_switch_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _] = env.branch else { return nan_gradient() };
    let &[_, x_v, _, _] = x;
    model::Gradient {
        value: x_v,
        dx: [S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Switching function 2 with all first derivatives.
///
/// No operations.
fn d_switch_2<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _] = env.branch else { return nan_gradient() };
    let &[_, _, _, x_u] = x;
    model::Gradient {
        value: x_u,
        dx: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(1.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// Guard of transition `soft` with all first derivatives.
///
/// No operations.
fn d_guard_soft<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _] = env.branch else { return nan_gradient() };
    let &[x_y, _, _, _] = x;
    model::Gradient {
        value: x_y,
        dx: [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State after transition `soft` with all first derivatives.
/// Components: y, v, q, u; derivatives by columns.
///
/// 1 addition.
fn d_reset_soft<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_jacobian() };
    let &[_, _, _] = env.branch else { return nan_jacobian() };
    let &[_, x_v, _, _] = x;
    let v0 = -x_v;
    model::Jacobian {
        value: [S::constant(0.0), S::constant(0.0), S::constant(0.0), v0],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(-1.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Guard of transition `hard` with all first derivatives.
///
/// No operations.
fn d_guard_hard<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _] = env.branch else { return nan_gradient() };
    let &[x_y, _, _, _] = x;
    model::Gradient {
        value: x_y,
        dx: [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State after transition `hard` with all first derivatives.
/// Components: y, v, q, u; derivatives by columns.
///
/// 1 addition, 1 division.
fn d_reset_hard<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_jacobian() };
    let &[_, _, _] = env.branch else { return nan_jacobian() };
    let &[_, x_v, _, _] = x;
    let v0 = x_v / S::constant(2.0);
    let v1 = -v0;
    model::Jacobian {
        value: [S::constant(0.0), S::constant(0.0), S::constant(0.0), v1],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(-0.5)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Guard of transition `lift` with all first derivatives.
///
/// No operations.
fn d_guard_lift<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Gradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_gradient() };
    let &[_, _, _] = env.branch else { return nan_gradient() };
    let &[_, _, x_q, _] = x;
    model::Gradient {
        value: x_q,
        dx: [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State after transition `lift` with all first derivatives.
/// Components: y, v, q, u; derivatives by columns.
///
/// 3 additions, 1 multiplication, 2 selections.
fn d_reset_lift<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::Jacobian<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_jacobian() };
    let &[b0, _, _] = env.branch else { return nan_jacobian() };
    let &[_, _, _, p_c] = env.p;
    let &[_, _, _, x_u] = x;
    let v0 = S::select(b0, S::constant(1.0), p_c);
    let v1 = x_u * v0;
    let v2 = -v1;
    let v3 = -v0;
    let v4 = -x_u;
    let v5 = S::select(b0, S::constant(0.0), v4);
    model::Jacobian {
        value: [S::constant(0.0), v2, S::constant(0.0), S::constant(0.0)],
        dx: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v3, S::constant(0.0), S::constant(0.0)],
        ],
        dp: [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), v5, S::constant(0.0), S::constant(0.0)],
        ],
        dtau: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dt: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
    }
}

/// Derivatives of the embedding by section coordinates and parameters, by columns.
///
/// No operations.
fn d_embed<S: scalar::Scalar>(
    z: &[S],
    _p: &[S; PARAMETERS],
) -> ([[S; STATES]; 1], [[S; STATES]; PARAMETERS]) {
    let &[_] = z else { return ([nan_state(); 1], [nan_state(); PARAMETERS]) };
    (
        [[S::constant(0.0), S::constant(1.0), S::constant(0.0), S::constant(0.0)]],
        [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// Derivatives of the 3 measures: by the 3 functionals, one row a measure, and by the parameters.
///
/// No operations.
fn d_measures<S: scalar::Scalar>(
    functionals: &[S],
    _p: &[S; PARAMETERS],
) -> ([S; 9], [[S; PARAMETERS]; 3]) {
    let &[_, _, _] = functionals else { return ([nan(); 9], [[nan(); PARAMETERS]; 3]) };
    (
        [
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(1.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(0.0),
            S::constant(1.0),
        ],
        [
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
            [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        ],
    )
}

/// The integrands.
///
/// 3 additions, 2 selections.
fn integrands<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; INTEGRALS] {
    let &[_] = env.memory else { return [nan(); INTEGRALS] };
    let &[_, b1, b2] = env.branch else { return [nan(); INTEGRALS] };
    let &[_, x_v, _, x_u] = x;
    let v0 = -x_v;
    let v1 = S::select(b1, x_v, v0);
    let v2 = -x_u;
    let v3 = S::select(b2, x_u, v2);
    let v4 = v1 + v3;
    [v4]
}

/// Observable 0.
///
/// No operations.
fn observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> S {
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[x_y, _, _, _] = x;
    x_y
}

/// Observable 0 with all first derivatives.
///
/// No operations.
fn d_observable_0<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _] = env.branch else { return nan_rate_gradient() };
    let &[x_y, _, _, _] = x;
    model::RateGradient {
        value: x_y,
        dx: [S::constant(1.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
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
    let &[_] = env.memory else { return nan() };
    let &[_, _, _] = env.branch else { return nan() };
    let &[_, _, x_q, _] = x;
    x_q
}

/// Observable 1 with all first derivatives.
///
/// No operations.
fn d_observable_1<S: scalar::Scalar>(
    x: &[S; STATES],
    env: &model::Env<'_, S, PARAMETERS>,
) -> model::RateGradient<S, STATES, PARAMETERS> {
    let &[_] = env.memory else { return nan_rate_gradient() };
    let &[_, _, _] = env.branch else { return nan_rate_gradient() };
    let &[_, _, x_q, _] = x;
    model::RateGradient {
        value: x_q,
        dx: [S::constant(0.0), S::constant(0.0), S::constant(1.0), S::constant(0.0)],
        dk: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dp: [S::constant(0.0), S::constant(0.0), S::constant(0.0), S::constant(0.0)],
        dtau: S::constant(0.0),
        dt: S::constant(0.0),
    }
}

/// State derivative f of mode `flight` and, for each column v, (df/dx) v.
///
/// Once: 1 addition. A column: No operations.
#[inline]
fn tangent_flow_flight<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, _] = x;
    let v0 = -p_g;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[_, dx_v, _, _] = column;
        *product = [dx_v, S::constant(0.0), S::constant(0.0), S::constant(0.0)];
    }
    ([x_v, v0, S::constant(0.0), S::constant(0.0)], products)
}

/// State derivative f and integrands of mode `flight` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 4 additions, 4 selections. A column: 1 addition, 1 multiplication, 1 fused multiply-add.
#[inline]
fn tangent_integrated_flight<S: scalar::Scalar, const C: usize>(
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
    let &[_, b1, b2] = env.branch else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[p_g, _, _, _] = env.p;
    let &[_, x_v, _, x_u] = x;
    let v0 = -p_g;
    let v1 = -x_v;
    let v2 = S::select(b1, x_v, v1);
    let v3 = -x_u;
    let v4 = S::select(b2, x_u, v3);
    let v5 = v2 + v4;
    let v6 = S::select(b1, S::constant(1.0), S::constant(-1.0));
    let v7 = S::select(b2, S::constant(1.0), S::constant(-1.0));
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[_, dx_v, _, dx_u] = dx;
        let &[dp_g, _, _, _] = dp;
        *dflow = [dx_v, -dp_g, S::constant(0.0), S::constant(0.0)];
        *dintegrands = [v7.mul_add(dx_u, v6 * dx_v)];
    }
    model::Integrated {
        flow: [x_v, v0, S::constant(0.0), S::constant(0.0)],
        integrands: [v5],
        dflow,
        dintegrands,
    }
}

/// State derivative f of mode `stance` and, for each column v, (df/dx) v.
///
/// Once: 2 additions, 2 multiplications. A column: 1 multiplication.
#[inline]
fn tangent_flow_stance<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[_, p_omega, _, _] = env.p;
    let &[_, _, x_q, x_u] = x;
    let v0 = p_omega * p_omega;
    let v1 = v0 * x_q;
    let v2 = -v1;
    let v3 = -v0;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[_, _, dx_q, dx_u] = column;
        *product = [S::constant(0.0), S::constant(0.0), dx_u, v3 * dx_q];
    }
    ([S::constant(0.0), S::constant(0.0), x_u, v2], products)
}

/// State derivative f and integrands of mode `stance` and, for each column (v, w),
/// (d./dx) v + (d./dp) w.
///
/// Once: 7 additions, 3 multiplications, 4 selections. A column: 2 multiplications, 2 fused multiply-adds.
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
    let &[_, b1, b2] = env.branch else {
        return model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }
    };
    let &[_, p_omega, _, _] = env.p;
    let &[_, x_v, x_q, x_u] = x;
    let v0 = p_omega * p_omega;
    let v1 = v0 * x_q;
    let v2 = -v1;
    let v3 = -x_v;
    let v4 = S::select(b1, x_v, v3);
    let v5 = -x_u;
    let v6 = S::select(b2, x_u, v5);
    let v7 = v4 + v6;
    let v8 = S::select(b1, S::constant(1.0), S::constant(-1.0));
    let v9 = -v0;
    let v10 = S::select(b2, S::constant(1.0), S::constant(-1.0));
    let v11 = p_omega + p_omega;
    let v12 = x_q * v11;
    let v13 = -v12;
    let mut dflow = [[S::constant(0.0); STATES]; C];
    let mut dintegrands = [[S::constant(0.0); INTEGRALS]; C];
    let results = dflow.iter_mut().zip(dintegrands.iter_mut());
    for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
        let &[_, dx_v, dx_q, dx_u] = dx;
        let &[_, dp_omega, _, _] = dp;
        *dflow = [
            S::constant(0.0),
            S::constant(0.0),
            dx_u,
            v13.mul_add(dp_omega, v9 * dx_q),
        ];
        *dintegrands = [v10.mul_add(dx_u, v8 * dx_v)];
    }
    model::Integrated {
        flow: [S::constant(0.0), S::constant(0.0), x_u, v2],
        integrands: [v7],
        dflow,
        dintegrands,
    }
}

/// The integrands and their derivatives along each direction.
///
/// Once: 3 additions, 4 selections. A column: 1 multiplication, 1 fused multiply-add.
#[inline]
fn tangent_integrands<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
    let &[_] = env.memory else { return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]) };
    let &[_, b1, b2] = env.branch else {
        return ([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])
    };
    let &[_, x_v, _, x_u] = x;
    let v0 = -x_v;
    let v1 = S::select(b1, x_v, v0);
    let v2 = -x_u;
    let v3 = S::select(b2, x_u, v2);
    let v4 = v1 + v3;
    let v5 = S::select(b1, S::constant(1.0), S::constant(-1.0));
    let v6 = S::select(b2, S::constant(1.0), S::constant(-1.0));
    let mut products = [[S::constant(0.0); INTEGRALS]; C];
    let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
    for (product, (((&[_, dx_v, _, dx_u], _), _), _)) in products
        .iter_mut()
        .zip(directions)
    {
        *product = [v6.mul_add(dx_u, v5 * dx_v)];
    }
    ([v4], products)
}

/// Number of terms that depend only on the clock, on parameters, memory and selectors: the most of any mode.
const CLOCK_TERMS: usize = 1;

/// The terms of mode `flight`'s flow that do not depend on the state.
///
/// 1 addition.
#[cfg_attr(not(debug_assertions), inline(always))]
fn clock_flight<S: scalar::Scalar>(
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; CLOCK_TERMS] {
    let &[_] = env.memory else { return [nan(); CLOCK_TERMS] };
    let &[_, _, _] = env.branch else { return [nan(); CLOCK_TERMS] };
    let &[p_g, _, _, _] = env.p;
    let v0 = -p_g;
    [v0]
}

/// State derivative f of mode `flight` and, for each column v, (df/dx) v, from the terms
/// that do not depend on the state.
///
/// Once: No operations. A column: No operations.
#[cfg_attr(not(debug_assertions), inline(always))]
fn staged_flow_flight<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    clock: &[S; CLOCK_TERMS],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[_, x_v, _, _] = x;
    let &[c0] = clock;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[_, dx_v, _, _] = column;
        *product = [dx_v, S::constant(0.0), S::constant(0.0), S::constant(0.0)];
    }
    ([x_v, c0, S::constant(0.0), S::constant(0.0)], products)
}

/// The terms of mode `stance`'s flow that do not depend on the state.
///
/// 1 addition, 1 multiplication.
#[cfg_attr(not(debug_assertions), inline(always))]
fn clock_stance<S: scalar::Scalar>(
    env: &model::Env<'_, S, PARAMETERS>,
) -> [S; CLOCK_TERMS] {
    let &[_] = env.memory else { return [nan(); CLOCK_TERMS] };
    let &[_, _, _] = env.branch else { return [nan(); CLOCK_TERMS] };
    let &[_, p_omega, _, _] = env.p;
    let v0 = p_omega * p_omega;
    let v1 = -v0;
    [v1]
}

/// State derivative f of mode `stance` and, for each column v, (df/dx) v, from the terms
/// that do not depend on the state.
///
/// Once: 1 multiplication. A column: 1 multiplication.
#[cfg_attr(not(debug_assertions), inline(always))]
fn staged_flow_stance<S: scalar::Scalar, const C: usize>(
    x: &[S; STATES],
    columns: &[[S; STATES]; C],
    clock: &[S; CLOCK_TERMS],
    env: &model::Env<'_, S, PARAMETERS>,
) -> ([S; STATES], [[S; STATES]; C]) {
    let &[_] = env.memory else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, _] = env.branch else { return (nan_state(), [nan_state(); C]) };
    let &[_, _, x_q, x_u] = x;
    let &[c0] = clock;
    let v0 = c0 * x_q;
    let mut products = [[S::constant(0.0); STATES]; C];
    for (product, column) in products.iter_mut().zip(columns) {
        let &[_, _, dx_q, dx_u] = column;
        *product = [S::constant(0.0), S::constant(0.0), dx_u, c0 * dx_q];
    }
    ([S::constant(0.0), S::constant(0.0), x_u, v0], products)
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
