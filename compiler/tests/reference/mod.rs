//! The pages of the language reference as one text, in the order of the list on the first of them.

#![allow(clippy::unwrap_used, clippy::expect_used)] // a failed unwrap fails the test

use std::path::Path;

/// All pages, one after the other.
pub(crate) fn pages() -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/language");
    let page = |name: &str| std::fs::read_to_string(folder.join(name)).expect(name);
    let first = page("README.md");
    let names = first.lines().filter_map(|line| line.strip_prefix("- [")?.split_once("](")?.1.split_once(')'));
    names.fold(first.clone(), |all, (name, _)| all + &page(name))
}

/// The fenced blocks of a text that begin with `fence`.
pub(crate) fn blocks(text: &str, fence: &str) -> Vec<String> {
    let blocks: Vec<String> =
        text.split(fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect();
    assert!(!blocks.is_empty(), "no `{fence}`");
    blocks
}
