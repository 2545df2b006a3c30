//! Whether a fixed point of the section's coordinates is a gait: the other states have to return as well.
//!
//! The embedding says what they are at the start of a map; where the motion does not lead them back there, the next step is
//! another one. States that nothing depends on, as the place of a runner, may end anywhere (`ModelInfo::returning`).

use crate::model::ModelInfo;
use crate::return_map::MapResult;

/// Differences below this part of a state's size are those of integration, ...
const CLOSED: f64 = 1e-6;
/// ... and below this many times the tolerance.
const OF_TOLERANCE: f64 = 1e3;

/// A state that a fixed point of the coordinates does not lead back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Open {
    /// Index into `info().states`.
    pub state: usize,
    /// Its value at the start of the map (SI units) ...
    pub start: f64,
    /// ... and at its end, symmetry applied.
    pub end: f64,
}

impl Open {
    /// In words, with the state's name and unit.
    pub fn describe(&self, info: &ModelInfo) -> String {
        let (name, unit) = info.states.get(self.state).map_or(("?", ""), |state| (state.name, state.si));
        let unit = if unit == "1" { String::new() } else { format!(" {unit}") };
        format!(
            "the section's coordinates repeat, but `{name}` begins at {:.4}{unit} and ends at {:.4}{unit}: the next step is another one, and its \
             embedding does not say what the motion makes of it",
            self.start, self.end
        )
    }
}

impl MapResult {
    /// The first state that has to return and does not, after a map at this relative tolerance.
    pub fn open(&self, info: &ModelInfo, relative: f64) -> Option<Open> {
        let bound = CLOSED.max(OF_TOLERANCE * relative);
        info.returning.iter().find_map(|&state| {
            let (start, end) = (*self.state.get(state)?, *self.end.get(state)?);
            // Written so that what is no number counts as open.
            let closed = (end - start).abs() <= bound * (1.0 + start.abs().max(end.abs()));
            (!closed).then_some(Open { state, start, end })
        })
    }
}
