//! Many expressions at many points: each node once a point, in an order that is laid down once.
//!
//! Nodes outside derivatives are real numbers. Those inside `d(expr, x)` are nilpotent numbers, once for each list of
//! symbols that are perturbed there, and real again where they depend on none of them.

use super::nilpotent::Nilpotent;
use super::{DEEPEST, Environment, binary, real, unary};
use crate::ir::{Binary, Graph, Node, NodeId, Symbol, Unary, graph::operands};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};

/// Most coefficients of one point: derivatives of derivatives double them at each level.
const COEFFICIENT_LIMIT: usize = 1 << 20;

/// Where a value stands.
#[derive(Clone, Copy, Debug)]
enum Slot {
    Real(usize),
    Nilpotent(usize),
}

/// What a step computes from the slots before it.
#[derive(Clone, Debug)]
enum Operation {
    Constant(f64),
    /// A variable, and the generators that are added to it.
    Symbol(Symbol, Vec<usize>),
    Unary(Unary, Slot),
    Binary(Binary, Slot, Slot),
    /// By the selector of a switch.
    Select(usize, Slot, Slot),
    /// By the sign of the first.
    Choose(Slot, Slot, Slot),
    /// What stands at a generator.
    Coefficient(Slot, usize),
}

/// One step; its value goes to the next slot of its kind.
#[derive(Clone, Debug)]
struct Step {
    operation: Operation,
    real: bool,
}

/// Expressions ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Tape {
    steps: Vec<Step>,
    roots: Vec<Slot>,
    reals: Vec<f64>,
    nilpotents: Vec<Nilpotent>,
}

impl Tape {
    /// For the values of `roots`, in their order.
    pub fn new(graph: &Graph, roots: &[NodeId]) -> Self {
        let (slots, moving) = (HashMap::new(), BTreeMap::new());
        let mut builder = Builder { graph, slots, moving, steps: Vec::new(), reals: 0, nilpotents: 0, size: 0 };
        let roots = roots.iter().map(|&root| builder.lay(&[], root)).collect();
        Self { steps: builder.steps, roots, reals: Vec::new(), nilpotents: Vec::new() }
    }

    /// The values at a point, one a root.
    pub fn values<'t>(&'t mut self, at: &Environment<'_>) -> impl Iterator<Item = f64> + use<'t> {
        self.reals.clear();
        self.nilpotents.clear();
        for step in &self.steps {
            if step.real {
                let value = self.real(&step.operation, at);
                self.reals.push(value);
            } else {
                let value = self.nilpotent(&step.operation, at);
                self.nilpotents.push(value);
            }
        }
        self.roots.iter().map(|&root| self.value(root))
    }

    /// The real part of what stands in a slot.
    fn value(&self, slot: Slot) -> f64 {
        match slot {
            Slot::Real(i) => self.reals.get(i).copied().unwrap_or(f64::NAN),
            Slot::Nilpotent(i) => self.nilpotents.get(i).map_or(f64::NAN, Nilpotent::value),
        }
    }

    fn real(&self, operation: &Operation, at: &Environment<'_>) -> f64 {
        match *operation {
            Operation::Constant(value) => value,
            Operation::Symbol(symbol, _) => at.value(symbol),
            Operation::Unary(op, a) => real::unary(op, self.value(a)),
            Operation::Binary(op, a, b) => real::binary(op, self.value(a), self.value(b)),
            Operation::Select(switch, a, b) => self.value(if at.selected(switch) { a } else { b }),
            Operation::Choose(margin, a, b) => self.value(if self.value(margin) >= 0.0 { a } else { b }),
            Operation::Coefficient(Slot::Nilpotent(i), generator) => {
                self.nilpotents.get(i).map_or(f64::NAN, |number| number.coefficient(generator).value())
            }
            // A real number has no part that a generator stands at.
            Operation::Coefficient(Slot::Real(_), _) => 0.0,
        }
    }

    fn nilpotent(&self, operation: &Operation, at: &Environment<'_>) -> Nilpotent {
        let of = |slot: Slot| match slot {
            Slot::Nilpotent(i) => self.nilpotents.get(i).map(Cow::Borrowed),
            Slot::Real(i) => self.reals.get(i).map(|&value| Cow::Owned(Nilpotent::real(value))),
        };
        let of = |slot: Slot| of(slot).unwrap_or_else(|| Cow::Owned(Nilpotent::real(f64::NAN)));
        match operation {
            Operation::Constant(value) => Nilpotent::real(*value),
            Operation::Symbol(symbol, generators) => {
                generators.iter().fold(Nilpotent::real(at.value(*symbol)), |value, &i| value.perturbed(i))
            }
            Operation::Unary(op, a) => unary(*op, &of(*a)),
            Operation::Binary(op, a, b) => binary(*op, &of(*a), &of(*b)),
            Operation::Select(switch, a, b) => of(if at.selected(*switch) { *a } else { *b }).into_owned(),
            Operation::Choose(margin, a, b) => of(if self.value(*margin) >= 0.0 { *a } else { *b }).into_owned(),
            Operation::Coefficient(a, generator) => of(*a).coefficient(*generator),
        }
    }
}

