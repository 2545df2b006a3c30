//! Newton's method with line search for P(z) = z.
//!
//! With F(z) = P(z) - z the step solves (dP/dz - I) s = -F; it is shortened until the scaled residual falls, and also
//! when the map has no next section crossing at the trial point. When Newton cannot go on, a few iterates of the map
//! itself serve as new starts.

use super::gait::{Gait, GaitOutcome, GaitRequest, GaitStatus};
use super::multipliers::{multipliers, spectral_radius};
use crate::event::NOTHING;
use crate::return_map::{
    Accuracy, MapOutcome, MapRequest, MapResult, RequestError, ReturnMap, Sensitivity, Stop, StopReason,
};
use core::cell::Cell;
use nalgebra::{DMatrix, DVector};

/// By how much the run with measures may miss the tolerance of the search.
const OTHER_STEPS: f64 = 1e3;
/// A step that has become so much shorter than that of the guess is on its way to no length at all.
const COLLAPSED: f64 = 1e-5;
/// A step whose length would change by this part of itself on the way to the fixed point has no length there that could be told
/// from none.
const VANISHING: f64 = 0.5;
/// A point that returns to itself within this part of its size is a gait, whatever its step's length.
const FIXED: f64 = 1e-6;
/// How often a Newton step is halved.
const HALVINGS: usize = 20;
/// How many iterates of the map serve as further starts.
const FALLBACK_ITERATES: usize = 12;
/// After each of so many iterates Newton is tried again.
const ITERATES_A_START: usize = 4;
/// In a search with a limit a trial takes at most so many times the steps of the guess's map: a machine that has fallen tumbles on
/// until the time limit, ...
const LONGER: usize = 10;
/// ... but it may always take so many.
const SHORT: usize = 300;

/// Finds a gait near `guess` (section coordinates, SI units).
///
/// # Errors
/// When the request is wrong: lengths, numbers that are not finite, a model without a section or with explicit time.
pub fn find_gait(map: &dyn ReturnMap, request: &GaitRequest<'_>, guess: &[f64]) -> Result<GaitOutcome, RequestError> {
    if map.info().uses_time {
        return Err(RequestError::ExplicitTime(map.info().name));
    }
    let search = Search { map, request, maps: Cell::new(0), steps: Cell::new(request.accuracy.step_limit) };
    if request.segments > 1 {
        return search.multiple(guess);
    }
    let mut start = guess.to_vec();
    let mut best: Option<Point> = None;
    let mut iterations = 0;
    let mut stop = None;
    let mut usual = None;
    for turn in 0..=FALLBACK_ITERATES / ITERATES_A_START {
        match search.evaluate(&start)? {
            Err(stopped) => {
                stop = Some(stopped);
                break;
            }
            Ok(point) => {
                let usual = *usual.get_or_insert(point.map.duration);
                if turn == 0 && request.map_limit < usize::MAX {
                    search.shorten(&point.map);
                }
                let point = search.newton(point, &mut iterations)?;
                let vanishes = || point.residual <= request.tolerance && point.vanishes();
                if (point.map.duration <= COLLAPSED * usual || vanishes()) && !point.is_fixed() {
                    return Ok(search.collapsed(point, iterations));
                }
                if best.as_ref().is_none_or(|b| point.residual < b.residual) {
                    best = Some(point);
                }
            }
        }
        if best.as_ref().is_some_and(|b| b.residual <= request.tolerance) || search.is_spent() {
            break;
        }
        if turn == 0 {
            start = guess.to_vec();
        }
        match search.iterate(&start)? {
            Some(next) => start = next,
            None => break,
        }
    }
    search.finish(best, stop, iterations)
}

/// A point of the section with the map evaluated there.
#[derive(Clone, Debug)]
pub(super) struct Point {
    z: DVector<f64>,
    map: MapResult,
    pub(super) residual: f64,
}

impl Point {
    /// Whether it returns to itself to a small part of its own size, however small that is.
    fn is_fixed(&self) -> bool {
        self.z.iter().zip(&self.map.coordinates).all(|(a, b)| (b - a).abs() <= FIXED * a.abs())
    }

