//! From the end of a search to the verdict: polished gait, confirmation, active constraints with shadow prices, kink.

use super::confirm::{self, Claim};
use super::critical_cone::significant;
use super::envelope;
use super::escape;
use super::gait::{self, NoGait, Start};
use super::kkt::{infeasibility, kkt};
use super::message;
use super::problem::{Constraint, ConstraintKind, Objective, Problem, ProblemError};
use super::program::{Failure, Point, Program, Row};
use super::search::{End, Ended};
use super::solution::{Active, ActiveKind, Curvature, Kink, Shape, Solution, Starts, Status};
use crate::orbit;
use nalgebra::{Complex, DVector};

/// Gap, relative to their magnitude, at which two multipliers meet: their difference is the square root of the
/// polynomial's discriminant, so this is where the discriminant is down to 1e-6 of its scale.
const MEETING: f64 = 1e-3;

/// A parameter is at a bound within this part of its own size, ...
const AT_BOUND: f64 = 1e-6;
/// ... and at a bound of 0 also within this part of its range.
const ROUNDING_OF_RANGE: f64 = 1e-12;
/// Within this part of the range of a bound, and beyond that part of its own size from it, a parameter is not resolved.
const NEXT_TO: f64 = 1e-6;
const FAR: f64 = 1e-2;

/// A smallest spectral radius below this is none.
const NO_MORE: f64 = 1e-5;

/// A verdict and how good it is: lower is better.
pub(super) struct Verdict {
    pub(super) solution: Solution,
    /// Largest scaled violation of a constraint.
    pub(super) violation: f64,
    /// Size of each section coordinate; empty without a gait.
    pub(super) nominal: Vec<f64>,
}

/// The verdict on a search.
///
/// # Errors
/// Only for a problem that turns out to be wrong as stated.
pub(super) fn verdict(program: &Program<'_>, mut ended: Ended) -> Result<Verdict, ProblemError> {
    let problem = program.problem;
    let curvature = escape::settle(program, &mut ended)?.map(|found| found.curvature);
    polish(program, &mut ended)?;
    let sensitivities = match curvature {
        Some(_) => envelope::sensitivities(program, &ended),
        None => Vec::new(),
    };
    let point = &ended.point;
    let d = point.section.len();
    let multipliers = orbit::multipliers(&point.map.jacobian.columns(0, d).into_owned());
    let spectral_radius = orbit::spectral_radius(&multipliers);
    let residuals = kkt(program, point, &ended.lin, &ended.multipliers);
    let mut solution = Solution {
        status: Status::Stalled,
        message: String::new(),
        notes: Vec::new(),
        objective: match problem.objective {
            Objective::SpectralRadius => spectral_radius,
            Objective::Expression(_) => program.worst_value(point),
        },
        parameters: point.parameters.clone(),
        section: point.section.clone(),
        spectral_radius,
        kink: kink(&multipliers),
        multipliers,
        measures: point.map.measures.as_slice().to_vec(),
        active: active(program, &ended),
        curvature,
        sensitivities,
        iterations: ended.iterations,
        kkt_residual: residuals.residual(),
        starts: Starts::default(),
        optima: Vec::new(),
        conflict: None,
        confirmation: None,
    };
    solution.notes.extend(program.kinks(&ended));
    judge(program, &ended, &mut solution);
    Ok(Verdict { violation: infeasibility(point), solution, nominal: program.variables.nominal.clone() })
}

