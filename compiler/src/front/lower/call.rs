//! Function calls: the functions of the language, functionals, and the spec's own functions, inlined where they are
//! called.

use super::branch::Extreme;
use super::definitions::undefined_function;
use super::expr::Operand;
use super::lowering::{Context, Frame, Lowering};
use super::scope::{Definition, Entity};
use super::value::{Place, Uses, Value};

use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::{Dimension, Exponent};
use crate::front::names::{FUNCTIONALS, FUNCTIONS};
use crate::front::syntax::Call;
use crate::ir::eval::real::unary;
use crate::ir::{Binary, Functional, FunctionalKind, NodeId, Symbol, Unary};
use crate::source::Span;

impl Lowering<'_> {
    pub(super) fn call(&mut self, call: &Call, span: Span, context: Context<'_>) -> Option<Value> {
        if FUNCTIONALS.contains(&call.name.as_str()) {
            return self.functional_call(call, context);
        }
        if let Some(&(name, count)) = FUNCTIONS.iter().find(|(name, _)| *name == call.name) {
            self.count(call, count, span, context)?;
            return self.built_in(name, call, span, context);
        }
        match self.scope.get(&call.name) {
            Some(Definition { entity: Entity::Function(i), .. }) => self.inline(i, call, span, context),
            Some(Definition { entity, .. }) => {
                let message = format!("`{}` is {}, not a function", call.name, entity.kind());
                let error = Diagnostic::error(Code::WrongKind, message).at(call.name_span, "");
                self.report(error.help("write `*` before the parenthesis to multiply"), context);
                None
            }
            None => {
                self.report(undefined_function(&call.name, call.name_span, self.scope), context);
                None
            }
        }
    }

    /// Checks the number of arguments.
    fn count(&mut self, call: &Call, expected: usize, span: Span, context: Context<'_>) -> Option<()> {
        let given = call.arguments.len();
        if given == expected {
            return Some(());
        }
        let plural = if expected == 1 { "" } else { "s" };
        let message = format!("`{}` takes {expected} argument{plural}, not {given}", call.name);
        let error = Diagnostic::error(Code::Arguments, message).at(span, "");
        let largest = match call.name.as_str() {
            "max" => Some("largest"),
            "min" => Some("smallest"),
            _ => None,
        };
        self.report(
            match largest.filter(|_| given == 1 && context.place == Place::Measure) {
                Some(which) => error.help(format!(
                    "the {which} value during a map is `cycle_{0}(...)`; `{0}(a, b)` is one of two",
                    call.name
                )),
                None => error,
            },
            context,
        );
        None
    }

    fn built_in(&mut self, name: &str, call: &Call, span: Span, context: Context<'_>) -> Option<Value> {
        match (name, call.arguments.as_slice()) {
            ("if", [condition, then, otherwise]) => self.if_(condition, then, otherwise, context),
            ("d", [expr, variable]) => self.partial(expr, variable, span, context),
            ("dot", [expr]) => self.rate_of(expr, span, context),
            ("min" | "max" | "atan2", [a, b]) => {
                let (left, right) = (self.expr(a, context), self.expr(b, context));
                let (a, b) = (Operand { value: left?, span: a.span }, Operand { value: right?, span: b.span });
                let dimension = self.same(a, b, &format!("`{name}`"), context)?;
                match name {
                    "min" => Some(self.extreme(Extreme::Smaller, a.value, b.value, dimension, span, context)),
                    "max" => Some(self.extreme(Extreme::Larger, a.value, b.value, dimension, span, context)),
                    _ => {
                        let node = self.binary(Binary::Atan2, a.value.node, b.value.node);
                        let uses = a.value.uses.and(b.value.uses);
                        Some(Value { node, dimension: Some(Dimension::NONE), uses })
                    }
                }
            }
            (_, [argument]) => {
                let value = self.expr(argument, context)?;
                self.unary(name, Operand { value, span: argument.span }, span, context)
            }
            _ => None,
        }
    }

    fn unary(&mut self, name: &str, a: Operand, span: Span, context: Context<'_>) -> Option<Value> {
        match name {
            "abs" => return Some(self.abs(a.value, span, context)),
            "sign" => return Some(self.sign(a.value, span, context)),
            "sqrt" => {
                self.real_of(Unary::Sqrt, a, span, context)?;
                let node = self.model.graph.unary(Unary::Sqrt, a.value.node);
                let half = Exponent { numerator: 1, denominator: 2 };
                let dimension = match a.value.dimension {
                    Some(dimension) => Some(self.in_range(dimension.pow(half), span, context)?),
                    None => None,
                };
                return Some(Value { node, dimension, ..a.value });
            }
            _ => {}
        }
        let op = match name {
            "sin" => Unary::Sin,
            "cos" => Unary::Cos,
            "tan" => Unary::Tan,
            "asin" => Unary::Asin,
            "acos" => Unary::Acos,
            "atan" => Unary::Atan,
            "sinh" => Unary::Sinh,
            "cosh" => Unary::Cosh,
            "tanh" => Unary::Tanh,
            "asinh" => Unary::Asinh,
            "acosh" => Unary::Acosh,
            "atanh" => Unary::Atanh,
            "exp" => Unary::Exp,
            "log" => Unary::Log,
            _ => return None,
        };
        self.dimensionless(a, &format!("the argument of `{name}`"), context)?;
        self.real_of(op, a, span, context)?;
        let node = self.model.graph.unary(op, a.value.node);
        Some(Value { node, dimension: Some(Dimension::NONE), ..a.value })
    }

    /// Checks a function of a literal.
    fn real_of(&mut self, op: Unary, a: Operand, span: Span, context: Context<'_>) -> Option<()> {
        match self.model.graph.constant_value(a.value.node) {
            Some(literal) => self.real(unary(op, literal), "this value", span, context),
            None => Some(()),
        }
    }

    fn functional_call(&mut self, call: &Call, context: Context<'_>) -> Option<Value> {
        self.count(call, 1, call.name_span, context)?;
        match context.place {
            Place::Measure => {}
            Place::Functional => {
                let message = format!("`{}` stands inside another functional", call.name);
                let error = Diagnostic::error(Code::NotAvailable, message).at(call.name_span, "");
                self.report(error.help("a functional takes what changes along the motion"), context);
                return None;
            }
            _ => {
                let help = "define a measure with it; problems use measures by name";
                return self.only_in("measures", &call.name, call.name_span, help, context);
            }
        }
        let argument = self.expr(call.arguments.first()?, context.with_place(Place::Functional))?;
        let (kind, dimension) = match call.name.as_str() {
            "start" => (FunctionalKind::Start, argument.dimension),
            "end" => (FunctionalKind::End, argument.dimension),
            "mean" => (FunctionalKind::Mean, argument.dimension),
            "cycle_max" => (FunctionalKind::Maximum, argument.dimension),
            "cycle_min" => (FunctionalKind::Minimum, argument.dimension),
            _ => {
                let time = argument.dimension.map(|dimension| dimension.mul(Dimension::TIME));
                let time = match time {
                    Some(dimension) => Some(self.in_range(dimension, call.name_span, context)?),
                    None => None,
                };
                (FunctionalKind::Integral, time)
            }
        };
        Some(self.functional(kind, argument.node, dimension))
    }

    /// The value of a functional.
    pub(super) fn functional(&mut self, kind: FunctionalKind, expr: NodeId, dimension: Option<Dimension>) -> Value {
        let index = self.functional_index(kind, expr);
        Value { node: self.model.graph.symbol(Symbol::Functional(index)), dimension, uses: Uses::FUNCTIONAL }
    }

    /// The index of the functional of an expression; one that is there already is shared.
    pub(super) fn functional_index(&mut self, kind: FunctionalKind, expr: NodeId) -> usize {
        let functionals = &mut self.model.functionals;
        *self.functionals.entry((kind, expr)).or_insert_with(|| {
            functionals.push(Functional { kind, expr });
            functionals.len() - 1
        })
    }

    /// A function of the spec, its body lowered with the arguments in place.
    fn inline(&mut self, index: usize, call: &Call, span: Span, context: Context<'_>) -> Option<Value> {
        let definitions = self.definitions;
        let function = definitions.functions.get(index)?;
        let values: Vec<Option<Value>> = call.arguments.iter().map(|argument| self.expr(argument, context)).collect();
        self.count(call, function.value.arguments.len(), span, context)?;
        if definitions.function_is_cyclic(index) {
            return None;
        }
        let key = (index, values, context.place);
        if let Some(&value) = self.calls.get(&key) {
            return value;
        }
        let body = function.value.body.as_ref().and_then(|body| body.expression.as_ref());
        let frame = Frame { function: &function.name, names: &function.value.arguments, values: &key.1, call: span };
        let value = body.and_then(|body| self.expr(&body.root, Context { place: context.place, frame: Some(&frame) }));
        self.calls.insert(key, value);
        value
    }
}
