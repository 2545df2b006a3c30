//! The run that a page shows, and what captions say of it.

use super::Study;
use gaitc_runtime::return_map::{RequestError, StopReason};
use gaitc_runtime::trajectory::{FollowRequest, Sampling, Start, Trajectory, Until};

/// Samples of a step.
const SAMPLES_A_STEP: usize = 80;
/// How long a machine that comes to no next step is shown after its last one (s): enough to see it fall.
const FALL: f64 = 2.0;

impl Study<'_> {
    /// Follows the machine: on its gait where there is one, else from the first guess.
    pub(super) fn follow(&self, steps: usize) -> Result<Option<Trajectory>, RequestError> {
        let Some(request) = self.request else { return Ok(None) };
        let start = self.gait().map_or(self.guess, |gait| gait.coordinates.as_slice());
        let samples = SAMPLES_A_STEP.saturating_mul(steps);
        let follow = FollowRequest {
            start: Start::Section(start),
            parameters: self.parameters,
            memory: request.memory,
            until: Until::Crossings(steps),
            sampling: Sampling::Count(samples),
            accuracy: request.accuracy,
        };
        let run = self.loaded.compiled.follow(&follow)?;
        if run.stop != Some(StopReason::NoEvent) {
            return Ok(Some(run));
        }
        let until = Until::Time(run.events.last().map_or(0.0, |event| event.time) + FALL);
        let mut fall = self.loaded.compiled.follow(&FollowRequest { until, ..follow })?;
        fall.stop = run.stop;
        Ok(Some(fall))
    }

    /// What a run shows: `two steps`, or how far it came.
    pub(super) fn extent(&self, run: &Trajectory, steps: usize) -> String {
        let section = self.loaded.spec.section.as_ref().map(|section| section.transition);
        let made = run.events.iter().filter(|event| Some(event.transition) == section).count();
        let from = if self.gait().is_some() { "" } else { " from the first guess" };
        match run.stop {
            None => format!("{}{from}", counted(steps)),
            Some(_) if made == 0 => format!("the run{from}, which comes to no step"),
            Some(_) => format!("the run{from}, which ends after {}", counted(made)),
        }
    }
}

fn counted(steps: usize) -> String {
    match steps {
        1 => "one step".to_owned(),
        2 => "two steps".to_owned(),
        steps => format!("{steps} steps"),
    }
}

/// A sentence's first letter as a capital.
pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
