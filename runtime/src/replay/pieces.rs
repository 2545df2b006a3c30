//! A plan cut into pieces at times between events, for multiple shooting: each leads from a state inside a leg, or from the
//! section, to the next cut, or to the section.

use super::course::Course;
use super::plan::{Checks, Leg, Plan, Sides};
use crate::event::Side;
use crate::model::{Model, Section};
use crate::scalar::filled;
use nalgebra::{DMatrix, DVector};

/// A piece of a plan of one map.
#[derive(Clone, Debug)]
pub struct Piece {
    /// The plan that it is a piece of, with the legs of the piece alone.
    pub(crate) plan: Plan,
    /// Whether it begins on the section; else inside a leg.
    pub(crate) from_section: bool,
    /// Whether it ends on the section.
    pub(crate) to_section: bool,
}

/// Where a piece leads: section coordinates or the full state, with the derivatives in the coordinates or the full state
/// that it begins with.
#[derive(Clone, Debug)]
pub struct PieceEnd {
    /// Coordinates (d) or state (N).
    pub value: DVector<f64>,
    /// Its derivatives, one column a component of the beginning.
    pub jacobian: DMatrix<f64>,
}

impl Plan {
    /// The same plan for a search on its way, whose numbers need not be exact yet: errors may be larger by `factor`.
    #[must_use]
    pub fn relaxed(mut self, factor: f64) -> Self {
        self.accuracy.relative *= factor;
        self.accuracy.absolute *= factor;
        self
    }

    /// The plan of one map in `count` pieces of about the same duration. A plan of several maps in a row, or one without
    /// duration, stays whole.
    pub fn pieces(&self, count: usize) -> Vec<Piece> {
        let whole = || vec![Piece { plan: self.clone(), from_section: true, to_section: true }];
        let [legs] = self.turns.as_slice() else {
            return whole();
        };
        let total: f64 = legs.iter().map(Leg::length).sum();
        if count < 2 || total.is_nan() || total <= 0.0 {
            return whole();
        }
        let mut cutter = Cutter { legs, leg: 0, step: 0, done: 0.0 };
        let mut pieces = Vec::with_capacity(count);
        for i in 0..count {
            let last = i + 1 == count;
            let legs = cutter.take(if last { f64::INFINITY } else { total / count as f64 });
            let plan = Plan { info: self.info, accuracy: self.accuracy, turns: vec![legs], checks: Checks::State };
            pieces.push(Piece { plan, from_section: i == 0, to_section: last });
        }
        pieces
    }
}

/// Goes through the legs of a plan and cuts off pieces.
struct Cutter<'a> {
    legs: &'a [Leg],
    /// Where it stands: leg, step in it, and how much of that step is gone (s).
    leg: usize,
    step: usize,
    done: f64,
}

impl Cutter<'_> {
    /// The legs, or parts of them, of the next `length` seconds.
    fn take(&mut self, mut length: f64) -> Vec<Leg> {
        let mut taken = Vec::new();
        while let Some(leg) = self.legs.get(self.leg) {
            let mut part = self.start(leg);
            while let Some(&size) = leg.sizes.get(self.step) {
                let rest = size - self.done;
                let (sides, error) = (self.step + 1, leg.errors.get(self.step).copied().unwrap_or(0.0));
                // A cut keeps away from the event that ends the leg: elsewhere that comes sooner.
                let to_event = self.step + 1 == leg.sizes.len() && !leg.end.surfaces.is_empty();
                let latest = if to_event { 0.5 * size - self.done } else { rest };
                if length < rest && latest > 0.0 {
                    let length = length.min(latest);
                    part.sizes.push(length);
                    part.errors.push(error);
                    // What is true in the middle of a step is known only of what does not change in it.
                    for (to, from) in part.watched.iter_mut().zip(&leg.watched) {
                        let (before, after) = (from.at.get(self.step), from.at.get(sides));
                        to.at.push(if before == after {
                            before.copied().unwrap_or(Side::Unknown)
                        } else {
                            Side::Unknown
                        });
                    }
                    self.done += length;
                    part.end.surfaces.clear();
                    taken.push(part);
                    return taken;
                }
                part.sizes.push(rest);
                part.errors.push(error);
                for (to, from) in part.watched.iter_mut().zip(&leg.watched) {
                    to.at.push(from.at.get(sides).copied().unwrap_or(Side::Unknown));
                }
                length = (length - rest).max(0.0);
                (self.step, self.done) = (self.step + 1, 0.0);
            }
            taken.push(part);
            (self.leg, self.step, self.done) = (self.leg + 1, 0, 0.0);
        }
        taken
    }

    /// The rest of a leg, without steps.
    fn start(&self, leg: &Leg) -> Leg {
        let gone: f64 = leg.sizes.get(..self.step).unwrap_or(&[]).iter().sum();
        let sides = |s: &Sides| {
            let (before, after) = (s.at.get(self.step), s.at.get(self.step + 1));
            let known = self.done == 0.0 || before == after;
            let here = if known { before.copied().unwrap_or(Side::Unknown) } else { Side::Unknown };
            let noise = if self.step == 0 && self.done == 0.0 { s.noise } else { 0.0 };
            Sides { at: vec![here], noise, ..s.clone() }
        };
        Leg {
            tau: leg.tau + gone + self.done,
            sizes: Vec::new(),
            errors: Vec::new(),
            watched: leg.watched.iter().map(sides).collect(),
            ..leg.clone()
        }
    }
}

/// Runs a piece from `start`: section coordinates or a full state. `None` where the plan does not hold.
pub(crate) fn run_piece<M, const N: usize, const P: usize, const Q: usize, const C: usize>(
    piece: &Piece,
    section: Section,
    start: &[f64],
    p: &[f64; P],
) -> Option<PieceEnd>
where
    M: Model<N, P, Q>,
{
    let legs = piece.plan.turns.first()?;
    let length = if piece.to_section { M::INFO.coordinates.len() } else { N };
    let mut end = PieceEnd { value: DVector::zeros(length), jacobian: DMatrix::zeros(length, start.len()) };
    for first in (0..start.len().max(1)).step_by(C.max(1)) {
        let mut x = [0.0; N];
        for (slot, value) in x.iter_mut().zip(start) {
            *slot = *value;
        }
        let unit = |c: usize| filled(0.0, |i| if i == first + c { 1.0 } else { 0.0 });
        let at = super::moving::Moving { x, dx: filled([0.0; N], unit) };
        let mut course = Course::<M, f64, N, P, Q, C>::new(&piece.plan, section, p);
        if piece.from_section {
            course.embed(&at);
            course.leave(legs);
        } else {
            course.at = at;
            course.tau = legs.first().map_or(0.0, |leg| leg.tau);
        }
        course.go(legs);
        let reached = if piece.to_section { course.project() } else { course.at };
        let finite = reached.x.iter().chain(reached.dx.iter().flatten()).all(|v| v.is_finite());
        if !course.valid || !finite {
            return None;
        }
        for i in 0..length.min(N) {
            end.value[i] = reached.x[i];
            for c in (0..C).filter(|c| first + c < start.len()) {
                end.jacobian[(i, first + c)] = reached.dx[c][i];
            }
        }
    }
    Some(end)
}
