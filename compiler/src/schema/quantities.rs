//! `[parameters]`, `[state]` and `[memory]`.

use super::forms::{Keys, described, interval, name, named, new_name, scalar, strings, text};
use crate::front::keys;
use crate::front::read::quantities::LARGEST;
use serde_json::{Value, json};

pub(super) fn parameters() -> Value {
    let key = |key: &str| match key {
        "value" => {
            Some(scalar("Constant with its unit at the end, as in `\"2*pi*3 rad/s\"`; a bare number has no dimension."))
        }
        "range" => Some(interval("Lowest and highest sensible value, as in `[\"5 cm\", \"30 cm\"]`.")),
        "doc" => Some(text("What the parameter is.")),
        _ => None,
    };
    let table = Keys::new(keys::PARAMETER, key).required(&["value"]).table("Value, range and meaning of a parameter.");
    let item = json!({
        "description": "A parameter: `\"13 cm\"`, or a table with `value`, `range` and `doc`.",
        "anyOf": [scalar("Constant with its unit at the end."), table],
    });
    named(item, new_name(), "Parameters: numbers that can be changed without compiling the model again.")
}

pub(super) fn states() -> Value {
    let key = |key: &str| match key {
        "unit" => Some(unit("Unit of the state, `\"1\"` for a pure number.")),
        "doc" => Some(text("What the state is.")),
        "modes" => Some(strings(name("Name of a mode."), "Modes that have the state; all when left out.")),
        _ => None,
    };
    let item = Keys::new(keys::STATE, key).required(&["unit"]).table("A state: unit, meaning and modes.");
    let mut states = named(item, new_name(), "States: what flows change between transitions.");
    states["minProperties"] = 1.into();
    states
}

pub(super) fn memory() -> Value {
    let largest = json!({ "type": "integer", "minimum": -(LARGEST as i64), "maximum": LARGEST });
    let key = |key: &str| match key {
        "initial" => Some(described(largest.clone(), "Whole number with which each map begins.")),
        "doc" => Some(text("What the memory counts.")),
        _ => None,
    };
    let item = Keys::new(keys::MEMORY, key).required(&["initial"]).table("A memory: initial value and meaning.");
    named(item, new_name(), "Memory: whole numbers that only resets change.")
}

/// A unit.
pub(super) fn unit(description: &str) -> Value {
    described(json!({ "type": "string", "minLength": 1 }), description)
}
