//! The independent route: which expressions of the spec a generated function stands for, evaluated with nilpotent
//! numbers.

use gaitc_compiler::ir::eval::{Environment, derivative, value};
use gaitc_compiler::ir::{Model, NodeId, Symbol};
use gaitc_runtime::model::{Functional, ModelInfo};
use gaitc_runtime::probe::{Function, Point, Variable};

/// A spec as reference for the functions that were generated from it.
pub struct Reference<'a> {
    info: &'a ModelInfo,
    spec: &'a Model,
}

impl<'a> Reference<'a> {
    /// The functions of `info`, by the expressions of `spec`, which it was compiled from.
    pub fn new(info: &'a ModelInfo, spec: &'a Model) -> Self {
        Self { info, spec }
    }

    /// How people call the function.
    pub fn name(&self, function: Function) -> String {
        let mode = |i: usize| self.info.modes.get(i).map_or("?", |m| m.name);
        let transition = |i: usize| self.info.transitions.get(i).map_or("?", |t| t.name);
        match function {
            Function::Flow(i) => format!("flow of {}", mode(i)),
            Function::Variational(i) => format!("variational flow of {}", mode(i)),
            Function::Staged(i) => format!("variational flow of {} from terms of the clock", mode(i)),
            Function::Integrated(i) => format!("flow and integrands of {}", mode(i)),
            Function::Residual(i) => format!("residual of {}", mode(i)),
            Function::Linearised(i) => format!("linearised residual of {}", mode(i)),
            Function::Integrands(i) => format!("integrands of {}", mode(i)),
            Function::Switch(i) => format!("switch `{}`", self.info.switches.get(i).unwrap_or(&"?")),
            Function::Guard(i) => format!("guard of {}", transition(i)),
            Function::Reset(i) => format!("reset of {}", transition(i)),
            Function::Memory(i) => format!("memory after {}", transition(i)),
            Function::When(i) => format!("when of {}", transition(i)),
            Function::Embed => "section embed".to_owned(),
            Function::Symmetry => "section symmetry".to_owned(),
            Function::Observable { index, mode: m } => format!("observable {index} in {}", mode(m)),
            Function::Measures => "measures".to_owned(),
        }
    }

    /// The expressions whose values the function returns (for residuals: f).
    fn roots(&self, function: Function) -> Vec<NodeId> {
        let flow = |i: usize| self.spec.modes.get(i).map_or_else(Vec::new, |m| m.flow.clone());
        let section = self.spec.section.as_ref();
        match function {
            Function::Flow(i) | Function::Variational(i) | Function::Staged(i) => flow(i),
            Function::Residual(i) | Function::Linearised(i) => flow(i),
            Function::Integrands(_) => self.integrands(),
            Function::Integrated(i) => [flow(i), self.integrands()].concat(),
            Function::Switch(i) => self.spec.switches.get(i).map(|s| s.expr).into_iter().collect(),
            Function::Guard(i) => self.spec.transitions.get(i).map(|t| t.guard).into_iter().collect(),
            Function::Reset(i) => self.spec.transitions.get(i).map_or_else(Vec::new, |t| t.reset.clone()),
            Function::Memory(i) => self.spec.transitions.get(i).map_or_else(Vec::new, |t| t.memory_reset.clone()),
            Function::When(i) => self.spec.transitions.get(i).and_then(|t| t.when).into_iter().collect(),
            Function::Embed => section.map_or_else(Vec::new, |s| s.embed.clone()),
            Function::Symmetry => section.and_then(|s| s.symmetry.clone()).unwrap_or_default(),
            Function::Observable { index, .. } => self.functional(|f| observable(f) == Some(index)),
            Function::Measures => self.spec.measures.iter().map(|m| m.expr).collect(),
        }
    }

    /// What stands in for the rates in a function that does not take them: the flow of its mode.
    fn rates(&self, function: Function) -> &[NodeId] {
        let explicit = |mode: usize| self.spec.modes.get(mode).filter(|m| m.mass.is_none()).map(|m| m.flow.as_slice());
        let before = |i: usize| self.spec.transitions.get(i).and_then(|t| explicit(t.from));
        let flow = match function {
            Function::Integrated(mode) => explicit(mode),
            Function::Integrands(mode) | Function::Observable { mode, .. } if self.info.explicit => explicit(mode),
            Function::Guard(i) | Function::When(i) | Function::Reset(i) | Function::Memory(i) => before(i),
            _ => None,
        };
        flow.unwrap_or(&[])
    }

    fn functional(&self, wanted: impl Fn(Functional) -> bool) -> Vec<NodeId> {
        let pairs = self.info.functionals.iter().zip(&self.spec.functionals);
        pairs.filter(|(f, _)| wanted(**f)).map(|(_, f)| f.expr).take(1).collect()
    }

    fn integrands(&self) -> Vec<NodeId> {
        let integral = |f: &Functional| match *f {
            Functional::Integral(i) | Functional::Mean(i) => Some(i + 1),
            _ => None,
        };
        let count = self.info.functionals.iter().filter_map(integral).max().unwrap_or(0);
        (0..count).flat_map(|i| self.functional(|f| integral(&f) == Some(i + 1))).collect()
    }

