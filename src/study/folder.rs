//! The folder of a study. Nothing outside it is written: a link or a folder in the place of one of its files is an error.

use super::chunk;
use super::lock::Lock;
use super::manifest::Manifest;
use crate::files::{self, FileError, Problem};
use crate::table::Table;
use std::fs;
use std::io::Error;
use std::path::{Path, PathBuf};
use thiserror::Error as ErrorDerive;

/// Most bytes of a value in a chunk; texts are names.
const LARGEST_VALUE: u64 = 256;
/// A larger file is no manifest.
const LARGEST_MANIFEST: u64 = 16 << 20;

/// Why a folder cannot be used.
#[derive(Debug, ErrorDerive)]
#[non_exhaustive]
pub enum StoreError {
    /// Another process works in it.
    #[error(
        "another run is at work in `{}`{}\n  help: wait until it has ended, or choose another folder with --dir",
        folder.display(), if holder.is_empty() { String::new() } else { format!(" ({holder})") }
    )]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Who it is.
        holder: String,
    },
    /// It holds a study, and nobody asked to go on with it.
    #[error("`{}` holds a study already\n  help: add --resume to go on with it, or choose another folder", .0.display())]
    Exists(PathBuf),
    /// It holds something else.
    #[error("`{}` is not empty, and holds no study\n  help: choose a new folder, or empty this one", .0.display())]
    Foreign(PathBuf),
    /// It holds another study.
    #[error(
        "`{}` holds another study: {difference}\n  help: give the flags of that study (its `study.json` has them), or choose \
         another folder",
        folder.display()
    )]
    Other {
        /// The folder.
        folder: PathBuf,
        /// In what it differs.
        difference: String,
    },
    /// Something stands where a file of the study belongs.
    #[error("`{}` is a link or a folder, where a file of the study belongs\n  help: remove it, or choose another folder", .0.display())]
    NotOwn(PathBuf),
    /// A file of the study is damaged.
    #[error("cannot use `{}`: {why}\n  help: choose another folder", path.display())]
    Damaged {
        /// Which.
        path: PathBuf,
        /// In what way.
        why: String,
    },
    /// Something cannot be read.
    #[error(transparent)]
    Read(#[from] FileError),
    /// Something cannot be written.
    #[error(
        "cannot write `{}`: {}\n  help: make room or give write permission, then run the same command again, a sweep or a basin \
         with --resume: what is complete is kept",
        path.display(), error.why()
    )]
    Write {
        /// What.
        path: PathBuf,
        /// What was in the way.
        error: FileError,
    },
    /// One folder is named twice.
    #[error("`{}` is given twice\n  help: name each folder once", .0.display())]
    Twice(PathBuf),
    /// Two folders have the same points, and not the same of them.
    #[error(
        "`{}` and `{}` both have points {points}, and do not agree on them\n  help: name only one of the two; shards that were computed \
         on processors of different kinds may differ in the last bit",
        one.display(), other.display()
    )]
    Disagree {
        /// The first folder.
        one: PathBuf,
        /// The second.
        other: PathBuf,
        /// The first points in which they differ.
        points: String,
    },
    /// Shards do not make a whole.
    #[error("{0}")]
    Incomplete(String),
}

impl StoreError {
    /// Of something that the system did not let write.
    pub(super) fn not_written(path: &Path, error: Error) -> Self {
        Self::Write { path: path.to_owned(), error: FileError::writing(path, error) }
    }
}

/// A study's folder.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    manifest: Manifest,
    /// Where this process writes to it.
    _lock: Option<Lock>,
}

impl Folder {
    /// Makes the folder of a study, or goes on with it if it is there and `resume` is set.
    ///
    /// # Errors
    /// When it is in use, holds something else, or cannot be written to; nothing has been changed then.
    pub fn open(path: &Path, manifest: Manifest, resume: bool) -> Result<Self, StoreError> {
        let problem = |error| StoreError::not_written(path, error);
        fs::create_dir_all(path).map_err(problem)?;
        if !holds_study(path) && holds_other(path)? {
            return Err(StoreError::Foreign(path.to_owned()));
        }
        let lock = Lock::take(path)?;
        if holds_study(path) {
            if !resume {
                return Err(StoreError::Exists(path.to_owned()));
            }
            let known = read_manifest(path)?;
            let shards = || format!("it is shard {} there, {} here", known.shard, manifest.shard);
            let difference = known.difference(&manifest).or_else(|| (known.shard != manifest.shard).then(shards));
            if let Some(difference) = difference {
                return Err(StoreError::Other { folder: path.to_owned(), difference });
            }
        }
        let folder = Self { path: path.to_owned(), manifest, _lock: Some(lock) };
        let chunks = path.join("chunks");
        if fs::symlink_metadata(&chunks).is_ok_and(|known| !known.is_dir()) {
            return Err(StoreError::NotOwn(chunks));
        }
        fs::create_dir_all(&chunks).map_err(|error| StoreError::not_written(&chunks, error))?;
        for place in [path, &chunks] {
            remove_leftovers(place);
        }
        if !holds_study(path) {
            folder.put("study.json", folder.manifest.text().as_bytes())?;
        }
        Ok(folder)
    }

