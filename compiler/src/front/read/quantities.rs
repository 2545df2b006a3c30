//! The tables `[parameters]`, `[state]` and `[memory]`.

use super::fields::{Sink, interval, scalar, string, strings};
use super::fields_of;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, ValueKind};
use crate::front::keys;
use crate::front::spec::{Memory, Named, Parameter, State};

/// `x = { value = "13 cm", range = ["5 cm", "30 cm"], doc = "..." }` or, for short, `x = "13 cm"`.
pub(super) fn parameters(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Parameter>> {
    entries.iter().map(|entry| named(entry, parameter(entry, sink))).collect()
}

fn parameter(entry: &Entry, sink: &mut Sink<'_>) -> Parameter {
    let example = "value = \"13 cm\"";
    let broken = Parameter { value: None, range: None, doc: String::new(), replaced: None };
    if let ValueKind::Text(text) | ValueKind::Integer(_, text) | ValueKind::Float(text) = &entry.value.kind {
        return Parameter { value: Some(text.clone()), ..broken };
    }
    let Some(fields) = fields_of(entry, "parameter", keys::PARAMETER, sink) else {
        return broken;
    };
    let value = fields.require("value", example, sink);
    Parameter {
        value: value.and_then(|entry| scalar(&entry.value, "value", example, sink)),
        range: fields.get("range").and_then(|entry| interval(entry, "range = [\"5 cm\", \"30 cm\"]", sink)),
        doc: fields.doc("doc", sink),
        replaced: None,
    }
}

/// `x = { unit = "m/s", doc = "...", modes = ["flight"] }`.
pub(super) fn states(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<State>> {
    entries.iter().map(|entry| named(entry, state(entry, sink))).collect()
}

fn state(entry: &Entry, sink: &mut Sink<'_>) -> State {
    let broken = State { unit: None, modes: None, doc: String::new() };
    let Some(fields) = fields_of(entry, "state", keys::STATE, sink) else {
        return broken;
    };
    let unit = fields.require("unit", "unit = \"m/s\"", sink);
    State {
        unit: unit.and_then(|entry| string(entry, "unit = \"m/s\"", sink)),
        modes: fields.get("modes").and_then(|entry| strings(entry, "modes = [\"stance\"]", sink)),
        doc: fields.doc("doc", sink),
    }
}

/// `n = { initial = 0, doc = "..." }`.
pub(super) fn memory(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Memory>> {
    entries.iter().map(|entry| named(entry, one_memory(entry, sink))).collect()
}

fn one_memory(entry: &Entry, sink: &mut Sink<'_>) -> Memory {
    let broken = Memory { initial: 0, doc: String::new() };
    let Some(fields) = fields_of(entry, "memory", keys::MEMORY, sink) else {
        return broken;
    };
    let doc = fields.doc("doc", sink);
    let Some(entry) = fields.require("initial", "initial = 0", sink) else {
        return Memory { doc, ..broken };
    };
    match &entry.value.kind {
        ValueKind::Integer(Some(initial), _) if initial.unsigned_abs() <= LARGEST => Memory { initial: *initial, doc },
        ValueKind::Integer(..) => {
            let message = "this whole number is too large for a memory";
            let help = "a memory takes whole numbers up to 9007199254740992, which a real number holds exactly";
            sink.push(Diagnostic::error(Code::BadValue, message).at(entry.value.span, "").help(help));
            broken
        }
        _ => {
            sink.wrong_type(&entry.value, "initial", "a whole number", "initial = 0");
            broken
        }
    }
}

/// Up to here every whole number is an f64: 2^53.
pub(crate) const LARGEST: u64 = 1 << 53;

fn named<T>(entry: &Entry, value: T) -> Named<T> {
    Named { name: entry.key.clone(), span: entry.key_span, value }
}
