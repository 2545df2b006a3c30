//! `gaitc explain` and what `gaitc check` says besides diagnostics.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;

use common::{gaitc_in, json, text};
use gaitc_compiler::diagnostic::Code;
use std::fs;
use std::path::Path;

#[test]
fn every_code_is_explained() {
    for code in Code::ALL {
        let lower = code.as_str().to_lowercase();
        let (exit, out, errors) = text(&["explain", &lower]);
        assert_eq!((exit, errors.as_str()), (0, ""), "{code}");
        assert!(out.starts_with(&format!("{code}: {}\n\n", code.title())), "{out}");
        assert!(out.contains("\nWrong:\n\n    ") && out.contains("\nRight:\n\n    "), "{out}");
        assert!(!out.contains("```") && !out.contains("## ") && !out.contains("]("), "{out}");
        let (_, value) = json(&["explain", code.as_str()]);
        assert_eq!((value["code"].as_str(), value["title"].as_str()), (Some(code.as_str()), Some(code.title())));
        assert!(value["text"].as_str().unwrap().contains("```toml"));
    }
}

#[test]
fn every_entry_has_a_code() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/errors.md")).unwrap();
    for heading in page.lines().filter_map(|line| line.strip_prefix("## ")) {
        let known = Code::ALL.iter().any(|code| heading == format!("{code}: {}", code.title()));
        assert!(known, "docs/errors.md explains `{heading}`, which is no code");
    }
}

#[test]
fn without_a_code_all_are_listed() {
    let (exit, out, _) = text(&["explain"]);
    assert_eq!(exit, 0);
    for code in Code::ALL {
        assert!(out.contains(&format!("{code}  {}\n", code.title())), "{out}");
    }
    let (_, value) = json(&["explain"]);
    assert_eq!(value["codes"].as_array().unwrap().len(), Code::ALL.len());
}

#[test]
fn unknown_codes_are_wrong_input() {
    for (code, part) in
        [("E0170", "did you mean `E0107`?"), ("nonsense", "codes look like `E0107`"), ("", "codes look")]
    {
        let (exit, out, errors) = text(&["explain", code]);
        assert_eq!((exit, out.as_str()), (1, ""), "{code}");
        assert!(errors.contains("no diagnostic has the code") && errors.contains(part), "{errors}");
        assert!(errors.contains("`gaitc explain` lists all"), "{errors}");
    }
    let (exit, value) = json(&["explain", "E9999"]);
    assert_eq!((exit, value["status"].as_str()), (1, Some("error")));
}

/// Runs `check` in a folder.
fn check(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = gaitc_in(folder, &[&["check"], args].concat());
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn check_ends_with_a_hint_once() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("compiler/tests/wrong");
    let (exit, out, _) = check(&folder, &["range.toml", "cycle.toml"]);
    assert_eq!(exit, 1);
    assert_eq!(out.matches("gaitc explain").count(), 1, "{out}");
    assert!(out.ends_with("\nfor more about E0206: gaitc explain E0206 (also E0404)\n"), "{out}");
    assert!(!check(&folder, &["range.toml", "--json"]).1.contains("gaitc explain"));
    let (exit, out, _) = check(&folder.join("../../../specs"), &["prescribed_length.toml"]);
    assert_eq!((exit, out.as_str()), (0, "prescribed_length.toml: no problems\n"));
}

