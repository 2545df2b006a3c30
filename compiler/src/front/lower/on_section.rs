//! Whether the embedding lies on the section, as far as that can be seen without a run: where the section stands before a
//! transition or on a surface, the guard is zero on it; where it stands after a transition, a state to which the reset gives
//! a value of its own has that value, and the guard is still zero if the reset keeps what it depends on.

use super::clock::depends_on_tau;
use super::sample;
use super::section::advice_off_guard;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::format_si;
use crate::front::spec::{Anchor, Equation, Spec};
use crate::ir::eval::{Environment, value};
use crate::ir::{Binary, Model, Node, NodeId, Section, Symbol};
use crate::source::Span;

/// Differences below this part of the values are rounding.
const ROUNDING: f64 = 1e-9;
/// Units in the last place of the largest term that a sum may be off.
const UNITS: f64 = 1e3;

/// Checks a spec without errors.
pub(super) fn check(spec: &Spec, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let (Some(section), Some(written)) = (&model.section, &spec.section) else { return };
    let Some(transition) = model.transitions.get(section.transition) else { return };
    if matches!(written.anchor, Some(Anchor::After(_))) {
        let before = diagnostics.len();
        for state in 0..model.states.len() {
            after(spec, model, section, state, diagnostics);
        }
        if diagnostics.len() > before || !keeps_guard(model, section) {
            return;
        }
    }
    let Some((n, off)) = off_the_guard(model, section, transition.guard) else { return };
    let message = format!("the embedding does not lie on the section: `{}` is not zero there", transition.guard_text);
    let states = sample::on_section(model, section, n);
    let at: Vec<String> = section.coordinates.iter().filter_map(|&i| describe(model, i, states.get(i))).collect();
    let at = if at.is_empty() { "there".to_owned() } else { format!("at {}", at.join(", ")) };
    let label = format!("{at} it is {}", format_si(off, transition.guard_dimension));
    let error =
        Diagnostic::error(Code::OffSection, message).at(guard_span(spec, section).unwrap_or(written.span), label);
    let error = written.embed.first().map_or(error.clone(), |embed| error.see(embed.span, "the embedding"));
    diagnostics.push(error.help(advice_off_guard(model, section, transition.guard)));
}

fn describe(model: &Model, state: usize, value: Option<&f64>) -> Option<String> {
    let state = model.states.get(state)?;
    Some(format!("{} = {}", state.name, format_si(*value?, state.dimension)))
}

/// The guard at which the section stands, as it is written.
fn guard_span(spec: &Spec, section: &Section) -> Option<Span> {
    let surface = section.transition.checked_sub(spec.transitions.len()).and_then(|i| spec.surfaces.get(i));
    let guard = match surface {
        Some(surface) => surface.value.guard.as_ref(),
        None => spec.transitions.get(section.transition)?.value.guard.as_ref(),
    };
    guard.map(|guard| guard.text.span)
}

/// A point of the section where a guard is not zero, and its value there.
fn off_the_guard(model: &Model, section: &Section, guard: NodeId) -> Option<(u32, f64)> {
    // Through conditions it is not followed, and the clock is not known.
    let frozen = |root| {
        let mut found = false;
        model.graph.visit(&[root], |_, node| found |= matches!(node, Node::Select { .. } | Node::Symbol(Symbol::Time)));
        found
    };
    if frozen(guard) || depends_on_tau(model, &[guard]) {
        return None;
    }
    let parameters = sample::parameters(model);
    let memory: Vec<f64> = model.memory.iter().map(|memory| memory.initial as f64).collect();
    let of = |states: &[f64]| {
        let at = Environment { states, parameters: &parameters, memory: &memory, ..Environment::default() };
        value(&model.graph, guard, &at)
    };
    // How large the guard is elsewhere tells what is zero, and how large its terms are what is rounding.
    let elsewhere = (0..sample::POINTS).map(|n| of(&sample::around_section(model, section, n)).abs());
    let size = elsewhere.filter(|size| size.is_finite()).fold(0.0, f64::max);
    (0..sample::POINTS).find_map(|n| {
        let states = sample::on_section(model, section, n);
        let at = Environment { states: &states, parameters: &parameters, memory: &memory, ..Environment::default() };
        let off = of(&states);
        let rounding = UNITS * f64::EPSILON * largest_term(model, guard, &at);
        (off.is_finite() && off.abs() > ROUNDING * size + rounding).then_some((n, off))
    })
}

