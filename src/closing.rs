//! Whether a gait closes in all states, not in the section's coordinates alone: the embedding says what the other states are
//! on the section, and the motion has to lead them back there.
//!
//! A state that nothing else depends on, as the place of a runner, may end anywhere.

use gaitc_compiler::front::format_si;
use gaitc_compiler::ir::{Model, Node, NodeId, Symbol};

/// Differences below this part of a state's size are those of integration.
const CLOSED: f64 = 1e-6;

/// What to say of each state that is not led back: from `first` to `end`, the states on the section at both ends of the map (SI
/// units, one a state of the model).
pub fn open_states(spec: &Model, first: &[f64], end: &[f64]) -> Vec<String> {
    let Some(section) = &spec.section else { return Vec::new() };
    let has_state = section.mode(&spec.transitions).and_then(|mode| spec.modes.get(mode)).map(|mode| &mode.has_state);
    let mut said = Vec::new();
    for (i, state) in spec.states.iter().enumerate() {
        let (Some(start), Some(end)) = (first.get(i), end.get(i)) else { continue };
        let there = has_state.is_none_or(|has| has.get(i) != Some(&false));
        let closed = (end - start).abs() <= CLOSED * (1.0 + start.abs().max(end.abs()));
        if !there || closed || section.coordinates.contains(&i) || !matters(spec, i) {
            continue;
        }
        let [start, end] = [*start, *end].map(|value| format_si(value, state.dimension));
        said.push(format!(
            "`{}` begins at {start} and ends at {end}: the section's coordinates repeat, this state does not; its \
             embedding does not say what the motion makes of it",
            state.name
        ));
    }
    said
}

/// Whether anything but the state itself depends on it.
fn matters(spec: &Model, state: usize) -> bool {
    let others = |rows: &[NodeId]| -> Vec<NodeId> {
        rows.iter().enumerate().filter(|(i, _)| *i != state).map(|(_, &row)| row).collect()
    };
    let mut roots: Vec<NodeId> = Vec::new();
    for mode in &spec.modes {
        roots.extend(&mode.flow);
        roots.extend(mode.mass.iter().flatten().flatten());
    }
    for transition in &spec.transitions {
        roots.extend(transition.when.into_iter().chain([transition.guard]));
        roots.extend(others(&transition.reset));
        roots.extend(&transition.memory_reset);
    }
    roots.extend(spec.switches.iter().map(|switch| switch.expr));
    let mut found = false;
    spec.graph.visit(&roots, |_, node| found |= node == Node::Symbol(Symbol::State(state)));
    found
}
