//! The tables `[functions]`, `[modes]`, `[transitions]`, `[surfaces]` and `[section]`.

use super::fields::{
    Fields, Sink, broken_equation, equation, equation_or_broken, equations, expression, scalar, string, strings, table,
};
use super::fields_of;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, Value, ValueKind};
use crate::front::keys;
use crate::front::names::suggest;
use crate::front::spec::{Anchor, Equation, Function, MassRow, Mode, Named, Section, Surface, Transition};
use crate::front::text::Text;
use crate::ir::Direction;
use crate::source::Span;

/// `f = { args = ["w"], expr = "..." }`.
pub(super) fn functions(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Function>> {
    let mut functions = Vec::new();
    for entry in entries {
        let Some(fields) = fields_of(entry, "function", keys::FUNCTION, sink) else {
            continue;
        };
        let arguments = fields.require("args", "args = [\"x\"]", sink);
        let arguments = arguments.and_then(|entry| strings(entry, "args = [\"x\"]", sink)).unwrap_or_default();
        let body = fields.equation("expr", "expr = \"2*x\"", sink);
        let value = Function { arguments, body, doc: fields.doc("doc", sink) };
        functions.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    functions
}

/// `[modes.NAME.flow]` and `[modes.NAME.mass]`.
pub(super) fn modes(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Mode>> {
    let mut modes = Vec::new();
    for entry in entries {
        let Some(fields) = fields_of(entry, "mode", keys::MODE, sink) else {
            continue;
        };
        let flow = fields.require("flow", &format!("[modes.{}.flow]", entry.key), sink);
        let flow = flow.and_then(|entry| table(entry, sink)).map(|table| equations(&table.entries, sink));
        let doc = fields.doc("doc", sink);
        let mass = mass(&fields, flow.as_deref().unwrap_or(&[]), sink);
        let value = Mode { flow: flow.unwrap_or_default(), mass, doc };
        modes.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    modes
}

/// The rows of `[modes.NAME.mass]`.
fn mass(fields: &Fields<'_>, flow: &[Named<Equation>], sink: &mut Sink<'_>) -> Vec<Named<MassRow>> {
    match fields.get("mass").map(|entry| &entry.value) {
        None => Vec::new(),
        Some(Value { kind: ValueKind::Table(table), .. }) => {
            table.entries.iter().map(|entry| mass_row(entry, sink)).collect()
        }
        Some(value) => {
            let example = "mass = { x = \"m\", y = { x = \"m*l\", y = \"m*l^2\" } }";
            sink.wrong_type(value, "mass", "a table", example);
            // Any row may have been meant: none is then taken for the identity's.
            let broken = |row: &Named<Equation>| Named {
                name: row.name.clone(),
                span: row.span,
                value: MassRow::Factor(broken_equation(value.span)),
            };
            flow.iter().map(broken).collect()
        }
    }
}

/// `x = "m"`, or `x = { x = "m", y = "m*l*cos(y)" }`.
fn mass_row(entry: &Entry, sink: &mut Sink<'_>) -> Named<MassRow> {
    let value = match &entry.value.kind {
        ValueKind::Table(table) => MassRow::Entries(equations(&table.entries, sink)),
        _ => MassRow::Factor(equation_or_broken(entry, sink)),
    };
    Named { name: entry.key.clone(), span: entry.key_span, value }
}

/// `[transitions.NAME]`.
pub(super) fn transitions(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Transition>> {
    let mut transitions = Vec::new();
    for entry in entries {
        let Some(fields) = fields_of(entry, "transition", keys::TRANSITION, sink) else {
            continue;
        };
        let value = Transition {
            doc: fields.doc("doc", sink),
            from: fields.string("from", "from = \"stance\"", sink),
            to: fields.string("to", "to = \"stance\"", sink),
            guard: fields.equation("guard", "guard = \"length - tau*speed\"", sink),
            direction: direction(&fields, sink),
            when: fields.get("when").and_then(|entry| equation(entry, sink)),
            reset: equations(fields.table("reset", sink), sink),
            also_zero: also_zero(&fields, sink),
        };
        transitions.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    transitions
}

fn also_zero(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Option<(Span, Vec<Equation>)> {
    let entry = fields.get("also_zero")?;
    let texts = strings(entry, "also_zero = [\"length - reach\"]", sink)?;
    Some((entry.key_span, texts.into_iter().map(|text| expression(text, sink)).collect()))
}

fn direction(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Option<Direction> {
    let example = "direction = \"falling\"";
    let entry = fields.require("direction", example, sink)?;
    let text = string(entry, example, sink)?;
    match text.value.as_str() {
        "falling" => Some(Direction::Falling),
        "rising" => Some(Direction::Rising),
        "either" => Some(Direction::Either),
        other => {
            let help = match suggest(other, keys::DIRECTIONS.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "write `falling` (from positive to negative), `rising` or `either`".to_owned(),
            };
            let message = "this is no direction in which a guard passes through zero";
            sink.push(Diagnostic::error(Code::BadValue, message).at(text.span, "").help(help));
            None
        }
    }
}

/// `[surfaces.NAME]`.
pub(super) fn surfaces(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Surface>> {
    let mut surfaces = Vec::new();
    for entry in entries {
        let Some(fields) = fields_of(entry, "surface", keys::SURFACE, sink) else {
            continue;
        };
        let value = Surface {
            mode: fields.string("mode", "mode = \"flight\"", sink),
            guard: fields.equation("guard", "guard = \"climbing_speed\"", sink),
            direction: direction(&fields, sink),
            doc: fields.doc("doc", sink),
        };
        surfaces.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    surfaces
}

/// `after = "step"`, `before = "step"` or `at = "apex"`.
fn anchor(fields: &Fields<'_>, sink: &mut Sink<'_>) -> Option<Anchor> {
    let anchors = [Anchor::After as fn(Text) -> Anchor, Anchor::Before, Anchor::At];
    let keys = ["after", "before", "at"].into_iter().zip(anchors);
    let mut given: Vec<_> = keys.filter_map(|(key, anchor)| Some((fields.get(key)?, anchor))).collect();
    given.sort_by_key(|(entry, _)| entry.key_span.start);
    let mut given = given.into_iter();
    let Some((entry, anchor)) = given.next() else {
        let message = format!("{} does not say where it stands", fields.what);
        let help = "add `after = \"TRANSITION\"`, `before = \"TRANSITION\"` or `at = \"SURFACE\"`";
        sink.missing(fields.place, message, help);
        return None;
    };
    for (other, _) in given {
        let message = format!("a section stands at one place, and `{}` gives another one", other.key);
        let error = Diagnostic::error(Code::GivenTwice, message).at(other.key_span, "");
        sink.push(error.see(entry.key_span, "the first one").help("keep one of the two"));
    }
    string(entry, &format!("{} = \"step\"", entry.key), sink).map(anchor)
}

/// `[section]`.
pub(super) fn section(entry: &Entry, sink: &mut Sink<'_>) -> Option<Section> {
    let fields = Fields::new(table(entry, sink)?, entry.key_span, "[section]".to_owned(), keys::SECTION, sink);
    fields.doc("doc", sink);
    let example = "coordinates = [\"angle\", \"speed\"]";
    let coordinates = fields.require("coordinates", example, sink);
    let mut start = Vec::new();
    for entry in fields.table("start", sink) {
        if let Some(value) = scalar(&entry.value, &entry.key, "x = \"0.2 m/s\"", sink) {
            start.push(Named { name: entry.key.clone(), span: entry.key_span, value });
        }
    }
    Some(Section {
        span: entry.key_span,
        anchor: anchor(&fields, sink),
        coordinates: coordinates.and_then(|entry| strings(entry, example, sink)),
        embed: equations(fields.table("embed", sink), sink),
        start,
        symmetry: fields.get("symmetry").map(|_| equations(fields.table("symmetry", sink), sink)),
    })
}
