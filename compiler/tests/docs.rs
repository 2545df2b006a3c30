//! The documentation: every block of TOML in the language reference and in the tutorial is compiled, what they say of
//! mistakes is what is said of them, and all links between pages lead somewhere.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed unwrap fails the test

use gaitc_compiler::diagnostic::render;
use gaitc_compiler::front::{Library, Parsed, parse_with};
use gaitc_compiler::ir::Model;
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn page(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A fenced block: the words behind its fence, and its text.
#[derive(Clone)]
struct Block {
    kind: String,
    text: String,
}

/// The fenced blocks of a page, and the lines outside of them.
fn split(page: &str) -> (Vec<Block>, Vec<&str>) {
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

/// A spec, under the file name that its `name` asks for.
fn parse(text: &str, parts: &[(&str, &str)]) -> Parsed {
    let name = text.lines().find_map(|line| line.strip_prefix("name = \"")?.split('"').next());
    let file = format!("{}.toml", name.unwrap_or_else(|| panic!("a spec without a name:\n{text}")));
    parse_with(Path::new(&file), text, Library::Texts(parts))
}

fn said(parsed: &Parsed) -> String {
    render(&parsed.diagnostics, &parsed.sources, false)
}

/// The model of a spec of which nothing is said.
fn model(text: &str) -> Model {
    let parsed = parse(text, &[]);
    assert_eq!(said(&parsed), "");
    parsed.model.unwrap()
}

/// The pages of the language, in the order of the list on the first one.
fn language() -> Vec<(String, Vec<Block>)> {
    let first = page("docs/language/README.md");
    let list = first.split("\n## Pages\n").nth(1).unwrap().split("\n## ").next().unwrap();
    let names = list.lines().filter_map(|line| line.strip_prefix("- [")?.split_once("](")?.1.split_once(')'));
    let names: Vec<&str> = std::iter::once("README.md").chain(names.map(|(name, _)| name)).collect();
    let mut files: Vec<String> = std::fs::read_dir(root().join("docs/language"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    let mut listed: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    files.sort();
    listed.sort();
    assert_eq!(files, listed, "the list of pages");
    names.iter().map(|name| ((*name).to_owned(), split(&page(&format!("docs/language/{name}"))).0)).collect()
}

#[test]
fn the_language_reference_compiles() {
    let pages = language();
    let part = pages.iter().flat_map(|(_, blocks)| blocks).find(|block| block.kind == "toml part").unwrap();
    let parts = [("parts/spring.toml", part.text.as_str())];
    let (mut running, mut specs, mut failures) = (String::new(), BTreeMap::new(), Vec::new());
    for (name, blocks) in &pages {
        let compiled = blocks.iter().filter(|block| block.kind.starts_with("toml")).count();
        assert!(compiled > 0, "{name} has no example");
        for block in blocks {
            match block.kind.split(' ').collect::<Vec<_>>()[..] {
                ["toml"] => running += &block.text,
                ["toml", "part"] => {}
                ["toml", "spec" | "using"] => {
                    let parsed = parse(&block.text, &parts);
                    if !parsed.diagnostics.is_empty() {
                        failures.push(format!("{name}:\n{}", said(&parsed)));
                    }
                    specs.extend(parsed.model.map(|model| (model.name.clone(), model)));
                }
                ["toml", "wrong", code] => {
                    let parsed = parse(&block.text, &[]);
                    let codes: Vec<String> = parsed.diagnostics.iter().map(|d| d.code.to_string()).collect();
                    if codes != [code] {
                        failures.push(format!("{name}: not {code} alone:\n{}\n{}", block.text, said(&parsed)));
                    }
                }
                _ => panic!("{name}: a block of the kind `{}`", block.kind),
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    let wheel = model(&running);
    assert_eq!((wheel.measures.len(), wheel.problems.len()), (4, 2));
    assert!(wheel.transitions.iter().any(|transition| transition.surface));
    let sled = &specs["sled"];
    assert!(sled.modes[0].mass.is_some() && sled.transitions[0].also_zero.len() == 1);
    let names: Vec<&str> = specs["bouncer"].parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    assert_eq!(names, ["m", "g", "k", "l0"]);
}

/// The blocks of the tutorial grow to one spec. A mistake stands for what follows it; behind it, and behind a step that
/// is not whole, stands what is said.
#[test]
fn the_tutorial_says_what_the_compiler_says() {
    let (blocks, _) = split(&page("docs/tutorial.md"));
    let (mut spec, mut mistakes, mut failures) = (String::new(), 0, Vec::new());
    for (i, block) in blocks.iter().enumerate() {
        let text = match block.kind.as_str() {
            "toml" => {
                spec += &format!("{}{}", if spec.is_empty() { "" } else { "\n" }, block.text);
                spec.clone()
            }
            "toml mistake" => {
                mistakes += 1;
                format!("{spec}\n{}", block.text)
            }
            "text" | "text output" | "sh" => continue,
            kind => panic!("a block of the kind `{kind}`"),
        };
        let expected = blocks.get(i + 1).filter(|next| next.kind == "text").map_or("", |next| next.text.as_str());
        let said = said(&parse(&text, &[]));
        if said.trim_end() != expected.trim_end() {
            failures.push(said);
        }
    }
    assert!(failures.is_empty(), "the page says otherwise; said now:\n\n{}", failures.join("\n---\n"));
    assert_eq!(mistakes, 2);
    let hopper = model(&spec);
    assert_eq!((hopper.modes.len(), hopper.measures.len(), hopper.problems.len()), (2, 4, 1));
}

/// Models that were written from the reference alone, by someone who had a machine in mind.
#[test]
fn models_written_from_the_reference_compile() {
    for name in ["brachiator", "raibert_hopper"] {
        let found = model(&page(&format!("compiler/tests/unseen/{name}.toml")));
        assert_eq!(found.name, name);
        assert!(found.section.is_some_and(|section| section.coordinates.len() >= 3));
    }
}

/// All pages of the repository, and what is not built or hidden.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !name.starts_with('.') && name != "target" {
            pages(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "md") {
            found.push(path);
        }
    }
}

/// The anchors of a page's headings, as code hosts make them.
fn anchors(prose: &[&str]) -> Vec<String> {
    let mut seen: HashMap<String, usize> = HashMap::new();
    let headings = prose.iter().filter(|line| line.starts_with('#') && line.trim_start_matches('#').starts_with(' '));
    let anchor = |line: &&str| {
        let text = line.trim_start_matches('#').trim().to_lowercase();
        let kept: String = text.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_')).collect();
        let anchor = kept.replace(' ', "-");
        let count = seen.entry(anchor.clone()).or_default();
        *count += 1;
        if *count == 1 { anchor } else { format!("{anchor}-{}", *count - 1) }
    };
    headings.map(anchor).collect()
}

/// The targets of the links in a page's prose, without those in code.
fn links(prose: &[&str]) -> Vec<String> {
    let shown = |line: &&&str| !line.starts_with("    ");
    let text: String = prose.iter().filter(shown).flat_map(|line| [*line, "\n"]).collect();
    let outside_code: String = text.split('`').step_by(2).collect();
    let targets = outside_code.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
    targets.map(|(target, _)| target.to_owned()).collect()
}

#[test]
fn links_between_pages_lead_somewhere() {
    let mut all = Vec::new();
    pages(&root(), &mut all);
    let (mut count, mut broken) = (0, Vec::new());
    for from in &all {
        let text = std::fs::read_to_string(from).unwrap();
        let (_, prose) = split(&text);
        for target in links(&prose).into_iter().filter(|target| !target.contains("://")) {
            count += 1;
            let (file, anchor) = target.split_once('#').map_or((target.as_str(), None), |(f, a)| (f, Some(a)));
            let to = if file.is_empty() { from.clone() } else { from.parent().unwrap().join(file) };
            let there = to.exists()
                && anchor.is_none_or(|anchor| {
                    let text = std::fs::read_to_string(&to).unwrap_or_default();
                    anchors(&split(&text).1).iter().any(|other| other == anchor)
                });
            if !there {
                broken.push(format!("{}: {target}", from.strip_prefix(root()).unwrap().display()));
            }
        }
    }
    assert!(broken.is_empty(), "these links lead nowhere:\n{}", broken.join("\n"));
    assert!(count > 100, "only {count} links were seen");
}
