//! Many maps near one gait, one after the other: replays of its plan where there is one and where it holds, full runs
//! without derivatives elsewhere.

use super::problem::Problem;
use crate::return_map::{Accuracy, Images, MapOutcome, MapRequest, Plan, Points, RequestError, Sensitivity};
use nalgebra::DVector;

/// Makes maps at the parameters of a gait.
pub(super) struct Stepper<'c> {
    problem: &'c Problem<'c>,
    parameters: &'c [f64],
    section: DVector<f64>,
    /// Where the map of the gait itself leads: the section again, but for what two accuracies differ by.
    image: DVector<f64>,
    accuracy: Accuracy,
    plan: Option<Plan>,
    images: Images,
}

impl<'c> Stepper<'c> {
    /// At a gait.
    ///
    /// # Errors
    /// When the request does not fit the model, in words.
    pub(super) fn new(
        problem: &'c Problem<'c>,
        (parameters, section): (&'c [f64], &[f64]),
        accuracy: Accuracy,
    ) -> Result<Self, String> {
        let section = DVector::from_column_slice(section);
        let (image, images) = (section.clone(), Images::default());
        let mut stepper = Self { problem, parameters, section, image, accuracy, plan: None, images };
        let (_, plan) = problem.map.plan(&stepper.request(stepper.section.as_slice())).map_err(words)?;
        stepper.plan = plan;
        stepper.image = stepper.map(&stepper.section.clone())?;
        Ok(stepper)
    }

    fn request<'r>(&'r self, section: &'r [f64]) -> MapRequest<'r> {
        MapRequest {
            coordinates: section,
            parameters: self.parameters,
            memory: &self.problem.memory,
            period: self.problem.period,
            sensitivity: Sensitivity::None,
            measures: false,
            accuracy: self.accuracy,
        }
    }

    /// Where the map leads from a point.
    ///
    /// # Errors
    /// When it leads nowhere, in words.
    pub(super) fn map(&mut self, section: &DVector<f64>) -> Result<DVector<f64>, String> {
        if let Some(plan) = &self.plan {
            let points = Points { coordinates: section.as_slice(), parameters: self.parameters };
            self.problem.map.replay(plan, points, &mut self.images).map_err(words)?;
            if self.images.held.first() == Some(&true) {
                return Ok(DVector::from_column_slice(&self.images.coordinates));
            }
        }
        match self.problem.map.evaluate(&self.request(section.as_slice())).map_err(words)? {
            MapOutcome::Completed(map) => Ok(map.coordinates),
            MapOutcome::Stopped(stop) => {
                Err(format!("a run from next to the gait does not complete: {}", super::message::stop_text(&stop)))
            }
        }
    }

    /// The deviation from the gait after a map, from that before it, both in units of the coordinates' sizes.
    ///
    /// # Errors
    /// As [`Self::map`].
    pub(super) fn deviation(&mut self, deviation: &DVector<f64>, sizes: &DVector<f64>) -> Result<DVector<f64>, String> {
        let start = &self.section + deviation.component_mul(sizes);
        Ok((self.map(&start)? - &self.image).component_div(sizes))
    }
}

fn words(error: RequestError) -> String {
    error.to_string()
}
