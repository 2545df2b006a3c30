//! Where the clock `tau` is not known: on a section it starts at 0 with the reset of a transition. A section on a surface, and
//! one before a transition, begins in the middle of a mode, where tau would be a coordinate of its own.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::{Anchor, Equation, Spec};
use crate::ir::{Model, Node, NodeId, Symbol, Transition};
use crate::source::Span;
use std::collections::BTreeSet;

/// Checks a spec without errors.
pub(super) fn check(spec: &Spec, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let surfaces = model.transitions.iter().filter(|transition| transition.surface);
    for (surface, item) in surfaces.zip(&spec.surfaces) {
        if let Some(what) = uses_in_mode(spec, model, surface.from) {
            let message = format!("{} uses `tau`, which is not known on the surface `{}`", what.text, item.name);
            report(message, what.span, (item.span, "this surface lies in the same mode"), diagnostics);
        }
    }
    let Some((Some(Anchor::Before(name)), section)) =
        spec.section.as_ref().map(|section| section.anchor.as_ref()).zip(model.section.as_ref())
    else {
        return;
    };
    let (Some(transition), Some(item)) =
        (model.transitions.get(section.transition), spec.transitions.get(section.transition))
    else {
        return;
    };
    if depends_on_tau(model, &resets(transition)) {
        let span = item.value.reset.iter().find_map(|reset| mentions(&reset.value)).unwrap_or(item.span);
        let message = format!("the reset of `{}` uses `tau`, which is not known on the section before it", item.name);
        report(message, span, (name.span, "the section"), diagnostics);
    }
}

fn report(message: String, span: Span, (place, label): (Span, &str), diagnostics: &mut Vec<Diagnostic>) {
    let error = Diagnostic::error(Code::ClockOnSection, message).at(span, "").see(place, label);
    let help = "make the time a state: `phase = { unit = \"s\" }` with the flow `phase = \"1\"` and the reset `phase = \"0\"`, \
                and let the section say what it is";
    diagnostics.push(error.help(help));
}

/// An equation in words and its place.
struct Use {
    text: String,
    span: Span,
}

/// Something computed in a mode that depends on tau.
fn uses_in_mode(spec: &Spec, model: &Model, index: usize) -> Option<Use> {
    let (mode, item) = (model.modes.get(index)?, spec.modes.get(index)?);
    let rows = mode.mass.iter().flatten().flatten();
    if depends_on_tau(model, &mode.flow.iter().chain(rows).copied().collect::<Vec<_>>()) {
        let span = item.value.flow.iter().find_map(|flow| mentions(&flow.value)).unwrap_or(item.span);
        return Some(Use { text: format!("the motion in mode `{}`", item.name), span });
    }
    let leaving = model.transitions.iter().zip(&spec.transitions).filter(|(transition, _)| transition.from == index);
    for (transition, item) in leaving {
        let mut roots = resets(transition);
        roots.extend(transition.when.into_iter().chain([transition.guard]));
        if depends_on_tau(model, &roots) {
            let equations = item.value.guard.iter().chain(&item.value.when);
            let equations = equations.chain(item.value.reset.iter().map(|reset| &reset.value));
            let span = equations.into_iter().find_map(mentions).unwrap_or(item.span);
            return Some(Use { text: format!("the transition `{}`", item.name), span });
        }
    }
    let measured: Vec<NodeId> = model.functionals.iter().map(|functional| functional.expr).collect();
    if !depends_on_tau(model, &measured) {
        return None;
    }
    let equations = spec.measures.iter().filter_map(|item| item.value.expr.as_ref());
    let span = equations.into_iter().find_map(mentions).or_else(|| spec.measures.first().map(|item| item.span))?;
    Some(Use { text: "a measure".to_owned(), span })
}

fn resets(transition: &Transition) -> Vec<NodeId> {
    transition.reset.iter().chain(&transition.memory_reset).copied().collect()
}

/// Whether any of `roots` depends on tau, through conditions too.
pub(super) fn depends_on_tau(model: &Model, roots: &[NodeId]) -> bool {
    let (mut open, mut seen, mut found) = (roots.to_vec(), BTreeSet::new(), false);
    while let Some(root) = open.pop() {
        model.graph.visit(&[root], |_, node| match node {
            Node::Symbol(Symbol::Tau) => found = true,
            Node::Select { switch, .. } if seen.insert(switch) => {
                open.extend(model.switches.get(switch).map(|switch| switch.expr));
            }
            _ => {}
        });
    }
    found
}

/// The place of an expression that names tau itself, not through a let.
fn mentions(equation: &Equation) -> Option<Span> {
    let expression = equation.expression.as_ref()?;
    expression.names.iter().any(|name| name.name == "tau").then_some(expression.root.span)
}
