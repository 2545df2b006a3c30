//! Observations along a trajectory.

use gaitc_compiler::front::Observations;
use gaitc_compiler::ir::{Observation, Observer, Point};
use gaitc_runtime::trajectory::{Sample, Trajectory};

/// How far before and after a switch its two sides are, as a part of the run's time.
const ASIDE: f64 = 1e-10;

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
    for (i, sample) in trajectory.samples.iter().enumerate() {
        let aside = aside(trajectory, i) * ASIDE * trajectory.time;
        for (column, value) in columns.iter_mut().zip(at(&mut observer, trajectory, &sample, aside)) {
            column.push(value);
        }
    }
    columns
}

/// On which side of a switch inside a segment a sample stands, where there are two at its time: -1 before it, 1 behind it.
fn aside(trajectory: &Trajectory, i: usize) -> f64 {
    let samples = &trajectory.samples;
    let place = |i: usize| samples.t.get(i).zip(samples.segment.get(i));
    match place(i) {
        Some(here) if place(i + 1) == Some(here) => -1.0,
        Some(here) if i > 0 && place(i - 1) == Some(here) => 1.0,
        _ => 0.0,
    }
}

/// The values of an observer at one sample, or so long (s) before or after it: on a switch conditions have no side.
fn at(observer: &mut Observer, trajectory: &Trajectory, sample: &Sample<'_>, aside: f64) -> Vec<f64> {
    let memory = trajectory.segments.get(sample.segment).map_or(&[][..], |segment| &segment.memory);
    let here = Point { x: sample.state, k: sample.rate, tau: sample.tau, t: sample.t, memory };
    if aside == 0.0 || sample.rate.iter().any(|rate| !rate.is_finite()) {
        return observer.at(&here);
    }
    let x: Vec<f64> = sample.state.iter().zip(sample.rate).map(|(x, rate)| x + aside * rate).collect();
    observer.at(&Point { x: &x, tau: here.tau + aside, t: here.t + aside, ..here })
}
