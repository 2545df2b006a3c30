//! Paths of parts cannot leave the folder of the spec, and cannot become code.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

mod common;

use common::search;
use gaitc_compiler::build::Config;
use gaitc_compiler::diagnostic::{Code, render};
use gaitc_compiler::front::parse_file;
use std::fs;
use std::path::Path;

const PART: &str = "spec = 1\n[parameters]\nc = \"1\"\n";

/// A spec that uses a part, whose path it writes as a TOML string.
fn spec(part: &str) -> String {
    let quoted = toml::Value::String(part.to_owned()).to_string();
    format!(
        "spec = 1\nname = \"fall\"\nuse = [{quoted}]\n[state]\ny = {{ unit = \"m\" }}\n\
         [modes.flight.flow]\ny = \"-c*1 [m/s]\"\n"
    )
}

#[test]
fn paths_of_parts_stay_below_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    let specs = folder.path().join("specs");
    fs::create_dir_all(specs.join("parts")).unwrap();
    // All of these are there: a path that got out would find its file.
    fs::write(folder.path().join("secret.toml"), PART).unwrap();
    fs::write(specs.join("parts/part.toml"), PART).unwrap();
    fs::write(specs.join("parts/part.txt"), PART).unwrap();
    let secret = folder.path().join("secret.toml");
    let absolute = secret.to_str().unwrap();
    let reads = |part: &str| {
        fs::write(specs.join("fall.toml"), spec(part)).unwrap();
        let parsed = parse_file(&specs.join("fall.toml")).unwrap();
        let rendered = render(&parsed.diagnostics, &parsed.sources, false);
        assert!(parsed.model.is_some() || parsed.diagnostics.iter().any(|d| d.code == Code::PartFile), "{rendered}");
        parsed.model.is_some()
    };
    assert!(reads("parts/part.toml"));
    for part in [
        absolute,
        "../secret.toml",
        "parts/../../secret.toml",
        "parts/../parts/part.toml",
        "./parts/part.toml",
        "parts//part.toml",
        "parts/part.txt",
        "parts/part.toml/",
        "parts/part.toml\0",
        "parts/part.toml\n",
        "parts\\part.toml",
        "..\\secret.toml",
        "file:///secret.toml",
        "~/secret.toml",
        "$HOME/secret.toml",
        "$(echo parts)/part.toml",
        "parts/*.toml",
        "parts/part.toml\" ]\n[let]\nx = \"1",
        "",
        "parts",
    ] {
        assert!(!reads(part), "{part:?} is read");
    }
}

/// A name that ends a string, a macro call and a comment of Rust, where files may be called so.
#[cfg(unix)]
#[test]
fn the_name_of_a_part_stays_a_string_in_generated_code() {
    let folder = tempfile::tempdir().unwrap();
    let name = "parts/a\")), (\"b\", include_str!(\"{x}\")); fn evil() {} /* ' # r#\"ü.toml";
    fs::create_dir_all(folder.path().join("specs/parts")).unwrap();
    // The name has a `/` in the comment: it is in a folder of its own.
    let path = folder.path().join("specs").join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, PART).unwrap();
    fs::write(folder.path().join("specs/fall.toml"), spec(name)).unwrap();
    let out = folder.path().join("out");
    let config = Config::new().manifest_dir(folder.path()).out_dir(&out).python(search());
    config.compile().unwrap();
    let list = fs::read_to_string(out.join("generated/mod.rs")).unwrap();
    let file = syn::parse_file(&list).unwrap();
    let functions = file.items.iter().filter(|item| matches!(item, syn::Item::Fn(_))).count();
    assert_eq!((functions, file.items.len()), (0, 2), "a module and the list:\n{list}");
    assert!(list.contains("a\\\")), (\\\"b\\\""), "{list}");
    assert!(Path::new(&out.join("generated/fall.rs")).is_file());
}
