//! Tables, sweeps and basins: what is written is what was computed, whatever happens in between. One binary, so that it is linked once.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

#[path = "../common/mod.rs"]
mod common;
mod simulate;
mod table;
