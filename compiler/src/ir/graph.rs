//! The expression graph: hash-consed nodes, so that equal expressions are one node.

use std::collections::HashMap;

/// Index of a node in its [`Graph`]. Operands always have smaller indices than the node that uses them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

/// A variable of the model. Indices point into the vectors of [`crate::ir::Model`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    /// A continuous state.
    State(usize),
    /// The time derivative of a state, supplied by the integrator.
    Rate(usize),
    /// A parameter.
    Parameter(usize),
    /// An integer memory.
    Memory(usize),
    /// Time since the last transition.
    Tau,
    /// Time since the start of the run.
    Time,
    /// Value of a functional (measures only).
    Functional(usize),
    /// Value of a measure (problems only).
    Measure(usize),
    /// Spectral radius of the return map's Jacobian (problems only).
    SpectralRadius,
}

/// Functions of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // the names say it
pub enum Unary {
    Neg,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Log,
    Sqrt,
}

/// Functions of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // the names say it
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
    Atan2,
}

/// A node of the expression graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A constant: the bits of an f64, so that nodes can be hashed.
    Constant(u64),
    /// A variable.
    Symbol(Symbol),
    /// A function of one argument.
    Unary(Unary, NodeId),
    /// A function of two arguments.
    Binary(Binary, NodeId, NodeId),
    /// Inside flows, guards, resets and functionals: chosen by the frozen selector of switch number `switch`.
    Select {
        /// Index into `Model::switches`.
        switch: usize,
        /// Where the selector is true.
        then: NodeId,
        /// Where it is false.
        otherwise: NodeId,
    },
    /// Where no integration runs (embed, symmetry, measures, `when`, problems): chosen by the sign of `margin` at once.
    Choose {
        /// `then` where `margin >= 0`.
        margin: NodeId,
        /// Where the margin is not negative.
        then: NodeId,
        /// Where it is negative.
        otherwise: NodeId,
    },
    /// Partial derivative with respect to a symbol, all other symbols held.
    Partial(NodeId, Symbol),
}

/// The graph. Nodes are only ever added.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    index: HashMap<Node, NodeId>,
}

impl Graph {
    /// The node's id; an equal node that is there already is shared.
    pub fn add(&mut self, node: Node) -> NodeId {
        if let Some(&id) = self.index.get(&node) {
            return id;
        }
        let id = NodeId(u32::try_from(self.nodes.len()).unwrap_or(u32::MAX));
        self.nodes.push(node);
        self.index.insert(node, id);
        id
    }

    /// A constant.
    pub fn constant(&mut self, value: f64) -> NodeId {
        // One zero: -0.0 and 0.0 would be two nodes of the same meaning.
        let value = if value == 0.0 { 0.0 } else { value };
        self.add(Node::Constant(value.to_bits()))
    }

    /// A variable.
    pub fn symbol(&mut self, symbol: Symbol) -> NodeId {
        self.add(Node::Symbol(symbol))
    }

    /// A function of one argument.
    pub fn unary(&mut self, op: Unary, a: NodeId) -> NodeId {
        self.add(Node::Unary(op, a))
    }

    /// A function of two arguments.
    pub fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        self.add(Node::Binary(op, a, b))
    }

    /// The node behind an id.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0 as usize]
    }

    /// The value, if the node is a constant.
    pub fn constant_value(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// All nodes in order; operands before users.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Calls `visit` once for each node that `roots` depend on, operands first. Switching functions of `Select`s
    /// are not followed (they belong to the model, not to the expression).
    pub fn visit(&self, roots: &[NodeId], mut visit: impl FnMut(NodeId, Node)) {
        let mut needed = vec![false; self.nodes.len()];
        for root in roots {
            needed[root.0 as usize] = true;
        }
        for i in (0..self.nodes.len()).rev() {
            if needed[i] {
                for operand in operands(self.nodes[i]) {
                    needed[operand.0 as usize] = true;
                }
            }
        }
        for (i, &node) in self.nodes.iter().enumerate() {
            if needed[i] {
                visit(NodeId(i as u32), node);
            }
        }
    }

    /// Whether any of `roots` depends on a symbol for which `wanted` holds (directly, not through switches).
    pub fn depends(&self, roots: &[NodeId], wanted: impl Fn(Symbol) -> bool) -> bool {
        let mut found = false;
        self.visit(roots, |_, node| {
            if let Node::Symbol(symbol) = node {
                found |= wanted(symbol);
            }
        });
        found
    }
}

/// The operands of a node, in order.
pub fn operands(node: Node) -> impl Iterator<Item = NodeId> {
    let [a, b, c] = match node {
        Node::Constant(_) | Node::Symbol(_) => [None; 3],
        Node::Unary(_, a) | Node::Partial(a, _) => [Some(a), None, None],
        Node::Binary(_, a, b) => [Some(a), Some(b), None],
        Node::Select { then, otherwise, .. } => [Some(then), Some(otherwise), None],
        Node::Choose { margin, then, otherwise } => [Some(margin), Some(then), Some(otherwise)],
    };
    [a, b, c].into_iter().flatten()
}
