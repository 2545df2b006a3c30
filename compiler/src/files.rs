//! Files: read within bounds, written whole or not at all. What goes wrong says what to do.

mod error;

pub use error::{FileError, Problem};

use std::fs::{self, File};
use std::io::{Error, ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};

/// More links than this, one behind the other, lead in a circle.
const MOST_LINKS: usize = 40;

/// Reads a regular file of at most `most` bytes. A pipe or a device, which may never end, is refused before anything is read of it.
///
/// # Errors
/// When it is no regular file, is larger, or the system refuses.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>, FileError> {
    // A file can grow, and those of `/proc` say that they are empty: what counts is what can be read.
    let bytes = read_start(path, most.saturating_add(1))?;
    if bytes.len() as u64 > most {
        let length = fs::metadata(path).map_or(0, |known| known.len());
        let problem = Problem::TooLarge { bytes: length.max(bytes.len() as u64), most };
        return Err(FileError::reading(path, problem));
    }
    Ok(bytes)
}

/// The first `most` bytes of a regular file.
///
/// # Errors
/// When it is no regular file, or the system refuses.
pub fn read_start(path: &Path, most: u64) -> Result<Vec<u8>, FileError> {
    let fail = |error: Error| FileError::reading(path, error);
    // Opened first, a pipe would wait for somebody to write to it.
    let known = fs::metadata(path).map_err(fail)?;
    if !known.is_file() {
        return Err(FileError::reading(path, Problem::of_kind(&known)));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes)).map_err(fail)?;
    Ok(bytes)
}

/// Reads a regular file of text, as [`read()`] does.
///
/// # Errors
/// Those of [`read()`], and when it is not UTF-8.
pub fn read_text(path: &Path, most: u64) -> Result<String, FileError> {
    String::from_utf8(read(path, most)?).map_err(|_| FileError::reading(path, Problem::NotText))
}

/// Writes a file: first beside its place, then under its name, so that what stood there stays until the new contents are
/// complete. A link is followed, also one to a file that is not there yet: the file that it names is replaced, not the link. What is no
/// regular file (a pipe, `/dev/stdout`) is written to as it is. A file that is write-protected is not replaced.
///
/// # Errors
/// Those of the file system; the old file is then untouched.
pub fn write(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    let place = writable(path)?;
    let fail = |error: Error| FileError::writing(path, error);
    if fs::metadata(&place).is_ok_and(|known| !known.is_file()) {
        return fs::OpenOptions::new()
            .write(true)
            .open(&place)
            .and_then(|mut file| file.write_all(contents))
            .map_err(fail);
    }
    let temporary = beside(&place);
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
    written.map_err(fail)
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
pub fn try_place(path: &Path) -> Result<(), FileError> {
    let place = writable(path)?;
    if fs::metadata(&place).is_ok_and(|known| !known.is_file()) {
        return Ok(());
    }
    let temporary = beside(&place);
    let tried = File::create_new(&temporary).and_then(|_| fs::remove_file(&temporary));
    tried.map_err(|error| FileError::writing(path, error))
}

/// The file that a path names, behind all links, unless it is one that must not be replaced.
fn writable(path: &Path) -> Result<PathBuf, FileError> {
    let place = place_of(path).map_err(|error| FileError::writing(path, error))?;
    match fs::metadata(&place) {
        Ok(known) if known.is_dir() => Err(FileError::writing(path, Problem::Folder)),
        Ok(known) if known.is_file() && known.permissions().readonly() => {
            Err(FileError::writing(path, Problem::Protected))
        }
        _ => Ok(place),
    }
}

/// Where a file is written before it gets its name.
fn beside(place: &Path) -> PathBuf {
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    place.with_file_name(format!(".{name}.{}.tmp", std::process::id()))
}

/// The file that a path names, behind all links; it need not be there.
fn place_of(path: &Path) -> std::io::Result<PathBuf> {
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
