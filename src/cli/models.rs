//! `gaitc models`: the compiled models.

use super::args::Cli;
use super::{InputError, Outcome, output};
use crate::load::{Loaded, embedded, load};
use crate::models::MODELS;
use gaitc_runtime::registry::Entry;
use serde_json::{Value, json};

pub(super) fn run(cli: &Cli) -> Result<Outcome, InputError> {
    // A spec that is wrong or was changed is listed as it was compiled, with what is wrong on stderr.
    let listed = |entry: &Entry| {
        load(entry.compiled.info().name, cli.specs.as_deref()).or_else(|problem| {
            output::error(&format!("warning: {problem}"));
            embedded(entry)
        })
    };
    let all = MODELS.iter().map(listed).collect::<Result<Vec<_>, _>>()?;
    if cli.json {
        output::json(&json!({ "models": all.iter().map(describe).collect::<Vec<_>>() }));
    } else {
        let row = |m: &Loaded| {
            let problems = m.spec.problems.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
            vec![m.spec.name.clone(), m.spec.title.clone(), problems]
        };
        output::print(&output::table(&["model", "title", "problems"], all.iter().map(row)));
    }
    Ok(Outcome::Done)
}

fn describe(model: &Loaded) -> Value {
    let spec = &model.spec;
    let names = |all: Vec<&String>| all.into_iter().cloned().collect::<Vec<_>>();
    json!({
        "model": spec.name,
        "title": spec.title,
        "source": spec.source,
        "file": model.file.as_ref().map(|path| path.display().to_string()),
        "fingerprint": model.compiled.info().fingerprint,
        "parameters": names(spec.parameters.iter().map(|p| &p.name).collect()),
        "states": names(spec.states.iter().map(|s| &s.name).collect()),
        "measures": names(spec.measures.iter().map(|m| &m.name).collect()),
        "problems": names(spec.problems.iter().map(|p| &p.name).collect()),
    })
}
