//! Strings of a spec that remember where each of their characters stands in the file.

use crate::source::{FileId, Span};
use std::ops::Range;

/// A decoded string and its place.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    /// The characters.
    pub(crate) value: String,
    /// The whole value in the file, quotes included.
    pub(crate) span: Span,
    offsets: Offsets,
}

/// How byte offsets of the decoded string map to offsets of the file.
#[derive(Clone, Debug)]
enum Offsets {
    /// By adding a constant.
    Shift(usize),
    /// One file offset for each byte and one for the end (strings with escapes).
    Table(Vec<usize>),
    /// Unknown: every part stands for the whole value.
    Whole,
}

impl Text {
    /// A text that is a file of its own, e.g. a command-line flag.
    pub(crate) fn whole_file(file: FileId, value: &str) -> Self {
        Self { value: value.to_owned(), span: Span { file, start: 0, end: value.len() }, offsets: Offsets::Shift(0) }
    }

    /// A TOML string: its decoded `value` and the `raw` characters at `span`, quotes included.
    pub(crate) fn from_toml(value: &str, raw: &str, span: Span) -> Self {
        let offsets = string_offsets(value, raw, span.start).unwrap_or(Offsets::Whole);
        Self { value: value.to_owned(), span, offsets }
    }

    /// A bare TOML value such as a number, taken as it is written.
    pub(crate) fn bare(raw: &str, span: Span) -> Self {
        let value = raw.replace('_', "");
        let offsets = if value == raw { Offsets::Shift(span.start) } else { Offsets::Whole };
        Self { value, span, offsets }
    }

    /// A part of a text that [`Text::whole_file`] made.
    pub(crate) fn part(&self, range: Range<usize>) -> Self {
        let value = self.value.get(range.clone()).unwrap_or("").to_owned();
        let span = self.at(range);
        Self { value, span, offsets: Offsets::Shift(span.start) }
    }

    /// Where the bytes `range` of the decoded string stand in the file.
    pub(crate) fn at(&self, range: Range<usize>) -> Span {
        let (start, end) = match &self.offsets {
            Offsets::Shift(shift) => (range.start + shift, range.end + shift),
            Offsets::Table(table) => match (table.get(range.start), table.get(range.end)) {
                (Some(&start), Some(&end)) => (start, end),
                _ => return self.span,
            },
            Offsets::Whole => return self.span,
        };
        Span { file: self.span.file, start, end: end.max(start) }
    }
}

/// The map of a TOML string literal; `None` if it does not decode to `value` by the rules known here.
fn string_offsets(value: &str, raw: &str, start: usize) -> Option<Offsets> {
    let quote = raw.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let triple: String = std::iter::repeat_n(quote, 3).collect();
    let multiline = raw.len() >= 6 && raw.starts_with(&triple);
    let width = if multiline { 3 } else { 1 };
    let inner = raw.get(width..raw.len().checked_sub(width)?)?;
    let first_newline = match (multiline, inner.as_bytes()) {
        (true, [b'\r', b'\n', ..]) => 2,
        (true, [b'\n', ..]) => 1,
        _ => 0,
    };
    let (inner, start) = (inner.get(first_newline..)?, start + width + first_newline);
    if inner == value {
        return Some(Offsets::Shift(start));
    }
    if quote == '\'' {
        return None;
    }
    let (decoded, table) = decode(inner, start)?;
    (decoded == value).then_some(Offsets::Table(table))
}

/// Decodes the inside of a basic string and records the file offset of each decoded byte and of the end.
fn decode(inner: &str, start: usize) -> Option<(String, Vec<usize>)> {
    let mut decoded = String::new();
    let mut table = Vec::new();
    let mut rest = inner;
    while let Some(c) = rest.chars().next() {
        let at = start + inner.len() - rest.len();
        let (out, used) = if c == '\\' { escape(rest)? } else { (Some(c), c.len_utf8()) };
        if let Some(out) = out {
            decoded.push(out);
            table.resize(decoded.len(), at);
        }
        rest = rest.get(used..)?;
    }
    table.push(start + inner.len());
    Some((decoded, table))
}

/// The character that an escape at the start of `rest` stands for (none for a line-ending backslash) and its length.
fn escape(rest: &str) -> Option<(Option<char>, usize)> {
    let hex = |digits: usize| {
        let code = u32::from_str_radix(rest.get(2..2 + digits)?, 16).ok()?;
        Some((Some(char::from_u32(code)?), 2 + digits))
    };
    match rest.as_bytes().get(1)? {
        b'b' => Some((Some('\u{8}'), 2)),
        b't' => Some((Some('\t'), 2)),
        b'n' => Some((Some('\n'), 2)),
        b'f' => Some((Some('\u{c}'), 2)),
        b'r' => Some((Some('\r'), 2)),
        b'e' => Some((Some('\u{1b}'), 2)),
        b'"' => Some((Some('"'), 2)),
        b'\\' => Some((Some('\\'), 2)),
        b'x' => hex(2),
        b'u' => hex(4),
        b'U' => hex(8),
        b' ' | b'\t' | b'\n' | b'\r' => {
            let tail = rest.get(1..)?;
            Some((None, 1 + tail.len() - tail.trim_start_matches([' ', '\t', '\n', '\r']).len()))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a failed unwrap fails the test
    use super::*;
    use crate::source::SourceMap;

    /// The file's characters that `part` of the decoded string maps to.
    fn mapped(raw: &str, value: &str, part: &str) -> String {
        let mut sources = SourceMap::default();
        let text = format!("key = {raw}");
        let file = sources.add("a.toml", text.clone());
        let string = Text::from_toml(value, raw, Span { file, start: 6, end: text.len() });
        let start = value.find(part).unwrap();
        sources.slice(string.at(start..start + part.len())).to_owned()
    }

    #[test]
    fn all_four_kinds_of_strings_map_exactly() {
        assert_eq!(mapped("\"a + bc\"", "a + bc", "bc"), "bc");
        assert_eq!(mapped("'a + bc'", "a + bc", "bc"), "bc");
        assert_eq!(mapped("\"\"\"\na +\n bc\"\"\"", "a +\n bc", "bc"), "bc");
        assert_eq!(mapped("'''a +\nbc'''", "a +\nbc", "bc"), "bc");
    }

    #[test]
    fn escapes_map_exactly() {
        assert_eq!(mapped(r#""a\t+ b\u0063 + d""#, "a\t+ bc + d", "d"), "d");
        assert_eq!(mapped(r#""a\t+ b\u0063 + d""#, "a\t+ bc + d", "bc"), r"b\u0063");
        assert_eq!(mapped("\"\"\"a + \\\n   bc\"\"\"", "a + bc", "bc"), "bc");
    }

    #[test]
    fn what_is_not_understood_falls_back_to_the_whole_value() {
        assert_eq!(mapped(r#""a\qb""#, "ab", "b"), r#""a\qb""#);
    }
}
