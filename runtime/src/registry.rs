//! The list of compiled models that a program carries; `generated/mod.rs` is one such list.

use crate::probe::Probe;
use crate::return_map::ReturnMap;

/// What a compiled model offers with its sizes erased.
pub trait Compiled: ReturnMap + Probe {}

impl<T: ReturnMap + Probe> Compiled for T {}

/// A compiled model and the text it was compiled from.
#[derive(Clone, Copy)]
pub struct Entry {
    /// The model.
    pub compiled: &'static dyn Compiled,
    /// The spec's text at build time: parameter values, problems and doc strings for when no file is found at run time.
    pub spec: &'static str,
    /// The parts that the spec uses: the name by which it finds each, and its text at build time.
    pub parts: &'static [(&'static str, &'static str)],
}
