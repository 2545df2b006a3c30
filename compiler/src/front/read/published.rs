//! The tables `[published.NAME]`.

use super::fields::{Fields, Sink, scalar};
use super::fields_of;
use crate::front::document::{Entry, ValueKind};
use crate::front::keys;
use crate::front::spec::{Named, Published};
use crate::front::text::Text;

/// `[published.NAME]`.
pub(super) fn published(entries: &[Entry], sink: &mut Sink<'_>) -> Vec<Named<Published>> {
    let mut published = Vec::new();
    for entry in entries {
        let Some(fields) = fields_of(entry, "publication", keys::PUBLISHED, sink) else {
            continue;
        };
        let value = Published {
            doc: fields.doc("doc", sink),
            source: fields.string("source", "source = \"who and where\"", sink),
            set: quantities(&fields, "set", "psi = \"20 deg\"", sink),
            start: quantities(&fields, "start", "q_theta = \"-20 deg\"", sink),
            measures: quantities(&fields, "measures", "climb_speed = \"72 cm/s\"", sink),
            section: quantities(&fields, "section", "q_theta = \"-20 deg\"", sink),
            spread: quantities(&fields, "spread", "climb_speed = \"4 cm/s\"", sink),
        };
        let empty = |key| match fields.get(key).map(|entry| &entry.value.kind) {
            None => true,
            Some(ValueKind::Table(table)) => table.entries.is_empty(),
            Some(_) => false,
        };
        if empty("measures") && empty("section") {
            let message = format!("{} has no numbers", fields.what);
            sink.missing(fields.place, message, "add `measures = { climb_speed = \"72 cm/s\" }`");
        }
        published.push(Named { name: entry.key.clone(), span: entry.key_span, value });
    }
    published
}

/// A table of quantities.
fn quantities(fields: &Fields<'_>, key: &str, example: &str, sink: &mut Sink<'_>) -> Vec<Named<Text>> {
    let mut quantities = Vec::new();
    for entry in fields.table(key, sink) {
        if let Some(value) = scalar(&entry.value, &entry.key, example, sink) {
            quantities.push(Named { name: entry.key.clone(), span: entry.key_span, value });
        }
    }
    quantities
}
