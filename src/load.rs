//! A compiled model together with the values of its spec: parameter values, problems and units are data, read at run
//! time from the spec file where there is one, else from the text that was embedded at build time.

use crate::files::FileError;
use crate::models::MODELS;
use gaitc_compiler::diagnostic;
use gaitc_compiler::front::{self, Library, Observations, flags::suggest};
use gaitc_compiler::ir;
use gaitc_compiler::ir::canonical::fingerprint;
use gaitc_runtime::registry::{Compiled, Entry};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A model ready to run.
pub struct Loaded {
    /// The compiled dynamics.
    pub compiled: &'static dyn Compiled,
    /// The spec: names, units, values, problems.
    pub spec: ir::Model,
    /// What can be observed along a run.
    pub observations: Observations,
    /// Hash of the texts of the spec and its parts.
    pub digest: String,
    /// Where the values come from; `None` is the text embedded at build time.
    pub file: Option<PathBuf>,
}

/// Why a model cannot be loaded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// No compiled model has that name.
    #[error("no compiled model is named `{name}`\n  help: {help}")]
    Unknown {
        /// The name asked for.
        name: String,
        /// What to do.
        help: String,
    },
    /// The spec file cannot be read.
    #[error(transparent)]
    Read(#[from] FileError),
    /// The spec has errors; the text is the rendered diagnostics.
    #[error("{0}")]
    Spec(String),
    /// The spec's equations are not the compiled ones.
    #[error(
        "the equations of `{}` differ from those that this program was built with\n  help: rebuild it (`cargo build \
         --release`), or give another folder with `--specs DIR`; changed parameter values alone need no rebuild",
        .0.display()
    )]
    Stale(PathBuf),
}

/// The compiled model `name` with the values of its spec in `specs` (else in `./specs`, else those embedded).
///
/// # Errors
/// When there is no such model, its spec cannot be read or is wrong, or its equations are not the compiled ones.
pub fn load(name: &str, specs: Option<&Path>) -> Result<Loaded, LoadError> {
    let folder = specs.unwrap_or(Path::new("specs"));
    let entry = find(name, folder)?;
    let path = folder.join(format!("{name}.toml"));
    // A folder that was asked for has to have the file; the default folder need not.
    // A link that leads nowhere is there, and is reported when it is read.
    if specs.is_none() && path.symlink_metadata().is_err() {
        return embedded(entry);
    }
    let parsed = front::parse_file(&path)?;
    let (digest, (spec, observations)) = (parsed.digest(), accept(parsed)?);
    if fingerprint(&spec) != entry.compiled.info().fingerprint {
        return Err(LoadError::Stale(path));
    }
    Ok(Loaded { compiled: entry.compiled, spec, observations, digest, file: Some(path) })
}

/// A compiled model with the values embedded at build time.
///
/// # Errors
/// When the embedded text does not match the compiled equations (a generated file was not rebuilt).
pub fn embedded(entry: &Entry) -> Result<Loaded, LoadError> {
    let path = PathBuf::from(format!("specs/{}.toml", entry.compiled.info().name));
    let parsed = front::parse_with(&path, entry.spec, Library::Texts(entry.parts));
    let (digest, (spec, observations)) = (parsed.digest(), accept(parsed)?);
    if fingerprint(&spec) != entry.compiled.info().fingerprint {
        return Err(LoadError::Stale(path));
    }
    Ok(Loaded { compiled: entry.compiled, spec, observations, digest, file: None })
}

fn find(name: &str, folder: &Path) -> Result<&'static Entry, LoadError> {
    if let Some(entry) = MODELS.iter().find(|entry| entry.compiled.info().name == name) {
        return Ok(entry);
    }
    let names: Vec<&str> = MODELS.iter().map(|entry| entry.compiled.info().name).collect();
    let help = if !name.contains(['/', '\\']) && folder.join(format!("{name}.toml")).exists() {
        format!("`{name}.toml` is in `{}` but was not compiled in: rebuild (`cargo build --release`)", folder.display())
    } else if let Some(close) = suggest(name, names.iter().copied()) {
        format!("did you mean `{close}`?")
    } else {
        format!("compiled models: {}", names.join(", "))
    };
    Err(LoadError::Unknown { name: name.to_owned(), help })
}

fn accept(parsed: front::Parsed) -> Result<(ir::Model, Observations), LoadError> {
    match parsed.model.zip(parsed.observations) {
        Some(accepted) => Ok(accepted),
        None => Err(LoadError::Spec(diagnostic::render(&parsed.diagnostics, &parsed.sources, false))),
    }
}

impl Loaded {
    /// Parameter values in SI units.
    pub fn parameters(&self) -> Vec<f64> {
        self.spec.parameters.iter().map(|p| p.value).collect()
    }

    /// Initial memory.
    pub fn memory(&self) -> Vec<f64> {
        // Memory counts steps: far below 2^53, so the conversion is exact.
        self.spec.memory.iter().map(|m| m.initial as f64).collect()
    }

    /// First guess of the section coordinates, SI units; empty without a section.
    pub fn start(&self) -> Vec<f64> {
        self.spec.section.as_ref().map_or_else(Vec::new, |section| section.start.clone())
    }

    /// Index of a parameter by name.
    pub fn parameter(&self, name: &str) -> Option<usize> {
        self.spec.parameters.iter().position(|p| p.name == name)
    }

    /// State indices of the section coordinates.
    pub fn coordinates(&self) -> &[usize] {
        self.spec.section.as_ref().map_or(&[], |section| &section.coordinates)
    }
}
