//! What travels to the CasADi script and back, as JSON.
//!
//! To it: for each model the number of input symbols, the expression nodes (operands by index, operands first), and for
//! each function its components and the inputs to differentiate by. Back: for each function CasADi's instruction tape and
//! the positions of the Jacobian's structural nonzeros.

use super::functions::{self, Expressions};
use crate::ir::{Binary, Graph, Model, Node, NodeId, Symbol, Unary};
use crate::valid::Validated;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// An input of the programs of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// A symbol of the model.
    Symbol(Symbol),
    /// A frozen branch selector.
    Branch(usize),
}

/// All inputs of a model's programs; programs refer to them by position.
pub fn inputs(model: &Model) -> Vec<Input> {
    let n = model.states.len();
    let symbols = (0..n)
        .map(Symbol::State)
        .chain((0..n).map(Symbol::Rate))
        .chain((0..model.parameters.len()).map(Symbol::Parameter))
        .chain((0..model.memory.len()).map(Symbol::Memory))
        .chain([Symbol::Tau, Symbol::Time])
        .chain((0..model.functionals.len()).map(Symbol::Functional));
    symbols.map(Input::Symbol).chain((0..model.switches.len()).map(Input::Branch)).collect()
}

/// What the script gets.
#[derive(Debug, Serialize)]
pub struct Request {
    /// The CasADi version that it has to be.
    casadi: &'static str,
    models: Vec<ModelRequest>,
}

#[derive(Debug, Serialize)]
struct ModelRequest {
    inputs: usize,
    /// Positions of the rates among the inputs.
    rates: Vec<usize>,
    nodes: Vec<NodeRequest>,
    functions: Vec<FunctionRequest>,
}

/// One expression node: an op code, operands by position in the node list, then an input's position if it has one.
#[derive(Debug, Serialize)]
struct NodeRequest {
    op: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    args: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    input: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<f64>,
}

#[derive(Debug, Serialize)]
struct FunctionRequest {
    values: Vec<usize>,
    /// What to put in place of the rates.
    rates: Option<Vec<usize>>,
    by: Vec<usize>,
}

/// What the script answers.
#[derive(Debug, Deserialize)]
pub struct Response {
    /// For each model the tape of each function.
    pub models: Vec<Vec<Tape>>,
}

/// The instruction tape of one CasADi function with two outputs: values (dense), and nonzeros of the Jacobian.
#[derive(Debug, Deserialize)]
pub struct Tape {
    /// In order of execution.
    pub instructions: Vec<Instruction>,
    /// How many components the value has.
    pub rows: usize,
    /// Row and column of each nonzero of the Jacobian.
    pub nonzeros: Vec<(usize, usize)>,
}

/// One instruction.
#[derive(Debug, Deserialize)]
pub struct Instruction {
    /// CasADi's op code by name, lower case.
    pub op: String,
    /// Register to write; for an output which output, and which of its nonzeros.
    pub out: Vec<usize>,
    /// Registers to read; for an input which input, and which of its components.
    pub args: Vec<usize>,
    /// The constant, printed so that it reads back exactly.
    pub value: Option<String>,
}

impl Request {
    /// The request for all functions of some models.
    pub fn new(models: &[&Validated]) -> Self {
        Self { casadi: super::CASADI_VERSION, models: models.iter().map(|model| model_request(model)).collect() }
    }
}

fn model_request(validated: &Validated) -> ModelRequest {
    let model = validated.model();
    let inputs = inputs(model);
    let position: HashMap<Input, usize> = inputs.iter().enumerate().map(|(i, &input)| (input, i)).collect();
    let mut graph = model.graph.clone();
    let functions = functions::list(validated);
    let expressions: Vec<Expressions> =
        functions.iter().map(|f| functions::expressions(validated, &mut graph, f.quantity)).collect();
    let (nodes, number) = nodes(&graph, &expressions, &position);
    let numbers = |ids: &[NodeId]| ids.iter().filter_map(|id| number.get(id).copied()).collect();
    let requests = functions
        .iter()
        .zip(&expressions)
        .map(|(function, expressions)| FunctionRequest {
            values: numbers(&expressions.values),
            rates: expressions.rates.as_deref().map(numbers),
            by: function.by.symbols(model).iter().filter_map(|&s| position.get(&Input::Symbol(s)).copied()).collect(),
        })
        .collect();
    let rates = (0..model.states.len()).filter_map(|i| position.get(&Input::Symbol(Symbol::Rate(i))).copied());
    ModelRequest { inputs: inputs.len(), rates: rates.collect(), nodes, functions: requests }
}

/// The nodes that the functions need, and where each stands in the list.
fn nodes(
    graph: &Graph,
    expressions: &[Expressions],
    position: &HashMap<Input, usize>,
) -> (Vec<NodeRequest>, HashMap<NodeId, usize>) {
    let roots: Vec<NodeId> =
        expressions.iter().flat_map(|e| e.values.iter().chain(e.rates.iter().flatten())).copied().collect();
    let (mut list, mut number) = (Vec::new(), HashMap::new());
    graph.visit(&roots, |id, node| {
        let args = crate::ir::graph::operands(node).filter_map(|o| number.get(&o).copied()).collect();
        let input = match node {
            Node::Symbol(symbol) | Node::Partial(_, symbol) => position.get(&Input::Symbol(symbol)).copied(),
            Node::Select { switch, .. } => position.get(&Input::Branch(switch)).copied(),
            _ => None,
        };
        let value = match node {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        };
        number.insert(id, list.len());
        list.push(NodeRequest { op: op_code(node), args, input, value });
    });
    (list, number)
}

fn op_code(node: Node) -> &'static str {
    match node {
        Node::Constant(_) => "constant",
        Node::Symbol(_) => "input",
        Node::Select { .. } => "select",
        Node::Choose { .. } => "choose",
        Node::Partial(..) => "partial",
        Node::Unary(op, _) => match op {
            Unary::Neg => "neg",
            Unary::Sin => "sin",
            Unary::Cos => "cos",
            Unary::Tan => "tan",
            Unary::Asin => "asin",
            Unary::Acos => "acos",
            Unary::Atan => "atan",
            Unary::Sinh => "sinh",
            Unary::Cosh => "cosh",
            Unary::Tanh => "tanh",
            Unary::Asinh => "asinh",
            Unary::Acosh => "acosh",
            Unary::Atanh => "atanh",
            Unary::Exp => "exp",
            Unary::Log => "log",
            Unary::Sqrt => "sqrt",
        },
        Node::Binary(op, ..) => match op {
            Binary::Add => "add",
            Binary::Sub => "sub",
            Binary::Mul => "mul",
            Binary::Div => "div",
            Binary::Pow => "pow",
            Binary::Atan2 => "atan2",
        },
    }
}
