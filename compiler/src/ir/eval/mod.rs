//! Evaluates the expression graph directly, values and derivatives of any order, with nilpotent numbers.
//!
//! This is the independent route against which generated code is checked (`gaitc verify`), and what evaluates the
//! objectives and constraints of optimisation problems, which are data. It shares nothing with CasADi or the emitter.

mod nilpotent;
pub(crate) mod real;
mod tape;

use super::{Binary, Graph, Node, NodeId, Symbol, Unary};
use nilpotent::Nilpotent;
use std::collections::HashMap;
pub use tape::Tape;

/// Values of all symbols, SI units. Symbols outside the slices are NaN.
#[derive(Clone, Copy, Debug, Default)]
pub struct Environment<'a> {
    /// States.
    pub states: &'a [f64],
    /// Their rates.
    pub rates: &'a [f64],
    /// Parameters.
    pub parameters: &'a [f64],
    /// Memory.
    pub memory: &'a [f64],
    /// Functionals.
    pub functionals: &'a [f64],
    /// Measures.
    pub measures: &'a [f64],
    /// Frozen branch selectors; a missing one is false.
    pub branch: &'a [bool],
    /// Time since the last transition.
    pub tau: f64,
    /// Time since the start of the run.
    pub time: f64,
    /// Spectral radius.
    pub spectral_radius: f64,
}

impl Environment<'_> {
    fn value(&self, symbol: Symbol) -> f64 {
        let from = |slice: &[f64], i: usize| slice.get(i).copied().unwrap_or(f64::NAN);
        match symbol {
            Symbol::State(i) => from(self.states, i),
            Symbol::Rate(i) => from(self.rates, i),
            Symbol::Parameter(i) => from(self.parameters, i),
            Symbol::Memory(i) => from(self.memory, i),
            Symbol::Functional(i) => from(self.functionals, i),
            Symbol::Measure(i) => from(self.measures, i),
            Symbol::Tau => self.tau,
            Symbol::Time => self.time,
            Symbol::SpectralRadius => self.spectral_radius,
        }
    }

    fn selected(&self, switch: usize) -> bool {
        self.branch.get(switch).copied().unwrap_or(false)
    }
}

/// Derivatives nested deeper than this evaluate to NaN: the work doubles with each level.
const DEEPEST: usize = 12;

/// Value of an expression.
pub fn value(graph: &Graph, root: NodeId, at: &Environment<'_>) -> f64 {
    evaluate(graph, root, at, &[]).value()
}

/// Partial derivative of an expression with respect to one symbol, all others held.
pub fn derivative(graph: &Graph, root: NodeId, at: &Environment<'_>, with_respect_to: Symbol) -> f64 {
    evaluate(graph, root, at, &[with_respect_to]).coefficient(0).value()
}

/// Evaluates with generator number i added to symbol `perturbed[i]`.
fn evaluate(graph: &Graph, root: NodeId, at: &Environment<'_>, perturbed: &[Symbol]) -> Nilpotent {
    let mut values: HashMap<NodeId, Nilpotent> = HashMap::new();
    graph.visit(&[root], |id, node| {
        let value = evaluate_node(graph, node, at, perturbed, &values);
        values.insert(id, value);
    });
    values.remove(&root).unwrap_or_else(|| Nilpotent::real(f64::NAN))
}

fn evaluate_node(
    graph: &Graph,
    node: Node,
    at: &Environment<'_>,
    perturbed: &[Symbol],
    values: &HashMap<NodeId, Nilpotent>,
) -> Nilpotent {
    let of = |id: NodeId| values.get(&id).cloned().unwrap_or_else(|| Nilpotent::real(f64::NAN));
    match node {
        Node::Constant(bits) => Nilpotent::real(f64::from_bits(bits)),
        Node::Symbol(symbol) => perturbed
            .iter()
            .enumerate()
            .filter(|(_, p)| **p == symbol)
            .fold(Nilpotent::real(at.value(symbol)), |value, (i, _)| value.perturbed(i)),
        Node::Unary(op, a) => unary(op, &of(a)),
        Node::Binary(op, a, b) => binary(op, &of(a), &of(b)),
        Node::Select { switch, then, otherwise } => of(if at.selected(switch) { then } else { otherwise }),
        Node::Choose { margin, then, otherwise } => of(if of(margin).value() >= 0.0 { then } else { otherwise }),
        Node::Partial(expr, symbol) if perturbed.len() < DEEPEST => {
            let more = [perturbed, &[symbol]].concat();
            evaluate(graph, expr, at, &more).coefficient(perturbed.len())
        }
        Node::Partial(..) => Nilpotent::real(f64::NAN),
    }
}

