//! Document to spec: every table read, every key checked, every expression parsed. Names are not resolved here.

mod drawing;
mod equations;
mod fields;
mod misplaced;
mod published;
pub(crate) mod quantities;
mod results;
mod uses;

use super::document::{Entry, Table, ValueKind};
use super::keys;
use super::names::{is_module_name, suggest};
use super::spec::Spec;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
pub(crate) use fields::list;
use fields::{Fields, Sink, table};

/// The version of the language.
pub(crate) const VERSION: i64 = 1;

/// Reads a whole document; `start` is the beginning of the file. Nothing is reported as missing unless `complete`.
pub(crate) fn read(document: &Table, start: Span, complete: bool, diagnostics: &mut Vec<Diagnostic>) -> Spec {
    let sink = &mut Sink { diagnostics, complete };
    let moved = misplaced::use_at_the_top(document, sink);
    let document = moved.as_ref().unwrap_or(document);
    let fields = Fields::new(document, start, "the spec".to_owned(), keys::SPEC, sink);
    version(&fields, sink);
    let name = fields.string("name", "name = \"my_model\"", sink);
    let spec = Spec {
        name,
        transitions: equations::transitions(fields.table("transitions", sink), sink),
        surfaces: equations::surfaces(fields.table("surfaces", sink), sink),
        section: fields.get("section").and_then(|entry| equations::section(entry, sink)),
        ..shared(&fields, sink)
    };
    for key in ["state", "modes"] {
        // A part may bring them; what is then still missing is seen when all parts are there.
        if fields.get(key).is_some() || fields.get("use").is_none() {
            needs(key, &fields, start, sink);
        }
    }
    check_name(&spec, sink);
    spec
}

/// Reads a document that is a part.
pub(crate) fn read_part(document: &Table, start: Span, complete: bool, diagnostics: &mut Vec<Diagnostic>) -> Spec {
    let sink = &mut Sink { diagnostics, complete };
    let moved = misplaced::use_at_the_top(document, sink);
    let document = of_parts(moved.as_ref().unwrap_or(document), sink);
    let of_specs = |key: &&str| keys::OF_SPECS_ONLY.iter().any(|(of_specs, _)| of_specs == key);
    let keys: Vec<&str> = keys::SPEC.iter().copied().filter(|key| !of_specs(key)).collect();
    let fields = Fields::new(&document, start, "the part".to_owned(), &keys, sink);
    version(&fields, sink);
    shared(&fields, sink)
}

/// A part without the keys that only a spec can have, which are reported, also where they are misspelt.
fn of_parts(document: &Table, sink: &mut Sink<'_>) -> Table {
    let mut kept = Table::default();
    for entry in &document.entries {
        let known = keys::SPEC.contains(&entry.key.as_str());
        let meant = if known { Some(entry.key.as_str()) } else { suggest(&entry.key, keys::SPEC.iter().copied()) };
        let Some((key, why)) = keys::OF_SPECS_ONLY.iter().find(|(key, _)| meant == Some(*key)) else {
            kept.entries.push(entry.clone());
            continue;
        };
        let message = match known {
            true => format!("a part cannot have `{key}`"),
            false => {
                format!("a part cannot have `{}`, nor `{key}`, if that is meant", super::parser::shortened(&entry.key))
            }
        };
        sink.push(Diagnostic::error(Code::PartTable, message).at(entry.key_span, "").help(*why));
    }
    kept
}

