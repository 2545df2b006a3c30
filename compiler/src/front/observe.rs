//! Observations of a spec: its names of `[let]`, and expressions that are given at run time.

use super::flags::{Flag, FlagError};
use super::lower::{Definitions, Lowering, Observed, Place};
use super::parser::parse_expression;
use super::spec::{Equation, Spec};
use crate::dimension::Dimension;
use crate::front::si_unit_like;
use crate::ir::{Drawing, Graph, Observation, Observer};
use crate::source::SourceMap;
use std::sync::Arc;

/// What can be observed along a run of a model.
#[derive(Clone, Debug)]
pub struct Observations {
    observed: Observed,
    spec: Arc<Spec>,
    sources: Arc<SourceMap>,
}

impl Observations {
    pub(super) fn new(observed: Observed, spec: Arc<Spec>, sources: SourceMap) -> Self {
        Self { observed, spec, sources: Arc::new(sources) }
    }

    /// The names of `[let]`, in the order of the spec, then of its parts.
    pub fn named(&self) -> &[Observation] {
        &self.observed.lets
    }

    /// How the model is drawn, where its spec says it.
    pub fn drawing(&self) -> Option<&Drawing> {
        self.observed.drawing.as_ref()
    }

    /// The graph that the expressions of observations stand in.
    pub fn graph(&self) -> &Graph {
        &self.observed.names.graph
    }

    /// Reads an observation: the name of a state or of `[let]`, or any expression such as `m*g` or `dot(v_r)` over
    /// states, rates, parameters, memory, names of `[let]`, functions, `tau` and `t`. Its node is added to the graph.
    ///
    /// # Errors
    /// When it is no such expression.
    pub fn observe(&mut self, text: &str) -> Result<Observation, FlagError> {
        let name = text.trim();
        if let Some(observation) = self.named().iter().find(|observation| observation.name == name) {
            return Ok(observation.clone());
        }
        let mut flag = Flag::among((*self.sources).clone(), text);
        let expression = match parse_expression(&flag.text) {
            Ok(expression) => expression,
            Err(diagnostic) => return flag.refuse(*diagnostic),
        };
        let equation = Equation { text: flag.text.clone(), expression: Some(expression) };
        let Observed { names, scope, lowered, .. } = &mut self.observed;
        // What the spec says wrong of its definitions it has said when it was read.
        let definitions = Definitions::new(&self.spec, scope, &mut Vec::new());
        let mut lowering = Lowering::new(names, scope, &definitions, &flag.sources, &mut flag.diagnostics);
        let value = lowering.with_lets(lowered.clone()).equation(&equation, Place::Observation);
        let state = names.states.iter().find(|state| state.name == name);
        let parameter = names.parameters.iter().find(|parameter| parameter.name == name);
        let written = state.map(|s| &s.unit).or(parameter.map(|p| &p.unit)).map_or("", String::as_str);
        flag.finish(value.map(|value| {
            let dimension = value.dimension.unwrap_or(Dimension::NONE);
            Observation {
                name: name.to_owned(),
                text: state.map_or(name, |state| &state.doc).to_owned(),
                dimension,
                unit: si_unit_like(dimension, written),
                expr: value.node,
            }
        }))
    }

    /// Evaluates some of these observations along a run, with all parameters of the model in SI units.
    pub fn observer<'o>(
        &self,
        observations: impl IntoIterator<Item = &'o Observation>,
        parameters: &[f64],
    ) -> Observer {
        Observer::new(self.graph(), observations, parameters)
    }
}
