//! Why a file could not be read or written, and what to do.

use std::fmt;
use std::fs::Metadata;
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// A file, or a folder, that could not be read or written. Its text has a `help:` line.
#[derive(Debug)]
pub struct FileError {
    writing: bool,
    path: PathBuf,
    problem: Problem,
}

/// What was in the way.
#[derive(Debug)]
#[non_exhaustive]
pub enum Problem {
    /// What the system said.
    System(Error),
    /// A folder, where a file is meant.
    Folder,
    /// A pipe or a device, which may never end.
    NotRegular,
    /// It is larger than what is meant can be.
    TooLarge {
        /// Its size in bytes, or as much of it as was seen.
        bytes: u64,
        /// The largest that is read.
        most: u64,
    },
    /// It is not UTF-8.
    NotText,
    /// Nobody may write to it.
    Protected,
}

impl From<Error> for Problem {
    fn from(error: Error) -> Self {
        match error.kind() {
            ErrorKind::IsADirectory => Self::Folder,
            _ => Self::System(error),
        }
    }
}

impl Problem {
    /// What is wrong with what is no regular file.
    pub(super) fn of_kind(known: &Metadata) -> Self {
        if known.is_dir() { Self::Folder } else { Self::NotRegular }
    }
}

impl FileError {
    /// Of something that was to be read.
    pub fn reading(path: &Path, problem: impl Into<Problem>) -> Self {
        Self { writing: false, path: path.to_owned(), problem: problem.into() }
    }

    /// Of something that was to be written.
    pub fn writing(path: &Path, problem: impl Into<Problem>) -> Self {
        Self { writing: true, path: path.to_owned(), problem: problem.into() }
    }

    /// Which file or folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What was in the way.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Whether there is nothing of that name.
    pub fn is_missing(&self) -> bool {
        matches!(&self.problem, Problem::System(error) if error.kind() == ErrorKind::NotFound)
    }

    /// What is wrong, without the file's name.
    pub fn why(&self) -> String {
        match &self.problem {
            Problem::System(_) if self.is_missing() && self.writing => "there is no such folder".to_owned(),
            Problem::System(_) if self.is_missing() => "there is no such file".to_owned(),
            Problem::System(error) => match error.kind() {
                ErrorKind::NotADirectory => "a part of the path is not a folder".to_owned(),
                ErrorKind::AlreadyExists => "something is in the way".to_owned(),
                _ => plainly(error),
            },
            Problem::Folder => "this is a folder".to_owned(),
            Problem::NotRegular => "this is a pipe or a device, not a regular file".to_owned(),
            Problem::TooLarge { bytes, most } => format!("this file has {bytes} bytes; {most} are read at most"),
            Problem::NotText => "this file is not UTF-8 text".to_owned(),
            Problem::Protected => "this file is write-protected".to_owned(),
        }
    }

    /// What to do.
    pub fn help(&self) -> &'static str {
        match (&self.problem, self.writing) {
            (Problem::System(error), true) => to_write(error.kind()),
            (Problem::System(error), false) => to_read(error.kind()),
            (Problem::Folder, _) => "name a file",
            (Problem::NotRegular, _) => "save what it gives as a file, and name that",
            (Problem::TooLarge { .. }, _) => "name another file: this one is not what is looked for",
            (Problem::NotText, _) => "name a text file, or save this one as UTF-8",
            (Problem::Protected, _) => "name another file, or give write permission (`chmod u+w`)",
        }
    }
}

fn to_write(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::NotFound => "make the folder first, or choose one that exists",
        ErrorKind::NotADirectory => "choose another place",
        ErrorKind::AlreadyExists => {
            "choose another place, or remove what is there: a file where a folder is meant, or what a killed run has left"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "make room, or choose a place on another disk, and run the same command again"
        }
        ErrorKind::InvalidFilename => "choose a shorter name",
        _ => "choose a place that can be written",
    }
}

fn to_read(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::NotFound => "check its name: it is looked for from the folder in which gaitc runs",
        ErrorKind::PermissionDenied => "give read permission (`chmod u+r`), or name another",
        ErrorKind::NotADirectory => "check the path",
        _ => "name another that can be read",
    }
}

/// What the system says, without the number that it gives it.
fn plainly(error: &Error) -> String {
    let text = error.to_string();
    text.split_once(" (os error").map_or(text.as_str(), |(words, _)| words).to_owned()
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verb = if self.writing { "write" } else { "read" };
        write!(f, "cannot {verb} `{}`: {}\n  help: {}", self.path.display(), self.why(), self.help())
    }
}

impl std::error::Error for FileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.problem {
            Problem::System(error) => Some(error),
            _ => None,
        }
    }
}
