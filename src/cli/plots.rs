//! `--plot FILE`: pictures of a command's result as files, with what made them. A command that knows several has a flag for each,
//! `--plot-KIND FILE`.

use super::{InputError, output};
use crate::picture::{self, Picture};
use crate::provenance::Provenance;
use std::path::Path;

/// Refuses a file that cannot be written, or is no picture by its name: before the work whose result it is to show.
pub(super) fn check(flag: &str, path: &Path) -> Result<(), InputError> {
    picture::check_name(path).map_err(|error| InputError(format!("{flag}: {error}")))
}

/// Writes a picture; what was printed stands even if that fails.
pub(super) fn save(flag: &str, path: &Path, picture: &dyn Picture, provenance: &Provenance) {
    if let Err(error) = picture::write(picture, path, provenance) {
        output::lose(&format!("{flag}: {error}"));
    }
}
