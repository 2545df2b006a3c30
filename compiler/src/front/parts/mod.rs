//! Parts: files of definitions that several specs share, pulled in by `use`. They are found, bound to what their user
//! says of them (`bind`) and joined with the spec (`join`), all before names are resolved.

mod bind;
mod join;

use super::document;
use super::parser::shortened;
use super::read::{STATE_LIMIT, nothing_in, read_part};
use super::spec::{Spec, Use};
use super::text::Text;
use super::{SIZE_LIMIT, long_line};
use crate::diagnostic::{Code, Diagnostic};
use crate::files;
use crate::source::{FileId, SourceMap, Span};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Most parts of a spec, each counted as often as it is taken in.
const PART_LIMIT: usize = 64;

/// Where the parts of a spec come from. Their names are paths seen from the folder of the spec, with `/`.
#[derive(Clone, Copy, Debug)]
pub enum Library<'a> {
    /// Files below a folder.
    Folder(&'a Path),
    /// Names and texts.
    Texts(&'a [(&'a str, &'a str)]),
}

impl Library<'_> {
    /// The text of a part, or why there is none.
    fn text(self, name: &str) -> Result<String, String> {
        match self {
            Self::Texts(texts) => {
                let text = texts.iter().find(|(other, _)| *other == name);
                text.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "it is not there".to_owned())
            }
            Self::Folder(folder) => files::read_text(&folder.join(name), SIZE_LIMIT).map_err(|error| error.why()),
        }
    }
}

/// Takes in all parts of a spec; `path` is how messages call the spec.
pub(super) struct Loader<'a> {
    library: Library<'a>,
    path: &'a Path,
    sources: &'a mut SourceMap,
    diagnostics: &'a mut Vec<Diagnostic>,
    /// The parts that are being taken in, and where each is asked for; the spec is the first.
    open: Vec<(String, Option<Span>)>,
    /// The texts read so far; `None` where there is none.
    texts: HashMap<String, Option<FileId>>,
    /// The parts that were taken in as they are: once is enough.
    plain: HashSet<String>,
    count: usize,
    whole: bool,
}

/// What came of the parts of a spec.
pub(super) struct Loaded {
    /// Their names, each once, in the order in which they were found.
    pub(super) names: Vec<String>,
    /// Whether all of them are there: else names and equations may be missing.
    pub(super) whole: bool,
}

impl<'a> Loader<'a> {
    pub(super) fn new(
        library: Library<'a>,
        path: &'a Path,
        sources: &'a mut SourceMap,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        let spec = path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
        let (texts, plain, open) = (HashMap::new(), HashSet::new(), vec![(spec, None)]);
        Self { library, path, sources, diagnostics, open, texts, plain, count: 0, whole: true }
    }

    /// Joins a spec with its parts; `start` is the beginning of its file.
    pub(super) fn load(mut self, spec: &mut Spec, start: Span) -> Loaded {
        let uses = !spec.uses.is_empty();
        self.take_in(spec);
        if uses && self.whole {
            self.check_sizes(spec, start);
        }
        self.loaded()
    }

    /// Joins a part that is looked at by itself with the parts that it uses.
    pub(super) fn load_part(mut self, part: &mut Spec) -> Loaded {
        self.take_in(part);
        self.loaded()
    }

    fn loaded(self) -> Loaded {
        let mut names: Vec<(FileId, String)> =
            self.texts.into_iter().filter_map(|(name, file)| Some((file?, name))).collect();
        names.sort();
        Loaded { names: names.into_iter().map(|(_, name)| name).collect(), whole: self.whole }
    }

    fn check_sizes(&mut self, spec: &Spec, start: Span) {
        for (key, count) in [("state", spec.states.len()), ("modes", spec.modes.len())] {
            if count == 0 {
                self.diagnostics.push(nothing_in(key, start));
            } else if count > STATE_LIMIT {
                let message = format!("with all parts [{key}] has {count} entries, and can have {STATE_LIMIT}");
                self.refuse(Diagnostic::error(Code::TooLarge, message).at(start, "").help("split the model"));
            }
        }
    }

    /// Joins a spec, or a part, with the parts that it uses.
    fn take_in(&mut self, owner: &mut Spec) {
        let uses = std::mem::take(&mut owner.uses);
        for (n, item) in uses.iter().enumerate() {
            let first = uses.iter().take(n).find(|first| is_plain(first) && first.part.value == item.part.value);
            if let Some(first) = first.filter(|_| is_plain(item)) {
                let message = format!("the part `{}` is used twice", shortened(&item.part.value));
                let error = Diagnostic::error(Code::GivenTwice, message).at(item.part.span, "");
                let help = "remove one; to have it twice, give its names other ones by `rename`";
                self.diagnostics.push(error.see(first.part.span, "first time").help(help));
                continue;
            }
            if let Some(part) = self.part(item) {
                join::join(owner, part, self.diagnostics);
            }
        }
    }

