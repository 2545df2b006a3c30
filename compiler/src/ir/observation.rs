//! What can be observed along a run. Observations are data: no code is generated for them, and they leave no trace in a
//! model's equations and its fingerprint.

use super::eval::{Environment, Tape};
use super::{Graph, NodeId};
use crate::dimension::Dimension;

/// A quantity that has a value at every point of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// How people call it: a name of the spec, or the expression itself.
    pub name: String,
    /// The expression as it was written; of a state its doc string.
    pub text: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// The unit of its values, which are in SI units; `1` for a pure number.
    pub unit: String,
    /// In the graph of the observations, over states, rates, parameters, memory, `tau` and `t`. Conditions in it are decided
    /// by the point's values.
    pub expr: NodeId,
}

/// A point of a run, in SI units.
#[derive(Clone, Copy, Debug, Default)]
pub struct Point<'a> {
    /// All states of the model; 0 for those that the mode does not have.
    pub x: &'a [f64],
    /// Their rates, as the integrator knows them; read by what has `dot(...)` in it.
    pub k: &'a [f64],
    /// Time since the last transition.
    pub tau: f64,
    /// Time since the start of the run.
    pub t: f64,
    /// All memory.
    pub memory: &'a [f64],
}

/// Evaluates observations along a run: what they share is computed once a point.
#[derive(Clone, Debug)]
pub struct Observer {
    tape: Tape,
    parameters: Vec<f64>,
}

impl Observer {
    /// For observations of a graph, with all parameters of the model in SI units.
    pub fn new<'o>(graph: &Graph, observations: impl IntoIterator<Item = &'o Observation>, parameters: &[f64]) -> Self {
        let roots: Vec<NodeId> = observations.into_iter().map(|observation| observation.expr).collect();
        Self::of(graph, &roots, parameters)
    }

    /// For expressions of a graph.
    pub fn of(graph: &Graph, roots: &[NodeId], parameters: &[f64]) -> Self {
        Self { tape: Tape::new(graph, roots), parameters: parameters.to_vec() }
    }

    /// The values at a point, one an observation, in SI units. One that needs what the point does not give is NaN, as is
    /// one that has no real value there.
    pub fn at(&mut self, point: &Point<'_>) -> Vec<f64> {
        let at = Environment {
            states: point.x,
            rates: point.k,
            parameters: &self.parameters,
            memory: point.memory,
            tau: point.tau,
            time: point.t,
            ..Environment::default()
        };
        self.tape.values(&at).collect()
    }
}
