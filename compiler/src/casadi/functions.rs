//! Which functions are generated for a model: quantities, and the symbols that they are differentiated by.

use crate::ir::{Binary, Graph, Mode, Model, NodeId, Symbol, Transition};
use crate::valid::Validated;

/// A vector-valued quantity of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// State derivative f of a mode.
    Flow(usize),
    /// f of a mode, then the integrands.
    Integrated(usize),
    /// F = M k - f of a mode.
    Residual(usize),
    /// The integrands; in a certain mode if its flow stands in for rates.
    Integrands(Option<usize>),
    /// A switching function.
    Switch(usize),
    /// Guard of a transition.
    Guard(usize),
    /// Margin of a transition's `when`.
    When(usize),
    /// State after a transition.
    Reset(usize),
    /// State, then memory after a transition.
    ResetWithMemory(usize),
    /// Full state on the section.
    Embed,
    /// Image under the symmetry.
    Symmetry,
    /// An observable; in a certain mode if its flow stands in for rates.
    Observable(usize, Option<usize>),
    /// All measures.
    Measures,
}

/// What a quantity is differentiated by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Columns {
    /// Nothing: the value alone.
    None,
    /// The states.
    State,
    /// The states, then the rates.
    StateAndRates,
    /// The states, then the parameters.
    StateAndParameters,
    /// The states, the parameters, t.
    Along,
    /// The states, the rates, the parameters, t.
    AlongWithRates,
    /// The states, the parameters, tau, t.
    All,
    /// The states, the rates, the parameters, tau, t.
    AllAndRates,
    /// The section coordinates, then the parameters.
    Coordinates,
    /// The functionals, then the parameters.
    Functionals,
}

impl Columns {
    /// Whether the generated function returns the value beside the Jacobian.
    pub fn with_value(self) -> bool {
        !matches!(self, Self::Coordinates | Self::Functionals)
    }

    /// The symbols, in the order of the Jacobian's columns.
    pub fn symbols(self, model: &Model) -> Vec<Symbol> {
        let x = (0..model.states.len()).map(Symbol::State);
        let k = (0..model.states.len()).map(Symbol::Rate);
        let p = (0..model.parameters.len()).map(Symbol::Parameter);
        let times = [Symbol::Tau, Symbol::Time];
        match self {
            Self::None => Vec::new(),
            Self::State => x.collect(),
            Self::StateAndRates => x.chain(k).collect(),
            Self::StateAndParameters => x.chain(p).collect(),
            Self::Along => x.chain(p).chain([Symbol::Time]).collect(),
            Self::AlongWithRates => x.chain(k).chain(p).chain([Symbol::Time]).collect(),
            Self::All => x.chain(p).chain(times).collect(),
            Self::AllAndRates => x.chain(k).chain(p).chain(times).collect(),
            Self::Coordinates => {
                let z = model.section.iter().flat_map(|s| s.coordinates.iter().copied().map(Symbol::State));
                z.chain(p).collect()
            }
            Self::Functionals => (0..model.functionals.len()).map(Symbol::Functional).chain(p).collect(),
        }
    }
}

/// A generated function: the value of a quantity, and its Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Function {
    /// Of what.
    pub quantity: Quantity,
    /// By what.
    pub by: Columns,
}

/// A quantity as expressions.
#[derive(Clone, Debug)]
pub struct Expressions {
    /// The components.
    pub values: Vec<NodeId>,
    /// What the rates stand for, where they are no argument of the function.
    pub rates: Option<Vec<NodeId>>,
}

/// All functions of a model, in a fixed order.
pub fn list(model: &Validated) -> Vec<Function> {
    let (m, facts) = (model.model(), model.facts());
    let mut functions = Vec::new();
    let mut add = |quantity, columns: &[Columns]| {
        functions.extend(columns.iter().map(|&by| Function { quantity, by }));
    };
    for mode in 0..m.modes.len() {
        if facts.explicit {
            add(Quantity::Flow(mode), &[Columns::None, Columns::All, Columns::State]);
            add(Quantity::Integrated(mode), &[Columns::None, Columns::StateAndParameters]);
        }
        add(Quantity::Residual(mode), &[Columns::None, Columns::AllAndRates, Columns::StateAndRates]);
    }
    for mode in integrand_modes(model) {
        add(Quantity::Integrands(mode), &[Columns::None, along(model)]);
    }
    for i in 0..m.switches.len() {
        add(Quantity::Switch(i), &[Columns::None, Columns::All]);
    }
    for (i, transition) in m.transitions.iter().enumerate() {
        add(Quantity::Guard(i), &[Columns::None, Columns::All]);
        if transition.when.is_some() {
            add(Quantity::When(i), &[Columns::None]);
        }
        add(Quantity::ResetWithMemory(i), &[Columns::None]);
        add(Quantity::Reset(i), &[Columns::All]);
    }
    if let Some(section) = &m.section {
        add(Quantity::Embed, &[Columns::None, Columns::Coordinates]);
        if section.symmetry.is_some() {
            add(Quantity::Symmetry, &[Columns::None, Columns::StateAndParameters]);
        }
    }
    for i in 0..facts.observables.len() {
        for mode in observable_modes(model, i) {
            add(Quantity::Observable(i, mode), &[Columns::None, all_of_rates(model)]);
        }
    }
    add(Quantity::Measures, &[Columns::None, Columns::Functionals]);
    functions
}

