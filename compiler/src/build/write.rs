//! Files that are either whole or not there, and untouched when nothing changed.

use super::BuildError;
use std::fs;
use std::path::Path;

/// Writes a file if its contents differ; says whether it did. The file appears whole or not at all.
pub(super) fn write_if_different(path: &Path, text: &str) -> Result<bool, BuildError> {
    if fs::read(path).is_ok_and(|old| old == text.as_bytes()) {
        return Ok(false);
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(BuildError::io(folder))?;
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
    let result = fs::write(&temporary, text).and_then(|()| fs::rename(&temporary, path));
    if result.is_err() {
        // What is left of a failed write is of no use; that it may not be there is no error.
        let _ = fs::remove_file(&temporary);
    }
    result.map_err(BuildError::io(path))?;
    Ok(true)
}