fn unary(op: Unary, a: &Nilpotent) -> Nilpotent {
    let inverse = |u: Nilpotent| Nilpotent::real(1.0).div(&u);
    match op {
        Unary::Neg => a.scale(-1.0),
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.map(f64::tan, |u| Nilpotent::real(1.0).div(&u.cos().mul(&u.cos()))),
        Unary::Asin => a.map(f64::asin, |u| inverse(u.one_plus_square(-1.0).sqrt())),
        Unary::Acos => a.map(f64::acos, |u| inverse(u.one_plus_square(-1.0).sqrt()).scale(-1.0)),
        Unary::Atan => a.map(f64::atan, |u| inverse(u.one_plus_square(1.0))),
        Unary::Sinh => a.sinh(),
        Unary::Cosh => a.cosh(),
        Unary::Tanh => a.map(f64::tanh, |u| inverse(u.cosh().mul(&u.cosh()))),
        Unary::Asinh => a.map(f64::asinh, |u| inverse(u.one_plus_square(1.0).sqrt())),
        Unary::Acosh => a.map(f64::acosh, |u| inverse(u.one_plus_square(-1.0).scale(-1.0).sqrt())),
        Unary::Atanh => a.map(f64::atanh, |u| inverse(u.one_plus_square(-1.0))),
        Unary::Exp => a.exp(),
        Unary::Log => a.log(),
        Unary::Sqrt => a.sqrt(),
    }
}

fn binary(op: Binary, a: &Nilpotent, b: &Nilpotent) -> Nilpotent {
    match op {
        Binary::Add => a.add(b),
        Binary::Sub => a.add(&b.scale(-1.0)),
        Binary::Mul => a.mul(b),
        Binary::Div => a.div(b),
        Binary::Pow => a.pow(b),
        Binary::Atan2 => a.atan2(b),
    }
}

#[cfg(test)]
mod tests {
    use super::{Environment, derivative, value};
    use crate::ir::{Binary, Graph, Node, Symbol, Unary};
    use approx::assert_relative_eq;

    /// r(tau) = 1/2 (1 + cos(omega tau)): its second time derivative, differentiated in omega by hand.
    #[test]
    fn partials_nest_and_can_be_differentiated() {
        let mut g = Graph::default();
        let (omega, tau) = (g.symbol(Symbol::Parameter(0)), g.symbol(Symbol::Tau));
        let phase = g.binary(Binary::Mul, omega, tau);
        let cos = g.unary(Unary::Cos, phase);
        let half = g.constant(0.5);
        let r = g.binary(Binary::Mul, half, cos);
        let v = g.add(Node::Partial(r, Symbol::Tau));
        let a = g.add(Node::Partial(v, Symbol::Tau));
        let (w, t) = (3.0_f64, 0.4_f64);
        let at = Environment { parameters: &[w], tau: t, ..Environment::default() };
        assert_relative_eq!(value(&g, a, &at), -0.5 * w * w * (w * t).cos(), max_relative = 1e-15);
        let by_hand = -w * (w * t).cos() + 0.5 * w * w * t * (w * t).sin();
        assert_relative_eq!(derivative(&g, a, &at, Symbol::Parameter(0)), by_hand, max_relative = 1e-14);
    }

    #[test]
    fn the_branch_not_taken_does_not_reach_the_derivative() {
        let mut g = Graph::default();
        let x = g.symbol(Symbol::State(0));
        let (root, zero) = (g.unary(Unary::Sqrt, x), g.constant(0.0));
        let guarded = g.add(Node::Select { switch: 0, then: root, otherwise: zero });
        let at = Environment { states: &[-1.0], branch: &[false], ..Environment::default() };
        assert_eq!(derivative(&g, guarded, &at, Symbol::State(0)), 0.0);
        let at = Environment { states: &[4.0], branch: &[true], ..Environment::default() };
        assert_eq!(derivative(&g, guarded, &at, Symbol::State(0)), 0.25);
    }
}
