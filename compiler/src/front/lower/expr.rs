//! Syntax trees to nodes: literals, names and arithmetic, with the dimension of each.

use super::definitions::undefined;
use super::dimension_text;
use super::fold;
use super::lowering::{Context, Lowering};
use super::scope::{Definition, Entity};
use super::value::{Place, Uses, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::{Dimension, Exponent};
use crate::front::names::{FUNCTIONALS, reserved};
use crate::front::syntax::{Arithmetic, Expr, ExprKind};
use crate::front::units::Unit;
use crate::ir::{Binary, FunctionalKind, NodeId, Symbol};
use crate::source::Span;

/// A lowered operand and its place.
#[derive(Clone, Copy)]
pub(super) struct Operand {
    pub(super) value: Value,
    pub(super) span: Span,
}

impl Lowering<'_> {
    /// Lowers an expression; `None` when it is broken, which has been reported.
    pub(crate) fn expr(&mut self, expr: &Expr, context: Context<'_>) -> Option<Value> {
        if !self.enter(expr.span, context) {
            return None;
        }
        let value = match &expr.kind {
            ExprKind::Number(value, unit) => self.number(*value, unit.as_ref(), expr.span, context),
            ExprKind::Name(name) => self.name(name, expr.span, context),
            ExprKind::Neg(operand) => self.expr(operand, context).map(|value| self.negated(value)),
            ExprKind::Arithmetic(..) => self.arithmetic(expr, context),
            ExprKind::Call(call) => self.call(call, expr.span, context),
            ExprKind::Compare(..) | ExprKind::Logic(..) | ExprKind::Not(_) => {
                let error = Diagnostic::error(Code::Condition, "a condition stands where a number is expected");
                let help = "choose between two numbers by `if(condition, a, b)`";
                self.report(error.at(expr.span, "").help(help), context);
                None
            }
        };
        self.leave();
        value
    }

    /// A constant of this model.
    pub(super) fn constant(&mut self, value: f64, dimension: Option<Dimension>) -> Value {
        Value { node: self.model.graph.constant(value), dimension, uses: Uses::NONE }
    }

    fn number(&mut self, value: f64, unit: Option<&Unit>, span: Span, context: Context<'_>) -> Option<Value> {
        let (si, dimension) = match unit {
            Some(unit) => (unit.to_si(value), Some(unit.dimension)),
            None if value == 0.0 => (value, None),
            None => (value, Some(Dimension::NONE)),
        };
        self.finite(si, span, context)?;
        Some(self.constant(si, dimension))
    }

    /// Reports a constant that is not finite.
    fn finite(&mut self, value: f64, span: Span, context: Context<'_>) -> Option<()> {
        if value.is_finite() {
            return Some(());
        }
        let error = Diagnostic::error(Code::NotFinite, "this constant is not a finite number").at(span, "");
        self.report(error.help("real numbers go up to about 1.8e308"), context);
        None
    }

    /// Reports a function of literals that has no real value.
    pub(super) fn real(&mut self, value: f64, what: &str, span: Span, context: Context<'_>) -> Option<()> {
        if value.is_finite() {
            return Some(());
        }
        let error = Diagnostic::error(Code::NotFinite, format!("{what} is not a real number")).at(span, "");
        self.report(
            error
                .help("even roots and logarithms take what is not negative, `asin` and `acos` what is within -1 and 1"),
            context,
        );
        None
    }

    pub(super) fn negated(&mut self, value: Value) -> Value {
        Value { node: fold::neg(&mut self.model.graph, value.node), ..value }
    }

    fn name(&mut self, name: &str, span: Span, context: Context<'_>) -> Option<Value> {
        let argument = context.frame.and_then(|frame| {
            let i = frame.names.iter().position(|argument| argument.value == name)?;
            frame.values.get(i).copied()
        });
        let value = match argument {
            Some(value) => value?,
            None => match self.word(name, span, context) {
                Some(value) => value?,
                None => self.definition(name, span, context)?,
            },
        };
        self.available(value, name, span, context)
    }

    /// The value of a word of the language; `None` if the name is none.
    fn word(&mut self, name: &str, span: Span, context: Context<'_>) -> Option<Option<Value>> {
        let meaning = reserved(name)?;
        Some(match (name, context.place) {
            ("pi", _) => Some(self.constant(std::f64::consts::PI, Some(Dimension::NONE))),
            ("tau", _) => Some(self.symbol(Symbol::Tau, Dimension::TIME, Uses::TAU)),
            ("t", _) => Some(self.symbol(Symbol::Time, Dimension::TIME, Uses::TIME)),
            ("duration", Place::Measure) => {
                let one = self.model.graph.constant(1.0);
                Some(self.functional(FunctionalKind::Duration, one, Some(Dimension::TIME)))
            }
            ("duration", _) => {
                let help = "define a measure, as in `step_time = { expr = \"duration\", unit = \"s\" }`, and use that";
                self.only_in("measures", name, span, help, context)
            }
            ("spectral_radius", Place::Problem) => {
                Some(self.symbol(Symbol::SpectralRadius, Dimension::NONE, Uses::RADIUS))
            }
            ("spectral_radius", _) => {
                let help = "bound it in `subject_to` of a problem: `spectral_radius <= 0.95`";
                self.only_in("problems", name, span, help, context)
            }
            _ => {
                let error =
                    Diagnostic::error(Code::WrongKind, format!("`{name}` is {meaning}, not a value")).at(span, "");
                self.report(error.help(format!("write its arguments in parentheses: `{name}(...)`")), context);
                None
            }
        })
    }

    /// Reports a word that has no meaning in this place.
    pub(super) fn only_in<T>(
        &mut self,
        where_: &str,
        name: &str,
        span: Span,
        help: &str,
        context: Context<'_>,
    ) -> Option<T> {
        let message = format!("`{name}` is available in {where_} only");
        self.report(Diagnostic::error(Code::NotAvailable, message).at(span, "").help(help), context);
        None
    }

    pub(super) fn symbol(&mut self, symbol: Symbol, dimension: Dimension, uses: Uses) -> Value {
        Value { node: self.model.graph.symbol(symbol), dimension: Some(dimension), uses }
    }

    /// The value of a name that the spec defines.
    fn definition(&mut self, name: &str, span: Span, context: Context<'_>) -> Option<Value> {
        let Some(Definition { entity, dimension, .. }) = self.scope.get(name) else {
            let error = if context.place == Place::Constant {
                not_constant(name, span)
            } else {
                undefined(name, span, self.scope)
            };
            self.report(error, context);
            return None;
        };
        match entity {
            Entity::Parameter(i) => Some(self.symbol(Symbol::Parameter(i), dimension?, Uses::PARAMETER)),
            Entity::State(i) => Some(self.symbol(Symbol::State(i), dimension?, Uses::STATE)),
            Entity::Memory(i) => Some(self.symbol(Symbol::Memory(i), Dimension::NONE, Uses::MEMORY)),
            Entity::Let(i) => self.lets.get(&(i, context.place.style())).copied().flatten(),
            Entity::Function(_) => {
                let error =
                    Diagnostic::error(Code::WrongKind, format!("`{name}` is a function, not a value")).at(span, "");
                self.report(error.help(format!("write its arguments in parentheses: `{name}(...)`")), context);
                None
            }
            Entity::Measure(i) => match context.place {
                Place::Measure => self.measures.get(&i).copied().flatten(),
                Place::Problem => Some(self.symbol(Symbol::Measure(i), dimension?, Uses::MEASURE)),
                _ => {
                    let help = "measures are known after a map; other measures and problems can use them";
                    self.only_in("measures and problems", name, span, help, context)
                }
            },
        }
    }

    /// Passes on a value that exists in this place; else says why not.
    pub(super) fn available(&mut self, value: Value, name: &str, span: Span, context: Context<'_>) -> Option<Value> {
        if value.uses.only(context.place.available()) {
            return Some(value);
        }
        let (message, help) = match context.place {
            Place::Measure => (
                format!("`{name}` changes along the motion, so it is not one number of a map"),
                format!("say what of it: {}", FUNCTIONALS.map_list(name)),
            ),
            Place::Problem => (
                format!("`{name}` changes along the motion, so a problem cannot use it"),
                format!("define a measure, such as `mean({name})` or `cycle_max({name})`, and use that"),
            ),
            Place::Section => (
                format!("`{name}` has no value on the section, which knows states and parameters only"),
                "write it without memory, rates, `tau` and `t`".to_owned(),
            ),
            Place::Flow if value.uses.any(Uses::RATE) => (
                format!("`{name}` needs a rate, which flow and mass matrix are there to determine"),
                "move the factor of the rate to `[modes.NAME.mass]`, so that the flow is what remains; where states \
                 give the rate themselves, write them, as the speed `v` for `dot(x)`"
                    .to_owned(),
            ),
            Place::Event(_) | Place::When(_) if value.uses.any(Uses::RATE) => (
                format!("`{name}` needs a rate, which transitions do not know in a mode with a mass matrix"),
                "write it with states: where the mass matrix is singular, a rate may have no value".to_owned(),
            ),
            _ => (
                format!("`{name}` is known only after a whole map"),
                "use it in measures, outside functionals such as `mean(...)`".to_owned(),
            ),
        };
        self.report(Diagnostic::error(Code::NotAvailable, message).at(span, "").help(help), context);
        None
    }

    /// A chain of operators, from the left and without recursion into it: `a + b + c + ...` may be long.
    fn arithmetic(&mut self, expr: &Expr, context: Context<'_>) -> Option<Value> {
        let mut chain = Vec::new();
        let mut first = expr;
        while let ExprKind::Arithmetic(op, left, right) = &first.kind {
            chain.push((*op, &**right, first.span));
            first = left;
        }
        let mut value = self.expr(first, context);
        let mut span = first.span;
        for (op, right, whole) in chain.into_iter().rev() {
            let right_value = self.expr(right, context);
            value = match (value, right_value) {
                (Some(left), Some(value)) => {
                    let (left, right) = (Operand { value: left, span }, Operand { value, span: right.span });
                    self.combine(op, left, right, whole, context)
                }
                _ => None,
            };
            span = whole;
        }
        value
    }

    fn combine(&mut self, op: Arithmetic, a: Operand, b: Operand, whole: Span, context: Context<'_>) -> Option<Value> {
        let (binary, dimension) = match op {
            Arithmetic::Add => (Binary::Add, self.same(a, b, &format!("`{}`", op.symbol()), context)?),
            Arithmetic::Sub => (Binary::Sub, self.same(a, b, &format!("`{}`", op.symbol()), context)?),
            Arithmetic::Mul => (Binary::Mul, self.product(a, b, Dimension::mul, whole, context)?),
            Arithmetic::Div => {
                if self.model.graph.constant_value(b.value.node) == Some(0.0) {
                    let error = Diagnostic::error(Code::NotFinite, "division by zero").at(b.span, "this is 0");
                    self.report(error, context);
                    return None;
                }
                (Binary::Div, self.product(a, b, Dimension::div, whole, context)?)
            }
            Arithmetic::Pow => (Binary::Pow, self.power(a, b, whole, context)?),
        };
        let node = fold::binary(&mut self.model.graph, binary, a.value.node, b.value.node);
        let constant = |id| self.model.graph.constant_value(id);
        if let Some(value) = constant(node) {
            self.finite(value, whole, context)?;
        } else if let (Arithmetic::Pow, Some(base), Some(exponent)) =
            (op, constant(a.value.node), constant(b.value.node))
        {
            self.real(base.powf(exponent), "this power", whole, context)?;
        }
        Some(Value { node, dimension, uses: a.value.uses.and(b.value.uses) })
    }

    /// The common dimension of two operands; outer `None` if they clash, which is reported.
    pub(super) fn same(
        &mut self,
        a: Operand,
        b: Operand,
        what: &str,
        context: Context<'_>,
    ) -> Option<Option<Dimension>> {
        match (a.value.dimension, b.value.dimension) {
            (None, other) | (other, None) => Some(other),
            (Some(left), Some(right)) if left == right => Some(Some(left)),
            (Some(left), Some(right)) => {
                let message = format!("{what} cannot join {} and {}", dimension_text(left), dimension_text(right));
                let text =
                    |this: &Self, span, dimension| format!("{} is {}", this.quote(span), dimension_text(dimension));
                let error = Diagnostic::error(Code::Clash, message)
                    .at(b.span, text(self, b.span, right))
                    .at(a.span, text(self, a.span, left));
                let number = |operand: Operand| self.model.graph.constant_value(operand.value.node).is_some();
                let error = match (left.is_none() && number(a), right.is_none() && number(b)) {
                    (true, false) | (false, true) => {
                        error.help("a literal takes its unit in brackets, as in `3 [m/s]`")
                    }
                    _ => error,
                };
                self.report(error, context);
                None
            }
        }
    }

    fn product(
        &mut self,
        a: Operand,
        b: Operand,
        of: impl Fn(Dimension, Dimension) -> Option<Dimension>,
        whole: Span,
        context: Context<'_>,
    ) -> Option<Option<Dimension>> {
        match (a.value.dimension, b.value.dimension) {
            (Some(a), Some(b)) => self.in_range(of(a, b), whole, context).map(Some),
            _ => Some(None),
        }
    }

    /// Reports a dimension whose exponents have left the range of integers.
    pub(super) fn in_range(
        &mut self,
        dimension: Option<Dimension>,
        span: Span,
        context: Context<'_>,
    ) -> Option<Dimension> {
        if dimension.is_none() {
            let message = "the exponents of this dimension are out of range";
            self.report(Diagnostic::error(Code::DimensionOverflow, message).at(span, ""), context);
        }
        dimension
    }

    fn power(&mut self, a: Operand, b: Operand, whole: Span, context: Context<'_>) -> Option<Option<Dimension>> {
        self.dimensionless(b, "an exponent", context)?;
        let Some(base) = a.value.dimension.filter(|dimension| !dimension.is_none()) else {
            return Some(a.value.dimension.or(Some(Dimension::NONE)));
        };
        let exponent = self.model.graph.constant_value(b.value.node).and_then(fraction);
        let Some(exponent) = exponent else {
            let message = "an exponent of something with a dimension must be a constant fraction";
            let error = Diagnostic::error(Code::Exponent, message).at(b.span, "");
            let label = format!("{} is {}", self.quote(a.span), dimension_text(base));
            self.report(
                error
                    .see(a.span, label)
                    .help("write a number, as in `x^2` or `x^(1/2)`, or make the base dimensionless"),
                context,
            );
            return None;
        };
        self.in_range(base.pow(exponent), whole, context).map(Some)
    }

    /// Reports an operand that has a dimension.
    pub(super) fn dimensionless(&mut self, a: Operand, what: &str, context: Context<'_>) -> Option<()> {
        let Some(dimension) = a.value.dimension.filter(|dimension| !dimension.is_none()) else {
            return Some(());
        };
        let message = format!("{what} must be dimensionless, not {}", dimension_text(dimension));
        let label = format!("{} is {}", self.quote(a.span), dimension_text(dimension));
        let error = Diagnostic::error(Code::NotDimensionless, message).at(a.span, label);
        self.report(error.help("divide by something of the same dimension"), context);
        None
    }

    /// A node of two operands with the simplifications of [`fold`].
    pub(super) fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        fold::binary(&mut self.model.graph, op, a, b)
    }
}

/// The message for a name in a quantity.
fn not_constant(name: &str, span: Span) -> Diagnostic {
    let message = format!("a quantity cannot use `{}`", crate::front::parser::shortened(name));
    let help =
        "a quantity is made of numbers, `pi` and functions, then a space and a unit, as in `2*pi*3 rad/s` or `3 1/s`";
    Diagnostic::error(Code::NotConstant, message).at(span, "not a constant").help(help)
}

/// The fraction with a small denominator that a constant is.
fn fraction(value: f64) -> Option<Exponent> {
    const LARGEST: f64 = 1000.0;
    (1..=12).find_map(|denominator| {
        let numerator = (value * f64::from(denominator)).round();
        let exact = numerator.abs() <= LARGEST && numerator / f64::from(denominator) == value;
        // The bound above makes the conversion exact.
        exact.then(|| Exponent::new(numerator as i32, denominator)).flatten()
    })
}

/// How functionals of a name are listed in messages.
trait MapList {
    fn map_list(&self, name: &str) -> String;
}

impl MapList for &[&str] {
    fn map_list(&self, name: &str) -> String {
        self.iter().map(|functional| format!("`{functional}({name})`")).collect::<Vec<_>>().join(", ")
    }
}
