//! Published numbers beside computed ones: for each publication of a spec the gait at its parameters, and what the model
//! gives for each of its numbers.

use crate::load::Loaded;
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Published, PublishedNumber, PublishedOf};
use gaitc_runtime::orbit::{Gait, GaitOutcome, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::RequestError;

/// A publication and what is computed for it.
pub struct Comparison<'a> {
    /// What is published.
    pub published: &'a Published,
    /// All parameters at which the gait was computed, SI units.
    pub parameters: Vec<f64>,
    /// What came of the search for the gait.
    pub outcome: GaitOutcome,
}

/// Computes the gait at the parameters of a publication, from its first guess.
///
/// # Errors
/// When the model has no section, so that there are no gaits.
pub fn compare<'a>(loaded: &Loaded, published: &'a Published) -> Result<Comparison<'a>, RequestError> {
    let (mut parameters, mut guess, memory) = (loaded.parameters(), loaded.start(), loaded.memory());
    for &(i, value) in &published.set {
        if let Some(slot) = parameters.get_mut(i) {
            *slot = value;
        }
    }
    // What is published of the gait itself is a guess as well.
    let coordinates = published.numbers.iter().filter_map(|number| match number.of {
        PublishedOf::Coordinate(i) => Some((i, number.value)),
        PublishedOf::Measure(_) | PublishedOf::SpectralRadius => None,
    });
    for (i, value) in coordinates.chain(published.start.iter().copied()) {
        if let Some(slot) = guess.get_mut(i) {
            *slot = value;
        }
    }
    let outcome = find_gait(loaded.compiled, &GaitRequest::new(&parameters, &memory), &guess)?;
    Ok(Comparison { published, parameters, outcome })
}

impl Comparison<'_> {
    /// The gait, where there is one.
    pub fn gait(&self) -> Option<&Gait> {
        self.outcome.gait.as_ref().filter(|_| self.outcome.status == GaitStatus::Converged)
    }

    /// What the model gives for a published number, SI units; `None` without a gait, or where it is no number.
    pub fn computed(&self, number: &PublishedNumber) -> Option<f64> {
        let gait = self.gait()?;
        let value = match number.of {
            PublishedOf::Measure(i) => *gait.map.measures.get(i)?,
            PublishedOf::SpectralRadius => gait.spectral_radius,
            PublishedOf::Coordinate(i) => *gait.coordinates.get(i)?,
        };
        value.is_finite().then_some(value)
    }

    /// By how much the computed value differs from the published one, relative to the latter; `None` where one of the two is
    /// missing or the published one is zero.
    pub fn deviation(&self, number: &PublishedNumber) -> Option<f64> {
        let computed = self.computed(number).filter(|_| number.value != 0.0)?;
        Some((computed - number.value) / number.value.abs())
    }
}

/// A published number in its own unit, with its spread.
pub fn shown(number: &PublishedNumber) -> String {
    let value = format_quantity(number.value, &number.unit);
    number.spread.map_or(value.clone(), |spread| format!("{value} ± {}", format_quantity(spread, &number.unit)))
}

/// What a number is of, as the spec calls it.
pub fn name<'a>(loaded: &'a Loaded, number: &PublishedNumber) -> &'a str {
    let spec = &loaded.spec;
    match number.of {
        PublishedOf::Measure(i) => spec.measures.get(i).map_or("?", |measure| &measure.name),
        PublishedOf::SpectralRadius => "spectral_radius",
        PublishedOf::Coordinate(i) => {
            let state = loaded.coordinates().get(i).and_then(|&state| spec.states.get(state));
            state.map_or("?", |state| &state.name)
        }
    }
}
