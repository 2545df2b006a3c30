//! The value of an expression without variables.

use crate::ir::eval::real::{binary, unary};
use crate::ir::{Graph, Node, NodeId};

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
