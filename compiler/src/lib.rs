//! Compiler of hybrid models: TOML specs in, Rust dynamics with analytic derivatives out.

pub mod back;
pub mod casadi;
pub mod dimension;
pub mod ir;
pub mod valid;
