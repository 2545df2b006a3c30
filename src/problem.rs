//! From a problem of a spec (expressions over measures and parameters) to a problem for the optimizer.

use crate::load::Loaded;
use gaitc_compiler::ir::eval::{Environment, derivative, value};
use gaitc_compiler::ir::{self, Graph, Node, NodeId, Symbol};
use gaitc_runtime::optimize::{
    Bound, Constraint, ConstraintKind, Expression, Objective, Problem, Sense, Settings, Uncertain, Value, Vary,
};
use std::sync::Arc;

/// Where an optimisation starts and how it searches.
#[derive(Clone, Debug)]
pub struct Start {
    /// All parameters in SI units; where one is varied, its first value.
    pub parameters: Vec<f64>,
    /// First guess of the section coordinates, SI units.
    pub section: Vec<f64>,
    /// How to search.
    pub settings: Settings,
}

/// The optimizer's problem for `problem`, whose expressions live in `spec` (the loaded spec, or a copy to which flags
/// have added expressions).
pub fn assemble<'a>(loaded: &'a Loaded, spec: &ir::Model, problem: &ir::Problem, start: Start) -> Problem<'a> {
    let graph = Arc::new(spec.graph.clone());
    let expression = |root: NodeId| GraphExpression::new(Arc::clone(&graph), root, spec);
    let objective = match graph.node(problem.objective) {
        Node::Symbol(Symbol::SpectralRadius) => Objective::SpectralRadius,
        _ => Objective::Expression(Box::new(expression(problem.objective))),
    };
    let constraint = |c: &ir::Constraint| {
        let kind = match c.stability_bound {
            Some(bound) => ConstraintKind::SpectralRadius {
                bound: match fixed(&graph, bound, problem, &start.parameters) {
                    Some(bound) => Bound::Constant(bound),
                    None => Bound::Expression(Box::new(expression(bound))),
                },
            },
            None => {
                let margin = expression(c.margin);
                let scale = margin.natural_scale(&start.parameters);
                ConstraintKind::Margin { margin: Box::new(margin), scale }
            }
        };
        Constraint { name: c.text.clone(), kind }
    };
    Problem {
        map: loaded.compiled,
        memory: loaded.memory(),
        period: problem.period,
        vary: problem.vary.iter().map(vary).collect(),
        sense: match problem.sense {
            ir::Sense::Maximize => Sense::Maximize,
            ir::Sense::Minimize => Sense::Minimize,
        },
        constraints: problem.constraints.iter().map(constraint).collect(),
        objective,
        parameters: start.parameters,
        start: start.section,
        settings: start.settings,
    }
}

/// What a problem is robust over, as [`gaitc_runtime::optimize::solve_robust`] takes it; empty for a problem without uncertainty.
pub fn uncertain(problem: &ir::Problem) -> Vec<Uncertain> {
    let one = |u: &ir::Uncertain| Uncertain { parameter: u.parameter, lower: u.lower, upper: u.upper };
    problem.robust.iter().map(one).collect()
}

/// The value of an expression in which nothing varies: neither measures nor the problem's parameters are in it, but for
/// those whose range is a point. SI units; `None` where something varies.
pub fn fixed(graph: &Graph, root: NodeId, problem: &ir::Problem, parameters: &[f64]) -> Option<f64> {
    let range = |i: usize| problem.vary.iter().find(|vary| vary.parameter == i);
    let varies = |symbol: Symbol| match symbol {
        Symbol::Parameter(i) => range(i).is_some_and(|vary| vary.lower < vary.upper),
        _ => true,
    };
    if graph.depends(&[root], varies) {
        return None;
    }
    let value_of = |(i, &value): (usize, &f64)| range(i).map_or(value, |vary| vary.lower);
    let parameters: Vec<f64> = parameters.iter().enumerate().map(value_of).collect();
    Some(value(graph, root, &Environment { parameters: &parameters, ..Environment::default() }))
}

fn vary(vary: &ir::Vary) -> Vary {
    Vary { parameter: vary.parameter, lower: vary.lower, upper: vary.upper }
}

/// An expression of the graph over measures and parameters.
struct GraphExpression {
    graph: Arc<Graph>,
    root: NodeId,
    /// The measures and parameters that it depends on: only these have a derivative to compute.
    symbols: Vec<Symbol>,
    measures: usize,
    parameters: usize,
}

impl GraphExpression {
    fn new(graph: Arc<Graph>, root: NodeId, spec: &ir::Model) -> Self {
        let mut symbols = Vec::new();
        graph.visit(&[root], |_, node| {
            if let Node::Symbol(symbol @ (Symbol::Measure(_) | Symbol::Parameter(_))) = node {
                symbols.push(symbol);
            }
        });
        Self { graph, root, symbols, measures: spec.measures.len(), parameters: spec.parameters.len() }
    }

    /// The size of a margin `bound - measure` where the measure vanishes: that of the bound. One where there is none.
    fn natural_scale(&self, parameters: &[f64]) -> f64 {
        let measures = vec![0.0; self.measures];
        let at = Environment { measures: &measures, parameters, ..Environment::default() };
        let scale = value(&self.graph, self.root, &at).abs();
        if scale.is_normal() { scale } else { 1.0 }
    }
}

impl Expression for GraphExpression {
    fn evaluate(&self, measures: &[f64], parameters: &[f64]) -> Value {
        let at = Environment { measures, parameters, ..Environment::default() };
        let mut result = Value {
            value: value(&self.graph, self.root, &at),
            dmeasures: vec![0.0; self.measures],
            dparameters: vec![0.0; self.parameters],
        };
        for &symbol in &self.symbols {
            let slope = derivative(&self.graph, self.root, &at, symbol);
            match symbol {
                Symbol::Measure(i) => result.dmeasures[i] = slope,
                Symbol::Parameter(i) => result.dparameters[i] = slope,
                _ => {}
            }
        }
        result
    }
}
