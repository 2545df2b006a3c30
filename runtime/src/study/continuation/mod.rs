//! Gaits followed over a parameter: pseudo-arclength continuation of the fixed points of P_k(z; p) = z.
//!
//! A branch is a curve in the space of section coordinates and parameter. It is followed from a gait in both directions, around folds, until it
//! leaves the range of the parameter, closes, or ends ([`EndReason`]). On the way the places are located where multipliers go through
//! the unit circle ([`Kind`]), and other branches can be entered there. Everything rests on exact derivatives of the map in coordinates and parameter.
//!
//! W. Govaerts, *Numerical Methods for Bifurcations of Dynamical Equilibria*, 2000; Y. A. Kuznetsov, *Elements of Applied Bifurcation Theory*, chapter
//! 10; H. B. Keller, *Numerical solution of bifurcation and nonlinear eigenvalue problems*, 1977.

mod corrector;
mod criticality;
mod diagram;
mod indicators;
mod locate;
mod normal_form;
mod observer;
mod path;
mod switching;
mod system;

pub use crate::interrupt::Interrupt;
pub use diagram::follow;
pub use observer::Observer;

use crate::orbit::{GaitOutcome, GaitRequest};
use crate::return_map::{Open, RequestError, Stop};
use nalgebra::{Complex, DVector};
use thiserror::Error;

/// What to follow.
#[derive(Clone, Debug)]
pub struct ContinuationRequest<'a> {
    /// The gait to start from: all parameters, memory, period, accuracy, tolerance.
    pub gait: GaitRequest<'a>,
    /// Index of the parameter that varies. Its value at the start lies in the range.
    pub parameter: usize,
    /// Its range (SI units), lower end first.
    pub range: (f64, f64),
    /// How.
    pub settings: Settings,
}

/// How to follow. Lengths are parts of the parameter's range (more exactly: lengths in scaled unknowns).
#[derive(Clone, Debug)]
pub struct Settings {
    /// The first step.
    pub initial: f64,
    /// The longest step. What happens twice within one (two flips of the same multiplier) is not seen.
    pub longest: f64,
    /// The shortest step, and how exactly the end of a branch is located where the map stops.
    pub shortest: f64,
    /// Most points of a branch in each direction.
    pub point_limit: usize,
    /// How many period doublings in a row are followed.
    pub doublings: usize,
    /// Whether the other branch is followed at branch points.
    pub branches: bool,
    /// Most branches.
    pub branch_limit: usize,
    /// A request to stop.
    pub interrupt: Interrupt,
    /// Who looks on.
    pub observer: Observer,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            initial: 5e-3,
            longest: 0.02,
            shortest: 1e-7,
            point_limit: 1000,
            doublings: 0,
            branches: false,
            branch_limit: 64,
            interrupt: Interrupt::default(),
            observer: Observer::default(),
        }
    }
}

/// Wrong input.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ContinuationError {
    /// The map refuses the request.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// No parameter has this index.
    #[error("there is no parameter number {0}")]
    Parameter(usize),
    /// The range has no inside, or the start is not in it.
    #[error("the range {lower} to {upper} is empty, or the start {start} is not in it (SI units)")]
    Range {
        /// Lower end.
        lower: f64,
        /// Upper end.
        upper: f64,
        /// Value at the start.
        start: f64,
    },
}

/// What came of it.
#[derive(Clone, Debug)]
pub enum ContinuationOutcome {
    /// There is no gait to start from; the search for it.
    NoStart(Box<GaitOutcome>),
    /// The branches. The first is the one that was asked for.
    Diagram(Diagram),
}

/// Branches, and how they hang together.
#[derive(Clone, Debug, Default)]
pub struct Diagram {
    /// In the order in which they were found: a branch stands behind its parent.
    pub branches: Vec<Branch>,
    /// Branches that could not be entered, or were not for the limit on their number: the branch and its bifurcation.
    pub not_entered: Vec<Parent>,
}

