//! Which lets and functions a model needs, directly or through others.

use crate::front::spec::{Drawing, Equation, MassRow, Spec};
use std::collections::{HashMap, HashSet};

/// The names of lets and functions that equations, sections, measures, problems or the drawing need.
pub(super) fn used(spec: &Spec) -> HashSet<&str> {
    let lets = spec.lets.iter().map(|item| (item.name.as_str(), &item.value));
    let functions = spec.functions.iter().filter_map(|item| Some((item.name.as_str(), item.value.body.as_ref()?)));
    let definitions: HashMap<&str, &Equation> = lets.chain(functions).collect();
    let mut open: Vec<&str> = roots(spec).into_iter().flat_map(names).collect();
    let mut found = HashSet::new();
    while let Some(name) = open.pop() {
        let Some(definition) = definitions.get(name) else { continue };
        if found.insert(name) {
            open.extend(names(definition));
        }
    }
    found
}

fn names(equation: &Equation) -> impl Iterator<Item = &str> {
    equation.expression.iter().flat_map(|expression| &expression.names).map(|name| name.name.as_str())
}

/// Every expression but those of lets and functions.
fn roots(spec: &Spec) -> Vec<&Equation> {
    let mut all: Vec<&Equation> = Vec::new();
    for mode in spec.modes.iter().map(|item| &item.value) {
        all.extend(mode.flow.iter().map(|item| &item.value));
        for row in &mode.mass {
            match &row.value {
                MassRow::Factor(equation) => all.push(equation),
                MassRow::Entries(entries) => all.extend(entries.iter().map(|item| &item.value)),
            }
        }
    }
    for transition in spec.transitions.iter().map(|item| &item.value) {
        all.extend(transition.guard.iter().chain(&transition.when));
        all.extend(transition.reset.iter().map(|item| &item.value));
        all.extend(transition.also_zero.iter().flat_map(|(_, equations)| equations));
    }
    all.extend(spec.surfaces.iter().filter_map(|item| item.value.guard.as_ref()));
    if let Some(section) = &spec.section {
        all.extend(section.embed.iter().chain(section.symmetry.iter().flatten()).map(|item| &item.value));
    }
    all.extend(spec.measures.iter().filter_map(|item| item.value.expr.as_ref()));
    for problem in spec.problems.iter().map(|item| &item.value) {
        all.extend(problem.objective.iter().map(|(_, equation)| equation).chain(&problem.subject_to));
    }
    all.extend(spec.drawing.iter().flat_map(Drawing::equations));
    all
}
