//! Where a result comes from: the program, the model and the run that made it. Every output carries it, so that a result can be
//! made again from its own metadata.

use serde_json::{Value, json};

/// The key under which files carry their provenance.
pub const KEY: &str = "gaitc";

/// What made a result. Settings that do not change a result (threads, where outputs go) are no part of it, so that equal
/// provenance means equal bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// Name of the model.
    pub model: String,
    /// Hash of the model's equations.
    pub fingerprint: String,
    /// The run as a run file has it: `command`, `model`, then flags by their long names, with the value of every parameter
    /// written out below `set`.
    pub run: toml::Table,
}

impl Provenance {
    /// Version of the program.
    pub const VERSION: &'static str = env!("CARGO_PKG_VERSION");

    /// As an object for JSON results.
    pub fn json(&self) -> Value {
        // A table of strings, numbers and arrays is JSON, too.
        let run = serde_json::to_value(&self.run).unwrap_or_default();
        json!({ "version": Self::VERSION, "model": self.model, "fingerprint": self.fingerprint, "run": run })
    }

    /// As one line, for the metadata of files.
    pub fn line(&self) -> String {
        self.json().to_string()
    }
}
