//! Compiler of hybrid models: TOML specs in, Rust dynamics with analytic derivatives out.

pub mod back;
pub mod build;
pub mod casadi;
pub mod diagnostic;
pub mod dimension;
pub mod files;
pub mod front;
pub mod ir;
pub mod schema;
pub mod show;
pub mod source;
pub mod valid;

pub use build::compile_specs;
