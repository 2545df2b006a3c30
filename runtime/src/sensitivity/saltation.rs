//! The saltation matrix: how variations pass an event.
//!
//! An event is where the guard g(x, tau, t, p) vanishes. With f- the flow before it, w the variation of the parameters
//! and s that of the time at which the segment's clock tau was started, the event moves by
//!
//! ```text
//! d tau* = -(g_x v + g_p w + g_t s) / (g_x f- + g_tau + g_t)
//! ```
//!
//! and the state just after it, x+ = R(x-, tau, t, p), by
//!
//! ```text
//! v_total = R_x (v + f- d tau*) + R_tau d tau* + R_t (s + d tau*) + R_p w.
//! ```
//!
//! A segment that restarts its clock at the event starts with v+ = v_total and s+ = s + d tau*. Where the clock runs on
//! (a switch of the flow), variations at fixed time are v+ = v_total - f+ d tau*; without parameter and time terms this
//! is v+ = Xi v with the saltation matrix Xi = R_x + (f+ - R_x f- - R_t) g_x / (g_t + g_x f-) of Kong, Payne, Zhu and
//! Johnson, "Saltation matrices: the essential tool for linearizing hybrid dynamical systems". The derivation is in
//! docs/mathematics.md.

use crate::model::{Gradient, Jacobian};
use crate::scalar::{Scalar, filled};

/// What becomes of the clock tau at an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clock<const N: usize, S = f64> {
    /// It starts again at 0: a transition.
    Restarts,
    /// It runs on, with this flow just after the event: a switch.
    RunsOn([S; N]),
}

/// An event: guard and reset linearised there.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<'a, const N: usize, const P: usize, S = f64> {
    /// The guard.
    pub guard: &'a Gradient<S, N, P>,
    /// The reset; `None` is the identity.
    pub reset: Option<&'a Jacobian<S, N, P>>,
    /// The flow just before.
    pub before: [S; N],
    /// The clock.
    pub clock: Clock<N, S>,
}

impl<S: Scalar, const N: usize, const P: usize> Crossing<'_, N, P, S> {
    /// Time derivative of the guard along the flow before the event: the transversality.
    pub fn transversality(&self) -> S {
        dot(&self.guard.dx, &self.before) + self.guard.dtau + self.guard.dt
    }

    /// d tau*: how the time of the event, on the segment's clock, follows the variations `dx` (of the state at fixed
    /// tau), `dp` (of the parameters) and `dstart` (of the time at which the clock started). 0 where the guard is
    /// touched with zero transversality: the time has no derivative there, and the run carries a warning.
    pub fn time_derivative(&self, dx: &[S; N], dp: &[S; P], dstart: S) -> S {
        let rate = self.transversality();
        let motion = dot(&self.guard.dx, dx) + dot(&self.guard.dp, dp) + self.guard.dt * dstart;
        S::select(rate.is_zero(), S::constant(0.0), -motion / rate)
    }

    /// The variation of the state just after the event, on the clock that runs there; `dtau` as from
    /// [`Self::time_derivative`].
    pub fn pass(&self, dx: &[S; N], dp: &[S; P], dstart: S, dtau: S) -> [S; N] {
        let mut total = *dx;
        for i in 0..N {
            total[i] = total[i] + self.before[i] * dtau;
        }
        if let Some(reset) = self.reset {
            total = through(reset, &total, dp, dstart, dtau);
        }
        if let Clock::RunsOn(after) = self.clock {
            for i in 0..N {
                total[i] = total[i] - after[i] * dtau;
            }
        }
        total
    }
}

/// The saltation matrix, as an array of columns: d x+ / d x- at fixed parameters.
pub fn saltation_matrix<const N: usize, const P: usize>(crossing: &Crossing<'_, N, P>) -> [[f64; N]; N] {
    let dp = [0.0; P];
    filled([0.0; N], |j| {
        let mut dx = [0.0; N];
        dx[j] = 1.0;
        let dtau = crossing.time_derivative(&dx, &dp, 0.0);
        crossing.pass(&dx, &dp, 0.0, dtau)
    })
}

