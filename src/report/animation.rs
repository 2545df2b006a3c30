//! The machine in motion: the numbers that the player draws.

use crate::motion::BodyPath;
use gaitc_compiler::ir::Joint;
use serde_json::{Value, json};

/// A run for the player.
#[derive(Clone, Debug)]
pub struct Animation {
    /// Times in s; two equal ones are both sides of a transition.
    pub t: Vec<f64>,
    /// Where body and points are at these times.
    pub path: BodyPath,
}

impl Animation {
    /// As JSON that may stand in a `script` element. Places in tenths of a millimetre or finer, `null` where a point is not there.
    pub(super) fn json(&self) -> String {
        let coordinates =
            |places: &[(f64, f64)]| -> Value { places.iter().flat_map(|p| [rounded(p.0), rounded(p.1)]).collect() };
        let joint = |joint: Joint| match joint {
            Joint::Body => -1,
            Joint::Point(point) => point as i64,
        };
        let points = self
            .path
            .points
            .iter()
            .map(|point| json!({ "name": point.name, "held": point.held, "at": coordinates(&point.at) }));
        let all = json!({
            "t": self.t.iter().map(|&t| rounded(t)).collect::<Value>(),
            "body": coordinates(&self.path.body),
            "points": points.collect::<Value>(),
            "links": self.path.links.iter().map(|link| link.map(joint)).collect::<Vec<_>>(),
        });
        // Within strings JSON may write these by number, and then they end no element.
        all.to_string().replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
    }
}

/// With five decimals; what is no number becomes `null`.
fn rounded(value: f64) -> Value {
    if value.is_finite() { json!((value * 1e5).round() / 1e5) } else { Value::Null }
}
