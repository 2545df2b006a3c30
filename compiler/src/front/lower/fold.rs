//! Nodes with the simplifications that are exact and obvious: arithmetic of literals, `x*1`, `x + 0` and the like.
//! Nothing else, so that an equation stays recognisable in what is generated from it. Functions of literals are not
//! folded: their last digit depends on the machine, and a compiled model must not.

use crate::ir::Node;
use crate::ir::{Binary, Graph, NodeId, Unary};

/// Largest whole exponent for which a power of literals is multiplied out.
const POWER_LIMIT: f64 = 64.0;

pub(crate) fn neg(graph: &mut Graph, a: NodeId) -> NodeId {
    if let Some(value) = graph.constant_value(a) {
        return graph.constant(-value);
    }
    match graph.node(a) {
        Node::Unary(Unary::Neg, inner) => inner,
        _ => graph.unary(Unary::Neg, a),
    }
}

/// The node of `a op b`.
pub(crate) fn binary(graph: &mut Graph, op: Binary, a: NodeId, b: NodeId) -> NodeId {
    let (left, right) = (graph.constant_value(a), graph.constant_value(b));
    if let (Some(left), Some(right)) = (left, right)
        && let Some(value) = literal(op, left, right)
    {
        return graph.constant(value);
    }
    match (op, left, right) {
        (Binary::Add | Binary::Sub, _, Some(0.0)) | (Binary::Mul | Binary::Div | Binary::Pow, _, Some(1.0)) => a,
        (Binary::Add, Some(0.0), _) | (Binary::Mul, Some(1.0), _) => b,
        (Binary::Sub, Some(0.0), _) => neg(graph, b),
        _ => graph.binary(op, a, b),
    }
}

/// What the operation gives for two literals, if every machine gives the same.
fn literal(op: Binary, a: f64, b: f64) -> Option<f64> {
    match op {
        Binary::Add => Some(a + b),
        Binary::Sub => Some(a - b),
        Binary::Mul => Some(a * b),
        Binary::Div => Some(a / b),
        Binary::Pow if b.fract() == 0.0 && b.abs() <= POWER_LIMIT => {
            let product = (0..b.abs() as u32).fold(1.0, |product, _| product * a);
            Some(if b < 0.0 { 1.0 / product } else { product })
        }
        Binary::Pow | Binary::Atan2 => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::Symbol;

    #[test]
    fn literals_fold_and_neutral_elements_vanish() {
        let mut graph = Graph::default();
        let x = graph.symbol(Symbol::State(0));
        let [zero, one, two, three] = [0.0, 1.0, 2.0, 3.0].map(|value| graph.constant(value));
        assert_eq!(binary(&mut graph, Binary::Add, x, zero), x);
        assert_eq!(binary(&mut graph, Binary::Add, zero, x), x);
        assert_eq!(binary(&mut graph, Binary::Sub, x, zero), x);
        assert_eq!(binary(&mut graph, Binary::Mul, one, x), x);
        assert_eq!(binary(&mut graph, Binary::Div, x, one), x);
        assert_eq!(binary(&mut graph, Binary::Pow, x, one), x);
        let eight = binary(&mut graph, Binary::Pow, two, three);
        assert_eq!(graph.constant_value(eight), Some(8.0));
        let minus = neg(&mut graph, x);
        assert_eq!(binary(&mut graph, Binary::Sub, zero, x), minus);
        assert_eq!(neg(&mut graph, minus), x);
    }

    #[test]
    fn equations_stay_recognisable() {
        let mut graph = Graph::default();
        let x = graph.symbol(Symbol::State(0));
        let [zero, two] = [0.0, 2.0].map(|value| graph.constant(value));
        let square = binary(&mut graph, Binary::Pow, x, two);
        assert_eq!(graph.node(square), Node::Binary(Binary::Pow, x, two));
        // 0*x is not 0 where x is not a number.
        let product = binary(&mut graph, Binary::Mul, zero, x);
        assert_eq!(graph.node(product), Node::Binary(Binary::Mul, zero, x));
    }
}
