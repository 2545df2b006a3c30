//! Where a new project finds the crates of gaitc: in the registry, or in sources on this machine.

use super::InputError;
use crate::files;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A larger file is no manifest of a crate.
const MOST_MANIFEST: u64 = 1 << 20;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Sources of the crates that a project needs; absolute paths.
pub(super) struct Crates {
    pub(super) compiler: PathBuf,
    pub(super) runtime: PathBuf,
}

impl Crates {
    /// Those in `given`, else those that this program was built from; `None`: the registry has them.
    ///
    /// # Errors
    /// When `given` does not hold them, or its path cannot stand in a manifest.
    pub(super) fn find(given: Option<&Path>) -> Result<Option<Self>, InputError> {
        let Some(folder) = given else {
            return Ok(Self::of_this_program());
        };
        let shown = folder.display();
        let absolute = std::path::absolute(folder)
            .map_err(|error| InputError(format!("--crates: {}", files::FileError::reading(folder, error))))?;
        if absolute.to_str().is_none() {
            return Err(InputError(format!("--crates: `{shown}` is not UTF-8\n  help: choose another folder")));
        }
        let found = Self::in_folder(&absolute);
        found.map(Some).ok_or_else(|| {
            InputError(format!(
                "--crates: `{shown}` does not hold the crates of gaitc\n  help: give a checkout of gaitc, which has \
                 `compiler` and `runtime`, or a folder with `gaitc-compiler-{VERSION}` and `gaitc-runtime-{VERSION}`"
            ))
        })
    }

    /// A checkout, or a package beside which the other two lie.
    fn of_this_program() -> Option<Self> {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR"));
        // Cargo leaves this file in packages that come from a registry: then the others come from there too.
        if sources.join(".cargo-ok").exists() {
            return None;
        }
        Self::in_folder(sources).or_else(|| Self::in_folder(sources.parent()?))
    }

    fn in_folder(folder: &Path) -> Option<Self> {
        let packaged = |name: &str| folder.join(format!("{name}-{VERSION}"));
        [(folder.join("compiler"), folder.join("runtime")), (packaged("gaitc-compiler"), packaged("gaitc-runtime"))]
            .into_iter()
            .find(|(compiler, runtime)| is_crate(compiler, "gaitc-compiler") && is_crate(runtime, "gaitc-runtime"))
            .map(|(compiler, runtime)| Self { compiler, runtime })
    }

    /// What makes cargo take them.
    pub(super) fn patch(&self) -> String {
        let line =
            |name: &str, path: &Path| format!("{name} = {{ path = {} }}\n", toml_string(&path.to_string_lossy()));
        format!(
            "\n# The sources that gaitc itself was built from, in place of published crates of the same version. Where these\n\
             # are published, the section can go.\n[patch.crates-io]\n{}{}",
            line("gaitc-compiler", &self.compiler),
            line("gaitc-runtime", &self.runtime)
        )
    }

    pub(super) fn json(self) -> Value {
        json!({ "gaitc-compiler": self.compiler.display().to_string(), "gaitc-runtime": self.runtime.display().to_string() })
    }
}

/// Whether a folder holds the sources of a crate.
fn is_crate(folder: &Path, name: &str) -> bool {
    let line = format!("name = \"{name}\"");
    folder.to_str().is_some()
        && files::read_text(&folder.join("Cargo.toml"), MOST_MANIFEST)
            .is_ok_and(|text| text.lines().any(|l| l.trim() == line))
}

/// A string as TOML writes it.
fn toml_string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            _ if letter.is_control() => quoted += &format!("\\u{:04X}", u32::from(letter)),
            _ => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}
