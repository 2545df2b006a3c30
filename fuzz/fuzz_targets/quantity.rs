//! Any text as a quantity, a range, values, an assignment; what is said of wrong ones is rendered.
#![no_main]

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::{Values, parse_assignment, parse_quantity, parse_range, parse_values};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    for dimension in [Dimension::NONE, Dimension::base(0)] {
        match parse_quantity(text, dimension) {
            Ok(value) => assert!(!value.is_nan()),
            Err(error) => drop(error.given_as("--set", &format!("name={text}")).render(false)),
        }
        match parse_range(text, dimension) {
            Ok((lower, upper)) => assert!(lower <= upper),
            Err(error) => drop(error.given_as("--vary", text).render(true)),
        }
        match parse_values(text, dimension) {
            Ok(Values::Range { lower, upper, count }) => assert!(lower <= upper && count != Some(0)),
            Ok(Values::List(values)) => assert!(!values.is_empty() && values.iter().all(|value| !value.is_nan())),
            Err(error) => drop(error.given_as("--over", "another text").render(false)),
        }
    }
    let _ = parse_assignment(text);
});
