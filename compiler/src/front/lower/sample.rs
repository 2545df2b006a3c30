//! Points at which a model is evaluated to check what its equations promise of each other.

use crate::ir::eval::{Environment, value};
use crate::ir::{Model, Section};

/// How many points are looked at.
pub(super) const POINTS: u32 = 8;

/// The values of all parameters.
pub(super) fn parameters(model: &Model) -> Vec<f64> {
    model.parameters.iter().map(|parameter| parameter.value).collect()
}

/// Point number `n` on the section, around its start: all states, as the embedding makes them.
pub(super) fn on_section(model: &Model, section: &Section, n: u32) -> Vec<f64> {
    let mut states = vec![0.0; model.states.len()];
    for (i, (&state, start)) in section.coordinates.iter().zip(&section.start).enumerate() {
        if let Some(slot) = states.get_mut(state) {
            *slot = near(*start, n, i);
        }
    }
    let parameters = parameters(model);
    let at = Environment { states: &states, parameters: &parameters, ..Environment::default() };
    section.embed.iter().map(|&equation| value(&model.graph, equation, &at)).collect()
}

/// Point number `n` around the section, not on it.
pub(super) fn around_section(model: &Model, section: &Section, n: u32) -> Vec<f64> {
    let mut states = on_section(model, section, n);
    for (i, state) in states.iter_mut().enumerate() {
        *state = near(*state, n, i);
    }
    states
}

/// A number near another one.
fn near(value: f64, n: u32, i: usize) -> f64 {
    value + (0.1 + 0.3 * value.abs()) * spread(n, i)
}

/// Numbers from -1 to 1 that are spread evenly and follow no pattern of the model.
pub(super) fn spread(n: u32, i: usize) -> f64 {
    // Multiples of the roots of primes, as Richtmyer's sequence takes them.
    const ROOTS: [f64; 4] =
        [std::f64::consts::SQRT_2, 1.732_050_807_568_877_2, 2.236_067_977_499_79, 2.645_751_311_064_590_7];
    let root = ROOTS[i % ROOTS.len()] * (1 + i / ROOTS.len()) as f64;
    2.0 * ((f64::from(n) + 0.5) * root).fract() - 1.0
}
