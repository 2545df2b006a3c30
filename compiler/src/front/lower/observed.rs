//! What can be observed along a run: every name of `[let]`, and what `[drawing]` has. It is lowered into a graph of its own, with conditions decided by
//! a point's values, so that it leaves neither nodes nor switches in the model.

use super::definitions::{Definitions, Lets};
use super::held::Held;
use super::lowering::Lowering;
use super::value::Place;
use super::{Scope, empty_model};
use crate::diagnostic::Diagnostic;
use crate::dimension::Dimension;
use crate::front::si_unit;
use crate::front::spec::Spec;
use crate::front::syntax::NameUse;
use crate::ir::{Drawing, Model, Observation};
use crate::source::SourceMap;

/// What can be observed, and what it takes to read more.
#[derive(Clone, Debug)]
pub(crate) struct Observed {
    /// The names of the model, and the graph of what is observed.
    pub(crate) names: Model,
    /// As a text sees it that is neither the spec nor a part.
    pub(crate) scope: Scope,
    /// The names of `[let]` in that graph.
    pub(crate) lowered: Lets,
    pub(crate) lets: Vec<Observation>,
    pub(crate) drawing: Option<Drawing>,
    /// The velocities of points that are to stand still.
    pub(crate) held: Vec<Held>,
}

/// Lowers what can be observed along runs of a model.
pub(super) fn observed(
    spec: &Spec,
    (model, scope, definitions): (&Model, &Scope, &Definitions<'_>),
    sources: &SourceMap,
    diagnostics: &mut Vec<Diagnostic>,
) -> Observed {
    let mut names = Model {
        parameters: model.parameters.clone(),
        states: model.states.clone(),
        memory: model.memory.clone(),
        modes: model.modes.clone(),
        ..empty_model()
    };
    let mut lowering = Lowering::new(&mut names, scope, definitions, sources, diagnostics);
    let lets = lowering.observed_lets(spec);
    let drawing = lowering.drawing(spec);
    let held = lowering.held_points(spec);
    let lowered = lowering.into_lets();
    Observed { names, scope: scope.outside(), lowered, lets, drawing, held }
}

impl Lowering<'_> {
    /// Every name of `[let]` that has a value; of the others it has been said what is wrong.
    fn observed_lets(&mut self, spec: &Spec) -> Vec<Observation> {
        let style = Place::Observation.style();
        let mut observations = Vec::new();
        for (i, item) in spec.lets.iter().enumerate() {
            let name = NameUse { name: item.name.clone(), span: item.span, called: false, in_functional: false };
            self.lower_lets(&[name], Place::Observation);
            let Some(value) = self.lets.get(&(i, style)).copied().flatten() else { continue };
            let dimension = value.dimension.unwrap_or(Dimension::NONE);
            observations.push(Observation {
                name: item.name.clone(),
                text: item.value.text.value.trim().to_owned(),
                dimension,
                unit: si_unit(dimension),
                expr: value.node,
            });
        }
        observations
    }
}
