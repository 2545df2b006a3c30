//! Spec to model: names resolved, dimensions checked, expressions lowered into one graph.

mod absent;
mod also_zero;
mod branch;
mod call;
mod clock;
mod declare;
mod definitions;
mod derivative;
mod drawing;
mod dynamics;
mod expr;
mod fixed;
mod fold;
mod held;
mod invariance;
mod involution;
mod lowering;
mod mass;
mod measures;
mod observed;
mod on_section;
mod order;
mod problems;
mod published;
mod reach;
mod sample;
mod scope;
mod section;
mod surfaces;
mod unused;
mod value;

pub(crate) use super::si::dimension_text;
use super::spec::Spec;
use crate::diagnostic::Diagnostic;
use crate::ir::{Graph, Model};
use crate::source::SourceMap;
pub(crate) use definitions::Definitions;
pub(crate) use lowering::{Context, Lowering};
pub(crate) use observed::Observed;
pub(crate) use scope::Scope;
pub(crate) use value::Place;

/// Lowers a spec: the model, and what can be observed along its runs. Both are whole only if no error was reported.
pub(crate) fn lower(spec: &Spec, sources: &SourceMap, diagnostics: &mut Vec<Diagnostic>) -> (Model, Observed) {
    let mut model = empty_model();
    model.name = spec.name.as_ref().map_or(String::new(), |name| name.value.clone());
    model.title.clone_from(&spec.title);
    model.source.clone_from(&spec.source);
    let scope = declare::declare(spec, &mut model, sources, diagnostics);
    let definitions = Definitions::new(spec, &scope, diagnostics);
    definitions.check_function_names(&scope, diagnostics);
    let mut lowering = Lowering::new(&mut model, &scope, &definitions, sources, diagnostics);
    lowering.modes(spec);
    lowering.transitions(spec);
    lowering.surfaces(spec);
    lowering.section(spec);
    lowering.measures(spec);
    lowering.also_zero(spec);
    lowering.problems(spec);
    lowering.published(spec);
    // What nothing needs is checked, but leaves no trace in the model.
    let lets = lowering.into_lets();
    let mut scratch = model.clone();
    Lowering::new(&mut scratch, &scope, &definitions, sources, diagnostics).lower_remaining_lets(lets);
    let observed = observed::observed(spec, (&model, &scope, &definitions), sources, diagnostics);
    // Where a name is misspelt, what it was meant to be only looks unused, and what follows from equations is not known.
    if !diagnostics.iter().any(Diagnostic::is_error) {
        reach::check(spec, &model, diagnostics);
        clock::check(spec, &model, diagnostics);
        on_section::check(spec, &model, diagnostics);
        involution::check(spec, &model, diagnostics);
        invariance::check(spec, &model, diagnostics);
        held::check(spec, &model, &observed, diagnostics);
        unused::check(spec, diagnostics);
    }
    (model, observed)
}

/// A model without anything.
pub(crate) fn empty_model() -> Model {
    Model {
        name: String::new(),
        title: String::new(),
        source: String::new(),
        graph: Graph::default(),
        parameters: Vec::new(),
        states: Vec::new(),
        memory: Vec::new(),
        switches: Vec::new(),
        modes: Vec::new(),
        transitions: Vec::new(),
        section: None,
        functionals: Vec::new(),
        measures: Vec::new(),
        problems: Vec::new(),
        published: Vec::new(),
    }
}
