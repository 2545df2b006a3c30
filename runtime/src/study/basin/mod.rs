//! Basins: where the motion from a start settles.
//!
//! The return map is iterated from each start. Where it comes back to where it was k maps ago, Newton's method looks for a gait of
//! period k there; the start belongs to that gait when the gait is stable and the iterates are next to it. Each start is followed by
//! itself; which of the gaits are the same is found afterwards, in the order of the starts ([`Gaits`]).

mod gaits;

pub use gaits::Gaits;

use crate::optimize::Interrupt;
use crate::orbit::{GaitRequest, GaitStatus, find_gait};
use crate::return_map::{MapOutcome, MapRequest, RequestError, ReturnMap, Sensitivity, StopReason};
use gaits::{canonical, near};

/// An iterate that comes back this close, relative to `max(1, |component|)`, may be next to a gait ...
const BACK: f64 = 1e-6;
/// ... which it is when the gait is not further away than this.
const NEXT_TO: f64 = 1e-3;

/// How motions are followed.
#[derive(Clone)]
pub struct Basin<'a> {
    /// The return map.
    pub map: &'a dyn ReturnMap,
    /// Parameters, memory, accuracy and tolerance of the gaits; their period does not matter.
    pub request: GaitRequest<'a>,
    /// Most maps from each start.
    pub steps: usize,
    /// Longest period of a gait, in maps.
    pub periods: usize,
    /// Ends the work early: what is then said of a start is of no use.
    pub interrupt: Interrupt,
}

/// How a motion ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// It settles on a stable gait.
    Gait {
        /// In how many maps it repeats; the least such number.
        period: usize,
    },
    /// It has no next section crossing.
    Stopped(StopReason),
    /// Neither within the number of maps.
    Undecided,
}

/// What became of a start.
#[derive(Clone, Debug, PartialEq)]
pub struct Fate {
    /// How it ended.
    pub end: End,
    /// After how many maps.
    pub steps: usize,
    /// Section coordinates at the end: of a gait, those of the one of its points that has the largest first coordinate (of
    /// those the largest second, and so on); else where the last map ended.
    pub coordinates: Vec<f64>,
}

impl Basin<'_> {
    /// Follows the motion from section coordinates `start`, SI units.
    ///
    /// # Errors
    /// When the request is wrong.
    pub fn fate(&self, start: &[f64]) -> Result<Fate, RequestError> {
        let mut last = vec![start.to_vec()];
        let mut next_look = 0;
        for steps in 1..=self.steps {
            if self.interrupt.requested() {
                break;
            }
            let z = match self.step(last.last().map_or(start, Vec::as_slice))? {
                Ok(z) => z,
                Err(reason) => return Ok(fate(End::Stopped(reason), steps - 1, last.pop().unwrap_or_default())),
            };
            let back = (1..=self.periods.min(last.len())).find(|k| near(&last[last.len() - k], &z, BACK));
            last.push(z);
            if last.len() > self.periods {
                last.remove(0);
            }
            let (Some(back), Some(z)) = (back, last.last()) else { continue };
            if steps < next_look {
                continue;
            }
            if let Some((period, coordinates)) = self.settled(z, back)? {
                return Ok(fate(End::Gait { period }, steps, coordinates));
            }
            // It passes by an unstable gait, or creeps: no use in looking again at once.
            next_look = steps + 10 + steps / 4;
        }
        Ok(fate(End::Undecided, self.steps, last.pop().unwrap_or_default()))
    }

    fn step(&self, z: &[f64]) -> Result<Result<Vec<f64>, StopReason>, RequestError> {
        let request = MapRequest {
            coordinates: z,
            parameters: self.request.parameters,
            memory: self.request.memory,
            period: 1,
            sensitivity: Sensitivity::None,
            measures: false,
            accuracy: self.request.accuracy,
        };
        Ok(match self.map.evaluate(&request)? {
            MapOutcome::Stopped(stop) => Err(stop.reason),
            MapOutcome::Completed(map) if map.coordinates.iter().all(|v| v.is_finite()) => {
                Ok(map.coordinates.as_slice().to_vec())
            }
            MapOutcome::Completed(_) => Err(StopReason::NotFinite),
        })
    }

    /// The stable gait next to an iterate: its least period and the first of its points.
    fn settled(&self, z: &[f64], period: usize) -> Result<Option<(usize, Vec<f64>)>, RequestError> {
        let request = GaitRequest { period, measures: false, ..self.request };
        let found = find_gait(self.map, &request, z)?;
        let Some(gait) = found.gait.filter(|gait| found.status == GaitStatus::Converged && gait.spectral_radius < 1.0)
        else {
            return Ok(None);
        };
        if !near(gait.coordinates.as_slice(), z, NEXT_TO) {
            return Ok(None);
        }
        let mut points = vec![gait.coordinates.as_slice().to_vec()];
        while points.len() < period {
            match self.step(points.last().map_or(z, Vec::as_slice))? {
                // A multiple of the least period is found where convergence is by turns.
                Ok(next) if near(&points[0], &next, gaits::SAME) => break,
                Ok(next) => points.push(next),
                Err(_) => return Ok(None),
            }
        }
        Ok(Some((points.len(), canonical(points))))
    }
}

fn fate(end: End, steps: usize, coordinates: Vec<f64>) -> Fate {
    Fate { end, steps, coordinates }
}
