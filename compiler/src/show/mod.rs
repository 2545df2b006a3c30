//! A model on paper: equations typeset from the spec as it was written, tables of its names, the graph of its modes.
//!
//! Pure functions over a spec that was read without errors; nothing is built and nothing runs. `collect` gathers the
//! content (`sheet`), formulas set by `plain` and `latex`; each page arranges it.

mod collect;
mod drawn;
mod escape;
#[cfg(test)]
mod formula_tests;
mod graph;
mod latex;
mod level;
mod lines;
mod literal;
mod page_latex;
mod page_markdown;
mod page_text;
mod plain;
mod sheet;
mod symbol;
mod used;
mod wrap;

pub use sheet::Sheet;

impl Sheet {
    /// The page for a terminal, 100 columns wide.
    pub fn text(&self) -> String {
        page_text::page(self)
    }

    /// A LaTeX document that compiles by itself.
    pub fn latex(&self) -> String {
        page_latex::page(self)
    }

    /// The page in Markdown, with formulas between `$` and `$$`.
    pub fn markdown(&self) -> String {
        page_markdown::page(self)
    }

    /// The measures: their names, and their expressions as the spec has them.
    pub fn measures(&self) -> impl Iterator<Item = (&str, &str)> {
        self.measures.iter().map(|measure| (measure.name.name.as_str(), measure.formula.source.as_str()))
    }

    /// Modes and transitions, one arrow a line.
    pub fn graph_text(&self) -> String {
        graph::text(self)
    }

    /// Modes and transitions in the DOT language.
    pub fn graph_dot(&self) -> String {
        graph::graphviz(self)
    }
}
