//! Extrema over a path whose place jumps: margins and objectives as the worst of several smooth pieces.
//!
//! An expression over a `cycle_max` is smooth as long as the place of the maximum moves smoothly, and has a kink where two places
//! compete. No model with one gradient tells of both sides, so a search that is led to a kink stalls there. What the expression
//! would be with the extremum taken at either place is smooth across the kink. So with pieces a margin is imposed on each place
//! (all of them hold where the worst does), and an objective is the worst of its pieces, through an epigraph variable:
//!
//! ```text
//! minimise t   subject to   F_k(z, p) <= t for all places k
//! ```
//!
//! Where the extremum is wanted the other way round (a maximum that is maximised) the kink repels and there is nothing to split.

use super::critical_cone::significant;
use super::message;
use super::problem::{ConstraintKind, Expression, Problem, Value};
use super::program::{Failure, Point, Program, Row};
use super::scene::Scene;
use super::search::{End, Ended, search};
use super::task::Task;
use super::verdict::starting_point;
use crate::return_map::{Candidate, MapResult};
use nalgebra::DVector;

/// So many pieces of a margin or objective have rows, the worst.
pub(super) const MOST: usize = 4;
/// A place that is further away than this part of the map is another one.
const NEAR: f64 = 0.1;

/// Where an extremum is taken: index of the functional, and the fraction of the map.
pub(super) type Place = (usize, f64);

/// An expression as it would be with an extremum taken at one place.
pub(super) struct Piece<'c> {
    pub(super) value: Value,
    /// The place; none for the expression as it is.
    pub(super) candidate: Option<&'c Candidate>,
}

impl Piece<'_> {
    pub(super) fn place(&self) -> Option<Place> {
        self.candidate.map(|candidate| (candidate.functional, candidate.phase))
    }
}

/// Whether rows stand for the same places at two points.
pub(super) fn alike(a: &Point, b: &Point) -> bool {
    a.places.iter().zip(&b.places).all(|places| match places {
        (None, None) => true,
        (Some((f, x)), Some((g, y))) => f == g && (x - y).abs() < NEAR,
        _ => false,
    })
}

impl Program<'_> {
    /// The pieces of an expression in a scene, in the order of their places; one where nothing competes. `good` is 1 where small
    /// values are the bad ones, -1 where large ones are.
    fn pieces<'c>(
        &self,
        (what, e): (&str, &dyn Expression),
        (scene, map): (usize, &MapResult),
        parameters: &[f64],
        (candidates, good): (&'c [Vec<Candidate>], f64),
    ) -> Result<Vec<Piece<'c>>, Failure> {
        let value = self.value(what, e, (scene, map), parameters)?;
        let Some(candidates) = candidates.get(scene) else { return Ok(vec![Piece { value, candidate: None }]) };
        let own = self.scenes[scene].parameters(parameters);
        let mut all = Vec::new();
        for candidate in candidates {
            let there = e.evaluate(candidate.measures.as_slice(), &own);
            self.problem.check_value(what, &there).map_err(Failure::Wrong)?;
            // What is worse than the expression itself is on the side from which the kink repels.
            if there.value.is_finite() && good * (there.value - value.value) >= 0.0 {
                all.push(Piece { value: there, candidate: Some(candidate) });
            }
        }
        // As it is the expression is one of the pieces of each of its extrema: once is enough.
        let taken = |piece: &Piece<'_>| piece.value.value.to_bits() == value.value.to_bits();
        let mut own = None;
        let mut pieces: Vec<Piece<'_>> = Vec::new();
        for rivals in runs(all) {
            let of = rivals.first().and_then(Piece::place).map(|place| place.0);
            if !rivals.iter().all(taken) {
                pieces.extend(rivals.into_iter().filter(|piece| !taken(piece) || *own.get_or_insert(of) == of));
            }
        }
        while pieces.len() > MOST {
            let badness = |k: &usize| -good * pieces[*k].value.value;
            let best = (0..pieces.len()).min_by(|a, b| badness(a).total_cmp(&badness(b)));
            pieces.remove(best.unwrap_or(0));
        }
        Ok(if pieces.is_empty() { vec![Piece { value, candidate: None }] } else { pieces })
    }

    /// The pieces of a block of rows in a scene.
    pub(super) fn block_pieces<'c>(
        &self,
        row: Row,
        scene: usize,
        (map, candidates): (&MapResult, &'c [Vec<Candidate>]),
        parameters: &[f64],
    ) -> Result<Vec<Piece<'c>>, Failure> {
        let (e, good) = match row {
            Row::Margin(i, _) => match self.problem.constraints.get(i).map(|c| (c.name.as_str(), &c.kind)) {
                Some((name, ConstraintKind::Margin { margin, .. })) => ((name, margin.as_ref()), 1.0),
                _ => return Ok(Vec::new()),
            },
            Row::Worst(_) => match self.target() {
                Some(target) => (target, -self.sign()),
                None => return Ok(Vec::new()),
            },
            Row::Jury(..) => return Ok(Vec::new()),
        };
        self.pieces(e, (scene, map), parameters, (candidates, good))
    }

    /// The value of a piece's row.
    pub(super) fn piece_row(&self, row: Row, piece: &Piece<'_>, u: &DVector<f64>) -> f64 {
        match row {
            Row::Margin(i, _) => piece.value.value / self.margin_scale(i),
            _ => self.shortfall(piece.value.value, u),
        }
    }

    /// The gradient of a piece's row in a scene.
    pub(super) fn piece_row_gradient(&self, row: Row, piece: &Piece<'_>, scene: usize, point: &Point) -> DVector<f64> {
        let gradient = self.piece_gradient(piece, scene, point);
        match row {
            Row::Margin(i, _) => gradient / self.margin_scale(i),
            _ => self.shortfall_gradient(gradient),
        }
    }

    /// The objective at a point, SI units: where it is in pieces, as it is, not the bound that all pieces keep to rounding.
    pub(super) fn worst_value(&self, point: &Point) -> f64 {
        let as_bounded = self.sign() * self.objective_scale * point.f;
        match self.target().filter(|_| self.split && self.scenes.len() == 1) {
            Some((what, e)) => {
                self.value(what, e, (0, &point.map), &point.parameters).map_or(as_bounded, |value| value.value)
            }
            None => as_bounded,
        }
    }

    /// In words, where an optimum stands at a kink because extrema are taken at several places at once.
    pub(super) fn kinks(&self, ended: &Ended) -> Vec<String> {
        let least = significant(self, ended);
        let mut blocks: Vec<(String, Vec<f64>)> = Vec::new();
        let rows = self.rows.iter().zip(&ended.point.places).zip(ended.multipliers.inequality.iter());
        for ((row, place), _) in rows.filter(|(_, lambda)| **lambda > least) {
            let Some((_, phase)) = place else { continue };
            let name = match *row {
                Row::Margin(i, _) => self.problem.constraints.get(i).map_or("?", |c| c.name.as_str()),
                _ => "the objective",
            };
            match blocks.iter_mut().find(|(known, _)| known == name) {
                Some((_, phases)) => phases.push(*phase),
                None => blocks.push((name.to_owned(), vec![*phase])),
            }
        }
        blocks.retain(|(_, phases)| phases.len() > 1);
        blocks.iter().map(|(name, phases)| message::places(name, phases)).collect()
    }

    fn margin_scale(&self, i: usize) -> f64 {
        match self.problem.constraints.get(i).map(|c| &c.kind) {
            Some(ConstraintKind::Margin { scale, .. }) => *scale,
            _ => 1.0,
        }
    }

    /// Total derivative of a piece in a scene with respect to u.
    fn piece_gradient(&self, piece: &Piece<'_>, scene: usize, point: &Point) -> DVector<f64> {
        let Some(candidate) = piece.candidate else { return self.total(&piece.value, scene, point) };
        let d = self.block(scene).len();
        self.total_through(&piece.value, scene, |measure, j| {
            let m = self.variables.free.len();
            let column = match j.checked_sub(m) {
                None => d + j,
                Some(i) if self.block(scene).contains(&i) => i - scene * d,
                Some(_) => return 0.0,
            };
            candidate.measures_jacobian[(measure, column)]
        })
    }
}

