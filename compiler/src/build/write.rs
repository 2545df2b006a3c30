//! Files that stay untouched when nothing changed.

use super::BuildError;
use crate::files;
use std::fs;
use std::path::Path;

/// Writes a file if its contents differ; says whether it did. The file appears whole or not at all.
pub(super) fn write_if_different(path: &Path, text: &str) -> Result<bool, BuildError> {
    if fs::read(path).is_ok_and(|old| old == text.as_bytes()) {
        return Ok(false);
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(BuildError::writing(folder))?;
    }
    files::write(path, text.as_bytes())?;
    Ok(true)
}
