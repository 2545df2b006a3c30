//! No text makes the front end panic, whatever has been done to a good spec, and every place it names exists.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front::flags::{parse_constraint, parse_quantity, parse_range};
use gaitc_compiler::front::{Library, check_file, parse_text, parse_with};
use gaitc_compiler::show::Sheet;
use proptest::prelude::*;
use std::path::Path;

const SPEC: &str = include_str!("../../specs/prescribed_length.toml");
/// The spec with most kinds of tables, and its parts.
const LARGE: &str = include_str!("../../specs/self_exciting.toml");
const PARTS: [(&str, &str); 4] = [
    ("parts/constant_voltage.toml", include_str!("../../specs/parts/constant_voltage.toml")),
    ("parts/dc_motor_planar.toml", include_str!("../../specs/parts/dc_motor_planar.toml")),
    ("parts/dc_motor.toml", include_str!("../../specs/parts/dc_motor.toml")),
    ("parts/crank_slider.toml", include_str!("../../specs/parts/crank_slider.toml")),
];

/// Pieces of the language, so that mutations get past the first token.
const PIECES: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "'",
    "\"\"\"",
    "\\",
    "\\u0041",
    ",",
    "=",
    "==",
    "^",
    "^-",
    "*",
    "/0",
    "+",
    "-",
    "1e999",
    "0.5",
    "if(",
    "d(",
    "dot(",
    "mean(",
    "abs(",
    "and",
    "not",
    "<=",
    ">",
    "tau",
    "t",
    "pi",
    "n",
    "q_theta",
    "psi",
    "climb_speed",
    "spectral_radius",
    "duration",
    " m",
    " [m/s]",
    "[state]",
    "[section]",
    "\n",
    "\u{0}",
    "é",
    "°",
    "%",
    "99999999999999999999",
];

#[derive(Clone, Debug)]
enum Mutation {
    Delete(usize, usize),
    Insert(usize, usize),
    Swap(usize, usize, usize),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let place = 0..LARGE.len();
    prop_oneof![
        (place.clone(), 1..40usize).prop_map(|(at, length)| Mutation::Delete(at, length)),
        (place.clone(), 0..PIECES.len()).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
        (place.clone(), place, 1..20usize).prop_map(|(a, b, length)| Mutation::Swap(a, b, length)),
    ]
}

fn mutate(text: &mut Vec<u8>, mutation: &Mutation) {
    let length = text.len();
    match *mutation {
        Mutation::Delete(at, count) => {
            let at = at.min(length);
            text.drain(at..(at + count).min(length));
        }
        Mutation::Insert(at, piece) => {
            let at = at.min(length);
            text.splice(at..at, PIECES[piece].bytes());
        }
        Mutation::Swap(a, b, count) => {
            for i in 0..count {
                if a + i < length && b + i < length {
                    text.swap(a + i, b + i);
                }
            }
        }
    }
}

/// Parses and renders, and checks what must hold of every answer.
fn check(text: &str) -> Result<(), TestCaseError> {
    check_with(text, &PARTS)
}

