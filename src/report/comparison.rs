//! Published numbers beside computed ones.

use super::collect::Study;
use super::{Comparison, Figure, Table};
use crate::figures;
use crate::load::Loaded;
use crate::published::{self, compare};
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::PublishedNumber;
use gaitc_runtime::return_map::RequestError;

/// Every publication of the spec.
pub(super) fn all(study: &Study<'_>) -> Result<Vec<Comparison>, RequestError> {
    if study.request.is_none() {
        return Ok(Vec::new());
    }
    let publications = study.loaded.spec.published.iter();
    publications.map(|publication| one(study, &compare(study.loaded, publication)?)).collect()
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
        vec![name, published::shown(number), computed, deviation]
    };
    Table {
        caption: "Published beside computed".to_owned(),
        header: ["quantity", "published", "computed", "deviation"].map(str::to_owned).to_vec(),
        rows: comparison.published.numbers.iter().map(row).collect(),
        names: true,
    }
}

/// The motion over two steps with published numbers as levels; nothing where none of them is a value of a curve.
fn picture(study: &Study<'_>, comparison: &published::Comparison<'_>) -> Result<Option<Figure>, RequestError> {
    let series = figures::published(study.loaded, study.sheet, comparison)?;
    let caption = "Computed curves over two steps, with published and computed numbers as horizontal lines.";
    let drawn = !series.panels.is_empty();
    Ok(drawn.then(|| Figure { caption: caption.to_owned(), picture: Box::new(series) }))
}