    /// The folder of a study as it is, to read from.
    ///
    /// # Errors
    /// When it holds no study.
    pub fn read(path: &Path) -> Result<Self, StoreError> {
        Ok(Self { path: path.to_owned(), manifest: read_manifest(path)?, _lock: None })
    }

    /// The manifest of the study that a folder holds, if it holds one.
    pub fn known(path: &Path) -> Option<Manifest> {
        read_manifest(path).ok()
    }

    /// What is studied.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is the same folder, however it is spelt.
    pub fn is_same(&self, other: &Self) -> bool {
        let real = |folder: &Self| folder.path.canonicalize().unwrap_or_else(|_| folder.path.clone());
        real(self) == real(other)
    }

    /// Whether another process is at work in it, as far as that can be seen.
    pub fn is_busy(&self) -> bool {
        Lock::is_held(&self.path)
    }

    /// The rows of a chunk, if it is there whole.
    ///
    /// # Errors
    /// When something else stands in its place, or it cannot be read.
    pub fn chunk(&self, number: u64) -> Result<Option<Table>, StoreError> {
        let path = self.path.join(chunk_name(number));
        is_own(&path)?;
        let rows = self.manifest.rows(number);
        let values = (rows.end - rows.start).saturating_mul(self.manifest.table().columns.len() as u64);
        match files::read(&path, LARGEST_MANIFEST.saturating_add(values.saturating_mul(LARGEST_VALUE))) {
            Ok(bytes) => Ok(chunk::decode(&self.manifest, number, &bytes)),
            Err(error) if error.is_missing() || matches!(error.problem(), Problem::TooLarge { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Writes a chunk.
    ///
    /// # Errors
    /// When it cannot be written; what was there stays.
    pub fn put_chunk(&self, number: u64, rows: &Table) -> Result<(), StoreError> {
        self.put(&chunk_name(number), &chunk::encode(&self.manifest, number, rows))
    }

    /// Writes a file of the folder, whole.
    ///
    /// # Errors
    /// When it cannot be written; what was there stays.
    pub fn put(&self, name: &str, contents: &[u8]) -> Result<(), StoreError> {
        let path = self.path.join(name);
        is_own(&path)?;
        files::write(&path, contents).map_err(|error| StoreError::Write { path, error })
    }
}

fn chunk_name(number: u64) -> String {
    format!("chunks/{number:08}.chunk")
}

/// Refuses links and folders in the place of a file.
pub(super) fn is_own(path: &Path) -> Result<(), StoreError> {
    match fs::symlink_metadata(path) {
        Ok(known) if !known.is_file() => Err(StoreError::NotOwn(path.to_owned())),
        _ => Ok(()),
    }
}

fn holds_study(path: &Path) -> bool {
    fs::symlink_metadata(path.join("study.json")).is_ok()
}

fn read_manifest(path: &Path) -> Result<Manifest, StoreError> {
    let path = path.join("study.json");
    is_own(&path)?;
    let text = files::read_text(&path, LARGEST_MANIFEST)?;
    Manifest::read(&text).map_err(|why| StoreError::Damaged { path, why })
}

/// Whether there is anything but what a run leaves that was killed before it wrote its manifest.
fn holds_other(path: &Path) -> Result<bool, StoreError> {
    let problem = |error| StoreError::from(FileError::reading(path, error));
    for entry in fs::read_dir(path).map_err(problem)? {
        let name = entry.map_err(problem)?.file_name();
        let name = name.to_string_lossy();
        let empty = || fs::read_dir(path.join("chunks")).is_ok_and(|mut entries| entries.next().is_none());
        if !(name == "lock" || name == "chunks" && empty() || is_leftover(&name)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether it is the name of a temporary file of [`files::write`].
fn is_leftover(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".tmp")
}

/// Removes what killed runs have left half written. Only the holder of the lock may do this.
fn remove_leftovers(path: &Path) {
    for entry in fs::read_dir(path).into_iter().flatten().flatten() {
        if is_leftover(&entry.file_name().to_string_lossy()) {
            // That it stays harms nothing.
            let _ = fs::remove_file(entry.path());
        }
    }
}
