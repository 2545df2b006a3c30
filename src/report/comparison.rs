//! Published numbers beside computed ones: tables, and means as levels in pictures.

use super::collect::Study;
use super::{Comparison, Figure, Table};
use crate::figures::Run;
use crate::load::Loaded;
use crate::published::{self, compare};
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Observation, PublishedNumber, PublishedOf};
use gaitc_compiler::show::Sheet;
use gaitc_runtime::return_map::{Accuracy, RequestError};
use gaitc_runtime::trajectory::{FollowRequest, Sampling, Start, Until};

/// Samples of the two steps that are drawn.
const SAMPLES: usize = 300;

/// Every publication of the spec.
pub(super) fn all(study: &Study<'_>) -> Result<Vec<Comparison>, RequestError> {
    if study.request.is_none() {
        return Ok(Vec::new());
    }
    let publications = study.loaded.spec.published.iter();
    publications.map(|publication| one(study, &compare(study.loaded, publication)?)).collect()
}

/// The mean of an observation on the gait, where a measure of the spec is that mean.
pub(super) fn mean(study: &Study<'_>, observation: &Observation) -> Vec<(String, f64)> {
    let Some(gait) = study.gait() else { return Vec::new() };
    let measure = mean_of(study.sheet, observation);
    let value = measure.and_then(|i| gait.map.measures.get(i)).filter(|value| value.is_finite());
    value.map(|&value| vec![(level("mean, computed", observation, value), value)]).unwrap_or_default()
}

/// The measure that is the mean of an observation, or of its magnitude.
fn mean_of(sheet: &Sheet, observation: &Observation) -> Option<usize> {
    let bare = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<String>();
    let mean = format!("mean({})", bare(&observation.name));
    sheet.measures().position(|(_, text)| bare(text) == mean)
}

fn level(kind: &str, observation: &Observation, value: f64) -> String {
    format!("{}: {kind}, {}", observation.name, format_quantity(value, &observation.unit))
}

fn one(study: &Study<'_>, comparison: &published::Comparison<'_>) -> Result<Comparison, RequestError> {
    let (loaded, publication) = (study.loaded, comparison.published);
    let set = publication.set.iter().filter_map(|&(i, value)| {
        let p = loaded.spec.parameters.get(i)?;
        Some(format!("{} = {}", p.name, format_quantity(value, &p.unit)))
    });
    let set: Vec<String> = set.collect();
    let at = if set.is_empty() { "the spec's values".to_owned() } else { set.join(", ") };
    let mut about = vec![format!("Source: {}.", publication.source)];
    if !publication.doc.is_empty() {
        about.push(format!("What is published: {}.", publication.doc));
    }
    about.push(format!("Computed at {at}."));
    if comparison.gait().is_none() {
        about.push(format!("No gait was found there: {}.", comparison.outcome.message));
    }
    Ok(Comparison {
        name: publication.name.clone(),
        about: about.join(" "),
        table: table(loaded, comparison),
        figure: picture(study, comparison)?,
    })
}

fn table(loaded: &Loaded, comparison: &published::Comparison<'_>) -> Table {
    let row = |number: &PublishedNumber| {
        let computed =
            comparison.computed(number).map_or("–".to_owned(), |value| format_quantity(value, &number.unit));
        let deviation = comparison.deviation(number).map_or("–".to_owned(), |by| format!("{:+.2} %", 100.0 * by));
        let name = published::name(loaded, number).to_owned();
        vec![name, format_quantity(number.value, &number.unit), computed, deviation]
    };
    Table {
        caption: "Published beside computed".to_owned(),
        header: ["quantity", "published", "computed", "deviation"].map(str::to_owned).to_vec(),
        rows: comparison.published.numbers.iter().map(row).collect(),
    }
}

/// The motion over two steps with published means as levels; nothing where no mean of a curve is published.
fn picture(study: &Study<'_>, comparison: &published::Comparison<'_>) -> Result<Option<Figure>, RequestError> {
    let Some(gait) = comparison.gait() else { return Ok(None) };
    let memory = study.loaded.memory();
    let follow = FollowRequest {
        start: Start::Section(gait.coordinates.as_slice()),
        parameters: &comparison.parameters,
        memory: &memory,
        until: Until::Crossings(2),
        sampling: Sampling::Count(SAMPLES),
        accuracy: Accuracy::default(),
    };
    let trajectory = study.loaded.compiled.follow(&follow)?;
    let published = |measure: usize| {
        let numbers = &comparison.published.numbers;
        numbers.iter().find(|number| number.of == PublishedOf::Measure(measure))
    };
    let levels = |observation: &Observation| {
        let Some(number) = mean_of(study.sheet, observation).and_then(published) else { return Vec::new() };
        let computed = comparison.computed(number).map(|value| (level("mean, computed", observation, value), value));
        let theirs = (level("mean, published", observation, number.value), number.value);
        std::iter::once(theirs).chain(computed).collect()
    };
    let run = Run { loaded: study.loaded, parameters: &comparison.parameters, trajectory: &trajectory };
    let mut series = run.over_time(&format!("{}: two steps", comparison.published.name), &levels);
    series.panels.retain(|panel| !panel.levels.is_empty());
    let caption = "Computed curves over two steps, with their published and computed means as horizontal lines.";
    let drawn = !series.panels.is_empty();
    Ok(drawn.then(|| Figure { caption: caption.to_owned(), picture: Box::new(series) }))
}
