//! Writing to the terminal: tables, JSON, errors. A closed pipe ends the program quietly.

use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;
use std::io::{ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether something that was printed did not arrive.
static LOST: AtomicBool = AtomicBool::new(false);

/// Prints text to stdout. A reader that has gone away (`| head`) is no error; a full disk is, see [`lost`].
pub(super) fn print(text: &str) {
    let mut out = anstream::stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        // Said once: what follows is lost for the same reason.
        Err(problem) if problem.kind() != ErrorKind::BrokenPipe && !LOST.swap(true, Ordering::Relaxed) => {
            error(&format!("the result could not be written: {problem}"));
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

/// Prints an error to stderr, with `error:` before it unless it is a rendered diagnostic, which has its own.
pub(super) fn error(message: &str) {
    let head = if message.starts_with("error") || message.starts_with("warning") { "" } else { "error: " };
    let mut err = anstream::stderr();
    let _ = writeln!(err, "{head}{}", message.trim_end());
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
