//! A unit of work: a model's return map and its Jacobian at the gait, what they are, and how close a code has to come.

use crate::Failure;
use serde_json::Value;

/// A unit as the runner wrote it.
#[derive(Clone, Debug)]
pub struct Unit {
    /// `a` (prescribed length), `b` (angle-switched), `c` (crank-slider).
    pub key: String,
    parameters: Value,
    /// Section coordinates of the gait, SI units.
    pub start: Vec<f64>,
    /// Image, then Jacobian row by row, to 15 digits.
    reference: Vec<f64>,
    /// Largest error that is allowed.
    pub wanted: f64,
}

impl Unit {
    /// Reads one unit of the file of units.
    pub fn read(file: &str, key: &str) -> Result<Self, Failure> {
        let all: Value = serde_json::from_str(&std::fs::read_to_string(file)?)?;
        let unit = all.get(key).ok_or_else(|| format!("{file}: no unit `{key}`"))?;
        let list = |name: &str| -> Vec<f64> {
            unit[name].as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
        };
        Ok(Self {
            key: key.to_owned(),
            parameters: unit["parameters"].clone(),
            start: list("start"),
            reference: list("reference"),
            wanted: unit["wanted"].as_f64().ok_or_else(|| format!("{file}: no `wanted` in unit `{key}`"))?,
        })
    }

    /// A parameter's value, SI units.
    pub fn parameter(&self, name: &str) -> Result<f64, Failure> {
        self.parameters[name].as_f64().ok_or_else(|| format!("unit `{}` has no parameter `{name}`", self.key).into())
    }

    /// Largest deviation of image and Jacobian; NaN where the code gave too few numbers or NaN.
    pub fn deviation(&self, values: &[f64]) -> f64 {
        if values.len() != self.reference.len() {
            return f64::NAN;
        }
        let pairs = values.iter().zip(&self.reference);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
    }

    /// The error that counts: of the determinant in unit a, of image and Jacobian in the others.
    pub fn error(&self, values: &[f64]) -> f64 {
        match (&self.key[..], values, &self.reference[..]) {
            ("a", [_, _, j @ ..], [_, _, k @ ..]) if j.len() == 4 && k.len() == 4 => {
                (j[0] * j[3] - j[1] * j[2] - (k[0] * k[3] - k[1] * k[2])).abs()
            }
            _ => self.deviation(values),
        }
    }
}
