//! The JSON Schema accepts whatever the reader accepts, refuses what it refuses for its form, and is the committed one.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

mod reference;

use gaitc_compiler::diagnostic::Code;
use gaitc_compiler::front::{Library, parse_with};
use gaitc_compiler::schema;
use jsonschema::Validator;
use reference::blocks;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn folder(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(relative)
}

fn toml_files(relative: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder(relative)).unwrap();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(!files.is_empty(), "{relative}");
    files
}

fn validator(schema: &Value) -> Validator {
    jsonschema::draft7::meta::validate(schema).unwrap();
    jsonschema::draft7::new(schema).unwrap()
}

/// A document as JSON; `None` where the TOML is broken.
fn json(text: &str) -> Option<Value> {
    let table: toml::Table = toml::from_str(text).ok()?;
    Some(serde_json::to_value(table).unwrap())
}

/// What the schema says against a document.
fn complaints(validator: &Validator, document: &Value) -> Vec<String> {
    validator.iter_errors(document).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

fn accepts(validator: &Validator, text: &str, what: &str) {
    let complaints = complaints(validator, &json(text).unwrap());
    assert!(complaints.is_empty(), "{what}: {complaints:#?}");
}

#[test]
fn every_right_spec_is_valid() {
    let (spec, part) = (validator(&schema::spec()), validator(&schema::part()));
    for path in toml_files("../specs").into_iter().chain(toml_files("tests/golden")) {
        accepts(&spec, &std::fs::read_to_string(&path).unwrap(), &path.display().to_string());
    }
    for path in toml_files("../specs/parts") {
        accepts(&part, &std::fs::read_to_string(&path).unwrap(), &path.display().to_string());
    }
    let pages = reference::pages();
    accepts(&spec, &blocks(&pages, "```toml\n").concat(), "the language's reference");
    for text in blocks(&pages, "```toml spec\n").iter().chain(&blocks(&pages, "```toml using\n")) {
        accepts(&spec, text, "a spec of the language's reference");
    }
    blocks(&pages, "```toml part\n").iter().for_each(|text| accepts(&part, text, "a part"));
    let own = std::fs::read_to_string(folder("../docs/own_project.md")).unwrap();
    let own = blocks(&own, "```toml\nspec = 1\n");
    own.iter().for_each(|text| accepts(&spec, &format!("spec = 1\n{text}"), "the spec of a new project"));
}

/// Codes of mistakes in the form of a file, which a schema can see.
const FORM: [Code; 3] = [Code::UnknownKey, Code::WrongType, Code::PartTable];

#[test]
fn wrong_specs_are_refused_for_their_form_only() {
    let (spec, part) = (validator(&schema::spec()), validator(&schema::part()));
    let mut refused = Vec::new();
    for path in toml_files("tests/wrong") {
        let text = std::fs::read_to_string(&path).unwrap();
        let Some(document) = json(&text) else { continue };
        let name = path.file_name().unwrap().to_str().unwrap();
        let parsed = parse_with(Path::new(name), &text, Library::Folder(path.parent().unwrap()));
        // Mistakes of parts are not in this document.
        let own =
            |d: &&gaitc_compiler::diagnostic::Diagnostic| parsed.sources.path(d.labels[0].span.file) == Path::new(name);
        let own: Vec<_> = parsed.diagnostics.iter().filter(own).collect();
        let complaints = complaints(&spec, &document);
        if own.iter().any(|d| FORM.contains(&d.code)) {
            assert!(!complaints.is_empty(), "{name} is valid");
        }
        if !complaints.is_empty() {
            assert!(own.iter().any(|d| d.is_error()), "{name} is refused without reason: {complaints:#?}");
            refused.push(name.to_owned());
        }
    }
    for path in toml_files("tests/wrong/parts") {
        let text = std::fs::read_to_string(&path).unwrap();
        let Some(document) = json(&text) else { continue };
        let name = path.file_name().unwrap().to_str().unwrap();
        if name == "tables.toml" {
            assert!(!part.is_valid(&document), "{name} is valid");
        }
    }
    // What the schema is there for.
    for name in [
        "key_unknown",
        "key_missing",
        "misspelt_tables",
        "types_wrong",
        "name_reserved",
        "name_not_a_module",
        "direction_typo",
        "part_outside",
        "part_use_forms",
        "value_bad",
        "coordinate_not_string",
    ] {
        assert!(refused.contains(&format!("{name}.toml")), "{name} is valid");
    }
}

/// Each single slip in a right spec is seen.
#[test]
fn slips_are_seen() {
    let right = std::fs::read_to_string(folder("../specs/prescribed_length.toml")).unwrap();
    let validator = validator(&schema::spec());
    let right = json(&right).unwrap();
    assert!(validator.is_valid(&right));
    for (pointer, key, value) in [
        ("", "spec", Value::from(2)),
        ("", "spec", "1".into()),
        ("", "name", "Self".into()),
        ("", "name", "self".into()),
        ("", "moods", Value::Object(Default::default())),
        ("", "use", "parts/motor.toml".into()),
        ("", "use", vec!["../motor.toml"].into()),
        ("", "use", vec!["a/./motor.toml"].into()),
        ("", "use", vec!["/motor.toml"].into()),
        ("", "use", vec!["c:motor.toml"].into()),
        ("", "state", Value::Object(Default::default())),
        ("/parameters", "sin", "1 m".into()),
        ("/parameters", "a b", "1 m".into()),
        ("/parameters", "_", "1 m".into()),
        ("/parameters", "m", true.into()),
        ("/let", "x", vec!["1"].into()),
        ("/state/q_theta", "unit", 1.into()),
        ("/transitions/step", "direction", "down".into()),
        ("/transitions/step", "gaurd", "x".into()),
        ("/section", "coordinates", "q_theta".into()),
        ("/memory/n", "initial", 0.5.into()),
        ("/memory/n", "initial", "0".into()),
        ("/problems/fastest", "vary", Value::Object(Default::default())),
        ("/problems/fastest", "robust", Value::Object(Default::default())),
        ("/problems/fastest", "robust", vec!["m"].into()),
        ("/problems/fastest", "minimize", "mean_power".into()),
        ("/problems/fastest", "default", "yes".into()),
    ] {
        let mut wrong = right.clone();
        let table = wrong.pointer_mut(pointer).and_then(Value::as_object_mut).unwrap_or_else(|| panic!("no {pointer}"));
        table.insert(key.to_owned(), value.clone());
        assert!(!validator.is_valid(&wrong), "{pointer}/{key} = {value}");
    }
    for (pointer, key) in [
        ("", "spec"),
        ("", "name"),
        ("/state/q_theta", "unit"),
        ("/transitions/step", "guard"),
        ("/section", "coordinates"),
        ("/problems/fastest", "maximize"),
        ("/problems/fastest", "vary"),
    ] {
        let mut wrong = right.clone();
        let removed = wrong.pointer_mut(pointer).and_then(Value::as_object_mut).unwrap().remove(key);
        assert!(removed.is_some() && !validator.is_valid(&wrong), "{pointer}/{key}");
    }
}

#[test]
fn the_committed_schemas_are_these() {
    for (file, schema, flag) in
        [("gaitc-spec.schema.json", schema::spec(), ""), ("gaitc-part.schema.json", schema::part(), " --part")]
    {
        let text = std::fs::read_to_string(folder("../docs").join(file)).unwrap_or_default();
        let committed: Value = serde_json::from_str(&text).unwrap_or_default();
        assert!(committed == schema, "write it again: cargo run -- schema{flag} > docs/{file}");
    }
}
