//! A search for a gait: what is asked, and what comes back.

use crate::return_map::{Accuracy, MapResult, Open, Stop};
use nalgebra::{Complex, DVector};

/// What to look for.
#[derive(Clone, Copy, Debug)]
pub struct GaitRequest<'a> {
    /// All parameters, SI units.
    pub parameters: &'a [f64],
    /// Initial memory.
    pub memory: &'a [f64],
    /// How many maps make one period; at least 1.
    pub period: usize,
    /// Accuracy of the map.
    pub accuracy: Accuracy,
    /// Bound on the residual, relative to `max(1, |z_i|)` in each coordinate. Newton goes on below it as long as
    /// that helps.
    pub tolerance: f64,
    /// Most Newton steps from one start.
    pub iteration_limit: usize,
    /// Most maps, over all starts: then the search gives up. Of several in a row each counts; multiple shooting is not counted. A
    /// search with a limit passes over trials whose maps are much longer than that of the guess, too.
    pub map_limit: usize,
    /// Whether functionals and measures of the gait are wanted.
    pub measures: bool,
    /// Into how many segments a map is cut: 1 is single shooting, more are multiple shooting, for models
    /// without a mass matrix and period 1.
    pub segments: usize,
}

impl<'a> GaitRequest<'a> {
    /// Period 1, default accuracy, tolerance 1e-10, 50 iterations, any number of maps, measures.
    pub fn new(parameters: &'a [f64], memory: &'a [f64]) -> Self {
        let accuracy = Accuracy::default();
        Self {
            parameters,
            memory,
            period: 1,
            accuracy,
            tolerance: 1e-10,
            iteration_limit: 50,
            map_limit: usize::MAX,
            measures: true,
            segments: 1,
        }
    }
}

/// A fixed point of the return map.
#[derive(Clone, Debug)]
pub struct Gait {
    /// Section coordinates z, length d.
    pub coordinates: DVector<f64>,
    /// The map evaluated there: its Jacobian (d x d), state, duration, measures, events, warnings.
    pub map: MapResult,
    /// Eigenvalues of the Jacobian by falling magnitude; empty for a section without coordinates.
    pub multipliers: Vec<Complex<f64>>,
    /// Their largest magnitude; 0 when there are none.
    pub spectral_radius: f64,
}

/// How the search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum GaitStatus {
    /// The residual is within the tolerance.
    Converged,
    /// The map has no next section crossing where the search stands.
    Stopped(Stop),
    /// The coordinates repeat, but a state that the motion depends on does not.
    Open(Open),
    /// The search came to no fixed point.
    NotConverged,
    /// The search came to no fixed point within the number of maps that it may take.
    GaveUp,
}

impl GaitStatus {
    /// Its name in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Open(_) => "not_closed",
            Self::NotConverged => "not_converged",
            Self::GaveUp => "map_limit",
            Self::Stopped(stop) => stop.reason.name(),
        }
    }
}

/// The result of a search.
#[derive(Clone, Debug)]
pub struct GaitOutcome {
    /// How it ended.
    pub status: GaitStatus,
    /// One sentence for people.
    pub message: String,
    /// The fixed point when converged; else the last point where the map could be evaluated, if any.
    pub gait: Option<Gait>,
    /// Largest component of P(z) - z, each relative to `max(1, |z_i|)`; infinite when nothing could be evaluated.
    pub residual: f64,
    /// Newton steps taken, over all starts.
    pub iterations: usize,
    /// Maps run in the search; see [`GaitRequest::map_limit`].
    pub maps: usize,
}
