//! gaitc itself: the units, at the gaits that it finds, and its own row.

use crate::Failure;
use crate::measure::{Attempt, tolerances};
use crate::unit::Unit;
use gaitc::load::{Loaded, load};
use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::return_map::{Accuracy, Images, MapOutcome, MapRequest, Points, Sensitivity};
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

/// gaitc's default method, and replays of a plan that was made near the start: one at a time, and in lanes.
pub fn attempts(unit: &Unit) -> Result<Vec<Attempt>, Failure> {
    let (model, _) = model(&unit.key)?;
    if !model.compiled.info().explicit {
        return Ok(vec![adaptive(unit, "Radau IIA, 5 stages, adaptive")]);
    }
    let (one, many) = ("order 8, replay of a plan made 1e-4 away", "order 8, replay of a plan made 1e-4 away, 8 lanes");
    Ok(vec![adaptive(unit, "order 8, adaptive"), replay(unit, one, 1), replay(unit, many, MANY)])
}

fn adaptive(unit: &Unit, configuration: &str) -> Attempt {
    let (key, start) = (unit.key.clone(), unit.start.clone());
    Attempt {
        configuration: configuration.to_owned(),
        settings: tolerances(),
        units: 1,
        build: Box::new(move |relative| {
            let loaded = at(&key);
            let start = start.clone();
            Box::new(move || {
                let (memory, model, parameters) = loaded.as_ref().map_err(Clone::clone)?;
                let outcome = model.compiled.evaluate(&request(&start, parameters, memory, relative));
                match outcome.map_err(|failure| failure.to_string())? {
                    MapOutcome::Completed(map) => {
                        // nalgebra keeps columns together.
                        Ok([map.coordinates.as_slice(), map.jacobian.transpose().as_slice()].concat())
                    }
                    MapOutcome::Stopped(stop) => Err(format!("{stop:?}")),
                }
            })
        }),
    }
}

/// Points of a batch.
const MANY: usize = 64;
/// How far from the start plans are made, relative to the coordinates, and how far the points of a batch are apart.
const AWAY: f64 = 1e-4;

fn replay(unit: &Unit, configuration: &str, units: usize) -> Attempt {
    let (key, start) = (unit.key.clone(), unit.start.clone());
    Attempt {
        configuration: configuration.to_owned(),
        settings: tolerances(),
        units,
        build: Box::new(move |relative| {
            let loaded = at(&key).and_then(|(memory, model, parameters)| {
                let near: Vec<f64> = start.iter().map(|z| z * (1.0 + AWAY)).collect();
                let planned = model.compiled.plan(&request(&near, &parameters, &memory, relative));
                let plan = planned.map_err(|failure| failure.to_string())?.1.ok_or("no plan")?;
                Ok((model, parameters, plan))
            });
            // The unit itself comes first; the others have parameters and starts of their own.
            let off = |i: usize| 1.0 + AWAY / MANY as f64 * i as f64;
            let z: Vec<f64> = (0..units).flat_map(|i| start.iter().map(move |z| z * off(i))).collect();
            let parameters = loaded.as_ref().map_or(&[][..], |(_, parameters, _)| parameters);
            let p: Vec<f64> = (0..units).flat_map(|i| parameters.iter().map(move |p| p * off(i))).collect();
            let (mut images, d) = (Images::default(), start.len());
            Box::new(move || {
                let (model, _, plan) = loaded.as_ref().map_err(Clone::clone)?;
                let points = Points { coordinates: &z, parameters: &p };
                model.compiled.replay(plan, points, &mut images).map_err(|failure| failure.to_string())?;
                if !images.held.iter().all(|held| *held) {
                    return Err("the plan does not hold".to_owned());
                }
                Ok([&images.coordinates[..d], images.jacobian(0, d).transpose().as_slice()].concat())
            })
        }),
    }
}

fn at(key: &str) -> Result<(Vec<f64>, Loaded, Vec<f64>), String> {
    let (model, parameters) = model(key).map_err(|failure| failure.to_string())?;
    Ok((model.memory(), model, parameters))
}

fn request<'a>(start: &'a [f64], parameters: &'a [f64], memory: &'a [f64], relative: f64) -> MapRequest<'a> {
    MapRequest {
        coordinates: start,
        parameters,
        memory,
        period: 1,
        sensitivity: Sensitivity::Coordinates,
        measures: false,
        accuracy: Accuracy { relative, absolute: 0.1 * relative, ..Accuracy::default() },
    }
}
