//! The intermediate representation: one hybrid model, names resolved, expressions as one hash-consed graph.
//!
//! When each part is evaluated (the runtime's contract, see also `gaitc_runtime::model`):
//! - a [`Mode`]'s flow: at every stage of every integration step, branch selectors frozen;
//! - [`Switch`]es: after every accepted step; a sign change is located and the integration restarts there;
//! - [`Transition`] guards and `when`: after every accepted step; reset: once, with pre-values throughout;
//! - [`Section`] embed: once at the start of a map; symmetry: once at its end;
//! - [`Functional`] integrands: beside the flow; observables: at start, end or extremum;
//! - [`Measure`]s: once, after a map, from the values of the functionals.

pub mod canonical;
mod drawing;
pub mod eval;
pub mod graph;
mod observation;
mod published;

use crate::dimension::Dimension;
pub use drawing::{Drawing, DrawnPoint, Joint, Plane};
pub use graph::{Binary, Graph, Node, NodeId, Symbol, Unary};
pub use observation::{Observation, Observer, Point};
pub use published::{Published, PublishedNumber, PublishedOf};

/// A whole model. Indices in [`Symbol`]s point into the vectors of this struct.
#[derive(Clone, Debug)]
pub struct Model {
    /// The name that the user types; a valid Rust module name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Where the equations come from.
    pub source: String,
    /// All expressions.
    pub graph: Graph,
    /// In the order of the spec.
    pub parameters: Vec<Parameter>,
    /// In the order of the spec.
    pub states: Vec<State>,
    /// Integer memory, not differentiated.
    pub memory: Vec<Memory>,
    /// Switching functions of the frozen branch selectors.
    pub switches: Vec<Switch>,
    /// Continuous modes.
    pub modes: Vec<Mode>,
    /// Discrete transitions.
    pub transitions: Vec<Transition>,
    /// The Poincare section, when the spec has one.
    pub section: Option<Section>,
    /// Functionals of one map that the measures need.
    pub functionals: Vec<Functional>,
    /// Named results of one map.
    pub measures: Vec<Measure>,
    /// Optimisation problems: data, not equations; not part of the fingerprint.
    pub problems: Vec<Problem>,
    /// Numbers that others have published: data as well.
    pub published: Vec<Published>,
}

/// A named quantity that stays constant during a run.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name in the spec.
    pub name: String,
    /// Dimension in SI base units.
    pub dimension: Dimension,
    /// Value in SI units.
    pub value: f64,
    /// Unit as the user wrote it, for print (empty: dimensionless).
    pub unit: String,
    /// Range in SI units, if given.
    pub range: Option<(f64, f64)>,
    /// For people.
    pub doc: String,
}

/// A continuous state.
#[derive(Clone, Debug)]
pub struct State {
    /// Name in the spec.
    pub name: String,
    /// Dimension in SI base units.
    pub dimension: Dimension,
    /// Unit as the user wrote it.
    pub unit: String,
    /// For people.
    pub doc: String,
}

/// An integer that only resets change.
#[derive(Clone, Debug)]
pub struct Memory {
    /// Name in the spec.
    pub name: String,
    /// Value at the start of every map.
    pub initial: i64,
    /// For people.
    pub doc: String,
}

/// A switching function: its selector is true where `expr >= 0`.
#[derive(Clone, Debug)]
pub struct Switch {
    /// The function of state, tau, t, parameters and memory.
    pub expr: NodeId,
    /// How to name it in messages, e.g. `tau <= pi/omega` or `abs(v_x)`.
    pub text: String,
}

/// A continuous mode.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Name in the spec.
    pub name: String,
    /// Right-hand side for each state of the model (a constant 0 for states that the mode does not have).
    pub flow: Vec<NodeId>,
    /// Mass matrix by rows; `None` is the identity.
    pub mass: Option<Vec<Vec<NodeId>>>,
    /// Which states the mode has.
    pub has_state: Vec<bool>,
}

/// In which direction a guard has to pass through zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From positive to negative.
    Falling,
    /// From negative to positive.
    Rising,
    /// Both.
    Either,
}

/// A discrete transition.
#[derive(Clone, Debug)]
pub struct Transition {
    /// Name in the spec.
    pub name: String,
    /// Whether it is a surface: a transition from a mode to itself that changes nothing.
    pub surface: bool,
    /// Index of the mode it leaves.
    pub from: usize,
    /// Index of the mode it enters.
    pub to: usize,
    /// The guard function.
    pub guard: NodeId,
    /// The guard as the user wrote it.
    pub guard_text: String,
    /// Its dimension.
    pub guard_dimension: Dimension,
    /// Crossing direction that fires.
    pub direction: Direction,
    /// Enabled where this margin is `>= 0`; `None` is always.
    pub when: Option<NodeId>,
    /// Post-value for each state (constant 0 for states the target mode does not have).
    pub reset: Vec<NodeId>,
    /// Post-value for each memory.
    pub memory_reset: Vec<NodeId>,
    /// Other functions that are zero when it fires; empty but for the section's transition.
    pub also_zero: Vec<AlsoZero>,
}

