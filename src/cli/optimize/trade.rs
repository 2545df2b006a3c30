//! `gaitc optimize MODEL --trade A:B`: the best A for every bound on B.

mod quantity;
mod report;

use super::{Outcome, conflict, request};
use crate::cli::args::OptimizeArgs;
use crate::cli::{InputError, output, plots, table_file};
use crate::files;
use crate::load::Loaded;
use crate::problem::{Start, assemble};
use crate::provenance::Provenance;
use gaitc_compiler::ir::{self, Binary};
use gaitc_runtime::optimize::{Aim, Origin, Problem, Settings, Solution, Status, TradeOutcome, trade};
use quantity::Quantity;
use report::Report;

/// More points than this show nothing new and would run for days.
const MOST_POINTS: usize = 10_000;

/// A problem of a spec whose objective gives way to two quantities.
struct Trade<'l> {
    loaded: &'l Loaded,
    spec: ir::Model,
    problem: ir::Problem,
    first: Quantity,
    second: Quantity,
    start: Start,
}

/// Computes the curve and shows it in all the ways that were asked for.
pub(super) fn run(
    loaded: &Loaded,
    (mut spec, problem): (ir::Model, ir::Problem),
    mut start: Start,
    (args, json): (&OptimizeArgs, bool),
    (warnings, provenance): (&[String], &Provenance),
) -> Result<Outcome, InputError> {
    if !(2..=MOST_POINTS).contains(&args.points) {
        return Err(InputError(format!("--points {}: give a number from 2 to {MOST_POINTS}", args.points)));
    }
    places(args)?;
    let text = args.trade.as_deref().unwrap_or_default();
    let (first, second) = quantity::pair(&mut spec, &problem, text)?;
    if let Some(objective) = args.maximize.as_deref().or(args.minimize.as_deref())
        && ![&first.text, &second.text].contains(&&objective.trim().to_owned())
    {
        return Err(InputError(format!(
            "--trade {text}: `{objective}`, which is to be optimised, is neither of the two\n  help: trade it for something, or \
             leave it out and take ranges and constraints from --problem"
        )));
    }
    for quantity in [&first, &second] {
        request::depends_on_what_varies(&spec, &problem, quantity.node, &quantity.text)?;
    }
    // Each point is confirmed by a fresh simulation; the long tests are for single answers.
    start.settings.long_tests = false;
    let asked = Trade { loaded, spec, problem, first, second, start };
    let outcome = trade(&|aim, origin| asked.problem(aim, origin), args.points)?;
    let report = Report { trade: &asked, outcome: &outcome, warnings };
    if json {
        output::result(provenance, report.json());
    } else {
        output::print(&report.text());
    }
    if let TradeOutcome::Curve(curve) = &outcome {
        if let Some(path) = &args.out {
            table_file::save("--out", path, &report.table(curve), provenance);
        }
        if let Some(path) = &args.plot {
            plots::save("--plot", path, &report.picture(curve), provenance);
        }
    }
    Ok(match outcome {
        TradeOutcome::Curve(curve) if curve.interrupted => Outcome::Interrupted,
        TradeOutcome::Curve(curve) if curve.gaps.is_empty() => Outcome::Done,
        TradeOutcome::NoFirst(end) | TradeOutcome::NoSecond(end) if end.status == Status::Interrupted => {
            Outcome::Interrupted
        }
        _ => Outcome::Without,
    })
}

/// Refuses files that cannot be written, or not as what they are named, before the work begins.
fn places(args: &OptimizeArgs) -> Result<(), InputError> {
    if let (Some(out), Some(plot)) = (&args.out, &args.plot)
        && files::is_same(out, plot)
    {
        return Err(InputError("--out and --plot name the same file\n  help: name two".to_owned()));
    }
    if let Some(path) = &args.plot {
        plots::check("--plot", path)?;
    }
    if let Some(path) = &args.out {
        table_file::check("--out", path)?;
    }
    Ok(())
}

impl<'l> Trade<'l> {
    /// The problem for an aim, from the start or from a gait of the curve.
    fn problem(&self, aim: Aim, origin: Option<&Origin>) -> Problem<'l> {
        let (spec, problem) = self.stated(aim);
        let mut start = self.start.clone();
        if let Some(origin) = origin {
            start.parameters.clone_from(&origin.parameters);
            start.section.clone_from(&origin.section);
            start.settings = Settings { starts: 1, ..start.settings };
        }
        assemble(self.loaded, &spec, &problem, start)
    }

    /// What the search for an aim ended with, in words; a conflict in units.
    fn message(&self, aim: Aim, solution: &Solution) -> String {
        let (spec, problem) = self.stated(aim);
        conflict::message(&spec, &problem, solution).unwrap_or_else(|| solution.message.clone())
    }

    /// The problem for an aim, and the spec with its expressions.
    fn stated(&self, aim: Aim) -> (ir::Model, ir::Problem) {
        let (mut spec, mut problem) = (self.spec.clone(), self.problem.clone());
        let objective = if aim == Aim::Second { &self.second } else { &self.first };
        problem.sense = objective.sense;
        problem.objective = objective.node;
        problem.objective_text.clone_from(&objective.text);
        problem.objective_dimension = objective.dimension;
        if let Aim::Bounded(bound) = aim {
            problem.constraints.push(self.bound(&mut spec, bound));
        }
        (spec, problem)
    }

    /// The second quantity at least as good as a bound.
    fn bound(&self, spec: &mut ir::Model, bound: f64) -> ir::Constraint {
        let second = &self.second;
        let number = spec.graph.constant(bound);
        let (relation, margin) = match second.sense {
            ir::Sense::Minimize => ("<=", spec.graph.binary(Binary::Sub, number, second.node)),
            ir::Sense::Maximize => (">=", spec.graph.binary(Binary::Sub, second.node, number)),
        };
        ir::Constraint {
            margin,
            stability_bound: second.is_spectral_radius(spec).then_some(number),
            text: format!("{} {relation} {}", second.text, second.show(bound)),
            dimension: second.dimension,
            unit: Some(second.unit.clone()),
        }
    }
}
