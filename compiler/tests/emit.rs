//! Emission.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // tests say what went wrong by panicking

mod common;

use gaitc_compiler::back::rust::{Options, emit};
use gaitc_compiler::casadi;
use gaitc_compiler::casadi::environment::Search;
use gaitc_compiler::valid::validate;

#[test]
fn scratch() {
    let model = validate(common::prescribed_length()).unwrap();
    let python = Search::from_environment(Some(std::env::temp_dir().join("gaitc-test"))).find().unwrap();
    let programs = casadi::derive(&python, &[&model]).unwrap();
    let options = Options { runtime_path: "::gaitc_runtime".into(), fingerprint: gaitc_compiler::ir::canonical::fingerprint(model.model()) };
    let text = emit(&model, &programs[0], &options).unwrap();
    std::fs::write("/tmp/out.rs", text).unwrap();
}