/// A function that vanishes together with a guard, by its functionals (indices into [`Model::functionals`]).
#[derive(Clone, Debug)]
pub struct AlsoZero {
    /// As the user wrote it.
    pub text: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its value at the start of the map.
    pub start: usize,
    /// Its value just before the transition.
    pub end: usize,
    /// Its time derivative there.
    pub rate: usize,
}

/// The Poincare section: just after a transition, or just before it. A section on a surface inside a mode stands after a
/// transition of that mode to itself that changes nothing.
#[derive(Clone, Debug)]
pub struct Section {
    /// Index of the transition.
    pub transition: usize,
    /// Whether it stands before the transition, not after it.
    pub before: bool,
    /// State indices of the coordinates.
    pub coordinates: Vec<usize>,
    /// For each state its value on the section, as a function of coordinate states and parameters.
    pub embed: Vec<NodeId>,
    /// First guess of the coordinates, SI units.
    pub start: Vec<f64>,
    /// Image of each state under the symmetry, as a function of states and parameters.
    pub symmetry: Option<Vec<NodeId>>,
}

impl Section {
    /// The mode of the states on it; the transition that it stands at is one of `transitions`.
    pub fn mode(&self, transitions: &[Transition]) -> Option<usize> {
        let transition = transitions.get(self.transition)?;
        Some(if self.before { transition.from } else { transition.to })
    }
}

/// What is taken of an expression over one map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FunctionalKind {
    /// Time integral.
    Integral,
    /// Time integral over the duration.
    Mean,
    /// Value just after the section's transition.
    Start,
    /// Value just before the next one.
    End,
    /// Largest value.
    Maximum,
    /// Smallest value.
    Minimum,
    /// Duration of the map (its expression is the constant 1).
    Duration,
}

/// A functional of one map.
#[derive(Clone, Debug)]
pub struct Functional {
    /// Which.
    pub kind: FunctionalKind,
    /// Of what.
    pub expr: NodeId,
}

/// A named result of one map, an expression over `Symbol::Functional`s and parameters.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Name in the spec.
    pub name: String,
    /// The expression.
    pub expr: NodeId,
    /// Its dimension.
    pub dimension: Dimension,
    /// Unit for print.
    pub unit: String,
    /// For people.
    pub doc: String,
}

/// Maximise or minimise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// The larger the better.
    Maximize,
    /// The smaller the better.
    Minimize,
}

/// An optimisation problem over parameters, as data.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Name in the spec.
    pub name: String,
    /// Taken when the user names none.
    pub default: bool,
    /// For people.
    pub doc: String,
    /// Sense of the objective.
    pub sense: Sense,
    /// Objective over `Symbol::Measure`, `Symbol::Parameter`, `Symbol::SpectralRadius`.
    pub objective: NodeId,
    /// The objective as the user wrote it.
    pub objective_text: String,
    /// Its dimension.
    pub objective_dimension: Dimension,
    /// Parameters to vary with their bounds in SI units.
    pub vary: Vec<Vary>,
    /// Parameters that are only known to lie in ranges: the best worst case over these is asked for. None of them varies.
    pub robust: Vec<Uncertain>,
    /// All must hold.
    pub constraints: Vec<Constraint>,
    /// How many maps make the gait.
    pub period: usize,
}

/// A parameter that an optimisation varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Vary {
    /// Index of the parameter.
    pub parameter: usize,
    /// Lower bound, SI units.
    pub lower: f64,
    /// Upper bound, SI units.
    pub upper: f64,
}

/// A parameter that is only known to lie in a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertain {
    /// Index of the parameter.
    pub parameter: usize,
    /// Lower end, SI units.
    pub lower: f64,
    /// Upper end, SI units.
    pub upper: f64,
}

/// `margin >= 0` must hold.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Over the same symbols as a problem's objective. For `spectral_radius <= r` this is `r - spectral_radius`.
    pub margin: NodeId,
    /// For `spectral_radius <= r`: the bound r (an expression over parameters). Imposed through the Jury inequalities.
    pub stability_bound: Option<NodeId>,
    /// As the user wrote it.
    pub text: String,
    /// Dimension of the margin.
    pub dimension: Dimension,
    /// The unit behind the bound, where it has one, as in `peak_force <= 150 N`.
    pub unit: Option<String>,
}
