//! `--plot [KIND=]FILE`: pictures of a command's result as files, with what made them.
//!
//! A command that knows one picture takes `--plot FILE`. One that knows several takes the kind before the file, any number of
//! times; the first of its kinds is the one that is drawn where no kind is given.

use super::{InputError, inputs, output};
use crate::picture::{self, Picture};
use crate::provenance::Provenance;
use std::path::{Path, PathBuf};

/// Refuses a file that cannot be written, or is no picture by its name: before the work whose result it is to show.
pub(super) fn check(flag: &str, path: &Path) -> Result<(), InputError> {
    picture::check_name(path).map_err(|error| InputError(format!("{flag} {error}")))
}

/// Kinds and files of all `--plot` flags, checked. `kinds` are names and what they stand for.
pub(super) fn wanted<K: Copy>(flags: &[String], kinds: &[(&str, K)]) -> Result<Vec<(K, PathBuf)>, InputError> {
    let mut all: Vec<(K, PathBuf)> = Vec::new();
    for text in flags {
        let (kind, path) = split(text, kinds)?;
        check("--plot", &path)?;
        if all.iter().any(|(_, other)| *other == path) {
            let help = "help: name two files, one for each picture";
            return Err(InputError(format!("--plot: `{}` is given twice\n  {help}", path.display())));
        }
        all.push((kind, path));
    }
    Ok(all)
}

fn split<K: Copy>(text: &str, kinds: &[(&str, K)]) -> Result<(K, PathBuf), InputError> {
    let names: Vec<&str> = kinds.iter().map(|(name, _)| *name).collect();
    match text.split_once('=') {
        // What stands before `=` is part of a file's name where no kind could be meant.
        Some((name, path)) if !name.contains(['/', '\\', '.']) => {
            let kind = kinds.iter().find(|(known, _)| *known == name);
            let kind = kind.ok_or_else(|| inputs::unknown("--plot", "kind of picture", name, &names))?;
            Ok((kind.1, PathBuf::from(path)))
        }
        _ => match kinds.first() {
            Some((_, kind)) => Ok((*kind, PathBuf::from(text))),
            None => Err(inputs::unknown("--plot", "kind of picture", text, &names)),
        },
    }
}

/// Writes a picture; what was printed stands even if that fails.
pub(super) fn save(flag: &str, path: &Path, picture: &dyn Picture, provenance: &Provenance) {
    if let Err(error) = picture::write(picture, path, provenance) {
        output::lose(&format!("{flag} {error}"));
    }
}
