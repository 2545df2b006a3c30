//! `[measures]` and `[problems.NAME]`.

use super::forms::{Keys, any_name, described, interval, named, new_name, scalar, strings, text};
use super::quantities::unit;
use crate::front::keys::{self, LONGEST_PERIOD, MOST_ROBUST};
use serde_json::{Value, json};

pub(super) fn measures() -> Value {
    let key = |key: &str| match key {
        "expr" => Some(scalar(
            "Expression of functionals of a map (`mean`, `integral`, `start`, `end`, `cycle_max`, `cycle_min`, `duration`), \
             parameters and other measures.",
        )),
        "unit" => Some(unit("Unit in which the measure is printed, `\"1\"` for a pure number.")),
        "doc" => Some(text("What is measured.")),
        _ => None,
    };
    let item =
        Keys::new(keys::MEASURE, key).required(&["expr", "unit"]).table("A measure: expression, unit and meaning.");
    named(item, new_name(), "Measures: numbers that a map has, such as a mean speed.")
}

pub(super) fn problems() -> Value {
    let mut vary = named(
        interval("Lower and upper bound, as in `[\"0 deg\", \"45 deg\"]`."),
        any_name(),
        "Parameters that the optimizer may change, each with its bounds.",
    );
    vary["minProperties"] = 1.into();
    let mut robust = named(
        interval("Lower and upper end, as in `[\"2.4 kg\", \"2.8 kg\"]`."),
        any_name(),
        "Parameters that are only known to lie in ranges: the best worst case over these is looked for.",
    );
    robust["minProperties"] = 1.into();
    robust["maxProperties"] = MOST_ROBUST.into();
    let key = |key: &str| match key {
        "doc" => Some(text("What is looked for.")),
        "default" => Some(described(
            json!({ "type": "boolean" }),
            "Whether `gaitc optimize` takes this problem when none is named.",
        )),
        "maximize" => Some(scalar("Expression of measures and parameters to make as large as possible.")),
        "minimize" => {
            Some(scalar("Expression of measures and parameters, or `spectral_radius`, to make as small as possible."))
        }
        "vary" => Some(vary.clone()),
        "robust" => Some(robust.clone()),
        "subject_to" => Some(strings(
            text("Constraint."),
            "Constraints by `<=` or `>=`, as in `[\"spectral_radius <= 0.95\", \"peak_force <= 150 N\"]`.",
        )),
        "period" => Some(described(
            json!({ "type": "integer", "minimum": 1, "maximum": LONGEST_PERIOD }),
            "How many maps make the gait: 1 unless given.",
        )),
        _ => None,
    };
    let mut item =
        Keys::new(keys::PROBLEM, key).required(&["vary"]).table("A problem: objective, parameters and constraints.");
    item["oneOf"] = json!([{ "required": ["maximize"] }, { "required": ["minimize"] }]);
    let names = any_name();
    named(item, names, "Problems for the optimizer.")
}
