//! Files of results: whole or not there, whatever happens while they are written.

use std::fs::{self, File};
use std::io::{Error, ErrorKind, Result, Write};
use std::path::{Path, PathBuf};

/// More links than this, one behind the other, lead in a circle.
const MOST_LINKS: usize = 40;

/// Writes a file: first beside its place, then under its name, so that what stood there stays until the new contents are
/// complete. A link is followed, also one to a file that is not there yet: the file that it names is replaced, not the link. What is no regular file (a pipe,
/// `/dev/stdout`) is written to as it is.
///
/// # Errors
/// Those of the file system; the old file is then untouched.
pub fn write(path: &Path, contents: &[u8]) -> Result<()> {
    let place = place_of(path)?;
    if fs::metadata(&place).is_ok_and(|known| !known.is_file()) {
        return fs::OpenOptions::new().write(true).open(&place)?.write_all(contents);
    }
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    let temporary = place.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
    let written = File::create_new(&temporary).and_then(|mut file| {
        if let Ok(known) = fs::metadata(&place) {
            // Who may read what stood there may read what replaces it, and nobody else.
            file.set_permissions(known.permissions())?;
        }
        file.write_all(contents)?;
        // Renamed before its contents are on the disk, a file could be empty after a power cut.
        file.sync_all()?;
        fs::rename(&temporary, &place)
    });
    if written.is_err() {
        // What is left of a failed write is of no use; that it may not be there is no error.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Whether two names are those of one file, however they are spelt; of files that are not there yet, too.
pub fn is_same(a: &Path, b: &Path) -> bool {
    let whole = |path: &Path| {
        let place = place_of(path).unwrap_or_else(|_| path.to_owned());
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        fs::canonicalize(folder).map_or(place.clone(), |folder| folder.join(place.file_name().unwrap_or_default()))
    };
    whole(a) == whole(b)
}

/// Whether a file could be written there, found out without touching it: before the work whose result it is to hold.
///
/// # Errors
/// Those of the file system.
pub fn try_place(path: &Path) -> Result<()> {
    let place = place_of(path)?;
    match fs::metadata(&place) {
        Ok(known) if known.is_dir() => Err(Error::new(ErrorKind::IsADirectory, "this is a folder")),
        Ok(known) if !known.is_file() => Ok(()),
        _ => {
            let name = place.file_name().unwrap_or_default().to_string_lossy();
            let temporary = place.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
            File::create_new(&temporary)?;
            fs::remove_file(&temporary)
        }
    }
}

/// The file that a path names, behind all links; it need not be there.
fn place_of(path: &Path) -> Result<PathBuf> {
    let mut place = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::canonicalize(&place) {
            Ok(known) => return Ok(known),
            Err(problem) if problem.kind() != ErrorKind::NotFound => return Err(problem),
            Err(_) => {}
        }
        if !fs::symlink_metadata(&place).is_ok_and(|known| known.is_symlink()) {
            return Ok(place);
        }
        // Where a relative link leads is counted from the folder that it stands in.
        let target = fs::read_link(&place)?;
        place = place.parent().unwrap_or(Path::new("")).join(target);
    }
    Err(Error::new(ErrorKind::InvalidInput, "links lead in a circle"))
}
