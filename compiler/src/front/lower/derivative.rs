//! Derivatives: `d(expr, x)`, partial, and `dot(expr)`, along the motion.

use super::lowering::{Context, Lowering};
use super::scope::{Definition, Entity};
use super::value::{Uses, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::parser::shortened;
use crate::front::syntax::{Expr, ExprKind};
use crate::ir::{Binary, Node, NodeId, Symbol};
use crate::source::Span;
use std::collections::BTreeSet;

impl Lowering<'_> {
    /// `d(expr, x)`: the partial derivative, all other symbols held.
    pub(super) fn partial(&mut self, expr: &Expr, variable: &Expr, span: Span, context: Context<'_>) -> Option<Value> {
        let value = self.expr(expr, context);
        let variable_symbol = self.variable(variable, context);
        let (value, (symbol, by)) = (value?, variable_symbol?);
        self.changes(value, expr.span, context)?;
        let dimension = self.divided(value.dimension, by, span, context)?;
        if !self.model.graph.depends(&[value.node], |other| other == symbol) {
            let message = format!("{} does not depend on {}", self.quote(expr.span), self.quote(variable.span));
            let warning = Diagnostic::warning(Code::ZeroDerivative, message).at(span, "this derivative is always 0");
            self.report(warning, context);
            return Some(self.constant(0.0, dimension));
        }
        let node = self.model.graph.add(Node::Partial(value.node, symbol));
        Some(Value { node, dimension, ..value })
    }

    /// What to differentiate with respect to, and its dimension.
    fn variable(&mut self, variable: &Expr, context: Context<'_>) -> Option<(Symbol, Dimension)> {
        let name = match &variable.kind {
            ExprKind::Name(name) => name.as_str(),
            _ => "",
        };
        let argument = context.frame.is_some_and(|frame| frame.names.iter().any(|argument| argument.value == name));
        let definition = self.scope.get(name).filter(|_| !argument);
        match (name, definition) {
            ("tau", _) => return Some((Symbol::Tau, Dimension::TIME)),
            ("t", _) => return Some((Symbol::Time, Dimension::TIME)),
            (_, Some(Definition { entity: Entity::State(i), dimension, .. })) => {
                return Some((Symbol::State(i), dimension?));
            }
            (_, Some(Definition { entity: Entity::Parameter(i), dimension, .. })) => {
                return Some((Symbol::Parameter(i), dimension?));
            }
            _ => {}
        }
        let message = format!("{} is not a variable to differentiate with respect to", self.quote(variable.span));
        let error = Diagnostic::error(Code::WithRespectTo, message).at(variable.span, "");
        self.report(error.help("write the name of a state or parameter, `tau` or `t`"), context);
        None
    }

    /// `dot(expr)`: the time derivative along the motion, sum over the states of (d expr/d x_i) dot(x_i), plus the
    /// partial derivatives by tau and t. What dot(x_i) is the integrator knows, also where the mass matrix is singular.
    pub(super) fn rate_of(&mut self, expr: &Expr, span: Span, context: Context<'_>) -> Option<Value> {
        let value = self.expr(expr, context)?;
        self.rate(value, expr.span, span, context)
    }

    /// The time derivative of the value at `of`, written at `span`.
    pub(super) fn rate(&mut self, value: Value, of: Span, span: Span, context: Context<'_>) -> Option<Value> {
        self.changes(value, of, context)?;
        let dimension = self.divided(value.dimension, Dimension::TIME, span, context)?;
        if value.uses.any(Uses::RATE) {
            let message = "this is a second time derivative, which is not computed";
            let error = Diagnostic::error(Code::NotAvailable, message).at(span, "");
            let help = "write the first one without `dot`, or make it a state";
            self.report(error.help(help), context);
            return None;
        }
        let mut sum: Option<NodeId> = None;
        let mut uses = value.uses;
        for symbol in self.changing(value.node) {
            let slope = self.slope(value.node, symbol);
            let term = match symbol {
                Symbol::State(i) => {
                    uses = uses.and(Uses::RATE);
                    let rate = self.model.graph.symbol(Symbol::Rate(i));
                    self.binary(Binary::Mul, slope, rate)
                }
                _ => slope,
            };
            sum = Some(sum.map_or(term, |sum| self.binary(Binary::Add, sum, term)));
        }
        let Some(node) = sum else {
            let message = format!("{} does not change along the motion", self.quote(of));
            let warning = Diagnostic::warning(Code::ZeroDerivative, message).at(span, "this derivative is always 0");
            self.report(warning, context);
            return Some(self.constant(0.0, dimension));
        };
        let name = self.sources.slice(span).to_owned();
        self.available(Value { node, dimension, uses }, &shortened(&name), span, context)
    }

    /// The states that a node depends on, tau and t, in the order of [`Symbol`].
    fn changing(&self, node: NodeId) -> BTreeSet<Symbol> {
        let mut symbols = BTreeSet::new();
        self.model.graph.visit(&[node], |_, node| {
            if let Node::Symbol(symbol @ (Symbol::State(_) | Symbol::Tau | Symbol::Time)) = node {
                symbols.insert(symbol);
            }
        });
        symbols
    }

    /// The partial derivative of a node by a symbol that it depends on.
    fn slope(&mut self, node: NodeId, symbol: Symbol) -> NodeId {
        let graph = &mut self.model.graph;
        if graph.node(node) == Node::Symbol(symbol) {
            return graph.constant(1.0);
        }
        graph.add(Node::Partial(node, symbol))
    }

    /// Reports what is one number of a map.
    fn changes(&mut self, value: Value, span: Span, context: Context<'_>) -> Option<()> {
        if value.uses.any(Uses::RESULT) {
            let message = "what is known only after a map has no derivative here";
            self.report(Diagnostic::error(Code::NotAvailable, message).at(span, ""), context);
            return None;
        }
        Some(())
    }

    /// The dimension of a derivative; outer `None` if it is out of range, which is reported.
    fn divided(
        &mut self,
        dimension: Option<Dimension>,
        by: Dimension,
        span: Span,
        context: Context<'_>,
    ) -> Option<Option<Dimension>> {
        match dimension {
            Some(dimension) => self.in_range(dimension.div(by), span, context).map(Some),
            None => Some(None),
        }
    }
}
