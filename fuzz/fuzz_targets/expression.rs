//! Any text as an expression over a model, as `--show` and `--subject-to` take it.
#![no_main]

use gaitc_compiler::front::flags::{parse_constraint, parse_objective};
use gaitc_compiler::front::{Observations, parse_text};
use gaitc_compiler::ir::Model;
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

/// Read once: the text is what is looked at.
static MODEL: LazyLock<(Model, Observations)> = LazyLock::new(|| {
    let spec = include_str!("../../specs/prescribed_length.toml");
    let parsed = parse_text("prescribed_length.toml".as_ref(), spec);
    parsed.model.zip(parsed.observations).expect("the spec is right")
});

fuzz_target!(|text: &str| {
    let (mut model, mut observations) = MODEL.clone();
    if let Err(error) = observations.observe(text) {
        drop(error.given_as("--show", text).render(false));
    }
    if let Err(error) = parse_constraint(&mut model, text) {
        drop(error.given_as("--subject-to", text).render(false));
    }
    let _ = parse_objective(&mut model, text);
});
