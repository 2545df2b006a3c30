//! `[let]`, `[functions]`, `[modes.NAME]`, `[transitions.NAME]`, `[surfaces.NAME]` and `[section]`.

use super::forms::{Keys, any_name, described, expressions, name, named, new_name, scalar, strings, text};
use crate::front::keys;
use serde_json::{Value, json};

pub(super) fn lets() -> Value {
    let item = scalar("Expression that the name stands for.");
    named(item, new_name(), "Names for expressions, visible everywhere, in any order.")
}

pub(super) fn functions() -> Value {
    let argument = {
        let mut names = new_name();
        names["type"] = "string".into();
        described(names, "Name of an argument.")
    };
    let key = |key: &str| match key {
        "args" => Some(strings(argument.clone(), "Names of the arguments, as in `[\"w\"]`.")),
        "expr" => Some(scalar("Expression of the arguments, and of everything else that has a name.")),
        "doc" => Some(text("What the function is.")),
        _ => None,
    };
    let item =
        Keys::new(keys::FUNCTION, key).required(&["args", "expr"]).table("A function: arguments and expression.");
    named(item, new_name(), "Functions that expressions can call.")
}

pub(super) fn modes() -> Value {
    let row = json!({
        "description": "Row of a state: its entries by state, or one expression, the entry of the state itself.",
        "anyOf": [
            scalar("Entry on the diagonal."),
            expressions("Entry: the factor of this state's rate.", "Entries by state; those not given are 0."),
        ],
    });
    let key = |key: &str| match key {
        "flow" => Some(expressions(
            "Time derivative of the state, or what its row of the mass matrix makes of it.",
            "Flow: an expression for each state that the mode has.",
        )),
        "mass" => Some(named(
            row.clone(),
            any_name(),
            "Rows of the mass matrix M in M(x) x' = flow; those not given are of the identity.",
        )),
        "doc" => Some(text("What the mode is.")),
        _ => None,
    };
    let item =
        Keys::new(keys::MODE, key).required(&["flow"]).table("A mode: its flow, and its mass matrix if it has one.");
    let mut modes = named(item, any_name(), "Modes: the equations of motion between transitions.");
    modes["minProperties"] = 1.into();
    modes
}

pub(super) fn transitions() -> Value {
    let key = |key: &str| match key {
        "from" => Some(name("Mode that the transition leaves.")),
        "to" => Some(name("Mode that the transition enters.")),
        "guard" => {
            Some(scalar("Expression of the state and `tau`: the transition happens when it passes through zero."))
        }
        "direction" => Some(direction()),
        "when" => Some(scalar("Condition under which the transition can happen, as in `\"v < 0 [m/s]\"`.")),
        "reset" => Some(expressions(
            "New value, from values before the transition.",
            "Each state of the target mode after the transition (`x = \"x\"` keeps it), and memory that changes.",
        )),
        "also_zero" => Some(strings(
            text("Expression that is zero when the guard is."),
            "Expressions that vanish together with the guard: `gait` reports whether they cross zero or only touch it.",
        )),
        "doc" => Some(text("What happens.")),
        _ => None,
    };
    let required = ["from", "to", "guard", "direction"];
    let item =
        Keys::new(keys::TRANSITION, key).required(&required).table("A transition: modes, guard, direction and reset.");
    named(item, any_name(), "Transitions: what ends a mode, and what the state is afterwards.")
}

pub(super) fn surfaces() -> Value {
    let key = |key: &str| match key {
        "mode" => Some(name("Mode in which the surface lies.")),
        "guard" => Some(scalar("Expression of the state: the surface is where it passes through zero.")),
        "direction" => Some(direction()),
        "doc" => Some(text("What the surface is.")),
        _ => None,
    };
    let required = ["mode", "guard", "direction"];
    let item = Keys::new(keys::SURFACE, key).required(&required).table("A surface: mode, guard and direction.");
    named(
        item,
        any_name(),
        "Surfaces inside modes: places to be noticed, where nothing changes; a section can stand on one.",
    )
}

fn direction() -> Value {
    described(
        json!({ "enum": keys::DIRECTIONS }),
        "In which the guard passes through zero: `falling` from positive to negative, `rising`, or `either`.",
    )
}

pub(super) fn section() -> Value {
    let quantities = named(
        scalar("Quantity with its unit, as in `\"0.2 m/s\"`."),
        any_name(),
        "First guess of a gait: a quantity for each coordinate.",
    );
    let key = |key: &str| match key {
        "after" => Some(name("Transition just after which the section stands.")),
        "before" => Some(name("Transition just before which the section stands.")),
        "at" => Some(name("Surface on which the section stands.")),
        "coordinates" => Some(strings(name("Name of a state."), "States that parametrise the section.")),
        "embed" => Some(expressions(
            "Value on the section, by coordinates and parameters.",
            "The states on the section that are no coordinates.",
        )),
        "start" => Some(quantities.clone()),
        "symmetry" => Some(expressions(
            "Image of the state.",
            "Symmetry that follows each map, as in `x = \"-x\"`; a state that is not mentioned is its own image.",
        )),
        "doc" => Some(text("What the section is.")),
        _ => None,
    };
    let mut section = Keys::new(keys::SECTION, key)
        .required(&["coordinates"])
        .table("The Poincare section, where each return map begins and ends.");
    let places = ["after", "before", "at"].map(|place| json!({ "required": [place] }));
    section["oneOf"] = places.as_slice().into();
    section
}
