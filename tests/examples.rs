//! The examples run, and draw what the README shows.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use std::path::PathBuf;
use std::process::Command;

/// Cargo builds examples beside the tests: in `examples/` next to the folder of this test's executable.
fn example(name: &str) -> PathBuf {
    let folder = std::env::current_exe().unwrap().parent().and_then(|deps| deps.parent()).unwrap().join("examples");
    let path = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(path.exists(), "{} is not built: run `cargo test` without a filter", path.display());
    path
}

#[test]
fn sprawl_draws_the_picture_of_the_readme() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("sprawl.svg");
    let output =
        Command::new(example("sprawl")).arg(&picture).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let drawn = std::fs::read_to_string(picture).unwrap();
    let committed = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/sprawl.svg")).unwrap();
    // Positions are whole pixels: the text is the same unless a curve, a label or the layout changed.
    assert_eq!(
        drawn.trim(),
        committed.trim(),
        "draw it again: cargo run --release --example sprawl -- docs/sprawl.svg"
    );
}
