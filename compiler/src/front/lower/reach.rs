//! Which modes a run goes through: it begins at the section, and has to come back to it.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::{self, Spec};
use crate::ir::Model;

/// Checks the modes of a spec without errors; one without a section has no runs that begin somewhere.
pub(super) fn check(spec: &Spec, model: &Model, diagnostics: &mut Vec<Diagnostic>) {
    let Some((section, after)) = model.section.as_ref().and_then(|s| Some((s, model.transitions.get(s.transition)?)))
    else {
        return;
    };
    let reached = reached_from(model, after.to);
    let mode = |i: usize| model.modes.get(i).map_or("", |mode| mode.name.as_str());
    if !reached.get(after.from).copied().unwrap_or(false) {
        let name = model.transitions.get(section.transition).map_or("", |transition| transition.name.as_str());
        let place = spec.section.as_ref().and_then(|section| section.anchor.as_ref()).map(spec::Anchor::name);
        let message = "no run that begins on the section comes back to it";
        let error = Diagnostic::error(Code::NoReturn, message);
        let label = format!(
            "`{name}` leads to mode `{}`, from which nothing leads to mode `{}`",
            mode(after.to),
            mode(after.from)
        );
        let error = place.map_or(error.clone(), |place| error.at(place.span, label));
        diagnostics.push(error.help(format!(
            "add transitions that lead from `{}` to `{}`",
            mode(after.to),
            mode(after.from)
        )));
        return;
    }
    for (item, _) in spec.modes.iter().zip(&reached).filter(|(_, reached)| !**reached) {
        let message = format!("no run reaches the mode `{}`", item.name);
        let warning = Diagnostic::warning(Code::Unreachable, message).at(item.span, "");
        diagnostics.push(warning.help("add a transition that enters it from a mode that is reached, or remove it"));
    }
}

/// The modes that transitions lead to from `start`, itself included.
fn reached_from(model: &Model, start: usize) -> Vec<bool> {
    let mut reached = vec![false; model.modes.len()];
    let mut open = vec![start];
    while let Some(mode) = open.pop() {
        let Some(slot) = reached.get_mut(mode).filter(|reached| !**reached) else { continue };
        *slot = true;
        open.extend(model.transitions.iter().filter(|t| t.from == mode).map(|t| t.to));
    }
    reached
}
