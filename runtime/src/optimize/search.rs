//! Sequential convex programming from one point: S l1 QP with a trust region.
//!
//! Each iteration minimises a convex model with elastic linearised constraints in a ball (module `subproblem`), takes
//! the step when the exact l1 merit f + mu (|h|_1 + |min(c, 0)|_1) falls as the model promised, corrects it to second
//! order when only the constraints' curvature spoils it (Maratos), and learns the Lagrangian's Hessian by damped BFGS.
//! The method: R. Fletcher, *Practical Methods of Optimization*, 14.4; penalty steering after Byrd, Nocedal and Waltz.

mod trial;

use super::active_set::refine;
use super::best::Best;
use super::kkt::{Kkt, infeasibility, kkt};
use super::linearisation::Linearisation;
use super::problem::ProblemError;
use super::program::{Failure, Point, Program};
use super::quasi_newton::QuasiNewton;
use super::subproblem::{Multipliers, Step, Subproblem, Unsolved, violation};
use crate::return_map::Stop;
use nalgebra::{DMatrix, DVector};
use std::cell::RefCell;

/// Largest penalty; beyond it the constraints count as not satisfiable together.
const LARGEST_PENALTY: f64 = 1e9;
/// What the penalty is not lowered below.
const SMALLEST_PENALTY: f64 = 0.1;
/// Violation, relative to the radius, that Clarabel's tolerance leaves.
const INTERIOR_POINT: f64 = 1e-7;
const SMALLEST_RADIUS: f64 = 1e-13;
/// A step shorter than this part of the radius is far inside the ball.
const FAR_INSIDE: f64 = 1e-4;
/// Scaled objective below which it counts as unbounded.
const UNBOUNDED: f64 = -1e7;
/// Residual at which rough derivatives have given what they can.
const ROUGHLY: f64 = 1e-5;
/// How often the penalties may be lowered.
const REDUCTIONS: usize = 20;
/// A search that cannot go on is still an optimum when its residuals are within these.
const ACCEPTABLE: Kkt = Kkt { optimality: 1e-5, feasibility: 1e-9 };
/// The same, in multiples of the maps' relative tolerance, for maps of low accuracy: derivatives of the Jacobian lose
/// most of its digits.
const ACCEPTABLE_MULTIPLE: Kkt = Kkt { optimality: 1e4, feasibility: 100.0 };

/// Why a search ended.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum End {
    /// KKT conditions met to the tolerances asked for.
    Converged,
    /// Met, but only to `ACCEPTABLE`.
    Acceptable,
    /// No small step reduces the violation.
    Infeasible,
    /// The objective fell below any bound.
    Unbounded,
    /// Iterations used up.
    IterationLimit,
    /// Single maps used up; the point is the best one so far.
    Exhausted,
    /// Steps became too small.
    Stalled,
    /// Clarabel's words.
    Subproblem(String),
    /// What the search was after holds, before any optimum.
    Reached,
    /// Somebody asked to stop; the point is the best one so far.
    Interrupted,
}

/// Where a search ended.
#[derive(Clone, Debug)]
pub(super) struct Ended {
    pub(super) end: End,
    pub(super) point: Point,
    pub(super) lin: Linearisation,
    pub(super) multipliers: Multipliers,
    pub(super) iterations: usize,
    /// Why the map had no next step at the last trial, where it was refused for that.
    pub(super) refused: Option<Stop>,
}

struct Search<'p, 'a> {
    program: &'p Program<'a>,
    /// Where it began.
    began: Point,
    point: Point,
    lin: Linearisation,
    model: QuasiNewton,
    /// What a violated inequality costs.
    penalty: f64,
    /// What a map that does not return to its start costs.
    tie: f64,
    radius: f64,
    /// Inequalities are driven to this instead of 0, so that rounding does not leave them violated.
    margin: f64,
    /// Steps left beyond the tolerance: they cost little, make constraints hold strictly and gain digits.
    spare: usize,
    /// How often the penalty may still be lowered: not without end, or the merit would not be one.
    reductions: usize,
    /// Why the map stopped at the trials since the last step.
    refused: RefCell<Option<Stop>>,
}

/// What an iteration did.
enum Progress {
    Going,
    Ended(End),
}

