//! TOML text to a document whose keys and values know their places, keys in the order of the file.

use super::text::Text;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Span};
use std::collections::HashSet;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A table.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    pub(crate) entries: Vec<Entry>,
}

/// A key and its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) value: Value,
}

/// A value and its place.
#[derive(Clone, Debug)]
pub(crate) struct Value {
    pub(crate) kind: ValueKind,
    pub(crate) span: Span,
}

/// What a value is.
#[derive(Clone, Debug)]
pub(crate) enum ValueKind {
    Text(Text),
    /// A whole number, `None` where it does not fit, and as it is written.
    Integer(Option<i64>, Text),
    /// A real number as it is written.
    Float(Text),
    Boolean(bool),
    Datetime,
    Array(Vec<Value>),
    Table(Table),
}

impl Table {
    /// The entry of a key.
    pub(crate) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }
}

impl Value {
    /// The kind of value in words.
    pub(crate) const fn kind_text(&self) -> &'static str {
        match self.kind {
            ValueKind::Text(_) => "a string",
            ValueKind::Integer(..) => "a whole number",
            ValueKind::Float(_) => "a fraction",
            ValueKind::Boolean(_) => "true or false",
            ValueKind::Datetime => "a date",
            ValueKind::Array(_) => "an array",
            ValueKind::Table(_) => "a table",
        }
    }
}

/// Most errors of broken TOML: a quote that is missing makes all that follows wrong.
const ERROR_LIMIT: usize = 50;

/// Reads a file. Where the TOML is broken, what could be recovered comes with the errors.
pub(crate) fn parse(file: FileId, text: &str, diagnostics: &mut Vec<Diagnostic>) -> Table {
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut lines = HashSet::new();
    for error in errors {
        let range = error.span().unwrap_or(0..0);
        // What follows a mistake on its line is mostly a consequence of it.
        let before = text.get(..range.start).unwrap_or("");
        if lines.len() >= ERROR_LIMIT || !lines.insert(before.rfind('\n')) {
            continue;
        }
        let span = Span { file, start: range.start.min(text.len()), end: range.end.min(text.len()) };
        let diagnostic = Diagnostic::error(Code::Toml, error.message().trim().replace('\n', ", ")).at(span, "");
        diagnostics.push(match advice(text, &range) {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        });
    }
    Reader { file, text }.table(table.get_ref())
}

/// The keys at the top of a file, and whether its TOML is broken.
pub(crate) fn top_level(text: &str) -> (Vec<String>, bool) {
    let (table, errors) = DeTable::parse_recoverable(text);
    (table.get_ref().keys().map(|key| key.get_ref().to_string()).collect(), !errors.is_empty())
}

/// The most frequent slip: an expression without quotes.
fn advice(text: &str, range: &Range<usize>) -> Option<&'static str> {
    let line_start = text.get(..range.start)?.rfind('\n').map_or(0, |i| i + 1);
    let before = text.get(line_start..range.start)?;
    let value = before.split_once('=').map(|(_, value)| value.trim_start())?;
    let quoted = value.starts_with(['"', '\'', '[', '{', '#']);
    (!quoted).then_some("expressions and quantities stand in quotes, as in `x = \"2*y\"`")
}

struct Reader<'a> {
    file: FileId,
    text: &'a str,
}

impl Reader<'_> {
    fn span(&self, range: Range<usize>) -> Span {
        Span { file: self.file, start: range.start, end: range.end }
    }

    fn table(&self, table: &DeTable<'_>) -> Table {
        let mut entries: Vec<Entry> = table
            .iter()
            .map(|(key, value)| Entry {
                key: key.get_ref().to_string(),
                key_span: self.span(key.span()),
                value: self.value(value),
            })
            .collect();
        // The TOML library sorts by name; parameters and states keep the order in which they were written.
        entries.sort_by_key(|entry| entry.key_span);
        Table { entries }
    }

    fn value(&self, value: &Spanned<DeValue<'_>>) -> Value {
        let span = self.span(value.span());
        let raw = self.text.get(value.span()).unwrap_or("");
        let kind = match value.get_ref() {
            DeValue::String(text) => ValueKind::Text(Text::from_toml(text, raw, span)),
            DeValue::Integer(number) => {
                let value = i64::from_str_radix(number.as_str(), number.radix()).ok();
                ValueKind::Integer(value, Text::bare(raw, span))
            }
            DeValue::Float(_) => ValueKind::Float(Text::bare(raw, span)),
            DeValue::Boolean(value) => ValueKind::Boolean(*value),
            DeValue::Datetime(_) => ValueKind::Datetime,
            DeValue::Array(values) => ValueKind::Array(values.iter().map(|value| self.value(value)).collect()),
            DeValue::Table(table) => ValueKind::Table(self.table(table)),
        };
        Value { kind, span }
    }
}
