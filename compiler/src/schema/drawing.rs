//! `[drawing]`.

use super::forms::{Keys, any_name, described, name, named, scalar, strings, text};
use crate::front::keys;
use serde_json::{Value, json};

pub(super) fn drawing() -> Value {
    let key = |key: &str| match key {
        "velocity" => Some(pair(
            "Velocity of the body, m/s: to the right, and up. The body's path is its time integral.",
            "Expression of dimension m/s.",
        )),
        "points" => Some(named(point(), any_name(), "Other points to draw, by name; `body` is always there.")),
        "links" => Some(strings(
            two(name("Name of a point, or `body`."), "Two points that a line joins."),
            "Lines between points, as in `[[\"body\", \"foot\"]]`.",
        )),
        "panels" => {
            let mut panel = strings(text("Expression of the motion."), "Curves of one dimension that share a panel.");
            panel["minItems"] = 1.into();
            Some(strings(panel, "What is worth plotting over time, as in `[[\"v_x\", \"v_y\"], [\"force\"]]`."))
        }
        _ => None,
    };
    let description = "How to draw the machine in the plane, and what of it is worth plotting.";
    let mut drawing = Keys::new(keys::DRAWING, key).table(description);
    drawing["dependencies"] = json!({ "points": ["velocity"], "links": ["velocity"] });
    drawing
}

fn point() -> Value {
    let key = |key: &str| match key {
        "at" => Some(pair(
            "Where the point is, seen from the body, m: to the right, and up, in directions of the world.",
            "Expression of dimension m.",
        )),
        "modes" => Some(strings(name("Name of a mode."), "Modes in which the point is there; all when left out.")),
        "held" => Some(described(
            json!({ "type": "boolean" }),
            "Whether the point stands still in the world from one transition to the next.",
        )),
        "doc" => Some(text("What the point is.")),
        _ => None,
    };
    Keys::new(keys::DRAWN_POINT, key).required(&["at"]).table("A point: where it is, and when.")
}

fn pair(description: &str, item: &str) -> Value {
    two(scalar(item), description)
}

fn two(item: Value, description: &str) -> Value {
    described(json!({ "type": "array", "items": item, "minItems": 2, "maxItems": 2 }), description)
}
