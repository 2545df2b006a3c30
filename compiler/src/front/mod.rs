//! The front end: the text of a spec to the intermediate representation, or to diagnostics.
//!
//! The stages, each in its folder or file: TOML with places (`document`), tables and keys checked and expressions
//! parsed (`read`, giving `spec`), parts taken in (`parts`), names resolved, dimensions checked and expressions lowered (`lower`). All
//! problems of a file are reported in one go; what depends on something broken is silent.

mod check;
mod constant;
mod document;
pub mod flags;
mod format;
pub(crate) mod keys;
mod lexer;
mod lower;
pub(crate) mod names;
mod observe;
pub(crate) mod parser;
mod parts;
pub(crate) mod quantity;
pub(crate) mod read;
mod si;
pub(crate) mod spec;
pub(crate) mod syntax;
pub(crate) mod text;
pub mod units;

use crate::diagnostic::{Code, Diagnostic};
use crate::files::{self, FileError, Problem};
use crate::ir::Model;
use crate::ir::canonical::hex_digest;
use crate::source::{FileId, SourceMap, Span};
pub use check::{Checked, check_file, may_be_spec};
pub use format::{format_exact, format_number, format_quantity, format_si, in_unit};
pub use keys::{LONGEST_PERIOD, MOST_ROBUST};
pub use names::{is_module_name, suggest};
pub use observe::Observations;
pub use parser::shortened;
pub use parts::Library;
use parts::Loader;
pub use si::{si_unit, si_unit_like};
use std::path::Path;
use std::sync::Arc;

/// Largest spec in bytes.
const SIZE_LIMIT: u64 = 4 << 20;

/// Longest line of a spec in bytes. Each message shows its line: many about a long one would take minutes.
const LINE_LIMIT: usize = 20_000;

/// What became of a spec.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The text and those of its parts, for rendering diagnostics.
    pub sources: SourceMap,
    /// The model; `Some` if and only if there is no error.
    pub model: Option<Model>,
    /// What can be observed along its runs; as the model.
    pub observations: Option<Observations>,
    /// Errors and warnings in the order of the text, then of its parts.
    pub diagnostics: Vec<Diagnostic>,
    /// The parts that were read, as paths seen from the folder of the spec, with `/`.
    pub parts: Vec<String>,
    /// The spec as it was written, joined with its parts, for `show`; `None` without a model.
    pub(crate) spec: Option<Arc<spec::Spec>>,
}

impl Parsed {
    /// Hash of everything that was read, the spec and its parts: 64 hexadecimal digits. Another text is another hash, also where the
    /// equations are the same.
    pub fn digest(&self) -> String {
        let digests: String = self.sources.texts().map(|text| hex_digest(text.as_bytes())).collect();
        hex_digest(digests.as_bytes())
    }
}

/// Reads a spec from a file, and its parts from the file's folder.
///
/// # Errors
/// When it is no regular file, or cannot be opened or read. A file that is too large or not UTF-8 gives a diagnostic.
pub fn parse_file(path: &Path) -> Result<Parsed, FileError> {
    let bytes = match files::read(path, SIZE_LIMIT) {
        Ok(bytes) => bytes,
        Err(error) => {
            let Problem::TooLarge { bytes, most } = error.problem() else { return Err(error) };
            let message = format!("this file has {bytes} bytes; a spec has at most {most}");
            return Ok(unreadable(path, "", 0, &message));
        }
    };
    Ok(match std::str::from_utf8(&bytes) {
        Ok(text) => parse_with(path, text, Library::Folder(path.parent().unwrap_or(Path::new("")))),
        Err(error) => {
            let valid = String::from_utf8_lossy(bytes.get(..error.valid_up_to()).unwrap_or(&[]));
            unreadable(path, &valid, valid.len(), "the file is not UTF-8 from here on")
        }
    })
}

/// Reads a spec that uses no parts from its text; `path` is how messages call it, and its stem is the name that the
/// model must have.
pub fn parse_text(path: &Path, text: &str) -> Parsed {
    parse_with(path, text, Library::Texts(&[]))
}