/// Searches from a point.
///
/// # Errors
/// When the start has no derivatives, or for a problem that turns out to be wrong as stated.
pub(super) fn search(program: &Program<'_>, start: Point) -> Result<Ended, Failure> {
    let (start, _) = program.settled(start)?;
    let lin = program.linearise_to(&start, true)?;
    let settings = &program.problem.settings;
    let mut search = Search {
        program,
        began: start.clone(),
        point: start,
        lin,
        model: QuasiNewton::new(program.len()),
        penalty: 1.0,
        tie: 1.0,
        radius: settings.trust_radius,
        margin: 0.5 * settings.attainable_feasibility(),
        spare: 3,
        reductions: REDUCTIONS,
        refused: RefCell::default(),
    };
    let mut multipliers = Multipliers::zeros(program.len(), search.point.h.len(), search.point.c.len());
    let mut iterations = 0;
    let mut best = Best::default();
    let end = loop {
        best.remember(&search.point, &search.lin);
        if settings.interrupt.requested() {
            best.recall(&mut search.point, &mut search.lin);
            break End::Interrupted;
        }
        if program.exhausted() {
            let end = search.verdict(&multipliers, End::Exhausted);
            if end == End::Exhausted {
                best.recall(&mut search.point, &mut search.lin);
            }
            break end;
        }
        if iterations == settings.max_iterations {
            break search.verdict(&multipliers, End::IterationLimit);
        }
        iterations += 1;
        match search.iterate(&mut multipliers).map_err(Failure::Wrong)? {
            Progress::Going => {}
            Progress::Ended(end @ (End::Stalled | End::Subproblem(_))) => break search.verdict(&multipliers, end),
            Progress::Ended(end) => break end,
        }
    };
    let early = matches!(end, End::Interrupted | End::Exhausted);
    let answer = early || matches!(end, End::Converged | End::Acceptable | End::Reached);
    if !answer && search.degenerate() {
        // What was given up on the way to a step of no length is no gait to report.
        search.lin = program.linearise_to(&search.began, true)?;
        search.point = search.began.clone();
    }
    if search.lin.rough {
        // The multipliers of the periodicity belong to the derivatives.
        search.refine_derivatives().map_err(Failure::Wrong)?;
        search.retie(&mut multipliers);
    }
    program.adopt(Some(&search.point));
    let refused = search.refused.into_inner();
    Ok(Ended { end, point: search.point, lin: search.lin, multipliers, iterations, refused })
}

impl Search<'_, '_> {
    /// `otherwise`, unless the point is good enough all the same.
    fn verdict(&self, multipliers: &Multipliers, otherwise: End) -> End {
        let kkt = kkt(self.program, &self.point, &self.lin, multipliers);
        if self.within_tolerance(kkt) {
            return End::Converged;
        }
        let relative = self.program.problem.settings.accuracy.relative;
        let good = kkt.optimality <= ACCEPTABLE.optimality.max(ACCEPTABLE_MULTIPLE.optimality * relative)
            && kkt.feasibility <= ACCEPTABLE.feasibility.max(ACCEPTABLE_MULTIPLE.feasibility * relative);
        if good { End::Acceptable } else { otherwise }
    }

    fn within_tolerance(&self, kkt: Kkt) -> bool {
        let settings = &self.program.problem.settings;
        kkt.optimality <= settings.optimality && kkt.feasibility <= settings.attainable_feasibility()
    }

