//! A plan: what a map did that was integrated with error control and event location, so that maps near it can do the same
//! without looking for it.
//!
//! It holds the mesh of step sizes, the modes, memory and selectors of each leg, on which side of every surface each step
//! ended, and which events ended the legs. It holds no number of the solution: a replay computes everything anew.

use crate::event::{Side, Surface};
use crate::model::ModelInfo;
use crate::return_map::Accuracy;

/// The plan of a return map.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The model that it was made for.
    pub(crate) info: &'static ModelInfo,
    /// The accuracy that it was made with, and that replays are held to.
    pub(crate) accuracy: Accuracy,
    /// For each map that is composed, its legs.
    pub(crate) turns: Vec<Vec<Leg>>,
    /// What replays of it check.
    pub(crate) checks: Checks,
}

/// What is checked besides the sides of surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Checks {
    /// The errors of state and variations.
    Errors,
    /// The errors of the state. Pieces carry variations along all states, also those that vanish fast and for which no mesh was
    /// made; in the product of the pieces nothing is left of these, and the others have the errors that they have in the whole.
    State,
    /// All errors, and whether surfaces are resolved: on a mesh that is not that of the run.
    Trial,
}

/// From one event to the next.
#[derive(Clone, Debug)]
pub(crate) struct Leg {
    /// Index of the mode.
    pub(crate) mode: usize,
    /// Clock at its start (s); not 0 for a part of a leg (`pieces`). Where a leg follows a switch the clock runs on.
    pub(crate) tau: f64,
    /// Memory.
    pub(crate) memory: Vec<f64>,
    /// Branch selectors.
    pub(crate) branch: Vec<bool>,
    /// Sizes of the steps (s).
    pub(crate) sizes: Vec<f64>,
    /// Errors of the steps relative to the tolerance; 0 for the last one, which is no more than a part of a step.
    pub(crate) errors: Vec<f64>,
    /// The surfaces that are watched.
    pub(crate) watched: Vec<Sides>,
    /// How it ends.
    pub(crate) end: End,
}

/// A surface through a leg.
#[derive(Clone, Debug)]
pub(crate) struct Sides {
    /// Which.
    pub(crate) surface: Surface,
    /// Its side at the start, and at the end of each step; unknown where that is not looked at.
    pub(crate) at: Vec<Side>,
    /// Whether its function depends on time and parameters only.
    pub(crate) clock_only: bool,
    /// Below this its value at the start was zero to rounding. A surface that has just been passed is off zero by what was
    /// rounded on the whole way to it.
    pub(crate) noise: f64,
}

/// How a leg ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct End {
    /// The surfaces that are passed at the same instant; the first decides when. A transition stands alone among its like.
    /// Empty where a piece of a plan ends between events.
    pub(crate) surfaces: Vec<Surface>,
    /// Whether the time of the first follows from the parameters alone.
    pub(crate) clock_only: bool,
    /// The side from which the first is passed. That where the last step starts may be the other one: a passage the other way,
    /// which does not count, comes in between.
    pub(crate) from: Side,
    /// Largest magnitude of the first one's rate in the leg.
    pub(crate) fastest: f64,
}

impl Plan {
    /// How many steps a replay takes.
    pub fn steps(&self) -> usize {
        self.legs().map(|leg| leg.sizes.len()).sum()
    }

    /// All legs in order of time.
    pub(crate) fn legs(&self) -> impl Iterator<Item = &Leg> {
        self.turns.iter().flatten()
    }
}

impl Leg {
    /// Duration (s).
    pub(crate) fn length(&self) -> f64 {
        self.sizes.iter().sum()
    }
}