    /// A part with all that it uses, bound to what its user says of it; empty if it is there already as it is.
    fn part(&mut self, item: &Use) -> Option<Spec> {
        let file = self.find(&item.part)?;
        if is_plain(item) && !self.plain.insert(item.part.value.clone()) {
            return Some(Spec::default());
        }
        self.count += 1;
        if self.count > PART_LIMIT {
            if self.count == PART_LIMIT + 1 {
                let message = format!("a spec can have {PART_LIMIT} parts");
                self.refuse(Diagnostic::error(Code::TooLarge, message).at(item.part.span, "").help("split the model"));
            }
            return None;
        }
        let text = self.sources.text(file).to_owned();
        let before = self.diagnostics.len();
        let document = document::parse(file, &text, self.diagnostics);
        let complete = self.diagnostics.len() == before;
        self.whole &= complete;
        let mut part = read_part(&document, Span { file, start: 0, end: 0 }, complete, self.diagnostics);
        // Tables that were refused for their size are not to be walked.
        let refused = |diagnostic: &Diagnostic| matches!(diagnostic.code, Code::TooLarge | Code::PartTable);
        self.whole &= !self.diagnostics.iter().skip(before).any(refused);
        self.open.push((item.part.value.clone(), Some(item.part.span)));
        self.take_in(&mut part);
        self.open.pop();
        if self.whole {
            bind::bind(&mut part, item, self.diagnostics);
        }
        Some(part)
    }

    /// The file of a part.
    fn find(&mut self, part: &Text) -> Option<FileId> {
        let name = part.value.as_str();
        if let Err(why) = is_below(name) {
            let message = format!("`{}` cannot be the file of a part: {why}", shortened(name));
            let help = "write a path seen from the folder of the spec, below that folder, as in `parts/motor.toml`";
            self.refuse(Diagnostic::error(Code::PartFile, message).at(part.span, "").help(help));
            return None;
        }
        if let Some(at) = self.open.iter().position(|(open, _)| open == name) {
            self.cycle(part, at);
            return None;
        }
        if let Some(file) = self.texts.get(name) {
            self.whole &= file.is_some();
            return *file;
        }
        let path = self.path.parent().unwrap_or(Path::new("")).join(name);
        let text = self.library.text(name).and_then(|text| match long_line(&text) {
            Some((start, message)) => {
                let line = text.get(..start).unwrap_or("").matches('\n').count() + 1;
                Err(format!("line {line}: {message}"))
            }
            None => Ok(text),
        });
        let file = match text {
            Ok(text) => Some(self.sources.add(path, text)),
            Err(why) => {
                self.missing(part, &path, &why);
                None
            }
        };
        self.texts.insert(name.to_owned(), file);
        file
    }

    fn missing(&mut self, part: &Text, path: &Path, why: &str) {
        let message = format!("the part `{}` cannot be read: {why}", shortened(&part.value));
        let help = format!("it is looked for at `{}`: the path is seen from the folder of the spec", path.display());
        self.refuse(Diagnostic::error(Code::PartFile, message).at(part.span, "").help(help));
    }

    /// Reports a part that needs itself; `at` is where it is among the open ones.
    fn cycle(&mut self, part: &Text, at: usize) {
        let names = self.open.iter().skip(at).map(|(name, _)| name.as_str()).chain([part.value.as_str()]);
        let path: Vec<String> = names.map(|name| format!("`{}`", shortened(name))).collect();
        let message = match path.len() {
            2 => format!("`{}` uses itself", shortened(&part.value)),
            _ => format!("parts use each other: {}", path.join(" -> ")),
        };
        let mut error = Diagnostic::error(Code::PartCycle, message).at(part.span, "");
        for span in self.open.iter().skip(at + 1).filter_map(|(_, span)| *span) {
            error = error.see(span, "");
        }
        self.refuse(error.help("move what both need into a third part"));
    }

    /// Reports something without which the spec is not whole.
    fn refuse(&mut self, diagnostic: Diagnostic) {
        self.whole = false;
        self.diagnostics.push(diagnostic);
    }
}

/// Whether a part is taken in as it is.
fn is_plain(item: &Use) -> bool {
    item.rename.is_empty() && item.set.is_empty() && item.fix.is_empty()
}

/// Whether a path stays below the folder that it is seen from, whatever the platform; else why not.
fn is_below(path: &str) -> Result<(), &'static str> {
    if path.starts_with('/') || path.contains([':', '\\']) || path.chars().any(char::is_control) {
        return Err("it is not a relative path with `/`");
    }
    if path.split('/').any(|name| name == "..") {
        return Err("it leads out of its folder");
    }
    if path.split('/').any(|name| name.is_empty() || name == ".") || !path.ends_with(".toml") {
        return Err("it is not the path of a TOML file");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::is_below;

    #[test]
    fn paths_stay_below_the_folder_of_the_spec() {
        for good in ["parts/motor.toml", "motor.toml", "a/b/c.d.toml", "parts/très.toml", "a..b.toml"] {
            assert_eq!(is_below(good), Ok(()), "{good}");
        }
        let bad =
            ["", "/etc/x.toml", "../x.toml", "a/../../x.toml", "a/./x.toml", "a//x.toml", "./x.toml", "a\\x.toml"];
        for bad in bad.into_iter().chain(["C:/x.toml", "C:x.toml", "x", "parts/", "~/x.toml/..", "a\0.toml"]) {
            assert!(is_below(bad).is_err(), "{bad}");
        }
    }
}