/// Lays down the steps.
struct Builder<'g> {
    graph: &'g Graph,
    /// By the perturbed symbols and the node.
    slots: HashMap<(Vec<Symbol>, NodeId), Slot>,
    /// For each symbol that something is differentiated by: whether each node depends on it.
    moving: BTreeMap<Symbol, Vec<bool>>,
    steps: Vec<Step>,
    /// How many slots of each kind there are.
    reals: usize,
    nilpotents: usize,
    /// Coefficients of one point so far.
    size: usize,
}

impl Builder<'_> {
    /// Lays down a node and what it needs, while `perturbed` are perturbed, generator number i at the i-th.
    fn lay(&mut self, perturbed: &[Symbol], root: NodeId) -> Slot {
        // An explicit stack: expressions may be deeper than the call stack allows.
        let mut open = vec![(root, false)];
        while let Some((id, operands_done)) = open.pop() {
            let list = self.list(perturbed, id);
            if self.slots.contains_key(&(list.to_vec(), id)) {
                continue;
            }
            let node = self.graph.node(id);
            if !operands_done {
                open.push((id, true));
                // What is differentiated is laid down for itself: its derivative alone is needed.
                if !matches!(node, Node::Partial(..)) {
                    open.extend(operands(node).map(|operand| (operand, false)));
                }
                continue;
            }
            let operation = self.operation(list, node);
            let slot = self.push(operation, list.len());
            self.slots.insert((list.to_vec(), id), slot);
        }
        self.slot(perturbed, root)
    }

    fn operation(&mut self, list: &[Symbol], node: Node) -> Operation {
        match node {
            Node::Constant(bits) => Operation::Constant(f64::from_bits(bits)),
            Node::Symbol(symbol) => {
                let at = list.iter().enumerate().filter(|(_, other)| **other == symbol).map(|(i, _)| i);
                Operation::Symbol(symbol, at.collect())
            }
            Node::Unary(op, a) => Operation::Unary(op, self.slot(list, a)),
            Node::Binary(op, a, b) => Operation::Binary(op, self.slot(list, a), self.slot(list, b)),
            Node::Select { switch, then, otherwise } => {
                Operation::Select(switch, self.slot(list, then), self.slot(list, otherwise))
            }
            Node::Choose { margin, then, otherwise } => {
                Operation::Choose(self.slot(list, margin), self.slot(list, then), self.slot(list, otherwise))
            }
            Node::Partial(expr, symbol) if list.len() < DEEPEST && self.size < COEFFICIENT_LIMIT => {
                let more = [list, &[symbol]].concat();
                Operation::Coefficient(self.lay(&more, expr), list.len())
            }
            Node::Partial(..) => Operation::Constant(f64::NAN),
        }
    }

    fn push(&mut self, operation: Operation, generators: usize) -> Slot {
        self.size += 1 << generators;
        self.steps.push(Step { operation, real: generators == 0 });
        let (count, slot) = match generators {
            0 => (&mut self.reals, Slot::Real as fn(usize) -> Slot),
            _ => (&mut self.nilpotents, Slot::Nilpotent as fn(usize) -> Slot),
        };
        *count += 1;
        slot(*count - 1)
    }

    /// The slot of a node that has been laid down.
    fn slot(&mut self, perturbed: &[Symbol], id: NodeId) -> Slot {
        let list = self.list(perturbed, id).to_vec();
        // Operands come before what needs them.
        self.slots.get(&(list, id)).copied().unwrap_or(Slot::Real(usize::MAX))
    }

    /// The perturbed symbols without those at the end that a node does not depend on.
    fn list<'s>(&mut self, perturbed: &'s [Symbol], id: NodeId) -> &'s [Symbol] {
        let mut list = perturbed;
        while let Some((&last, rest)) = list.split_last() {
            let graph = self.graph;
            let moving = self.moving.entry(last).or_insert_with(|| moving(graph, last));
            if moving.get(id.0 as usize).copied().unwrap_or(true) {
                break;
            }
            list = rest;
        }
        list
    }
}

/// For each node whether it depends on a symbol.
fn moving(graph: &Graph, symbol: Symbol) -> Vec<bool> {
    let mut moving: Vec<bool> = Vec::with_capacity(graph.nodes().len());
    for &node in graph.nodes() {
        let of_operand = |id: NodeId| moving.get(id.0 as usize).copied().unwrap_or(false);
        let depends = node == Node::Symbol(symbol) || operands(node).any(of_operand);
        moving.push(depends);
    }
    moving
}
