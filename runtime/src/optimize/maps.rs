//! The maps that the nonlinear program is made of: one in every scene, stacked, counted as work.

use super::gait::patient;
use super::program::{Failure, Program};
use super::scene::{Scene, stacked};
use crate::return_map::{Accuracy, Candidate, MapOutcome, MapRequest, MapResult, Plan, Sensitivity};
use std::sync::atomic::Ordering;

impl Program<'_> {
    /// The map in every scene with the places that compete for its extrema; none of these where pieces are not asked for.
    pub(super) fn image(
        &self,
        parameters: &[f64],
        section: &[f64],
    ) -> Result<(MapResult, Vec<Vec<Candidate>>), Failure> {
        let columns: Vec<usize> = self.variables.free.iter().map(|free| free.parameter).collect();
        let sensitivity = Sensitivity::CoordinatesAndParameters(&columns);
        if !self.split {
            return Ok((self.request(parameters, section, sensitivity, true)?, Vec::new()));
        }
        let mut places = Vec::new();
        let maps = self.scenes.iter().enumerate().map(|(s, scene)| {
            let (outcome, candidates) = self.problem.map.candidates(&MapRequest {
                coordinates: &section[self.block(s)],
                parameters: &scene.parameters(parameters),
                memory: &self.problem.memory,
                period: self.problem.period,
                sensitivity,
                measures: true,
                accuracy: self.patient(),
            })?;
            places.push(candidates);
            self.completed(outcome)
        });
        let mut maps = maps.collect::<Result<Vec<MapResult>, Failure>>()?;
        let map = if maps.len() == 1 { maps.swap_remove(0) } else { stacked(&maps, self.problem.start.len()) };
        Ok((map, places))
    }

    /// One evaluation of the map in every scene, stacked; a result that is not finite is a failure.
    pub(super) fn request(
        &self,
        parameters: &[f64],
        section: &[f64],
        sensitivity: Sensitivity<'_>,
        measures: bool,
    ) -> Result<MapResult, Failure> {
        if let [scene] = self.scenes.as_slice() {
            return self.request_one(&scene.parameters(parameters), section, sensitivity, measures);
        }
        let one = |(s, scene): (usize, &Scene)| {
            self.request_one(&scene.parameters(parameters), &section[self.block(s)], sensitivity, measures)
        };
        let maps: Result<Vec<MapResult>, Failure> = self.scenes.iter().enumerate().map(one).collect();
        Ok(stacked(&maps?, self.problem.start.len()))
    }

    /// Where the coordinates of a scene stand among those of all.
    pub(super) fn block(&self, scene: usize) -> std::ops::Range<usize> {
        let d = self.problem.start.len();
        scene * d..(scene + 1) * d
    }

    fn request_one(
        &self,
        parameters: &[f64],
        section: &[f64],
        sensitivity: Sensitivity<'_>,
        measures: bool,
    ) -> Result<MapResult, Failure> {
        let outcome = self.problem.map.evaluate(&MapRequest {
            coordinates: section,
            parameters,
            memory: &self.problem.memory,
            period: self.problem.period,
            sensitivity,
            measures,
            accuracy: self.patient(),
        })?;
        self.completed(outcome)
    }

    /// The accuracy of maps near the gait that the search follows.
    fn patient(&self) -> Accuracy {
        patient(self.problem.settings.accuracy, f64::from_bits(self.followed.load(Ordering::Relaxed)))
    }

    /// What a map that was run has led to, counted as work.
    pub(super) fn completed(&self, outcome: MapOutcome) -> Result<MapResult, Failure> {
        self.worked.fetch_add(self.problem.period, Ordering::Relaxed);
        match outcome {
            MapOutcome::Stopped(stop) => Err(Failure::Stopped(stop)),
            MapOutcome::Completed(map) => {
                let finite = map.coordinates.iter().chain(map.jacobian.iter()).all(|x| x.is_finite());
                if finite { Ok(*map) } else { Err(Failure::NotFinite("the return map".to_owned())) }
            }
        }
    }

    /// The plan of the map at parameters and coordinates of a scene, if there is one for a single map.
    pub(super) fn plan(&self, parameters: &[f64], section: &[f64]) -> Result<Option<Plan>, Failure> {
        let (_, plan) = self.problem.map.plan(&MapRequest {
            coordinates: section,
            parameters,
            memory: &self.problem.memory,
            period: self.problem.period,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: self.problem.settings.accuracy,
        })?;
        Ok(plan)
    }
}
