//! Records a run as a plan, while it goes on.

use super::plan::{Checks, End, Leg, Plan, Sides};
use crate::event::{Side, Surface, Watched};
use crate::model::{Direction, ModelInfo};
use crate::return_map::Accuracy;

/// What has been recorded so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Record {
    turns: Vec<Vec<Leg>>,
    /// Whether something happened that no plan can say.
    unfit: bool,
}

impl Record {
    /// A map begins.
    pub(crate) fn turn(&mut self) {
        self.turns.push(Vec::new());
    }

    /// A leg begins, in this mode with this memory and these selectors.
    pub(crate) fn leg(&mut self, mode: usize, tau: f64, memory: &[f64], branch: &[bool], watched: &[Watched]) {
        let sides = |w: &Watched| Sides {
            surface: w.surface,
            at: vec![w.side],
            clock_only: w.start.clock_only,
            noise: w.start.rounding,
        };
        let end = End { surfaces: Vec::new(), clock_only: false, from: Side::Unknown, fastest: 0.0 };
        let leg = Leg {
            mode,
            tau,
            memory: memory.to_vec(),
            branch: branch.to_vec(),
            sizes: Vec::new(),
            errors: Vec::new(),
            watched: watched.iter().map(sides).collect(),
            end,
        };
        match self.turns.last_mut() {
            Some(legs) => legs.push(leg),
            None => self.unfit = true,
        }
    }

    /// A step of size `h` was taken, with this error, without an event; `watched` stands at its end.
    pub(crate) fn step(&mut self, h: f64, error: f64, watched: &[Watched]) {
        let sides = watched.iter().map(|w| (w.side, w.direction, w.clock_only()));
        self.add(h, error, sides);
    }

    /// A step of size `h` was taken to the first of the events `passed` (indices into `watched`), where the surfaces are on
    /// these sides.
    pub(crate) fn end(&mut self, h: f64, watched: &[Watched], sides: &[Side], passed: &[usize]) {
        let all = watched.iter().zip(sides).enumerate();
        let all = all.map(|(i, (w, side))| {
            let side = if passed.contains(&i) { w.side } else { *side };
            (side, w.direction, w.clock_only())
        });
        self.add(h, 0.0, all);
        let Some(leg) = self.turns.last_mut().and_then(|legs| legs.last_mut()) else {
            self.unfit = true;
            return;
        };
        let surfaces: Vec<Surface> = passed.iter().filter_map(|i| watched.get(*i)).map(|w| w.surface).collect();
        let transitions = surfaces.iter().filter(|s| matches!(s, Surface::Transition(_))).count();
        let first = passed.first().and_then(|i| leg.watched.get(*i).zip(watched.get(*i)));
        match first {
            Some((sides, w)) if transitions <= 1 => {
                let from = match w.direction {
                    Direction::Falling => Side::Positive,
                    Direction::Rising => Side::Negative,
                    Direction::Either => w.side,
                };
                leg.end = End { surfaces, clock_only: sides.clock_only, from, fastest: w.fastest };
            }
            _ => self.unfit = true,
        }
    }

    fn add(&mut self, h: f64, error: f64, sides: impl Iterator<Item = (Side, Direction, bool)>) {
        let Some(leg) = self.turns.last_mut().and_then(|legs| legs.last_mut()) else {
            self.unfit = true;
            return;
        };
        leg.sizes.push(h);
        leg.errors.push(error);
        for (slot, (side, direction, clock_only)) in leg.watched.iter_mut().zip(sides) {
            let from = slot.at.last().copied().unwrap_or(Side::Unknown);
            // A guard that passed zero the way that fires, and did not fire: its `when` did not hold, just there.
            let held_back = from != side && from.leaves(direction);
            self.unfit |= side == Side::Unknown || held_back;
            slot.at.push(side);
            slot.clock_only &= clock_only;
        }
    }

    /// The plan, if there is one.
    pub(crate) fn plan(self, info: &'static ModelInfo, accuracy: Accuracy) -> Option<Plan> {
        let whole = self.turns.iter().flatten().all(|leg| !leg.end.surfaces.is_empty());
        (!self.unfit && whole).then_some(Plan { info, accuracy, turns: self.turns, checks: Checks::Errors })
    }
}
