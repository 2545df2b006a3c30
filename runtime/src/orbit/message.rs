//! How a search for a gait ended, in words.

use super::gait::{GaitRequest, GaitStatus};
use crate::model::ModelInfo;
use crate::return_map::StopReason;

/// One sentence on the end of a search.
pub(super) fn message(info: &ModelInfo, status: &GaitStatus, residual: f64, request: &GaitRequest<'_>) -> String {
    let tolerance = request.tolerance;
    match status {
        GaitStatus::Open(open) => format!("no gait: {}", open.describe(info)),
        GaitStatus::Converged => format!("the step maps onto itself to {residual:.1e}"),
        GaitStatus::Stopped(stop) => format!(
            "the map has no next section crossing from the guess: {} after {:.4} s; try another guess or other parameters",
            why(stop.reason),
            stop.time
        ),
        GaitStatus::NotConverged => format!(
            "no fixed point found: the residual stays at {residual:.1e}, above the tolerance {tolerance:.1e}; try another guess, or follow the gait from parameters where it is known"
        ),
        GaitStatus::GaveUp => format!(
            "no fixed point found within {} maps: the residual stays at {residual:.1e}, above the tolerance {tolerance:.1e}; try another guess, or follow the gait from parameters where it is known",
            request.map_limit
        ),
    }
}

/// Why a run has no next step, in words.
pub fn why(reason: StopReason) -> &'static str {
    match reason {
        StopReason::NoEvent => "no transition fired within the time limit",
        StopReason::StepLimit => "the limit on steps was reached",
        StopReason::StepTooSmall => "the error control asked for a step below rounding",
        StopReason::NotFinite => "a value was not finite, the run left the model's domain",
        StopReason::Inconsistent => {
            "the state contradicts the equations where the mass matrix is singular (does the reset lead to a consistent state?)"
        }
        StopReason::Zeno => "transitions piled up in time, or a step took no time",
        StopReason::Interrupted => "it was interrupted",
    }
}
