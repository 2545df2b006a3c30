//! Strict readers of what `show` prints: LaTeX, Markdown with formulas, DOT.

#![allow(clippy::panic)] // a test may fail loudly

/// A LaTeX document: braces, environments and formulas are closed, no special character stands where it has no meaning.
pub(crate) fn check_latex(page: &str) {
    let (preamble, body) = page.split_once("\\begin{document}\n").expect("a document begins");
    assert!(preamble.starts_with("\\documentclass"));
    let body = body.strip_suffix("\\end{document}\n").expect("the document ends");
    Reader::read(body, false);
}

/// A formula.
pub(crate) fn check_math(latex: &str) {
    assert!(!latex.contains('$') && !latex.contains('#') && !latex.contains("\\["), "{latex}");
    Reader::read(latex, true);
}

/// Markdown: formulas are closed and read as LaTeX, tables have as many cells in each row, nothing is HTML.
pub(crate) fn check_markdown(page: &str) {
    let mut columns = None;
    let mut display: Option<String> = None;
    for line in page.lines() {
        if line == "$$" {
            match display.take() {
                Some(formula) => check_math(&formula),
                None => display = Some(String::new()),
            }
            continue;
        }
        if let Some(formula) = &mut display {
            *formula += line;
            formula.push('\n');
            continue;
        }
        let cells = line.starts_with('|').then(|| unescaped(line, '|'));
        assert!(columns.is_none() || cells.is_none() || cells == columns, "cells: {line}");
        columns = cells;
        inline(line);
    }
    assert!(display.is_none(), "a formula is open at the end");
}

/// How often a character stands in a line without a backslash before it.
fn unescaped(line: &str, wanted: char) -> usize {
    let (mut count, mut escaped) = (0, false);
    for c in line.chars() {
        count += usize::from(c == wanted && !escaped);
        escaped = c == '\\' && !escaped;
    }
    count
}

/// A line outside of displayed formulas: code, formulas and escaped text.
fn inline(line: &str) {
    let text = line.trim_start_matches('#');
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '\\' => rest = rest.get(1..).unwrap_or_else(|| panic!("a backslash ends the line: {line}")),
            '`' => rest = rest.split_once('`').unwrap_or_else(|| panic!("code is open: {line}")).1,
            '$' => {
                let (formula, behind) = rest.split_once('$').unwrap_or_else(|| panic!("a formula is open: {line}"));
                check_math(formula);
                rest = behind;
            }
            '<' | '>' | '*' | '_' | '[' | ']' | '&' | '~' | '#' => panic!("`{c}` is markup: {line}"),
            _ => {}
        }
    }
}

/// A DOT file as `show` writes it: quoted names and attributes, one statement a line.
pub(crate) fn check_dot(graph: &str) {
    let graph = graph.strip_suffix("}\n").expect("the graph is closed");
    let (head, body) = graph.split_once('\n').expect("lines");
    assert_eq!(words(head), ["digraph", "S", "{"]);
    for line in body.lines() {
        let words = words(line);
        let shape: Vec<&str> = words.iter().map(String::as_str).collect();
        match shape.as_slice() {
            ["label=", "S", ";"] | ["node", "[shape=box,", "style=rounded];"] | ["S", ";"] => {}
            ["S", "->", "S", "[label=", "S", "];"]
            | ["S", "->", "S", "[label=", "S", ",", "style=bold];" | "style=dashed];"] => {}
            ["S", "->", "S", "[label=", "S", ",", "style=", "S", "];"] => {}
            _ => panic!("no statement: {line}"),
        }
    }
}

