//! `--plot FILE`: pictures of a command's result as files, with what made them.

use super::{InputError, output};
use crate::load::Loaded;
use crate::picture::{self, Picture};
use crate::provenance::Provenance;
use gaitc_compiler::front::in_unit;
use std::path::Path;

/// Refuses a file that cannot be written, or is no picture by its name: before the work whose result it is to show.
pub(super) fn check(flag: &str, path: &Path) -> Result<(), InputError> {
    picture::check_name(path).map_err(|error| InputError(format!("{flag} {error}")))
}

/// Writes a picture; what was printed stands even if that fails.
pub(super) fn save(flag: &str, path: &Path, picture: &dyn Picture, provenance: &Provenance) {
    if let Err(error) = picture::write(picture, path, provenance) {
        output::lose(&format!("{flag} {error}"));
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
    let set = loaded.spec.parameters.iter().zip(values);
    let set =
        set.map(|(p, &value)| (p.name.clone(), format!("{} {}", in_unit(value, &p.unit), p.unit).trim_end().into()));
    run.insert("set".to_owned(), toml::Value::Table(set.collect()));
    let fingerprint = loaded.compiled.info().fingerprint.to_owned();
    Provenance { model: loaded.spec.name.clone(), fingerprint, run }
}
