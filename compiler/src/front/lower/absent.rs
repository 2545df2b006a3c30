//! States that belong to some modes only: what is computed in a mode uses the states of that mode.

use super::lowering::Lowering;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::{Equation, Named, Transition};
use crate::ir::{Node, NodeId, Symbol};
use std::collections::BTreeSet;

impl Lowering<'_> {
    /// Reports the first state that an equation uses and the mode where it is computed does not have; `what` is the
    /// equation in words, `has_state` the states of the mode.
    pub(super) fn only_states_of(
        &mut self,
        (mode, has_state): (&str, &[bool]),
        node: NodeId,
        equation: &Equation,
        what: &str,
    ) {
        let Some(state) = self.used(node, has_state) else { return };
        let name = self.state_name(state);
        let message = format!("{what} uses the state `{name}`, which mode `{mode}` does not have");
        let error = Diagnostic::error(Code::NotAvailable, message).at(self.root_span(equation), "");
        self.diagnostics.push(error.help(format!("write it without `{name}`, or add `{mode}` to the state's `modes`")));
    }

    /// Reports states that guard, condition and resets of the last transition use and the mode `from`, which it leaves,
    /// does not have.
    pub(super) fn leaves_with(&mut self, item: &Named<Transition>, from: usize) {
        let Some(transition) = self.model.transitions.last() else { return };
        let mut uses: Vec<(NodeId, &Equation, String)> = Vec::new();
        uses.extend(item.value.guard.iter().map(|guard| (transition.guard, guard, "this guard".to_owned())));
        let when = transition.when.zip(item.value.when.as_ref());
        uses.extend(when.map(|(node, when)| (node, when, "this condition".to_owned())));
        for reset in &item.value.reset {
            let state = self.model.states.iter().position(|state| state.name == reset.name);
            let node = state.and_then(|state| transition.reset.get(state));
            uses.extend(node.map(|&node| (node, &reset.value, format!("the reset of `{}`", reset.name))));
        }
        let Some(mode) = self.model.modes.get(from).cloned() else { return };
        for (node, equation, what) in uses {
            self.only_states_of((&mode.name, &mode.has_state), node, equation, &what);
        }
    }

    /// A state that is not there and that a node depends on, conditions included.
    pub(super) fn used(&self, node: NodeId, has_state: &[bool]) -> Option<usize> {
        if has_state.iter().all(|has| *has) {
            return None;
        }
        let (mut open, mut seen, mut found) = (vec![node], BTreeSet::new(), None);
        while let Some(root) = open.pop() {
            self.model.graph.visit(&[root], |_, node| match node {
                Node::Symbol(Symbol::State(i) | Symbol::Rate(i)) if has_state.get(i) == Some(&false) => {
                    found = found.or(Some(i));
                }
                Node::Select { switch, .. } if seen.insert(switch) => {
                    open.extend(self.model.switches.get(switch).map(|switch| switch.expr));
                }
                _ => {}
            });
        }
        found
    }
}
