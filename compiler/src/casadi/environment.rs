//! Which Python runs the CasADi script.
//!
//! In this order: the one that `GAITC_PYTHON` names; one with a private package folder below the build's target
//! directory, which is filled from a pinned, hash-checked list on first use; otherwise an error that names the ways out.

use super::run::{converse, shown};
use super::{CASADI_VERSION, CasadiError, REQUIREMENTS};
use crate::ir::canonical::hex_digest;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Environment variable that names the Python to use.
pub const VARIABLE: &str = "GAITC_PYTHON";

/// A Python that can import CasADi.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Python {
    /// The program.
    pub command: PathBuf,
    /// The folder of its private packages, if it has one.
    pub packages: Option<PathBuf>,
}

/// Where to look.
#[derive(Clone, Debug, Default)]
pub struct Search {
    /// The Python that the user named; nothing else is tried then.
    pub named: Option<PathBuf>,
    /// Folder for private packages, below the target directory; `None`: do not install anything.
    pub folder: Option<PathBuf>,
    /// Programs to make private packages with, in order; empty: `python3`, then `python`.
    pub programs: Vec<PathBuf>,
}

impl Search {
    /// As the environment says, with private packages below `folder`.
    pub fn from_environment(folder: Option<PathBuf>) -> Self {
        let named = std::env::var_os(VARIABLE).filter(|name| !name.is_empty()).map(PathBuf::from);
        Self { named, folder, programs: Vec::new() }
    }

    /// Finds a Python, and installs the private packages if they are needed and not there.
    ///
    /// # Errors
    /// When there is none; the message names the ways out.
    pub fn find(&self) -> Result<Python, CasadiError> {
        if let Some(command) = &self.named {
            has_casadi(command)
                .map_err(|reason| ways_out(&format!("{VARIABLE} is set to `{}`: {reason}", command.display())))?;
            return Ok(Python { command: command.clone(), packages: None });
        }
        let Some(folder) = &self.folder else {
            return Err(ways_out("no folder for private packages is known"));
        };
        let defaults = [PathBuf::from("python3"), PathBuf::from("python")];
        let programs: &[PathBuf] = if self.programs.is_empty() { &defaults } else { &self.programs };
        let mut reasons = Vec::new();
        for command in programs {
            match tag(command) {
                Ok(tag) => return install(command, folder, &tag),
                Err(reason) => reasons.push(format!("`{}`: {reason}", command.display())),
            }
        }
        Err(ways_out(&reasons.join("; ")))
    }
}

/// An error that says what to do.
fn ways_out(reason: &str) -> CasadiError {
    CasadiError::Environment(format!(
        "the model code has to be generated again, and no Python with CasADi could be made ({reason})\n\
         ways out, any of them:\n\
         - install Python 3.10 or later with pip and allow it to reach a package index, then build again\n\
         - `pip install casadi=={CASADI_VERSION}` in a Python of your own, and set {VARIABLE} to that Python\n\
         - use specs and generated code that belong together, unchanged: then no Python is needed"
    ))
}

/// Whether a Python of the user's can import CasADi; else why not.
fn has_casadi(command: &Path) -> Result<(), String> {
    let script = "import casadi; print('casadi', casadi.__version__)";
    match converse(Command::new(command).args(["-c", script]), String::new()) {
        Err(CasadiError::Process { source, .. }) => Err(source.to_string()),
        Err(error) => Err(error.to_string()),
        Ok(output) if !output.status.success() => {
            Err(format!("it cannot import casadi\n{}", shown(&output).trim_end()))
        }
        Ok(output) if !output.stdout.starts_with(b"casadi") => Err("it is no Python".to_owned()),
        Ok(_) => Ok(()),
    }
}

/// What packages depend on: implementation, version and platform.
fn tag(command: &Path) -> Result<String, String> {
    let script = "import sys, sysconfig; assert sys.version_info >= (3, 10), 'Python 3.10 or later is needed'\n\
                  print(sys.implementation.cache_tag, sysconfig.get_platform(), sep='-')";
    let output = converse(Command::new(command).args(["-I", "-c", script]), String::new());
    match output {
        Err(CasadiError::Process { source, .. }) => Err(source.to_string()),
        Err(error) => Err(error.to_string()),
        Ok(output) if !output.status.success() => Err(shown(&output).trim().to_owned()),
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stdout);
            let clean = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '.' { c } else { '-' };
            Ok(text.trim().chars().map(clean).collect())
        }
    }
}

/// The private packages for one Python, installed if they are not there yet.
fn install(command: &Path, folder: &Path, tag: &str) -> Result<Python, CasadiError> {
    let digest = hex_digest(REQUIREMENTS.as_bytes());
    let name = format!("{tag}-{}", digest.get(..16).unwrap_or(&digest));
    let packages = folder.join(&name);
    let failed = |error: std::io::Error| ways_out(&format!("`{}`: {error}", packages.display()));
    fs::create_dir_all(folder).map_err(failed)?;
    // Builds run in parallel: one installs, the others wait. The lock ends with the file, whatever happens.
    let lock = File::create(folder.join(format!("{name}.lock"))).map_err(failed)?;
    lock.lock().map_err(failed)?;
    let complete = folder.join(format!("{name}.complete"));
    if !complete.is_file() {
        if packages.exists() {
            fs::remove_dir_all(&packages).map_err(failed)?;
        }
        let requirements = folder.join(format!("{name}.txt"));
        fs::write(&requirements, REQUIREMENTS).map_err(failed)?;
        pip(command, &packages, &requirements)?;
        fs::write(&complete, "").map_err(failed)?;
    }
    Ok(Python { command: command.to_path_buf(), packages: Some(packages) })
}

fn pip(command: &Path, packages: &Path, requirements: &Path) -> Result<(), CasadiError> {
    let mut pip = Command::new(command);
    pip.args(["-m", "pip", "install", "--disable-pip-version-check", "--no-input", "--no-deps", "--quiet"])
        .args(["--require-hashes", "--only-binary", ":all:", "--target"])
        .arg(packages)
        .arg("-r")
        .arg(requirements);
    let output = converse(&mut pip, String::new())?;
    if output.status.success() {
        return Ok(());
    }
    Err(ways_out(&format!("`{} -m pip install` failed:\n{}", command.display(), shown(&output).trim_end())))
}
