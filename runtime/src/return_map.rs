//! The object-safe return map: what optimizer, studies and command line see of a model, whatever its sizes.
//!
//! The map is P = symmetry o R o embed (R alone when the spec has no symmetry), from section coordinates to section
//! coordinates, with memory restarted at its initial value; R flows from just after the section's transition to just
//! after the next one.

pub use crate::also_zero::{AlsoZeroAt, Passage};
pub use crate::closing::Open;
use crate::interrupt::Interrupt;
use crate::model::ModelInfo;
pub use crate::replay::{Images, Piece, PieceEnd, Plan, Points, SecondOrder};
use crate::trajectory::{FollowRequest, Trajectory};
use nalgebra::{DMatrix, DVector};
use thiserror::Error;

/// How accurately and how far to integrate, and who may end it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Relative tolerance of the local error.
    pub relative: f64,
    /// Absolute tolerance in SI units.
    pub absolute: f64,
    /// Longest time of one map (s).
    pub time_limit: f64,
    /// Most steps of one map.
    pub step_limit: usize,
    /// How to integrate.
    pub method: Method,
    /// A request to stop, looked at before every step.
    pub interrupt: Interrupt,
}

impl Default for Accuracy {
    fn default() -> Self {
        Self {
            relative: 1e-12,
            absolute: 1e-13,
            time_limit: 100.0,
            step_limit: 100_000,
            method: Method::Automatic,
            interrupt: Interrupt::default(),
        }
    }
}

/// How to integrate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// `Radau5` for models with a mass matrix and for runs that turn out to be stiff, `Explicit` for all others.
    Automatic,
    /// Explicit Runge-Kutta method of order 8; needs a model without a mass matrix.
    Explicit,
    /// Radau IIA with 5 stages, order 9.
    Radau5,
    /// Radau IIA with 3 stages, order 5.
    Radau3,
}

/// One evaluation of the return map.
#[derive(Clone, Copy, Debug)]
pub struct MapRequest<'a> {
    /// Section coordinates z, in the order of `info().coordinates`, SI units.
    pub coordinates: &'a [f64],
    /// All parameters, in the order of `info().parameters`, SI units.
    pub parameters: &'a [f64],
    /// Initial memory, in the order of `info().memory`.
    pub memory: &'a [f64],
    /// How many maps to compose; at least 1. Memory restarts after each.
    pub period: usize,
    /// What to differentiate.
    pub sensitivity: Sensitivity<'a>,
    /// Whether functionals and measures are wanted.
    pub measures: bool,
    /// Accuracy.
    pub accuracy: Accuracy,
}

/// What to differentiate a map with respect to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensitivity<'a> {
    /// Nothing.
    None,
    /// The section coordinates.
    Coordinates,
    /// The section coordinates, then these parameters (by index).
    CoordinatesAndParameters(&'a [usize]),
}

/// A completed map. With d = number of section coordinates and c = number of sensitivity columns
/// (d, then the chosen parameters; 0 for `Sensitivity::None`).
#[derive(Clone, Debug)]
pub struct MapResult {
    /// P(z), length d.
    pub coordinates: DVector<f64>,
    /// Derivative of P(z), d x c.
    pub jacobian: DMatrix<f64>,
    /// Full state on the section at the start of the map, as the embedding makes it.
    pub state: DVector<f64>,
    /// Full state on the section at its end, symmetry applied: on a gait the same, but for states that only count how far the
    /// machine has come.
    pub end: DVector<f64>,
    /// Duration (s).
    pub duration: f64,
    /// Derivative of the duration, length c.
    pub duration_gradient: DVector<f64>,
    /// Measures, in the order of `info().measures`; empty unless asked for.
    pub measures: DVector<f64>,
    /// Derivative of the measures, measures x c; empty unless asked for.
    pub measures_jacobian: DMatrix<f64>,
    /// Transitions in order of time.
    pub events: Vec<Event>,
    /// Functions that are zero together with the guard of the section's transition; empty unless measures were asked for.
    pub also_zero: Vec<AlsoZeroAt>,
    /// Work done.
    pub statistics: Statistics,
    /// The method that was used; never `Automatic`.
    pub method: Method,
    /// What the user has to know about the linearisation (grazing, ties).
    pub warnings: Vec<Warning>,
}

