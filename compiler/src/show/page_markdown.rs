//! A model in Markdown: tables, and formulas between `$$`.

use super::drawn::Drawing;
use super::escape::markdown;
use super::lines::{aligned, row};
use super::literal::quantity_latex;
use super::page_latex::rows;
use super::sheet::{Problem, Sheet, Surface, Transition, Vary};

/// The whole page.
pub(super) fn page(sheet: &Sheet) -> String {
    let title = if sheet.title.is_empty() { markdown(&sheet.model) } else { markdown(&sheet.title) };
    let mut page = format!("# {title}\n\nModel `{}`", sheet.model);
    if !sheet.source.is_empty() {
        page += &format!("; source: {}", markdown(&sheet.source));
    }
    page.push('\n');
    section(&mut page, "States", &states(sheet));
    section(&mut page, "Memory", &memory(sheet));
    section(&mut page, "Parameters", &parameters(sheet));
    section(&mut page, "Definitions", &definitions(sheet));
    for mode in &sheet.modes {
        let rows: Vec<String> = mode.equations.iter().map(|e| row(&e.left_latex, &e.flow)).collect();
        section(&mut page, &format!("Mode `{}`", mode.name), &(paragraph(&mode.doc) + &display(&rows)));
    }
    for transition in &sheet.transitions {
        section(&mut page, &format!("Transition `{}`", transition.name), &self::transition(transition));
    }
    for surface in &sheet.surfaces {
        section(&mut page, &format!("Surface `{}`", surface.name), &self::surface(surface));
    }
    section(&mut page, "Section", &poincare(sheet));
    section(&mut page, "Measures", &measures(sheet));
    for problem in &sheet.problems {
        let default = if problem.default { " (default)" } else { "" };
        section(&mut page, &format!("Problem `{}`{default}", problem.name), &self::problem(problem));
    }
    section(&mut page, "Drawing", &sheet.drawing.as_ref().map_or(String::new(), drawing));
    for published in &sheet.published {
        let body = paragraph(&published.source()) + &display(&published.latex());
        section(&mut page, &format!("Published: {}", markdown(&published.name)), &body);
    }
    page
}

fn drawing(drawing: &Drawing) -> String {
    display(&drawing.latex()) + &drawing.said().map(|said| paragraph(&said)).collect::<String>()
}

fn section(page: &mut String, title: &str, body: &str) {
    if !body.is_empty() {
        *page += &format!("\n## {title}\n\n{}\n", body.trim_end());
    }
}

fn paragraph(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{}\n\n", markdown(text)) }
}

fn display(rows: &[String]) -> String {
    if rows.is_empty() { String::new() } else { format!("$$\n{}\n$$\n\n", aligned(rows)) }
}

fn math(latex: &str) -> String {
    format!("${latex}$")
}

fn table(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let body: String = rows.map(|row| format!("| {} |\n", row.join(" | "))).collect();
    if body.is_empty() {
        return body;
    }
    format!("| {} |\n|{}\n{body}", header.join(" | "), "---|".repeat(header.len()))
}

fn states(sheet: &Sheet) -> String {
    let rows = sheet.states.iter().map(|state| {
        let modes = state.modes.as_ref().map_or(String::new(), |modes| format!("in {}; ", markdown(&modes.join(", "))));
        let name = format!("`{}`", state.name.name);
        vec![name, math(&state.name.latex), markdown(&state.unit), modes + &markdown(&state.doc)]
    });
    table(&["state", "symbol", "unit", "what it is"], rows)
}

fn memory(sheet: &Sheet) -> String {
    let rows = sheet.memory.iter().map(|memory| {
        let name = format!("`{}`", memory.name.name);
        vec![name, math(&memory.name.latex), memory.initial.to_string(), markdown(&memory.doc)]
    });
    table(&["memory", "symbol", "at the start", "what it is"], rows)
}

