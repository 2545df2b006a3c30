//! One direction along a branch: predictor along the tangent, corrector, step size, and where it ends.

use super::corrector::{Corrected, Miss, tangent};
use super::locate::{Found, Seen};
use super::system::{Sample, System};
use super::{EndReason, Settings, Side};
use crate::return_map::RequestError;
use nalgebra::DVector;

/// The angle between the tangents of neighbouring points that steps aim at, and the largest that is accepted (rad).
const ANGLE: (f64, f64) = (0.1, 0.4);
/// By how much a step may grow or shrink from one to the next.
const GROWTH: (f64, f64) = (0.4, 1.7);
/// More Newton steps than this make the next step shorter.
const FEW: usize = 4;
/// How far from the predicted point, relative to the step, the corrected one may be.
const RADIUS: f64 = 0.5;
/// Steps shorter than this many shortest ones accept what longer steps do not: a corner, bifurcations on top of each other.
const NEARLY_SHORTEST: f64 = 8.0;
/// Coordinates this many times their scale have no bound.
const UNBOUNDED: f64 = 1e6;
/// How near its start a loop closes.
const CLOSED: f64 = 1e-6;

/// What one direction consists of.
pub(super) struct Path {
    /// The start is the first.
    pub(super) samples: Vec<Sample>,
    pub(super) found: Vec<Found>,
    pub(super) end: EndReason,
}

/// A step that is taken.
struct Accepted {
    sample: Sample,
    found: Vec<Found>,
    iterations: usize,
    landed: Option<Side>,
    closed: bool,
}

/// A step, or why a shorter one has to be tried.
type Trial = Result<Accepted, Miss>;

pub(super) struct Walk<'s, 'a> {
    pub(super) system: &'s System<'a>,
    pub(super) settings: &'s Settings,
    /// Asked of every branch point: whether the branch ends there because it is that of half its period.
    pub(super) period_can_halve: bool,
}

impl Walk<'_, '_> {
    /// Follows the branch from a point along its tangent.
    pub(super) fn follow(&self, start: Sample, first_step: f64) -> Result<Path, RequestError> {
        let mut path = Path { samples: vec![start.clone()], found: Vec::new(), end: EndReason::PointLimit };
        let (mut step, mut here) = (first_step, start.clone());
        // Where the last step failed, as a distance from here, and how the map stopped on the way there, if it did: last of all
        // it may be the amplified rounding of a run that takes ever longer.
        let (mut wall, mut stopped) = (f64::INFINITY, None);
        if let Some(side) = leaves(&here) {
            path.end = EndReason::RangeEnd(side);
            return Ok(path);
        }
        while path.samples.len() < self.settings.point_limit {
            if self.settings.interrupt.requested() {
                path.end = EndReason::Interrupted;
                return Ok(path);
            }
            match self.attempt(&here, &start, step, path.samples.len() - 1)? {
                Err(miss) => {
                    if let Miss::Stopped(stop) = miss {
                        stopped = Some(stop);
                    }
                    // What is no wall is passed with shorter steps.
                    if stopped.is_some() {
                        wall = step;
                    }
                    step *= 0.5;
                    if step < self.settings.shortest {
                        path.end = stopped.map_or(EndReason::StepTooSmall, EndReason::MapStops);
                        return Ok(path);
                    }
                }
                Ok(Accepted { sample, found, iterations, landed, closed }) => {
                    let halved = self.halves(&found)?;
                    path.found.extend(found);
                    if halved {
                        self.cut(&mut path);
                        return Ok(path);
                    }
                    let done = (&sample.y - &here.y).norm();
                    let angle = here.tangent.dot(&sample.tangent).clamp(-1.0, 1.0).acos();
                    self.settings.observer.tell(self.system.value(&sample.y));
                    path.samples.push(sample.clone());
                    if let Some(end) = self.ended(&sample, landed, closed) {
                        path.end = end;
                        return Ok(path);
                    }
                    wall = if wall > done { wall - done } else { f64::INFINITY };
                    stopped = stopped.filter(|_| wall.is_finite());
                    step = self.next_step(step, angle, iterations, wall, &sample);
                    here = sample;
                }
            }
        }
        Ok(path)
    }

    fn ended(&self, sample: &Sample, landed: Option<Side>, closed: bool) -> Option<EndReason> {
        match (landed, closed, sample.open) {
            (_, true, _) => Some(EndReason::Closed),
            (_, _, Some(open)) => Some(EndReason::NotClosed(open)),
            (Some(side), ..) => Some(EndReason::RangeEnd(side)),
            _ if sample.y.amax() > UNBOUNDED => Some(EndReason::Unbounded),
            _ => None,
        }
    }

    /// Longer where the branch is straight and Newton's method quick; never far into what has failed.
    fn next_step(&self, step: f64, angle: f64, iterations: usize, wall: f64, at: &Sample) -> f64 {
        let mut factor = (ANGLE.0 / angle.max(1e-6)).clamp(GROWTH.0, GROWTH.1);
        if iterations > FEW {
            factor = factor.min(0.7);
        }
        // Where coordinates have grown beyond their scale, lengths are relative to them.
        let size = at.y.iter().fold(1.0_f64, |size, y| size.max(y.abs()));
        (step * factor).min(self.settings.longest * size).min((0.5 * wall).max(self.settings.shortest))
    }

