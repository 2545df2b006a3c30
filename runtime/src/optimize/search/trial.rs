//! Trying a step: back to the gaits, correction of second order, acceptance, and the radius for the next one.

use super::super::kkt::lagrangian_gradient;
use super::super::pieces::alike;
use super::super::problem::ProblemError;
use super::super::program::{Failure, Point};
use super::super::subproblem::{Multipliers, Step};
use super::Search;
use nalgebra::DVector;
use std::ops::AddAssign;

/// A ratio of the merit's reduction to the promised one with which nothing needs correcting.
const GOOD: f64 = 0.75;
/// Part of the promised reduction that violations after the step may take before they are corrected.
const SPOILT: f64 = 0.1;
/// A gait whose step takes so many times longer, or shorter, is not the one that is followed.
const OTHER_GAIT: f64 = 2.5;
/// A step that is so many times shorter or longer than that of the gait where the search began is no step of that machine any
/// more: where steps shrink to no length every map returns to its start.
const ANOTHER_KIND: f64 = 1e3;
/// Most steps back to periodicity after a trial.
const RESTORATIONS: usize = 3;
const LARGEST_RADIUS: f64 = 4.0;

impl Search<'_, '_> {
    /// Tries a step, with its gait brought back to periodicity and the constraints' curvature taken into account where these
    /// spoil it; moves when the merit falls enough, and adapts the radius.
    pub(super) fn advance(
        &mut self,
        step: &Step,
        promised: f64,
        lower: &[f64],
        upper: &[f64],
    ) -> Result<(), ProblemError> {
        let mut trial = self.trial(&(&self.point.u + &step.s))?;
        for _ in 0..RESTORATIONS {
            let Some(point) = &trial else { break };
            if self.tie * point.h.lp_norm(1) <= SPOILT * promised {
                break;
            }
            let Some(restored) = self.restored(point)? else { break };
            trial = Some(restored);
        }
        let mut ratio = self.ratio(trial.as_ref(), promised);
        if ratio < GOOD
            && let Some(point) = &trial
            && self.cost(&point.h, &self.shifted(&point.c)) > SPOILT * promised
            && let Some(corrected) = self.corrected(&(&point.u - &self.point.u), point, lower, upper)
            && let Some(second) = self.trial(&(&self.point.u + corrected))?
        {
            let better = self.ratio(Some(&second), promised);
            if better > ratio {
                (trial, ratio) = (Some(second), better);
            }
        }
        let length = step.s.norm();
        let moved = match trial {
            Some(point) if ratio > 1e-4 => self.accept(point, &step.multipliers)?,
            _ => false,
        };
        if moved {
            self.refused.take();
        }
        if !moved {
            self.radius = 0.25 * f64::min(self.radius, length);
        } else if ratio < 0.25 {
            self.radius = 0.5 * f64::min(self.radius, length);
        } else if ratio > GOOD && length > 0.8 * self.radius {
            self.radius = f64::min(2.0 * self.radius, LARGEST_RADIUS);
        }
        Ok(())
    }

    /// A step of Newton's method on the periodicity alone, with the parameters as they are: towards the gait near a point.
    /// `None` where that does not come closer to one.
    fn restored(&self, point: &Point) -> Result<Option<Point>, ProblemError> {
        let (d, at) = (point.h.len(), self.program.variables.section_at());
        let matrix = self.program.periodicity_jacobian(point).columns(at, d).into_owned();
        let Some(correction) = matrix.lu().solve(&-&point.h).filter(|z| z.norm() <= self.radius) else {
            return Ok(None);
        };
        let mut u = point.u.clone();
        u.rows_mut(at, d).add_assign(&correction);
        let closer = |other: &Point| other.h.lp_norm(1) < 0.5 * point.h.lp_norm(1);
        Ok(self.trial(&u)?.filter(closer))
    }

    /// The point at some unknowns; `None` where the map stops, a value is not finite, or the gait's step is so much longer
    /// or shorter that it is another gait (or, where it goes towards no length at all, none).
    fn trial(&self, u: &DVector<f64>) -> Result<Option<Point>, ProblemError> {
        match self.program.evaluate(u) {
            Ok(point) => {
                let (before, after) = (self.point.map.duration, point.map.duration);
                let same = within(OTHER_GAIT, before, after);
                Ok((same && within(ANOTHER_KIND, self.began.map.duration, after)).then_some(point))
            }
            Err(Failure::Wrong(error)) => Err(error),
            Err(failure) => {
                if let Failure::Stopped(stop) = failure {
                    self.refused.replace(Some(stop));
                }
                Ok(None)
            }
        }
    }

    /// Whether the search stands next to where steps count as of no length, or without end: the place says nothing of gaits.
    pub(super) fn degenerate(&self) -> bool {
        !within(ANOTHER_KIND / OTHER_GAIT, self.began.map.duration, self.point.map.duration)
    }

    /// Reduction of the merit over what was promised; both are allowed the rounding of the maps.
    fn ratio(&self, trial: Option<&Point>, promised: f64) -> f64 {
        let error = f64::max(1e-13, 0.1 * self.program.problem.settings.accuracy.relative);
        let rounding = error * (1.0 + self.point.f.abs() + self.penalty + self.tie);
        match trial {
            Some(point) => (self.merit(&self.point) - self.merit(point) + rounding) / (promised + rounding),
            None => f64::NEG_INFINITY,
        }
    }

    /// Second-order correction: the same model with the constraints' values after the step.
    fn corrected(&self, s: &DVector<f64>, trial: &Point, lower: &[f64], upper: &[f64]) -> Option<DVector<f64>> {
        let mut problem = self.subproblem(lower, upper);
        problem.h = &trial.h - &self.lin.h * s;
        problem.c = self.shifted(&trial.c) - &self.lin.c * s;
        self.tied(problem).ok().map(|step| step.s)
    }

    /// Moves to a point; `false` when it has no derivatives.
    fn accept(&mut self, point: Point, multipliers: &Multipliers) -> Result<bool, ProblemError> {
        let next = self.program.settled(point).and_then(|(point, others)| {
            let lin = self.program.linearise_to(&point, self.lin.rough)?;
            Ok((point, others, lin))
        });
        let (point, others, lin) = match next {
            Ok(next) => next,
            Err(failure) => {
                self.program.adopt(Some(&self.point));
                return if let Failure::Wrong(error) = failure { Err(error) } else { Ok(false) };
            }
        };
        // With other rows the multipliers are those of others.
        if !others && alike(&self.point, &point) {
            let change = lagrangian_gradient(&lin, multipliers) - lagrangian_gradient(&self.lin, multipliers);
            self.model.update(&(&point.u - &self.point.u), &change);
        }
        (self.point, self.lin) = (point, lin);
        Ok(true)
    }
}

/// Whether two positive numbers differ by a factor of no more than `factor`.
fn within(factor: f64, a: f64, b: f64) -> bool {
    a <= factor * b && b <= factor * a
}
