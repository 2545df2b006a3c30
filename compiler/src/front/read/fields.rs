//! One table of a spec: which keys it takes, which it must have, and of what type they are.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, Table, Value, ValueKind};
use crate::front::names::suggest;
use crate::front::parser::{parse_constraint, parse_expression, parse_expression_or_quantity, shortened};
use crate::front::spec::{Equation, Interval, Named};
use crate::front::syntax::Expression;
use crate::front::text::Text;
use crate::source::Span;

/// Where problems go, and whether the file was read completely (else nothing is reported as missing).
pub(super) struct Sink<'a> {
    pub(super) diagnostics: &'a mut Vec<Diagnostic>,
    pub(super) complete: bool,
}

impl Sink<'_> {
    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports a value of the wrong type.
    pub(super) fn wrong_type(&mut self, value: &Value, key: &str, expected: &str, example: &str) {
        if !self.complete {
            return; // what broken TOML was meant to be is not known
        }
        let message = format!("`{}` must be {expected}, not {}", shortened(key), value.kind_text());
        self.push(Diagnostic::error(Code::WrongType, message).at(value.span, "").help(format!("write `{example}`")));
    }

    /// Reports something that is not there.
    pub(super) fn missing(&mut self, place: Span, message: String, help: &str) {
        if self.complete {
            self.push(Diagnostic::error(Code::MissingKey, message).at(place, "").help(help));
        }
    }
}

/// A table whose keys are fixed.
pub(super) struct Fields<'t> {
    table: &'t Table,
    /// Misspelt keys and what they were probably meant to be: read as that, so that nothing else is said of them.
    misspelt: Vec<(&'t Entry, String)>,
    /// The table's header, to point at when something is missing.
    pub(super) place: Span,
    /// The table in words, e.g. "parameter `psi`".
    pub(super) what: String,
}

