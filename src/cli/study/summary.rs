//! What is said of a study when it ends.

use super::args::StorageArgs;
use super::run::Ran;
use crate::cli::{Outcome, output};
use crate::provenance::Provenance;
use crate::study::{Manifest, Shard};
use crate::table::{Table, Values};
use crate::words::counted;
use serde_json::{Map, Value, json};
use std::time::Instant;

/// A study that has ended.
pub(super) struct Summary<'a> {
    pub(super) provenance: &'a Provenance,
    pub(super) manifest: &'a Manifest,
    pub(super) storage: &'a StorageArgs,
    pub(super) warnings: &'a [String],
    pub(super) began: Instant,
}

/// What a command says of its own table: for people, and as JSON.
pub(super) struct Findings {
    pub(super) text: String,
    pub(super) json: Map<String, Value>,
}

impl Summary<'_> {
    /// Prints it. `findings` looks at the complete table.
    pub(super) fn print(&self, ran: &Ran, json: bool, findings: impl FnOnce(&Table) -> Findings) -> Outcome {
        let (points, shard) = (self.manifest.points, self.storage.shard.unwrap_or_default());
        let table = match ran {
            Ran::Complete(table) => table,
            Ran::Interrupted(done) => {
                let message = self.interrupted(*done);
                if json {
                    let status = json!({ "model": self.provenance.model, "status": "interrupted", "message": message, "points": points, "done": done });
                    output::result(self.provenance, status);
                }
                output::error(&message);
                return Outcome::Interrupted;
            }
        };
        let Findings { text, json: mut found } = findings(table);
        if json {
            let status = if shard == Shard::default() { "complete" } else { "shard" };
            let mut all = Map::new();
            all.insert("model".to_owned(), self.provenance.model.clone().into());
            all.insert("status".to_owned(), status.into());
            all.insert("points".to_owned(), points.into());
            all.insert("computed".to_owned(), table.rows().into());
            all.insert("warnings".to_owned(), self.warnings.into());
            all.append(&mut found);
            if self.storage.dir.is_none() && self.storage.out.is_none() {
                all.insert("columns".to_owned(), columns(table));
            }
            output::result(self.provenance, Value::Object(all));
        } else {
            let part = if shard == Shard::default() { String::new() } else { format!(", shard {shard} of {points}") };
            let mut all = format!(
                "{} · {} · {}{part}\n",
                self.provenance.model,
                self.manifest.kind.name(),
                counted(table.rows() as u64, "point")
            );
            for warning in self.warnings {
                all += &format!("warning: {warning}\n");
            }
            output::print(&format!("{all}{text}{}", self.places(shard)));
        }
        Outcome::Done
    }

    fn interrupted(&self, done: u64) -> String {
        match &self.storage.dir {
            Some(folder) => format!(
                "interrupted: {} kept in `{}`\n  help: run the same command with --resume to go on",
                match done {
                    1 => "1 point is".to_owned(),
                    _ => format!("{done} points are"),
                },
                folder.display()
            ),
            None => "interrupted: nothing is kept without a folder\n  help: give one with --dir DIR".to_owned(),
        }
    }

    fn places(&self, shard: Shard) -> String {
        let kind = self.manifest.kind.name();
        let mut text = String::new();
        if let Some(folder) = &self.storage.dir {
            let folder = folder.display();
            text += &match shard == Shard::default() {
                true => format!("written: {folder}/{kind}.csv, {folder}/{kind}.parquet\n"),
                false => format!("kept in {folder}; gaitc merge joins all {}\n", counted(shard.count, "shard")),
            };
        }
        if let Some(file) = self.storage.out.as_ref().filter(|_| !output::lost()) {
            text += &format!("written: {}\n", file.display());
        }
        text + &format!("time: {:.1} s\n", self.began.elapsed().as_secs_f64())
    }
}

/// All columns, with units and values; what is not there is null.
fn columns(table: &Table) -> Value {
    let column = |column: &crate::table::Column| {
        let values = match &column.values {
            Values::Number(values) => json!(values),
            Values::Integer(values) => json!(values),
            Values::Text(values) => json!(values),
        };
        let about = json!({ "unit": column.unit().unwrap_or("1"), "doc": column.doc, "values": values });
        (column.name.clone(), about)
    };
    Value::Object(table.columns.iter().map(column).collect())
}