/// Pieces of the same functional together.
fn runs(all: Vec<Piece<'_>>) -> Vec<Vec<Piece<'_>>> {
    let functional = |piece: &Piece<'_>| piece.place().map(|place| place.0);
    let mut runs: Vec<Vec<Piece<'_>>> = Vec::new();
    for piece in all {
        match runs.last_mut() {
            Some(run) if run.first().map(functional) == Some(functional(&piece)) => run.push(piece),
            _ => runs.push(vec![piece]),
        }
    }
    runs
}

/// The end of a search from gaits of all scenes; where that is no optimum, of one that goes on with pieces, if any compete there
/// and it comes to an optimum.
///
/// # Errors
/// As those of the search.
pub(super) fn searched<'a>(
    problem: &'a Problem<'a>,
    task: &Task,
    scenes: &[Scene],
    (parameters, section): (&[f64], &[f64]),
) -> Result<(Program<'a>, Ended), Failure> {
    let program = Program::new(problem, task.clone(), (scenes.to_vec(), false), (parameters, section))?;
    let point = starting_point(&program, parameters, section)?;
    let ended = search(&program, point)?;
    if !matches!(ended.end, End::Stalled | End::IterationLimit | End::Subproblem(_) | End::Infeasible) {
        return Ok((program, ended));
    }
    let again = || -> Result<Option<(Program<'a>, Ended)>, Failure> {
        let (parameters, section) = (&ended.point.parameters, &ended.point.section);
        let mut split = Program::new(problem, task.clone(), (scenes.to_vec(), true), (parameters, section))?;
        split.continues(&program);
        let point = starting_point(&split, parameters, section)?;
        if point.places.iter().all(Option::is_none) {
            return Ok(None);
        }
        let mut second = search(&split, point)?;
        second.iterations += ended.iterations;
        Ok(matches!(second.end, End::Converged | End::Acceptable | End::Reached).then_some((split, second)))
    };
    match again() {
        Ok(Some(found)) => Ok(found),
        Err(Failure::Wrong(error)) => Err(Failure::Wrong(error)),
        Ok(None) | Err(_) => Ok((program, ended)),
    }
}
