//! Basins: where the motion from a start settles.
//!
//! The return map is iterated from each start. Where it comes back to where it was k maps ago, Newton's method looks for a gait of
//! period k there; the start belongs to that gait when the gait is stable and the iterates are next to it. Each start is followed by
//! itself, many of them side by side; which of the gaits are the same is found afterwards, in the order of the starts ([`Gaits`]).

mod gaits;

pub use gaits::Gaits;

use crate::orbit::{GaitRequest, GaitStatus, find_gait};
use crate::return_map::{
    Images, MapOutcome, MapRequest, Plan, Points, RequestError, ReturnMap, Sensitivity, StopReason,
};
use gaits::{canonical, near};

/// An iterate that comes back this close, relative to `max(1, |component|)`, may be next to a gait ...
const BACK: f64 = 1e-5;
/// ... which it is when the gait is not further away than this.
const NEXT_TO: f64 = 1e-3;

/// How motions are followed.
#[derive(Clone)]
pub struct Settings<'a> {
    /// Parameters, memory, accuracy and tolerance of the gaits; their period does not matter. The accuracy's request to stop ends
    /// the work early: what is then said of a start is of no use.
    pub request: GaitRequest<'a>,
    /// Most maps from each start.
    pub steps: usize,
    /// Longest period of a gait, in maps.
    pub periods: usize,
}

/// Follows motions.
pub struct Basin<'a> {
    map: &'a dyn ReturnMap,
    settings: Settings<'a>,
    /// Where it holds, maps are replayed side by side.
    plan: Option<Plan>,
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

/// A motion that has not ended yet.
struct Motion {
    /// Which start it belongs to.
    number: usize,
    /// The last points, up to the longest period of them.
    last: Vec<Vec<f64>>,
    /// After how many maps a gait is looked for again.
    next_look: usize,
}

impl<'a> Basin<'a> {
    /// Makes a plan at `near`, section coordinates where the motions come by.
    ///
    /// # Errors
    /// When the request is wrong.
    pub fn new(map: &'a dyn ReturnMap, settings: Settings<'a>, near: &[f64]) -> Result<Self, RequestError> {
        let basin = Self { map, settings, plan: None };
        let (_, plan) = map.plan(&basin.request(near, Sensitivity::Coordinates))?;
        Ok(Self { plan, ..basin })
    }

    /// Follows the motions from some section coordinates, SI units. Which of them are followed together changes no bit.
    ///
    /// # Errors
    /// When a start does not fit the model.
    pub fn fates(&self, starts: &[Vec<f64>]) -> Result<Vec<Fate>, RequestError> {
        let motion = |(number, start): (usize, &Vec<f64>)| Motion { number, last: vec![start.clone()], next_look: 0 };
        let mut motions: Vec<Motion> = starts.iter().enumerate().map(motion).collect();
        let undecided =
            |start: &Vec<f64>| Fate { end: End::Undecided, steps: self.settings.steps, coordinates: start.clone() };
        let mut fates: Vec<Fate> = starts.iter().map(undecided).collect();
        let mut images = Images::default();
        for steps in 1..=self.settings.steps {
            if motions.is_empty() || self.settings.request.accuracy.interrupt.requested() {
                break;
            }
            self.replay(&motions, &mut images)?;
            let mut going = Vec::with_capacity(motions.len());
            for (row, mut motion) in motions.into_iter().enumerate() {
                match self.on(&mut motion, steps, held(&images, row))? {
                    Some(fate) => fates[motion.number] = fate,
                    None => going.push(motion),
                }
            }
            motions = going;
        }
        for motion in motions {
            fates[motion.number].coordinates = motion.here().to_vec();
        }
        Ok(fates)
    }

    /// The next points of all motions, where the plan holds.
    fn replay(&self, motions: &[Motion], images: &mut Images) -> Result<(), RequestError> {
        let Some(plan) = &self.plan else { return Ok(()) };
        let coordinates: Vec<f64> = motions.iter().flat_map(|motion| motion.here().iter().copied()).collect();
        let points = Points { coordinates: &coordinates, parameters: self.settings.request.parameters };
        self.map.replay(plan, points, images)
    }

    /// Takes a motion one map on, to `image` if that is known; its fate when it ends there.
    fn on(&self, motion: &mut Motion, steps: usize, image: Option<&[f64]>) -> Result<Option<Fate>, RequestError> {
        let fate = |end, steps, coordinates| Ok(Some(Fate { end, steps, coordinates }));
        let z = match image {
            Some(image) => image.to_vec(),
            None => match self.step(motion.here())? {
                Ok(z) => z,
                Err(reason) => return fate(End::Stopped(reason), steps - 1, motion.here().to_vec()),
            },
        };
        let last = &mut motion.last;
        let back = (1..=self.settings.periods.min(last.len())).find(|k| near(&last[last.len() - k], &z, BACK));
        if let Some(period) = back.filter(|_| steps >= motion.next_look) {
            if let Some((period, coordinates)) = self.settled(&z, period)? {
                return fate(End::Gait { period }, steps, coordinates);
            }
            // It passes by an unstable gait, or creeps: no use in looking again at once.
            motion.next_look = steps + 10 + steps / 4;
        }
        if last.len() >= self.settings.periods.max(1) {
            last.remove(0);
        }
        last.push(z);
        Ok(None)
    }

    fn request<'z>(&'z self, z: &'z [f64], sensitivity: Sensitivity<'z>) -> MapRequest<'z> {
        MapRequest {
            coordinates: z,
            parameters: self.settings.request.parameters,
            memory: self.settings.request.memory,
            period: 1,
            sensitivity,
            measures: false,
            accuracy: self.settings.request.accuracy,
        }
    }

    fn step(&self, z: &[f64]) -> Result<Result<Vec<f64>, StopReason>, RequestError> {
        Ok(match self.map.evaluate(&self.request(z, Sensitivity::None))? {
            MapOutcome::Stopped(stop) => Err(stop.reason),
            MapOutcome::Completed(map) if map.coordinates.iter().all(|v| v.is_finite()) => {
                Ok(map.coordinates.as_slice().to_vec())
            }
            MapOutcome::Completed(_) => Err(StopReason::NotFinite),
        })
    }

    /// The stable gait next to an iterate: its least period and the first of its points.
    fn settled(&self, z: &[f64], period: usize) -> Result<Option<(usize, Vec<f64>)>, RequestError> {
        let request = GaitRequest { period, measures: false, ..self.settings.request };
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

impl Motion {
    /// Where it is.
    fn here(&self) -> &[f64] {
        self.last.last().map_or(&[], Vec::as_slice)
    }
}

/// The image of a point whose replay held.
fn held(images: &Images, row: usize) -> Option<&[f64]> {
    let d = images.coordinates.len().checked_div(images.held.len())?;
    let image = images.coordinates.get(row * d..(row + 1) * d)?;
    (images.held.get(row) == Some(&true) && image.iter().all(|v| v.is_finite())).then_some(image)
}
