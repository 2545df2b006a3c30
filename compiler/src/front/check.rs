//! Checking a file by itself: a spec, or a part without anyone who uses it.

use super::parts::{Library, Loader};
use super::{Parsed, SIZE_LIMIT, document, lower, parse_file, read, sorted};
use crate::diagnostic::{Code, Diagnostic};
use crate::files::{self, FileError};
use crate::front::spec::Spec;
use crate::source::{SourceMap, Span};
use std::path::Path;

/// What was found in a file.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The diagnostics, and the model of a spec.
    pub parsed: Parsed,
    /// Whether the file is a part, which never gives a model.
    pub part: bool,
}

/// Checks a spec, or a part: a file without `name` in a folder called `parts`, or one that has no transitions and no section
/// either. Of a part is checked what does not depend on its user:
/// syntax, tables and keys, units, names that clash, and the dimensions of what its own names determine.
///
/// # Errors
/// As [`parse_file`].
pub fn check_file(path: &Path) -> Result<Checked, FileError> {
    if let Some(parsed) = files::read_text(path, SIZE_LIMIT).ok().and_then(|text| part(path, &text)) {
        return Ok(Checked { parsed, part: true });
    }
    Ok(Checked { parsed: parse_file(path)?, part: false })
}

/// Whether a file may be meant as a spec or a part, as far as can be seen without reading it as one: it has the key `spec`
/// at its top, or, where its TOML is broken, a line that begins with it. What cannot be looked into may be anything.
pub fn may_be_spec(path: &Path) -> bool {
    let Ok(bytes) = files::read_start(path, SIZE_LIMIT) else { return true };
    let text = String::from_utf8_lossy(&bytes);
    let (document, broken) = document::top_level(&text);
    let begins =
        |line: &str| line.trim_start().strip_prefix("spec").is_some_and(|rest| rest.trim_start().starts_with('='));
    document.iter().any(|key| key == "spec") || (broken && text.lines().any(begins))
}

/// Checks a text as a part; `None` where it is none.
fn part(path: &Path, text: &str) -> Option<Parsed> {
    let mut sources = SourceMap::default();
    let file = sources.add(path, text);
    let mut diagnostics = Vec::new();
    let document = document::parse(file, text, &mut diagnostics);
    // Where TOML is broken the tables of a spec may be lost; an empty file is no part. A file among the parts is one, and
    // hears of tables that it cannot have.
    let of_spec: &[&str] = if is_among_parts(path) { &["name"] } else { &["name", "transitions", "section"] };
    let of_spec = of_spec.iter().any(|key| document.get(key).is_some());
    if of_spec || !diagnostics.is_empty() || document.entries.is_empty() {
        return None;
    }
    let start = Span { file, start: 0, end: 0 };
    let mut spec = read::read_part(&document, start, true, &mut diagnostics);
    let root = folder_of_specs(path, &spec);
    let name = root.join(path.file_name().unwrap_or_default());
    let loaded = Loader::new(Library::Folder(root), &name, &mut sources, &mut diagnostics).load_part(&mut spec);
    if loaded.whole && !diagnostics.iter().any(|diagnostic| diagnostic.code == Code::TooLarge) {
        let mut found = Vec::new();
        lower::lower(&spec, &sources, &mut found);
        diagnostics.extend(found.into_iter().filter(is_of_the_part));
    }
    let (diagnostics, parts) = (sorted(diagnostics), loaded.names);
    Some(Parsed { sources, model: None, observations: None, diagnostics, parts, spec: None })
}

/// Whether a folder of the path is called `parts`; of a file's bare name, the folder where it lies.
fn is_among_parts(path: &Path) -> bool {
    let called = |folder: &Path| folder.file_name().is_some_and(|name| name == "parts");
    let lies_there = || std::path::absolute(path).is_ok_and(|path| path.parent().is_some_and(called));
    path.ancestors().skip(1).any(called) || lies_there()
}

/// The folder from which the parts that a part uses are seen, that of the specs: the nearest one above the part that
/// has them.
fn folder_of_specs<'p>(path: &'p Path, spec: &Spec) -> &'p Path {
    let own = path.parent().unwrap_or(Path::new(""));
    let has_all = |folder: &&Path| spec.uses.iter().all(|item| folder.join(&item.part.value).is_file());
    own.ancestors().find(has_all).unwrap_or(own)
}

/// Whether a diagnostic would be one for every user of the part. Names, equations and modes that are not there may come
/// from the user, and with them what makes other things used, reachable or regular.
fn is_of_the_part(diagnostic: &Diagnostic) -> bool {
    diagnostic.is_error()
        && !matches!(
            diagnostic.code,
            Code::UndefinedName
                | Code::UndefinedFunction
                | Code::WithRespectTo
                | Code::MissingEquation
                | Code::UnknownReference
                | Code::SuperfluousEquation
                | Code::GuardConstant
                | Code::Mass
                | Code::NoReturn
        )
}
