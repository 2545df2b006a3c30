//! Command-line flags in the language of specs: quantities, ranges, constraints and objectives.
//!
//! Every error is a [`FlagError`]: the diagnostics and the flag's text, which render like those of a spec, the wrong
//! characters underlined.

use super::lower::{Definitions, Lowering, Scope};
use super::names::is_identifier;
use super::parser::parse_expression;
use super::quantity::Quantities;
use super::spec::Equation;
pub use super::suggest;
use super::syntax::Expression;
use super::text::Text;
use crate::diagnostic::{Code, Diagnostic, render};
use crate::dimension::Dimension;
use crate::ir::{Constraint, Model, NodeId};
use crate::source::{FileId, SourceMap, Span};
use std::fmt;
use std::ops::Range;

/// A flag that cannot be understood.
#[derive(Clone, Debug)]
pub struct FlagError {
    /// What is wrong, at least one.
    pub diagnostics: Vec<Diagnostic>,
    /// The flag's text.
    pub sources: SourceMap,
    /// Which of the texts it is: an observation refers to others.
    own: FileId,
}

impl FlagError {
    /// The same with the flag that has the text, such as `--set`, and its whole argument, which the text may be the end of.
    #[must_use]
    pub fn given_as(mut self, flag: &str, argument: &str) -> Self {
        // What was read is a part of the argument: mostly its end, behind `NAME=`.
        let Some(shift) = argument.rfind(self.sources.text(self.own)) else { return self };
        let own = self.own;
        let labels = self.diagnostics.iter_mut().flat_map(|diagnostic| &mut diagnostic.labels);
        for label in labels.filter(|label| label.span.file == own) {
            label.span.start += shift;
            label.span.end += shift;
        }
        self.sources.replace(own, flag, argument);
        self
    }

    /// For people, the wrong characters underlined; with ANSI colours if `color`.
    pub fn render(&self, color: bool) -> String {
        render(&self.diagnostics, &self.sources, color)
    }
}

impl fmt::Display for FlagError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.render(false).trim_end())
    }
}

impl std::error::Error for FlagError {}

/// A flag's text being read.
pub(super) struct Flag {
    pub(super) sources: SourceMap,
    pub(super) text: Text,
    pub(super) diagnostics: Vec<Diagnostic>,
}

impl Flag {
    fn new(text: &str) -> Self {
        Self::among(SourceMap::default(), text)
    }

    /// A text that refers to others.
    pub(super) fn among(mut sources: SourceMap, text: &str) -> Self {
        let file: FileId = sources.add("command line", text);
        Self { sources, text: Text::whole_file(file, text), diagnostics: Vec::new() }
    }

    fn quantities(&mut self) -> Quantities<'_> {
        Quantities { sources: &self.sources, diagnostics: &mut self.diagnostics }
    }

    pub(super) fn finish<T>(self, result: Option<T>) -> Result<T, FlagError> {
        let own = self.text.span.file;
        let error = FlagError { diagnostics: self.diagnostics, sources: self.sources, own };
        match result {
            Some(result) if !error.diagnostics.iter().any(Diagnostic::is_error) => Ok(result),
            _ => Err(error),
        }
    }

    fn error<T>(self, code: Code, message: &str, span: Span, help: &str) -> Result<T, FlagError> {
        self.refuse(Diagnostic::error(code, message).at(span, "").help(help))
    }

    pub(super) fn refuse<T>(mut self, diagnostic: Diagnostic) -> Result<T, FlagError> {
        self.diagnostics.push(diagnostic);
        self.finish(None)
    }

    /// Lowers the text as an expression over a model's measures and parameters.
    fn lower<T>(
        mut self,
        expression: Result<Expression, Box<Diagnostic>>,
        model: &mut Model,
        lower: impl FnOnce(&mut Lowering<'_>, &Equation) -> Option<T>,
    ) -> Result<T, FlagError> {
        let expression = match expression {
            Ok(expression) => expression,
            Err(diagnostic) => return self.refuse(*diagnostic),
        };
        let equation = Equation { text: self.text.clone(), expression: Some(expression) };
        let (scope, definitions) = (Scope::of_model(model), Definitions::default());
        let mut lowering = Lowering::new(model, &scope, &definitions, &self.sources, &mut self.diagnostics);
        let result = lower(&mut lowering, &equation);
        self.finish(result)
    }
}

/// Reads a quantity such as `25 deg`; its value in SI units.
///
/// # Errors
/// When it is no quantity or has another dimension than `expected`.
pub fn parse_quantity(text: &str, expected: Dimension) -> Result<f64, FlagError> {
    let mut flag = Flag::new(text);
    let whole = flag.text.clone();
    let value = flag.quantities().of(&whole, expected, "this quantity");
    flag.finish(value)
}

