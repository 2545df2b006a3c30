//! Compiler of hybrid models: TOML specs in, Rust dynamics with analytic derivatives out.

pub mod dimension;
pub mod ir;
