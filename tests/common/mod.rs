//! Running the gaitc binary from tests.

#![allow(dead_code, unreachable_pub)] // shared by several test files, none of which uses all of it
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

/// Runs gaitc with the repository as current folder.
pub fn gaitc(args: &[&str]) -> Output {
    gaitc_in(Path::new(env!("CARGO_MANIFEST_DIR")), args)
}

/// Runs gaitc in a folder.
pub fn gaitc_in(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gaitc"));
    command.current_dir(folder).args(args).env("NO_COLOR", "1").output().expect("the binary runs")
}

/// Runs gaitc with `--json` and returns its exit code and output.
pub fn json(args: &[&str]) -> (i32, Value) {
    let output = gaitc(&[args, &["--json"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    let value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{args:?}: {e}\n{text}\n{errors}"));
    (output.status.code().unwrap(), value)
}

/// Runs gaitc and returns exit code, stdout and stderr.
pub fn text(args: &[&str]) -> (i32, String, String) {
    let output = gaitc(args);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// A number in a JSON value.
pub fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number at {path} in {value:#}"))
}