/// Reads a spec from its text, and its parts from a library; `path` is how messages call it, and its stem is the name
/// that the model must have.
pub fn parse_with(path: &Path, text: &str, library: Library<'_>) -> Parsed {
    if text.len() as u64 > SIZE_LIMIT {
        let message = format!("this text has {} bytes; a spec has at most {SIZE_LIMIT}", text.len());
        return unreadable(path, "", 0, &message);
    }
    if let Some((start, message)) = long_line(text) {
        return unreadable(path, text, start, &message);
    }
    let mut sources = SourceMap::default();
    let file = sources.add(path, text);
    let mut diagnostics = Vec::new();
    let document = document::parse(file, text, &mut diagnostics);
    let complete = diagnostics.is_empty();
    let start = Span { file, start: 0, end: 0 };
    let mut spec = read::read(&document, start, complete, &mut diagnostics);
    let loaded = Loader::new(library, path, &mut sources, &mut diagnostics).load(&mut spec, start);
    let mut lowered = None;
    // Where TOML is broken or a part is missing definitions may be lost: what would be said of names is unreliable.
    if complete && loaded.whole && !diagnostics.iter().any(|diagnostic| diagnostic.code == Code::TooLarge) {
        check_file_name(&spec, path, &mut diagnostics);
        lowered = Some(lower::lower(&spec, &sources, &mut diagnostics));
    }
    let whole = lowered.filter(|_| !diagnostics.iter().any(Diagnostic::is_error));
    let (model, observed) = whole.unzip();
    let diagnostics = sorted(diagnostics);
    let spec = model.is_some().then(|| Arc::new(spec));
    let observations = observed.zip(spec.clone());
    let observations = observations.map(|(observed, spec)| Observations::new(observed, spec, sources.clone()));
    Parsed { sources, model, observations, diagnostics, parts: loaded.names, spec }
}

/// Where a line begins that is too long, and what is to be said of it.
fn long_line(text: &str) -> Option<(usize, String)> {
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        if line.len() > LINE_LIMIT {
            return Some((start, format!("this line has {} bytes; a line has at most {LINE_LIMIT}", line.len())));
        }
        start += line.len();
    }
    None
}

fn unreadable(path: &Path, text: &str, at: usize, message: &str) -> Parsed {
    let mut sources = SourceMap::default();
    let file: FileId = sources.add(path, text);
    let diagnostic = Diagnostic::error(Code::File, message).at(Span { file, start: at, end: at }, "");
    Parsed { sources, model: None, observations: None, diagnostics: vec![diagnostic], parts: Vec::new(), spec: None }
}

fn check_file_name(spec: &spec::Spec, path: &Path, diagnostics: &mut Vec<Diagnostic>) {
    let (Some(name), Some(stem)) = (&spec.name, path.file_stem().and_then(|stem| stem.to_str())) else {
        return;
    };
    if name.value != stem {
        let message = format!("the model is named `{}`, its file `{stem}`", parser::shortened(&name.value));
        let help = format!("name the file `{}.toml`, or write `name = \"{stem}\"`", parser::shortened(&name.value));
        diagnostics.push(Diagnostic::error(Code::NameMismatch, message).at(name.span, "").help(help));
    }
}

/// Most diagnostics of one spec; beyond that errors only, and no more than this.
const DIAGNOSTIC_LIMIT: usize = 1000;

/// In the order of the texts, each problem of each place once.
fn sorted(mut diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    diagnostics.sort_by_key(|diagnostic| diagnostic.primary());
    let mut seen = std::collections::HashSet::new();
    diagnostics.retain(|diagnostic| seen.insert((diagnostic.code, diagnostic.primary(), diagnostic.message.clone())));
    if diagnostics.len() > DIAGNOSTIC_LIMIT && diagnostics.iter().any(Diagnostic::is_error) {
        diagnostics.retain(Diagnostic::is_error);
    }
    diagnostics.truncate(DIAGNOSTIC_LIMIT);
    diagnostics
}
