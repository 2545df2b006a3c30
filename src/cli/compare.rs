//! `gaitc compare [MODEL]`: what others have published, beside what is computed.

use super::args::Cli;
use super::{InputError, Outcome, inputs, output, plots, provenance, show};
use crate::figures;
use crate::load::{Loaded, load};
use crate::models::MODELS;
use crate::picture::{Series, label};
use crate::provenance::Provenance;
use crate::published::{self, Comparison, compare, name};
use clap::Args;
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::PublishedNumber;
use gaitc_compiler::show::Sheet;
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// Which model.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc compare\n  gaitc compare self_exciting --json\n  gaitc compare self_exciting --plot speeds.svg"
)]
pub(crate) struct CompareArgs {
    /// Name of a compiled model; all that have published numbers without it
    #[arg(value_name = "MODEL")]
    pub(crate) model: Option<String>,
    /// Draw the computed curves with published and computed numbers as horizontal lines, as SVG or PNG
    #[arg(long, value_name = "FILE", requires = "model")]
    plot: Option<PathBuf>,
}

pub(super) fn run(cli: &Cli, args: &CompareArgs) -> Result<Outcome, InputError> {
    if let Some(path) = &args.plot {
        plots::check("--plot", path)?;
    }
    let loaded = models(cli, args)?;
    let (mut texts, mut all, mut outcome) = (Vec::new(), Vec::new(), Outcome::Done);
    for model in &loaded {
        for published in &model.spec.published {
            let comparison = compare(model, published)?;
            if comparison.gait().is_none() {
                outcome = Outcome::Without;
            }
            match cli.json {
                true => all.push(object(model, &comparison)),
                false => texts.push(text(model, &comparison)),
            }
        }
    }
    if cli.json {
        // Several models have several fingerprints: each stands in the results of its model alone.
        let made = match &loaded[..] {
            [model] => provenance::of(&cli.run, model, &model.parameters()),
            _ => Provenance { run: cli.run.clone(), ..Provenance::default() },
        };
        output::result(&made, json!({ "comparisons": all }));
    } else {
        output::print(&texts.join("\n"));
    }
    if let (Some(path), [model]) = (&args.plot, &loaded[..]) {
        let provenance = provenance::of(&cli.run, model, &model.parameters());
        let picture = picture(cli, model)?;
        if picture.panels.is_empty() {
            let why = "none of the published numbers is a value of a curve (the mean, the largest, the least, ... of something)";
            output::warning(&format!("--plot {}: not drawn, since {why}", path.display()));
        } else {
            plots::save("--plot", path, &picture, &provenance);
        }
    }
    Ok(outcome)
}

/// The panels of all publications of a model, each with the name of its publication.
fn picture(cli: &Cli, model: &Loaded) -> Result<Series, InputError> {
    let parsed = show::find(&model.spec.name, cli.specs.as_deref())?;
    let title = format!("{}: computed motion, published numbers", model.spec.name);
    let mut all = Series { title, x: label("time", "s"), ..Series::default() };
    let Some(sheet) = Sheet::new(&parsed) else { return Ok(all) };
    for published in &model.spec.published {
        let mut series = figures::published(model, &sheet, &compare(model, published)?)?;
        for panel in &mut series.panels {
            let mine = panel.levels.iter_mut().filter(|level| !level.name.is_empty());
            mine.for_each(|level| level.name = format!("{}, {}", published.name, level.name));
        }
        all.panels.append(&mut series.panels);
    }
    Ok(all)
}

/// The models to compare: each has published numbers.
fn models(cli: &Cli, args: &CompareArgs) -> Result<Vec<Loaded>, InputError> {
    let specs = cli.specs.as_deref();
    if let Some(model) = &args.model {
        let loaded = load(model, specs)?;
        if loaded.spec.published.is_empty() {
            let message = format!("the spec of `{model}` has no published numbers to compare with");
            let help = "add them as [published.NAME], with `source` and `measures`";
            return Err(InputError(format!("{message}\n  help: {help}")));
        }
        return Ok(vec![loaded]);
    }
    let mut all = Vec::new();
    for entry in MODELS {
        let name = entry.compiled.info().name;
        // A folder that was asked for need not have every model.
        if specs.is_none_or(|folder| folder.join(format!("{name}.toml")).exists()) {
            all.push(load(name, specs)?);
        }
    }
    all.retain(|model| !model.spec.published.is_empty());
    match all.is_empty() {
        false => Ok(all),
        true => {
            let message = "no model has published numbers to compare with";
            Err(InputError(format!("{message}\n  help: add them to a spec as [published.NAME]")))
        }
    }
}

/// The parameters that a publication sets, with their values.
fn set<'a>(model: &'a Loaded, comparison: &'a Comparison<'_>) -> impl Iterator<Item = (&'a str, &'a str, f64)> {
    let parameters = &model.spec.parameters;
    let set = comparison.published.set.iter();
    set.filter_map(|&(i, value)| parameters.get(i).map(|p| (p.name.as_str(), p.unit.as_str(), value)))
}

fn text(model: &Loaded, comparison: &Comparison<'_>) -> String {
    let published = comparison.published;
    let doc = if published.doc.is_empty() { String::new() } else { format!(": {}", published.doc) };
    let mut text = format!("{} · {}{doc}\nsource: {}\n", model.spec.name, published.name, published.source);
    let set: Vec<String> = set(model, comparison)
        .map(|(name, unit, value)| format!("{name} = {}", format_quantity(value, unit)))
        .collect();
    if !set.is_empty() {
        text += &format!("at {}\n", set.join(", "));
    }
    for warning in inputs::outside_range(model, &comparison.parameters) {
        text += &format!("warning: {warning}\n");
    }
    if comparison.gait().is_none() {
        let outcome = &comparison.outcome;
        text += &format!("{}: {}\n", outcome.status.name(), outcome.message);
    }
    let row = |number: &PublishedNumber| {
        let computed = comparison.computed(number);
        let computed = computed.map_or("-".to_owned(), |value| format_quantity(value, &number.unit));
        let deviation = comparison.deviation(number).map_or("-".to_owned(), percent);
        vec![name(model, number).to_owned(), published::shown(number), computed, deviation]
    };
    let rows = published.numbers.iter().map(row);
    text + "\n" + &output::table(&["quantity", "published", "computed", "deviation"], rows)
}

/// A relative deviation for people.
fn percent(deviation: f64) -> String {
    let percent = 100.0 * deviation;
    if percent.abs() >= 0.1 { format!("{percent:+.1} %") } else { format!("{percent:+.1e} %") }
}

fn object(model: &Loaded, comparison: &Comparison<'_>) -> Value {
    let published = comparison.published;
    let set: Map<String, Value> =
        set(model, comparison).map(|(name, _, value)| (name.to_owned(), json!(value))).collect();
    let number = |number: &PublishedNumber| {
        json!({
            "name": name(model, number),
            "published": number.value,
            "spread": number.spread,
            "computed": comparison.computed(number),
            "deviation": comparison.deviation(number),
        })
    };
    json!({
        "model": model.spec.name,
        "name": published.name,
        "doc": published.doc,
        "source": published.source,
        "set": set,
        "status": comparison.outcome.status.name(),
        "message": comparison.outcome.message,
        "warnings": inputs::outside_range(model, &comparison.parameters),
        "numbers": published.numbers.iter().map(number).collect::<Vec<_>>(),
    })
}
