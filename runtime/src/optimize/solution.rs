//! What an optimisation ended with: a verdict, the gait, and what limits it.

use super::conflict::Conflict;
use super::optima::Optimum;
use crate::return_map::Method;
use nalgebra::Complex;

/// The verdict. Everything but [`Status::Optimal`] means: no optimum to rely on; the message says what to do next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// A local optimum, confirmed by a fresh simulation.
    Optimal,
    /// The search converged, but a fresh simulation disagrees.
    Unconfirmed,
    /// The first-order conditions hold, but the objective curves the wrong way, and no search from next to it did better.
    Saddle,
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
    /// More single maps than one search may take: the best gait so far.
    WorkLimit,
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

/// What second derivatives say of an optimum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The active constraints leave no direction: first derivatives decide.
    Vertex,
    /// In every direction that is left the objective gets worse.
    Strict,
    /// In some direction it changes by less than can be told.
    Flat,
    /// In some direction it improves: no optimum.
    Saddle,
    /// Second derivatives cannot be had here, or do not decide.
    Undecided,
}

/// The second-order condition: the Hessian of the Lagrangian on the directions that the active constraints leave.
#[derive(Clone, Debug, PartialEq)]
pub struct Curvature {
    /// The verdict.
    pub shape: Shape,
    /// How many bounds and inequalities limit the optimum, one less for a spectral radius that is minimised: it is itself the
    /// least bound on its inequalities. A bound on the spectral radius can count more than once, where multipliers meet; ...
    pub constraints: usize,
    /// ... and how many more are met with equality, but have no price.
    pub weak: usize,
    /// How many independent directions the former leave.
    pub directions: usize,
    /// Smallest eigenvalue there, in scaled quantities; NaN where there is none.
    pub smallest: f64,
    /// What it may be off by.
    pub error: f64,
    /// For a flat direction or a saddle: the parameters along it, the largest share of its range first. Empty where only the
    /// gait moves.
    pub along: Vec<usize>,
}

/// How the optimum follows a parameter that is held fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensitivity {
    /// Index into `info().parameters`.
    pub parameter: usize,
    /// Derivative of the best objective with respect to it, SI units.
    pub derivative: f64,
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
    /// The gait under random disturbances before each of many maps; `None` for a section without coordinates.
    pub disturbed: Option<Disturbed>,
    /// Map and Jacobian by another route; `None` where there is none.
    pub independent: Option<Independent>,
}

/// What random disturbances of every coordinate before each map made of a gait.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Disturbed {
    /// It is stable, and stayed.
    Stays {
        /// Maps in sequence.
        maps: usize,
        /// Standard deviation of the disturbance of a coordinate, relative to its size.
        level: f64,
        /// Largest difference of a map from the linear prediction, relative to the size of the deviations.
        nonlinear: f64,
        /// Largest relative difference between the standard deviation of a coordinate and the predicted one; 0 where a map
        /// leaves less than 1 % of a disturbance, ...
        spread: f64,
        /// ... and what it is on average (one standard deviation) because the sample is no longer than that.
        sampling: f64,
        /// Maps in which a deviation falls to 1/e. When it is not short against `maps`, the spread says little, and it is
        /// the agreement of the single maps that counts.
        memory: f64,
    },
    /// It is not stable: a small deviation was followed for as long as it stayed small.
    Grows {
        /// Maps in sequence.
        maps: usize,
        /// By what factor the deviation grew ...
        grown: f64,
        /// ... and by what factor the Jacobian says it grows.
        expected: f64,
    },
}

/// Another route to the map and its Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// Another integration method, with its own variational equations.
    Method(Method),
    /// Gauss collocation on a fixed grid; the Jacobian by differences of its maps.
    Collocation {
        /// Steps between two transitions.
        steps: usize,
    },
}

impl Route {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Method(Method::Explicit) => "the explicit Runge-Kutta method",
            Self::Method(Method::Radau3) => "Radau IIA with 3 stages",
            Self::Method(_) => "Radau IIA",
            Self::Collocation { .. } => "Gauss collocation",
        }
    }
}

/// By how much another route differs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Independent {
    /// Which.
    pub route: Route,
    /// Largest difference of a coordinate after the map, relative to its size.
    pub image: f64,
    /// Largest difference of an entry of the Jacobian in units of the coordinates' sizes, relative to the largest entry.
    pub jacobian: f64,
    /// Largest distance between multipliers, relative to the largest magnitude.
    pub multipliers: f64,
    /// What the other route's image may itself be off by.
    pub uncertainty: f64,
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
    /// The second-order condition; `None` when the search did not converge.
    pub curvature: Option<Curvature>,
    /// How the optimum follows each fixed parameter, the largest change for one per cent of its value first; empty when the
    /// search did not converge.
    pub sensitivities: Vec<Sensitivity>,
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