    fn attempt(&self, here: &Sample, start: &Sample, step: f64, after: usize) -> Result<Trial, RequestError> {
        let nearly_shortest = step < NEARLY_SHORTEST * self.settings.shortest;
        let (Corrected { mut sample, iterations }, landed) = match self.reach(here, step)? {
            Ok(reached) => reached,
            Err(miss) => return Ok(Err(miss)),
        };
        let Some(direction) = tangent(&sample.matrix, &here.tangent) else {
            return Ok(Err(Miss::Diverged));
        };
        sample.tangent = direction;
        let angle = here.tangent.dot(&sample.tangent).clamp(-1.0, 1.0).acos();
        if angle > ANGLE.1 && !nearly_shortest {
            return Ok(Err(Miss::Diverged));
        }
        let closed = self.closes(here, &sample, start)?;
        if closed {
            sample = start.clone();
        }
        let found = match self.system.bifurcations(here, &sample, after)? {
            Seen::All(found) => found,
            Seen::TooMuch(found) if nearly_shortest => found,
            Seen::TooMuch(_) => return Ok(Err(Miss::Diverged)),
        };
        let landed = landed.filter(|_| !closed);
        Ok(Ok(Accepted { sample, found, iterations, landed, closed }))
    }

    /// A step along the tangent, or up to the end of the range.
    fn reach(&self, here: &Sample, step: f64) -> Result<Result<(Corrected, Option<Side>), Miss>, RequestError> {
        let predicted = &here.y + &here.tangent * step;
        let d = here.coordinates();
        if let Some(side) = Side::beyond(predicted[d]) {
            return self.land(here, &predicted, side, step);
        }
        match self.system.correct(predicted, &here.tangent, RADIUS * step)? {
            Ok(corrected) => match Side::beyond(corrected.sample.s()) {
                Some(side) => self.land(here, &corrected.sample.y, side, step),
                None => Ok(Ok((corrected, None))),
            },
            Err(miss) => Ok(Err(miss)),
        }
    }

    /// The point at the end of the range, on the way to one beyond it.
    fn land(
        &self,
        here: &Sample,
        beyond: &DVector<f64>,
        side: Side,
        step: f64,
    ) -> Result<Result<(Corrected, Option<Side>), Miss>, RequestError> {
        let d = here.coordinates();
        let part = (side.scaled() - here.s()) / (beyond[d] - here.s());
        let mut guess = &here.y + (beyond - &here.y) * part;
        guess[d] = side.scaled();
        let mut row = DVector::zeros(d + 1);
        row[d] = 1.0;
        let reached = self.system.correct(guess, &row, RADIUS * step)?;
        // Not behind, where the branch turns round before the end.
        let ahead = |c: &Corrected| here.tangent.dot(&(&c.sample.y - &here.y)) > 0.0;
        Ok(match reached {
            Ok(corrected) if ahead(&corrected) => Ok((corrected, Some(side))),
            Ok(_) => Err(Miss::Diverged),
            Err(miss) => Err(miss),
        })
    }

    /// Whether the branch returns to its start within a step.
    fn closes(&self, here: &Sample, next: &Sample, start: &Sample) -> Result<bool, RequestError> {
        let length = here.tangent.dot(&(&next.y - &here.y));
        let to_start = &start.y - &here.y;
        let h = here.tangent.dot(&to_start);
        let near = h > 0.0 && h <= length && to_start.norm() < 1.5 * length && start.tangent.dot(&here.tangent) > 0.0;
        if !near {
            return Ok(false);
        }
        let between = self.system.between(here, next, h)?;
        Ok(between.is_some_and(|sample| (&sample.y - &start.y).norm() <= CLOSED))
    }

    /// Whether the last of these is where the branch has come back to the one of half its period.
    fn halves(&self, found: &[Found]) -> Result<bool, RequestError> {
        if !self.period_can_halve {
            return Ok(false);
        }
        for one in found.iter().filter(|found| found.kind == super::Kind::Branch) {
            if self.system.repeats_sooner(&one.sample)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Ends the path at its last branch point.
    fn cut(&self, path: &mut Path) {
        while let Some(found) = path.found.pop() {
            if found.kind == super::Kind::Branch {
                path.samples.push(found.sample);
                break;
            }
        }
        path.end = EndReason::PeriodHalved;
    }
}

/// Which end of the range a point stands on and is about to leave.
fn leaves(sample: &Sample) -> Option<Side> {
    let (s, along) = (sample.s(), sample.along_parameter());
    match () {
        () if s <= 0.0 && along < 0.0 => Some(Side::Lower),
        () if s >= 1.0 && along > 0.0 => Some(Side::Upper),
        () => None,
    }
}

impl Side {
    /// The end that a scaled parameter is beyond.
    fn beyond(s: f64) -> Option<Self> {
        match s {
            s if s < 0.0 => Some(Self::Lower),
            s if s > 1.0 => Some(Self::Upper),
            _ => None,
        }
    }

    /// Its scaled parameter.
    fn scaled(self) -> f64 {
        if self == Self::Lower { 0.0 } else { 1.0 }
    }
}