impl<'t> Fields<'t> {
    /// Takes a table and reports the keys that it must not have.
    pub(super) fn new(table: &'t Table, place: Span, what: String, keys: &[&str], sink: &mut Sink<'_>) -> Self {
        let mut misspelt = Vec::new();
        for entry in table.entries.iter().filter(|entry| !keys.contains(&entry.key.as_str())) {
            let near = suggest(&entry.key, keys.iter().copied());
            misspelt.extend(near.map(|near| (entry, near.to_owned())));
            let help = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the keys are {}", list(keys)),
            };
            let message = format!("unknown key `{}` of {what}", shortened(&entry.key));
            sink.push(Diagnostic::error(Code::UnknownKey, message).at(entry.key_span, "").help(help));
        }
        Self { table, misspelt, place, what }
    }

    pub(super) fn get(&self, key: &str) -> Option<&'t Entry> {
        let misspelt = || self.misspelt.iter().find(|(_, meant)| meant == key).map(|(entry, _)| *entry);
        self.table.get(key).or_else(misspelt)
    }

    /// A key that must be there.
    pub(super) fn require(&self, key: &str, example: &str, sink: &mut Sink<'_>) -> Option<&'t Entry> {
        let entry = self.get(key);
        if entry.is_none() {
            sink.missing(self.place, format!("`{key}` of {} is missing", self.what), &format!("add `{example}`"));
        }
        entry
    }

    /// A string, empty when it is not there.
    pub(super) fn doc(&self, key: &str, sink: &mut Sink<'_>) -> String {
        let entry = self.get(key);
        entry
            .and_then(|entry| string(entry, &format!("{key} = \"...\""), sink))
            .map_or(String::new(), |text| text.value)
    }

    /// A string that must be there.
    pub(super) fn string(&self, key: &str, example: &str, sink: &mut Sink<'_>) -> Option<Text> {
        string(self.require(key, example, sink)?, example, sink)
    }

    /// An expression that must be there.
    pub(super) fn equation(&self, key: &str, example: &str, sink: &mut Sink<'_>) -> Option<Equation> {
        equation(self.require(key, example, sink)?, sink)
    }

    /// A sub-table; empty when it is not there.
    pub(super) fn table(&self, key: &str, sink: &mut Sink<'_>) -> &'t [Entry] {
        self.get(key).and_then(|entry| table(entry, sink)).map_or(&[], |table| &table.entries)
    }
}

/// A string.
pub(super) fn string(entry: &Entry, example: &str, sink: &mut Sink<'_>) -> Option<Text> {
    match &entry.value.kind {
        ValueKind::Text(text) => Some(text.clone()),
        _ => {
            sink.wrong_type(&entry.value, &entry.key, "a string", example);
            None
        }
    }
}

/// A table.
pub(super) fn table<'t>(entry: &'t Entry, sink: &mut Sink<'_>) -> Option<&'t Table> {
    match &entry.value.kind {
        ValueKind::Table(table) => Some(table),
        _ => {
            sink.wrong_type(&entry.value, &entry.key, "a table", &format!("{} = {{ ... }}", shortened(&entry.key)));
            None
        }
    }
}

/// The text of an expression or a quantity: a string, or a bare number.
pub(super) fn scalar(value: &Value, key: &str, example: &str, sink: &mut Sink<'_>) -> Option<Text> {
    match &value.kind {
        ValueKind::Text(text) | ValueKind::Integer(_, text) | ValueKind::Float(text) => Some(text.clone()),
        _ => {
            sink.wrong_type(value, key, "a string", example);
            None
        }
    }
}

/// An expression.
pub(super) fn equation(entry: &Entry, sink: &mut Sink<'_>) -> Option<Equation> {
    let text = scalar(&entry.value, &entry.key, &format!("{} = \"...\"", shortened(&entry.key)), sink)?;
    Some(expression(text, sink))
}

/// The same; what has the wrong type is there all the same: it must not be reported as missing.
pub(super) fn equation_or_broken(entry: &Entry, sink: &mut Sink<'_>) -> Equation {
    equation(entry, sink).unwrap_or_else(|| broken_equation(entry.value.span))
}

/// What stands for an expression that cannot be read.
pub(super) fn broken_equation(span: Span) -> Equation {
    Equation { text: Text::bare("", span), expression: None }
}

/// The expression of a text.
pub(super) fn expression(text: Text, sink: &mut Sink<'_>) -> Equation {
    kept(parse_expression(&text), text, sink)
}

/// The expression of a text that may be a quantity.
pub(super) fn expression_or_quantity(text: Text, sink: &mut Sink<'_>) -> Equation {
    kept(parse_expression_or_quantity(&text), text, sink)
}

/// A constraint.
pub(super) fn constraint(text: Text, sink: &mut Sink<'_>) -> Equation {
    kept(parse_constraint(&text), text, sink)
}

fn kept(result: Result<Expression, Box<Diagnostic>>, text: Text, sink: &mut Sink<'_>) -> Equation {
    let expression = match result {
        Ok(expression) => Some(expression),
        Err(diagnostic) => {
            sink.push(*diagnostic);
            None
        }
    };
    Equation { text, expression }
}

/// A table of expressions.
pub(super) fn equations(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Equation>> {
    let mut equations = Vec::new();
    for entry in entries {
        let value = equation_or_broken(entry, sink);
        equations.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    equations
}

/// An array of strings; `None` if it is none.
pub(super) fn strings(entry: &Entry, example: &str, sink: &mut Sink<'_>) -> Option<Vec<Text>> {
    let ValueKind::Array(values) = &entry.value.kind else {
        sink.wrong_type(&entry.value, &entry.key, "an array of strings", example);
        return None;
    };
    let mut texts = Vec::new();
    for value in values {
        match &value.kind {
            ValueKind::Text(text) => texts.push(text.clone()),
            _ => sink.wrong_type(value, &entry.key, "an array of strings", example),
        }
    }
    (texts.len() == values.len()).then_some(texts)
}

/// An array of two quantities.
pub(super) fn interval(entry: &Entry, example: &str, sink: &mut Sink<'_>) -> Option<Interval> {
    let ValueKind::Array(values) = &entry.value.kind else {
        sink.wrong_type(&entry.value, &entry.key, "an array of two quantities", example);
        return None;
    };
    let [lower, upper] = values.as_slice() else {
        let message =
            format!("`{}` needs a lower and an upper bound, not {} values", shortened(&entry.key), values.len());
        let diagnostic = Diagnostic::error(Code::WrongType, message).at(entry.value.span, "");
        sink.push(diagnostic.help(format!("write `{example}`")));
        return None;
    };
    let lower = scalar(lower, &entry.key, example, sink);
    let upper = scalar(upper, &entry.key, example, sink);
    Some(Interval { lower: lower?, upper: upper?, span: entry.value.span })
}

/// Names in words: `a`, `b` and `c`.
pub(crate) fn list(names: &[&str]) -> String {
    match names {
        [] => "none".to_owned(),
        [one] => format!("`{one}`"),
        [first @ .., last] => {
            let first: Vec<_> = first.iter().map(|name| format!("`{name}`")).collect();
            format!("{} and `{last}`", first.join(", "))
        }
    }
}
