//! gaitc itself: the units, at the gaits that it finds, and its own row.

use crate::Failure;
use crate::measure::{Attempt, tolerances};
use crate::unit::Unit;
use gaitc::load::{Loaded, load};
use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, Sensitivity};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// Key, model and what is set other than in its spec (SI units).
type Named = (&'static str, &'static str, &'static [(&'static str, f64)]);

const UNITS: [Named; 3] = [
    ("a", "prescribed_length", &[("psi", 25.0 * std::f64::consts::PI / 180.0)]),
    ("b", "angle_switched", &[]),
    ("c", "self_exciting", &[]),
];

/// A model and its parameters in a unit.
fn model(key: &str) -> Result<(Loaded, Vec<f64>), Failure> {
    let (_, name, set) = UNITS.into_iter().find(|unit| unit.0 == key).ok_or_else(|| format!("no unit `{key}`"))?;
    let model = load(name, None)?;
    let mut parameters = model.parameters();
    for (name, value) in set {
        parameters[model.parameter(name).ok_or_else(|| format!("no parameter `{name}`"))?] = *value;
    }
    Ok((model, parameters))
}

/// The units: parameters, section coordinates and duration of the gait.
pub fn cases() -> Result<Value, Failure> {
    let mut all = Map::new();
    for (key, name, _) in UNITS {
        let (model, parameters) = model(key)?;
        let memory = model.memory();
        let outcome = find_gait(model.compiled, &GaitRequest::new(&parameters, &memory), &model.start())?;
        let gait = outcome.gait.ok_or_else(|| format!("`{name}` has no gait"))?;
        let names = model.compiled.info().parameters.iter().map(|parameter| parameter.name);
        let values: BTreeMap<&str, f64> = names.zip(parameters.iter().copied()).collect();
        all.insert(
            key.to_owned(),
            json!({
                "model": name, "parameters": values, "start": gait.coordinates.as_slice(),
                "duration": gait.map.duration,
            }),
        );
    }
    Ok(Value::Object(all))
}

/// gaitc's default method.
pub fn attempts(unit: &Unit) -> Result<Vec<Attempt>, Failure> {
    let key = unit.key.clone();
    let start = unit.start.clone();
    let (model, _) = model(&key)?;
    let method = if model.compiled.info().explicit { "order 8, adaptive" } else { "Radau IIA, 5 stages, adaptive" };
    Ok(vec![Attempt {
        configuration: method.to_owned(),
        settings: tolerances(),
        build: Box::new(move |relative| {
            let loaded = self::model(&key).map(|(model, parameters)| (model.memory(), model, parameters));
            let loaded = loaded.map_err(|failure| failure.to_string());
            let start = start.clone();
            Box::new(move || {
                let (memory, model, parameters) = loaded.as_ref().map_err(Clone::clone)?;
                let outcome = model.compiled.evaluate(&MapRequest {
                    coordinates: &start,
                    parameters,
                    memory,
                    period: 1,
                    sensitivity: Sensitivity::Coordinates,
                    measures: false,
                    accuracy: Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() },
                });
                match outcome.map_err(|failure| failure.to_string())? {
                    MapOutcome::Completed(map) => {
                        // nalgebra keeps columns together.
                        Ok([map.coordinates.as_slice(), map.jacobian.transpose().as_slice()].concat())
                    }
                    MapOutcome::Stopped(stop) => Err(format!("{stop:?}")),
                }
            })
        }),
    }])
}
