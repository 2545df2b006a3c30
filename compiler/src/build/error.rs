//! What can go wrong in a build.

use crate::back::rust::EmitError;
use crate::casadi::CasadiError;
use std::fmt;
use std::path::PathBuf;

/// Why specs could not be compiled.
///
/// `Debug` prints the same text as `Display`, so that a build script whose `main` returns this error shows it readably.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Specs have errors; the rendered diagnostics of all of them.
    #[error("{0}")]
    Specs(String),
    /// A setting that only cargo can know is missing.
    #[error("the environment variable `{0}` is not set; run this from a build script, or set it in `Config`")]
    NotInBuildScript(&'static str),
    /// A file or folder cannot be read or written.
    #[error("`{}`: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The symbolic step failed.
    #[error(transparent)]
    Casadi(#[from] CasadiError),
    /// The code could not be printed.
    #[error("model `{model}`: {source}")]
    Emit {
        /// Which model.
        model: String,
        /// Why.
        source: EmitError,
    },
}

impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

impl BuildError {
    /// Adds the path to an I/O error.
    pub(super) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::Io { path, source }
    }
}
