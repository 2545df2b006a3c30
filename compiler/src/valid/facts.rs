//! What follows from a model's structure and the back end has to know: which integrals run beside the flow, which
//! observables are asked for, which switching functions matter where.

use crate::ir::{FunctionalKind, Graph, Model, Node, NodeId, Symbol};
use std::collections::BTreeSet;

/// What a functional refers to: the index of an integral or of an observable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// Index into [`Facts::integrals`].
    Integral(usize),
    /// Index into [`Facts::observables`].
    Observable(usize),
    /// Neither: the duration.
    None,
}

/// Derived facts of a model.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The Q distinct integrands; an integral and a mean of the same expression share one.
    pub integrals: Vec<NodeId>,
    /// The distinct expressions that start, end, maximum and minimum functionals refer to.
    pub observables: Vec<NodeId>,
    /// For each functional of the model what it refers to.
    pub references: Vec<Reference>,
    /// For each mode the switches that its flow and its transitions depend on, ascending, including those that other
    /// switching functions depend on.
    pub mode_switches: Vec<Vec<usize>>,
    /// The same with those that the functionals depend on.
    pub measured_switches: Vec<Vec<usize>>,
    /// States of the section, coordinates left out, that a gait has to lead back: those that something else depends on.
    pub returning: Vec<usize>,
    /// Whether every mode gives its state derivative explicitly (no mass matrix).
    pub explicit: bool,
    /// Whether the equations depend on the time since the start of the run.
    pub uses_time: bool,
}

impl Facts {
    /// Derives the facts of a structurally sound model.
    ///
    /// # Errors
    /// When switching functions depend on each other in a circle.
    pub(super) fn of(model: &Model) -> Result<Self, String> {
        let (integrals, observables, references) = functionals(model);
        let closure = switch_closure(model)?;
        let measured: Vec<NodeId> = model.functionals.iter().map(|f| f.expr).collect();
        let switches = |mode: usize, more: &[NodeId]| -> Vec<usize> {
            let direct = switches_of(&model.graph, &[&mode_roots(model, mode), more].concat());
            let all: BTreeSet<usize> =
                direct.iter().filter_map(|&s| closure.get(s)).flatten().chain(&direct).copied().collect();
            all.into_iter().collect()
        };
        Ok(Self {
            integrals,
            observables,
            references,
            mode_switches: (0..model.modes.len()).map(|mode| switches(mode, &[])).collect(),
            measured_switches: (0..model.modes.len()).map(|mode| switches(mode, &measured)).collect(),
            returning: returning(model),
            explicit: model.modes.iter().all(|mode| mode.mass.is_none()),
            uses_time: model.graph.depends(&equation_roots(model), |symbol| symbol == Symbol::Time),
        })
    }
}

/// States of the section that matter and are no coordinates.
fn returning(model: &Model) -> Vec<usize> {
    let Some(section) = &model.section else { return Vec::new() };
    let mode = section.mode(&model.transitions).and_then(|mode| model.modes.get(mode));
    let there = |i: usize| mode.is_some_and(|mode| mode.has_state.get(i) == Some(&true));
    let states = 0..model.states.len();
    states.filter(|&i| there(i) && !section.coordinates.contains(&i) && matters(model, i)).collect()
}

/// Whether anything that happens depends on a state, its own reset left out.
fn matters(model: &Model, state: usize) -> bool {
    let mut roots: Vec<NodeId> = Vec::new();
    for mode in &model.modes {
        roots.extend(&mode.flow);
        roots.extend(mode.mass.iter().flatten().flatten());
    }
    for transition in &model.transitions {
        roots.extend(transition.when.into_iter().chain([transition.guard]));
        roots.extend(transition.reset.iter().enumerate().filter(|(i, _)| *i != state).map(|(_, &reset)| reset));
        roots.extend(&transition.memory_reset);
    }
    roots.extend(model.switches.iter().map(|switch| switch.expr));
    model.graph.depends(&roots, |symbol| symbol == Symbol::State(state))
}

/// Integrals, observables, and for each functional what it refers to.
fn functionals(model: &Model) -> (Vec<NodeId>, Vec<NodeId>, Vec<Reference>) {
    let (mut integrals, mut observables) = (Vec::new(), Vec::new());
    let references = model
        .functionals
        .iter()
        .map(|functional| match functional.kind {
            FunctionalKind::Integral | FunctionalKind::Mean => {
                Reference::Integral(position(&mut integrals, functional.expr))
            }
            FunctionalKind::Start | FunctionalKind::End | FunctionalKind::Maximum | FunctionalKind::Minimum => {
                Reference::Observable(position(&mut observables, functional.expr))
            }
            FunctionalKind::Duration => Reference::None,
        })
        .collect();
    (integrals, observables, references)
}

/// Position of `id` in the list, appended when it is not there.
fn position(list: &mut Vec<NodeId>, id: NodeId) -> usize {
    list.iter().position(|&other| other == id).unwrap_or_else(|| {
        list.push(id);
        list.len() - 1
    })
}

/// Expressions that a mode evaluates: flow, mass matrix, and the transitions that leave it.
fn mode_roots(model: &Model, mode: usize) -> Vec<NodeId> {
    let mut roots = Vec::new();
    if let Some(m) = model.modes.get(mode) {
        roots.extend(&m.flow);
        roots.extend(m.mass.iter().flatten().flatten());
    }
    for transition in model.transitions.iter().filter(|t| t.from == mode) {
        roots.push(transition.guard);
        roots.extend(transition.when);
        roots.extend(&transition.reset);
        roots.extend(&transition.memory_reset);
    }
    roots
}

/// All expressions that are evaluated during a run.
fn equation_roots(model: &Model) -> Vec<NodeId> {
    let mut roots: Vec<NodeId> = (0..model.modes.len()).flat_map(|mode| mode_roots(model, mode)).collect();
    roots.extend(model.switches.iter().map(|s| s.expr));
    roots.extend(model.functionals.iter().map(|f| f.expr));
    roots
}

/// Switches that `roots` select on directly.
fn switches_of(graph: &Graph, roots: &[NodeId]) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    graph.visit(roots, |_, node| {
        if let Node::Select { switch, .. } = node {
            found.insert(switch);
        }
    });
    found
}

/// For each switch all other switches that its function depends on, directly or through others.
fn switch_closure(model: &Model) -> Result<Vec<BTreeSet<usize>>, String> {
    let mut closure: Vec<BTreeSet<usize>> =
        model.switches.iter().map(|s| switches_of(&model.graph, &[s.expr])).collect();
    // As many rounds as switches suffice: a longer chain would repeat a switch.
    for _ in 0..closure.len() {
        let before = closure.clone();
        for set in &mut closure {
            let more: Vec<usize> = set.iter().filter_map(|&s| before.get(s)).flatten().copied().collect();
            set.extend(more);
        }
        if before == closure {
            break;
        }
    }
    match closure.iter().enumerate().find(|(switch, set)| set.contains(switch)) {
        Some((switch, _)) => Err(format!(
            "the condition `{}` depends on itself; write it without the `if` that it decides",
            model.switches.get(switch).map_or("", |s| s.text.as_str())
        )),
        None => Ok(closure),
    }
}
