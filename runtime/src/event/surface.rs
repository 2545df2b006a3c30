//! What is watched during a segment: guards of the mode's transitions and the mode's switching functions.

use crate::model::{Direction, Env, Gradient, Model};
use crate::sensitivity::dot;

/// How many units in the last place of its terms a guard's value may be off by rounding.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// What is smaller than this is zero in any unit: its square is lost to underflow, and rates so small have no inverse.
pub(crate) const NOTHING: f64 = 1e-150;

/// A function whose zeros are events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Surface {
    /// Guard of a transition.
    Transition(usize),
    /// A switching function.
    Switch(usize),
}

/// On which side of a surface the run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// The function is negative.
    Negative,
    /// Not known: zero with all derivatives that were looked at.
    Unknown,
    /// The function is positive.
    Positive,
}

/// Value and time derivative of a surface's function at one point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    /// The value.
    pub(crate) value: f64,
    /// Its time derivative along the flow.
    pub(crate) rate: f64,
    /// Below this a value is zero to rounding.
    pub(crate) rounding: f64,
    /// Whether the function does not depend on the state here, only on time and parameters.
    pub(crate) clock_only: bool,
}

impl Side {
    /// The side on which `value` is.
    pub(crate) fn of(value: f64) -> Self {
        if value > 0.0 {
            Self::Positive
        } else if value < 0.0 {
            Self::Negative
        } else {
            Self::Unknown
        }
    }

    /// -1, 0 or 1.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Negative => -1.0,
            Self::Unknown => 0.0,
            Self::Positive => 1.0,
        }
    }

    /// The other side.
    pub(crate) fn opposite(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Unknown => Self::Unknown,
            Self::Positive => Self::Negative,
        }
    }

    /// Whether a passage that leaves this side is one that `direction` asks for.
    pub(crate) fn leaves(self, direction: Direction) -> bool {
        match self {
            Self::Negative => direction != Direction::Falling,
            Self::Unknown => false,
            Self::Positive => direction != Direction::Rising,
        }
    }
}

/// The linearisation of a surface's function.
#[inline]
pub(crate) fn gradient<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    surface: Surface,
    x: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Gradient<f64, N, P> {
    match surface {
        Surface::Transition(i) => M::guard_gradient(i, x, env),
        Surface::Switch(i) => M::switch_gradient(i, x, env),
    }
}

/// The value of a surface's function.
#[inline]
pub(crate) fn value<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    surface: Surface,
    x: &[f64; N],
    env: &Env<'_, f64, P>,
) -> f64 {
    match surface {
        Surface::Transition(i) => M::guard(i, x, env),
        Surface::Switch(i) => M::switch(i, x, env),
    }
}

/// Reads a surface where the rate is `flow`.
#[inline]
pub(crate) fn read<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    surface: Surface,
    x: &[f64; N],
    flow: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Reading {
    let g = gradient::<M, N, P, Q>(surface, x, env);
    let mut size = g.value.abs() + (g.dtau * env.tau).abs() + (g.dt * env.t).abs();
    let mut clock_only = true;
    for i in 0..N {
        size += (g.dx[i] * x[i]).abs();
        clock_only &= g.dx[i] == 0.0;
    }
    for i in 0..P {
        size += (g.dp[i] * env.p[i]).abs();
    }
    let rate = dot(&g.dx, flow) + g.dtau + g.dt;
    Reading { value: g.value, rate, rounding: (ROUNDING * size).max(NOTHING), clock_only }
}
