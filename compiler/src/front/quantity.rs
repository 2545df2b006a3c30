//! Quantities: a constant expression and then a unit to the end, e.g. `2*pi*3 rad/s`.

use super::constant::evaluate;
use super::lower::{Context, Definitions, Lowering, Place, Scope, dimension_text, empty_model};
use super::parser::{parse_value, shortened, unit_diagnostic};
use super::spec::Interval;
use super::syntax::Expression;
use super::text::Text;
use super::units::{Unit, parse_unit};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::source::{SourceMap, Span};

/// A quantity.
#[derive(Clone, Debug)]
pub(crate) struct Quantity {
    /// In SI units.
    pub(crate) value: f64,
    /// `None` is a bare 0, which fits any dimension.
    pub(crate) dimension: Option<Dimension>,
    /// The unit as it was written.
    pub(crate) unit: String,
}

/// A quantity split into its number and its unit.
struct Parts {
    number: Quantity,
    /// The unit at the end, and whether there is one.
    unit: Unit,
    given: bool,
}

/// Reads quantities and reports what is wrong with them.
pub(crate) struct Quantities<'a> {
    pub(crate) sources: &'a SourceMap,
    pub(crate) diagnostics: &'a mut Vec<Diagnostic>,
}

impl Quantities<'_> {
    /// Reads a quantity of any dimension.
    pub(crate) fn any(&mut self, text: &Text) -> Option<Quantity> {
        let parts = self.parts(text)?;
        self.joined(parts, text)
    }

    /// Reads a quantity of a given dimension, `what` it is in words; the SI value.
    pub(crate) fn of(&mut self, text: &Text, expected: Dimension, what: &str) -> Option<f64> {
        let quantity = self.any(text)?;
        self.check(&quantity, text.span, expected, what)?;
        Some(quantity.value)
    }

    /// Checks the dimension of a quantity.
    pub(crate) fn check(&mut self, quantity: &Quantity, span: Span, expected: Dimension, what: &str) -> Option<()> {
        let Some(got) = quantity.dimension.filter(|got| *got != expected) else {
            return Some(());
        };
        let (message, help) = if got.is_none() && quantity.unit.is_empty() {
            (format!("{what} needs a unit"), format!("write a unit of dimension {expected} behind the number"))
        } else {
            let help = match expected.is_none() {
                true => "leave the unit away, or write one such as `deg` or `%`".to_owned(),
                false => format!("write a unit of dimension {expected}"),
            };
            (format!("{what} must be {}, not {}", dimension_text(expected), dimension_text(got)), help)
        };
        self.diagnostics.push(Diagnostic::error(Code::MissingUnit, message).at(span, "").help(help));
        None
    }

    /// Reads two bounds of a given dimension and checks their order.
    pub(crate) fn interval(&mut self, interval: &Interval, expected: Dimension, what: &str) -> Option<(f64, f64)> {
        let lower = self.of(&interval.lower, expected, &format!("the lower bound of {what}"));
        let upper = self.of(&interval.upper, expected, &format!("the upper bound of {what}"));
        self.ordered(lower?, upper?, interval.span, what)
    }

    /// Checks that a range is not empty.
    pub(crate) fn ordered(&mut self, lower: f64, upper: f64, span: Span, what: &str) -> Option<(f64, f64)> {
        if lower <= upper {
            return Some((lower, upper));
        }
        let message = format!("the lower bound of {what} is above the upper one");
        self.diagnostics.push(Diagnostic::error(Code::Range, message).at(span, "").help("exchange the bounds"));
        None
    }

    /// Reads two quantities that may share the unit of the second one: `0..200 N/m`.
    pub(crate) fn sharing_unit(&mut self, lower: &Text, upper: &Text) -> Option<(Quantity, Quantity)> {
        let (first, second) = (self.parts(lower), self.parts(upper));
        let (mut first, second) = (first?, second?);
        if !first.given && second.given && first.number.dimension.is_none_or(Dimension::is_none) {
            first.unit = second.unit;
            first.given = true;
            first.number.unit.clone_from(&second.number.unit);
        }
        Some((self.joined(first, lower)?, self.joined(second, upper)?))
    }

    fn parts(&mut self, text: &Text) -> Option<Parts> {
        let (expression, rest) = self.kept(parse_value(text))?;
        let unit_text = text.value.get(rest..).unwrap_or("").trim_end();
        let unit = parse_unit(unit_text).map_err(|error| unit_diagnostic(error, text, rest));
        // Both halves are looked at, so that both are reported.
        let number = self.number(&expression);
        let unit = self.kept(unit)?;
        let (value, dimension) = number?;
        let number = Quantity { value, dimension, unit: unit_text.to_owned() };
        Some(Parts { number, unit, given: !unit_text.is_empty() })
    }

    fn joined(&mut self, parts: Parts, text: &Text) -> Option<Quantity> {
        let Parts { number, unit, given } = parts;
        if !given {
            return Some(number);
        }
        if number.dimension.is_some_and(|dimension| !dimension.is_none()) {
            let error = Diagnostic::error(Code::Unit, "this quantity has a unit in brackets and one at the end");
            self.diagnostics.push(error.at(text.span, "").help("write one unit, at the end"));
            return None;
        }
        let value = unit.to_si(number.value);
        if !value.is_finite() {
            self.not_finite(text.span);
            return None;
        }
        Some(Quantity { value, dimension: Some(unit.dimension), unit: number.unit })
    }

    /// The value of a constant expression.
    fn number(&mut self, expression: &Expression) -> Option<(f64, Option<Dimension>)> {
        let (mut model, scope, definitions) = (empty_model(), Scope::default(), Definitions::default());
        let mut lowering = Lowering::new(&mut model, &scope, &definitions, self.sources, self.diagnostics);
        let value = lowering.expr(&expression.root, Context::of(Place::Constant))?;
        let number = evaluate(&model.graph, value.node).filter(|number| number.is_finite());
        if number.is_none() {
            self.not_finite(expression.root.span);
        }
        Some((number?, value.dimension))
    }

    fn not_finite(&mut self, span: Span) {
        let message = format!("{} is not a finite number", shortened(&format!("`{}`", self.sources.slice(span))));
        let help = "look for a division by zero, a logarithm or root of a negative number, or an overflow";
        self.diagnostics.push(Diagnostic::error(Code::NotFinite, message).at(span, "").help(help));
    }

    fn kept<T>(&mut self, result: Result<T, Box<Diagnostic>>) -> Option<T> {
        result.map_err(|diagnostic| self.diagnostics.push(*diagnostic)).ok()
    }
}
