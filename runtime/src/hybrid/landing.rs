//! The last step before an event: from its start to exactly the event.
//!
//! Where the mass matrix vanishes at the event, the method knows the rates there only as the derivative of the polynomial
//! through its stages, good to h^S. When functionals are carried, which may take rates there, the step is therefore split: its
//! second part is so short that this no longer matters.

use super::run::Run;
use crate::event::{Found, read};
use crate::integrate::{Carried, Held, Method, Purpose, StepOf};
use crate::model::Model;
use crate::return_map::StopReason;

/// The second part of a split step, as a fraction of it.
pub(super) const LAST_PART: f64 = 0.01;
/// An event before this fraction of a step takes its rates from the step that it lies in.
pub(super) const EARLY: f64 = 1e-3;
/// Corrections of the second part's size.
const CORRECTIONS: usize = 4;

impl<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>
    Run<'_, X, M, R, N, P, Q, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    /// Replaces the step by one (or two) from the same start that ends at the event `found`.
    pub(crate) fn land(&mut self, found: &Found) -> Result<(), StopReason> {
        let part = found.h / self.step.h;
        if X::RATES_BY_POLYNOMIAL && part < EARLY {
            let accepted = self.step.stages;
            self.shorten(found.h)?;
            X::take_rates(&mut self.step, &accepted, part);
            return self.complete_step();
        }
        if !(X::RATES_BY_POLYNOMIAL && R::MEASURED) {
            self.shorten(found.h)?;
            return self.complete_step();
        }
        self.shorten((1.0 - LAST_PART) * found.h)?;
        self.complete_step()?;
        self.move_on();
        self.shorten(LAST_PART * found.h)?;
        self.correct(found)?;
        self.complete_step()
    }

    /// One step of size `h` from where the run is. It is shorter than one that was accepted, so that this fails is all but
    /// impossible.
    fn shorten(&mut self, h: f64) -> Result<(), StopReason> {
        let solved = self.attempt(h, Purpose::Land);
        self.finish();
        if solved.is_finite() { Ok(()) } else { Err(StopReason::StepTooSmall) }
    }

    /// The event was located on one step; on two it is elsewhere by the difference of their errors.
    fn correct(&mut self, found: &Found) -> Result<(), StopReason> {
        let Some(surface) = self.watched.get(found.watched).map(|w| w.surface) else {
            return Ok(());
        };
        for _ in 0..CORRECTIONS {
            let (x, k) = (&self.step.end.x, &self.step.end_rates.x);
            let (tau, h) = (self.step.tau, self.step.h);
            let reading = read::<M, N, P, Q>(surface, x, k, &self.segment.env(tau + h));
            let correction = reading.value / reading.rate;
            let smallest = 2.0 * f64::EPSILON * (tau + h);
            // A touch has no rate to correct by.
            if !(correction.abs() > smallest && correction.abs() < 0.1 * h) {
                break;
            }
            self.shorten(h - correction)?;
        }
        Ok(())
    }
}

/// The solution `h` after the start of a step that was taken, as the end of one step (or of the second of two).
pub(crate) fn stand_at<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    held: &Held<'_, P, C>,
    step: &StepOf<X, N, W, C>,
    h: f64,
    work: &mut X::Workspace<N>,
    evaluations: &mut usize,
) -> StepOf<X, N, W, C>
where
    X: Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    let mut y = *step;
    let mut go = |y: &mut StepOf<X, N, W, C>, h: f64| {
        let tolerance = held.frame.tolerance;
        X::attempt::<M, R, N, P, Q, W, C>(held, y, h, Purpose::Land, tolerance, work, evaluations);
        X::finish::<M, R, N, P, Q, W, C>(held, y, evaluations);
    };
    if X::RATES_BY_POLYNOMIAL {
        go(&mut y, (1.0 - LAST_PART) * h);
        y.move_on();
        go(&mut y, LAST_PART * h);
    } else {
        go(&mut y, h);
    }
    y
}
