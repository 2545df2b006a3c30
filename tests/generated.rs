//! The committed files in `generated/` are what the specs compile to, byte for byte.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use gaitc_compiler::build::Config;

#[test]
fn generated_files_are_fresh() {
    // Derives every model again with CasADi: trusting the stamps alone would not notice a stamp that is wrong.
    let target = tempfile::tempdir().unwrap();
    let config = Config::new().manifest_dir(env!("CARGO_MANIFEST_DIR")).out_dir(out_dir(&target)).regenerate();
    let stale = config.check().unwrap_or_else(|e| panic!("{e}"));
    assert!(stale.is_empty(), "run `cargo build` and commit generated/: {stale:#?}");
}

/// The private Python environment is kept below the target directory, which the compiler finds from the folder that
/// cargo gives a build script: the one of this very build, so that the environment is shared.
fn out_dir(scratch: &tempfile::TempDir) -> std::path::PathBuf {
    option_env!("OUT_DIR").map_or_else(|| scratch.path().to_path_buf(), Into::into)
}
