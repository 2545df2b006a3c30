//! `gaitc show MODEL_OR_FILE`: a model on paper. Needs neither a build nor Python.

use super::args::{Cli, Format, GraphFormat, ShowArgs};
use super::{InputError, Outcome, output};
use crate::models::MODELS;
use gaitc_compiler::diagnostic;
use gaitc_compiler::front::{self, Library, Parsed, suggest};
use gaitc_compiler::show::Sheet;
use std::path::{Path, PathBuf};

pub(super) fn run(cli: &Cli, args: &ShowArgs) -> Result<Outcome, InputError> {
    let parsed = find(&args.model, cli.specs.as_deref())?;
    let Some(sheet) = Sheet::new(&parsed) else {
        let errors: Vec<_> = parsed.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).cloned().collect();
        return Err(InputError(diagnostic::render(&errors, &parsed.sources, false)));
    };
    if cli.json {
        output::json(&sheet);
        return Ok(Outcome::Done);
    }
    output::print(&match (args.graph, args.format) {
        (Some(GraphFormat::Text), _) => sheet.graph_text(),
        (Some(GraphFormat::Dot), _) => sheet.graph_dot(),
        (None, Format::Text) => sheet.text(),
        (None, Format::Latex) => sheet.latex(),
        (None, Format::Markdown) => sheet.markdown(),
    });
    Ok(Outcome::Done)
}

/// A spec by its path, or by its name: in `specs` (else in `./specs`), else the text embedded at build time.
pub(super) fn find(model: &str, specs: Option<&Path>) -> Result<Parsed, InputError> {
    if model.ends_with(".toml") {
        return read(Path::new(model));
    }
    let folder = specs.unwrap_or(Path::new("specs"));
    let embedded = MODELS.iter().find(|entry| entry.compiled.info().name == model);
    let is_name = !model.contains(['/', '\\', ':', '.']);
    let path = folder.join(format!("{model}.toml"));
    // A link that leads nowhere is there, and is reported when it is read. A folder that was asked for has to have the
    // files of compiled models.
    if is_name && (path.symlink_metadata().is_ok() || (specs.is_some() && embedded.is_some())) {
        return read(&path);
    }
    if let Some(entry) = embedded {
        let path = PathBuf::from(format!("specs/{model}.toml"));
        return Ok(front::parse_with(&path, entry.spec, Library::Texts(entry.parts)));
    }
    let names: Vec<&str> = MODELS.iter().map(|entry| entry.compiled.info().name).collect();
    let help = match suggest(model, names.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("models: {}; or write the path of a spec, with its `.toml`", names.join(", ")),
    };
    let message = format!("no model is named `{model}`, and `{}` has no such spec\n  help: {help}", folder.display());
    Err(InputError(message))
}

fn read(path: &Path) -> Result<Parsed, InputError> {
    Ok(front::parse_file(path)?)
}