    fn iterate(&mut self, multipliers: &mut Multipliers) -> Result<Progress, ProblemError> {
        let settings = &self.program.problem.settings;
        if self.program.reached(&self.point) {
            return Ok(Progress::Ended(End::Reached));
        }
        if self.point.f < UNBOUNDED && infeasibility(&self.point) < 1e-4 {
            return Ok(Progress::Ended(End::Unbounded));
        }
        if self.lin.rough && self.radius < ROUGHLY {
            return self.refine_derivatives();
        }
        if self.radius < SMALLEST_RADIUS {
            return Ok(Progress::Ended(End::Stalled));
        }
        let (lower, upper) = self.bounds();
        let step = match self.steered(&lower, &upper) {
            Ok(Some(step)) => step,
            Ok(None) => return Ok(Progress::Ended(End::Infeasible)),
            Err(Unsolved(words)) => return Ok(Progress::Ended(End::Subproblem(words))),
        };
        *multipliers = step.multipliers.clone();
        let kkt = kkt(self.program, &self.point, &self.lin, multipliers);
        if self.lin.rough && kkt.residual() <= ROUGHLY {
            return self.refine_derivatives();
        }
        if self.within_tolerance(kkt) {
            let strictly = self.point.c.iter().all(|c| *c >= 0.0) && kkt.optimality <= 1e-3 * settings.optimality;
            if self.spare == 0 || strictly {
                return Ok(Progress::Ended(End::Converged));
            }
            self.spare -= 1;
        }
        let promised = self.promised(&step, &lower, &upper);
        if promised < 0.0 || step.s.norm() < SMALLEST_RADIUS {
            // With a penalty just at the multipliers, violating a constraint costs as much as it gains.
            let tempting = self.penalty < 100.0 * step.multipliers.inequality.amax();
            if promised < 0.0 && tempting && self.penalty < LARGEST_PENALTY {
                self.penalty *= 10.0;
                return Ok(Progress::Going);
            }
            return if self.lin.rough { self.refine_derivatives() } else { Ok(Progress::Ended(End::Stalled)) };
        }
        self.advance(&step, promised, &lower, &upper)?;
        Ok(Progress::Going)
    }

    /// From here on the derivatives are as exact as they can be.
    fn refine_derivatives(&mut self) -> Result<Progress, ProblemError> {
        match self.program.linearise(&self.point) {
            Ok(lin) => self.lin = lin,
            Err(Failure::Wrong(error)) => return Err(error),
            Err(_) => return Ok(Progress::Ended(End::Stalled)),
        }
        Ok(Progress::Going)
    }

    /// Multipliers of the periodicity that make the Lagrangian's gradient vanish in the coordinates.
    fn retie(&self, multipliers: &mut Multipliers) {
        let (d, at) = (self.point.h.len(), self.program.variables.section_at());
        let pull = (&self.lin.f - self.lin.c.tr_mul(&multipliers.inequality)).rows(at, d).into_owned();
        if let Some(y) = self.lin.h.columns(at, d).transpose().lu().solve(&pull) {
            multipliers.equality = y;
        }
    }