/// The largest magnitude among the operands of an expression's sums.
fn largest_term(model: &Model, root: NodeId, at: &Environment<'_>) -> f64 {
    let mut terms = Vec::new();
    model.graph.visit(&[root], |_, node| {
        if let Node::Binary(Binary::Add | Binary::Sub, a, b) = node {
            terms.extend([a, b]);
        }
    });
    terms
        .into_iter()
        .map(|term| value(&model.graph, term, at).abs())
        .filter(|size| size.is_finite())
        .fold(0.0, f64::max)
}

/// Whether the reset of the section's transition, and the symmetry, keep every state that the guard depends on: then it is
/// zero after the transition as well. Where the guard is one of coordinates alone no embedding contradicts it: there are more
/// coordinates than needed, and each map comes back to the section.
fn keeps_guard(model: &Model, section: &Section) -> bool {
    let Some(transition) = model.transitions.get(section.transition) else { return false };
    let is_state = |root: Option<&NodeId>, i: usize| {
        root.is_some_and(|&root| model.graph.node(root) == Node::Symbol(Symbol::State(i)))
    };
    let (mut keeps, mut embedded) = (true, false);
    model.graph.visit(&[transition.guard], |_, node| match node {
        Node::Symbol(Symbol::State(i)) => {
            embedded |= !section.coordinates.contains(&i);
            keeps &= is_state(transition.reset.get(i), i);
            keeps &= section.symmetry.as_ref().is_none_or(|symmetry| is_state(symmetry.get(i), i));
        }
        // The memory has moved on.
        Node::Symbol(Symbol::Memory(_) | Symbol::Rate(_)) => keeps = false,
        _ => {}
    });
    keeps && embedded
}

/// Compares a state's embedding with its reset, where that depends on parameters alone.
fn after(spec: &Spec, model: &Model, section: &Section, state: usize, diagnostics: &mut Vec<Diagnostic>) {
    let Some(transition) = model.transitions.get(section.transition) else { return };
    let has = model.modes.get(transition.to).and_then(|mode| mode.has_state.get(state)) == Some(&true);
    let (Some(&reset), Some(&embed)) = (transition.reset.get(state), section.embed.get(state)) else { return };
    let image =
        section.symmetry.as_ref().and_then(|symmetry| symmetry.get(state)).map(|&image| model.graph.node(image));
    let mirrored = image.is_some_and(|image| image != Node::Symbol(Symbol::State(state)));
    if !has || mirrored || section.coordinates.contains(&state) || !of_parameters(model, reset) {
        return;
    }
    let parameters = sample::parameters(model);
    let of = |root, states: &[f64]| {
        let at = Environment { states, parameters: &parameters, ..Environment::default() };
        value(&model.graph, root, &at)
    };
    let made = of(reset, &[]);
    let embedded = (0..sample::POINTS).map(|n| of(embed, &sample::on_section(model, section, n)));
    let differs = |value: &f64| (value - made).abs() > ROUNDING * (value.abs().max(made.abs()));
    let Some(other) = embedded.filter(|value| value.is_finite()).find(differs) else { return };
    let (Some(state), Some(written)) = (model.states.get(state), &spec.section) else { return };
    let message =
        format!("the embedding of `{}` is not what the reset of `{}` makes of it", state.name, transition.name);
    let at = |equations: &[crate::front::spec::Named<Equation>]| {
        equations.iter().find(|equation| equation.name == state.name).map(|equation| equation.value.text.span)
    };
    let [made, other] = [made, other].map(|value| format_si(value, state.dimension));
    let error = Diagnostic::error(Code::OffSection, message)
        .at(at(&written.embed).unwrap_or(written.span), format!("this is {other} ..."));
    let reset = spec.transitions.get(section.transition).and_then(|item| at(&item.value.reset));
    let error = reset.map_or(error.clone(), |span| error.see(span, format!("... and this {made}")));
    diagnostics.push(error.help("the section stands just after the transition: write the same in both places"));
}

/// Whether an expression depends on parameters alone.
fn of_parameters(model: &Model, root: NodeId) -> bool {
    let mut only = true;
    model.graph.visit(&[root], |_, node| {
        only &= match node {
            Node::Symbol(symbol) => matches!(symbol, Symbol::Parameter(_)),
            Node::Select { .. } => false,
            _ => true,
        };
    });
    only
}
