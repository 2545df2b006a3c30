//! Gaits of gaitc's crank-slider climbers for the machines of `crank_slider`, values by name.

#![allow(dead_code, unreachable_pub)] // shared by several test files, none of which uses all of it
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use crate::crank_slider::machine::Machine;
use gaitc::load::Loaded;
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::Accuracy;
use std::collections::BTreeMap;

/// A gait with names.
pub struct Named {
    /// Section coordinates by name.
    pub section: BTreeMap<&'static str, f64>,
    /// Measures by name.
    pub measures: BTreeMap<&'static str, f64>,
    /// The gait.
    pub gait: Gait,
}

/// Parameter values of a model for a machine: sprawl, gear ratio, spring and, where the model has one, rotor inertia. All
/// others are those of the spec, so that these are under test as well.
pub fn parameters(model: &Loaded, machine: &Machine) -> Vec<f64> {
    let mut parameters = model.parameters();
    for (name, value) in [("psi", machine.psi), ("G", machine.gear), ("k", machine.stiffness), ("I_r", machine.rotor)] {
        match model.parameter(name) {
            Some(index) => parameters[index] = value,
            None => assert_eq!(value, 0.0, "the model has no parameter {name}"),
        }
    }
    parameters
}

/// The gait that gaitc finds from the spec's own start.
pub fn gait(model: &Loaded, machine: &Machine, accuracy: Accuracy) -> Named {
    let (parameters, memory) = (parameters(model, machine), model.memory());
    let request = GaitRequest { accuracy, ..GaitRequest::new(&parameters, &memory) };
    let outcome = find_gait(model.compiled, &request, &model.start()).unwrap();
    assert_eq!(outcome.status, GaitStatus::Converged, "{machine:?}: {}", outcome.message);
    let (info, gait) = (model.compiled.info(), outcome.gait.unwrap());
    let section = info.coordinates.iter().map(|i| info.states[*i].name).zip(gait.coordinates.iter().copied()).collect();
    let measures = info.measures.iter().map(|m| m.name).zip(gait.map.measures.iter().copied()).collect();
    Named { section, measures, gait }
}
