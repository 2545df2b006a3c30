//! The commands that the tutorials and how-to pages show are run, in order and in one folder with the specs, and print what
//! the pages say. What a page calls a file is written there first.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod common;
#[path = "../compiler/tests/pages/mod.rs"]
mod pages;

use common::gaitc_in;
use pages::{commands, files, page, root, shows, split};
use std::fs;
use std::path::Path;

/// Copies a folder of files and folders.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

/// Runs all commands of a page; so many have to be there.
fn runs(path: &str, at_least: usize) {
    let folder = tempfile::tempdir().unwrap();
    copy(&root().join("specs"), &folder.path().join("specs"));
    let blocks = split(&page(path)).0;
    for (name, text) in files(&blocks) {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let all = commands(&blocks);
    assert!(all.len() >= at_least, "{path}: only {} commands", all.len());
    let mut failures = Vec::new();
    for shown in &all {
        let words: Vec<&str> = shown.words.iter().map(String::as_str).collect();
        let output = gaitc_in(folder.path(), &words);
        let (out, err) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
        if let Some(file) = &shown.into {
            fs::write(folder.path().join(file), &out).unwrap();
        }
        let printed = format!("{out}{err}");
        let as_shown = shown.printed.as_ref().is_none_or(|expected| shows(expected, &printed));
        if output.status.code() != Some(shown.exit_code) || !as_shown {
            failures.push(format!("gaitc {}: {:?}\n{printed}", words.join(" "), output.status.code()));
        }
    }
    assert!(failures.is_empty(), "{path} says otherwise:\n\n{}", failures.join("\n---\n"));
}

#[test]
fn the_climber_tutorial_prints_what_it_says() {
    runs("docs/tutorial_climber.md", 10);
}

#[test]
fn the_how_to_pages_print_what_they_say() {
    runs("docs/howto.md", 10);
}