/// Newton on the gait at the final parameters; the point and its derivatives follow.
fn polish(program: &Program<'_>, ended: &mut Ended) -> Result<(), ProblemError> {
    let section = match gait::near(program.problem, &ended.point.parameters, &ended.point.section) {
        Ok(section) => section,
        Err(NoGait::Wrong(error)) => return Err(error),
        // Away from any gait: the verdict then stands on the unpolished point.
        Err(_) => return Ok(()),
    };
    let variables = &program.variables;
    // Another gait, far from the one that was searched for, is not a polish.
    let moved =
        section.iter().zip(&ended.point.section).zip(&variables.nominal).any(|((a, b), s)| (a - b).abs() > 1e-6 * s);
    if moved && ended.end == End::Converged {
        return Ok(());
    }
    let at = variables.section_at();
    let mut u = ended.point.u.clone();
    for (i, (z, scale)) in section.iter().zip(&variables.nominal).enumerate() {
        u[at + i] = z / scale;
    }
    match program.evaluate(&u) {
        // Rounding in u would undo the last bits: the polished coordinates themselves are what is reported.
        Ok(point) => ended.point = Point { section, ..point },
        Err(Failure::Wrong(error)) => return Err(error),
        Err(_) => {}
    }
    Ok(())
}

/// Status and message, with the confirmation where the search converged.
fn judge(program: &Program<'_>, ended: &Ended, solution: &mut Solution) {
    let problem = program.problem;
    solution.status = match &ended.end {
        End::Converged | End::Acceptable => Status::Optimal,
        End::Infeasible => Status::InfeasibleLocally,
        End::Interrupted => Status::Interrupted,
        // Only a step on the way to a problem ends so, and it is not judged.
        End::Reached => Status::Stalled,
        End::Unbounded => Status::Unbounded,
        End::IterationLimit => Status::IterationLimit,
        End::Exhausted => Status::WorkLimit,
        End::Stalled => Status::Stalled,
        End::Subproblem(_) => Status::SubproblemFailed,
    };
    let mut detail = match &ended.end {
        End::Subproblem(words) => words.clone(),
        _ => message::violations(program, &ended.point),
    };
    if solution.status == Status::Optimal && saddle(solution.curvature.as_ref()) {
        solution.status = Status::Saddle;
    }
    let apart = bound_apart(problem, solution);
    if solution.status == Status::Optimal && apart.is_some() {
        solution.status = Status::Unconfirmed;
    } else if solution.status == Status::Optimal {
        match confirmed(program, ended, solution) {
            Ok(confirmation) => solution.confirmation = Some(confirmation),
            Err(reason) => {
                solution.status = Status::Unconfirmed;
                detail = reason;
            }
        }
    }
    if ended.end == End::Acceptable {
        solution.notes.push(format!(
            "the search could not be driven below a KKT residual of {:.1e}; rounding in the maps is the usual reason",
            solution.kkt_residual
        ));
    }
    solution.notes.extend(deadbeat(program, &ended.point, solution));
    if let Some(kink) = &solution.kink {
        solution.notes.push(message::kink(kink));
    }
    solution.notes.extend(ended.point.map.warnings.iter().map(|warning| message::warning(problem, warning)));
    solution.message = match apart {
        Some((parameter, bound)) if solution.status == Status::Unconfirmed => {
            message::range_too_wide(problem, parameter, solution.parameters[parameter], bound)
        }
        _ => match &ended.refused {
            Some(stop) if solution.status == Status::Stalled => message::refused(solution, stop, &detail),
            _ => message::message(problem, solution, &detail),
        },
    };
}

/// The note on a smallest spectral radius that is none but for rounding: where the search stopped at the least that it looks for.
pub(super) fn deadbeat(program: &Program<'_>, point: &Point, solution: &Solution) -> Option<String> {
    let variables = &program.variables;
    let minimised = matches!(program.problem.objective, Objective::SpectralRadius);
    let least = variables.epigraph_at().is_some_and(|at| point.u[at] <= 1.01 * variables.floor);
    let radius = solution.spectral_radius;
    (minimised && solution.status == Status::Optimal && (least || radius <= NO_MORE)).then(|| message::deadbeat(radius))
}

