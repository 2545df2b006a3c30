//! Reading the specs of a folder: the one place where the build driver meets the front end.

use super::{BuildError, stamp};
use crate::front;
use crate::ir::canonical::fingerprint;
use crate::valid::{Validated, validate};
use std::fs;
use std::path::{Path, PathBuf};

/// A spec that was read, checked and validated.
pub(super) struct Spec {
    /// The model's name, which is the file's.
    pub(super) name: String,
    pub(super) path: PathBuf,
    /// Its parts: the name by which the spec finds each, and its file.
    pub(super) parts: Vec<(String, PathBuf)>,
    pub(super) model: Validated,
    pub(super) fingerprint: String,
    /// Warnings of the front end, rendered; empty when there are none.
    pub(super) warnings: String,
    /// Hash of all that the generated text depends on.
    pub(super) source_hash: String,
}

/// All specs of a folder, by name. Only its own `*.toml` files are models; folders in it hold parts.
pub(super) fn read_folder(folder: &Path, runtime_path: &str) -> Result<Vec<Spec>, BuildError> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(BuildError::reading(folder))? {
        let path = entry.map_err(BuildError::reading(folder))?.path();
        // Editors and file managers leave hidden files about.
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if !hidden && path.is_file() && path.extension().is_some_and(|extension| extension == "toml") {
            paths.push(path);
        }
    }
    // The order of a directory is not the same everywhere.
    paths.sort();
    let (mut specs, mut reports) = (Vec::new(), Vec::new());
    for path in paths {
        match read(&path, runtime_path)? {
            Ok(spec) => specs.push(spec),
            Err(report) => reports.push(report),
        }
    }
    if reports.is_empty() { Ok(specs) } else { Err(BuildError::Specs(reports.join("\n"))) }
}

/// One spec, or the report on what is wrong with it.
fn read(path: &Path, runtime_path: &str) -> Result<Result<Spec, String>, BuildError> {
    let parsed = front::parse_file(path)?;
    let warnings = crate::diagnostic::render(&parsed.diagnostics, &parsed.sources, false);
    let Some(model) = parsed.model else {
        return Ok(Err(warnings));
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let parts = parsed.parts.into_iter().map(|name| (name.clone(), folder.join(name))).collect();
    let wrong = |messages: &[String]| messages.iter().map(|m| format!("error: {}: {m}\n", path.display())).collect();
    if path.file_stem().is_none_or(|stem| stem != model.name.as_str()) {
        let hint = format!("the model is called `{0}`; call the file `{0}.toml`, or the model as the file", model.name);
        return Ok(Err(wrong(&[hint])));
    }
    Ok(match validate(model) {
        Err(defects) => Err(wrong(&defects)),
        Ok(model) => {
            let fingerprint = fingerprint(model.model());
            Ok(Spec {
                name: model.model().name.clone(),
                path: path.to_path_buf(),
                parts,
                warnings,
                source_hash: stamp::source_hash(&model, &fingerprint, runtime_path),
                fingerprint,
                model,
            })
        }
    })
}
