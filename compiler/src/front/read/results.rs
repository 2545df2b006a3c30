//! The tables `[measures]` and `[problems]`.

use super::fields::{Fields, Sink, constraint, equation, interval, strings};
use super::fields_of;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, ValueKind};
use crate::front::keys::{self, LONGEST_PERIOD, MOST_ROBUST};
use crate::front::parser::shortened;
use crate::front::spec::{Equation, Interval, Measure, Named, Problem};
use crate::ir::Sense;
use crate::source::Span;

/// `speed = { expr = "mean(v)", unit = "m/s", doc = "..." }`.
pub(super) fn measures(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Measure>> {
    let mut measures = Vec::new();
    for entry in entries {
        if !matches!(entry.value.kind, ValueKind::Table(_)) {
            let example = format!("{} = {{ expr = \"...\", unit = \"...\" }}", shortened(&entry.key));
            sink.wrong_type(&entry.value, &entry.key, "a table", &example);
            // It is there all the same: what uses it is not wrong.
            let value = Measure { expr: None, unit: None, doc: String::new() };
            measures.push(Named { name: entry.key.clone(), span: entry.key_span, value });
            continue;
        }
        let Some(fields) = fields_of(entry, "measure", keys::MEASURE, sink) else {
            continue;
        };
        let value = Measure {
            expr: fields.equation("expr", "expr = \"mean(v)\"", sink),
            unit: fields.string("unit", "unit = \"m/s\"", sink),
            doc: fields.doc("doc", sink),
        };
        measures.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    measures
}

/// `[problems.NAME]`.
pub(super) fn problems(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Problem>> {
    let mut problems = Vec::new();
    for entry in entries {
        let Some(fields) = fields_of(entry, "problem", keys::PROBLEM, sink) else {
            continue;
        };
        let example = "subject_to = [\"spectral_radius <= 0.95\"]";
        let subject_to = fields.get("subject_to").and_then(|entry| strings(entry, example, sink)).unwrap_or_default();
        let value = Problem {
            doc: fields.doc("doc", sink),
            default: default(&fields, sink),
            objective: objective(&fields, sink),
            vary: vary(&fields, sink),
            robust: robust(&fields, sink),
            subject_to: subject_to.into_iter().map(|text| constraint(text, sink)).collect(),
            period: period(&fields, sink),
        };
        problems.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    problems
}

fn default(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Option<Span> {
    let entry = fields.get("default")?;
    match entry.value.kind {
        ValueKind::Boolean(default) => default.then_some(entry.key_span),
        _ => {
            sink.wrong_type(&entry.value, "default", "true or false", "default = true");
            None
        }
    }
}

/// How many maps make the gait; one where nothing is said, or nothing that can be used.
fn period(fields: &Fields<'_>, sink: &mut Sink<'_>) -> usize {
    let Some(entry) = fields.get("period") else { return 1 };
    match &entry.value.kind {
        ValueKind::Integer(period, _) => {
            let known = period.and_then(|period| usize::try_from(period).ok());
            known.filter(|period| (1..=LONGEST_PERIOD).contains(period)).unwrap_or_else(|| {
                let message = "a gait cannot be made of this many maps";
                let help = format!("write a whole number from 1 to {LONGEST_PERIOD}");
                sink.push(Diagnostic::error(Code::BadValue, message).at(entry.value.span, "").help(help));
                1
            })
        }
        _ => {
            sink.wrong_type(&entry.value, "period", "a whole number", "period = 2");
            1
        }
    }
}

fn objective(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Option<(Sense, Equation)> {
    match (fields.get("maximize"), fields.get("minimize")) {
        (Some(maximize), Some(minimize)) => {
            let message = format!("{} both maximizes and minimizes", fields.what);
            let diagnostic = Diagnostic::error(Code::ProblemForm, message).at(minimize.key_span, "");
            let diagnostic = diagnostic.see(maximize.key_span, "first objective");
            sink.push(diagnostic.help("keep one, and bound the other in `subject_to`, or write two problems"));
            None
        }
        (Some(entry), None) => equation(entry, sink).map(|equation| (Sense::Maximize, equation)),
        (None, Some(entry)) => equation(entry, sink).map(|equation| (Sense::Minimize, equation)),
        (None, None) => {
            let message = format!("{} has no objective", fields.what);
            sink.missing(fields.place, message, "add `maximize = \"...\"` or `minimize = \"...\"`");
            None
        }
    }
}

fn vary(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Vec<Named<Interval>> {
    let example = "vary = { psi = [\"0 deg\", \"45 deg\"] }";
    if fields.require("vary", example, sink).is_none() {
        return Vec::new();
    }
    let vary = intervals(fields, "vary", example, sink);
    if is_empty_table(fields, "vary") {
        let diagnostic = Diagnostic::error(Code::ProblemForm, format!("{} varies nothing", fields.what));
        sink.push(diagnostic.at(fields.place, "").help(format!("write `{example}`")));
    }
    vary
}

fn robust(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Vec<Named<Interval>> {
    let example = "robust = { m = [\"2.4 kg\", \"2.8 kg\"] }";
    let Some(entry) = fields.get("robust") else { return Vec::new() };
    let robust = intervals(fields, "robust", example, sink);
    if is_empty_table(fields, "robust") {
        let diagnostic = Diagnostic::error(Code::ProblemForm, format!("{} is robust over nothing", fields.what));
        let help = format!("leave `robust` out, or write `{example}`");
        sink.push(diagnostic.at(entry.key_span, "").help(help));
    }
    if robust.len() > MOST_ROBUST {
        let message = format!("{} is robust over {} parameters", fields.what, robust.len());
        let help = format!("keep the {MOST_ROBUST} that matter most: each needs scenarios of its own");
        sink.push(Diagnostic::error(Code::ProblemForm, message).at(entry.key_span, "").help(help));
    }
    robust
}

/// A table of names with intervals.
fn intervals(fields: &Fields<'_>, key: &str, example: &str, sink: &mut Sink<'_>) -> Vec<Named<Interval>> {
    let mut intervals = Vec::new();
    for entry in fields.table(key, sink) {
        if let Some(value) = interval(entry, example, sink) {
            intervals.push(Named { name: entry.key.clone(), span: entry.key_span, value });
        }
    }
    intervals
}

fn is_empty_table(fields: &Fields<'_>, key: &str) -> bool {
    fields
        .get(key)
        .is_some_and(|entry| matches!(&entry.value.kind, ValueKind::Table(entries) if entries.entries.is_empty()))
}
