//! Observations along a trajectory.

use gaitc_compiler::front::Observations;
use gaitc_compiler::ir::{Observation, Observer, Point};
use gaitc_runtime::trajectory::{Sample, Trajectory};

/// The values of some observations at every sample of a trajectory, one column an observation, in SI units. A value that is not
/// there is NaN. `parameters` are all of the model's.
pub fn observe(
    observations: &Observations,
    chosen: &[Observation],
    parameters: &[f64],
    trajectory: &Trajectory,
) -> Vec<Vec<f64>> {
    let mut observer = observations.observer(chosen, parameters);
    let mut columns = vec![Vec::with_capacity(trajectory.samples.len()); chosen.len()];
    for sample in trajectory.samples.iter() {
        for (column, value) in columns.iter_mut().zip(at(&mut observer, trajectory, &sample)) {
            column.push(value);
        }
    }
    columns
}

/// The values of an observer at one sample.
fn at(observer: &mut Observer, trajectory: &Trajectory, sample: &Sample<'_>) -> Vec<f64> {
    let memory = trajectory.segments.get(sample.segment).map_or(&[][..], |segment| &segment.memory);
    observer.at(&Point { x: sample.state, k: sample.rate, tau: sample.tau, t: sample.t, memory })
}
