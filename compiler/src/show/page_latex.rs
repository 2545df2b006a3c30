//! A model as a LaTeX document that compiles by itself.

use super::drawn::Drawing;
use super::escape::latex;
use super::lines::{aligned, row};
use super::literal::{quantity_latex, unit_latex};
use super::sheet::{Assignment, Problem, Sheet, Surface, Transition, Vary};

/// Packages, and what to do with characters that pdfTeX does not know.
const PREAMBLE: &str = "\\documentclass{article}
\\usepackage[T1]{fontenc}
\\usepackage{amsmath,amssymb,iftex,longtable,textcomp}
\\usepackage[margin=2cm]{geometry}
% A character by its code point and by itself: pdfTeX prints the code point.
\\newcommand{\\gaitcchar}[2]{\\ifPDFTeX[U+#1]\\else#2\\fi}
\\setlength{\\parindent}{0pt}
\\begin{document}
";

/// The whole document.
pub(super) fn page(sheet: &Sheet) -> String {
    let mut page = PREAMBLE.to_owned();
    let title = if sheet.title.is_empty() { latex(&sheet.model) } else { latex(&sheet.title) };
    page += &format!("\\section*{{{title}}}\n\\texttt{{{}}}", latex(&sheet.model));
    if !sheet.source.is_empty() {
        page += &format!("; source: {}", latex(&sheet.source));
    }
    page.push('\n');
    section(&mut page, "States", &states(sheet));
    section(&mut page, "Memory", &memory(sheet));
    section(&mut page, "Parameters", &parameters(sheet));
    section(&mut page, "Definitions", &definitions(sheet));
    for mode in &sheet.modes {
        let rows: Vec<String> = mode.equations.iter().map(|e| row(&e.left_latex, &e.flow)).collect();
        let title = format!("Mode \\texttt{{{}}}", latex(&mode.name));
        section(&mut page, &title, &(paragraph(&mode.doc) + &display(&rows)));
    }
    for transition in &sheet.transitions {
        let title = format!("Transition \\texttt{{{}}}", latex(&transition.name));
        section(&mut page, &title, &self::transition(transition));
    }
    for surface in &sheet.surfaces {
        let title = format!("Surface \\texttt{{{}}}", latex(&surface.name));
        section(&mut page, &title, &self::surface(surface));
    }
    section(&mut page, "Section", &poincare(sheet));
    section(&mut page, "Measures", &measures(sheet));
    for problem in &sheet.problems {
        let default = if problem.default { " (default)" } else { "" };
        let title = format!("Problem \\texttt{{{}}}{default}", latex(&problem.name));
        section(&mut page, &title, &self::problem(problem));
    }
    section(&mut page, "Drawing", &sheet.drawing.as_ref().map_or(String::new(), drawing));
    for published in &sheet.published {
        let body = paragraph(&published.source()) + &display(&published.latex());
        section(&mut page, &format!("Published: {}", latex(&published.name)), &body);
    }
    page + "\\end{document}\n"
}

fn drawing(drawing: &Drawing) -> String {
    display(&drawing.latex()) + &drawing.said().map(|said| paragraph(&said)).collect::<String>()
}

fn section(page: &mut String, title: &str, body: &str) {
    if !body.is_empty() {
        *page += &format!("\n\\subsection*{{{title}}}\n{body}");
    }
}

fn paragraph(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{}\n\n", latex(text)) }
}

/// Equations, each broken over pages between rows only.
fn display(rows: &[String]) -> String {
    let groups = rows.chunks(12).map(|rows| format!("\\[\n{}\n\\]\n", aligned(rows)));
    groups.collect()
}

fn unit(unit: &str) -> String {
    let unit = unit_latex(unit);
    if unit.is_empty() { "1".to_owned() } else { unit }
}

fn table(columns: &str, header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut body = String::new();
    for row in rows {
        body += &format!("{} \\\\\n", row.join(" & "));
    }
    if body.is_empty() {
        return body;
    }
    let header = header.join(" & ");
    format!("\\begin{{longtable}}{{{columns}}}\n{header} \\\\ \\hline\n\\endhead\n{body}\\end{{longtable}}\n")
}

fn states(sheet: &Sheet) -> String {
    let rows = sheet.states.iter().map(|state| {
        let modes = state.modes.as_ref().map_or(String::new(), |modes| format!("in {}; ", latex(&modes.join(", "))));
        let symbol = format!("${}$", state.name.latex);
        vec![symbol, format!("${}$", unit(&state.unit)), modes + &latex(&state.doc)]
    });
    table("llp{11cm}", &["state", "unit", ""], rows)
}

fn memory(sheet: &Sheet) -> String {
    let rows = sheet
        .memory
        .iter()
        .map(|memory| vec![format!("${}$", memory.name.latex), format!("${}$", memory.initial), latex(&memory.doc)]);
    table("llp{11cm}", &["memory", "at the start", ""], rows)
}

fn parameters(sheet: &Sheet) -> String {
    let rows = sheet.parameters.iter().map(|parameter| {
        let range = parameter.shown_range().map_or(String::new(), |(lower, upper)| {
            format!("${}$ to ${}$", quantity_latex(&lower), quantity_latex(&upper))
        });
        let part = parameter.part.as_ref().map_or(String::new(), |part| format!(" (\\texttt{{{}}})", latex(part)));
        let value = format!("${}$", quantity_latex(&parameter.shown()));
        vec![format!("${}$", parameter.name.latex), value, range, latex(&parameter.doc) + &part]
    });
    table("lllp{7cm}", &["parameter", "value", "range", ""], rows)
}

fn definitions(sheet: &Sheet) -> String {
    let rows = sheet.definitions.iter().map(|definition| {
        let arguments: Vec<&str> = definition.arguments.iter().map(|argument| argument.latex.as_str()).collect();
        let arguments = if arguments.is_empty() { String::new() } else { format!("({})", arguments.join(", ")) };
        row(&format!("{}{arguments}", definition.name.latex), &definition.formula)
    });
    display(&rows.collect::<Vec<_>>())
}

/// Rows of equations whose left sides carry a sign.
pub(super) fn rows(items: &[Assignment], sign: &str) -> Vec<String> {
    items.iter().map(|item| row(&format!("{}{sign}", item.left.latex), &item.right)).collect()
}

fn transition(transition: &Transition) -> String {
    let mut body = paragraph(&transition.doc);
    let (from, to) = (latex(&transition.from), latex(&transition.to));
    body += &format!("From \\texttt{{{from}}} to \\texttt{{{to}}} when ${}$ ", transition.guard.latex);
    body += super::graph::direction(transition.direction);
    if let Some(when) = &transition.when {
        body += &format!(" while ${}$", when.latex);
    }
    for zero in &transition.also_zero {
        body += &format!(", where also ${} = 0$", zero.latex);
    }
    body + ".\n" + &display(&rows(&transition.reset, "^{+}"))
}

fn surface(surface: &Surface) -> String {
    let direction = super::graph::direction(surface.direction);
    let place = format!("In \\texttt{{{}}} where ${}$ {direction}.\n", latex(&surface.mode), surface.guard.latex);
    paragraph(&surface.doc) + &place
}

fn poincare(sheet: &Sheet) -> String {
    let Some(section) = &sheet.section else { return String::new() };
    let names: Vec<String> = section.coordinates.iter().map(|name| format!("${}$", name.latex)).collect();
    let names = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    let mut body = format!("{} \\texttt{{{}}}, coordinates: {names}.\n", section.place(), latex(&section.of));
    if !section.embed.is_empty() {
        body += &format!("\nOn it\n{}", display(&rows(&section.embed, "")));
    }
    if let Some(symmetry) = section.symmetry.as_ref().filter(|symmetry| !symmetry.is_empty()) {
        body += &format!("\nSymmetry\n{}", display(&rows(symmetry, "^{+}")));
    }
    if !section.start.is_empty() {
        let start = section.start.iter().map(|s| format!("{} & = {}", s.name.latex, quantity_latex(&s.shown)));
        body += &format!("\nFirst guess of a gait\n{}", display(&start.collect::<Vec<_>>()));
    }
    body
}

fn measures(sheet: &Sheet) -> String {
    let rows = sheet.measures.iter().map(|measure| row(&measure.name.latex, &measure.formula));
    let equations = display(&rows.collect::<Vec<_>>());
    let rows = sheet.measures.iter().map(|measure| {
        vec![format!("${}$", measure.name.latex), format!("${}$", unit(&measure.unit)), latex(&measure.doc)]
    });
    equations + &table("llp{9cm}", &["measure", "unit", ""], rows)
}

fn problem(problem: &Problem) -> String {
    let mut body = paragraph(&problem.doc);
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
    body += &display(&lines);
    body
}
