//! The computed motion with published means as horizontal lines.

use super::Run;
use crate::load::Loaded;
use crate::picture::Series;
use crate::published::Comparison;
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Observation, PublishedOf};
use gaitc_compiler::show::Sheet;
use gaitc_runtime::orbit::Gait;
use gaitc_runtime::return_map::{Accuracy, RequestError};
use gaitc_runtime::trajectory::{FollowRequest, Sampling, Start, Until};

/// Samples of the two steps that are drawn.
const SAMPLES: usize = 300;

/// The mean of an observation on a gait as a level, where a measure of the spec is that mean.
#[must_use]
pub fn mean(sheet: &Sheet, gait: &Gait, observation: &Observation) -> Option<(String, f64)> {
    let value = *gait.map.measures.get(mean_of(sheet, observation)?)?;
    value.is_finite().then(|| (level("mean, computed", observation, value), value))
}

/// The measure that is the mean of an observation.
fn mean_of(sheet: &Sheet, observation: &Observation) -> Option<usize> {
    let bare = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    let mean = format!("mean({})", bare(&observation.name));
    sheet.measures().position(|(_, text)| bare(text) == mean)
}

fn level(kind: &str, observation: &Observation, value: f64) -> String {
    format!("{}: {kind}, {}", observation.name, format_quantity(value, &observation.unit))
}

/// The panels of the spec's drawing of which a mean is published, over two steps of the gait at the publication's parameters, with
/// published and computed means. No panels where there is no gait or no such mean.
///
/// # Errors
/// When the model cannot be followed.
pub fn published(loaded: &Loaded, sheet: &Sheet, comparison: &Comparison<'_>) -> Result<Series, RequestError> {
    let Some(gait) = comparison.gait() else { return Ok(Series::default()) };
    let memory = loaded.memory();
    let follow = FollowRequest {
        start: Start::Section(gait.coordinates.as_slice()),
        parameters: &comparison.parameters,
        memory: &memory,
        until: Until::Crossings(2),
        sampling: Sampling::Count(SAMPLES),
        accuracy: Accuracy::default(),
    };
    let trajectory = loaded.compiled.follow(&follow)?;
    let levels = |observation: &Observation| {
        let measure = mean_of(sheet, observation);
        let number = comparison.published.numbers.iter().find(|n| measure.map(PublishedOf::Measure) == Some(n.of));
        let Some(number) = number else { return Vec::new() };
        let theirs = (level("mean, published", observation, number.value), number.value);
        std::iter::once(theirs).chain(mean(sheet, gait, observation)).collect()
    };
    let run = Run { loaded, parameters: &comparison.parameters, trajectory: &trajectory };
    let mut series = run.over_time(&format!("{}: two steps", comparison.published.name), &levels);
    series.panels.retain(|panel| !panel.levels.is_empty());
    Ok(series)
}
