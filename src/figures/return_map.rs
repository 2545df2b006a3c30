//! The return map with the orbit of a start: one coordinate after the other against its next value.

use crate::load::Loaded;
use crate::picture::{Cobweb, Return, label};
use gaitc_compiler::front::in_unit;
use gaitc_compiler::ir::State;
use gaitc_runtime::orbit::GaitRequest;
use gaitc_runtime::return_map::{MapOutcome, MapRequest, RequestError, Sensitivity};

/// Steps of the orbit that is shown.
const STEPS: usize = 40;
/// Points of the curve.
const POINTS: usize = 161;

/// What is shown of a return map.
#[derive(Clone, Copy, Debug)]
pub struct Orbit<'a> {
    /// The map: its parameters, memory, period and accuracy; where it is evaluated does not matter.
    pub map: MapRequest<'a>,
    /// Where the orbit starts: section coordinates in SI units.
    pub start: &'a [f64],
    /// The gait's section coordinates, where there is one.
    pub gait: Option<&'a [f64]>,
}

/// The map whose fixed points a request looks for.
#[must_use]
pub fn map_of<'a>(request: &GaitRequest<'a>, coordinates: &'a [f64]) -> MapRequest<'a> {
    MapRequest {
        coordinates,
        parameters: request.parameters,
        memory: request.memory,
        period: request.period,
        sensitivity: Sensitivity::None,
        measures: false,
        accuracy: request.accuracy,
    }
}

/// The orbit of a start as a cobweb for each section coordinate. With one coordinate the return map is a curve, and it is
/// drawn, too. An orbit that comes to no next step ends there.
///
/// # Errors
/// When the request does not fit the model.
pub fn return_map(loaded: &Loaded, orbit: &Orbit<'_>) -> Result<Cobweb, RequestError> {
    let mut iterates = vec![orbit.start.to_vec()];
    while iterates.len() <= STEPS
        && let Some(last) = iterates.last()
        && let Some(next) = image(loaded, orbit, last)?
    {
        iterates.push(next);
    }
    let mut maps = Vec::new();
    for (index, &state) in loaded.coordinates().iter().enumerate() {
        let state = &loaded.spec.states[state];
        let values: Vec<f64> = iterates.iter().map(|z| in_unit(z[index], &state.unit)).collect();
        let fixed: Vec<f64> = orbit.gait.iter().map(|z| in_unit(z[index], &state.unit)).collect();
        maps.push(Return {
            x: label(&state.name, &state.unit),
            y: label(&format!("next {}", state.name), &state.unit),
            curve: Vec::new(),
            iterates: values,
            fixed,
        });
    }
    if let ([only], [state]) = (&mut maps[..], loaded.coordinates()) {
        only.curve = curve(loaded, orbit, &loaded.spec.states[*state], &iterates)?;
    }
    let period = if orbit.map.period == 1 { String::new() } else { format!(" of {} maps in a row", orbit.map.period) };
    Ok(Cobweb { title: format!("{}: return map{period}", loaded.spec.name), maps })
}

/// The next value over the value, around everything that is shown.
fn curve(
    loaded: &Loaded,
    orbit: &Orbit<'_>,
    state: &State,
    iterates: &[Vec<f64>],
) -> Result<Vec<(f64, f64)>, RequestError> {
    let shown = || iterates.iter().map(|z| z[0]).chain(orbit.gait.iter().map(|z| z[0]));
    let (low, high) = (shown().fold(f64::INFINITY, f64::min), shown().fold(f64::NEG_INFINITY, f64::max));
    let size = low.abs().max(high.abs());
    // Around an orbit that stands still, too.
    let air = (0.15 * (high - low)).max(0.05 * if size > 0.0 { size } else { 1.0 });
    let mut points = Vec::with_capacity(POINTS);
    for i in 0..POINTS {
        let value = low - air + (high - low + 2.0 * air) * i as f64 / (POINTS - 1) as f64;
        let next = image(loaded, orbit, &[value])?.map_or(f64::NAN, |next| next[0]);
        points.push((in_unit(value, &state.unit), in_unit(next, &state.unit)));
    }
    Ok(points)
}

/// The next section coordinates, where there are any.
fn image(loaded: &Loaded, orbit: &Orbit<'_>, at: &[f64]) -> Result<Option<Vec<f64>>, RequestError> {
    Ok(match loaded.compiled.evaluate(&MapRequest { coordinates: at, ..orbit.map })? {
        MapOutcome::Completed(map) => Some(map.coordinates.as_slice().to_vec()),
        MapOutcome::Stopped(_) => None,
    })
}
