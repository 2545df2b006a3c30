//! `[published.NAME]`.

use super::forms::{Keys, any_name, expressions, named, text};
use crate::front::keys;
use serde_json::{Value, json};

pub(super) fn published() -> Value {
    let key = |key: &str| match key {
        "doc" => Some(text("What the numbers are of.")),
        "source" => Some(text("Where they are published.")),
        "set" => Some(expressions(
            "Quantity with its unit.",
            "Parameters at which to compare, as in `{ psi = \"20 deg\" }`; the others have the values of the spec.",
        )),
        "start" => Some(expressions(
            "Quantity with its unit.",
            "First guess of coordinates of the section, where the spec's own does not lead to the gait.",
        )),
        "measures" => Some(expressions(
            "Quantity with its unit, as it was published.",
            "Published values of measures, and of `spectral_radius`.",
        )),
        "section" => Some(expressions(
            "Quantity with its unit, as it was published.",
            "Published values of the gait's coordinates on the section.",
        )),
        "spread" => Some(expressions(
            "Quantity with its unit, at least 0.",
            "By how much a published number scatters, or how exactly it is known: shown behind it, as in 20 cm/s ± 4 cm/s.",
        )),
        _ => None,
    };
    let mut item = Keys::new(keys::PUBLISHED, key)
        .required(&["source"])
        .table("Numbers from one source, to be shown beside computed ones.");
    item["anyOf"] = json!([{ "required": ["measures"] }, { "required": ["section"] }]);
    named(item, any_name(), "What others have published of the machine.")
}
