//! The numbers that docs/comparison.md calls computed are what its commands print.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::json;
use gaitc::load::load;
use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::parse_quantity;
use serde_json::Value;

/// Splits a command line at spaces outside single quotes.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in command.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().unwrap().push(c),
        }
    }
    words
}

/// A quantity of an answer, wherever it stands.
fn find(answer: &Value, name: &str) -> f64 {
    let tables = ["measures", "section"].map(|table| &answer[table][name]);
    let optimised = answer.get("objective").map(|_| &answer["parameters"][name]);
    let mut places = tables.into_iter().chain(optimised).chain([&answer[name]]);
    places.find_map(Value::as_f64).unwrap_or_else(|| panic!("no {name} in {answer:#}"))
}

/// The dimension of a quantity of a model; what the spec does not define has none.
fn dimension(model: &str, name: &str) -> Dimension {
    let spec = load(model, None).unwrap().spec;
    let parameters = spec.parameters.iter().map(|p| (&p.name, p.dimension));
    let states = spec.states.iter().map(|s| (&s.name, s.dimension));
    let measures = spec.measures.iter().map(|m| (&m.name, m.dimension));
    parameters
        .chain(states)
        .chain(measures)
        .find(|(n, _)| *n == name)
        .map_or(Dimension::NONE, |(_, dimension)| dimension)
}

/// Half a unit of the last digit that is written, relative to the number.
fn rounding(number: &str) -> f64 {
    let (value, decimals) = (number.parse::<f64>().unwrap(), number.split_once('.').map_or(0, |(_, d)| d.len()));
    0.5001 * 10_f64.powi(-i32::try_from(decimals).unwrap()) / value.abs()
}

#[test]
fn computed_numbers_are_what_the_commands_print() {
    let text = include_str!("../docs/comparison.md");
    let mut rows = 0;
    for line in text.lines().filter(|line| line.contains("| `gaitc ")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [_, _, written, quantity, command] = cells[..] else { panic!("{line}") };
        let words = words(command.trim_matches('`'));
        let args: Vec<&str> = words.iter().skip(1).map(String::as_str).collect();
        let (code, answer) = json(&args);
        assert_eq!(code, 0, "{line}\n{answer:#}");
        let expected = parse_quantity(written, dimension(args[1], quantity)).unwrap();
        let found = find(&answer, quantity);
        let number = written.split(' ').next().unwrap();
        assert!((found - expected).abs() <= rounding(number) * expected.abs(), "{line}\nis {found}");
        rows += 1;
    }
    assert!(rows > 30, "{rows}");
}
