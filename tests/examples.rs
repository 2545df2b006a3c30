//! The examples run, and draw what the README and docs show.

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

/// The example draws the picture that is committed.
fn draws(name: &str) {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("picture.svg");
    let output = Command::new(example(name)).arg(&picture).current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let drawn = std::fs::read_to_string(picture).unwrap();
    let committed = std::fs::read_to_string(format!("{}/docs/{name}.svg", env!("CARGO_MANIFEST_DIR"))).unwrap();
    // Positions are whole pixels: the text is the same unless a curve, a label or the layout changed.
    assert_eq!(
        drawn.trim(),
        committed.trim(),
        "draw it again: cargo run --release --example {name} -- docs/{name}.svg"
    );
}

#[test]
fn sprawl_draws_the_picture_of_speed_against_stability() {
    draws("sprawl");
}

#[test]
fn self_exciting_draws_the_picture_of_the_readme() {
    draws("self_exciting");
}