    /// Bounds on the step.
    fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        let bounds = (0..self.program.len()).map(|i| {
            let (lower, upper) = self.program.variables.bounds(i);
            (f64::min(lower - self.point.u[i], 0.0), f64::max(upper - self.point.u[i], 0.0))
        });
        bounds.unzip()
    }

    fn shifted(&self, c: &DVector<f64>) -> DVector<f64> {
        c.add_scalar(-self.margin)
    }

    /// What violations cost.
    fn cost(&self, h: &DVector<f64>, c: &DVector<f64>) -> f64 {
        let none = DVector::zeros(0);
        self.tie * h.lp_norm(1) + self.penalty * violation(&none, c)
    }

    fn merit(&self, point: &Point) -> f64 {
        point.f + self.cost(&point.h, &self.shifted(&point.c))
    }

    /// By how much a step reduces the model of the merit.
    fn promised(&self, step: &Step, lower: &[f64], upper: &[f64]) -> f64 {
        let problem = self.subproblem(lower, upper);
        let after = self.cost(&(problem.equality * &step.s + &problem.h), &(problem.inequality * &step.s + &problem.c));
        self.cost(&problem.h, &problem.c) - after - problem.model(&step.s)
    }

    fn subproblem<'s>(&'s self, lower: &'s [f64], upper: &'s [f64]) -> Subproblem<'s> {
        Subproblem {
            hessian: &self.model.matrix,
            gradient: &self.lin.f,
            equality: &self.lin.h,
            h: self.point.h.clone(),
            inequality: &self.lin.c,
            c: self.shifted(&self.point.c),
            lower,
            upper,
            radius: self.radius,
            penalty: self.penalty,
            tie: self.tie,
            clarabel: &self.program.problem.settings.clarabel,
            tally: &self.program.problem.settings.tally,
        }
    }

    /// The step of a subproblem in which the linearised periodicity holds, where it can: a search that may trade it for
    /// something else comes to places where hardly any map moves its start, but none returns to it. Not where gaits meet
    /// or branch, and all that keeps to them leads along the branch.
    fn tied(&self, mut problem: Subproblem<'_>) -> Result<Step, Unsolved> {
        if !self.lin.follows {
            problem.tie = problem.tie.max(problem.penalty);
            return solve(&problem);
        }
        let tie = std::mem::replace(&mut problem.tie, f64::INFINITY);
        solve(&problem).or_else(|_| {
            problem.tie = tie;
            solve(&problem)
        })
    }

    /// A step, with the penalty raised until it reduces the violation nearly as much as any step could; `None` when
    /// constraints are violated and no step reduces that.
    fn steered(&mut self, lower: &[f64], upper: &[f64]) -> Result<Option<Step>, Unsolved> {
        let tolerance = self.program.problem.settings.attainable_feasibility();
        // What an interior-point step leaves violated by its own tolerance is no reason to steer.
        let nothing = f64::max(tolerance, INTERIOR_POINT * self.radius);
        let mut step = self.tied(self.subproblem(lower, upper))?;
        let before = violation(&self.point.h, &self.shifted(&self.point.c));
        let after = |search: &Self, step: &Step| search.subproblem(lower, upper).violation(&step.s);
        if after(self, &step) > nothing {
            let least = self.least_violation(lower, upper)?.min(after(self, &step));
            if infeasibility(&self.point) > 1e2 * tolerance && before - least <= 1e-6 * before && self.radius > 1e-6 {
                return Ok(None);
            }
            while before - after(self, &step) < 0.9 * (before - least) && self.penalty < LARGEST_PENALTY {
                self.penalty *= 10.0;
                self.tie = self.tie.max(self.penalty);
                step = self.tied(self.subproblem(lower, upper))?;
            }
        }
        self.adapt_penalties(&step.multipliers, after(self, &step) <= nothing);
        Ok(Some(step))
    }

    /// Penalties above the multipliers, so that the merit is exact; but not far above. One from a time when violations had to be
    /// fought makes every curvature of a constraint look bad.
    fn adapt_penalties(&mut self, multipliers: &Multipliers, feasible: bool) {
        let mut lowered = false;
        let mut adapted = |penalty: f64, largest: f64, raise: bool| {
            let needed = (1.5 * largest).max(SMALLEST_PENALTY);
            if needed > penalty && raise {
                needed.min(LARGEST_PENALTY)
            } else if self.reductions > 0 && feasible && penalty > 10.0 * needed {
                lowered = true;
                2.0 * needed
            } else {
                penalty
            }
        };
        let tie = adapted(self.tie, multipliers.equality.amax(), true);
        let penalty = adapted(self.penalty, multipliers.inequality.amax(), feasible);
        self.reductions -= usize::from(lowered);
        // Where periodicity is a constraint like the others, none is worth more than the other.
        let both = tie.max(penalty);
        (self.tie, self.penalty) = if self.lin.follows { (tie, penalty) } else { (both, both) };
    }

    /// Least violation of the linearised constraints within the ball.
    fn least_violation(&self, lower: &[f64], upper: &[f64]) -> Result<f64, Unsolved> {
        let n = self.program.len();
        let (hessian, gradient) = (DMatrix::identity(n, n) * 1e-8, DVector::zeros(n));
        let mut problem = self.subproblem(lower, upper);
        problem.hessian = &hessian;
        problem.gradient = &gradient;
        (problem.penalty, problem.tie) = (1.0, 1.0);
        let tie = if self.lin.follows { f64::INFINITY } else { 1.0 };
        let tied = Subproblem { tie, ..problem.clone() }.solve();
        let step = tied.or_else(|_| problem.solve())?;
        Ok(problem.violation(&step.s))
    }
}

/// Clarabel's step, refined on its active set where that holds. Where it does not, a step far inside the ball has no more digits than
/// Clarabel's tolerance of the radius: it is computed once more in a ball of its own size.
fn solve(problem: &Subproblem<'_>) -> Result<Step, Unsolved> {
    let step = problem.solve()?;
    if let Some(refined) = refine(problem, &step) {
        return Ok(refined);
    }
    let length = step.s.norm();
    if length > FAR_INSIDE * problem.radius {
        return Ok(step);
    }
    let radius = f64::max(10.0 * length, 1e-2 * FAR_INSIDE * problem.radius);
    let closer = Subproblem { radius, ..problem.clone() };
    Ok(match closer.solve() {
        Ok(second) if second.s.norm() < 0.9 * radius => refine(&closer, &second).unwrap_or(second),
        _ => step,
    })
}
