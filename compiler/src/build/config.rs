//! Settings of a build, and the build itself.

use super::place::Folders;
use super::spec::{Spec, read_folder};
use super::write::write_if_different;
use super::{BuildError, stamp};
use crate::back::rust::{Mounted, Options, emit, registry};
use crate::casadi;
use crate::casadi::environment::{Search, VARIABLE};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// What a build does; see the [module](super) for where files go.
#[derive(Clone, Debug)]
pub struct Config {
    specs: PathBuf,
    generated: PathBuf,
    runtime_path: String,
    manifest_dir: Option<PathBuf>,
    out_dir: Option<PathBuf>,
    python: Option<Search>,
    regenerate: bool,
}

/// What a build did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// The folder whose `mod.rs` is mounted.
    pub mounted: PathBuf,
    /// Models that CasADi derived again.
    pub derived: Vec<String>,
    /// Files that were written because their contents changed.
    pub written: Vec<PathBuf>,
    /// Generated files of specs that are gone.
    pub deleted: Vec<PathBuf>,
}

/// A committed file that is not what the specs give.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stale {
    /// Which.
    pub path: PathBuf,
    /// What is wrong with it.
    pub reason: &'static str,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            specs: "specs".into(),
            generated: "generated".into(),
            runtime_path: "::gaitc_runtime".into(),
            manifest_dir: None,
            out_dir: None,
            python: None,
            regenerate: false,
        }
    }
}

impl Config {
    /// The defaults: `specs/`, `generated/`, `::gaitc_runtime`, folders as cargo tells a build script.
    pub fn new() -> Self {
        Self::default()
    }

    /// Folder of the specs, relative to the manifest.
    #[must_use]
    pub fn specs(mut self, folder: impl Into<PathBuf>) -> Self {
        self.specs = folder.into();
        self
    }

    /// Folder of committed generated files, relative to the manifest.
    #[must_use]
    pub fn generated(mut self, folder: impl Into<PathBuf>) -> Self {
        self.generated = folder.into();
        self
    }

    /// Path of the runtime crate as the crate with the generated code sees it.
    #[must_use]
    pub fn runtime_path(mut self, path: impl Into<String>) -> Self {
        self.runtime_path = path.into();
        self
    }

    /// Folder of the manifest; `CARGO_MANIFEST_DIR` unless set.
    #[must_use]
    pub fn manifest_dir(mut self, folder: impl Into<PathBuf>) -> Self {
        self.manifest_dir = Some(folder.into());
        self
    }

    /// Folder for what a build script writes; `OUT_DIR` unless set.
    #[must_use]
    pub fn out_dir(mut self, folder: impl Into<PathBuf>) -> Self {
        self.out_dir = Some(folder.into());
        self
    }

    /// Where to look for Python; `GAITC_PYTHON` and a folder below the target directory unless set.
    #[must_use]
    pub fn python(mut self, search: Search) -> Self {
        self.python = Some(search);
        self
    }

    /// Trust no stamp: derive every model again.
    #[must_use]
    pub fn regenerate(mut self) -> Self {
        self.regenerate = true;
        self
    }

    /// Compiles the specs, and tells cargo when to do it again.
    ///
    /// # Errors
    /// When a spec is wrong, code has to be derived and there is no Python for it, or a file cannot be read or written.
    pub fn compile(&self) -> Result<Report, BuildError> {
        let folders = self.folders()?;
        tell_cargo(&folders);
        let specs = read_folder(&folders.specs, &self.runtime_path)?;
        pass_warnings(&specs);
        let mut report = Report::default();
        if !folders.is_checkout() && !self.regenerate && self.differences(&folders, &specs, None)?.is_empty() {
            report.mounted.clone_from(&folders.tree);
        } else {
            report.mounted = if folders.is_checkout() { folders.tree.clone() } else { folders.private() };
            self.update(&folders, &specs, &mut report)?;
        }
        mount(&folders, &mut report)?;
        Ok(report)
    }