/// How variations of the state at an event, its motion in time included, pass the reset.
pub(crate) fn through<S: Scalar, const N: usize, const P: usize>(
    reset: &Jacobian<S, N, P>,
    total: &[S; N],
    dp: &[S; P],
    dstart: S,
    dtau: S,
) -> [S; N] {
    let mut result = [S::constant(0.0); N];
    for i in 0..N {
        let mut sum = reset.dtau[i] * dtau + reset.dt[i] * (dstart + dtau);
        for j in 0..N {
            sum = sum + reset.dx[j][i] * total[j];
        }
        for j in 0..P {
            sum = sum + reset.dp[j][i] * dp[j];
        }
        result[i] = sum;
    }
    result
}

/// Scalar product.
pub(crate) fn dot<S: Scalar, const L: usize>(a: &[S; L], b: &[S; L]) -> S {
    let mut sum = S::constant(0.0);
    for i in 0..L {
        sum = sum + a[i] * b[i];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    /// The bouncing ball (y, v) with restitution e: Xi = [[-e, 0], [-(1 + e) g/v, -e]] by rows.
    #[test]
    fn bouncing_ball_has_its_closed_form() {
        let (g, e, v) = (9.81, 0.7, -2.0);
        let guard = Gradient { value: 0.0, dx: [1.0, 0.0], dp: [], dtau: 0.0, dt: 0.0 };
        let dx = [[1.0, 0.0], [0.0, -e]];
        let reset = Jacobian { value: [0.0, -e * v], dx, dp: [], dtau: [0.0; 2], dt: [0.0; 2] };
        let before = [v, -g];
        let clock = Clock::RunsOn([-e * v, -g]);
        let crossing = Crossing::<2, 0> { guard: &guard, reset: Some(&reset), before, clock };
        let xi = saltation_matrix(&crossing);
        let exact = [[-e, -(1.0 + e) * g / v], [0.0, -e]];
        for j in 0..2 {
            for i in 0..2 {
                assert_abs_diff_eq!(xi[j][i], exact[j][i], epsilon = 1e-14);
            }
        }
    }

    /// Guard, reset and flow that depend on everything, against Xi as published, with D_t terms.
    #[test]
    fn time_terms_agree_with_the_published_formula() {
        let guard = Gradient { value: 0.0, dx: [0.3, -1.1], dp: [0.4], dtau: 0.0, dt: 0.25 };
        let dx = [[0.9, 0.2], [-0.4, 1.3]];
        let reset = Jacobian { value: [0.0; 2], dx, dp: [[0.7, -0.6]], dtau: [0.0; 2], dt: [0.15, -0.35] };
        let (before, after) = ([0.8, -0.5], [-0.2, 1.4]);
        let crossing = Crossing::<2, 1> { guard: &guard, reset: Some(&reset), before, clock: Clock::RunsOn(after) };
        let xi = saltation_matrix(&crossing);
        let rate = 0.25 + 0.3 * 0.8 + 1.1 * 0.5;
        assert_abs_diff_eq!(crossing.transversality(), rate, epsilon = 1e-15);
        for j in 0..2 {
            for i in 0..2 {
                let jump = after[i] - dx[0][i] * before[0] - dx[1][i] * before[1] - reset.dt[i];
                assert_abs_diff_eq!(xi[j][i], dx[j][i] + jump * guard.dx[j] / rate, epsilon = 1e-14);
            }
        }
        // A parameter moves the event, and the reset.
        let dtau = crossing.time_derivative(&[0.0; 2], &[1.0], 0.0);
        assert_abs_diff_eq!(dtau, -0.4 / rate, epsilon = 1e-15);
        let touched = Gradient { dx: [0.0; 2], dt: 0.0, ..guard };
        assert_eq!(Crossing { guard: &touched, ..crossing }.time_derivative(&[1.0, 1.0], &[1.0], 0.0), 0.0);
    }
}
