//! Trade-offs: the best value of one quantity for every bound on another (a Pareto curve).
//!
//! The epsilon-constraint method: the two ends are the optima of either quantity alone; between them the second
//! quantity is bounded at evenly spaced values and the first optimised. Every point is an ordinary optimum, confirmed by
//! simulation, and its shadow price of the bound is the exact slope of the curve there. Neighbours start from each
//! other's gaits, from both ends, so that the curve needs no luck; what another point beats in both quantities is left
//! out. (Y. Y. Haimes, L. S. Lasdon, D. A. Wismer, "On a bicriterion formulation of the problems of integrated system
//! identification and system optimization", 1971.)

use super::problem::{Objective, Problem, ProblemError, Sense};
use super::solution::{ActiveKind, Solution, Status};
use super::solve;

/// Differences of a quantity below this part of its spread along the curve are no difference.
const SAME: f64 = 1e-7;

/// What a problem of the family asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// The best first quantity, whatever the second.
    First,
    /// The best second quantity, whatever the first.
    Second,
    /// The best first quantity with the second at least as good as this (SI units).
    Bounded(f64),
}

/// A gait to start from.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// All parameters, SI units.
    pub parameters: Vec<f64>,
    /// Section coordinates of the gait there, SI units.
    pub section: Vec<f64>,
}

/// The problems of one trade-off. They share everything but the objective and, for [`Aim::Bounded`], one more
/// constraint, which has to be the last. With an origin the problem starts there, without one where it likes.
pub type Family<'f, 'a> = dyn Fn(Aim, Option<&Origin>) -> Problem<'a> + Sync + 'f;

/// A point of the curve.
#[derive(Clone, Debug)]
pub struct TradePoint {
    /// The first quantity, SI units.
    pub first: f64,
    /// The second quantity, SI units.
    pub second: f64,
    /// Slope of the curve, d first / d second, from the shadow price of the bound; `None` at both ends, which no such bound
    /// limits.
    pub slope: Option<f64>,
    /// The optimum.
    pub solution: Solution,
}

/// A bound for which no optimum was found.
#[derive(Clone, Debug)]
pub struct Gap {
    /// The bound on the second quantity, SI units.
    pub bound: f64,
    /// What the search from the better neighbour ended with; `None` when somebody asked to stop before it.
    pub solution: Option<Solution>,
}

/// The curve, from the best first quantity to the best second one.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// Points, none of which is better than another in both quantities.
    pub points: Vec<TradePoint>,
    /// Bounds without an optimum.
    pub gaps: Vec<Gap>,
    /// How many points were left out since others beat or repeat them.
    pub dominated: usize,
    /// Somebody asked to stop: the points are those found until then.
    pub interrupted: bool,
}

/// What came out.
#[derive(Clone, Debug)]
pub enum TradeOutcome {
    /// A curve; a single point when one gait is best in both.
    Curve(Curve),
    /// The best first quantity was not found.
    NoFirst(Box<Solution>),
    /// The best second quantity was not found.
    NoSecond(Box<Solution>),
}

/// The curve of `points` points (at least 2) over a family of problems. Deterministic.
///
/// # Errors
/// When a problem of the family is wrong as stated.
pub fn trade(family: &Family<'_, '_>, points: usize) -> Result<TradeOutcome, ProblemError> {
    let trade = Trade { family, first: family(Aim::First, None).sense, second: family(Aim::Second, None).sense };
    let (first, second) = match trade.ends()? {
        Ok(ends) => ends,
        Err(outcome) => return Ok(outcome),
    };
    let (from, to) = (first.second, second.second);
    let inner = points.max(2) - 1;
    let bounds: Vec<f64> = (1..inner).map(|i| from + (to - from) * i as f64 / inner as f64).collect();
    if (to - from).abs() <= SAME * (to.abs() + from.abs()) {
        return Ok(TradeOutcome::Curve(Curve { points: vec![first], ..Curve::default() }));
    }
    let (down, up) = rayon::join(
        || trade.chain(bounds.iter().copied(), &first.solution),
        || trade.chain(bounds.iter().rev().copied(), &second.solution),
    );
    let best = down?.into_iter().zip(up?.into_iter().rev()).map(|(a, b)| trade.better(a, b));
    let mut between: Vec<(f64, Option<Solution>)> = bounds.into_iter().zip(best).collect();
    let mut curve = Curve { interrupted: between.iter().any(|(_, s)| stopped(s.as_ref())), ..Curve::default() };
    if !curve.interrupted {
        trade.repair(&mut between, &second)?;
    }
    let mut all = vec![first];
    for (bound, solution) in between {
        match solution {
            Some(solution) if solution.status == Status::Optimal => {
                let slope = trade.slope(&solution, bound);
                all.push(trade.point(solution, Some(slope)));
            }
            solution => curve.gaps.push(Gap { bound, solution }),
        }
    }
    all.push(second);
    let count = all.len();
    curve.points = trade.undominated(all);
    curve.dominated = count - curve.points.len();
    Ok(TradeOutcome::Curve(curve))
}

struct Trade<'t, 'f, 'a> {
    family: &'t Family<'f, 'a>,
    first: Sense,
    second: Sense,
}

