//! Where generated files go, and how one file names another.

use super::BuildError;
use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

/// A file of this name beside the manifest allows writing generated files into the source tree.
pub(super) const CHECKOUT_MARK: &str = ".gaitc-checkout";

/// The folders of a build.
#[derive(Clone, Debug)]
pub(super) struct Folders {
    /// Of the crate's manifest.
    pub(super) manifest: PathBuf,
    /// For what the build script writes.
    pub(super) out: PathBuf,
    /// Of the specs.
    pub(super) specs: PathBuf,
    /// Of committed generated files.
    pub(super) tree: PathBuf,
}

impl Folders {
    /// Whether this is a checkout whose generated files are committed.
    pub(super) fn is_checkout(&self) -> bool {
        self.manifest.join(CHECKOUT_MARK).is_file()
    }

    /// Generated files of a build that must not write into the source tree.
    pub(super) fn private(&self) -> PathBuf {
        self.out.join("generated")
    }

    /// Folder for Python packages: below the target directory, so that builds share it and `cargo clean` removes it.
    pub(super) fn packages(&self) -> PathBuf {
        let target = self.out.ancestors().find(|folder| folder.join("CACHEDIR.TAG").is_file());
        target.unwrap_or(&self.out).join("gaitc-python")
    }

    /// The path of a spec as `include_str!` in `folder` has to name it: relative where both lie below the manifest, so
    /// that committed files are the same on every machine.
    pub(super) fn spec_seen_from(&self, folder: &Path, spec: &Path) -> Result<String, BuildError> {
        let relative = spec
            .strip_prefix(&self.manifest)
            .ok()
            .zip(folder.strip_prefix(&self.manifest).ok())
            .filter(|_| !folder.starts_with(&self.out))
            .and_then(|(spec, folder)| relative(folder, spec));
        match relative {
            Some(path) => Ok(path),
            None => {
                let path = std::path::absolute(spec).map_err(BuildError::reading(spec))?;
                Ok(path.to_string_lossy().into_owned())
            }
        }
    }
}

/// `to` seen from the folder `from`, both relative to the same folder, with `/` on every platform.
fn relative(from: &Path, to: &Path) -> Option<String> {
    let names = |path: &Path| -> Option<Vec<String>> {
        path.components()
            .filter(|component| !matches!(component, Component::CurDir))
            .map(|component| match component {
                Component::Normal(name) => OsStr::to_str(name).map(str::to_owned),
                _ => None,
            })
            .collect()
    };
    let (from, to) = (names(from)?, names(to)?);
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = from.iter().skip(shared).map(|_| "..".to_owned());
    Some(up.chain(to.into_iter().skip(shared)).collect::<Vec<_>>().join("/"))
}

#[cfg(test)]
mod tests {
    use super::relative;
    use std::path::Path;

    #[test]
    fn relative_paths() {
        let from = |from: &str, to: &str| relative(Path::new(from), Path::new(to));
        assert_eq!(from("generated", "specs/a.toml").as_deref(), Some("../specs/a.toml"));
        assert_eq!(from("tests/golden/generated", "tests/golden/specs/a.toml").as_deref(), Some("../specs/a.toml"));
        assert_eq!(from("./generated", "a.toml").as_deref(), Some("../a.toml"));
        assert_eq!(from("generated", "../a.toml"), None);
    }
}
