//! Writing a project: all of its files, or none.

use super::InputError;
use crate::files::FileError;
use std::fs;
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

/// Makes a folder with files (path below it and text). It is not there yet, or empty; messages call it `shown`.
pub(super) fn create(folder: &Path, shown: &str, texts: &[(String, String)]) -> std::result::Result<(), InputError> {
    let exists = folder.symlink_metadata().is_ok();
    if exists {
        let mut entries = fs::read_dir(folder).map_err(|error| match error.kind() {
            ErrorKind::NotADirectory => InputError(format!("`{shown}` is not a folder\n  help: choose another name")),
            _ => FileError::reading(folder, error).into(),
        })?;
        if entries.next().is_some() {
            let message = format!("`{shown}` is not empty, and nothing in it is overwritten");
            return Err(InputError(format!("{message}\n  help: choose a folder that does not exist yet")));
        }
    }
    let result = if exists { fill(folder, texts) } else { make(folder, texts) };
    result.map_err(|error| {
        let error = FileError::writing(Path::new(shown), error);
        InputError(format!("the project cannot be written to `{shown}`: {}\n  help: {}", error.why(), error.help()))
    })
}

/// A folder that is not there: written beside its place, then given its name.
fn make(folder: &Path, texts: &[(String, String)]) -> Result<()> {
    let parent = folder.parent().unwrap_or(Path::new("/"));
    let made = make_parents(parent)?;
    let temporary = Scratch::new(parent).inspect_err(|_| remove_empty(&made))?;
    let written = write(&temporary.0, texts).and_then(|()| fs::rename(&temporary.0, folder));
    if written.is_err() {
        drop(temporary);
        remove_empty(&made);
    }
    written
}

/// An empty folder: written inside it, then moved up.
fn fill(folder: &Path, texts: &[(String, String)]) -> Result<()> {
    let temporary = Scratch::new(folder)?;
    write(&temporary.0, texts)?;
    let mut moved: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(&temporary.0)? {
        let result = entry.and_then(|entry| {
            let place = folder.join(entry.file_name());
            if place.symlink_metadata().is_ok() {
                return Err(Error::from(ErrorKind::AlreadyExists));
            }
            fs::rename(entry.path(), &place)?;
            moved.push(place);
            Ok(())
        });
        if let Err(error) = result {
            // Back again, so that they are removed with the rest.
            for place in &moved {
                let _ = fs::rename(place, temporary.0.join(place.file_name().unwrap_or_default()));
            }
            return Err(error);
        }
    }
    Ok(())
}

fn write(folder: &Path, texts: &[(String, String)]) -> Result<()> {
    for (path, text) in texts {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)?;
        }
        fs::write(path, text)?;
    }
    Ok(())
}

/// Makes a folder and those above it; the ones that were made, the lowest first.
fn make_parents(folder: &Path) -> Result<Vec<PathBuf>> {
    let missing = folder.ancestors().take_while(|folder| !folder.exists());
    let missing: Vec<PathBuf> = missing.filter(|f| !f.as_os_str().is_empty()).map(Path::to_path_buf).collect();
    fs::create_dir_all(folder).inspect_err(|_| remove_empty(&missing))?;
    Ok(missing)
}

/// Removes folders that are empty.
fn remove_empty(folders: &[PathBuf]) {
    for folder in folders {
        let _ = fs::remove_dir(folder);
    }
}

/// A folder of passage, which is gone in the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(parent: &Path) -> Result<Self> {
        let path = parent.join(format!(".gaitc-new-{}", std::process::id()));
        fs::create_dir(&path)?;
        Ok(Self(path))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // After a rename there is nothing to remove.
        let _ = fs::remove_dir_all(&self.0);
    }
}
