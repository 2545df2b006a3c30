//! Joining a spec with a part: each table of the part behind that of its user. Names that clash are found when all
//! parts are there and names are resolved; here only what no expression can name is looked at.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::{Drawing, Mode, Named, Spec};

/// Appends the tables of `part` to those of `owner`.
pub(super) fn join(owner: &mut Spec, part: Spec, diagnostics: &mut Vec<Diagnostic>) {
    owner.parameters.extend(part.parameters);
    owner.states.extend(part.states);
    owner.memory.extend(part.memory);
    owner.lets.extend(part.lets);
    owner.functions.extend(part.functions);
    owner.measures.extend(part.measures);
    owner.fixed.extend(part.fixed);
    for mode in part.modes {
        match owner.modes.iter_mut().find(|other| other.name == mode.name) {
            Some(other) => join_modes(other, mode, diagnostics),
            None => owner.modes.push(mode),
        }
    }
    add(&mut owner.problems, part.problems, "problem", diagnostics);
    add(&mut owner.published, part.published, "publication", diagnostics);
    match (&mut owner.drawing, part.drawing) {
        (Some(drawing), Some(more)) => join_drawings(drawing, more, diagnostics),
        (None, more) => owner.drawing = more,
        (Some(_), None) => {}
    }
}

/// The equations of one mode that stand in two files.
fn join_modes(owner: &mut Named<Mode>, part: Named<Mode>, diagnostics: &mut Vec<Diagnostic>) {
    add(&mut owner.value.flow, part.value.flow, &format!("flow in mode `{}`", part.name), diagnostics);
    add(
        &mut owner.value.mass,
        part.value.mass,
        &format!("row of the mass matrix of mode `{}`", part.name),
        diagnostics,
    );
}

/// What two files say of how the machine is drawn.
fn join_drawings(owner: &mut Drawing, part: Drawing, diagnostics: &mut Vec<Diagnostic>) {
    if owner.velocity.is_some() && part.velocity.is_some() {
        let message = "two files say how the body moves in the drawing";
        let error = Diagnostic::error(Code::DefinedTwice, message).at(part.span, "");
        diagnostics.push(error.see(owner.span, "first one").help("keep one `velocity`"));
    }
    owner.velocity = owner.velocity.take().or(part.velocity);
    add(&mut owner.points, part.points, POINT, diagnostics);
    owner.links.extend(part.links);
    owner.panels.extend(part.panels);
}

/// What a drawing has.
const POINT: &str = "drawn point";

/// Appends items, and reports those whose name is there already.
fn add<T>(items: &mut Vec<Named<T>>, more: Vec<Named<T>>, what: &str, diagnostics: &mut Vec<Diagnostic>) {
    for item in more {
        if let Some(first) = items.iter().find(|first| first.name == item.name) {
            let message = format!("`{}` has more than one {what}", item.name);
            let message = match what {
                "problem" | "publication" | POINT => format!("two {what}s are named `{}`", item.name),
                _ => message,
            };
            let error = Diagnostic::error(Code::DefinedTwice, message).at(item.span, "");
            diagnostics.push(error.see(first.span, "first one").help("remove one of the two"));
            continue;
        }
        items.push(item);
    }
}