    /// Which committed files are not what the specs give, without writing anything. With [`Config::regenerate`] all
    /// models are derived again and compared byte for byte; otherwise stamps are compared and no Python runs.
    ///
    /// # Errors
    /// When a spec is wrong or a file cannot be read; with `regenerate` also when the symbolic step fails.
    pub fn check(&self) -> Result<Vec<Stale>, BuildError> {
        let folders = self.folders()?;
        let specs = read_folder(&folders.specs, &self.runtime_path)?;
        let texts = if self.regenerate {
            let all: Vec<&Spec> = specs.iter().collect();
            Some(self.derive(&folders, &all)?)
        } else {
            None
        };
        self.differences(&folders, &specs, texts.as_ref())
    }

    fn folders(&self) -> Result<Folders, BuildError> {
        let known = |set: &Option<PathBuf>, variable: &'static str| {
            set.clone()
                .or_else(|| std::env::var_os(variable).map(PathBuf::from))
                .ok_or(BuildError::NotInBuildScript(variable))
        };
        let manifest = known(&self.manifest_dir, "CARGO_MANIFEST_DIR")?;
        Ok(Folders {
            out: known(&self.out_dir, "OUT_DIR")?,
            specs: manifest.join(&self.specs),
            tree: manifest.join(&self.generated),
            manifest,
        })
    }

    /// Brings the generated files of a folder up to date.
    fn update(&self, folders: &Folders, specs: &[Spec], report: &mut Report) -> Result<(), BuildError> {
        let folder = report.mounted.clone();
        let mut texts = BTreeMap::new();
        if !self.regenerate {
            for spec in specs {
                // A file of the source tree that fits spares a packaged crate the symbolic step.
                let known = [&folder, &folders.tree].into_iter().find_map(|folder| fitting(folder, spec));
                texts.extend(known.map(|text| (spec.name.clone(), text)));
            }
        }
        let missing: Vec<&Spec> = specs.iter().filter(|spec| !texts.contains_key(&spec.name)).collect();
        report.derived = missing.iter().map(|spec| spec.name.clone()).collect();
        texts.extend(self.derive(folders, &missing)?);
        let mut write = |path: PathBuf, text: &str| -> Result<(), BuildError> {
            if write_if_different(&path, text)? {
                report.written.push(path);
            }
            Ok(())
        };
        for (name, text) in &texts {
            write(file_of(&folder, name), text)?;
        }
        write(folder.join("mod.rs"), &self.registry(folders, &folder, specs)?)?;
        for path in orphans(&folder, specs)? {
            fs::remove_file(&path).map_err(BuildError::writing(&path))?;
            report.deleted.push(path);
        }
        Ok(())
    }

    /// Derives models anew, all in one start of Python; stamped texts by model name.
    fn derive(&self, folders: &Folders, specs: &[&Spec]) -> Result<BTreeMap<String, String>, BuildError> {
        if specs.is_empty() {
            return Ok(BTreeMap::new());
        }
        let search = self.python.clone().unwrap_or_else(|| Search::from_environment(Some(folders.packages())));
        let models: Vec<_> = specs.iter().map(|spec| &spec.model).collect();
        let programs = casadi::derive(&search.find()?, &models)?;
        specs
            .iter()
            .zip(&programs)
            .map(|(spec, programs)| {
                let options =
                    Options { runtime_path: self.runtime_path.clone(), fingerprint: spec.fingerprint.clone() };
                let text = emit(&spec.model, programs, &options)
                    .map_err(|source| BuildError::Emit { model: spec.name.clone(), source })?;
                Ok((spec.name.clone(), stamp::stamped(&spec.source_hash, &text)))
            })
            .collect()
    }

    /// The stamped `mod.rs` of a folder.
    fn registry(&self, folders: &Folders, folder: &Path, specs: &[Spec]) -> Result<String, BuildError> {
        let mounted: Result<Vec<Mounted>, BuildError> = specs
            .iter()
            .map(|spec| {
                let part = |(name, path): &(String, PathBuf)| Ok((name.clone(), folders.spec_seen_from(folder, path)?));
                let parts: Result<Vec<_>, BuildError> = spec.parts.iter().map(part).collect();
                let path = folders.spec_seen_from(folder, &spec.path)?;
                Ok(Mounted { name: spec.name.clone(), spec: path, parts: parts? })
            })
            .collect();
        let text = registry(&mounted?, &self.runtime_path)
            .map_err(|source| BuildError::Emit { model: "mod".to_owned(), source })?;
        Ok(stamp::stamped("the list of models", &text))
    }

    /// What is stale in the source tree's generated files: against `texts` if given, else by stamps.
    fn differences(
        &self,
        folders: &Folders,
        specs: &[Spec],
        texts: Option<&BTreeMap<String, String>>,
    ) -> Result<Vec<Stale>, BuildError> {
        let tree = &folders.tree;
        let mut stale = Vec::new();
        let mut note = |path: PathBuf, reason| stale.push(Stale { path, reason });
        for spec in specs {
            let path = file_of(tree, &spec.name);
            match read(&path) {
                None => note(path, "it is missing"),
                Some(file) => match texts.map(|texts| texts.get(&spec.name)) {
                    Some(text) if text != Some(&file) => note(path, "deriving the model again gives another text"),
                    None if fitting(tree, spec).is_none() => note(path, "its stamp does not fit the spec"),
                    _ => {}
                },
            }
        }
        let path = tree.join("mod.rs");
        if read(&path) != Some(self.registry(folders, tree, specs)?) {
            note(path, "it does not list the models");
        }
        for path in orphans(tree, specs)? {
            note(path, "its spec is gone");
        }
        Ok(stale)
    }
}

