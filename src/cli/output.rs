//! Writing to the terminal: tables, JSON, errors. A closed pipe ends the program quietly.

use crate::provenance::{self, Provenance};
use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;
use serde_json::Value;
use std::io::{ErrorKind, Write};
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};

/// A longer line of a message has text of the user's that is too long to be shown; ...
const LONGEST_LINE: usize = 1000;
/// ... so much of it is, at either end.
const KEPT: usize = 100;

/// Whether something that was printed did not arrive.
static LOST: AtomicBool = AtomicBool::new(false);

/// Prints text to stdout. A reader that has gone away (`| head`) is no error; a full disk is, see [`lost`].
pub(super) fn print(text: &str) {
    let mut out = anstream::stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Said once: what follows is lost for the same reason.
        Err(problem) if problem.kind() != ErrorKind::BrokenPipe && !LOST.swap(true, Ordering::Relaxed) => {
            error(&format!(
                "the result could not be written: {problem}\n  help: make room where stdout goes, and run the same command again"
            ));
        }
        _ => {}
    }
}

/// Says that a part of the result could not be written: the command fails then, but what it printed stands.
pub(super) fn lose(message: &str) {
    LOST.store(true, Ordering::Relaxed);
    error(message);
}

/// Whether a result was lost: the command has failed then, whatever it found.
pub(super) fn lost() -> bool {
    LOST.load(Ordering::Relaxed)
}

/// How much is said on stderr besides errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Talk {
    /// Nothing.
    Quiet,
    /// Warnings, and progress where stderr is a terminal.
    Normal,
    /// Also where values come from and how long the work took.
    Verbose,
}

static TALK: AtomicU8 = AtomicU8::new(1);

/// Sets how much is said.
pub(super) fn talk(talk: Talk) {
    TALK.store(talk as u8, Ordering::Relaxed);
}

/// Whether nothing but errors may be said.
pub(super) fn is_quiet() -> bool {
    TALK.load(Ordering::Relaxed) == Talk::Quiet as u8
}

/// Says something that is no part of the result but that the user has to know.
pub(super) fn warning(message: &str) {
    if !is_quiet() {
        error(&format!("warning: {message}"));
    }
}

/// Says something to those who want to know more.
pub(super) fn note(message: &str) {
    if TALK.load(Ordering::Relaxed) == Talk::Verbose as u8 {
        let _ = writeln!(anstream::stderr(), "{message}");
    }
}

/// A message without the middle of its longest lines: what was typed or read, and is much too long to be what was meant, is
/// not said again in full.
pub(super) fn shortened(message: &str) -> String {
    let one = |line: &str| {
        let length = line.chars().count();
        if length <= LONGEST_LINE {
            return line.to_owned();
        }
        let first: String = line.chars().take(KEPT).collect();
        let last: String = line.chars().skip(length - KEPT).collect();
        format!("{first} ... {last}")
    };
    message.split('\n').map(one).collect::<Vec<_>>().join("\n")
}

/// Prints an error to stderr, with `error:` before it unless it is a rendered diagnostic, which has its own.
pub(super) fn error(message: &str) {
    let message = shortened(message);
    let head = if message.starts_with("error") || message.starts_with("warning") { "" } else { "error: " };
    let mut err = anstream::stderr();
    let _ = writeln!(err, "{head}{}", message.trim_end());
}

/// Prints what is wrong with the arguments, in clap's colours unless it has to be shortened.
pub(super) fn usage(error: &clap::Error) {
    let plain = error.render().to_string();
    if shortened(&plain) == plain {
        // That stderr is gone cannot be told to anybody.
        let _ = error.print();
    } else {
        self::error(&plain);
    }
}

/// Prints a result as JSON, with where it comes from.
pub(super) fn result(provenance: &Provenance, mut result: Value) {
    if let Value::Object(all) = &mut result {
        all.insert(provenance::KEY.to_owned(), provenance.json());
    }
    json(&result);
}

/// Prints a value as JSON.
pub(super) fn json(value: &impl Serialize) {
    // The values printed here have string keys only, so that serialisation cannot fail.
    print(&format!("{}\n", serde_json::to_string_pretty(value).unwrap_or_else(|e| format!("\"{e}\""))));
}

/// Where the meaning of a model's measures stands; nothing where it has none.
pub(super) fn measures_hint(model: &gaitc_compiler::ir::Model) -> String {
    match model.measures.is_empty() {
        true => String::new(),
        false => format!("what the measures mean: gaitc show {}\n", model.name),
    }
}

/// A table without borders: first column to the left, numbers to the right.
pub(super) fn table(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_header(header);
    for row in rows {
        table.add_row(row);
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Left);
    }
    let lines = table.lines().map(|line| format!(" {}\n", line.trim_end()));
    lines.collect()
}