    /// Whether the step is as short as it is only because the point lies near one where steps have no length: by the first order, what
    /// is left of the way to the fixed point changes its duration by as much as there is of it.
    fn vanishes(&self) -> bool {
        if self.z.is_empty() {
            return false;
        }
        let gradient = self.map.duration_gradient.iter();
        let change: f64 = newton_step(self).map_or(0.0, |step| gradient.zip(&step).map(|(slope, z)| slope * z).sum());
        change.abs() > VANISHING * self.map.duration
    }
}

pub(super) struct Search<'a> {
    pub(super) map: &'a dyn ReturnMap,
    pub(super) request: &'a GaitRequest<'a>,
    /// Maps run so far.
    maps: Cell<usize>,
    /// Most steps of a map.
    steps: Cell<usize>,
}

impl Search<'_> {
    /// Whether all maps have been run that may be.
    fn is_spent(&self) -> bool {
        self.maps.get() >= self.request.map_limit
    }

    /// Passes over what is much longer than the guess's map from now on.
    fn shorten(&self, guess: &MapResult) {
        let steps = guess.statistics.steps + guess.statistics.rejected;
        self.steps.set(self.steps.get().min(steps.saturating_mul(LONGER).max(SHORT)));
    }

    fn run(&self, z: &[f64], sensitivity: Sensitivity<'_>, measures: bool) -> Result<MapOutcome, RequestError> {
        self.maps.set(self.maps.get().saturating_add(self.request.period));
        self.map.evaluate(&self.map_request(z, sensitivity, measures))
    }

    pub(super) fn map_request<'z>(
        &'z self,
        z: &'z [f64],
        sensitivity: Sensitivity<'z>,
        measures: bool,
    ) -> MapRequest<'z> {
        MapRequest {
            coordinates: z,
            parameters: self.request.parameters,
            memory: self.request.memory,
            period: self.request.period,
            sensitivity,
            measures,
            accuracy: Accuracy { step_limit: self.steps.get(), ..self.request.accuracy },
        }
    }

    pub(super) fn evaluate(&self, z: &[f64]) -> Result<Result<Point, Stop>, RequestError> {
        Ok(match self.run(z, Sensitivity::Coordinates, false)? {
            MapOutcome::Stopped(stop) => Err(stop),
            MapOutcome::Completed(map) => {
                let z = DVector::from_column_slice(z);
                let residual = residual(&z, &map.coordinates);
                Ok(Point { z, map: *map, residual })
            }
        })
    }

    /// Newton with line search as long as the residual falls.
    fn newton(&self, mut point: Point, iterations: &mut usize) -> Result<Point, RequestError> {
        for _ in 0..self.request.iteration_limit {
            if point.residual == 0.0 || self.is_spent() {
                break;
            }
            let Some(step) = newton_step(&point) else {
                break;
            };
            *iterations += 1;
            let Some(better) = self.line_search(&point, &step)? else {
                break;
            };
            point = better;
        }
        Ok(point)
    }

    /// The first point along the step where the residual falls sufficiently.
    fn line_search(&self, point: &Point, step: &DVector<f64>) -> Result<Option<Point>, RequestError> {
        let mut length = 1.0;
        for _ in 0..HALVINGS {
            let trial = (&point.z + step * length).map(without_underflow);
            if trial.iter().all(|v| v.is_finite())
                && let Ok(better) = self.evaluate(trial.as_slice())?
                && better.residual < point.residual * (1.0 - 0.1 * length)
            {
                return Ok(Some(better));
            }
            // Close to a solution a step that does not help is rounding: no use in shortening it.
            if point.residual <= self.request.tolerance || self.is_spent() {
                break;
            }
            length *= 0.5;
        }
        Ok(None)
    }

    /// Some iterates of the map; `None` when it stops.
    fn iterate(&self, z: &[f64]) -> Result<Option<Vec<f64>>, RequestError> {
        let mut z = z.to_vec();
        for _ in 0..ITERATES_A_START {
            match self.run(&z, Sensitivity::None, false)? {
                MapOutcome::Stopped(_) => return Ok(None),
                MapOutcome::Completed(map) => z = map.coordinates.as_slice().to_vec(),
            }
        }
        Ok(Some(z))
    }

    pub(super) fn finish(
        &self,
        best: Option<Point>,
        stop: Option<Stop>,
        iterations: usize,
    ) -> Result<GaitOutcome, RequestError> {
        let (maps, spent) = (self.maps.get(), self.is_spent());
        let mut residual = best.as_ref().map_or(f64::INFINITY, |b| b.residual);
        let gait = match best {
            Some(point) => Some(self.gait(point)?),
            None => None,
        };
        // What is reported comes from a run of its own, with measures. It takes other steps, so that it closes to the
        // accuracy of integration only; where it does not, it is another run.
        if let Some(gait) = &gait {
            let measured = self::residual(&gait.coordinates, &gait.map.coordinates);
            if measured.is_nan() || measured > OTHER_STEPS * self.request.tolerance {
                residual = measured;
            }
        }
        let converged = residual <= self.request.tolerance;
        let (info, relative) = (self.map.info(), self.request.accuracy.relative);
        let open = gait.as_ref().filter(|_| converged).and_then(|gait| gait.map.open(info, relative));
        let status = match (open, stop) {
            (Some(open), _) => GaitStatus::Open(open),
            _ if converged => GaitStatus::Converged,
            (_, Some(stop)) if gait.is_none() => GaitStatus::Stopped(stop),
            _ if spent => GaitStatus::GaveUp,
            _ => GaitStatus::NotConverged,
        };
        let message = super::message::message(info, &status, residual, self.request);
        Ok(GaitOutcome { status, message, gait, residual, iterations, maps })
    }

    /// The outcome of a search that ran into a step of no length: where a step ends as it begins every map has a fixed point, which
    /// is no gait.
    fn collapsed(&self, point: Point, iterations: usize) -> GaitOutcome {
        let stop =
            Stop { reason: StopReason::Zeno, time: point.map.duration, state: point.map.state.as_slice().to_vec() };
        let message = format!(
            "the search runs into a step of zero length, which is no gait ({:.1e} s when it was given up); try another guess or \
         other parameters",
            stop.time
        );
        GaitOutcome {
            status: GaitStatus::Stopped(stop),
            message,
            gait: None,
            residual: point.residual,
            iterations,
            maps: self.maps.get(),
        }
    }

    fn gait(&self, point: Point) -> Result<Gait, RequestError> {
        let mut map = point.map;
        if self.request.measures {
            match self.run(point.z.as_slice(), Sensitivity::Coordinates, true)? {
                MapOutcome::Completed(full) => map = *full,
                // The gait is there all the same; what cannot be measured is not a number.
                MapOutcome::Stopped(_) => {
                    map.measures = DVector::from_element(self.map.info().measures.len(), f64::NAN);
                }
            }
        }
        let multipliers = multipliers(&map.jacobian);
        let spectral_radius = spectral_radius(&multipliers);
        Ok(Gait { coordinates: point.z, map, multipliers, spectral_radius })
    }
}

