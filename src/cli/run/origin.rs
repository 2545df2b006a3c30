//! The file that a run is read from, and what is wrong with it: where, and what to write instead.

use crate::cli::InputError;
use crate::files::{self, FileError};
use crate::provenance::find;
use gaitc_compiler::diagnostic::{Code, Diagnostic};
use gaitc_compiler::front::shortened;
use gaitc_compiler::source::{SourceMap, Span};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// A larger file is no result that carries its run.
const LARGEST_RESULT: u64 = 1 << 30;
/// A larger file is no run file.
const LARGEST_RUN: u64 = 1 << 20;

const NOTHING: &str =
    "give a run file (`command = \"gait\"`, ...) whose name ends in `.toml`, or a result that gaitc wrote";

/// A run as it was read.
pub(super) struct Read<'p> {
    /// Arguments by their long names, `command` among them.
    pub(super) run: Map<String, Value>,
    /// What a result says of the program that it was made with.
    pub(super) made: Option<Value>,
    pub(super) origin: Origin<'p>,
}

/// Where a run comes from.
pub(super) struct Origin<'p> {
    path: &'p Path,
    /// A run file with the places of its keys; of those in tables as `TABLE.KEY`.
    text: Option<(String, BTreeMap<String, Range<usize>>)>,
}

/// Reads a run file, or a result.
pub(super) fn read(path: &Path) -> Result<Read<'_>, InputError> {
    let is_run = path.extension().is_some_and(|ending| ending == "toml");
    let contents = files::read(path, if is_run { LARGEST_RUN } else { LARGEST_RESULT })?;
    if let Some(made) = find(&contents) {
        let run = made.get("run").and_then(Value::as_object).cloned().unwrap_or_default();
        return Ok(Read { run, made: Some(made), origin: Origin { path, text: None } });
    }
    if !is_run {
        return Err(Origin { path, text: None }.plainly("there is no run in this file", NOTHING));
    }
    of_text(path, String::from_utf8(contents).map_err(|_| FileError::reading(path, files::Problem::NotText))?)
}

/// Reads the text of a run file.
pub(super) fn of_text(path: &Path, text: String) -> Result<Read<'_>, InputError> {
    let (run, places) = match toml::from_str::<toml::Table>(&text).and_then(|run| Ok((run, places(&text)?))) {
        Ok(found) => found,
        Err(error) => {
            let message = error.message().trim().replace('\n', ", ");
            let place = error.span().unwrap_or(0..0);
            let origin = Origin { path, text: Some((text, BTreeMap::new())) };
            return Err(origin.at(
                Code::Toml,
                place,
                &message,
                "a run file is TOML: `KEY = VALUE`, with texts in quotes",
            ));
        }
    };
    let origin = Origin { path, text: Some((text, places)) };
    let mut arguments = Map::new();
    for (key, value) in run {
        let value = json(value).map_err(|message| {
            origin.refuse(Code::WrongType, &key, &message, &format!("write `{} = \"...\"`", shortened(&key)))
        })?;
        arguments.insert(key, value);
    }
    Ok(Read { run: arguments, made: None, origin })
}

impl Origin<'_> {
    /// What is wrong with a key.
    pub(super) fn refuse(&self, code: Code, key: &str, message: &str, help: &str) -> InputError {
        let place = self.text.as_ref().and_then(|(_, places)| places.get(key)).cloned();
        place.map_or_else(|| self.plainly(message, help), |place| self.at(code, place, message, help))
    }

    /// What is wrong with all of it.
    pub(super) fn plainly(&self, message: &str, help: &str) -> InputError {
        InputError(format!("{}: {message}\n  help: {help}", self.path.display()))
    }

    /// What is wrong at a place of a run file, shown as that in a spec.
    fn at(&self, code: Code, place: Range<usize>, message: &str, help: &str) -> InputError {
        let mut sources = SourceMap::default();
        let text = self.text.as_ref().map_or("", |(text, _)| text.as_str());
        let span = Span { file: sources.add(self.path, text), start: place.start, end: place.end };
        let diagnostic = Diagnostic::error(code, message).at(span, "").help(help);
        InputError(gaitc_compiler::diagnostic::render(&[diagnostic], &sources, false))
    }

    /// An error of the command that the file asks for, with the file.
    pub(super) fn asked(&self, InputError(message): InputError) -> InputError {
        InputError(format!("{}\n  note: this is what `{}` asks for", message.trim_end(), self.path.display()))
    }
}

/// Where keys stand.
fn places(text: &str) -> Result<BTreeMap<String, Range<usize>>, toml::de::Error> {
    let mut places = BTreeMap::new();
    for (key, value) in DeTable::parse(text)?.get_ref() {
        places.insert(key.get_ref().to_string(), key.span());
        if let DeValue::Table(table) = value.get_ref() {
            for inner in table.keys() {
                places.insert(format!("{}.{}", key.get_ref(), inner.get_ref()), inner.span());
            }
        }
    }
    Ok(places)
}

/// A value of TOML as JSON has it. What JSON has no numbers for stays text: the command says what it thinks of it.
fn json(value: toml::Value) -> Result<Value, String> {
    Ok(match value {
        toml::Value::String(text) => Value::String(text),
        toml::Value::Integer(number) => number.into(),
        toml::Value::Float(number) if number.is_finite() => number.into(),
        toml::Value::Float(number) => Value::String(number.to_string()),
        toml::Value::Boolean(truth) => Value::Bool(truth),
        toml::Value::Datetime(date) => return Err(format!("`{date}` is a date, which no argument is")),
        toml::Value::Array(all) => Value::Array(all.into_iter().map(json).collect::<Result<_, _>>()?),
        toml::Value::Table(all) => {
            Value::Object(all.into_iter().map(|(key, value)| Ok((key, json(value)?))).collect::<Result<_, String>>()?)
        }
    })
}
