//! Compiler of hybrid models: TOML specs in, Rust dynamics with analytic derivatives out.

pub mod diagnostic;
pub mod dimension;
pub mod front;
pub mod ir;
pub mod source;
