//! `gaitc models`: the compiled models.

use super::args::Cli;
use super::{InputError, Outcome, output};
use crate::load::{Loaded, load};
use crate::models::MODELS;
use serde_json::{Value, json};

pub(super) fn run(cli: &Cli) -> Result<Outcome, InputError> {
    let specs = cli.specs.as_deref();
    let all = MODELS.iter().map(|entry| load(entry.compiled.info().name, specs)).collect::<Result<Vec<_>, _>>()?;
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
