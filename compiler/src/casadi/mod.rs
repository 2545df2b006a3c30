//! The symbolic step: expressions go to CasADi, straight-line programs come back.
//!
//! [`functions`] says which functions are generated for a model, [`exchange`] is what travels to and from the one Python
//! script `derive.py`, [`environment`] finds a Python that has CasADi, [`run`] starts it, and [`tape`] turns CasADi's
//! register tapes into [`program`]s in single-assignment form. No text of a spec is evaluated by Python: only node lists
//! with op codes, indices and numbers travel.

pub mod environment;
pub mod exchange;
pub mod functions;
mod fuse;
pub mod hoist;
pub mod program;
pub mod run;
pub mod tape;

use crate::valid::Validated;
pub use environment::Python;
pub use functions::{Function, Quantity};
pub use program::Program;

/// The script that is run, whole.
pub const SCRIPT: &str = include_str!("derive.py");
/// Pinned, hash-checked packages of the private environment.
pub const REQUIREMENTS: &str = include_str!("requirements.txt");
/// The CasADi version that the generated code comes from; the script refuses any other.
pub const CASADI_VERSION: &str = "3.8.2";

/// Why the symbolic step failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CasadiError {
    /// No Python with CasADi could be found or made.
    #[error("{0}")]
    Environment(String),
    /// The script failed; its last output.
    #[error("the CasADi step failed ({status}):\n{output}")]
    Failed {
        /// How the process ended.
        status: String,
        /// The end of what it printed.
        output: String,
    },
    /// The process could not be run.
    #[error("cannot run `{command}`: {source}")]
    Process {
        /// The program.
        command: String,
        /// Why.
        source: std::io::Error,
    },
    /// The answer is not one.
    #[error("the CasADi step gave an answer that cannot be read: {0}")]
    Answer(String),
}

/// The programs of all functions of a model, in the order of [`functions::list`].
pub type Programs = Vec<(Function, Program)>;

/// Derives the programs of several models in one start of Python.
///
/// # Errors
/// When Python or CasADi fails, or answers with something that is no program.
pub fn derive(python: &Python, models: &[&Validated]) -> Result<Vec<Programs>, CasadiError> {
    let request = exchange::Request::new(models);
    let response = run::run(python, &request)?;
    if response.models.len() != models.len() {
        return Err(CasadiError::Answer("it does not have one entry a model".to_owned()));
    }
    models
        .iter()
        .zip(&response.models)
        .map(|(model, tapes)| {
            let functions = functions::list(model);
            if tapes.len() != functions.len() {
                return Err(CasadiError::Answer("it does not have one tape a function".to_owned()));
            }
            functions
                .into_iter()
                .zip(tapes)
                .map(|(function, tape)| {
                    let inputs = exchange::inputs(model.model());
                    let mut program = tape::program(tape, &inputs).map_err(CasadiError::Answer)?;
                    if !function.by.with_value() {
                        program.values.clear();
                    }
                    Ok((function, program.without_dead_values()))
                })
                .collect()
        })
        .collect()
}
