//! Location of an event to rounding error: Newton on the true guard, re-stepping from the start of the step.
//!
//! The dense output only supplies the bracket and the first guess; its error does not enter the result.

use super::surface::{Reading, Side};

const ITERATIONS: usize = 60;

/// The time h after the start of the step at which the surface is crossed, leaving side `from`, between `low` and
/// `high`; `guess` is from the dense output; `reading(h)` reads the surface after `h`.
pub(crate) fn locate(
    reading: &mut impl FnMut(f64) -> Reading,
    tau: f64,
    (low, high): (f64, f64),
    guess: f64,
    from: Side,
) -> f64 {
    let (mut low, mut high, mut h) = (low, high, guess);
    for _ in 0..ITERATIONS {
        let at = reading(h);
        let smallest = 2.0 * f64::EPSILON * (tau.abs() + h.abs());
        if at.value == 0.0 || high - low <= smallest {
            return h;
        }
        if from.sign() * at.value > 0.0 {
            low = low.max(h);
        } else {
            high = high.min(h);
        }
        let newton = h - at.value / at.rate;
        // What is left after Newton's step is of the size of its square. An event does not lie before the step.
        if (newton - h).abs() <= smallest.max(1e-9 * h.abs()) && newton >= 0.0 {
            return newton;
        }
        // A bracket from the dense output may miss by its error: Newton may leave it by as much, but no further.
        let slack = 1e-6 * (high - low);
        h = if newton >= 0.0 && newton > low - slack && newton < high + slack { newton } else { 0.5 * (low + high) };
    }
    h
}