/// What integrands are differentiated by: the rates, too, where they are an argument.
pub fn along(model: &Validated) -> Columns {
    if model.facts().explicit { Columns::Along } else { Columns::AlongWithRates }
}

/// What observables are differentiated by: the rates, too, where they are an argument.
pub fn all_of_rates(model: &Validated) -> Columns {
    if model.facts().explicit { Columns::All } else { Columns::AllAndRates }
}

/// The modes in which an observable has a function of its own; one `None` when it is the same in all.
pub fn observable_modes(model: &Validated, index: usize) -> Vec<Option<usize>> {
    let expr = model.facts().observables.get(index).copied();
    modes_of(model, expr.as_slice())
}

/// The same for the integrands; nothing when there are none.
pub fn integrand_modes(model: &Validated) -> Vec<Option<usize>> {
    let integrals = &model.facts().integrals;
    if integrals.is_empty() { Vec::new() } else { modes_of(model, integrals) }
}

/// In an explicit model each mode's flow stands in for the rates, so what depends on them differs by mode.
fn modes_of(model: &Validated, expressions: &[NodeId]) -> Vec<Option<usize>> {
    let m = model.model();
    let substituted = model.facts().explicit && m.graph.depends(expressions, |s| matches!(s, Symbol::Rate(_)));
    if substituted { (0..m.modes.len()).map(Some).collect() } else { vec![None] }
}

/// The expressions of a quantity; new nodes are added to `graph`, which starts as the model's.
pub fn expressions(model: &Validated, graph: &mut Graph, quantity: Quantity) -> Expressions {
    let (m, facts) = (model.model(), model.facts());
    let flow_of = |mode: usize| m.modes.get(mode).filter(|mode| mode.mass.is_none()).map(|mode| mode.flow.clone());
    let rates_of = |transition: usize| m.transitions.get(transition).and_then(|t| flow_of(t.from));
    let transition = |i: usize| m.transitions.get(i);
    let (values, rates) = match quantity {
        Quantity::Flow(mode) => (flow_of(mode).unwrap_or_default(), None),
        Quantity::Integrated(mode) => {
            let flow = flow_of(mode).unwrap_or_default();
            (flow.iter().chain(&facts.integrals).copied().collect(), Some(flow))
        }
        Quantity::Residual(mode) => (m.modes.get(mode).map_or_else(Vec::new, |mode| residual(graph, mode)), None),
        Quantity::Integrands(mode) => (facts.integrals.clone(), mode.and_then(flow_of)),
        Quantity::Switch(i) => (m.switches.get(i).map(|s| s.expr).into_iter().collect(), None),
        Quantity::Guard(i) => (transition(i).map(|t| t.guard).into_iter().collect(), rates_of(i)),
        Quantity::When(i) => (transition(i).and_then(|t| t.when).into_iter().collect(), rates_of(i)),
        Quantity::Reset(i) => (transition(i).map_or_else(Vec::new, |t| t.reset.clone()), rates_of(i)),
        Quantity::ResetWithMemory(i) => {
            let all = |t: &Transition| t.reset.iter().chain(&t.memory_reset).copied().collect();
            (transition(i).map_or_else(Vec::new, all), rates_of(i))
        }
        Quantity::Embed => (section(m, |s| Some(&s.embed)), None),
        Quantity::Symmetry => (section(m, |s| s.symmetry.as_ref()), None),
        Quantity::Observable(i, mode) => {
            (facts.observables.get(i).copied().into_iter().collect(), mode.and_then(flow_of))
        }
        Quantity::Measures => (m.measures.iter().map(|measure| measure.expr).collect(), None),
    };
    Expressions { values, rates }
}

fn section(model: &Model, of: impl Fn(&crate::ir::Section) -> Option<&Vec<NodeId>>) -> Vec<NodeId> {
    model.section.as_ref().and_then(of).cloned().unwrap_or_default()
}

/// F = M k - f, by rows; without a mass matrix, and for states that the mode does not have, M is the identity.
fn residual(graph: &mut Graph, mode: &Mode) -> Vec<NodeId> {
    let mut rows = Vec::with_capacity(mode.flow.len());
    for (i, &flow) in mode.flow.iter().enumerate() {
        let has_state = mode.has_state.get(i).copied().unwrap_or(true);
        let row = mode.mass.as_ref().filter(|_| has_state).and_then(|rows| rows.get(i));
        let inertia = match row {
            Some(row) => weighted_rates(graph, row),
            None => graph.symbol(Symbol::Rate(i)),
        };
        rows.push(if has_state { graph.binary(Binary::Sub, inertia, flow) } else { inertia });
    }
    rows
}

/// Sum of M_ij k_j over a row of the mass matrix.
fn weighted_rates(graph: &mut Graph, row: &[NodeId]) -> NodeId {
    let mut sum = None;
    for (j, &factor) in row.iter().enumerate() {
        if graph.constant_value(factor) == Some(0.0) {
            continue;
        }
        let rate = graph.symbol(Symbol::Rate(j));
        let term = graph.binary(Binary::Mul, factor, rate);
        sum = Some(match sum {
            Some(sum) => graph.binary(Binary::Add, sum, term),
            None => term,
        });
    }
    sum.unwrap_or_else(|| graph.constant(0.0))
}
