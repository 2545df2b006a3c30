//! A run as pictures: curves over time, and the path of the body.

use super::report::Report;
use crate::figures;
use crate::motion::BodyPath;
use crate::picture::{Panel, Path, Series};
use gaitc_compiler::ir::{Observation, State};

impl Report<'_> {
    /// Curves over time: of what was asked for (`chosen`), else of what the spec's drawing names, else of the states.
    pub(super) fn series(&self, chosen: bool) -> Series {
        let drawn = self.loaded.observations.drawing().is_some_and(|drawing| !drawing.panels.is_empty());
        match (chosen, drawn) {
            (false, true) => self.run().over_time(&self.title(), &|_| Vec::new()),
            (true, _) => self.by_unit(self.observed.iter().cloned().zip(self.values.iter().cloned())),
            (false, false) => self.by_unit(self.state_values()),
        }
    }

    /// The path of the body, with links and points that are held.
    pub(super) fn plane(&self, path: &BodyPath) -> Path {
        self.run().path(&self.title(), path)
    }

    fn run(&self) -> figures::Run<'_> {
        figures::Run { loaded: self.loaded, parameters: self.parameters, trajectory: self.trajectory }
    }

    fn title(&self) -> String {
        let spec = &self.loaded.spec;
        if spec.title.is_empty() { spec.name.clone() } else { spec.title.clone() }
    }

    /// One panel a unit, in the order of their first curves.
    fn by_unit(&self, all: impl IntoIterator<Item = (Observation, Vec<f64>)>) -> Series {
        let mut groups: Vec<(Vec<Observation>, Vec<Vec<f64>>)> = Vec::new();
        for (observation, values) in all {
            let group = groups.iter().position(|(o, _)| o.first().is_some_and(|o| o.unit == observation.unit));
            match group.and_then(|i| groups.get_mut(i)) {
                Some((observations, columns)) => {
                    observations.push(observation);
                    columns.push(values);
                }
                None => groups.push((vec![observation], vec![values])),
            }
        }
        let panel = |(observations, values): &(Vec<Observation>, Vec<Vec<f64>>)| -> Panel {
            self.run().panel(observations, values, &|_| Vec::new())
        };
        self.run().series(&self.title(), groups.iter().map(panel).collect())
    }

    /// The states as something observed.
    fn state_values(&self) -> Vec<(Observation, Vec<f64>)> {
        let (states, samples) = (self.states(), &self.trajectory.samples);
        let mut observations = self.loaded.observations.clone();
        let observed = |(i, state): (usize, &State)| {
            let values = samples.states.iter().skip(i).step_by(states.len()).copied().collect();
            // The name of a state is an expression that is always right.
            observations.observe(&state.name).ok().map(|observation| (observation, values))
        };
        states.iter().enumerate().filter_map(observed).collect()
    }
}
