//! What an optimisation ended with: a verdict, the gait, and what limits it.

use super::conflict::Conflict;
use super::optima::Optimum;
use nalgebra::Complex;

/// The verdict. Everything but [`Status::Optimal`] means: no optimum to rely on; the message says what to do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// A local optimum, confirmed by a fresh simulation.
    Optimal,
    /// The search converged, but a fresh simulation disagrees.
    Unconfirmed,
    /// Constraints cannot hold together: searches from several starts agree on which, and how far they get.
    Infeasible,
    /// The search ended where no small change brings the violated constraints any closer to holding.
    InfeasibleLocally,
    /// Objective or constraints have no value where the search would begin.
    Undefined,
    /// Somebody asked to stop: the best gait so far, not an optimum.
    Interrupted,
    /// No periodic gait was found to start from.
    NoGait,
    /// The objective improves without limit.
    Unbounded,
    /// More iterations than allowed.
    IterationLimit,
    /// Steps became too small to matter before the conditions of an optimum were met.
    Stalled,
    /// Clarabel could not solve a subproblem, also after rescaling and regularising.
    SubproblemFailed,
}

/// What limits the optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActiveKind {
    /// The lower bound of this parameter (index into `info().parameters`).
    LowerBound(usize),
    /// The upper bound of this parameter.
    UpperBound(usize),
    /// This constraint (index into `Problem::constraints`).
    Constraint(usize),
}

/// An active constraint and its shadow price.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Active {
    /// Which.
    pub kind: ActiveKind,
    /// By how much the objective improves for each unit by which the bound is relaxed, SI units; not negative. For
    /// `spectral_radius <= r` the unit is that of r.
    pub multiplier: f64,
}

/// How many starts were run and how many of them gave a confirmed optimum. Where none of those asked for does, a few more
/// are run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Starts {
    /// Started.
    pub run: usize,
    /// Ended in a confirmed optimum.
    pub converged: usize,
}

/// Two multipliers of largest magnitude meet here: the spectral radius is not differentiable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kink {
    /// Where they meet.
    pub multiplier: Complex<f64>,
    /// How far apart they are, relative to their magnitude.
    pub gap: f64,
}

/// What the fresh simulation of the gait found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Confirmation {
    /// Largest |P(z) - z| relative to the size of each coordinate.
    pub residual: f64,
    /// Largest relative difference of a measure.
    pub measures: f64,
    /// Largest difference between the Jacobian and a difference quotient of maps, relative to the Jacobian.
    pub linearisation: f64,
    /// For a gait claimed stable: how many maps a disturbed gait was followed for ...
    pub maps: usize,
    /// ... and what was left of the disturbance.
    pub remaining: f64,
}

/// The result of [`solve`](super::solve).
#[derive(Clone, Debug)]
pub struct Solution {
    /// The verdict.
    pub status: Status,
    /// The verdict for people, with what to do next.
    pub message: String,
    /// What else the user should know.
    pub notes: Vec<String>,
    /// Objective, SI units; NaN without a gait.
    pub objective: f64,
    /// All parameters, SI units.
    pub parameters: Vec<f64>,
    /// Section coordinates of the gait, SI units; the first guess without a gait.
    pub section: Vec<f64>,
    /// Largest magnitude of a multiplier; 0 for a section without coordinates, NaN without a gait.
    pub spectral_radius: f64,
    /// Eigenvalues of the return map's Jacobian by falling magnitude.
    pub multipliers: Vec<Complex<f64>>,
    /// Measures, in the order of `info().measures`; empty without a gait.
    pub measures: Vec<f64>,
    /// What limits the optimum, the highest price first in units of each bound's natural scale.
    pub active: Vec<Active>,
    /// Set where multipliers of largest magnitude meet.
    pub kink: Option<Kink>,
    /// Iterations of the start that is reported.
    pub iterations: usize,
    /// Largest violation of the conditions of an optimum in scaled quantities; NaN when there was no iteration.
    pub kkt_residual: f64,
    /// Starts.
    pub starts: Starts,
    /// The distinct optima that the starts found, best first.
    pub optima: Vec<Optimum>,
    /// What cannot hold together, where the problem is infeasible.
    pub conflict: Option<Conflict>,
    /// The fresh simulation; `None` when the search did not converge.
    pub confirmation: Option<Confirmation>,
}
