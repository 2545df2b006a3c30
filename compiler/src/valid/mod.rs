//! The validator: the only way from a model to code.
//!
//! The emitter takes a [`Validated`], and [`validate`] alone makes one, so a model that was not checked cannot be
//! emitted. The front end reports what a user wrote wrongly, with its place in the file; what is found here beyond that
//! is structure that no code could be generated for.

mod facts;
mod structure;

pub use facts::{Facts, Reference};

use crate::ir::Model;

/// A model that passed [`validate`], with what the back end has to know about it.
#[derive(Clone, Debug)]
pub struct Validated {
    model: Model,
    facts: Facts,
}

impl Validated {
    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// What follows from it.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }
}

/// Checks a model and derives its [`Facts`].
///
/// # Errors
/// All defects that were found, one message each: indices out of range, vectors of wrong lengths, operands after their
/// users, symbols where they have no value, names that cannot be printed as Rust, absurd sizes.
pub fn validate(model: Model) -> Result<Validated, Vec<String>> {
    let defects = structure::defects(&model);
    if !defects.is_empty() {
        return Err(defects);
    }
    let facts = Facts::of(&model).map_err(|defect| vec![defect])?;
    Ok(Validated { model, facts })
}
