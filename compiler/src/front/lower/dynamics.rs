//! Modes with their flows, transitions with guards, conditions and resets.

use super::lowering::{Expected, Lowering};
use super::mass::Mass;
use super::scope::{Definition, Entity};
use super::value::{Place, Rates, Uses, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::names::suggest;
use crate::front::parser::shortened;
use crate::front::read::list;
use crate::front::spec::{Equation, Mode, Named, Spec, Transition};
use crate::front::syntax::ExprKind;
use crate::front::text::Text;
use crate::ir::{self, Binary, Node, NodeId, Symbol, Unary};
use crate::source::Span;

impl Lowering<'_> {
    /// Lowers `[modes]`.
    pub(super) fn modes(&mut self, spec: &Spec) {
        let has_state = self.states_of_modes(spec);
        for (mode, has_state) in spec.modes.iter().zip(has_state) {
            let mass = self.mass(mode, &has_state);
            let flow = self.flow(mode, &has_state, mass.as_ref());
            let mass = mass.map(|mass| mass.rows);
            self.model.modes.push(ir::Mode { name: mode.name.clone(), flow, mass, has_state });
        }
    }

    /// For each mode which states it has.
    fn states_of_modes(&mut self, spec: &Spec) -> Vec<Vec<bool>> {
        let mut has_state = vec![vec![true; spec.states.len()]; spec.modes.len()];
        for (i, state) in spec.states.iter().enumerate() {
            let Some(modes) = &state.value.modes else {
                continue;
            };
            has_state.iter_mut().filter_map(|mode| mode.get_mut(i)).for_each(|has| *has = false);
            for mode in modes {
                if let Some(has) = self.mode(spec, mode).and_then(|m| has_state.get_mut(m)?.get_mut(i)) {
                    *has = true;
                }
            }
        }
        has_state
    }

    pub(super) fn mode(&mut self, spec: &Spec, name: &Text) -> Option<usize> {
        let names: Vec<&str> = spec.modes.iter().map(|mode| mode.name.as_str()).collect();
        self.reference("mode", &name.value, name.span, &names)
    }

    /// The index of what a name refers to.
    pub(super) fn reference(&mut self, kind: &str, name: &str, span: Span, names: &[&str]) -> Option<usize> {
        if let Some(index) = names.iter().position(|other| *other == name) {
            return Some(index);
        }
        let help = match suggest(name, names.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None if names.is_empty() => format!("define a {kind} first"),
            None if names.len() == 1 => format!("the only {kind} is {}", list(names)),
            None => format!("the {kind}s are {}", list(names)),
        };
        let message = format!("there is no {kind} `{}`", shortened(name));
        self.diagnostics.push(Diagnostic::error(Code::UnknownReference, message).at(span, "").help(help));
        None
    }

    /// The state that an equation is for; reports one for anything else.
    pub(super) fn state_of(&mut self, equation: &Named<Equation>, what: &str) -> Option<usize> {
        self.state_named(&equation.name, equation.span, what)
    }

    /// The state of a name; `what` stands below it.
    pub(super) fn state_named(&mut self, name: &str, span: Span, what: &str) -> Option<usize> {
        match self.scope.get(name).map(|definition| definition.entity) {
            Some(Entity::State(i)) => Some(i),
            Some(entity) => {
                let message = format!("`{name}` is {}, so it has no {what}", entity.kind());
                let error = Diagnostic::error(Code::SuperfluousEquation, message).at(span, "");
                self.diagnostics.push(match entity {
                    Entity::Memory(_) => error.help("a memory changes in resets only"),
                    _ => error.help("only states have one"),
                });
                None
            }
            None => {
                let names: Vec<&str> = self.model.states.iter().map(|state| state.name.as_str()).collect();
                // A state whose name is not allowed has been reported; it is in the model all the same.
                if let Some(i) = names.iter().position(|other| *other == name) {
                    return Some(i);
                }
                let help = match suggest(name, names.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("the states are {}", list(&names)),
                };
                let message = format!("there is no state `{}`", shortened(name));
                self.diagnostics.push(Diagnostic::error(Code::UnknownReference, message).at(span, "").help(help));
                None
            }
        }
    }

    /// The dimension of a state, if its definition is not broken.
    pub(super) fn state_dimension(&self, state: usize) -> Option<Dimension> {
        let name = &self.model.states.get(state)?.name;
        self.scope.get(name).and_then(|definition: Definition| definition.dimension)
    }

    pub(super) fn state_name(&self, state: usize) -> String {
        self.model.states.get(state).map_or(String::new(), |state| state.name.clone())
    }

    /// Reports an equation for a state that the mode does not have.
    pub(super) fn absent(&mut self, equation: &Named<Equation>, mode: &str) {
        let message = format!("mode `{mode}` does not have the state `{}`", equation.name);
        let error = Diagnostic::error(Code::SuperfluousEquation, message).at(equation.span, "");
        self.diagnostics.push(error.help(format!("remove the equation, or add `{mode}` to the state's `modes`")));
    }

    fn flow(&mut self, item: &Named<Mode>, has_state: &[bool], mass: Option<&Mass>) -> Vec<NodeId> {
        let mode = item.name.as_str();
        let zero = self.model.graph.constant(0.0);
        let mut flow = vec![zero; has_state.len()];
        let mut given = vec![false; has_state.len()];
        for equation in &item.value.flow {
            let state = self.state_of(equation, "flow");
            let row = state.and_then(|i| mass?.dimensions.get(i).copied().flatten());
            let help = match row {
                Some(_) => "a row of the mass matrix times the rates has the dimension of its flow",
                None => "a flow is the state's rate of change: its unit divided by seconds",
            };
            let identity = || state.and_then(|i| self.state_dimension(i)?.div(Dimension::TIME));
            let expected = Expected {
                dimension: row.unwrap_or_else(identity),
                what: format!("the flow of `{}`", equation.name),
                help: help.to_owned(),
            };
            let value = self.checked(&equation.value, Place::Flow, &expected);
            let Some(i) = state else { continue };
            if has_state.get(i) == Some(&false) {
                self.absent(equation, mode);
            }
            given[i] = true;
            flow[i] = value.map_or(zero, |value| value.node);
            let what = format!("the flow of `{}`", equation.name);
            self.only_states_of((mode, has_state), flow[i], &equation.value, &what);
        }
        for i in (0..has_state.len()).filter(|&i| has_state[i] && !given[i]) {
            let name = self.state_name(i);
            let message = format!("mode `{mode}` has no flow for the state `{name}`");
            let error = Diagnostic::error(Code::MissingEquation, message).at(item.span, "");
            let help = format!("add `{name} = \"...\"` to [modes.{mode}.flow], `\"0\"` if it stays constant");
            self.diagnostics.push(error.help(help));
        }
        flow
    }

    /// Lowers `[transitions]`.
    pub(super) fn transitions(&mut self, spec: &Spec) {
        for item in &spec.transitions {
            let Transition { from, to, guard, direction, when, reset, also_zero: _, doc: _ } = &item.value;
            let from = from.as_ref().and_then(|name| self.mode(spec, name));
            let to = to.as_ref().and_then(|name| self.mode(spec, name));
            let has_mass = from.and_then(|from| self.model.modes.get(from)).is_some_and(|mode| mode.mass.is_some());
            let rates = if has_mass { Rates::Unknown } else { Rates::Known };
            let guard_text = guard.as_ref().map_or(String::new(), |guard| guard.text.value.trim().to_owned());
            let guard = guard.as_ref().and_then(|guard| self.guard(guard, rates));
            let when = when.as_ref().and_then(|when| self.condition(when, Place::When(rates)));
            let has_state = to.and_then(|to| self.model.modes.get(to)).map(|mode| mode.has_state.clone());
            let (reset, memory_reset) = self.reset(item, reset, has_state.as_deref(), rates);
            let zero = self.model.graph.constant(0.0);
            self.model.transitions.push(ir::Transition {
                name: item.name.clone(),
                surface: false,
                from: from.unwrap_or(0),
                to: to.unwrap_or(0),
                guard: guard.map_or(zero, |value| value.node),
                guard_text,
                guard_dimension: guard.and_then(|value| value.dimension).unwrap_or(Dimension::NONE),
                direction: direction.unwrap_or(ir::Direction::Either),
                when: when.map(|value| value.node),
                reset,
                memory_reset,
                also_zero: Vec::new(),
            });
            if let Some(from) = from {
                self.leaves_with(item, from);
            }
        }
    }

    pub(super) fn guard(&mut self, guard: &Equation, rates: Rates) -> Option<Value> {
        if self.is_condition(guard) {
            return None;
        }
        let value = self.equation(guard, Place::Event(rates))?;
        self.moves(value, guard, "this guard").then_some(value)
    }

    /// Whether a guard is a condition, where a number that passes through zero is expected; reports one that is.
    fn is_condition(&mut self, guard: &Equation) -> bool {
        let root = guard.expression.as_ref().map(|expression| &expression.root);
        let Some(root) =
            root.filter(|root| matches!(root.kind, ExprKind::Compare(..) | ExprKind::Logic(..) | ExprKind::Not(_)))
        else {
            return false;
        };
        let error = Diagnostic::error(Code::Condition, "a guard is a number that passes through zero, not a condition");
        let help = match &root.kind {
            ExprKind::Compare(comparison, a, b) => {
                let direction = if comparison.is_less() { "falling" } else { "rising" };
                let [a, b] = [a, b].map(|side| self.sources.slice(side.span));
                match b.trim() {
                    "0" => format!("write `{}` with `direction = \"{direction}\"`", shortened(a)),
                    b => format!("write `{} - ({})` with `direction = \"{direction}\"`", shortened(a), shortened(b)),
                }
            }
            _ => "write what vanishes when it happens, as in `length - reach`, and the conditions in `when`".to_owned(),
        };
        self.diagnostics.push(error.at(root.span, "").help(help));
        true
    }

    /// Whether a function that is to pass through zero depends on state or time; reports one that does not.
    pub(super) fn moves(&mut self, value: Value, guard: &Equation, what: &str) -> bool {
        if value.uses.any(Uses::STATE.and(Uses::TAU).and(Uses::TIME)) {
            return true;
        }
        let message = format!("{what} depends on neither state nor time, so it never passes through zero");
        let error = Diagnostic::error(Code::GuardConstant, message).at(self.root_span(guard), "");
        self.diagnostics.push(error.help("write what vanishes when the transition happens, as in `length - reach`"));
        false
    }

    /// A condition as a margin.
    fn condition(&mut self, condition: &Equation, place: Place) -> Option<Value> {
        let expression = condition.expression.as_ref()?;
        self.lower_lets(&expression.names, place);
        self.margin(&expression.root, place)
    }

    /// Post-values of states and memory. Without `has_state` the target mode is not known.
    fn reset(
        &mut self,
        item: &Named<Transition>,
        equations: &[Named<Equation>],
        has_state: Option<&[bool]>,
        rates: Rates,
    ) -> (Vec<NodeId>, Vec<NodeId>) {
        let zero = self.model.graph.constant(0.0);
        let mut reset = vec![zero; self.model.states.len()];
        let mut given = vec![false; reset.len()];
        let mut memory: Vec<NodeId> =
            (0..self.model.memory.len()).map(|i| self.model.graph.symbol(Symbol::Memory(i))).collect();
        for equation in equations {
            if let Some(Definition { entity: Entity::Memory(i), .. }) = self.scope.get(&equation.name) {
                if let Some(node) = self.memory_reset(equation, rates) {
                    memory[i] = node;
                }
                continue;
            }
            let state = self.state_of(equation, "reset");
            let expected = Expected {
                dimension: state.and_then(|i| self.state_dimension(i)),
                what: format!("the reset of `{}`", equation.name),
                help: "a reset gives the state's value after the transition, in its own unit".to_owned(),
            };
            let value = self.checked(&equation.value, Place::Event(rates), &expected);
            let Some(i) = state else { continue };
            if has_state.is_some_and(|has| has.get(i) == Some(&false)) {
                let target = item.value.to.as_ref().map_or("", |to| to.value.as_str());
                self.absent(equation, target);
            }
            given[i] = true;
            reset[i] = value.map_or(zero, |value| value.node);
        }
        let has_state = has_state.unwrap_or(&[]);
        for i in (0..has_state.len()).filter(|&i| has_state[i] && !given[i]) {
            self.no_reset(item, i);
        }
        (reset, memory)
    }

    fn no_reset(&mut self, item: &Named<Transition>, state: usize) {
        let name = self.state_name(state);
        let message = format!("transition `{}` has no reset for the state `{name}`", item.name);
        let error = Diagnostic::error(Code::MissingEquation, message).at(item.span, "");
        let from = item.value.from.as_ref().map_or("", |from| from.value.as_str());
        let source = self.model.modes.iter().find(|mode| mode.name == from);
        let help = if source.is_some_and(|mode| mode.has_state.get(state) == Some(&false)) {
            format!("add `{name} = \"...\"` to [transitions.{}.reset]: mode `{from}` does not have it", item.name)
        } else {
            format!("add `{name} = \"{name}\"` to [transitions.{}.reset] to keep it", item.name)
        };
        self.diagnostics.push(error.help(help));
    }

    fn memory_reset(&mut self, equation: &Named<Equation>, rates: Rates) -> Option<NodeId> {
        let what = format!("the memory `{}`", equation.name);
        let expected =
            Expected { dimension: Some(Dimension::NONE), what, help: "a memory is a whole number".to_owned() };
        let value = self.checked(&equation.value, Place::Event(rates), &expected)?;
        if self.is_whole(value.node) {
            return Some(value.node);
        }
        let message = format!("the memory `{}` would not stay a whole number", equation.name);
        let error = Diagnostic::error(Code::MemoryNotInteger, message).at(self.root_span(&equation.value), "");
        let help = "use memory, whole numbers, `+`, `-`, `*` and `if`; a real memory is a state with zero flow";
        self.diagnostics.push(error.help(help));
        None
    }

    /// Whether a node is a whole number whenever the memory is.
    pub(super) fn is_whole(&self, root: NodeId) -> bool {
        let graph = &self.model.graph;
        let mut whole = true;
        graph.visit(&[root], |_, node| {
            whole &= match node {
                Node::Constant(bits) => f64::from_bits(bits).fract() == 0.0,
                Node::Symbol(symbol) => matches!(symbol, Symbol::Memory(_)),
                Node::Unary(op, _) => op == Unary::Neg,
                Node::Binary(Binary::Pow, _, exponent) => graph.constant_value(exponent).is_some_and(|e| e >= 0.0),
                Node::Binary(op, ..) => matches!(op, Binary::Add | Binary::Sub | Binary::Mul),
                Node::Select { .. } => true,
                Node::Choose { .. } | Node::Partial(..) => false,
            };
        });
        whole
    }
}
