//! `--plot [KIND=]FILE`: pictures of a command's result as files, with what made them.
//!
//! A command that knows one picture takes `--plot FILE`. One that knows several takes the kind before the file, any number of
//! times; the first of its kinds is the one that is drawn where no kind is given.

use super::{InputError, inputs, output};
use crate::load::Loaded;
use crate::picture::{self, Picture};
use crate::provenance::Provenance;
use gaitc_compiler::front::in_unit;
use std::path::{Path, PathBuf};

/// Refuses a file that cannot be written, or is no picture by its name: before the work whose result it is to show.
pub(super) fn check(path: &Path) -> Result<(), InputError> {
    picture::check_name(path).map_err(|error| InputError(format!("--plot {error}")))
}

/// Kinds and files of all `--plot` flags, checked. `kinds` are names and what they stand for.
pub(super) fn wanted<K: Copy>(flags: &[String], kinds: &[(&str, K)]) -> Result<Vec<(K, PathBuf)>, InputError> {
    let mut all: Vec<(K, PathBuf)> = Vec::new();
    for text in flags {
        let (kind, path) = split(text, kinds)?;
        check(&path)?;
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
pub(super) fn save(path: &Path, picture: &dyn Picture, provenance: &Provenance) {
    if let Err(error) = picture::write(picture, path, provenance) {
        output::lose(&format!("--plot {error}"));
    }
}

/// What made the result of a command: the model, the value of every parameter, and the flags that change the result.
pub(super) fn provenance(
    loaded: &Loaded,
    command: &str,
    values: &[f64],
    flags: impl IntoIterator<Item = (&'static str, toml::Value)>,
) -> Provenance {
    let mut run = toml::Table::new();
    run.insert("command".to_owned(), command.into());
    run.insert("model".to_owned(), loaded.spec.name.clone().into());
    run.extend(flags.into_iter().map(|(flag, value)| (flag.to_owned(), value)));
    let text = |value: f64, unit: &str| format!("{} {unit}", in_unit(value, unit)).trim_end().to_owned();
    let set = loaded.spec.parameters.iter().zip(values);
    let set = set.map(|(p, &value)| (p.name.clone(), text(value, &p.unit).into()));
    run.insert("set".to_owned(), toml::Value::Table(set.collect()));
    let fingerprint = loaded.compiled.info().fingerprint.to_owned();
    Provenance { model: loaded.spec.name.clone(), fingerprint, run }
}
