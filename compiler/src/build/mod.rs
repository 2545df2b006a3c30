//! The build driver: from a folder of specs to Rust modules, from a crate's `build.rs`.
//!
//! # In a build script
//!
//! Put specs into `specs/`, add `gaitc-compiler` to the build dependencies and `gaitc-runtime` to the dependencies, and
//! write this `build.rs`:
//!
//! ```no_run
//! fn main() -> Result<(), gaitc_compiler::build::BuildError> {
//!     gaitc_compiler::compile_specs("specs")
//! }
//! ```
//!
//! The crate then mounts the compiled models:
//!
//! ```ignore
//! include!(concat!(env!("OUT_DIR"), "/gaitc_models.rs"));
//! // generated::MODELS lists them; generated::my_model::MyModel is one.
//! ```
//!
//! [`Config`] sets what [`compile_specs`] leaves at its default.
//!
//! # When Python runs
//!
//! Every generated file begins with a stamp: a hash of what it was made from (the equations, the emitter, the CasADi
//! script and version) and a hash of its own text. While both fit nothing runs and no Python is needed. Otherwise only
//! the models that differ are derived again, by the Python that `GAITC_PYTHON` names, or by one with private packages
//! below the target directory.
//!
//! # Where files go
//!
//! Into `OUT_DIR` only, unless the folder of the manifest holds a file `.gaitc-checkout`: then into `generated/` beside
//! the specs, where the files are committed. A package that brings fitting `generated/` files uses them as they are.

mod config;
mod error;
mod place;
mod sources;
mod spec;
mod stamp;
mod write;

pub use config::{Config, Report, Stale};
pub use error::BuildError;

use std::path::PathBuf;

/// Compiles all specs of a folder (relative to the manifest) with default settings.
///
/// # Errors
/// When a spec is wrong, code has to be derived and there is no Python for it, or a file cannot be read or written.
pub fn compile_specs(folder: impl Into<PathBuf>) -> Result<(), BuildError> {
    Config::new().specs(folder).compile().map(|_report| ())
}