/// Reads a range such as `0..200 N/m`; a unit at the end is that of both bounds. The bounds in SI units.
///
/// # Errors
/// When it is no range, a bound has another dimension than `expected`, or the lower bound is above the upper one.
pub fn parse_range(text: &str, expected: Dimension) -> Result<(f64, f64), FlagError> {
    let mut flag = Flag::new(text);
    let Some(dots) = text.find("..") else {
        let span = flag.text.span;
        return flag.error(Code::Syntax, "this is not a range", span, "write `LO..HI`, as in `0..200 N/m`");
    };
    if let Some(rest) = text.get(dots + 2..).filter(|rest| rest.starts_with('.')) {
        let written = format!("{}..{}", text.get(..dots).unwrap_or(""), rest.trim_start_matches('.'));
        let span = flag.text.span;
        return flag.error(
            Code::Syntax,
            "a range has two dots",
            span,
            &format!("write `{written}`; a number that begins with its point needs a 0 there"),
        );
    }
    let (lower, upper) = (flag.text.part(0..dots), flag.text.part(dots + 2..text.len()));
    let span = flag.text.span;
    let mut quantities = flag.quantities();
    let range = quantities.sharing_unit(&lower, &upper).and_then(|(low, high)| {
        let first = quantities.check(&low, lower.span, expected, "the lower bound");
        let second = quantities.check(&high, upper.span, expected, "the upper bound");
        first.and(second)?;
        quantities.ordered(low.value, high.value, span, "the range")
    });
    flag.finish(range)
}

/// What a flag says of the values that a quantity takes, SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// A range, and how many values it is cut into where that is said: `0..200 N/m:11`.
    Range {
        /// Lower bound.
        lower: f64,
        /// Upper bound, not below the lower one.
        upper: f64,
        /// How many values.
        count: Option<u64>,
    },
    /// Single values, at least one: `1, 2, 5 deg`.
    List(Vec<f64>),
}

/// Reads the values that a quantity takes: a range such as `0..200 N/m:11` (11 values; the count may be missing), or a list such
/// as `1, 2, 5 deg`, where the last unit is that of all values that have none.
///
/// # Errors
/// When it is neither, has another dimension than `expected`, or the count is no number of values.
pub fn parse_values(text: &str, expected: Dimension) -> Result<Values, FlagError> {
    let mut flag = Flag::new(text);
    if text.contains("..") {
        let (range, count) = text.rsplit_once(':').map_or((text, None), |(range, count)| (range, Some(count)));
        let count = match count.map(|count| (count, count.trim().parse::<u64>())) {
            None => None,
            Some((_, Ok(count))) if count > 0 => Some(count),
            Some((count, _)) => {
                let span = flag.text.at(text.len() - count.len()..text.len());
                let help = "write how many values, as in `0..200 N/m:11`";
                return flag.error(Code::Syntax, "this is no number of values", span, help);
            }
        };
        let (lower, upper) = parse_range(range, expected)?;
        return Ok(Values::Range { lower, upper, count });
    }
    let mut parts: Vec<Text> = Vec::new();
    let mut first = 0;
    for end in text.match_indices(',').map(|(at, _)| at).chain([text.len()]) {
        // A comma in brackets is one of a function: min(1, 2).
        let piece = text.get(first..end).unwrap_or_default();
        if piece.matches('(').count() <= piece.matches(')').count() {
            parts.push(flag.text.part(trimmed(text, first..end)));
            first = end + 1;
        }
    }
    if first <= text.len() {
        parts.push(flag.text.part(trimmed(text, first..text.len())));
    }
    let Some((last, others)) = parts.split_last() else { return flag.finish(None) };
    let mut quantities = flag.quantities();
    let values = (|| {
        let end = quantities.any(last)?;
        quantities.check(&end, last.span, expected, "the last value")?;
        let mut values = Vec::with_capacity(parts.len());
        for value in others {
            let (quantity, _) = quantities.sharing_unit(value, last)?;
            quantities.check(&quantity, value.span, expected, "this value")?;
            values.push(quantity.value);
        }
        values.push(end.value);
        Some(Values::List(values))
    })();
    flag.finish(values)
}

/// A range of bytes of a text without the blanks at its ends.
fn trimmed(text: &str, range: Range<usize>) -> Range<usize> {
    let part = text.get(range.clone()).unwrap_or("");
    let start = range.start + part.len() - part.trim_start().len();
    start..start + part.trim().len()
}

/// Splits `NAME=REST`.
///
/// # Errors
/// When there is no `=` or what stands before it is no name.
pub fn parse_assignment(text: &str) -> Result<(&str, &str), FlagError> {
    let flag = Flag::new(text);
    let span = flag.text.span;
    let Some((name, rest)) = text.split_once('=') else {
        return flag.error(Code::Syntax, "a `=` is missing", span, "write `NAME=VALUE`, as in `psi=\"25 deg\"`");
    };
    if !is_identifier(name.trim()) {
        let span = flag.text.at(0..name.len());
        return flag.error(Code::InvalidName, "what stands before `=` is no name", span, "write `NAME=VALUE`");
    }
    Ok((name.trim(), rest.trim()))
}

/// Reads a constraint such as `spectral_radius <= 0.95` over the measures and parameters of a model; its nodes are
/// added to the model's graph.
///
/// # Errors
/// When it is no constraint, or uses something else.
pub fn parse_constraint(model: &mut Model, text: &str) -> Result<Constraint, FlagError> {
    let flag = Flag::new(text);
    let expression = super::parser::parse_constraint(&flag.text);
    flag.lower(expression, model, |lowering, equation| lowering.constraint(equation))
}

/// Reads an objective such as `climb_speed` over the measures and parameters of a model; its node, which is added to
/// the model's graph, and its dimension.
///
/// # Errors
/// When it is no expression, or uses something else.
pub fn parse_objective(model: &mut Model, text: &str) -> Result<(NodeId, Dimension), FlagError> {
    let flag = Flag::new(text);
    let expression = parse_expression(&flag.text);
    flag.lower(expression, model, |lowering, equation| lowering.objective(equation))
}