/// A varied parameter that is next to a bound in units of its range, but not in its own size, and the bound: in a range of
/// many powers of ten all that is near its small end counts as at the bound, and all gradients vanish there.
fn bound_apart(problem: &Problem<'_>, solution: &Solution) -> Option<(usize, f64)> {
    let claimed = |kind: ActiveKind| solution.active.iter().any(|active| active.kind == kind);
    let sides = problem.vary.iter().filter(|vary| vary.lower < vary.upper).flat_map(|vary| {
        let p = vary.parameter;
        [(vary, vary.lower, ActiveKind::LowerBound(p)), (vary, vary.upper, ActiveKind::UpperBound(p))]
    });
    sides.into_iter().find_map(|(vary, bound, kind)| {
        let (p, range) = (vary.parameter, vary.upper - vary.lower);
        let first = problem.parameters[p].clamp(vary.lower, vary.upper);
        // Next to a bound of 0 a value says nothing of what is small for the parameter, but the first value does; where that
        // is 0, too, only the range is left.
        let known = bound.abs().max(first.abs());
        let size = if known > 0.0 { known.max(solution.parameters[p].abs()) } else { range };
        let rounding = if bound == 0.0 { ROUNDING_OF_RANGE * range } else { 0.0 };
        let apart = (solution.parameters[p] - bound).abs();
        let wide = if claimed(kind) { apart > AT_BOUND * size } else { apart <= NEXT_TO * range && apart > FAR * size };
        (wide && apart > rounding).then_some((p, bound))
    })
}

/// Puts an optimum to the long tests, which only the best of all starts has to pass. Whether it passes; else the verdict says so.
pub(super) fn tested(problem: &Problem<'_>, verdict: &mut Verdict) -> bool {
    let Verdict { solution, nominal, .. } = verdict;
    match confirm::at_length(problem, solution, nominal) {
        Ok(()) => true,
        Err(reason) => {
            solution.status = Status::Unconfirmed;
            solution.message = message::message(problem, solution, &reason);
            false
        }
    }
}

fn saddle(curvature: Option<&Curvature>) -> bool {
    curvature.is_some_and(|curvature| curvature.shape == Shape::Saddle)
}

/// A fresh simulation, and the bounds on the spectral radius against the eigenvalues themselves.
fn confirmed(
    program: &Program<'_>,
    ended: &Ended,
    solution: &Solution,
) -> Result<super::solution::Confirmation, String> {
    let point = &ended.point;
    if !solution.spectral_radius.is_finite() {
        return Err("the eigenvalues of the Jacobian cannot be computed".to_owned());
    }
    // Where multipliers meet, rounding moves them by its square root.
    let slack = if solution.kink.is_some() { 1e-4 } else { 1e-7 };
    for (i, constraint) in program.problem.constraints.iter().enumerate() {
        if let ConstraintKind::SpectralRadius { .. } = constraint.kind
            && let Ok(bound) = program.radius(Some(i), &point.u, (0, &point.map), &point.parameters)
            && solution.spectral_radius > bound.value * program.reference(Some(i)) * (1.0 + slack)
        {
            let name = &constraint.name;
            return Err(format!("`{name}` does not hold for the eigenvalues: {}", solution.spectral_radius));
        }
    }
    confirm::confirm(
        program.problem,
        &Claim {
            parameters: &point.parameters,
            section: &point.section,
            map: &point.map,
            spectral_radius: solution.spectral_radius,
            nominal: &program.variables.nominal,
        },
    )
}

