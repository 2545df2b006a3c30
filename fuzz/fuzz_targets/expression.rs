//! Any text as an expression over a model, as `--show` and `--subject-to` take it.
#![no_main]

use gaitc_compiler::front::flags::{parse_constraint, parse_objective};
use gaitc_compiler::front::parse_text;
use libfuzzer_sys::fuzz_target;

const SPEC: &str = include_str!("../../specs/prescribed_length.toml");

fuzz_target!(|text: &str| {
    let parsed = parse_text("prescribed_length.toml".as_ref(), SPEC);
    let (Some(mut model), Some(mut observations)) = (parsed.model, parsed.observations) else {
        panic!("the spec is right");
    };
    let _ = observations.observe(text);
    let _ = parse_constraint(&mut model, text);
    let _ = parse_objective(&mut model, text);
});
