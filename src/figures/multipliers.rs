//! The multipliers of a gait in the unit circle.

use crate::load::Loaded;
use crate::picture::{Circle, Multipliers};
use gaitc_runtime::orbit::Gait;

/// Multipliers of a gait.
#[must_use]
pub fn multipliers(loaded: &Loaded, gait: &Gait) -> Circle {
    let values = gait.multipliers.iter().map(|m| (m.re, m.im)).collect();
    let name = if gait.spectral_radius < 1.0 { "multipliers, stable" } else { "multipliers, not stable" };
    Circle {
        title: format!("{}: multipliers", loaded.spec.name),
        groups: vec![Multipliers { name: name.to_owned(), values }],
    }
}
