//! Location of an event to rounding error: Newton on the true guard, re-stepping from the start of the step.
//!
//! The dense output only supplies the bracket and the first guess; its error does not enter the result.

use super::surface::{Reading, Side};
use crate::ode::{Bundle, Stages, Step, attempt};

const ITERATIONS: usize = 60;

/// The state after `h` from the start of a step, by one step of that size.
pub(crate) fn restep<const N: usize, const W: usize, const C: usize>(
    flow: &impl Fn(f64, &[f64; N]) -> [f64; N],
    step: &Step<Bundle<N, W, C>>,
    h: f64,
) -> [f64; N] {
    short_step(flow, step.tau, &step.start.x, &step.stages[0].x, h)
}

/// The state after one step of size `h` from (`tau`, `x`), where the flow is `rate`.
pub(crate) fn short_step<const N: usize>(
    flow: &impl Fn(f64, &[f64; N]) -> [f64; N],
    tau: f64,
    x: &[f64; N],
    rate: &[f64; N],
    h: f64,
) -> [f64; N] {
    let bundle = |x: [f64; N]| Bundle::<N, 0, 0> {
        x,
        q: [],
        dx: [],
        dq: [],
    };
    let mut k: Stages<Bundle<N, 0, 0>> = [bundle(*rate); 12];
    attempt(
        &|tau, y: &Bundle<N, 0, 0>| bundle(flow(tau, &y.x)),
        tau,
        h,
        &bundle(*x),
        &mut k,
    )
    .x
}

/// The time h after the start of the step at which the surface is crossed, leaving side `from`, between `low` and
/// `high`; `guess` is from the dense output; `reading(h)` reads the surface after `h`. Also says how many readings it took.
pub(crate) fn locate(
    reading: &impl Fn(f64) -> Reading,
    tau: f64,
    (low, high): (f64, f64),
    guess: f64,
    from: Side,
) -> (f64, usize) {
    let (mut low, mut high, mut h) = (low, high, guess);
    let smallest = 2.0 * f64::EPSILON * (tau.abs() + high);
    for count in 1..=ITERATIONS {
        let at = reading(h);
        if at.value == 0.0 || high - low <= smallest {
            return (h, count);
        }
        if from.sign() * at.value > 0.0 {
            low = low.max(h);
        } else {
            high = high.min(h);
        }
        let newton = h - at.value / at.rate;
        if (newton - h).abs() <= smallest {
            return (newton, count);
        }
        // A bracket from the dense output may miss by its error: Newton may leave it by as much, but no further.
        let slack = 1e-6 * (high - low);
        h = if newton > low - slack && newton < high + slack {
            newton
        } else {
            0.5 * (low + high)
        };
    }
    (h, ITERATIONS)
}
