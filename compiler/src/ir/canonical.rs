//! The canonical form of a model's equations, and its hash, the fingerprint.
//!
//! Two models have the same fingerprint exactly when the same code is generated for them, up to texts for people:
//! names, dimensions, structure and the expressions that equations and measures reach count; parameter values and
//! ranges, start guesses, initial memory, titles, doc strings and problems do not. Nodes are numbered in the order of a
//! depth-first visit from the equations, so that what is not reached does not shift any number.

use super::{AlsoZero, Graph, Model, Node, NodeId, Symbol, graph};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;

/// SHA-256 of the canonical form, 64 hexadecimal digits.
pub fn fingerprint(model: &Model) -> String {
    hex_digest(canonical(model).as_bytes())
}

/// SHA-256 of some bytes, 64 hexadecimal digits.
pub fn hex_digest(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::with_capacity(64), |mut text, byte| {
        // Writing to a String cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// The canonical form: one line an item, the same text for the same equations.
pub fn canonical(model: &Model) -> String {
    let mut writer = Writer::new(&model.graph);
    writer.line(format_args!("gaitc canonical form 1"));
    writer.line(format_args!("model {:?}", model.name));
    for p in &model.parameters {
        writer.line(format_args!("parameter {:?} {}", p.name, p.dimension));
    }
    for s in &model.states {
        writer.line(format_args!("state {:?} {}", s.name, s.dimension));
    }
    for m in &model.memory {
        writer.line(format_args!("memory {:?}", m.name));
    }
    for s in &model.switches {
        writer.item("switch", &[s.expr]);
    }
    writer.modes(model);
    writer.transitions(model);
    writer.section(model);
    for f in &model.functionals {
        writer.item(&format!("functional {:?}", f.kind), &[f.expr]);
    }
    for m in &model.measures {
        writer.item(&format!("measure {:?} {}", m.name, m.dimension), &[m.expr]);
    }
    writer.text
}

/// Writes items, and before each item the nodes that it needs and that were not written yet.
struct Writer<'a> {
    graph: &'a Graph,
    /// Canonical number of each node that was written.
    number: Vec<Option<usize>>,
    next: usize,
    text: String,
}

impl<'a> Writer<'a> {
    fn new(graph: &'a Graph) -> Self {
        Self { graph, number: vec![None; graph.nodes().len()], next: 0, text: String::new() }
    }

    fn line(&mut self, arguments: std::fmt::Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.text.write_fmt(arguments);
        self.text.push('\n');
    }

    /// One item with its expressions.
    fn item(&mut self, label: &str, roots: &[NodeId]) {
        let numbers: Vec<String> = roots.iter().map(|&root| self.visit(root)).collect();
        self.line(format_args!("{label} = {}", numbers.join(" ")));
    }

    fn modes(&mut self, model: &Model) {
        for mode in &model.modes {
            self.line(format_args!("mode {:?} states {:?}", mode.name, mode.has_state));
            self.item("flow", &mode.flow);
            for row in mode.mass.iter().flatten() {
                self.item("mass row", row);
            }
        }
    }

    fn transitions(&mut self, model: &Model) {
        for t in &model.transitions {
            self.line(format_args!("transition {:?} {} -> {} {:?}", t.name, t.from, t.to, t.direction));
            self.item("guard", &[t.guard]);
            if let Some(when) = t.when {
                self.item("when", &[when]);
            }
            self.item("reset", &t.reset);
            self.item("memory reset", &t.memory_reset);
            for AlsoZero { dimension, start, end, rate, .. } in &t.also_zero {
                self.line(format_args!("also zero {dimension} functionals {start} {end} {rate}"));
            }
        }
    }

    fn section(&mut self, model: &Model) {
        if let Some(section) = &model.section {
            let side = if section.before { "before" } else { "after" };
            self.line(format_args!("section {side} {} coordinates {:?}", section.transition, section.coordinates));
            self.item("embed", &section.embed);
            if let Some(symmetry) = &section.symmetry {
                self.item("symmetry", symmetry);
            }
        }
    }

    /// Writes the nodes below `root`, operands first, and gives the root's number.
    fn visit(&mut self, root: NodeId) -> String {
        // An explicit stack: expressions may be deeper than the call stack allows.
        let mut stack = vec![(root, false)];
        while let Some((id, operands_done)) = stack.pop() {
            let index = id.0 as usize;
            let (Some(&node), Some(None)) = (self.graph.nodes().get(index), self.number.get(index)) else {
                continue;
            };
            if operands_done {
                self.node(index, node);
            } else {
                stack.push((id, true));
                let operands: Vec<NodeId> = graph::operands(node).collect();
                // Only smaller indices, so that a malformed graph cannot make this run for ever.
                stack.extend(operands.into_iter().rev().filter(|o| o.0 < id.0).map(|o| (o, false)));
            }
        }
        self.name(root)
    }

    fn node(&mut self, index: usize, node: Node) {
        let text = match node {
            Node::Constant(bits) => format!("constant {bits:016x}"),
            Node::Symbol(symbol) => symbol_text(symbol),
            Node::Unary(op, a) => format!("{op:?} {}", self.name(a)),
            Node::Binary(op, a, b) => format!("{op:?} {} {}", self.name(a), self.name(b)),
            Node::Select { switch, then, otherwise } => {
                format!("select {switch} {} {}", self.name(then), self.name(otherwise))
            }
            Node::Choose { margin, then, otherwise } => {
                format!("choose {} {} {}", self.name(margin), self.name(then), self.name(otherwise))
            }
            Node::Partial(a, symbol) => format!("partial {} {}", self.name(a), symbol_text(symbol)),
        };
        let number = self.next;
        self.next += 1;
        if let Some(slot) = self.number.get_mut(index) {
            *slot = Some(number);
        }
        self.line(format_args!("%{number} = {text}"));
    }

    fn name(&self, id: NodeId) -> String {
        match self.number.get(id.0 as usize) {
            Some(Some(number)) => format!("%{number}"),
            _ => "%missing".to_owned(),
        }
    }
}

fn symbol_text(symbol: Symbol) -> String {
    match symbol {
        Symbol::State(i) => format!("state {i}"),
        Symbol::Rate(i) => format!("rate {i}"),
        Symbol::Parameter(i) => format!("parameter {i}"),
        Symbol::Memory(i) => format!("memory {i}"),
        Symbol::Tau => "tau".to_owned(),
        Symbol::Time => "t".to_owned(),
        Symbol::Functional(i) => format!("functional {i}"),
        Symbol::Measure(i) => format!("measure {i}"),
        Symbol::SpectralRadius => "spectral radius".to_owned(),
    }
}
