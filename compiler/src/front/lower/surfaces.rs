//! Surfaces inside modes, on which a section can stand: transitions of a mode to itself that change nothing. Their clock
//! starts again at 0 all the same, which `clock` keeps from mattering.

use super::lowering::Lowering;
use super::value::Rates;
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::spec::{Named, Spec, Surface};
use crate::ir::{self, NodeId, Symbol};

impl Lowering<'_> {
    /// Lowers `[surfaces]`. They stand behind the transitions, which come first where several happen at once.
    pub(super) fn surfaces(&mut self, spec: &Spec) {
        for item in &spec.surfaces {
            if let Some(first) = spec.transitions.iter().find(|transition| transition.name == item.name) {
                let message = format!("a transition is named `{}` as well", item.name);
                let error = Diagnostic::error(Code::DefinedTwice, message).at(item.span, "");
                self.diagnostics.push(error.see(first.span, "the transition").help("rename one of the two"));
            }
            self.surface(spec, item);
        }
    }

    fn surface(&mut self, spec: &Spec, item: &Named<Surface>) {
        let Surface { mode, guard, direction, doc: _ } = &item.value;
        let mode = mode.as_ref().and_then(|name| self.mode(spec, name));
        let has_mass = mode.and_then(|mode| self.model.modes.get(mode)).is_some_and(|mode| mode.mass.is_some());
        let rates = if has_mass { Rates::Unknown } else { Rates::Known };
        let guard_text = guard.as_ref().map_or(String::new(), |guard| guard.text.value.trim().to_owned());
        let value = guard.as_ref().and_then(|guard| self.guard(guard, rates));
        let zero = self.model.graph.constant(0.0);
        let states: Vec<NodeId> =
            (0..self.model.states.len()).map(|i| self.model.graph.symbol(Symbol::State(i))).collect();
        let memory_reset = (0..self.model.memory.len()).map(|i| self.model.graph.symbol(Symbol::Memory(i))).collect();
        let has_state = mode.and_then(|mode| self.model.modes.get(mode)).map_or(&[][..], |mode| &mode.has_state);
        let keep = |(i, state): (usize, NodeId)| if has_state.get(i) == Some(&true) { state } else { zero };
        let reset = states.into_iter().enumerate().map(keep).collect();
        if let (Some(mode), Some(value), Some(guard)) = (mode, value, guard) {
            let (has, name) =
                (has_state.to_vec(), self.model.modes.get(mode).map_or(String::new(), |m| m.name.clone()));
            let what = format!("the guard of surface `{}`", item.name);
            self.only_states_of((&name, &has), value.node, guard, &what);
        }
        self.model.transitions.push(ir::Transition {
            name: item.name.clone(),
            surface: true,
            from: mode.unwrap_or(0),
            to: mode.unwrap_or(0),
            guard: value.map_or(zero, |value| value.node),
            guard_text,
            guard_dimension: value.and_then(|value| value.dimension).unwrap_or(Dimension::NONE),
            direction: direction.unwrap_or(ir::Direction::Either),
            when: None,
            reset,
            memory_reset,
            also_zero: Vec::new(),
        });
    }
}