/// The words of a line, each quoted string as `S`.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut rest = line;
    while let Some(c) = rest.chars().next() {
        rest = &rest[c.len_utf8()..];
        match c {
            '"' => {
                let (mut escaped, mut end) = (false, None);
                for (i, c) in rest.char_indices() {
                    if c == '"' && !escaped {
                        end = Some(i);
                        break;
                    }
                    escaped = c == '\\' && !escaped;
                }
                let end = end.unwrap_or_else(|| panic!("a string is open: {line}"));
                words.extend(["S".to_owned(), String::new()]);
                rest = &rest[end + 1..];
            }
            ' ' => words.push(String::new()),
            c => words.last_mut().expect("there is one").push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Reads LaTeX.
struct Reader<'a> {
    all: &'a str,
    rest: &'a str,
    /// What is open, innermost last: `{`, `$`, `[`, `left`, or the name of an environment.
    open: Vec<&'a str>,
    math: bool,
}

impl<'a> Reader<'a> {
    fn read(all: &'a str, math: bool) {
        let mut reader = Reader { all, rest: all, open: Vec::new(), math };
        while let Some(c) = reader.rest.chars().next() {
            reader.rest = &reader.rest[c.len_utf8()..];
            reader.character(c);
        }
        assert!(reader.open.is_empty(), "open at the end: {:?}\n{all}", reader.open);
    }

    fn refuse(&self, what: &str) -> ! {
        let at = self.all.len() - self.rest.len();
        panic!("{what} at ...{}\n\n{}", &self.all[self.all[..at].rfind('\n').unwrap_or(0)..at], self.all)
    }

    fn close(&mut self, what: &str) {
        if self.open.pop() != Some(what) {
            self.refuse(&format!("`{what}` is closed, but not open"));
        }
    }

    fn is_open(&self, what: &str) -> bool {
        self.open.contains(&what)
    }

    fn character(&mut self, c: char) {
        match c {
            '\\' => self.command(),
            '{' => self.open.push("{"),
            '}' => self.close("{"),
            '$' if self.is_open("$") => {
                self.close("$");
                self.math = false;
            }
            '$' if !self.math => {
                self.open.push("$");
                self.math = true;
            }
            '_' | '^'
                if self.math && self.rest.starts_with(|c: char| "{\\".contains(c) || c.is_ascii_alphanumeric()) => {}
            '_' | '^' if self.math => self.refuse("nothing to raise or lower"),
            '&' if self.open.iter().any(|open| matches!(*open, "aligned" | "cases" | "longtable")) => {}
            '$' | '_' | '^' | '&' | '#' | '%' | '~' | '|' | '<' | '>' | '"' if !self.math => {
                self.refuse("a character with a meaning")
            }
            '&' | '#' | '%' | '~' | '"' | '|' | '$' => self.refuse("a character with a meaning"),
            c if c.is_control() && c != '\n' => self.refuse("a control character"),
            c if self.math && !c.is_ascii() => self.refuse("not ASCII in a formula"),
            _ => {}
        }
    }

    fn command(&mut self) {
        let letters = self.rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(self.rest.len());
        let name = &self.rest[..letters.max(1)];
        self.rest = &self.rest[name.len()..];
        match name {
            "begin" | "end" => {
                let (environment, rest) =
                    self.rest.strip_prefix('{').and_then(|rest| rest.split_once('}')).expect("an environment");
                self.rest = rest;
                if name == "end" {
                    return self.close(environment);
                }
                assert!(["aligned", "cases", "longtable"].contains(&environment), "{environment}");
                assert_eq!(self.math, environment != "longtable", "{environment}");
                self.open.push(environment);
            }
            "[" => {
                assert!(!self.math, "a formula in a formula");
                self.open.push("[");
                self.math = true;
            }
            "]" => {
                self.close("[");
                self.math = false;
            }
            "left" | "right" => {
                assert!(self.math);
                let delimiter = ["(", ")", "\\lvert", "\\rvert"].iter().find(|d| self.rest.starts_with(**d));
                let Some(delimiter) = delimiter else { self.refuse("no delimiter") };
                self.rest = &self.rest[delimiter.len()..];
                if name == "left" { self.open.push("left") } else { self.close("left") }
            }
            "\\" | "{" | "}" | "$" | "&" | "#" | "%" | "_" | "," => {}
            _ if MATH.contains(&name) => assert!(self.math, "\\{name} outside of a formula\n{}", self.all),
            _ if TEXT.contains(&name) => assert!(!self.math, "\\{name} in a formula\n{}", self.all),
            _ if GREEK.contains(&name.to_ascii_lowercase().as_str()) => assert!(self.math, "\\{name}"),
            _ => self.refuse(&format!("no command that `show` writes: \\{name}")),
        }
    }
}

#[rustfmt::skip]
const MATH: &[&str] = &[
    "frac", "sqrt", "dot", "partial", "mathrm", "operatorname", "text", "int", "cdot", "le", "ge", "lnot", "land", "lor",
    "sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "ln", "min", "max", "arcsin", "arccos", "arctan", "circ", "qquad",
    "quad",
];

#[rustfmt::skip]
const TEXT: &[&str] = &[
    "section", "subsection", "texttt", "textbackslash", "textasciicircum", "textasciitilde", "textasciigrave", "textbar",
    "textless", "textgreater", "textquotedbl", "gaitcchar", "hline", "endhead",
];

#[rustfmt::skip]
const GREEK: &[&str] = &[
    "alpha", "beta", "gamma", "delta", "varepsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "upsilon", "varphi", "phi", "chi", "psi", "omega",
];
