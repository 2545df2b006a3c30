//! What can go wrong in a build.

use crate::back::rust::EmitError;
use crate::casadi::CasadiError;
use crate::files::FileError;
use std::fmt;
use std::path::Path;

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
    #[error(transparent)]
    File(#[from] FileError),
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
    /// Of something that could not be read.
    pub(super) fn reading(path: &Path) -> impl FnOnce(std::io::Error) -> Self + use<'_> {
        move |error| FileError::reading(path, error).into()
    }

    /// Of something that could not be written.
    pub(super) fn writing(path: &Path) -> impl FnOnce(std::io::Error) -> Self + use<'_> {
        move |error| FileError::writing(path, error).into()
    }
}
