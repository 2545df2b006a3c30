//! The graph of modes and transitions: as a list of arrows, and in the DOT language of Graphviz.

use super::escape::{dot, plain};
use super::sheet::{Sheet, Transition};

/// One arrow a line.
pub(super) fn text(sheet: &Sheet) -> String {
    let mut out = String::new();
    for transition in &sheet.transitions {
        let mark = if is_section(sheet, transition) { "  (section)" } else { "" };
        let Transition { name, from, to, .. } = transition;
        out += &format!("{from} --{name}--> {to}   when {}{mark}\n", condition(transition));
    }
    for surface in &sheet.surfaces {
        let mark = if is_at(sheet, &surface.name) { "  (section)" } else { "" };
        let guard = plain(&format!("{} {}", surface.guard.text, direction(surface.direction)));
        out += &format!("{}: surface {} where {guard}{mark}\n", surface.mode, surface.name);
    }
    if sheet.transitions.is_empty() {
        out += &sheet.modes.iter().map(|mode| format!("{}\n", mode.name)).collect::<String>();
    }
    out
}

/// Modes as boxes, transitions as edges with name and guard; that of the section is bold.
pub(super) fn graphviz(sheet: &Sheet) -> String {
    let mut out = format!("digraph \"{}\" {{\n", dot(&sheet.model));
    if !sheet.title.is_empty() {
        out += &format!("  label=\"{}\";\n", dot(&sheet.title));
    }
    out += "  node [shape=box, style=rounded];\n";
    for mode in &sheet.modes {
        out += &format!("  \"{}\";\n", dot(&mode.name));
    }
    for transition in &sheet.transitions {
        let section = is_section(sheet, transition);
        let (mark, style) = if section { ("\\nsection", ", style=bold") } else { ("", "") };
        let label = format!("{}\\n{}{mark}", dot(&transition.name), dot(&condition(transition)));
        let (from, to) = (dot(&transition.from), dot(&transition.to));
        out += &format!("  \"{from}\" -> \"{to}\" [label=\"{label}\"{style}];\n");
    }
    for surface in &sheet.surfaces {
        let (mark, style) = if is_at(sheet, &surface.name) {
            ("\\nsection", ", style=\"dashed,bold\"")
        } else {
            ("", ", style=dashed")
        };
        let guard = plain(&format!("{} {}", surface.guard.text, direction(surface.direction)));
        let (mode, label) = (dot(&surface.mode), format!("{}\\n{}{mark}", dot(&surface.name), dot(&guard)));
        out += &format!("  \"{mode}\" -> \"{mode}\" [label=\"{label}\"{style}];\n");
    }
    out + "}\n"
}

/// When a transition happens, in words.
pub(super) fn condition(transition: &Transition) -> String {
    let while_ = transition.when.as_ref().map_or(String::new(), |when| format!(" while {}", when.text));
    plain(&format!("{} {}{while_}", transition.guard.text, direction(transition.direction)))
}

/// A direction in words.
pub(super) fn direction(direction: &str) -> &'static str {
    match direction {
        "falling" => "falls through 0",
        "rising" => "rises through 0",
        _ => "passes through 0",
    }
}

fn is_section(sheet: &Sheet, transition: &Transition) -> bool {
    is_at(sheet, &transition.name)
}

fn is_at(sheet: &Sheet, name: &str) -> bool {
    sheet.section.as_ref().is_some_and(|section| section.of == name)
}
