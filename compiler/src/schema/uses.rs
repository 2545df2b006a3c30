//! The key `use`.

use super::forms::{Keys, any_name, described, expressions, name, named, strings};
use crate::front::keys;
use serde_json::{Value, json};

pub(super) fn uses() -> Value {
    let key = |key: &str| match key {
        "part" => Some(path()),
        "rename" => Some(named(
            name("New name."),
            any_name(),
            "Other names for what the part defines or takes from its user: `old = \"new\"`.",
        )),
        "set" => Some(expressions("Quantity with its unit.", "Other values for parameters of the part.")),
        "fix" => Some(expressions(
            "Expression of this spec's parameters and numbers, or a quantity.",
            "Expressions in the place of parameters of the part, which are no parameters of the model then.",
        )),
        _ => None,
    };
    let table = Keys::new(keys::USE, key).required(&["part"]).table("A part, and what changes in it.");
    let item = json!({ "description": "A part: its path, or a table that also says what changes in it.", "anyOf": [path(), table] });
    json!({
        "description": "Parts that the spec uses: a list of paths, or what each is there for, as in `motor = \"parts/motor.toml\"`.",
        "anyOf": [
            strings(path(), "Parts, taken as they are."),
            named(item, any_name(), "Parts by what they are there for."),
        ],
    })
}

/// A path below the folder of the spec.
fn path() -> Value {
    let schema = json!({
        "type": "string",
        "pattern": "^[^/:\\\\][^:\\\\]*\\.toml$",
        "not": { "pattern": "(^|/)\\.{0,2}(/|$)" },
    });
    described(schema, "Path of a part, seen from the folder of the spec, with `/`, below that folder.")
}