fn file_of(folder: &Path, model: &str) -> PathBuf {
    folder.join(format!("{model}.rs"))
}

/// A generated file, line ends as it was written.
fn read(path: &Path) -> Option<String> {
    fs::read_to_string(path).ok().map(|text| stamp::normalised(&text))
}

/// The text of a model's file, if it was made from what the spec says now and nobody edited it.
fn fitting(folder: &Path, spec: &Spec) -> Option<String> {
    read(&file_of(folder, &spec.name)).filter(|text| stamp::source_hash_of(text).as_ref() == Some(&spec.source_hash))
}

/// Generated files that belong to no spec.
fn orphans(folder: &Path, specs: &[Spec]) -> Result<Vec<PathBuf>, BuildError> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut orphans = Vec::new();
    for entry in fs::read_dir(folder).map_err(BuildError::reading(folder))? {
        let path = entry.map_err(BuildError::reading(folder))?.path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        let wanted = stem == "mod" || specs.iter().any(|spec| spec.name == stem);
        let rust = path.extension().is_some_and(|extension| extension == "rs");
        if rust && !wanted && read(&path).is_some_and(|text| text.starts_with(stamp::MARK)) {
            orphans.push(path);
        }
    }
    orphans.sort();
    Ok(orphans)
}

/// Writes the file that a crate includes to mount the models.
fn mount(folders: &Folders, report: &mut Report) -> Result<(), BuildError> {
    let list = std::path::absolute(report.mounted.join("mod.rs")).map_err(BuildError::reading(&report.mounted))?;
    let text = format!("/// The compiled models.\n#[path = {:?}]\npub mod generated;\n", list.to_string_lossy());
    let path = folders.out.join("gaitc_models.rs");
    if write_if_different(&path, &text)? {
        report.written.push(path);
    }
    Ok(())
}

/// Tells cargo what this build depends on.
#[expect(clippy::print_stdout, reason = "cargo reads a build script's standard output")]
fn tell_cargo(folders: &Folders) {
    println!("cargo:rerun-if-env-changed={VARIABLE}");
    // Of a folder cargo watches all that is in it: parts, which lie below it, new files and removed ones too.
    println!("cargo:rerun-if-changed={}", folders.specs.display());
    if folders.tree.is_dir() {
        println!("cargo:rerun-if-changed={}", folders.tree.display());
    }
}

/// Shows the warnings of specs that compile all the same.
#[expect(clippy::print_stdout, reason = "cargo reads a build script's standard output")]
fn pass_warnings(specs: &[Spec]) {
    for line in specs.iter().flat_map(|spec| spec.warnings.lines()) {
        println!("cargo:warning={line}");
    }
}
