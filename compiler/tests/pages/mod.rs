//! Pages of the documentation: their fenced blocks, and the commands that they show with what these print.

#![allow(dead_code, unreachable_pub)] // shared by test files of two crates, none of which uses all of it
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use std::path::{Path, PathBuf};

/// A fenced block: the words behind its fence, and its text.
#[derive(Clone, Debug)]
pub struct Block {
    pub kind: String,
    pub text: String,
}

/// A command of a page and what is to be seen of it.
#[derive(Debug, PartialEq)]
pub struct Shown {
    /// The words of the command line, without the program.
    pub words: Vec<String>,
    /// The file that stdout goes to, behind `>`.
    pub into: Option<String>,
    pub exit_code: i32,
    /// What is printed; `...` stands for lines, or the end of one, that are left out.
    pub printed: Option<String>,
}

/// The folder of the repository.
pub fn root() -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found = crate_folder.ancestors().take(2).find(|folder| folder.join("docs/tutorial.md").is_file());
    found.expect("docs/tutorial.md").to_owned()
}

/// The text of a page.
pub fn page(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The fenced blocks of a page, and the lines outside of them.
pub fn split(page: &str) -> (Vec<Block>, Vec<&str>) {
    let (mut blocks, mut prose, mut open) = (Vec::new(), Vec::new(), None::<Block>);
    for line in page.lines() {
        match (line.strip_prefix("```"), open.take()) {
            (Some(kind), None) => open = Some(Block { kind: kind.to_owned(), text: String::new() }),
            (Some(_), Some(block)) => blocks.push(block),
            (None, Some(mut block)) => {
                block.text += line;
                block.text.push('\n');
                open = Some(block);
            }
            (None, None) => prose.push(line),
        }
    }
    assert!(open.is_none(), "a block is not closed");
    (blocks, prose)
}

/// The commands in blocks of the kind `sh` (`sh exit 2` where they end with that code), in order. What the last of a block
/// prints stands in a block of the kind `text output` that follows it.
pub fn commands(blocks: &[Block]) -> Vec<Shown> {
    let mut all = Vec::new();
    for (i, block) in blocks.iter().enumerate() {
        let exit_code = match block.kind.split(' ').collect::<Vec<_>>()[..] {
            ["sh"] => 0,
            ["sh", "exit", code] => code.parse().unwrap(),
            _ => continue,
        };
        let lines = block.text.lines().filter_map(|line| line.strip_prefix("gaitc "));
        all.extend(lines.map(|line| command(line, exit_code)));
        let printed = blocks.get(i + 1).filter(|next| next.kind == "text output");
        if let (Some(printed), Some(last)) = (printed, all.last_mut()) {
            last.printed = Some(printed.text.clone());
        }
    }
    all
}

/// The files that a page shows in blocks of the kind `toml file NAME`, with their names.
pub fn files(blocks: &[Block]) -> Vec<(&str, &str)> {
    blocks.iter().filter_map(|block| Some((block.kind.strip_prefix("toml file ")?, block.text.as_str()))).collect()
}

fn command(line: &str, exit_code: i32) -> Shown {
    let mut words = words(line);
    let into = words.iter().position(|word| word == ">").map(|at| words.split_off(at).swap_remove(1));
    Shown { words, into, exit_code, printed: None }
}

/// Splits a command line at spaces outside single quotes; `#` begins a comment.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '\'' => quoted = !quoted,
            '#' if !quoted && words.last().is_some_and(String::is_empty) => break,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().unwrap().push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Whether a text is what a page shows of it.
pub fn shows(shown: &str, text: &str) -> bool {
    let lines = |text: &str| text.trim_end().lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>();
    let (shown, text) = (lines(shown), lines(text));
    let mut pieces = shown.split(|line| line.trim() == "...");
    let first = pieces.next().unwrap_or_default();
    let rest: Vec<&[String]> = pieces.collect();
    let Some((last, between)) = rest.split_last() else {
        return text.len() == first.len() && same(first, &text);
    };
    let mut at = first.len();
    if text.len() < at || !same(first, &text[..at]) {
        return false;
    }
    for piece in between {
        let found = (at..=text.len().saturating_sub(piece.len())).find(|&i| same(piece, &text[i..]));
        let Some(found) = found else { return false };
        at = found + piece.len();
    }
    text.len() >= at + last.len() && same(last, &text[text.len() - last.len()..])
}

/// Whether lines begin with those of a page.
fn same(shown: &[String], lines: &[String]) -> bool {
    let one = |(shown, line): (&String, &String)| match shown.strip_suffix(" ...") {
        Some(head) => line.starts_with(head),
        None => shown == line,
    };
    lines.len() >= shown.len() && shown.iter().zip(lines).all(one)
}
