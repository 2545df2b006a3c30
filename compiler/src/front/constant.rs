//! The value of an expression without variables.

use crate::ir::{Binary, Graph, Node, NodeId, Unary};

/// Evaluates a node; `None` if it depends on a variable.
pub(crate) fn evaluate(graph: &Graph, root: NodeId) -> Option<f64> {
    let mut values: Vec<Option<f64>> = vec![None; graph.nodes().len()];
    graph.visit(&[root], |id, node| {
        let of = |id: NodeId| values.get(id.0 as usize).copied().flatten();
        let value = match node {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            Node::Unary(op, a) => of(a).map(|a| unary(op, a)),
            Node::Binary(op, a, b) => of(a).zip(of(b)).map(|(a, b)| binary(op, a, b)),
            Node::Choose { margin, then, otherwise } => {
                of(margin).and_then(|m| if m >= 0.0 { of(then) } else { of(otherwise) })
            }
            Node::Symbol(_) | Node::Select { .. } | Node::Partial(..) => None,
        };
        if let Some(slot) = values.get_mut(id.0 as usize) {
            *slot = value;
        }
    });
    values.get(root.0 as usize).copied().flatten()
}

/// The value of a function of one argument.
pub(crate) fn unary(op: Unary, a: f64) -> f64 {
    match op {
        Unary::Neg => -a,
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Asin => a.asin(),
        Unary::Acos => a.acos(),
        Unary::Atan => a.atan(),
        Unary::Sinh => a.sinh(),
        Unary::Cosh => a.cosh(),
        Unary::Tanh => a.tanh(),
        Unary::Asinh => a.asinh(),
        Unary::Acosh => a.acosh(),
        Unary::Atanh => a.atanh(),
        Unary::Exp => a.exp(),
        Unary::Log => a.ln(),
        Unary::Sqrt => a.sqrt(),
    }
}

fn binary(op: Binary, a: f64, b: f64) -> f64 {
    match op {
        Binary::Add => a + b,
        Binary::Sub => a - b,
        Binary::Mul => a * b,
        Binary::Div => a / b,
        Binary::Pow => a.powf(b),
        Binary::Atan2 => a.atan2(b),
    }
}