/// A place where an extremal functional could have been taken: all measures as if it had been taken there. Those of the place
/// where it was taken are the measures of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Index into `info().functionals`.
    pub functional: usize,
    /// The place, as a fraction of the duration of the map.
    pub phase: f64,
    /// Measures, in the order of `info().measures`.
    pub measures: DVector<f64>,
    /// Their derivative, measures x c.
    pub measures_jacobian: DMatrix<f64>,
}

/// A transition that fired.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Index into `info().transitions`.
    pub transition: usize,
    /// Time since the start of the map (s).
    pub time: f64,
    /// Time derivative of the guard along the flow just before it fired, in the guard's unit per second.
    pub transversality: f64,
    /// Largest magnitude of that derivative since the transition before (seen at the ends of steps).
    pub fastest: f64,
}

/// Something that limits what a completed map means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Warning {
    /// The flow only touched this transition's guard, or crossed it so flatly that the linearisation is not valid.
    Grazing {
        /// Index into `info().transitions`.
        transition: usize,
        /// When (s).
        time: f64,
        /// Time derivative of the guard there.
        transversality: f64,
    },
    /// Two transitions fired at the same time to rounding; the first in the spec's order was taken.
    Tie {
        /// The one that was taken.
        taken: usize,
        /// The other.
        other: usize,
        /// When (s).
        time: f64,
    },
}

/// Work done by one evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations of the flow.
    pub evaluations: usize,
}

/// A map that has no next section crossing, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Why.
    pub reason: StopReason,
    /// When (s).
    pub time: f64,
    /// The state there.
    pub state: Vec<f64>,
}

/// Why a run has no next step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// No transition fired within the time limit.
    NoEvent,
    /// More steps than allowed.
    StepLimit,
    /// The error control asks for a step below rounding.
    StepTooSmall,
    /// A value is not finite: the run left the domain where the model is defined.
    NotFinite,
    /// The state contradicts the equations where the mass matrix is singular: rates that would lead on do not exist.
    Inconsistent,
    /// Transitions pile up in time (or a step takes no time at all).
    Zeno,
    /// Somebody asked to stop: nothing is said of the run.
    Interrupted,
}

impl StopReason {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::NoEvent => "no_event",
            Self::StepLimit => "step_limit",
            Self::StepTooSmall => "step_too_small",
            Self::NotFinite => "not_finite",
            Self::Inconsistent => "inconsistent",
            Self::Zeno => "zeno",
            Self::Interrupted => "interrupted",
        }
    }
}

/// What a map ended with; both are results, not errors.
#[derive(Clone, Debug)]
pub enum MapOutcome {
    /// The section was reached.
    Completed(Box<MapResult>),
    /// It was not.
    Stopped(Stop),
}