    /// The function's value.
    pub fn value(&self, function: Function, at: &Point<'_>) -> Vec<f64> {
        let at = environment(at);
        let flow: Vec<f64> = self.rates(function).iter().map(|&f| value(&self.spec.graph, f, &at)).collect();
        let at = if flow.is_empty() { at } else { Environment { rates: &flow, ..at } };
        let values: Vec<f64> = self.roots(function).iter().map(|&root| value(&self.spec.graph, root, &at)).collect();
        match function {
            // Without `when` a transition is always enabled.
            Function::When(_) if values.is_empty() => vec![1.0],
            Function::Residual(mode) | Function::Linearised(mode) => {
                self.residual(mode, &at, values, &|node| value(&self.spec.graph, node, &at))
            }
            _ => values,
        }
    }

    /// The function's derivative, columns one after the other.
    pub fn derivative(&self, function: Function, variable: Variable, at: &Point<'_>) -> Vec<f64> {
        let (at, rates) = (environment(at), self.rates(function));
        let flow: Vec<f64> = rates.iter().map(|&f| value(&self.spec.graph, f, &at)).collect();
        let at = if flow.is_empty() { at } else { Environment { rates: &flow, ..at } };
        let column = |symbol: Symbol| {
            let of = |node: NodeId| derivative(&self.spec.graph, node, &at, symbol);
            let through_rates = |node: NodeId| -> f64 {
                let by_rate = |j: usize| derivative(&self.spec.graph, node, &at, Symbol::Rate(j));
                rates.iter().enumerate().map(|(j, &f)| product(by_rate(j), of(f))).sum()
            };
            let whole = |&root: &NodeId| match symbol {
                Symbol::Rate(_) if !rates.is_empty() => 0.0,
                _ => of(root) + through_rates(root),
            };
            let values = self.roots(function).iter().map(whole).collect();
            match function {
                Function::Residual(mode) | Function::Linearised(mode) => {
                    self.residual_slope(mode, symbol, &at, values, &of)
                }
                _ => values,
            }
        };
        self.symbols(variable).into_iter().flat_map(column).collect()
    }

    fn symbols(&self, variable: Variable) -> Vec<Symbol> {
        let states = self.spec.states.len();
        match variable {
            Variable::State => (0..states).map(Symbol::State).collect(),
            Variable::Coordinate => self.info.coordinates.iter().map(|&i| Symbol::State(i)).collect(),
            Variable::Functional => (0..self.spec.functionals.len()).map(Symbol::Functional).collect(),
            Variable::Rate => (0..states).map(Symbol::Rate).collect(),
            Variable::Parameter => (0..self.spec.parameters.len()).map(Symbol::Parameter).collect(),
            Variable::Tau => vec![Symbol::Tau],
            Variable::Time => vec![Symbol::Time],
        }
    }

    /// M k - f, with `mass` giving the value (or derivative) of an entry of M.
    fn residual(&self, mode: usize, at: &Environment<'_>, f: Vec<f64>, mass: &dyn Fn(NodeId) -> f64) -> Vec<f64> {
        let rows = self.spec.modes.get(mode).and_then(|m| m.mass.as_ref());
        let product = |i: usize| match rows {
            None => at.rates.get(i).copied().unwrap_or(f64::NAN),
            Some(rows) => rows[i].iter().zip(at.rates).map(|(&entry, k)| mass(entry) * k).sum(),
        };
        f.into_iter().enumerate().map(|(i, f)| product(i) - f).collect()
    }

    /// Derivative of M k - f: (dM) k + M dk - df.
    fn residual_slope(
        &self,
        mode: usize,
        symbol: Symbol,
        at: &Environment<'_>,
        df: Vec<f64>,
        of: &dyn Fn(NodeId) -> f64,
    ) -> Vec<f64> {
        let rows = self.spec.modes.get(mode).and_then(|m| m.mass.as_ref());
        let slope = |i: usize| {
            let moved = |j: usize| f64::from(u8::from(symbol == Symbol::Rate(j)));
            match rows {
                None => moved(i),
                Some(rows) => (rows[i].iter().zip(at.rates).enumerate())
                    .map(|(j, (&entry, k))| of(entry) * k + value(&self.spec.graph, entry, at) * moved(j))
                    .sum(),
            }
        };
        df.into_iter().enumerate().map(|(i, df)| slope(i) - df).collect()
    }
}

/// A product in which nothing comes of what does not occur, be it infinite.
fn product(factor: f64, other: f64) -> f64 {
    if factor == 0.0 { 0.0 } else { factor * other }
}

fn observable(functional: Functional) -> Option<usize> {
    match functional {
        Functional::Start(i) | Functional::End(i) | Functional::Maximum(i) | Functional::Minimum(i) => Some(i),
        Functional::Integral(_) | Functional::Mean(_) | Functional::Duration => None,
    }
}

fn environment<'a>(at: &Point<'a>) -> Environment<'a> {
    Environment {
        states: at.x,
        rates: at.k,
        parameters: at.p,
        memory: at.memory,
        functionals: at.functionals,
        branch: at.branch,
        tau: at.tau,
        time: at.t,
        ..Environment::default()
    }
}
