//! Conditions, `if`, `min`, `max`, `abs` and `sign`.
//!
//! Where an integration runs they select by frozen selectors: `a <= b` has the switching function b - a, and selectors
//! are shared between conditions on the same function, also on its negative, whose branches then change sides.
//! Elsewhere they choose by the sign of the same function at once.

use super::expr::Operand;
use super::lowering::{Context, Lowering};
use super::value::{Place, Style, Uses, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::parser::shortened;
use crate::front::syntax::{Comparison, Expr, ExprKind, Logic};
use crate::ir::{Binary, Node, NodeId, Switch, Symbol, Unary};
use crate::source::Span;

/// Two branches.
#[derive(Clone, Copy)]
struct Branches {
    then: NodeId,
    otherwise: NodeId,
}

/// Which of two numbers.
#[derive(Clone, Copy)]
pub(super) enum Extreme {
    Smaller,
    Larger,
}

impl Lowering<'_> {
    /// `if(condition, then, otherwise)`.
    pub(super) fn if_(
        &mut self,
        condition: &Expr,
        then: &Expr,
        otherwise: &Expr,
        context: Context<'_>,
    ) -> Option<Value> {
        let (a, b) = (self.expr(then, context), self.expr(otherwise, context));
        let branches = match (a, b) {
            (Some(a), Some(b)) => {
                let (a, b) = (Operand { value: a, span: then.span }, Operand { value: b, span: otherwise.span });
                self.same(a, b, "`if`", context).map(|dimension| (a.value, b.value, dimension))
            }
            _ => None,
        };
        let Some((a, b, dimension)) = branches else {
            // Lowered all the same, for its messages.
            let zero = self.model.graph.constant(0.0);
            self.choose(condition, Branches { then: zero, otherwise: zero }, context);
            return None;
        };
        let (node, uses) = self.choose(condition, Branches { then: a.node, otherwise: b.node }, context)?;
        Some(Value { node, dimension, uses: uses.and(a.uses).and(b.uses) })
    }

    /// The node that is one of two by a condition, and what the condition depends on.
    fn choose(&mut self, condition: &Expr, branches: Branches, context: Context<'_>) -> Option<(NodeId, Uses)> {
        if !self.enter(condition.span, context) {
            return None;
        }
        let Branches { then, otherwise } = branches;
        let result = match &condition.kind {
            ExprKind::Compare(comparison, a, b) => {
                let function = self.difference(*comparison, a, b, context);
                function.map(|value| (self.by_sign(value.node, branches, condition.span, context), value.uses))
            }
            ExprKind::Not(inner) => self.choose(inner, Branches { then: otherwise, otherwise: then }, context),
            ExprKind::Logic(logic, a, b) => {
                let inner = self.choose(b, branches, context);
                let (node, uses) = inner.unwrap_or((then, Uses::NONE));
                let outer = match logic {
                    Logic::And => Branches { then: node, otherwise },
                    Logic::Or => Branches { then, otherwise: node },
                };
                let outer = self.choose(a, outer, context);
                outer.filter(|_| inner.is_some()).map(|(node, more)| (node, uses.and(more)))
            }
            _ => {
                self.no_condition(condition, context);
                None
            }
        };
        self.leave();
        result
    }

    fn no_condition(&mut self, expr: &Expr, context: Context<'_>) {
        let error =
            Diagnostic::error(Code::Condition, "a number stands where a condition is expected").at(expr.span, "");
        self.report(error.help("compare it, as in `x >= 0`"), context);
    }

    /// What is `>= 0` where the comparison holds.
    fn difference(&mut self, comparison: Comparison, a: &Expr, b: &Expr, context: Context<'_>) -> Option<Value> {
        let (left, right) = (self.expr(a, context), self.expr(b, context));
        let (a, b) = (Operand { value: left?, span: a.span }, Operand { value: right?, span: b.span });
        let dimension = self.same(a, b, &format!("`{}`", comparison.symbol()), context)?;
        let (large, small) = if comparison.is_less() { (b, a) } else { (a, b) };
        let node = self.binary(Binary::Sub, large.value.node, small.value.node);
        let node = self.beside_zero(node, comparison);
        Some(Value { node, dimension, uses: a.value.uses.and(b.value.uses) })
    }

    /// A difference of whole numbers may well be 0, where `<` and `<=` differ: it is moved by one half to the side where it
    /// belongs.
    fn beside_zero(&mut self, difference: NodeId, comparison: Comparison) -> NodeId {
        if !self.is_whole(difference) {
            return difference;
        }
        let strict = matches!(comparison, Comparison::Less | Comparison::Greater);
        let half = self.model.graph.constant(0.5);
        self.binary(if strict { Binary::Sub } else { Binary::Add }, difference, half)
    }

    /// A condition as one number that is `>= 0` where it holds: `and` is the smaller, `or` the larger one.
    pub(crate) fn margin(&mut self, condition: &Expr, place: Place) -> Option<Value> {
        let context = Context::of(place);
        if !self.enter(condition.span, context) {
            return None;
        }
        let value = match &condition.kind {
            ExprKind::Compare(comparison, a, b) => self.difference(*comparison, a, b, context),
            ExprKind::Not(inner) => self.margin(inner, place).map(|value| self.negated(value)),
            ExprKind::Logic(logic, a, b) => {
                let (a, b) = (self.margin(a, place), self.margin(b, place));
                a.zip(b).map(|(a, b)| {
                    let extreme = if *logic == Logic::And { Extreme::Smaller } else { Extreme::Larger };
                    self.extreme(extreme, a, b, Some(Dimension::NONE), condition.span, context)
                })
            }
            _ => {
                self.no_condition(condition, context);
                None
            }
        };
        self.leave();
        value
    }

    /// `min(a, b)` or `max(a, b)`.
    pub(super) fn extreme(
        &mut self,
        extreme: Extreme,
        a: Value,
        b: Value,
        dimension: Option<Dimension>,
        span: Span,
        context: Context<'_>,
    ) -> Value {
        let difference = match extreme {
            Extreme::Smaller => self.binary(Binary::Sub, b.node, a.node),
            Extreme::Larger => self.binary(Binary::Sub, a.node, b.node),
        };
        let branches = Branches { then: a.node, otherwise: b.node };
        let node = self.by_sign(difference, branches, span, context);
        Value { node, dimension, uses: a.uses.and(b.uses) }
    }

    pub(super) fn abs(&mut self, a: Value, span: Span, context: Context<'_>) -> Value {
        let minus = self.negated(a).node;
        let node = self.by_sign(a.node, Branches { then: a.node, otherwise: minus }, span, context);
        Value { node, ..a }
    }

    pub(super) fn sign(&mut self, a: Value, span: Span, context: Context<'_>) -> Value {
        let (one, minus) = (self.model.graph.constant(1.0), self.model.graph.constant(-1.0));
        let node = self.by_sign(a.node, Branches { then: one, otherwise: minus }, span, context);
        Value { node, dimension: Some(Dimension::NONE), ..a }
    }

    /// `then` where the function is `>= 0`.
    fn by_sign(&mut self, function: NodeId, branches: Branches, span: Span, context: Context<'_>) -> NodeId {
        let Branches { then, otherwise } = branches;
        if let Some(value) = self.model.graph.constant_value(function) {
            return if value >= 0.0 { then } else { otherwise };
        }
        if then == otherwise {
            return then;
        }
        if context.place.style() == Style::Immediate {
            return self.model.graph.add(Node::Choose { margin: function, then, otherwise });
        }
        if self.model.graph.depends(&[function], |symbol| matches!(symbol, Symbol::Rate(_))) {
            let message = "this switches where something made of rates is zero, which cannot be located";
            let help = "decide by states; for the largest magnitude take `cycle_max(x)` and `cycle_min(x)` apart";
            self.report(Diagnostic::error(Code::NotAvailable, message).at(span, "").help(help), context);
            return then;
        }
        let (switch, reversed) = self.switch(function, span);
        let (then, otherwise) = if reversed { (otherwise, then) } else { (then, otherwise) };
        self.model.graph.add(Node::Select { switch, then, otherwise })
    }

    /// The switch of a function, and whether it is that of the function's negative.
    fn switch(&mut self, function: NodeId, span: Span) -> (usize, bool) {
        if let Some(&switch) = self.switches.get(&function) {
            return (switch, false);
        }
        if let Some(&switch) = self.negative(function).and_then(|negative| self.switches.get(&negative)) {
            return (switch, true);
        }
        let switch = self.model.switches.len();
        let text = shortened(self.sources.slice(span));
        self.model.switches.push(Switch { expr: function, text });
        self.switches.insert(function, switch);
        (switch, false)
    }

    /// The node that is the negative of a function, as it would have been lowered.
    fn negative(&mut self, function: NodeId) -> Option<NodeId> {
        match self.model.graph.node(function) {
            Node::Binary(Binary::Sub, a, b) => Some(self.binary(Binary::Sub, b, a)),
            Node::Unary(Unary::Neg, a) => Some(a),
            _ => Some(self.model.graph.unary(Unary::Neg, function)),
        }
    }
}