/// A wrong request.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RequestError {
    /// A slice has the wrong length.
    #[error("{what}: expected {expected} values, got {got}")]
    Length {
        /// Which.
        what: &'static str,
        /// Expected length.
        expected: usize,
        /// Length given.
        got: usize,
    },
    /// An input is not a finite number.
    #[error("{what} number {index} is not a finite number")]
    NotFinite {
        /// Which.
        what: &'static str,
        /// Index of the value.
        index: usize,
    },
    /// An accuracy setting makes no sense.
    #[error("{0}")]
    Accuracy(&'static str),
    /// The equations depend on the time since the start of the run, so that a fixed point of one map is no periodic motion.
    #[error(
        "model `{0}` depends on `t`, so a fixed point of its return map is not a periodic gait; make the phase a state \
         (phi' = omega) and a section coordinate instead of using `t`"
    )]
    ExplicitTime(&'static str),
    /// The explicit method was asked for where there is no explicit flow.
    #[error("model `{0}` has a mass matrix, which the explicit method cannot treat; take `radau5` or `radau3`")]
    NoExplicitFlow(&'static str),
    /// A method that is compiled in for models with a mass matrix only.
    #[error(
        "model `{0}` has no mass matrix, and for such models there is no `radau3`; take `radau5` to check the explicit method"
    )]
    NoMassMatrix(&'static str),
    /// Multiple shooting was asked for where there is no plan to cut.
    #[error(
        "the return map of model `{0}` cannot be cut into segments here (several maps in a row, a mass matrix, a tie or grazing \
         on the way); use 1 segment"
    )]
    NoPlan(&'static str),
    /// A plan of one model was given to another.
    #[error("the plan was made for model `{made_for}`, not for `{given_to}`; make a plan with the same return map")]
    ForeignPlan {
        /// The model of the plan.
        made_for: &'static str,
        /// The model that it was given to.
        given_to: &'static str,
    },
    /// The model has no section, so it has no return map.
    #[error("model `{0}` has no [section], so it has no return map")]
    NoSection(&'static str),
    /// How far to follow a run, or how densely to sample it, makes no sense.
    #[error("{0}")]
    Follow(&'static str),
    /// A trajectory would hold more values than there is room for.
    #[error("more than {limit} values; sample at longer intervals, or do not go beyond {time:.6} s")]
    TooManyValues {
        /// The most values of a trajectory.
        limit: usize,
        /// When it would hold so many (s).
        time: f64,
    },
    /// A map that is no machine's has no trajectories.
    #[error("the return map of `{0}` has no trajectories: it is not that of a compiled model")]
    NoTrajectory(&'static str),
}

/// A model's return map with sizes erased.
///
/// What concerns plans has defaults for maps that have none: every map is then run in full.
pub trait ReturnMap: Send + Sync {
    /// Names, units and structure.
    fn info(&self) -> &'static ModelInfo;

    /// Evaluates the map.
    ///
    /// # Errors
    /// When the request itself is wrong; a map without a next section crossing is `Ok(MapOutcome::Stopped)`.
    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError>;

    /// Evaluates the map, with derivatives in the section coordinates and without measures, and keeps its plan. There is none
    /// where the map stops, grazes, ties, holds a guard back by its `when`, or is integrated by an implicit method.
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    fn plan(&self, request: &MapRequest<'_>) -> Result<(MapOutcome, Option<Plan>), RequestError> {
        Ok((self.evaluate(request)?, None))
    }

    /// Evaluates the map, and says where else its extremal functionals could have been taken: local extrema and ends of segments,
    /// the best few of each functional in order of time, the one taken among them. None for a map that does not know.
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    fn candidates(&self, request: &MapRequest<'_>) -> Result<(MapOutcome, Vec<Candidate>), RequestError> {
        Ok((self.evaluate(request)?, Vec::new()))
    }

    /// Replays a plan at each point, one after the other; `images` says where it held.
    ///
    /// # Errors
    /// When the plan is another model's, or the points do not fit the model.
    fn replay(&self, plan: &Plan, points: Points<'_>, images: &mut Images) -> Result<(), RequestError> {
        let _ = plan;
        images.make_room(points.count(self.info())?, self.info().coordinates.len());
        Ok(())
    }

    /// Runs a piece of a plan from `start`: section coordinates for the first piece, a full state for the others. `None` where
    /// the plan does not hold.
    ///
    /// # Errors
    /// When the plan is another model's, or a length does not fit.
    fn piece(&self, piece: &Piece, start: &[f64], parameters: &[f64]) -> Result<Option<PieceEnd>, RequestError> {
        let _ = (piece, start, parameters);
        Ok(None)
    }

    /// Second derivatives of the map at a point, along its section coordinates and the chosen parameters (by index), on a plan
    /// that was made at this point. `None` where the plan does not hold.
    ///
    /// # Errors
    /// As [`Self::replay`]; also when a parameter index is out of range.
    fn second_order(
        &self,
        plan: &Plan,
        point: Points<'_>,
        chosen: &[usize],
    ) -> Result<Option<SecondOrder>, RequestError> {
        let _ = (plan, point, chosen);
        Ok(None)
    }

    /// Follows the real machine from any start: memory kept, no symmetry, no projection; see [`crate::trajectory`].
    ///
    /// # Errors
    /// When the request itself is wrong, or would hold more values than [`crate::trajectory::MOST_VALUES`]; a run that stops
    /// on its way is a trajectory up to there.
    fn follow(&self, request: &FollowRequest<'_>) -> Result<Trajectory, RequestError> {
        let _ = request;
        Err(RequestError::NoTrajectory(self.info().name))
    }

    /// Where the map leads, without derivatives, by a second route that shares nothing with [`Self::evaluate`]: Gauss
    /// collocation on a fixed grid. `stretches` are the times between transitions, as an evaluation found them, and `steps` says
    /// into how many steps each is cut; of the accuracy nothing is used. `None` where a step cannot be solved, where the
    /// transitions come otherwise, or where the map has no such route.
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    fn collocate(
        &self,
        request: &MapRequest<'_>,
        stretches: &[f64],
        steps: usize,
    ) -> Result<Option<DVector<f64>>, RequestError> {
        let _ = (request, stretches, steps);
        Ok(None)
    }
}
