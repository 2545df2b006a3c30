//! `--out FILE` and its like: tables of a command's result as files, with what made them.

use super::{InputError, output};
use crate::files;
use crate::provenance::Provenance;
use crate::table::{self, Format, Table};
use std::path::Path;

/// Refuses a file that cannot be written, or is no table by its name: before the work whose result it is to hold.
pub(super) fn check(flag: &str, path: &Path) -> Result<(), InputError> {
    Format::of(path).map_err(|message| InputError(format!("{flag}: {message}")))?;
    files::try_place(path).map_err(|error| InputError(format!("{flag}: {error}")))
}

/// Writes a table; what was printed stands even if that fails.
pub(super) fn save(flag: &str, path: &Path, table: &Table, provenance: &Provenance) {
    if let Err(error) = table::write(table, path, provenance) {
        output::lose(&format!("{flag}: {error}"));
    }
}