/// What specs and parts have in common.
fn shared(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Spec {
    too_many(fields, sink);
    let entries = |key: &str, sink: &mut Sink<'_>| fields.table(key, sink);
    Spec {
        title: fields.doc("title", sink),
        source: fields.doc("source", sink),
        uses: fields.get("use").map_or(Vec::new(), |entry| uses::uses(entry, sink)),
        parameters: quantities::parameters(entries("parameters", sink), sink),
        states: quantities::states(entries("state", sink), sink),
        memory: quantities::memory(entries("memory", sink), sink),
        lets: fields::equations(entries("let", sink), sink),
        functions: equations::functions(entries("functions", sink), sink),
        modes: equations::modes(entries("modes", sink), sink),
        measures: results::measures(entries("measures", sink), sink),
        problems: results::problems(entries("problems", sink), sink),
        drawing: fields.get("drawing").and_then(|entry| drawing::drawing(entry, sink)),
        published: published::published(entries("published", sink), sink),
        ..Spec::default()
    }
}

/// Reports a table that has to have an entry and has none.
fn needs(key: &str, fields: &Fields<'_>, start: Span, sink: &mut Sink<'_>) {
    let entry = fields.get(key);
    if entry.is_none_or(|entry| matches!(&entry.value.kind, ValueKind::Table(table) if table.entries.is_empty())) {
        let diagnostic = nothing_in(key, entry.map_or(start, |entry| entry.key_span));
        if sink.complete {
            sink.push(diagnostic);
        }
    }
}

/// The message for a spec without states or modes.
pub(crate) fn nothing_in(key: &str, place: Span) -> Diagnostic {
    let example = if key == "state" { "x = { unit = \"m\" }" } else { "x = \"...\"` below `[modes.NAME.flow]" };
    let message = format!("a spec needs at least one entry in [{key}]");
    Diagnostic::error(Code::MissingKey, message).at(place, "").help(format!("add `{example}`"))
}

/// Most states and most modes: a model with more would not fit into the sizes of generated code.
pub(crate) const STATE_LIMIT: usize = 256;
/// Most entries of any other table.
const ENTRY_LIMIT: usize = 10_000;

/// Reports tables of absurd size; nothing is lowered then.
fn too_many(fields: &Fields<'_>, sink: &mut Sink<'_>) {
    for key in keys::SPEC {
        let Some(entry) = fields.get(key) else { continue };
        let ValueKind::Table(table) = &entry.value.kind else { continue };
        let limit = if matches!(*key, "state" | "modes") { STATE_LIMIT } else { ENTRY_LIMIT };
        if table.entries.len() > limit {
            let message = format!("[{key}] has {} entries, and can have {limit}", table.entries.len());
            sink.push(Diagnostic::error(Code::TooLarge, message).at(entry.key_span, "").help("split the model"));
        }
    }
}

fn version(fields: &Fields<'_>, sink: &mut Sink<'_>) {
    let Some(entry) = fields.require("spec", "spec = 1", sink) else {
        return;
    };
    match entry.value.kind {
        ValueKind::Integer(Some(VERSION), _) => {}
        ValueKind::Integer(..) => {
            let message = "this version of the spec language is not known here";
            let diagnostic = Diagnostic::error(Code::BadValue, message).at(entry.value.span, "");
            sink.push(diagnostic.help("write `spec = 1`, or use a newer gaitc"));
        }
        _ => sink.wrong_type(&entry.value, "spec", "a whole number", "spec = 1"),
    }
}

fn check_name(spec: &Spec, sink: &mut Sink<'_>) {
    let Some(name) = spec.name.as_ref().filter(|name| !is_module_name(&name.value)) else {
        return;
    };
    let message = format!("`{}` cannot name a model", super::parser::shortened(&name.value));
    let help = "a model's name has lower-case letters, digits and `_`, begins with a letter and is no Rust keyword";
    sink.push(Diagnostic::error(Code::InvalidName, message).at(name.span, "").help(help));
}

/// The fields of a named sub-table, e.g. of `[modes.stance]`.
fn fields_of<'t>(entry: &'t Entry, kind: &str, keys: &[&str], sink: &mut Sink<'_>) -> Option<Fields<'t>> {
    let what = format!("{kind} `{}`", super::parser::shortened(&entry.key));
    Some(Fields::new(table(entry, sink)?, entry.key_span, what, keys, sink))
}
