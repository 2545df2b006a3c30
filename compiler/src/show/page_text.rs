//! A model for the terminal, 100 columns wide.

use super::drawn::Drawing;
use super::escape::plain;
use super::graph;
use super::sheet::{Assignment, Problem, Sheet, Transition};
use super::wrap::{formula, table, wrapped};

/// The whole page.
pub(super) fn page(sheet: &Sheet) -> String {
    let mut page = String::new();
    let title = if sheet.title.is_empty() { String::new() } else { format!(" · {}", plain(&sheet.title)) };
    page += &wrapped("", &format!("{}{title}", sheet.model), 2);
    if !sheet.source.is_empty() {
        page += &wrapped("source: ", &plain(&sheet.source), 8);
    }
    section(&mut page, "states", &states(sheet));
    section(&mut page, "memory", &memory(sheet));
    section(&mut page, "parameters", &parameters(sheet));
    section(&mut page, "definitions", &definitions(sheet));
    for mode in &sheet.modes {
        let mut body = doc(&mode.doc);
        for equation in &mode.equations {
            body += &equality("  ", &equation.left_text, &equation.flow.text);
        }
        section(&mut page, &format!("mode {}", mode.name), &body);
    }
    for transition in &sheet.transitions {
        section(&mut page, &format!("transition {}", transition.name), &self::transition(transition));
    }
    for surface in &sheet.surfaces {
        let guard = format!("{} {}", surface.guard.text, graph::direction(surface.direction));
        let body = doc(&surface.doc) + &formula(&format!("  in {} where ", surface.mode), &plain(&guard), 8);
        section(&mut page, &format!("surface {}", surface.name), &body);
    }
    section(&mut page, "modes and transitions", &indented(&graph::text(sheet)));
    section(&mut page, "section", &poincare(sheet));
    section(&mut page, "measures", &measures(sheet));
    for problem in &sheet.problems {
        let default = if problem.default { " (default)" } else { "" };
        section(&mut page, &format!("problem {}{default}", problem.name), &self::problem(problem));
    }
    section(&mut page, "drawing", &sheet.drawing.as_ref().map_or(String::new(), Drawing::text));
    for published in &sheet.published {
        section(&mut page, &format!("published {}", plain(&published.name)), &published.text());
    }
    page
}

/// A headed section, unless it is empty.
fn section(page: &mut String, title: &str, body: &str) {
    if !body.is_empty() {
        *page += &format!("\n{title}\n{body}");
    }
}

fn doc(text: &str) -> String {
    if text.is_empty() { String::new() } else { wrapped("  ", &plain(text), 2) }
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}

/// `left = right`, the right side broken below itself.
fn equality(head: &str, left: &str, right: &str) -> String {
    let head = format!("{head}{left} = ");
    let hang = head.chars().count().min(30);
    formula(&head, right, hang)
}

fn states(sheet: &Sheet) -> String {
    let modes = |modes: &Option<Vec<String>>| match modes {
        Some(modes) => format!("in {}", modes.join(", ")),
        None => String::new(),
    };
    let rows = sheet.states.iter().map(|state| {
        vec![state.name.text.clone(), format!("[{}]", plain(&state.unit)), modes(&state.modes), plain(&state.doc)]
    });
    table(&rows.collect::<Vec<_>>())
}

fn memory(sheet: &Sheet) -> String {
    let rows = sheet
        .memory
        .iter()
        .map(|memory| vec![memory.name.text.clone(), format!("starts at {}", memory.initial), plain(&memory.doc)]);
    table(&rows.collect::<Vec<_>>())
}

fn parameters(sheet: &Sheet) -> String {
    let rows = sheet.parameters.iter().map(|parameter| {
        let range = parameter.shown_range().map_or(String::new(), |(lower, upper)| format!("{lower} .. {upper}"));
        let part = parameter.part.as_ref().map_or(String::new(), |part| format!("[{}]", plain(part)));
        let said = [plain(&parameter.doc), part].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>();
        vec![parameter.name.text.clone(), parameter.shown(), range, said.join(" ")]
    });
    table(&rows.collect::<Vec<_>>())
}

