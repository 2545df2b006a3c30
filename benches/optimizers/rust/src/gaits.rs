//! The gait at given parameters: from the spec's first guess, else followed in equal strides from the gait at the spec's own values.

use gaitc_runtime::optimize::Problem;
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::RequestError;

/// Into how many strides the way is cut, one after the other until one leads there.
const STRIDES: [u32; 4] = [1, 4, 16, 64];

/// Section coordinates and duration of the gait; `None` where none is found.
pub(crate) fn gait(problem: &Problem<'_>, parameters: &[f64]) -> Result<Option<(Vec<f64>, f64)>, RequestError> {
    if let Some(gait) = near(problem, parameters, &problem.start)? {
        return Ok(Some(gait));
    }
    let Some((first, _)) = near(problem, &problem.parameters, &problem.start)? else { return Ok(None) };
    for strides in STRIDES {
        let mut last = Some((first.clone(), 0.0));
        for stride in 1..=strides {
            let part = f64::from(stride) / f64::from(strides);
            let between = problem.parameters.iter().zip(parameters).map(|(a, b)| a + part * (b - a));
            let Some((guess, _)) = &last else { break };
            last = near(problem, &between.collect::<Vec<_>>(), guess)?;
        }
        if last.is_some() {
            return Ok(last);
        }
    }
    Ok(None)
}

fn near(problem: &Problem<'_>, parameters: &[f64], guess: &[f64]) -> Result<Option<(Vec<f64>, f64)>, RequestError> {
    let accuracy = problem.settings.accuracy;
    let tolerance = f64::max(1e-10, 10.0 * accuracy.relative);
    let request = GaitRequest { accuracy, tolerance, ..GaitRequest::new(parameters, &problem.memory) };
    let outcome = find_gait(problem.map, &request, guess)?;
    let gait = outcome.gait.filter(|_| outcome.status == GaitStatus::Converged);
    Ok(gait.map(|gait| (gait.coordinates.as_slice().to_vec(), gait.map.duration)))
}
