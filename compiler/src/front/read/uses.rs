//! The key `use`: a list of parts, or a table that gives each part a role and says what changes in it.

use super::fields::{Fields, Sink, expression_or_quantity, scalar, string, table};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, Value, ValueKind};
use crate::front::keys;
use crate::front::names::is_identifier;
use crate::front::parser::shortened;
use crate::front::spec::{Named, Use};
use crate::front::text::Text;

/// What `use` looks like.
const EXAMPLE: &str = "use = [\"parts/motor.toml\"]";
/// What a part of the table form looks like.
const PART: &str = "part = \"parts/motor.toml\"";

/// `use = ["parts/motor.toml"]`, or `[use]` with `motor = "parts/motor.toml"` or `[use.motor]`.
pub(super) fn uses(entry: &Entry, sink: &mut Sink<'_>) -> Vec<Use> {
    match &entry.value.kind {
        ValueKind::Array(values) => values.iter().filter_map(|value| listed(value, sink)).collect(),
        ValueKind::Table(table) => table.entries.iter().filter_map(|entry| in_a_role(entry, sink)).collect(),
        _ => {
            sink.wrong_type(&entry.value, "use", "an array of strings or a table", EXAMPLE);
            Vec::new()
        }
    }
}

fn listed(value: &Value, sink: &mut Sink<'_>) -> Option<Use> {
    match &value.kind {
        ValueKind::Text(part) => Some(plain(part)),
        _ => {
            sink.wrong_type(value, "use", "an array of strings or a table", EXAMPLE);
            None
        }
    }
}

/// A part as it is.
fn plain(part: &Text) -> Use {
    Use { part: part.clone(), rename: Vec::new(), set: Vec::new(), fix: Vec::new() }
}

fn in_a_role(entry: &Entry, sink: &mut Sink<'_>) -> Option<Use> {
    let role = shortened(&entry.key);
    if !is_identifier(&entry.key) {
        let message = format!("`{role}` is not a valid name for what a part does");
        let help = "a name has ASCII letters, digits and `_` and does not begin with a digit";
        sink.push(Diagnostic::error(Code::InvalidName, message).at(entry.key_span, "").help(help));
    }
    if let ValueKind::Text(part) = &entry.value.kind {
        return Some(plain(part));
    }
    let fields = Fields::new(table(entry, sink)?, entry.key_span, format!("use of `{role}`"), keys::USE, sink);
    let texts = |key: &str, read: fn(&Entry, &mut Sink<'_>) -> Option<Text>, sink: &mut Sink<'_>| {
        let mut items = Vec::new();
        for entry in fields.table(key, sink) {
            if let Some(value) = read(entry, sink) {
                items.push(Named { name: entry.key.clone(), span: entry.key_span, value });
            }
        }
        items
    };
    let quantity = |entry: &Entry, sink: &mut Sink<'_>| scalar(&entry.value, &entry.key, "m = \"2 kg\"", sink);
    let rename = texts("rename", |entry, sink| string(entry, "m = \"m_motor\"", sink), sink);
    let set = texts("set", quantity, sink);
    let fix = texts("fix", quantity, sink);
    let expression = |item: Named<Text>, sink: &mut Sink<'_>| Named {
        name: item.name,
        span: item.span,
        value: expression_or_quantity(item.value, sink),
    };
    let fix = fix.into_iter().map(|item| expression(item, sink)).collect();
    Some(Use { part: fields.string("part", PART, sink)?, rename, set, fix })
}