#[test]
fn parts_are_checked_by_themselves() {
    let specs = Path::new(env!("CARGO_MANIFEST_DIR")).join("specs");
    for part in fs::read_dir(specs.join("parts")).unwrap() {
        let name = format!("parts/{}", part.unwrap().file_name().to_str().unwrap());
        let (exit, out, errors) = check(&specs, &[&name]);
        assert_eq!((exit, out, errors.as_str()), (0, format!("{name}: part, no problems\n"), ""));
    }
    let folder = tempfile::tempdir().unwrap();
    let head = "spec = 1\n[parameters]\nk = \"3 N/m\"\nl = \"1 m\"\n";
    let rows = [
        ("[let]\nF = \"k*(length - l)\"\nv = \"d(r, phi)*foo(w)\"\n", None),
        (
            "[modes.stance.flow]\nx = \"v\"\n[problems.p]\nmaximize = \"speed\"\nvary = { psi = [\"0 deg\", \"1 deg\"] }\n",
            None,
        ),
        ("[let]\nF = \"k + l\"\n", Some("E0301")),
        ("[let]\nF = \"k*\"\n", Some("E0101")),
        ("[let]\nl = \"2*k\"\n", Some("E0203")),
        ("[let]\na = \"b\"\nb = \"a\"\n", Some("E0206")),
        ("[memory]\nn = 1\n", Some("E0005")),
        ("[lets]\nF = \"k\"\n", Some("E0003")),
        ("[measures]\nF = { expr = \"cycle_max(k*l)\", unit = \"m\" }\n", Some("E0302")),
        ("[state]\nx = { unit = \"mm/parsec\" }\n", Some("E0104")),
        ("[use]\nother = \"parts/none.toml\"\n", Some("E0010")),
    ];
    for (tables, code) in rows {
        fs::write(folder.path().join("part.toml"), format!("{head}{tables}")).unwrap();
        let (exit, out, errors) = check(folder.path(), &["part.toml"]);
        match code {
            None => assert_eq!((exit, out.as_str()), (0, "part.toml: part, no problems\n"), "{tables}"),
            Some(code) => {
                assert_eq!((exit, errors.as_str()), (1, "error: 1 error in the spec\n"), "{tables}\n{out}");
                assert!(out.contains(&format!("error[{code}]")), "{tables}\n{out}");
            }
        }
    }
    // A file with what only a spec has is a spec.
    fs::write(folder.path().join("part.toml"), format!("{head}[section]\n")).unwrap();
    assert!(check(folder.path(), &["part.toml"]).1.contains("`name` of the spec is missing"));
}

#[test]
fn parts_of_parts_are_seen_from_the_folder_of_the_specs() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write(
        "parts/a.toml",
        "spec = 1\nuse = [\"parts/b.toml\"]\n[let]\nF = \"k*x + c\"\n[state]\nx = { unit = \"m\" }\n",
    );
    write("parts/b.toml", "spec = 1\n[parameters]\nk = \"3 N/m\"\nc = \"1 N\"\n");
    assert_eq!(check(folder.path(), &["parts/a.toml"]).1, "parts/a.toml: part, no problems\n");
    write("parts/b.toml", "spec = 1\n[parameters]\nk = \"3 N/m\"\nc = \"1 W\"\n");
    assert!(check(folder.path(), &["parts/a.toml"]).1.contains("error[E0301]"));
}

#[test]
fn check_goes_on_and_into_folders() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("a/b")).unwrap();
    let part = "spec = 1\n[parameters]\nk = \"3 N/m\"\n";
    fs::write(folder.path().join("a/z.toml"), part).unwrap();
    fs::write(folder.path().join("a/b/y.toml"), part).unwrap();
    fs::write(folder.path().join("a/b/no.txt"), "no spec").unwrap();
    let (exit, out, errors) = check(folder.path(), &["none.toml", "a"]);
    assert_eq!((exit, out.as_str()), (1, "a/b/y.toml: part, no problems\na/z.toml: part, no problems\n"));
    assert!(errors.contains("cannot read `none.toml`") && errors.contains("1 file could not be read"), "{errors}");
    let output = gaitc_in(folder.path(), &["check", "none.toml", "a", "--json"]);
    let value: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(value["diagnostics"].as_array().unwrap().len(), 1, "{value:#}");
    assert_eq!(
        (value["diagnostics"][0]["code"].as_str(), value["diagnostics"][0]["file"].as_str()),
        (Some("E0002"), Some("none.toml"))
    );
    fs::create_dir(folder.path().join("empty")).unwrap();
    let (exit, _, errors) = check(folder.path(), &["empty"]);
    assert!(exit == 1 && errors.contains("no file below this folder ends in .toml"), "{errors}");
}
