//! The JSON Schema of the spec language (draft 7, which editors know): what an editor completes, explains and underlines
//! while a spec is written.
//!
//! It knows tables, keys, types, names and what is required. Whether an expression can be read, a name is defined and
//! dimensions fit is said by `gaitc check`. Keys come from the reader's own lists, so that the two cannot drift apart.

mod drawing;
mod equations;
mod forms;
mod published;
mod quantities;
mod results;
mod uses;

use crate::front::keys;
use crate::front::read::VERSION;
use forms::{Keys, described, text};
use serde_json::{Value, json};

/// The schema of a spec.
pub fn spec() -> Value {
    let mut schema = document(keys::SPEC.to_vec(), "A gaitc spec", &["spec", "name"]);
    schema["description"] = "A hybrid model: flow, guards, resets, a section, measures and problems.".into();
    // A part may bring states and modes.
    schema["anyOf"] = json!([{ "required": ["state", "modes"] }, { "required": ["use"] }]);
    schema
}

/// The schema of a part.
pub fn part() -> Value {
    let shared = |key: &&str| !keys::OF_SPECS_ONLY.iter().any(|(only, _)| only == key);
    let mut schema = document(keys::SPEC.iter().copied().filter(shared).collect(), "A part of gaitc specs", &["spec"]);
    schema["description"] = "Definitions that several specs share by `use`: an actuator, a controller, a foot.".into();
    schema
}

fn document(keys: Vec<&'static str>, title: &str, required: &[&str]) -> Value {
    let mut schema = Keys::new(&keys, key).required(required).table(title);
    schema["$schema"] = "http://json-schema.org/draft-07/schema#".into();
    schema["title"] = title.into();
    schema
}

/// What a key of a spec holds.
fn key(key: &str) -> Option<Value> {
    Some(match key {
        "spec" => described(json!({ "const": VERSION }), "Version of the language."),
        "name" => forms::model_name(),
        "title" => text("The model in a few words."),
        "source" => text("Where the equations come from."),
        "use" => uses::uses(),
        "parameters" => quantities::parameters(),
        "state" => quantities::states(),
        "memory" => quantities::memory(),
        "let" => equations::lets(),
        "functions" => equations::functions(),
        "modes" => equations::modes(),
        "transitions" => equations::transitions(),
        "surfaces" => equations::surfaces(),
        "section" => equations::section(),
        "measures" => results::measures(),
        "problems" => results::problems(),
        "drawing" => drawing::drawing(),
        "published" => published::published(),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)] // a failed unwrap fails the test
    use super::*;

    /// Every object that describes a table with fixed keys, and each of its keys.
    fn walk(path: &str, schema: &Value, seen: &mut usize) {
        if let Some(properties) = schema["properties"].as_object() {
            assert_eq!(schema["additionalProperties"], false, "{path}");
            for (key, value) in properties {
                *seen += 1;
                let text = value["description"].as_str().unwrap_or_else(|| panic!("{path}/{key} says nothing"));
                assert!(text.ends_with('.') && text.len() > 10, "{path}/{key}: {text}");
            }
        }
        match schema {
            Value::Object(all) => all.iter().for_each(|(key, value)| walk(&format!("{path}/{key}"), value, seen)),
            Value::Array(all) => all.iter().for_each(|value| walk(path, value, seen)),
            _ => {}
        }
    }

    #[test]
    fn every_key_is_described_and_no_other_is_allowed() {
        let mut seen = 0;
        walk("", &spec(), &mut seen);
        let tables = [keys::USE, keys::PARAMETER, keys::STATE, keys::MEMORY, keys::FUNCTION, keys::MODE];
        let tables = tables.iter().chain(&[
            keys::TRANSITION,
            keys::SURFACE,
            keys::SECTION,
            keys::MEASURE,
            keys::PROBLEM,
            keys::DRAWING,
            keys::DRAWN_POINT,
            keys::PUBLISHED,
            keys::SPEC,
        ]);
        assert_eq!(seen, tables.map(|keys| keys.len()).sum::<usize>());
    }

    #[test]
    fn a_part_has_what_a_spec_has_but_for_its_own() {
        let (spec, part) = (spec(), part());
        for key in keys::SPEC {
            let only = keys::OF_SPECS_ONLY.iter().any(|(only, _)| only == key);
            assert_eq!(part["properties"][key].is_null(), only, "{key}");
            assert!(only || part["properties"][key] == spec["properties"][key], "{key}");
        }
    }
}
