//! Any text as a quantity, a range, an assignment.
#![no_main]

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::{parse_assignment, parse_quantity, parse_range};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    for dimension in [Dimension::NONE, Dimension::base(0)] {
        if let Ok(value) = parse_quantity(text, dimension) {
            assert!(!value.is_nan());
        }
        if let Ok((lower, upper)) = parse_range(text, dimension) {
            assert!(lower <= upper);
        }
    }
    let _ = parse_assignment(text);
});
