//! What tables are made of: names, expressions, quantities, texts; and tables with fixed keys and with names for keys.

use crate::front::names::reserved_words;
use serde_json::{Map, Value, json};

/// A table whose keys are fixed, each described by a function; a key without description is not allowed in it.
pub(super) struct Keys<'a> {
    properties: Map<String, Value>,
    required: &'a [&'a str],
}

impl<'a> Keys<'a> {
    pub(super) fn new(keys: &[&str], describe: impl Fn(&str) -> Option<Value>) -> Self {
        let described = keys.iter().filter_map(|key| Some(((*key).to_owned(), describe(key)?)));
        Self { properties: described.collect(), required: &[] }
    }

    /// The keys that must be there.
    pub(super) fn required(self, required: &'a [&'a str]) -> Self {
        Self { required, ..self }
    }

    pub(super) fn table(self, description: &str) -> Value {
        let mut schema = json!({
            "type": "object",
            "description": description,
            "properties": self.properties,
            "additionalProperties": false,
        });
        if !self.required.is_empty() {
            schema["required"] = json!(self.required);
        }
        schema
    }
}

/// A schema with what an editor says of it.
pub(super) fn described(mut schema: Value, description: &str) -> Value {
    schema["description"] = description.into();
    schema
}

/// Text for people.
pub(super) fn text(description: &str) -> Value {
    described(json!({ "type": "string" }), description)
}

/// An expression or a quantity: a string or a bare number. (Numbers that JSON does not know cannot be in a spec.)
pub(super) fn scalar(description: &str) -> Value {
    described(json!({ "type": ["string", "number"], "minLength": 1 }), description)
}

/// A lower and an upper bound.
pub(super) fn interval(description: &str) -> Value {
    let item = scalar("Quantity with its unit.");
    described(json!({ "type": "array", "items": item, "minItems": 2, "maxItems": 2 }), description)
}

/// A list of strings.
pub(super) fn strings(item: Value, description: &str) -> Value {
    described(json!({ "type": "array", "items": item }), description)
}

/// ASCII letters, digits and `_`, no digit first.
const NAME: &str = "^([A-Za-z]|_[A-Za-z0-9_])[A-Za-z0-9_]*$";

/// The names of a table's keys that expressions do not refer to, or that are defined elsewhere.
pub(super) fn any_name() -> Value {
    json!({ "pattern": NAME })
}

/// A string that names something.
pub(super) fn name(description: &str) -> Value {
    described(json!({ "type": "string", "pattern": NAME }), description)
}

/// A name that a spec gives to something that expressions can refer to.
pub(super) fn new_name() -> Value {
    json!({ "pattern": NAME, "not": { "enum": reserved_words() } })
}

/// Lower-case words of Rust that cannot name a module.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// The name of a model.
pub(super) fn model_name() -> Value {
    let schema = json!({ "type": "string", "pattern": "^[a-z][a-z0-9_]*$", "not": { "enum": KEYWORDS } });
    described(
        schema,
        "Name of the model, which is that of the file: lower-case letters, digits and `_`, no Rust keyword.",
    )
}

/// A table of things by names of a form.
pub(super) fn named(item: Value, names: Value, description: &str) -> Value {
    json!({ "type": "object", "description": description, "propertyNames": names, "additionalProperties": item })
}

/// A table of expressions by the names that stand for something defined elsewhere.
pub(super) fn expressions(item: &str, description: &str) -> Value {
    named(scalar(item), any_name(), description)
}

#[cfg(test)]
mod tests {
    use super::KEYWORDS;
    use crate::front::is_module_name;

    #[test]
    fn keywords_are_those_that_the_reader_refuses() {
        for word in KEYWORDS {
            assert!(!is_module_name(word), "{word}");
        }
        for word in ["union", "auto", "default", "raw", "safe", "macro_rules", "dyn_"] {
            assert!(is_module_name(word) && !KEYWORDS.contains(&word), "{word}");
        }
    }
}
