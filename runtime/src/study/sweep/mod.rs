//! Sweeps: the gait at every point of a set of parameters.
//!
//! At each point the gait is first looked for as it would be at this point alone: by Newton's method from the given start. Where
//! that fails, the gait of the reference parameters is followed to the point along a straight line.

use crate::orbit::{Gait, GaitOutcome, GaitRequest, GaitStatus, find_gait, follow};
use crate::return_map::{Accuracy, RequestError, ReturnMap};

/// Most Newton steps to the next gait on the way, and most maps for them: more would say that the step along the way is too long.
const CORRECTIONS: usize = 10;
const CORRECTION: usize = 12;
/// Most steps of a map on the way, relative to those of the last gait, and what they may always be.
const LONGER: usize = 10;
const SHORT: usize = 300;
/// Most maps of a search from the start. One that succeeds takes a few; one that fails might go on and on.
const SEARCH: usize = 60;
/// Most maps on the way from the reference parameters, and of the search for the gait there.
const WAY: usize = 300;

/// What is the same at all points.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The reference parameters, SI units.
    pub parameters: Vec<f64>,
    /// Initial memory.
    pub memory: Vec<f64>,
    /// First guess of the section coordinates, SI units.
    pub start: Vec<f64>,
    /// How many maps make one period; at least 1.
    pub period: usize,
    /// Accuracy of the maps. Its request to stop ends the work early: what is then said of a point is of no use.
    pub accuracy: Accuracy,
}

impl Reference {
    fn request<'a>(&'a self, parameters: &'a [f64]) -> GaitRequest<'a> {
        let request = GaitRequest::new(parameters, &self.memory);
        // A map that is integrated more coarsely is no smoother than its tolerance: nor can its fixed point be.
        let tolerance = request.tolerance.max(10.0 * self.accuracy.relative);
        let (period, accuracy) = (self.period, self.accuracy);
        GaitRequest { period, accuracy, tolerance, map_limit: SEARCH.saturating_mul(period), ..request }
    }
}

/// Finds gaits at any parameters.
pub struct Gaits<'a> {
    map: &'a dyn ReturnMap,
    reference: Reference,
    /// The gait at the reference parameters, where there is one.
    origin: Option<Vec<f64>>,
    /// How many steps its map takes.
    steps: usize,
}

/// How a gait was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// From the given start.
    Start,
    /// Followed from the gait of the reference parameters.
    Followed,
}

impl<'a> Gaits<'a> {
    /// Looks for the gait at the reference parameters. That there is none is no error.
    ///
    /// # Errors
    /// When the request is wrong, as [`find_gait`] says.
    pub fn new(map: &'a dyn ReturnMap, reference: Reference) -> Result<Self, RequestError> {
        // Much hangs on this one: it may take longer.
        let map_limit = WAY.saturating_mul(reference.period);
        let request = GaitRequest { measures: false, map_limit, ..reference.request(&reference.parameters) };
        let found = find_gait(map, &request, &reference.start)?;
        let origin = found.gait.filter(|_| found.status == GaitStatus::Converged);
        let steps = origin.as_ref().map_or(0, steps);
        Ok(Self { map, origin: origin.map(|gait| gait.coordinates.as_slice().to_vec()), steps, reference })
    }

    /// The gait at these parameters (all of them, SI units). Where there is none, the outcome is that of the search from the start,
    /// or [`GaitStatus::GaveUp`] where the way from the reference parameters was too long.
    ///
    /// # Errors
    /// As [`find_gait`].
    pub fn at(&self, parameters: &[f64]) -> Result<(GaitOutcome, Route), RequestError> {
        let request = self.reference.request(parameters);
        let mut direct = find_gait(self.map, &request, &self.reference.start)?;
        if direct.status == GaitStatus::Converged {
            return Ok((direct, Route::Start));
        }
        match self.followed(parameters) {
            Ok(section) => {
                let outcome = find_gait(self.map, &request, &section)?;
                if outcome.status == GaitStatus::Converged {
                    return Ok((outcome, Route::Followed));
                }
            }
            // A search that knows a reason of its own keeps it.
            Err(Lost::TooFar) if direct.status == GaitStatus::NotConverged => {
                direct.status = GaitStatus::GaveUp;
                direct.message = format!("following the gait from the reference parameters takes more than {WAY} maps");
            }
            Err(_) => {}
        }
        Ok((direct, Route::Start))
    }

    /// Section coordinates of the gait that the one of the reference parameters leads to.
    fn followed(&self, to: &[f64]) -> Result<Vec<f64>, Lost> {
        let origin = self.origin.as_deref().ok_or(Lost::NoWay)?;
        let (period, mut maps, mut longest) = (self.reference.period, 0, self.steps);
        let gait = |parameters: &[f64], guess: &[f64]| {
            if self.reference.accuracy.interrupt.requested() {
                return Err(Lost::NoWay);
            }
            if maps >= WAY.saturating_mul(period) {
                return Err(Lost::TooFar);
            }
            let request = self.reference.request(parameters);
            let step_limit = request.accuracy.step_limit.min(longest.saturating_mul(LONGER).max(SHORT));
            let request = GaitRequest {
                measures: false,
                iteration_limit: CORRECTIONS,
                map_limit: CORRECTION.saturating_mul(period),
                accuracy: Accuracy { step_limit, ..request.accuracy },
                ..request
            };
            let found = find_gait(self.map, &request, guess).map_err(|_| Lost::NoWay)?;
            maps += found.maps;
            let found = found.gait.filter(|_| found.status == GaitStatus::Converged).ok_or(Lost::NoGait)?;
            longest = steps(&found);
            Ok(found.coordinates.as_slice().to_vec())
        };
        let followed =
            follow::follow((&self.reference.parameters, origin), to, gait, |lost| !matches!(lost, Lost::NoGait));
        followed.failure.map_or(Ok(followed.section), Err)
    }
}

/// How many steps the map of a gait takes.
fn steps(gait: &Gait) -> usize {
    gait.map.statistics.steps + gait.map.statistics.rejected
}

/// Why a gait was not followed.
enum Lost {
    /// It is not found here, and perhaps nearer by.
    NoGait,
    /// There is nothing to follow, or no sense in it.
    NoWay,
    /// The work is more than one point may take.
    TooFar,
}
