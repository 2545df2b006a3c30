//! The search for a gait by multiple shooting: plans, their pieces, and what is reported.

use super::gait::GaitOutcome;
use super::multipliers::{multipliers, spectral_radius};
use super::newton::Search;
use super::shooting::{Shot, shoot};
use crate::return_map::{MapOutcome, RequestError, Sensitivity};

/// How many plans multiple shooting makes before it gives up.
const PLANS: usize = 30;
/// By how much errors may be larger than the tolerance until multiple shooting is near its end.
const ON_THE_WAY: f64 = 1e6;

impl Search<'_> {
    /// Multiple shooting. A plan that no longer holds is made anew where the search stands.
    pub(super) fn multiple(&self, guess: &[f64]) -> Result<GaitOutcome, RequestError> {
        let (mut z, mut iterations, mut near) = (guess.to_vec(), 0, false);
        let (mut best, mut planned): (Option<Shot>, bool) = (None, false);
        for _ in 0..PLANS {
            let (outcome, plan) = self.map.plan(&self.map_request(&z, Sensitivity::Coordinates, false))?;
            if let (MapOutcome::Stopped(stop), None) = (outcome, &best) {
                return self.finish(None, Some(stop), iterations);
            }
            let Some(plan) = plan.filter(|_| self.request.period == 1) else {
                break;
            };
            planned = true;
            // The last round, from where the others have led, is exact.
            let plan = if near { plan } else { plan.relaxed(ON_THE_WAY) };
            let pieces = plan.pieces(self.request.segments);
            let limits = (self.request.tolerance, self.request.iteration_limit);
            let Some(shot) = shoot(self.map, self.request.parameters, &pieces, &z, limits)? else {
                break;
            };
            let solved = shot.residual <= self.request.tolerance;
            iterations += shot.iterations;
            z = shot.z.as_slice().to_vec();
            best = Some(shot);
            if solved && near {
                break;
            }
            near = solved;
        }
        let Some(shot) = best else {
            if !planned {
                return Err(RequestError::NoPlan(self.map.info().name));
            }
            return match self.evaluate(guess)? {
                Ok(point) => self.finish(Some(point), None, iterations),
                Err(stop) => self.finish(None, Some(stop), iterations),
            };
        };
        let point = self.evaluate(shot.z.as_slice())?;
        let mut outcome = match point {
            Ok(mut point) => {
                point.residual = point.residual.max(shot.residual);
                self.finish(Some(point), None, iterations)?
            }
            Err(stop) => return self.finish(None, Some(stop), iterations),
        };
        if let Some(gait) = &mut outcome.gait {
            gait.multipliers = multipliers(&shot.jacobian);
            gait.spectral_radius = spectral_radius(&gait.multipliers);
            gait.map.jacobian = shot.jacobian;
        }
        Ok(outcome)
    }
}
