//! gaitc compiles declarative models of hybrid dynamical systems to Rust dynamics with analytic derivatives, and finds
//! with them periodic gaits, their stability, and the fastest stable climber.

pub mod cli;
pub mod figures;
pub mod load;
pub mod models;
pub mod motion;
pub mod picture;
pub mod problem;
pub mod progress;
pub mod provenance;
pub mod published;
pub mod report;
pub mod study;
pub mod table;
pub mod verify;
pub mod words;

pub use gaitc_compiler::files;
