//! What answers cost, in steps and evaluations of the flow: not more than when these numbers were written down.
//!
//! Counts and not seconds, since seconds depend on the computer and on what else it does, so that a test of them is either
//! blind or wrong now and then. Counts are the same everywhere, but for a last bit that decides whether a step is rejected,
//! and what makes an answer slow in this program is most often that it takes more of them: a controller that shrinks its
//! steps too far, an event that is approached once more, a plan with steps that it does not need. What a step costs itself
//! is for `cargo bench --bench units`.
//!
//! Where a change lowers a count the number here goes down with it; where it raises one there is a reason to write down.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a test may fail loudly

mod maps;

use gaitc_runtime::orbit::{GaitRequest, find_gait};
use gaitc_runtime::return_map::{Accuracy, MapOutcome, MapRequest, Sensitivity};
use maps::Machine;

/// What a model costs at its gait.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Effort {
    model: &'static str,
    /// Newton steps from the start of the spec to the gait.
    newton: usize,
    /// Steps of one map at a tolerance of 1e-9, those rejected, and evaluations of the flow.
    map: [usize; 3],
    /// The same with measures.
    measured: [usize; 3],
    /// Steps of a replay; 0 without a plan.
    replay: usize,
}

const EFFORTS: &[Effort] = &[
    Effort { model: "angle_switched", newton: 6, map: [11, 2, 245], measured: [12, 2, 427], replay: 11 },
    Effort { model: "compass_walker", newton: 4, map: [10, 2, 320], measured: [146, 41, 13715], replay: 0 },
    Effort { model: "fg_template", newton: 6, map: [11, 3, 222], measured: [13, 4, 562], replay: 11 },
    Effort { model: "power_stroke_muscle", newton: 4, map: [16, 2, 303], measured: [17, 2, 783], replay: 15 },
    Effort { model: "prescribed_length", newton: 4, map: [6, 1, 112], measured: [10, 2, 314], replay: 6 },
    Effort { model: "self_exciting", newton: 4, map: [16, 4, 430], measured: [28, 2, 950], replay: 0 },
    Effort { model: "self_exciting_rack", newton: 4, map: [40, 2, 663], measured: [41, 3, 1123], replay: 38 },
    Effort { model: "self_exciting_rotor", newton: 4, map: [18, 3, 420], measured: [31, 3, 1040], replay: 0 },
    Effort { model: "slip_runner", newton: 7, map: [12, 4, 372], measured: [12, 4, 588], replay: 12 },
];

impl Effort {
    /// What it costs now.
    fn now(model: &'static str) -> Self {
        let machine = Machine::new(model, &[]);
        let (compiled, memory, start) = (machine.model.compiled, machine.model.memory(), machine.model.start());
        let found = find_gait(compiled, &GaitRequest::new(&machine.parameters, &memory), &start).unwrap();
        let coordinates = found.gait.expect("every model has a gait").coordinates;
        let request = |measures| MapRequest {
            coordinates: coordinates.as_slice(),
            parameters: &machine.parameters,
            memory: &memory,
            period: 1,
            sensitivity: Sensitivity::Coordinates,
            measures,
            accuracy: Accuracy { relative: 1e-9, absolute: 1e-10, ..Accuracy::default() },
        };
        let counts = |measures| match compiled.evaluate(&request(measures)).unwrap() {
            MapOutcome::Completed(map) => [map.statistics.steps, map.statistics.rejected, map.statistics.evaluations],
            MapOutcome::Stopped(stop) => panic!("{model}: {stop:?}"),
        };
        let (_, plan) = compiled.plan(&request(false)).unwrap();
        Self {
            model,
            newton: found.iterations,
            map: counts(false),
            measured: counts(true),
            replay: plan.map_or(0, |plan| plan.steps()),
        }
    }

    /// Whether nothing is more than it was; a plan is not lost.
    fn within(&self, before: &Self) -> bool {
        let not_more = |now: &[usize], before: &[usize]| now.iter().zip(before).all(|(now, before)| now <= before);
        let plan = self.replay <= before.replay && (self.replay > 0) == (before.replay > 0);
        self.newton <= before.newton
            && not_more(&self.map, &before.map)
            && not_more(&self.measured, &before.measured)
            && plan
    }
}

#[test]
fn no_answer_costs_more_than_it_did() {
    assert!(EFFORTS.len() >= 6);
    let worse: Vec<String> = EFFORTS
        .iter()
        .map(|before| (before, Effort::now(before.model)))
        .filter(|(before, now)| !now.within(before))
        .map(|(before, now)| format!("before {before:?}\n   now {now:?}"))
        .collect();
    assert!(worse.is_empty(), "{}", worse.join("\n"));
}
