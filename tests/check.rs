//! `gaitc check` on folders and parts: which files are looked at, and as what.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::gaitc_in;
use std::fs;
use std::path::Path;

/// A spec without mistakes, named after its file.
const SPEC: &str = r#"
spec = 1
name = "fall"
[parameters]
g = "9.81 m/s^2"
[state]
x = { unit = "m" }
v = { unit = "m/s" }
[modes.fall.flow]
x = "v"
v = "-g"
"#;

fn write(folder: &Path, files: &[(&str, &str)]) {
    for (path, text) in files {
        let path = folder.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
}

/// Exit code, stdout and stderr of `check` with these arguments.
fn check(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = gaitc_in(folder, &[&["check"], args].concat());
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_folder_stands_for_the_specs_in_it() {
    let folder = tempfile::tempdir().unwrap();
    write(
        folder.path(),
        &[
            ("specs/fall.toml", SPEC),
            ("specs/parts/drag.toml", "spec = 1\n[let]\ndrag = \"v\"\n"),
            ("Cargo.toml", "[package]\nname = \"mine\"\n"),
            ("broken.toml", "[package\nname = x\n"),
            ("empty.toml", ""),
            ("notes/specs.toml", "[tool]\nspec = 1\n"),
            (".hidden.toml", "spec = 1\n"),
            (".git/config.toml", "spec = 1\n"),
            ("target/debug/fall.toml", "spec = 1\n"),
        ],
    );
    let (code, out, err) = check(folder.path(), &["."]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert_eq!(out, "./specs/fall.toml: no problems\n./specs/parts/drag.toml: part, no problems\n");
    // A spec whose TOML is broken is one all the same.
    write(folder.path(), &[("specs/half.toml", "spec = 1\nname = \"half\"\n[state\n")]);
    let (code, out, _) = check(folder.path(), &["specs"]);
    assert!(code == 1 && out.contains("specs/half.toml:3"), "{out}");
    // Who names a file or a folder wants it to be checked.
    let (code, out, _) = check(folder.path(), &["Cargo.toml"]);
    assert!(code == 1 && out.contains("unknown key `package` of the part"), "{out}");
    assert_eq!(check(folder.path(), &["target"]).1, "target/debug/fall.toml: part, no problems\n");
}

#[test]
fn a_folder_without_specs_says_so() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[("Cargo.toml", "[package]\nname = \"mine\"\n"), ("target/fall.toml", SPEC)]);
    let (code, _, err) = check(folder.path(), &["."]);
    assert!(code == 1 && err.contains("no TOML file below this folder has the key `spec`"), "{err}");
    let (code, out, _) = check(folder.path(), &[".", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, value["diagnostics"][0]["code"].as_str()), (1, Some("E0002")), "{value:#}");
}

#[test]
fn a_file_among_the_parts_is_a_part() {
    let folder = tempfile::tempdir().unwrap();
    let part = "spec = 1\n[transitions.stop]\nfrom = \"fall\"\n[section]\nafter = \"stop\"\n";
    write(folder.path(), &[("specs/parts/legs/leg.toml", part), ("specs/leg.toml", part)]);
    let refused = ["a part cannot have `transitions`", "a part cannot have `section`"];
    for path in ["specs/parts/legs/leg.toml", "specs/parts"] {
        let (code, out, _) = check(folder.path(), &[path]);
        assert!(code == 1 && refused.iter().all(|said| out.contains(said)), "{out}");
        assert_eq!(out.matches("error[").count(), 2, "{out}");
    }
    // The folder counts also where the path does not name it.
    fs::copy(folder.path().join("specs/leg.toml"), folder.path().join("specs/parts/leg.toml")).unwrap();
    let (_, out, _) = check(&folder.path().join("specs/parts"), &["leg.toml"]);
    assert!(refused.iter().all(|said| out.contains(said)), "{out}");
    // Elsewhere the same text is a spec, which lacks its name.
    let (_, out, _) = check(folder.path(), &["specs/leg.toml"]);
    assert!(out.contains("`name` of the spec is missing"), "{out}");
}
