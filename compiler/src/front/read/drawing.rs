//! The table `[drawing]`.

use super::fields::{Fields, Sink, expression, scalar, strings, table};
use super::fields_of;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, Value, ValueKind};
use crate::front::keys;
use crate::front::parser::shortened;
use crate::front::spec::{Drawing, DrawnPoint, Equation, Named};
use crate::front::text::Text;

/// What `at` looks like.
const AT: &str = "at = [\"-r*sin(q)\", \"r*cos(q)\"]";

/// `[drawing]`.
pub(super) fn drawing(entry: &Entry, sink: &mut Sink<'_>) -> Option<Drawing> {
    let fields = Fields::new(table(entry, sink)?, entry.key_span, "[drawing]".to_owned(), keys::DRAWING, sink);
    let velocity = fields.get("velocity").and_then(|entry| pair(entry, "velocity = [\"v_x\", \"v_y\"]", sink));
    let points: Vec<_> = fields.table("points", sink).iter().filter_map(|entry| point(entry, sink)).collect();
    let links: Vec<_> = lists(&fields, "links", "links = [[\"body\", \"foot\"]]", sink)
        .into_iter()
        .filter_map(|value| link(value, sink))
        .collect();
    let panels = lists(&fields, "panels", "panels = [[\"v_x\", \"v_y\"], [\"force\"]]", sink);
    let panels = panels.into_iter().filter_map(|value| panel(value, sink)).collect();
    if fields.get("velocity").is_none()
        && let Some(entry) = fields.get("points").or_else(|| fields.get("links"))
    {
        let message = "the drawing does not say how the body moves";
        let help =
            "add `velocity = [\"v_x\", \"v_y\"]`, its speeds to the right and up: all points are seen from the body";
        sink.missing(entry.key_span, message.to_owned(), help);
    }
    Some(Drawing { span: entry.key_span, velocity, points, links, panels })
}

fn point(entry: &Entry, sink: &mut Sink<'_>) -> Option<Named<DrawnPoint>> {
    let fields = fields_of(entry, "point", keys::DRAWN_POINT, sink)?;
    let at = fields.require("at", AT, sink);
    let value = DrawnPoint {
        at: at.and_then(|entry| pair(entry, AT, sink)),
        modes: fields.get("modes").and_then(|entry| strings(entry, "modes = [\"stance\"]", sink)),
        held: held(&fields, sink),
        doc: fields.doc("doc", sink),
    };
    Some(Named { name: entry.key.clone(), span: entry.key_span, value })
}

fn held(fields: &Fields<'_>, sink: &mut Sink<'_>) -> bool {
    match fields.get("held").map(|entry| &entry.value) {
        None => false,
        Some(Value { kind: ValueKind::Boolean(held), .. }) => *held,
        Some(value) => {
            sink.wrong_type(value, "held", "true or false", "held = true");
            false
        }
    }
}

/// An array of two expressions: to the right, and up.
fn pair(entry: &Entry, example: &str, sink: &mut Sink<'_>) -> Option<[Equation; 2]> {
    let ValueKind::Array(values) = &entry.value.kind else {
        sink.wrong_type(&entry.value, &entry.key, "an array of two expressions", example);
        return None;
    };
    let [x, y] = values.as_slice() else {
        two(&entry.value, &format!("`{}` takes two expressions", shortened(&entry.key)), values.len(), example, sink);
        return None;
    };
    let (x, y) = (scalar(x, &entry.key, example, sink), scalar(y, &entry.key, example, sink));
    Some([expression(x?, sink), expression(y?, sink)])
}

/// An array of arrays.
fn lists<'t>(fields: &Fields<'t>, key: &str, example: &str, sink: &mut Sink<'_>) -> Vec<&'t Value> {
    match fields.get(key).map(|entry| &entry.value) {
        None => Vec::new(),
        Some(Value { kind: ValueKind::Array(values), .. }) => values.iter().collect(),
        Some(value) => {
            sink.wrong_type(value, key, "an array of arrays", example);
            Vec::new()
        }
    }
}

fn link(value: &Value, sink: &mut Sink<'_>) -> Option<[Text; 2]> {
    let example = "links = [[\"body\", \"foot\"]]";
    let ends = texts(value, "links", "an array of two names of points", example, sink)?;
    match <[Text; 2]>::try_from(ends) {
        Ok(ends) => Some(ends),
        Err(ends) => {
            two(value, "a link joins two points", ends.len(), example, sink);
            None
        }
    }
}

fn panel(value: &Value, sink: &mut Sink<'_>) -> Option<Vec<Equation>> {
    let example = "panels = [[\"v_x\", \"v_y\"], [\"force\"]]";
    let texts = texts(value, "panels", "an array of expressions", example, sink)?;
    if texts.is_empty() {
        let diagnostic = Diagnostic::error(Code::BadValue, "this panel has no curves").at(value.span, "");
        sink.push(diagnostic.help(format!("write `{example}`")));
        return None;
    }
    Some(texts.into_iter().map(|text| expression(text, sink)).collect())
}

/// The strings of an inner array.
fn texts(value: &Value, key: &str, expected: &str, example: &str, sink: &mut Sink<'_>) -> Option<Vec<Text>> {
    let ValueKind::Array(values) = &value.kind else {
        sink.wrong_type(value, key, expected, example);
        return None;
    };
    values
        .iter()
        .map(|value| match &value.kind {
            ValueKind::Text(text) => Some(text.clone()),
            _ => {
                sink.wrong_type(value, key, expected, example);
                None
            }
        })
        .collect()
}

/// Reports an array that does not have two entries.
fn two(value: &Value, what: &str, count: usize, example: &str, sink: &mut Sink<'_>) {
    let message = format!("{what}, not {count}");
    let diagnostic = Diagnostic::error(Code::WrongType, message).at(value.span, "");
    sink.push(diagnostic.help(format!("write `{example}`")));
}
