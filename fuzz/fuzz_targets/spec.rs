//! Any text as a spec: read, checked, its diagnostics rendered, and shown where it is right.
#![no_main]

use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front::parse_text;
use gaitc_compiler::show::Sheet;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let parsed = parse_text("fuzz.toml".as_ref(), text);
    let _ = render(&parsed.diagnostics, &parsed.sources, false);
    let _ = Sheet::new(&parsed);
    assert_eq!(parsed.model.is_none(), parsed.diagnostics.iter().any(|d| d.is_error()));
});