/// Active constraints by falling scaled multiplier, with shadow prices in SI units.
pub(super) fn active(program: &Program<'_>, ended: &Ended) -> Vec<Active> {
    if !matches!(ended.end, End::Converged | End::Acceptable) {
        return Vec::new();
    }
    let m = &ended.multipliers;
    let scale = program.objective_scale;
    let mut priced: Vec<(f64, Active)> = Vec::new();
    for (i, free) in program.variables.free.iter().enumerate() {
        let price = scale / free.range();
        let bounds =
            [(m.low[i], ActiveKind::LowerBound(free.parameter)), (m.high[i], ActiveKind::UpperBound(free.parameter))];
        priced.extend(bounds.map(|(scaled, kind)| (scaled, Active { kind, multiplier: scaled * price })));
    }
    for (i, constraint) in program.problem.constraints.iter().enumerate() {
        let (scaled, price) = constraint_price(program, ended, i, constraint);
        let multiplier = f64::max(0.0, price * scale);
        priced.push((scaled, Active { kind: ActiveKind::Constraint(i), multiplier }));
    }
    let least = significant(program, ended);
    priced.retain(|(scaled, _)| *scaled > least);
    priced.sort_by(|a, b| b.0.total_cmp(&a.0));
    priced.into_iter().map(|(_, active)| active).collect()
}

/// Scaled multiplier of a constraint, and its price for a scaled objective.
///
/// All Jury rows of a bound r move with r: the price of r is the sum of their multipliers times their slopes in r.
fn constraint_price(program: &Program<'_>, ended: &Ended, i: usize, constraint: &Constraint) -> (f64, f64) {
    let rows = program.rows.iter().zip(ended.multipliers.inequality.iter()).zip(&ended.lin.radius);
    let own = rows.filter(|((row, _), _)| matches!(row, Row::Margin(of, _) | Row::Jury(Some(of), _) if *of == i));
    match &constraint.kind {
        ConstraintKind::Margin { scale, .. } => {
            let lambda: f64 = own.map(|((_, lambda), _)| *lambda).sum();
            (lambda, lambda / scale)
        }
        ConstraintKind::SpectralRadius { .. } => {
            let price: f64 = own.map(|((_, lambda), slope)| lambda * slope).sum();
            (price * program.reference(Some(i)), price)
        }
    }
}

/// Whether a second multiplier, not the conjugate of the first, has nearly the same value.
pub(super) fn kink(multipliers: &[Complex<f64>]) -> Option<Kink> {
    let first = *multipliers.first()?;
    let size = first.norm();
    let next = multipliers.iter().skip(1).map(|m| (first - m).norm()).fold(f64::INFINITY, f64::min);
    // A magnitude near zero has no meaningful gap: the map is deadbeat.
    let meets = size > 1e-4 && next <= MEETING * size;
    meets.then(|| Kink { multiplier: first, gap: next / size })
}

/// The verdict when no gait was found to start from.
pub(super) fn no_gait(problem: &Problem<'_>, parameters: Vec<f64>, failure: &NoGait) -> Verdict {
    let message = message::no_gait(&failure.to_string());
    without_values(Status::NoGait, message, parameters, problem.start.clone())
}

/// The verdict when something is not defined at the start itself.
pub(super) fn undefined(start: &Start, what: &str) -> Verdict {
    without_values(Status::Undefined, message::undefined(what), start.parameters.clone(), start.section.clone())
}

pub(super) fn without_values(status: Status, message: String, parameters: Vec<f64>, section: Vec<f64>) -> Verdict {
    let solution = Solution {
        status,
        message,
        notes: Vec::new(),
        objective: f64::NAN,
        parameters,
        section,
        spectral_radius: f64::NAN,
        multipliers: Vec::new(),
        measures: Vec::new(),
        active: Vec::new(),
        curvature: None,
        sensitivities: Vec::new(),
        kink: None,
        iterations: 0,
        kkt_residual: f64::NAN,
        starts: Starts::default(),
        optima: Vec::new(),
        conflict: None,
        confirmation: None,
    };
    Verdict { solution, violation: f64::INFINITY, nominal: Vec::new() }
}

/// The search's starting point as a point of the program.
pub(super) fn starting_point(program: &Program<'_>, parameters: &[f64], section: &[f64]) -> Result<Point, Failure> {
    program.adopt(None);
    program.evaluate(&DVector::from_vec(program.variables.pack(parameters, section, program.epigraph_start)))
}
