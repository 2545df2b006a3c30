//! The state of lowering: the model that grows, the names, and what has been lowered already.

use super::definitions::{Definitions, Lets};
use super::dimension_text;
use super::scope::Scope;
use super::value::{Place, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::parser::shortened;
use crate::front::spec::Equation;
use crate::front::text::Text;
use crate::ir::{FunctionalKind, Model, NodeId};
use crate::source::{SourceMap, Span};
use std::collections::HashMap;

/// Deepest nesting of expressions through the functions that they call.
const DEPTH_LIMIT: usize = 256;
/// Most nodes of a model.
const NODE_LIMIT: usize = 200_000;

/// Lowers expressions into a model's graph.
pub(crate) struct Lowering<'a> {
    pub(crate) model: &'a mut Model,
    pub(crate) scope: &'a Scope,
    pub(crate) definitions: &'a Definitions<'a>,
    pub(crate) sources: &'a SourceMap,
    pub(crate) diagnostics: &'a mut Vec<Diagnostic>,
    pub(super) lets: Lets,
    /// The function calls lowered so far.
    pub(super) calls: HashMap<CallKey, Option<Value>>,
    /// The measures lowered so far.
    pub(super) measures: HashMap<usize, Option<Value>>,
    pub(super) switches: HashMap<NodeId, usize>,
    pub(super) functionals: HashMap<(FunctionalKind, NodeId), usize>,
    /// Whether all coordinates of the section are known.
    pub(super) whole_section: bool,
    depth: usize,
    full: bool,
}

/// A function, its arguments and the place of the call.
pub(super) type CallKey = (usize, Vec<Option<Value>>, Place);

/// Where an expression stands.
#[derive(Clone, Copy)]
pub(crate) struct Context<'c> {
    pub(crate) place: Place,
    /// The call whose function body this is.
    pub(super) frame: Option<&'c Frame<'c>>,
}

/// The arguments of a call.
pub(super) struct Frame<'c> {
    pub(super) function: &'c str,
    pub(super) names: &'c [Text],
    pub(super) values: &'c [Option<Value>],
    pub(super) call: Span,
}

impl<'c> Context<'c> {
    pub(crate) const fn of(place: Place) -> Self {
        Self { place, frame: None }
    }

    pub(super) const fn with_place(self, place: Place) -> Self {
        Self { place, ..self }
    }
}

/// The dimension that an equation must have, and how to speak of it.
pub(crate) struct Expected {
    /// `None` where it is not known, since a definition is broken.
    pub(crate) dimension: Option<Dimension>,
    /// What has to have it, e.g. "the flow of `x`".
    pub(crate) what: String,
    /// Why.
    pub(crate) help: String,
}

impl<'a> Lowering<'a> {
    pub(crate) fn new(
        model: &'a mut Model,
        scope: &'a Scope,
        definitions: &'a Definitions<'a>,
        sources: &'a SourceMap,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        Self {
            model,
            scope,
            definitions,
            sources,
            diagnostics,
            lets: HashMap::new(),
            calls: HashMap::new(),
            measures: HashMap::new(),
            switches: HashMap::new(),
            functionals: HashMap::new(),
            whole_section: true,
            depth: 0,
            full: false,
        }
    }

    /// With names of `[let]` that have been lowered before, into the same graph.
    pub(crate) fn with_lets(&mut self, lets: Lets) -> &mut Self {
        self.lets = lets;
        self
    }

    /// Lowers an equation of the spec.
    pub(crate) fn equation(&mut self, equation: &Equation, place: Place) -> Option<Value> {
        let expression = equation.expression.as_ref()?;
        self.lower_lets(&expression.names, place);
        self.expr(&expression.root, Context::of(place))
    }

    /// Lowers an equation and checks its dimension.
    pub(crate) fn checked(&mut self, equation: &Equation, place: Place, expected: &Expected) -> Option<Value> {
        let value = self.equation(equation, place)?;
        let (Some(wanted), Some(got)) = (expected.dimension, value.dimension) else {
            return Some(value);
        };
        if wanted != got {
            let message = format!("{} must be {}, not {}", expected.what, dimension_text(wanted), dimension_text(got));
            let span = self.root_span(equation);
            let label = format!("{} is {}", self.quote(span), dimension_text(got));
            self.diagnostics
                .push(Diagnostic::error(Code::EquationDimension, message).at(span, label).help(&*expected.help));
            return None;
        }
        Some(value)
    }

    pub(crate) fn root_span(&self, equation: &Equation) -> Span {
        equation.expression.as_ref().map_or(equation.text.span, |expression| expression.root.span)
    }

    /// Enters one level of nesting; `false` (and a message) where that is too deep or the model too large.
    pub(super) fn enter(&mut self, span: Span, context: Context<'_>) -> bool {
        let deep = self.depth >= DEPTH_LIMIT;
        if deep || self.model.graph.nodes().len() > NODE_LIMIT {
            // After the first message every other expression of a model that is too large would say the same.
            if !self.full {
                let message =
                    if deep { "functions call each other too deeply here" } else { "this model is too large" };
                let error = Diagnostic::error(Code::TooComplex, message).at(span, "");
                let help = format!("at most {DEPTH_LIMIT} levels and {NODE_LIMIT} operations are possible");
                self.report(error.help(help), context);
                self.full = true;
            }
            return false;
        }
        self.depth += 1;
        true
    }

    pub(super) fn leave(&mut self) {
        self.depth -= 1;
    }

    /// Reports a problem; inside a function's body also where the function is called.
    pub(super) fn report(&mut self, diagnostic: Diagnostic, context: Context<'_>) {
        self.diagnostics.push(match context.frame {
            Some(frame) => diagnostic.see(frame.call, format!("in this call of `{}`", frame.function)),
            None => diagnostic,
        });
    }

    /// The characters of a span in backticks, "this" if they are many.
    pub(super) fn quote(&self, span: Span) -> String {
        let text = self.sources.slice(span);
        if text.is_empty() || text.contains('\n') || text != shortened(text) {
            "this".to_owned()
        } else {
            format!("`{text}`")
        }
    }
}
