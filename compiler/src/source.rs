//! Source texts and places in them: what every diagnostic points into.

use std::path::{Path, PathBuf};

/// A text of a [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FileId(u32);

/// A range of bytes of one text; `start <= end`, both on character boundaries of that text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// The text.
    pub file: FileId,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// The smallest span that holds both; the first one where they are of different texts.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        if self.file != other.file {
            return self;
        }
        Self { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}

/// All texts that a compilation has read.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<(PathBuf, String)>,
}

impl SourceMap {
    /// Takes in a text; `path` is how messages call it.
    pub fn add(&mut self, path: impl Into<PathBuf>, text: impl Into<String>) -> FileId {
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        self.files.push((path.into(), text.into()));
        id
    }

    /// Puts another text, with another name, in the place of one: places in the old one have to be moved.
    pub(crate) fn replace(&mut self, file: FileId, path: impl Into<PathBuf>, text: impl Into<String>) {
        if let Some(entry) = self.files.get_mut(file.0 as usize) {
            *entry = (path.into(), text.into());
        }
    }

    /// How messages call the text; empty for an id of another map.
    pub fn path(&self, file: FileId) -> &Path {
        self.files.get(file.0 as usize).map_or(Path::new(""), |(path, _)| path)
    }

    /// All texts in the order in which they were read.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(_, text)| text.as_str())
    }

    /// The text; empty for an id of another map.
    pub fn text(&self, file: FileId) -> &str {
        self.files.get(file.0 as usize).map_or("", |(_, text)| text)
    }

    /// The characters of a span; empty where the span does not lie on character boundaries of its text.
    pub fn slice(&self, span: Span) -> &str {
        self.text(span.file).get(span.start..span.end).unwrap_or("")
    }

    /// The span moved into its text and onto character boundaries.
    pub fn clamp(&self, span: Span) -> Span {
        let text = self.text(span.file);
        let start = boundary(text, span.start);
        Span { file: span.file, start, end: boundary(text, span.end).max(start) }
    }

    /// Line and column of the span's start, both from 1, the column in characters.
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let text = self.text(span.file);
        let before = text.get(..boundary(text, span.start)).unwrap_or("");
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let column = before.get(line_start..).map_or(0, |line| line.chars().count());
        (before.bytes().filter(|&b| b == b'\n').count() + 1, column + 1)
    }
}

/// The nearest character boundary at or before `offset`.
fn boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_from_one_in_characters() {
        let mut sources = SourceMap::default();
        let file = sources.add("a.toml", "x = 1\nµ = \"é\"\n");
        let at = |start| Span { file, start, end: start };
        assert_eq!(sources.line_column(at(0)), (1, 1));
        assert_eq!(sources.line_column(at(6)), (2, 1));
        assert_eq!(sources.line_column(at(8)), (2, 2)); // after the two bytes of µ
        assert_eq!(sources.line_column(at(1000)), (3, 1));
    }

    #[test]
    fn clamp_moves_into_the_text_and_onto_boundaries() {
        let mut sources = SourceMap::default();
        let file = sources.add("a.toml", "µm");
        let span = sources.clamp(Span { file, start: 1, end: 99 });
        assert_eq!((span.start, span.end), (0, 3));
        assert_eq!(sources.slice(span), "µm");
    }
}