fn definitions(sheet: &Sheet) -> String {
    let mut body = String::new();
    let mut part = &None;
    for definition in &sheet.definitions {
        if definition.part != *part {
            let from = definition.part.as_deref().map_or("the spec itself".to_owned(), plain);
            body += &wrapped("  ", &format!("from {from}"), 2);
            part = &definition.part;
        }
        let arguments: Vec<&str> = definition.arguments.iter().map(|argument| argument.text.as_str()).collect();
        let arguments = if arguments.is_empty() { String::new() } else { format!("({})", arguments.join(", ")) };
        body += &equality("  ", &format!("{}{arguments}", definition.name.text), &definition.formula.text);
        if !definition.doc.is_empty() {
            body += &wrapped("      ", &plain(&definition.doc), 6);
        }
    }
    body
}

fn transition(transition: &Transition) -> String {
    let mut body = doc(&transition.doc);
    body += &format!("  {} -> {}\n", transition.from, transition.to);
    body += &formula("  when ", &graph::condition(transition), 7);
    for zero in &transition.also_zero {
        body += &formula("  where also ", &format!("{} = 0", zero.text), 13);
    }
    for reset in &transition.reset {
        body += &equality("  ", &format!("{}⁺", reset.left.text), &reset.right.text);
    }
    body
}

fn poincare(sheet: &Sheet) -> String {
    let Some(section) = &sheet.section else { return String::new() };
    let names: Vec<&str> = section.coordinates.iter().map(|name| name.text.as_str()).collect();
    let names = if names.is_empty() {
        "without coordinates".to_owned()
    } else {
        format!("with coordinates {}", names.join(", "))
    };
    let place = format!("{} {}, {names}", section.place().to_lowercase(), section.of);
    let mut body = wrapped("  ", &place, 2);
    let list = |title: &str, items: &[Assignment], sign: &str| {
        let lines = items.iter().map(|item| equality("    ", &format!("{}{sign}", item.left.text), &item.right.text));
        if items.is_empty() { String::new() } else { format!("  {title}\n") + &lines.collect::<String>() }
    };
    body += &list("on it", &section.embed, "");
    body += &list("symmetry", section.symmetry.as_deref().unwrap_or(&[]), "⁺");
    if !section.start.is_empty() {
        body += "  first guess of a gait\n";
        body += &section.start.iter().map(|s| equality("    ", &s.name.text, &s.shown)).collect::<String>();
    }
    body
}

fn measures(sheet: &Sheet) -> String {
    let mut body = String::new();
    for measure in &sheet.measures {
        let unit = match measure.unit.as_str() {
            "" | "1" => String::new(),
            unit => format!(" [{}]", plain(unit)),
        };
        body += &equality("  ", &format!("{}{unit}", measure.name.text), &measure.formula.text);
        if !measure.doc.is_empty() {
            body += &wrapped("      ", &plain(&measure.doc), 6);
        }
    }
    body
}

fn problem(problem: &Problem) -> String {
    let mut body = doc(&problem.doc);
    body += &formula(&format!("  {} ", problem.sense), &problem.objective.text, 11);
    for vary in &problem.vary {
        body += &format!("  over {} = {} .. {}\n", vary.name.text, vary.shown.0, vary.shown.1);
    }
    for uncertain in &problem.robust {
        let (lower, upper) = &uncertain.shown;
        body += &format!("  for every {} = {lower} .. {upper}\n", uncertain.name.text);
    }
    for constraint in &problem.subject_to {
        body += &formula("  subject to ", &constraint.text, 13);
    }
    if problem.period > 1 {
        body += &format!("  for a gait of {} maps\n", problem.period);
    }
    body
}
