//! Optimisation problems: objectives, parameters to vary, and constraints.

use super::expr::Operand;
use super::lowering::{Context, Lowering};
use super::value::{Place, Uses, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::quantity::Quantities;
use crate::front::spec::{Equation, Interval, Named, Problem, Spec};
use crate::front::syntax::{Comparison, Expr, ExprKind};
use crate::ir::{self, Binary, Node, NodeId, Symbol};

impl Lowering<'_> {
    /// Lowers `[problems]`.
    pub(super) fn problems(&mut self, spec: &Spec) {
        let mut default = None;
        for item in &spec.problems {
            if let Some(span) = item.value.default {
                if let Some(first) = default {
                    let error = Diagnostic::error(Code::GivenTwice, "two problems are the default").at(span, "");
                    self.diagnostics.push(error.see(first, "first one").help("keep one `default = true`"));
                }
                default = default.or(Some(span));
            }
            let problem = self.problem(item);
            self.model.problems.extend(problem);
        }
    }

    fn problem(&mut self, item: &Named<Problem>) -> Option<ir::Problem> {
        let Problem { doc, default, objective, vary, robust, subject_to, period } = &item.value;
        let lowered = objective.as_ref().and_then(|(sense, equation)| {
            let lowered = self.objective(equation)?;
            (*sense == ir::Sense::Minimize || self.can_grow(equation, lowered.0)).then_some(lowered)
        });
        let varied: Vec<Option<ir::Vary>> = vary.iter().map(|item| self.vary(item)).collect();
        let uncertain: Vec<Option<ir::Uncertain>> = robust.iter().map(|item| self.uncertain(item, vary)).collect();
        let constraints: Vec<Option<ir::Constraint>> = subject_to.iter().map(|item| self.constraint(item)).collect();
        let ((sense, equation), (objective, objective_dimension)) = objective.as_ref().zip(lowered)?;
        let problem = ir::Problem {
            name: item.name.clone(),
            default: default.is_some(),
            doc: doc.clone(),
            sense: *sense,
            objective,
            objective_text: equation.text.value.trim().to_owned(),
            objective_dimension,
            vary: varied.into_iter().collect::<Option<_>>()?,
            robust: uncertain.into_iter().collect::<Option<_>>()?,
            constraints: constraints.into_iter().collect::<Option<_>>()?,
            period: *period,
        };
        self.same_bounds(&problem, subject_to);
        Some(problem)
    }

    /// An objective: exactly `spectral_radius`, or an expression over measures and parameters.
    pub(crate) fn objective(&mut self, equation: &Equation) -> Option<(NodeId, Dimension)> {
        let value = self.equation(equation, Place::Problem)?;
        if value.uses.any(Uses::RADIUS) && !self.is_radius(value) {
            let message = "`spectral_radius` can be an objective, but not a part of one";
            let error = Diagnostic::error(Code::ProblemForm, message).at(self.root_span(equation), "");
            let help = "it is not smooth; optimise a measure and bound `spectral_radius` in `subject_to`";
            self.diagnostics.push(error.help(help));
            return None;
        }
        Some((value.node, value.dimension.unwrap_or(Dimension::NONE)))
    }

    fn vary(&mut self, item: &Named<Interval>) -> Option<ir::Vary> {
        let (parameter, lower, upper) = self.range(item)?;
        Some(ir::Vary { parameter, lower, upper })
    }

    /// An uncertain parameter, which must not be one of those that vary.
    fn uncertain(&mut self, item: &Named<Interval>, vary: &[Named<Interval>]) -> Option<ir::Uncertain> {
        let range = self.range(item);
        if let Some(varied) = vary.iter().find(|varied| varied.name == item.name) {
            let message = format!("`{}` is both varied and uncertain", item.name);
            let error = Diagnostic::error(Code::ProblemForm, message).at(item.span, "").see(varied.span, "varied here");
            self.diagnostics
                .push(error.help("a designer chooses it, or does not know it: leave it out of one of the two"));
            return None;
        }
        let (parameter, lower, upper) = range?;
        Some(ir::Uncertain { parameter, lower, upper })
    }

    /// Refuses bounds on the spectral radius that are not the same for all machines of a robust problem.
    fn same_bounds(&mut self, problem: &ir::Problem, subject_to: &[Equation]) {
        if problem.robust.is_empty() {
            return;
        }
        let mut ranges = problem.vary.iter().map(|v| (v.parameter, v.lower, v.upper)).collect::<Vec<_>>();
        ranges.extend(problem.robust.iter().map(|u| (u.parameter, u.lower, u.upper)));
        let moves = |symbol: Symbol| {
            let of = |i: usize| ranges.iter().any(|(parameter, lower, upper)| *parameter == i && lower < upper);
            matches!(symbol, Symbol::Parameter(i) if of(i))
        };
        for (constraint, equation) in problem.constraints.iter().zip(subject_to) {
            if constraint.stability_bound.is_some_and(|bound| self.model.graph.depends(&[bound], moves)) {
                let message =
                    "in a robust problem the bound on `spectral_radius` is the same for all machines and designs";
                let error = Diagnostic::error(Code::ProblemForm, message).at(self.root_span(equation), "");
                self.diagnostics.push(error.help("bound it by a number, as in `spectral_radius <= 0.95`"));
            }
        }
    }

    /// A parameter and a range for it, SI units.
    fn range(&mut self, item: &Named<Interval>) -> Option<(usize, f64, f64)> {
        let model = &self.model;
        let names: Vec<String> = model.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let parameter = self.reference("parameter", &item.name, item.span, &names)?;
        let dimension = self.scope.get(&item.name).and_then(|definition| definition.dimension);
        let mut quantities = Quantities { sources: self.sources, diagnostics: self.diagnostics };
        let Some(dimension) = dimension else {
            // The parameter is broken; the bounds are read for their messages.
            quantities.any(&item.value.lower);
            quantities.any(&item.value.upper);
            return None;
        };
        let (lower, upper) = quantities.interval(&item.value, dimension, &format!("`{}`", item.name))?;
        Some((parameter, lower, upper))
    }

    /// A constraint, `lhs <= rhs` or `lhs >= rhs`.
    pub(crate) fn constraint(&mut self, equation: &Equation) -> Option<ir::Constraint> {
        let expression = equation.expression.as_ref()?;
        let root = &expression.root;
        let ExprKind::Compare(comparison, a, b) = &root.kind else {
            let error = Diagnostic::error(Code::ConstraintForm, "a constraint compares two numbers").at(root.span, "");
            let help = "write it as `lhs <= rhs` or `lhs >= rhs`, one constraint a string";
            self.diagnostics.push(error.help(help));
            return None;
        };
        if matches!(comparison, Comparison::Less | Comparison::Greater) {
            let message =
                format!("a constraint cannot be strict: an optimum on `{0}` may not exist", comparison.symbol());
            let error = Diagnostic::error(Code::ConstraintForm, message).at(root.span, "");
            self.diagnostics.push(error.help(format!("write `{}=`", comparison.symbol())));
            return None;
        }
        self.lower_lets(&expression.names, Place::Problem);
        self.sides(*comparison, a, b, equation)
    }

    fn sides(&mut self, comparison: Comparison, a: &Expr, b: &Expr, equation: &Equation) -> Option<ir::Constraint> {
        let context = Context::of(Place::Problem);
        let (left, right) = (self.expr(a, context), self.expr(b, context));
        let (a, b) = (Operand { value: left?, span: a.span }, Operand { value: right?, span: b.span });
        let dimension = self.same(a, b, &format!("`{}`", comparison.symbol()), context)?;
        let (small, large) = if comparison.is_less() { (a.value, b.value) } else { (b.value, a.value) };
        let uses = small.uses.and(large.uses);
        let bound = self.is_radius(small) && large.uses.only(Uses::PARAMETER);
        if uses.any(Uses::RADIUS) && !bound {
            let message = "this is no bound on `spectral_radius` that can be imposed";
            let error = Diagnostic::error(Code::ConstraintForm, message).at(self.root_span(equation), "");
            self.diagnostics.push(error.help("write `spectral_radius <= r` with a number or parameters for r"));
            return None;
        }
        Some(ir::Constraint {
            margin: self.binary(Binary::Sub, large.node, small.node),
            stability_bound: bound.then_some(large.node),
            text: equation.text.value.trim().to_owned(),
            dimension: dimension.unwrap_or(Dimension::NONE),
            unit: equation.expression.as_ref().and_then(|expression| expression.unit.as_deref().map(str::to_owned)),
        })
    }

    /// Whether an objective can be maximised; reports the one that cannot.
    fn can_grow(&mut self, equation: &Equation, objective: NodeId) -> bool {
        if self.model.graph.node(objective) != Node::Symbol(Symbol::SpectralRadius) {
            return true;
        }
        let error = Diagnostic::error(Code::ProblemForm, "`spectral_radius` can only be minimised");
        let help = "write `minimize = \"spectral_radius\"`";
        self.diagnostics.push(error.at(self.root_span(equation), "").help(help));
        false
    }

    fn is_radius(&self, value: Value) -> bool {
        self.model.graph.node(value.node) == Node::Symbol(Symbol::SpectralRadius)
    }
}
