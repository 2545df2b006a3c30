//! Tables, sweeps and basins: what is written is what was computed, whatever happens in between. One binary, so that it is linked once.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)] // a test may fail loudly, and say what it left out

mod basin;
#[path = "../common/mod.rs"]
mod common;
mod dask;
mod interrupted;
mod merge;
mod refused;
mod simulate;
mod sweep;
mod table;

use common::text;
use std::path::Path;

/// Runs gaitc, which has to succeed; its stdout.
fn done(args: &[&str]) -> String {
    let (code, out, errors) = text(args);
    assert_eq!(code, 0, "{args:?}: {errors}\n{out}");
    out
}

/// Runs gaitc, which has to refuse; its stderr, which contains all of `expected`.
fn refused(args: &[&str], expected: &[&str]) {
    let (code, out, errors) = text(args);
    assert_eq!(code, 1, "{args:?}: {errors}\n{out}");
    for part in expected {
        assert!(errors.contains(part), "{args:?}: no `{part}` in {errors}");
    }
}

/// The path of a file in a folder, as text.
fn at(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}
