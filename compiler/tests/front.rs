//! The front end on whole files: specs that are right, specs that are wrong (with what is said of them), and specs
//! that no one would write.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::diagnostic::{Code, render};
use gaitc_compiler::front::{Library, Parsed, parse_file, parse_text, parse_with};
use std::path::{Path, PathBuf};

fn folder(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(relative)
}

fn toml_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}

/// Parsed under its bare file name, so that messages are the same on every machine.
fn parse_here(path: &Path) -> Parsed {
    let text = std::fs::read_to_string(path).unwrap();
    parse_with(Path::new(path.file_name().unwrap()), &text, Library::Folder(path.parent().unwrap()))
}

#[test]
fn every_spec_of_the_project_is_accepted_without_a_word() {
    for path in toml_files(&folder("../specs")) {
        let parsed = parse_file(&path).unwrap();
        assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "");
        assert_eq!(parsed.model.unwrap().name, path.file_stem().unwrap().to_str().unwrap());
    }
}

/// Right in unusual ways: guards that a symmetry turns around, transitions that are each other's image, phases that a symmetry
/// shifts, guards that are small differences of large terms.
#[test]
fn unusual_specs_are_accepted_without_a_word() {
    let files = toml_files(&folder("tests/right"));
    assert!(files.len() >= 6);
    for path in files {
        let parsed = parse_here(&path);
        assert_eq!(render(&parsed.diagnostics, &parsed.sources, false), "", "{}", path.display());
    }
}

/// What is said of each file of `tests/wrong` stands beside it. `GAITC_BLESS=1` writes what is said now, and fails.
#[test]
fn wrong_specs_are_explained() {
    let bless = std::env::var_os("GAITC_BLESS").is_some();
    let mut failures = Vec::new();
    for path in toml_files(&folder("tests/wrong")) {
        let parsed = parse_here(&path);
        let said = render(&parsed.diagnostics, &parsed.sources, false);
        assert!(!said.is_empty(), "{} is accepted", path.display());
        assert_eq!(parsed.model.is_some(), !parsed.diagnostics.iter().any(|d| d.is_error()));
        let expected_path = path.with_extension("txt");
        let expected = std::fs::read_to_string(&expected_path).unwrap_or_default();
        if said != expected {
            if bless {
                std::fs::write(&expected_path, &said).unwrap();
            }
            failures.push(format!("{}:\n{said}", path.display()));
        }
    }
    assert!(failures.is_empty(), "{} files differ; said now:\n\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn every_code_has_a_test_and_an_entry_in_the_documentation() {
    let documentation = std::fs::read_to_string(folder("../docs/errors.md")).unwrap();
    let mut tested: Vec<Code> = Vec::new();
    for path in toml_files(&folder("tests/wrong")) {
        tested.extend(parse_here(&path).diagnostics.iter().map(|diagnostic| diagnostic.code));
    }
    for code in Code::ALL {
        let heading = format!("## {code}: {}", code.title());
        assert!(documentation.contains(&heading), "docs/errors.md has no heading `{heading}`");
        // Tested below: a TOML file that is no text cannot stand in the folder.
        assert!(tested.contains(code) || *code == Code::File, "no file of tests/wrong gives {code}");
    }
}

#[test]
fn files_that_are_no_text_or_too_large_are_diagnosed() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        parse_file(&path).unwrap()
    };
    let binary = write("binary.toml", b"spec = 1\nname = \"\xff\"\n");
    assert!(binary.model.is_none());
    assert_eq!(binary.diagnostics[0].code, Code::File);
    let at = gaitc_compiler::diagnostic::locate(&binary.diagnostics[0], &binary.sources).unwrap();
    assert_eq!((at.1, at.2), (2, 9));
    let large = write("large.toml", &vec![b'#'; 5 << 20]);
    assert_eq!(large.diagnostics[0].code, Code::File);
    assert!(parse_file(&folder.path().join("missing.toml")).is_err());
    let text = "#".repeat(5 << 20);
    assert_eq!(parse_text(Path::new("large.toml"), &text).diagnostics[0].code, Code::File);
}
