//! Sweeps: the gait at every point of a set of parameters.
//!
//! At each point the gait is first looked for as it would be at this point alone: by Newton's method from the given start. Where
//! that fails, the gait of the reference parameters is followed to the point along a straight line.

use crate::orbit::{GaitOutcome, GaitRequest, GaitStatus, find_gait, follow};
use crate::return_map::{Accuracy, RequestError, ReturnMap};

/// Most Newton steps to the next gait on the way: more would say that the way is too long.
const CORRECTIONS: usize = 10;

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
        GaitRequest { period: self.period, accuracy: self.accuracy, tolerance, ..request }
    }
}

/// Finds gaits at any parameters.
pub struct Gaits<'a> {
    map: &'a dyn ReturnMap,
    reference: Reference,
    /// The gait at the reference parameters, where there is one.
    origin: Option<Vec<f64>>,
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
        let request = GaitRequest { measures: false, ..reference.request(&reference.parameters) };
        let found = find_gait(map, &request, &reference.start)?;
        let origin = found.gait.filter(|_| found.status == GaitStatus::Converged);
        Ok(Self { map, origin: origin.map(|gait| gait.coordinates.as_slice().to_vec()), reference })
    }

    /// The gait at these parameters (all of them, SI units). Where there is none, the outcome is that of the search from the start.
    ///
    /// # Errors
    /// As [`find_gait`].
    pub fn at(&self, parameters: &[f64]) -> Result<(GaitOutcome, Route), RequestError> {
        let request = self.reference.request(parameters);
        let direct = find_gait(self.map, &request, &self.reference.start)?;
        if direct.status == GaitStatus::Converged {
            return Ok((direct, Route::Start));
        }
        if let Some(section) = self.followed(parameters) {
            let outcome = find_gait(self.map, &request, &section)?;
            if outcome.status == GaitStatus::Converged {
                return Ok((outcome, Route::Followed));
            }
        }
        Ok((direct, Route::Start))
    }

    /// Section coordinates of the gait that the one of the reference parameters leads to.
    fn followed(&self, to: &[f64]) -> Option<Vec<f64>> {
        let origin = self.origin.as_deref()?;
        let gait = |parameters: &[f64], guess: &[f64]| {
            if self.reference.accuracy.interrupt.requested() {
                return Err(true);
            }
            let request =
                GaitRequest { measures: false, iteration_limit: CORRECTIONS, ..self.reference.request(parameters) };
            let found = find_gait(self.map, &request, guess).map_err(|_| true)?;
            let found = found.gait.filter(|_| found.status == GaitStatus::Converged).ok_or(false)?;
            Ok(found.coordinates.as_slice().to_vec())
        };
        let followed = follow::follow((&self.reference.parameters, origin), to, gait, |hopeless| *hopeless);
        followed.failure.is_none().then_some(followed.section)
    }
}