/// The same of a spec with its parts.
fn check_with(text: &str, parts: &[(&str, &str)]) -> Result<(), TestCaseError> {
    let parsed = parse_with(Path::new("prescribed_length.toml"), text, Library::Texts(parts));
    prop_assert_eq!(parsed.model.is_none(), parsed.diagnostics.iter().any(|d| d.is_error()));
    for label in parsed.diagnostics.iter().flat_map(|diagnostic| &diagnostic.labels) {
        let span = label.span;
        let text = parsed.sources.text(span.file);
        prop_assert!(span.start <= span.end && span.end <= text.len(), "{:?} of {}", span, text.len());
        prop_assert!(text.is_char_boundary(span.start) && text.is_char_boundary(span.end), "{:?}", span);
    }
    prop_assert!(parsed.diagnostics.iter().all(|diagnostic| !diagnostic.labels.is_empty()));
    let rendered = render(&parsed.diagnostics, &parsed.sources, false);
    prop_assert_eq!(rendered.is_empty(), parsed.diagnostics.is_empty());
    let sheet = Sheet::new(&parsed);
    prop_assert_eq!(sheet.is_some(), parsed.model.is_some());
    if let Some(sheet) = sheet {
        let closed = sheet.latex().ends_with("\\end{document}\n") && sheet.graph_dot().ends_with("}\n");
        prop_assert!(closed, "a page is not whole");
        prop_assert!(!sheet.text().is_empty() && !sheet.markdown().is_empty());
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_specs_never_panic(mutations in prop::collection::vec(mutation(), 1..6)) {
        let mut text = SPEC.as_bytes().to_vec();
        mutations.iter().for_each(|mutation| mutate(&mut text, mutation));
        check(&String::from_utf8_lossy(&text))?;
    }

    #[test]
    fn mutated_specs_with_mass_matrices_never_panic(mutations in prop::collection::vec(mutation(), 1..6)) {
        let mut text = LARGE.as_bytes().to_vec();
        mutations.iter().for_each(|mutation| mutate(&mut text, mutation));
        check(&String::from_utf8_lossy(&text))?;
    }

    #[test]
    fn mutated_parts_never_panic(mutations in prop::collection::vec(mutation(), 1..6), which in 0..PARTS.len()) {
        let mut text = PARTS[which].1.as_bytes().to_vec();
        mutations.iter().for_each(|mutation| mutate(&mut text, mutation));
        let text = String::from_utf8_lossy(&text);
        // By itself as well, whatever the file then is.
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("part.toml");
        std::fs::write(&path, text.as_bytes())?;
        let checked = check_file(&path)?;
        prop_assert!(!checked.part || checked.parsed.model.is_none());
        let mut parts = PARTS;
        parts[which].1 = &text;
        check_with(LARGE, &parts)?;
    }

    #[test]
    fn mutated_expressions_never_panic(pieces in prop::collection::vec(0..PIECES.len(), 0..12), line in 20..75usize) {
        // Into the first string of some line, so that the TOML mostly stays whole.
        let piece: String = pieces.iter().map(|&i| PIECES[i]).filter(|piece| !piece.contains(['"', '\n', '\\', '\0'])).collect();
        let mut lines: Vec<String> = SPEC.lines().map(str::to_owned).collect();
        if let Some(at) = lines.get(line).and_then(|line| line.find('"')) {
            lines[line].insert_str(at + 1, &piece);
        }
        check(&lines.join("\n"))?;
    }

    #[test]
    fn flags_never_panic(pieces in prop::collection::vec(0..PIECES.len(), 0..10), dots in 0..10usize) {
        let mut flag: String = pieces.iter().map(|&i| PIECES[i]).collect();
        let dimension = gaitc_compiler::dimension::Dimension::TIME;
        drop(parse_quantity(&flag, dimension).map_err(|error| error.to_string()));
        let mut model = parse_text(Path::new("prescribed_length.toml"), SPEC).model.unwrap();
        drop(parse_constraint(&mut model, &flag).map_err(|error| error.to_string()));
        let at = flag.char_indices().map(|(i, _)| i).nth(dots).unwrap_or(flag.len());
        flag.insert_str(at, "..");
        drop(parse_range(&flag, dimension).map_err(|error| error.to_string()));
    }
}

#[test]
fn extremes_never_overflow_the_stack() {
    let spec = |flow: &str| SPEC.replace("p_theta/r\"\np_theta", &format!("{flow}\"\np_theta"));
    for flow in [
        "(".repeat(9_000),
        "-".repeat(9_000),
        format!("q_theta{}", "+q_theta".repeat(1_200)),
        format!("if({}q_theta < 0, 1, 2)", "q_theta < 0 and ".repeat(500)),
        format!("{}q_theta{}", "abs(".repeat(127), ")".repeat(127)),
        format!("{}q_theta{}", "min(1, ".repeat(120), ")".repeat(120)),
        format!("if({}q_theta < 0, 1, 2)", "not ".repeat(120)),
        format!("1 [1/s]*{}q_theta", "-".repeat(120)),
        format!("1 [1/s]*{}q_theta{}", "-(1 + ".repeat(60), ")".repeat(60)),
        format!("1 [1/s]*{}q_theta{}", "1/(1 - ".repeat(60), ")^2".repeat(60)),
        format!("1 [1/s]*{}q_theta{}", "if(q_theta < 0, 1, 2*".repeat(60), ")".repeat(60)),
        format!("1 [1/s]*{}q_theta{}", "2^(".repeat(60), ")".repeat(60)),
    ] {
        check(&spec(&flow)).unwrap();
    }
    let lets: String = (1..3_000).map(|i| format!("y{i} = \"y{} + 1\"\n", i - 1)).collect();
    check(&SPEC.replace("[let]", &format!("[let]\ny0 = \"y2999\"\n{lets}"))).unwrap();
    let functions: String = (1..3_000).map(|i| format!("f{i} = {{ args = [], expr = \"f{}()\" }}\n", i - 1)).collect();
    let functions = format!("[functions]\nf0 = {{ args = [], expr = \"1 [1/s]\" }}\n{functions}[let]");
    check(&spec("f2999()").replace("[let]", &functions)).unwrap();
    let body = |i: usize| format!("min(1 [1/s], if(q_theta < 0 or not q_theta < 1, abs(f{i}() + 1 [1/s]), 1 [1/s]))");
    let functions: String = (1..300).map(|i| format!("f{i} = {{ args = [], expr = \"{}\" }}\n", body(i - 1))).collect();
    let functions = format!("[functions]\nf0 = {{ args = [], expr = \"1 [1/s]\" }}\n{functions}[let]");
    check(&spec("f299()").replace("[let]", &functions)).unwrap();
    check(&format!("{SPEC}\nx = {}", "[".repeat(100_000))).unwrap();
    check(&format!("{SPEC}\n{}x = 1", "a.".repeat(100_000))).unwrap();
}

#[test]
fn exponential_functions_are_cut_off() {
    // Each call has other arguments, so nothing can be shared: 2^40 terms.
    let mut functions = "[functions]\nf0 = { args = [\"z\"], expr = \"z\" }\n".to_owned();
    for i in 1..=40 {
        functions += &format!("f{i} = {{ args = [\"z\"], expr = \"f{0}(z + {i}) + f{0}(z*{i})\" }}\n", i - 1);
    }
    let text = SPEC
        .replace("[let]", &format!("{functions}[let]"))
        .replace("p_theta/r\"\np_theta", "f40(q_theta)*1 [1/s]\"\np_theta");
    let parsed = parse_text(Path::new("prescribed_length.toml"), &text);
    assert!(parsed.diagnostics.iter().any(|diagnostic| diagnostic.message.contains("too large")));
}
