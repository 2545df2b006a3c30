//! What commands say of the ways in which a run can stop.

use gaitc_runtime::return_map::StopReason;

/// What happened, and what to do.
pub(super) fn explanation(reason: StopReason) -> (&'static str, &'static str) {
    match reason {
        StopReason::NoEvent => (
            "no step ended within the time limit of 100 s: it fell, or came to rest",
            "start elsewhere (--from, --gait), or set other parameters (--set)",
        ),
        StopReason::StepLimit => (
            "the integration needs more steps than are allowed",
            "integrate less exactly (--tol 1e-8) or by another method (--method radau5)",
        ),
        StopReason::StepTooSmall => (
            "the integration needs steps below rounding",
            "look at the last samples (--out FILE.csv): some rate grows without bound there",
        ),
        StopReason::NotFinite => (
            "a value is not finite: the run left the domain where the model is defined",
            "look at the last samples (--out FILE.csv), and start elsewhere or set other parameters (--set)",
        ),
        StopReason::Inconsistent => (
            "the state contradicts the equations where the mass matrix is singular",
            "start in a state that obeys them; after a transition: let its reset lead to such a state",
        ),
        StopReason::Zeno => (
            "transitions pile up in time, or a step takes no time",
            "look at the events (--events FILE.csv); a guard that is zero at the start or just after a reset fires at once",
        ),
        StopReason::Interrupted => ("it was interrupted", "run the same command again"),
    }
}
