//! Step size: a proportional-integral controller and the size of the first step.
//!
//! h_new = h * safety * err^(-alpha) * err_old^beta (Gustafsson; Hairer, Norsett, Wanner, section II.4), bounded, and
//! not growing right after a rejection.

use super::step::Tolerance;

const BETA: f64 = 0.02;
const SAFETY: f64 = 0.9;
const LARGEST_GROWTH: f64 = 6.0;
const LARGEST_SHRINK: f64 = 1.0 / 3.0;
/// How much a step shrinks when a value was not finite.
const NOT_FINITE_SHRINK: f64 = 0.25;

/// Proposes step sizes from errors.
#[derive(Clone, Copy, Debug)]
pub struct Controller {
    order: f64,
    previous: f64,
    rejected: bool,
    /// Size and error of the last accepted step, where the controller looks at how errors change from step to step.
    accepted: Option<(f64, f64)>,
    predictive: bool,
}

impl Controller {
    /// For an error estimate that behaves like h to the power `order`.
    pub fn new(order: f64) -> Self {
        Self { order, previous: 1e-4, rejected: false, accepted: None, predictive: false }
    }

    /// The same, and sizes follow the trend of the errors: a solution that gets harder from step to step would have every
    /// second step rejected (Gustafsson's predictive control; Hairer, Wanner, section IV.8).
    pub fn predictive(order: f64) -> Self {
        Self { predictive: true, ..Self::new(order) }
    }

    /// Whether a step with this error is accepted, and the size of the next one (or of the next attempt).
    pub fn judge(&mut self, error: f64, h: f64) -> (bool, f64) {
        if !error.is_finite() {
            self.rejected = true;
            return (false, h * NOT_FINITE_SHRINK);
        }
        let alpha = 1.0 / self.order - 0.2 * BETA;
        let plain = SAFETY * error.max(1e-12).powf(-alpha);
        if error > 1.0 {
            self.rejected = true;
            return (false, h * plain.clamp(LARGEST_SHRINK, 1.0));
        }
        let limit = if self.rejected { 1.0 } else { LARGEST_GROWTH };
        let factor = (plain * self.previous.powf(BETA)).clamp(LARGEST_SHRINK, limit);
        let factor = factor.min(self.trend(error, h)).max(LARGEST_SHRINK);
        self.previous = error.max(1e-4);
        self.rejected = false;
        (true, h * factor)
    }
}

impl Controller {
    /// The factor that the last two accepted steps suggest; infinite when there is nothing to go by.
    fn trend(&mut self, error: f64, h: f64) -> f64 {
        let error = error.max(1e-2);
        let before = self.accepted.replace((h, error));
        match before {
            Some((size, last)) if self.predictive => {
                SAFETY * (h / size) * (last / (error * error)).powf(1.0 / self.order)
            }
            _ => f64::INFINITY,
        }
    }
}

/// A first step size for a method of order 8, from one more evaluation of the flow: the second derivative tells how fast
/// the flow changes.
pub fn first_step<const N: usize>(
    flow: &impl Fn(f64, &[f64; N]) -> [f64; N],
    tau: f64,
    x: &[f64; N],
    rate: &[f64; N],
    tolerance: Tolerance,
    longest: f64,
) -> f64 {
    let scaled = |v: &dyn Fn(usize) -> f64| {
        let mut sum = 0.0;
        for i in 0..N {
            let scale = tolerance.absolute + tolerance.relative * x[i].abs();
            sum += (v(i) / scale) * (v(i) / scale);
        }
        (sum / (N.max(1) as f64)).sqrt()
    };
    let (size, speed) = (scaled(&|i| x[i]), scaled(&|i| rate[i]));
    let trial = if size > 1e-5 && speed > 1e-5 { 0.01 * size / speed } else { 1e-6 };
    let trial = trial.min(longest);
    let mut ahead = *x;
    for i in 0..N {
        ahead[i] += trial * rate[i];
    }
    let later = flow(tau + trial, &ahead);
    let bend = scaled(&|i| later[i] - rate[i]) / trial;
    let largest = speed.max(bend);
    let guess = if largest <= 1e-15 { (trial * 1e-3).max(1e-6) } else { (0.01 / largest).powf(1.0 / 8.0) };
    let guess = if guess.is_finite() { guess.min(100.0 * trial) } else { trial };
    guess.min(longest)
}