/// A coordinate, or 0 where it is so small that products of two such numbers underflow: Newton's method halves its way to a gait
/// at 0 down to the smallest number there is, and the motion from there has no derivatives.
fn without_underflow(z: f64) -> f64 {
    if z.abs() < NOTHING { 0.0 } else { z }
}

fn residual(z: &DVector<f64>, image: &DVector<f64>) -> f64 {
    let mut worst = 0.0;
    for (a, b) in z.iter().zip(image) {
        let component = (b - a).abs() / a.abs().max(1.0);
        // NaN wins, and stays.
        if component > worst || component.is_nan() {
            worst = component;
        }
    }
    worst
}

/// The Newton step; where the matrix is singular, the shortest step that solves in the least-squares sense.
fn newton_step(point: &Point) -> Option<DVector<f64>> {
    let d = point.z.len();
    let matrix = &point.map.jacobian - DMatrix::identity(d, d);
    let right = &point.z - &point.map.coordinates;
    if let Some(step) = matrix.clone().lu().solve(&right)
        && step.iter().all(|v| v.is_finite())
    {
        return Some(step);
    }
    let svd = matrix.svd(true, true);
    let cut = 1e-12 * svd.singular_values.max();
    svd.solve(&right, cut).ok().filter(|step| step.iter().all(|v| v.is_finite()))
}
