//! Diagnostics: what is wrong in a spec, where, and what to write instead.

mod code;

use crate::source::{SourceMap, Span};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
pub use code::Code;
use std::path::PathBuf;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The spec cannot be compiled.
    Error,
    /// The spec means something, but perhaps not what was intended.
    Warning,
}

/// A marked place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What to say about it; may be empty.
    pub text: String,
    /// Whether this is the place of the problem (else: of what it has to do with).
    pub primary: bool,
}

/// One problem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What kind of problem.
    pub code: Code,
    /// How bad.
    pub severity: Severity,
    /// One lower-case sentence, names in backticks.
    pub message: String,
    /// Places, the primary one first.
    pub labels: Vec<Label>,
    /// What to write instead.
    pub help: Option<String>,
}

impl Diagnostic {
    /// An error without places yet.
    pub fn error(code: Code, message: impl Into<String>) -> Self {
        Self { code, severity: Severity::Error, message: message.into(), labels: Vec::new(), help: None }
    }

    /// A warning without places yet.
    pub fn warning(code: Code, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message) }
    }

    /// Adds the place of the problem.
    #[must_use]
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: true });
        self
    }

    /// Adds a place that the problem has to do with.
    #[must_use]
    pub fn see(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into(), primary: false });
        self
    }

    /// Says what to write instead.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// The place of the problem.
    pub fn primary(&self) -> Option<Span> {
        self.labels.iter().find(|label| label.primary).or(self.labels.first()).map(|label| label.span)
    }

    /// Whether it stops the compilation.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// Path, line and column (both from 1, the column in characters) of the problem; `None` when it has no place.
pub fn locate(diagnostic: &Diagnostic, sources: &SourceMap) -> Option<(PathBuf, usize, usize)> {
    let span = diagnostic.primary()?;
    let (line, column) = sources.line_column(span);
    Some((sources.path(span.file).to_path_buf(), line, column))
}

/// All diagnostics for people, snippets underlined, one blank line between two; with ANSI colours if `color`.
pub fn render(diagnostics: &[Diagnostic], sources: &SourceMap, color: bool) -> String {
    let renderer = if color { Renderer::styled() } else { Renderer::plain() };
    let reports: Vec<String> =
        diagnostics.iter().map(|diagnostic| renderer.render(&[report(diagnostic, sources)]).to_string()).collect();
    let mut text = reports.join("\n\n");
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

fn report<'a>(diagnostic: &'a Diagnostic, sources: &'a SourceMap) -> Group<'a> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(diagnostic.message.as_str()).id(diagnostic.code.as_str());
    let mut files = Vec::new();
    for label in &diagnostic.labels {
        if !files.contains(&label.span.file) {
            files.push(label.span.file);
        }
    }
    let snippets = files.into_iter().map(|file| {
        let path = sources.path(file).to_string_lossy().into_owned();
        let labels = diagnostic.labels.iter().filter(move |label| label.span.file == file);
        Snippet::source(sources.text(file)).path(path).annotations(labels.map(|label| annotation(label, sources)))
    });
    let group = title.elements(snippets);
    match &diagnostic.help {
        Some(help) => group.element(Level::HELP.message(help.as_str())),
        None => group,
    }
}

fn annotation<'a>(label: &'a Label, sources: &SourceMap) -> Annotation<'a> {
    let span = sources.clamp(label.span);
    let kind = if label.primary { AnnotationKind::Primary } else { AnnotationKind::Context };
    let annotation = kind.span(span.start..span.end);
    if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rendered_diagnostic_names_code_place_and_help() {
        let mut sources = SourceMap::default();
        let file = sources.add("a.toml", "one\ntwo = \"x + y\"\n");
        let span = Span { file, start: 11, end: 12 };
        let diagnostic = Diagnostic::error(Code::UndefinedName, "undefined name `x`")
            .at(span, "not defined")
            .help("did you mean `y`?");
        let text = render(std::slice::from_ref(&diagnostic), &sources, false);
        assert!(text.contains("error[E0201]: undefined name `x`"), "{text}");
        assert!(text.contains("a.toml:2:8"), "{text}");
        assert!(text.contains("help: did you mean `y`?"), "{text}");
        assert_eq!(locate(&diagnostic, &sources), Some(("a.toml".into(), 2, 8)));
        assert!(render(&[diagnostic], &sources, true).contains('\u{1b}'));
    }

    #[test]
    fn codes_are_unique_and_in_order() {
        let mut texts: Vec<_> = Code::ALL.iter().map(|code| code.as_str()).collect();
        let given = texts.clone();
        texts.sort_unstable();
        texts.dedup();
        assert_eq!(texts, given);
    }
}
