//! Where a result comes from: the program, the model and the run that made it. Every output carries it, so that a result can be
//! made again from its own metadata (`gaitc run FILE`).

use serde_json::{Map, Value};

/// The key under which files carry their provenance.
pub const KEY: &str = "gaitc";

/// How a provenance begins as text: its keys are in alphabetical order.
const HEAD: &str = "{\"fingerprint\":";

/// What made a result. Settings that do not change a result (threads, where outputs go) are no part of it, so that equal
/// provenance means equal bytes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Name of the model.
    pub model: String,
    /// Hash of the model's equations.
    pub fingerprint: String,
    /// Hash of the texts that values, problems and first guesses were read from: the spec and its parts.
    pub spec: String,
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
        let text = |text: &str| Value::String(text.to_owned());
        let entries = [
            ("fingerprint", text(&self.fingerprint)),
            ("model", text(&self.model)),
            ("run", run),
            ("spec", text(&self.spec)),
            ("version", text(Self::VERSION)),
        ];
        Value::Object(entries.map(|(key, value)| (key.to_owned(), value)).into_iter().collect::<Map<_, _>>())
    }

    /// As one line of JSON for the metadata of files, without the characters that mean something in XML.
    pub fn line(&self) -> String {
        // They stand within strings only, where JSON may write them by number.
        self.json().to_string().replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
    }
}

/// The provenance that a file carries, whatever kind of file it is: as `Provenance::json` has it.
pub fn find(contents: &[u8]) -> Option<Value> {
    if let Ok(Value::Object(mut all)) = serde_json::from_slice::<Value>(contents) {
        return all.remove(KEY).filter(|found| found.get("run").is_some());
    }
    let starts = contents.windows(HEAD.len()).enumerate().filter(|(_, window)| *window == HEAD.as_bytes());
    let read = |(start, _)| serde_json::Deserializer::from_slice(contents.get(start..)?).into_iter().next()?.ok();
    starts.filter_map(read).find(|found: &Value| found.get("run").is_some())
}