/// A branch of gaits.
#[derive(Clone, Debug)]
pub struct Branch {
    /// How many maps make one period.
    pub period: usize,
    /// Where it was entered; `None` for the first.
    pub parent: Option<Parent>,
    /// In order along the branch, the parameter increasing through the start where the branch is not vertical.
    pub points: Vec<Point>,
    /// Index of the point where it was entered or started.
    pub start: usize,
    /// In order along the branch.
    pub bifurcations: Vec<Bifurcation>,
    /// How it ends before its first point and behind its last.
    pub ends: [EndReason; 2],
    /// Whether its gaits repeat after half of the period already.
    pub repeats_sooner: bool,
}

/// A bifurcation of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parent {
    /// Index into [`Diagram::branches`].
    pub branch: usize,
    /// Index into [`Branch::bifurcations`].
    pub bifurcation: usize,
}

/// A gait of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The parameter's value (SI units).
    pub value: f64,
    /// Section coordinates (SI units).
    pub section: DVector<f64>,
    /// Eigenvalues of the Jacobian by falling magnitude.
    pub multipliers: Vec<Complex<f64>>,
    /// Their largest magnitude; 0 when there are none.
    pub spectral_radius: f64,
    /// In the order of `info().measures`; NaN where the run with measures came to no end.
    pub measures: DVector<f64>,
    /// Duration of one period (s).
    pub duration: f64,
    /// Largest component of P(z) - z, each relative to `max(1, |z_i|)`.
    pub residual: f64,
}

impl Point {
    /// Whether small disturbances die out.
    pub fn stable(&self) -> bool {
        self.spectral_radius < 1.0
    }
}

/// Where gaits change in kind.
#[derive(Clone, Debug)]
pub struct Bifurcation {
    /// How.
    pub kind: Kind,
    /// Index of the branch's point before it.
    pub after: usize,
    /// The gait there.
    pub point: Point,
    /// From which side other motions come, where it could be told; never of folds.
    pub criticality: Option<Criticality>,
}

/// How gaits change in kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A multiplier is 1 and the branch turns round: beyond there are no such gaits.
    Fold,
    /// A multiplier is 1 and another branch crosses (transcritical, pitchfork).
    Branch,
    /// A multiplier is -1: gaits of twice the period branch off.
    Flip,
    /// A complex pair is on the unit circle: slow modulations that grow, or that keep their size, branch off.
    NeimarkSacker,
}

/// From which side other motions come: gaits of twice the period at a flip, a pair of gaits at a branch point, lasting swings at a
/// Neimark-Sacker bifurcation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criticality {
    /// They exist where the multiplier is outside the circle: the change is gradual, and reversible.
    Supercritical,
    /// They exist where the multiplier is still inside, and limit what disturbances the gait survives: the change is a jump.
    Subcritical,
    /// Of a branch point alone: the other branch goes on through it, and both change sides.
    Transcritical,
}

/// An end of the parameter's range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The lower one.
    Lower,
    /// The upper one.
    Upper,
}

/// How a branch ends in one direction.
#[derive(Clone, Debug, PartialEq)]
pub enum EndReason {
    /// At the end of the range, exactly.
    RangeEnd(Side),
    /// It is a loop, and has come back to its start.
    Closed,
    /// The map has no next section crossing beyond the last point, or the step has no length there.
    MapStops(Stop),
    /// Beyond the last point the coordinates repeat, but a state that the motion depends on does not.
    NotClosed(Open),
    /// Newton's method fails however short the step is.
    StepTooSmall,
    /// The coordinates grow beyond all bounds.
    Unbounded,
    /// So many points were asked for.
    PointLimit,
    /// It has come back to the branch of half its period.
    PeriodHalved,
    /// It begins where it was entered, on its parent.
    Parent,
    /// The start belongs to a family of gaits at one parameter value, or is a branch point itself: there is no direction to go.
    NoDirection,
    /// Somebody asked to stop.
    Interrupted,
}