impl Trade<'_, '_, '_> {
    fn solve(&self, aim: Aim, origin: Option<&Origin>) -> Result<Solution, ProblemError> {
        solve(&(self.family)(aim, origin))
    }

    /// The optima of either quantity alone; each is also looked for from the other's gait.
    fn ends(&self) -> Result<Result<(TradePoint, TradePoint), TradeOutcome>, ProblemError> {
        let mut first = self.solve(Aim::First, None)?;
        let mut second = self.solve(Aim::Second, None)?;
        if let Some(origin) = origin(&first) {
            second = best(self.second, second, self.solve(Aim::Second, Some(&origin))?);
        }
        if let Some(origin) = origin(&second) {
            first = best(self.first, first, self.solve(Aim::First, Some(&origin))?);
        }
        if first.status != Status::Optimal {
            return Ok(Err(TradeOutcome::NoFirst(Box::new(first))));
        }
        if second.status != Status::Optimal {
            return Ok(Err(TradeOutcome::NoSecond(Box::new(second))));
        }
        Ok(Ok((self.point(first, None), self.point(second, None))))
    }

    /// Optima for one bound after the other, each from the last gait that was found; none after an interruption.
    fn chain(&self, bounds: impl Iterator<Item = f64>, end: &Solution) -> Result<Vec<Option<Solution>>, ProblemError> {
        let mut at = origin(end);
        let mut found: Vec<Option<Solution>> = Vec::new();
        for bound in bounds {
            if found.last().is_some_and(|last| stopped(last.as_ref())) {
                found.push(None);
                continue;
            }
            let solution = self.solve(Aim::Bounded(bound), at.as_ref())?;
            at = origin(&solution).or(at);
            found.push(Some(solution));
        }
        Ok(found)
    }

    /// A stricter bound cannot give more: where it does, the looser one is solved again from there.
    fn repair(&self, between: &mut [(f64, Option<Solution>)], end: &TradePoint) -> Result<(), ProblemError> {
        let mut stricter = (end.first, origin(&end.solution));
        for (bound, solution) in between.iter_mut().rev() {
            let known = solution.as_ref().filter(|s| s.status == Status::Optimal);
            if known.is_none_or(|known| ahead(self.first, stricter.0, known.objective) > 0.0) {
                let again = self.solve(Aim::Bounded(*bound), stricter.1.as_ref())?;
                *solution = self.better(solution.take(), Some(again));
            }
            if let Some(solution) = solution
                && let Some(origin) = origin(solution)
            {
                stricter = (solution.objective, Some(origin));
            }
        }
        Ok(())
    }

    fn better(&self, a: Option<Solution>, b: Option<Solution>) -> Option<Solution> {
        match (a, b) {
            (Some(a), Some(b)) => Some(best(self.first, a, b)),
            (a, b) => a.or(b),
        }
    }

    fn point(&self, solution: Solution, slope: Option<f64>) -> TradePoint {
        let value = |aim: Aim| match (self.family)(aim, None).objective {
            Objective::SpectralRadius => solution.spectral_radius,
            Objective::Expression(e) => e.evaluate(&solution.measures, &solution.parameters).value,
        };
        TradePoint { first: value(Aim::First), second: value(Aim::Second), slope, solution }
    }

    /// d first / d bound: the price of the bound, with the signs of both senses.
    fn slope(&self, solution: &Solution, bound: f64) -> f64 {
        let last = (self.family)(Aim::Bounded(bound), None).constraints.len().saturating_sub(1);
        let own = solution.active.iter().find(|active| active.kind == ActiveKind::Constraint(last));
        let sign = if (self.first == Sense::Maximize) == (self.second == Sense::Minimize) { 1.0 } else { -1.0 };
        own.map_or(0.0, |active| sign * active.multiplier)
    }

    /// Without points that another beats, or equals, in both quantities; the order is kept.
    fn undominated(&self, points: Vec<TradePoint>) -> Vec<TradePoint> {
        let spread = |value: fn(&TradePoint) -> f64| {
            let (low, high) = points
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(value(p)), high.max(value(p))));
            SAME * (high - low)
        };
        let (first, second) = (spread(|p| p.first), spread(|p| p.second));
        let beats = |(i, a): (usize, &TradePoint), (j, b): (usize, &TradePoint)| {
            let (x, y) = (ahead(self.first, a.first, b.first), ahead(self.second, a.second, b.second));
            let nowhere_worse = x >= -first && y >= -second;
            nowhere_worse && (x > first || y > second || i < j)
        };
        let keep: Vec<bool> = (0..points.len())
            .map(|j| !(0..points.len()).any(|i| i != j && beats((i, &points[i]), (j, &points[j]))))
            .collect();
        points.into_iter().zip(keep).filter_map(|(point, keep)| keep.then_some(point)).collect()
    }
}

/// How much better a is than b.
fn ahead(sense: Sense, a: f64, b: f64) -> f64 {
    if sense == Sense::Maximize { a - b } else { b - a }
}

/// The optimum of two, the first where both are as good.
fn best(sense: Sense, a: Solution, b: Solution) -> Solution {
    let optimal = |s: &Solution| s.status == Status::Optimal;
    let second = optimal(&b) && (!optimal(&a) || ahead(sense, b.objective, a.objective) > 0.0);
    if second { b } else { a }
}

/// Whether somebody asked to stop before this, or while it was computed.
fn stopped(solution: Option<&Solution>) -> bool {
    solution.is_none_or(|solution| solution.status == Status::Interrupted)
}

fn origin(solution: &Solution) -> Option<Origin> {
    (solution.status == Status::Optimal)
        .then(|| Origin { parameters: solution.parameters.clone(), section: solution.section.clone() })
}
