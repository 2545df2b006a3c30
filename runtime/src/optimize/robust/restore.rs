//! Where a robust search ends without an optimum: constraints are brought to hold for all machines, one after the other, and
//! what cannot be is named with the machine that is in the way.
//!
//! The restoration of a single machine (module `restore`) with scenes: each constraint is pushed until it holds in all of them,
//! by maximising its worst margin (or minimising the largest spectral radius) while those that hold everywhere are kept.

use super::super::conflict::Reached;
use super::super::gait::{self, NoGait, Start};
use super::super::pieces;
use super::super::problem::ProblemError;
use super::super::program::Failure;
use super::super::scene::Scene;
use super::super::search::Ended;
use super::super::standing::{Standing, standing};
use super::super::task::{Goal, Task};
use super::Robust;

/// What a push may lose of the constraints that it keeps, in units of their scales.
const SLACK: f64 = 1e-6;
/// Margin, in units of its scale, from which a constraint that holds is unlikely to be in the way.
const LOOSE: f64 = 1e-3;

/// A constraint that cannot be brought to hold for all machines.
#[derive(Clone, Debug, PartialEq)]
pub struct InTheWay {
    /// The machine with its smallest margin: values of the uncertain parameters, SI units, in their order.
    pub values: Vec<f64>,
    /// The constraint, and how far it gets there.
    pub reached: Reached,
    /// The constraints that hold for all machines there, and limit it (indices into `Problem::constraints`).
    pub limits: Vec<usize>,
}

/// A design with the gaits of all machines.
#[derive(Clone, Debug)]
pub(super) struct Design {
    /// All parameters, those of the problem where a scene has its own.
    pub(super) parameters: Vec<f64>,
    /// Section coordinates of all scenes, one after the other.
    pub(super) section: Vec<f64>,
}

/// Where a restoration ended.
pub(super) enum Restored {
    /// A design with which all constraints hold in all scenes.
    Feasible(Design),
    /// One could not be brought to hold.
    Blocked(Box<InTheWay>),
    /// There was no gait to go on from, a value is not defined, or somebody asked to stop.
    Lost,
}

/// What each scene's gait is worth.
struct Stands {
    gaits: Vec<Start>,
    standings: Vec<Standing>,
}

impl Stands {
    /// Smallest scaled margin of a constraint, and the scene that has it; NaN counts as the smallest.
    fn least(&self, constraint: usize) -> (usize, f64) {
        let margin = |s: usize| match self.standings[s].scaled[constraint] {
            margin if margin.is_nan() => f64::NEG_INFINITY,
            margin => margin,
        };
        let scene = (0..self.standings.len()).min_by(|a, b| margin(*a).total_cmp(&margin(*b))).unwrap_or(0);
        (scene, margin(scene))
    }
}

impl Robust<'_> {
    /// Brings all constraints to hold in all scenes, from a design.
    ///
    /// # Errors
    /// Only for a problem that turns out to be wrong as stated.
    pub(super) fn restored(&self, scenes: &[Scene], from: &Design) -> Result<Restored, ProblemError> {
        let count = self.problem.constraints.len();
        let tolerance = 10.0 * self.problem.settings.attainable_feasibility();
        let mut kept = vec![false; count];
        let mut at = from.clone();
        let Some(mut now) = self.stands_at(scenes, &at)? else { return Ok(Restored::Lost) };
        loop {
            for (i, kept) in kept.iter_mut().enumerate() {
                *kept |= now.least(i).1 >= -tolerance;
            }
            let missing = (0..count).filter(|i| !kept[*i]);
            // The easiest first.
            let Some(next) = missing.max_by(|a, b| now.least(*a).1.total_cmp(&now.least(*b).1).then(b.cmp(a))) else {
                return Ok(Restored::Feasible(at));
            };
            let task = Task { goal: Goal::Push(next), kept: kept.clone() };
            let ended = match self.pushed(scenes, task, &at) {
                Ok(ended) => ended,
                Err(Failure::Wrong(error)) => return Err(error),
                Err(_) => return Ok(Restored::Lost),
            };
            at = Design { parameters: ended.point.parameters, section: ended.point.section };
            now = match self.stands_at(scenes, &at)? {
                Some(now) if !self.problem.settings.interrupt.requested() => now,
                _ => return Ok(Restored::Lost),
            };
            let all_kept = (0..count).all(|i| !kept[i] || now.least(i).1 >= -SLACK);
            if !all_kept || now.least(next).1 < -tolerance {
                return Ok(Restored::Blocked(Box::new(self.in_the_way(scenes, &now, &kept, next))));
            }
            kept[next] = true;
        }
    }

    fn pushed(&self, scenes: &[Scene], task: Task, from: &Design) -> Result<Ended, Failure> {
        let Design { parameters, section } = from;
        Ok(pieces::searched(self.problem, &task, scenes, (parameters, section))?.1)
    }

    /// Gaits and values of all scenes with a design; `None` where one is missing.
    fn stands_at(&self, scenes: &[Scene], design: &Design) -> Result<Option<Stands>, ProblemError> {
        let d = self.problem.start.len();
        let one = |(s, scene): (usize, &Scene)| {
            let parameters = scene.parameters(&design.parameters).into_owned();
            let section = gait::near(self.problem, &parameters, &design.section[s * d..(s + 1) * d])?;
            let gait = Start { parameters, section };
            let standing = standing(self.problem, &gait)?;
            Ok((gait, standing))
        };
        match scenes.iter().enumerate().map(one).collect::<Result<Vec<_>, NoGait>>() {
            Ok(all) => {
                let (gaits, standings) = all.into_iter().unzip();
                Ok(Some(Stands { gaits, standings }))
            }
            Err(NoGait::Wrong(error)) => Err(error),
            Err(_) => Ok(None),
        }
    }

    fn in_the_way(&self, scenes: &[Scene], now: &Stands, kept: &[bool], failing: usize) -> InTheWay {
        let (scene, scaled) = now.least(failing);
        let (gait, standing) = (&now.gaits[scene], &now.standings[scene]);
        InTheWay {
            values: self.values(&scenes[scene]),
            reached: Reached {
                constraint: failing,
                margin: standing.margins[failing],
                scaled,
                parameters: gait.parameters.clone(),
                section: gait.section.clone(),
                measures: standing.measures.clone(),
                spectral_radius: standing.spectral_radius,
            },
            limits: (0..kept.len()).filter(|i| kept[*i] && now.least(*i).1 <= LOOSE).collect(),
        }
    }
}
