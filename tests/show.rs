//! `gaitc show`: every model in every format, a spec of all constructs with hostile texts against golden files, and
//! which spec is shown.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
#[path = "show/markup.rs"]
mod markup;

use common::{gaitc_in, json, text};
use gaitc::models::MODELS;
use std::path::Path;

const FORMATS: [&str; 3] = ["text", "latex", "markdown"];
const HOPPER: &str = "tests/show/hopper.toml";

fn shown(args: &[&str]) -> String {
    let (code, out, errors) = text(&[&["show"], args].concat());
    assert_eq!((code, errors.as_str()), (0, ""), "{args:?}");
    out
}

/// All specs: those of the registry by name, and the one of this test.
fn specs() -> Vec<&'static str> {
    MODELS.iter().map(|entry| entry.compiled.info().name).chain([HOPPER]).collect()
}

#[test]
fn every_model_is_shown_in_every_format() {
    for spec in specs() {
        markup::check_latex(&shown(&[spec, "--format", "latex"]));
        markup::check_markdown(&shown(&[spec, "--format", "markdown"]));
        markup::check_dot(&shown(&[spec, "--graph", "dot"]));
        assert!(shown(&[spec, "--graph", "text"]).contains("(section)"), "{spec}");
        for line in shown(&[spec]).lines() {
            assert!(line.chars().count() <= 100 && !line.chars().any(char::is_control), "{spec}: {line}");
        }
        let (code, value) = json(&["show", spec]);
        assert_eq!(code, 0, "{spec}");
        for key in ["states", "modes", "transitions", "parameters"] {
            assert!(!value[key].as_array().unwrap().is_empty(), "{spec}: {key}");
        }
        for equation in value["modes"][0]["equations"].as_array().unwrap() {
            let (source, latex) = (&equation["flow"]["source"], &equation["flow"]["latex"]);
            assert!(!source.as_str().unwrap().is_empty(), "{spec}: {equation}");
            markup::check_math(latex.as_str().unwrap());
        }
    }
}

/// What is shown stands in `tests/show`. `GAITC_BLESS=1` writes what is shown now, and fails.
#[test]
fn pages_are_those_of_the_golden_files() {
    let mut changed = Vec::new();
    let dot = ("dot", shown(&[HOPPER, "--graph", "dot"]));
    let pages = FORMATS.map(|format| (format, shown(&[HOPPER, "--format", format])));
    for (format, page) in pages.into_iter().chain([dot]) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/show/hopper.{format}"));
        if page != std::fs::read_to_string(&path).unwrap_or_default() {
            if std::env::var_os("GAITC_BLESS").is_some() {
                std::fs::write(&path, &page).unwrap();
            }
            changed.push(format!("{}:\n{page}", path.display()));
        }
    }
    assert!(changed.is_empty(), "shown now:\n\n{}", changed.join("\n"));
}

#[test]
fn json_says_what_the_pages_say() {
    let (_, value) = json(&["show", HOPPER]);
    assert_eq!(value["model"], "hopper");
    let parameter = |name: &str| {
        let all = value["parameters"].as_array().unwrap();
        all.iter().find(|p| p["name"] == name).unwrap_or_else(|| panic!("no {name}")).clone()
    };
    assert_eq!(parameter("m")["range"], serde_json::json!([0.5, 5.0]));
    assert_eq!(parameter("F_max")["value"], 30.0);
    assert_eq!(parameter("F_max")["part"], "parts/pull_&_push.toml");
    assert_eq!(parameter("k_0")["part"], "parts/pull_&_push.toml");
    assert!(parameter("g")["part"].is_null());
    assert_ne!(parameter("l_0")["symbol"], parameter("l0")["symbol"]);
    let names: Vec<&str> =
        value["definitions"].as_array().unwrap().iter().map(|d| d["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"wave") && names.contains(&"pull"), "{names:?}");
    assert!(!names.contains(&"dead") && !names.contains(&"dead_2"), "{names:?}");
    // A part's name in an expression is that which the spec gives it.
    let pull = value["definitions"].as_array().unwrap().iter().find(|d| d["name"] == "pull").unwrap();
    assert_eq!(pull["source"], "max(-F_max, min(F_max, k_0*x))");
    let row = &value["modes"][0]["equations"][1];
    assert_eq!((row["name"].as_str(), row["mass"].as_array().unwrap().len()), (Some("v"), 2));
    assert_eq!(value["transitions"][0]["when"]["source"], "v > 0 and tau > 1 [ms]");
    assert_eq!(value["problems"][0]["sense"], "maximize");
}

#[test]
fn a_name_is_looked_up_as_gait_does() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let output = gaitc_in(folder.path(), &[&["show"], args].concat());
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
    };
    // Embedded: there is no file.
    let (code, page, _) = run(&["prescribed_length"]);
    assert!(code == 0 && page.contains("20 deg"), "{page}");
    let spec = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/prescribed_length.toml"));
    let spec = spec.unwrap().replace("\"20 deg\"", "\"21 deg\"");
    std::fs::create_dir(folder.path().join("specs")).unwrap();
    std::fs::write(folder.path().join("specs/prescribed_length.toml"), &spec).unwrap();
    assert!(run(&["prescribed_length"]).1.contains("21 deg"));
    // What is not compiled is shown as well, by name and by path.
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    let own = spec.replace("name = \"prescribed_length\"", "name = \"own\"");
    std::fs::write(folder.path().join("mine/own.toml"), own).unwrap();
    assert!(run(&["own", "--specs", "mine"]).1.starts_with("own ·"));
    assert!(run(&["mine/own.toml"]).1.starts_with("own ·"));
    for (args, part) in [
        (&["prescribed_length", "--specs", "mine"][..], "cannot read `mine/prescribed_length.toml`"),
        (&["prescribed_lenght"], "did you mean `prescribed_length`?"),
        (&["../mine/own"], "no model is named"),
        (&["nothing.toml"], "cannot read `nothing.toml`"),
        (&["mine"], "models: "),
        (&["own", "--specs", "mine", "--graph", "dot", "--format", "latex"], "cannot be used with"),
    ] {
        let (code, _, errors) = run(args);
        assert!(code == 1 && errors.contains(part), "{args:?}: {errors}");
    }
    // A spec with errors has no equations to show.
    std::fs::write(folder.path().join("mine/own.toml"), spec.replace("p_theta/r", "p_teta/r")).unwrap();
    let (code, out, errors) = run(&["mine/own.toml"]);
    assert!(code == 1 && out.is_empty() && errors.contains("error[E0201]"), "{errors}");
}

/// A sum as long as an expression can be is shown, not a stack that overflows.
#[test]
fn long_expressions_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let spec = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/prescribed_length.toml"));
    for (one, join, count) in [("q_theta", "+", 1200), ("1", "*", 4900), ("1", "-", 4900)] {
        let long = vec![one; count].join(join);
        let spec = spec.as_ref().unwrap().replace("\"q_theta + delta\"", &format!("\"q_theta + delta + {long}\""));
        std::fs::write(folder.path().join("prescribed_length.toml"), spec).unwrap();
        for format in FORMATS {
            let output = gaitc_in(folder.path(), &["show", "prescribed_length.toml", "--format", format]);
            let errors = String::from_utf8(output.stderr).unwrap();
            assert_eq!((output.status.code(), errors.as_str()), (Some(0), ""), "{join} {format}");
        }
    }
}
