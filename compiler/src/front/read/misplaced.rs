//! The list `use` below the header of a table: in TOML it belongs to that table then, while it was meant for the file.

use super::fields::Sink;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::document::{Entry, Table, ValueKind};
use crate::front::parser::shortened;

/// The document with such a list moved to where it was meant to stand, so that nothing else is said of it or of the
/// names that its parts bring; reports each. `None` where there is none.
pub(super) fn use_at_the_top(document: &Table, sink: &mut Sink<'_>) -> Option<Table> {
    let mut found = Vec::new();
    let mut moved = Table::default();
    for entry in &document.entries {
        moved.entries.push(without(entry, &shortened(&entry.key), &mut found));
    }
    let first = found.first()?.1.clone();
    for (table, entry) in found {
        let message = format!("`use` stands in the table [{table}], where it takes in no parts");
        let error = Diagnostic::error(Code::UnknownKey, message).at(entry.key_span, "");
        sink.push(error.help("move this line above the first header in brackets: what stands below one belongs to it"));
    }
    if moved.get("use").is_none() {
        moved.entries.insert(0, first);
    }
    Some(moved)
}

/// An entry without the lists of parts in it, which go to `found` with the path of their table.
fn without(entry: &Entry, path: &str, found: &mut Vec<(String, Entry)>) -> Entry {
    let ValueKind::Table(table) = &entry.value.kind else { return entry.clone() };
    let mut kept = Table::default();
    for inner in &table.entries {
        if inner.key == "use" && is_list_of_parts(&inner.value.kind) {
            found.push((path.to_owned(), inner.clone()));
        } else {
            kept.entries.push(without(inner, &format!("{path}.{}", shortened(&inner.key)), found));
        }
    }
    let mut entry = entry.clone();
    entry.value.kind = ValueKind::Table(kept);
    entry
}

/// Whether a value is a list of TOML files, which nothing but parts can be.
fn is_list_of_parts(value: &ValueKind) -> bool {
    let ValueKind::Array(values) = value else { return false };
    let is_part = |value: &ValueKind| matches!(value, ValueKind::Text(text) if text.value.ends_with(".toml"));
    !values.is_empty() && values.iter().all(|value| is_part(&value.kind))
}