fn parameters(sheet: &Sheet) -> String {
    let rows = sheet.parameters.iter().map(|parameter| {
        let range = parameter.shown_range().map_or(String::new(), |(lower, upper)| format!("{lower} to {upper}"));
        let part = parameter.part.as_deref().map_or(String::new(), markdown);
        let (name, symbol) = (format!("`{}`", parameter.name.name), math(&parameter.name.latex));
        vec![name, symbol, markdown(&parameter.shown()), markdown(&range), markdown(&parameter.doc), part]
    });
    table(&["parameter", "symbol", "value", "range", "what it is", "from the part"], rows)
}

fn definitions(sheet: &Sheet) -> String {
    let rows = sheet.definitions.iter().map(|definition| {
        let arguments: Vec<&str> = definition.arguments.iter().map(|argument| argument.latex.as_str()).collect();
        let arguments = if arguments.is_empty() { String::new() } else { format!("({})", arguments.join(", ")) };
        row(&format!("{}{arguments}", definition.name.latex), &definition.formula)
    });
    display(&rows.collect::<Vec<_>>())
}

fn transition(transition: &Transition) -> String {
    let mut body = paragraph(&transition.doc);
    let direction = super::graph::direction(transition.direction);
    body += &format!(
        "From `{}` to `{}` when {} {direction}",
        transition.from,
        transition.to,
        math(&transition.guard.latex)
    );
    if let Some(when) = &transition.when {
        body += &format!(" while {}", math(&when.latex));
    }
    for zero in &transition.also_zero {
        body += &format!(", where also {}", math(&format!("{} = 0", zero.latex)));
    }
    body + ".\n\n" + &display(&rows(&transition.reset, "^{+}"))
}

fn surface(surface: &Surface) -> String {
    let direction = super::graph::direction(surface.direction);
    paragraph(&surface.doc) + &format!("In `{}` where {} {direction}.\n\n", surface.mode, math(&surface.guard.latex))
}

fn poincare(sheet: &Sheet) -> String {
    let Some(section) = &sheet.section else { return String::new() };
    let names: Vec<String> = section.coordinates.iter().map(|name| math(&name.latex)).collect();
    let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    let mut body = format!("{} `{}`, coordinates: {names}.\n\n", section.place(), section.of);
    if !section.embed.is_empty() {
        body += &format!("On it\n\n{}", display(&rows(&section.embed, "")));
    }
    if let Some(symmetry) = section.symmetry.as_ref().filter(|symmetry| !symmetry.is_empty()) {
        body += &format!("Symmetry\n\n{}", display(&rows(symmetry, "^{+}")));
    }
    if !section.start.is_empty() {
        let start = section.start.iter().map(|s| format!("{} & = {}", s.name.latex, quantity_latex(&s.shown)));
        body += &format!("First guess of a gait\n\n{}", display(&start.collect::<Vec<_>>()));
    }
    body
}

fn measures(sheet: &Sheet) -> String {
    let rows = sheet.measures.iter().map(|measure| row(&measure.name.latex, &measure.formula));
    let equations = display(&rows.collect::<Vec<_>>());
    let rows = sheet
        .measures
        .iter()
        .map(|measure| vec![format!("`{}`", measure.name.name), markdown(&measure.unit), markdown(&measure.doc)]);
    equations + &table(&["measure", "unit", "what it is"], rows)
}

fn problem(problem: &Problem) -> String {
    let mut lines = vec![format!("\\text{{{}}} \\quad & {}", problem.sense, problem.objective.latex)];
    let range = |what: &str, vary: &Vary| {
        let (lower, upper) = (quantity_latex(&vary.shown.0), quantity_latex(&vary.shown.1));
        format!("\\text{{{what}}} \\quad & {lower} \\le {} \\le {upper}", vary.name.latex)
    };
    lines.extend(problem.vary.iter().map(|vary| range("over", vary)));
    lines.extend(problem.robust.iter().map(|uncertain| range("for every", uncertain)));
    lines.extend(problem.subject_to.iter().map(|c| format!("\\text{{subject to}} \\quad & {}", c.latex)));
    if problem.period > 1 {
        lines.push(format!("\\text{{for a gait of {} maps}} \\quad &", problem.period));
    }
    paragraph(&problem.doc) + &display(&lines)
}
