//! `--robust NAME=LO..HI` and `robust` of a problem: parameters that are only known to lie in ranges, and how the design does over these.

use super::conflict::listed;
use super::report::Report;
use crate::cli::args::OptimizeArgs;
use crate::cli::{InputError, inputs, output};
use crate::load::Loaded;
use crate::problem::fixed;
use gaitc_compiler::front::flags::{parse_assignment, parse_range};
use gaitc_compiler::front::{MOST_ROBUST, format_number, format_quantity, in_unit};
use gaitc_compiler::ir::{self, Model, Problem, Vary};
use gaitc_runtime::optimize::{ActiveKind, InTheWay, RobustSolution, Scenario, Uncertain};
use serde_json::{Value, json};

/// A robust result with what was uncertain.
pub(super) struct Shown<'a> {
    pub(super) uncertain: &'a [Uncertain],
    pub(super) found: &'a RobustSolution,
}

/// Adds the uncertain parameters of the flags to those of the problem; one that it has already gets the range of the flag.
pub(super) fn add(loaded: &Loaded, args: &OptimizeArgs, problem: &mut Problem) -> Result<(), InputError> {
    let mut seen = Vec::new();
    for text in &args.robust {
        let (name, range) = parse_assignment(text).map_err(inputs::given("--robust", text))?;
        let parameter = inputs::parameter(loaded, "--robust", name)?;
        inputs::once(&mut seen, "--robust", name)?;
        let dimension = loaded.spec.parameters[parameter].dimension;
        let (lower, upper) = parse_range(range, dimension).map_err(inputs::given("--robust", text))?;
        problem.robust.retain(|known| known.parameter != parameter);
        problem.robust.push(ir::Uncertain { parameter, lower, upper });
    }
    let varied = |u: &&ir::Uncertain| problem.vary.iter().any(|vary| vary.parameter == u.parameter);
    if let Some(both) = problem.robust.iter().find(varied) {
        let name = &loaded.spec.parameters[both.parameter].name;
        return Err(InputError(format!(
            "`{name}` is varied, so it cannot be uncertain\n  help: leave it out of --vary or of --robust, or state a problem that \
             does not vary it or is not robust over it, with --maximize or --minimize and --vary"
        )));
    }
    if problem.robust.len() > MOST_ROBUST {
        return Err(InputError(format!(
            "{} parameters are uncertain\n  help: give at most {MOST_ROBUST} to --robust and to the problem's `robust`, those that \
             matter most: each needs scenarios of its own",
            problem.robust.len()
        )));
    }
    Ok(())
}

/// Refuses a trade-off under uncertainty.
pub(super) fn no_trade(problem: &Problem) -> Result<(), InputError> {
    if problem.robust.is_empty() {
        return Ok(());
    }
    Err(InputError(format!(
        "--trade: problem `{}` is robust, and trade-offs are for problems without uncertainty\n  help: name another problem with \
         --problem, or state one with --maximize or --minimize and --vary",
        problem.name
    )))
}

/// The problem with all that is not the same for every machine among what varies.
pub(super) fn loose(problem: &Problem, uncertain: &[Uncertain]) -> Problem {
    let mut loose = problem.clone();
    let vary = |u: &Uncertain| Vary { parameter: u.parameter, lower: u.lower, upper: u.upper };
    loose.vary.extend(uncertain.iter().map(vary));
    loose
}

/// Refuses a bound on the spectral radius that is not the same number for every machine and design.
pub(super) fn stability_bounds(
    spec: &Model,
    loose: &Problem,
    parameters: &[f64],
    uncertain: &[Uncertain],
) -> Result<(), InputError> {
    let moves = |c: &&gaitc_compiler::ir::Constraint| {
        c.stability_bound.is_some_and(|bound| fixed(&spec.graph, bound, loose, parameters).is_none())
    };
    match loose.constraints.iter().find(moves) {
        Some(constraint) if !uncertain.is_empty() => Err(InputError(format!(
            "the bound in `{}` is not the same for all machines\n  help: bound the spectral radius by a number, as in \
             `spectral_radius <= 0.95`",
            constraint.text
        ))),
        _ => Ok(()),
    }
}

/// The message of a robust problem without a design for all machines; `None` where nothing is known to be in the way.
pub(super) fn message(spec: &Model, problem: &Problem, found: &RobustSolution) -> Option<String> {
    let machine = |values: &[f64]| -> String {
        let one = |(u, value): (&ir::Uncertain, &f64)| {
            let parameter = &spec.parameters[u.parameter];
            format!("{} = {}", parameter.name, format_quantity(*value, &parameter.unit))
        };
        problem.robust.iter().zip(values).map(one).collect::<Vec<_>>().join(", ")
    };
    if let Some(lost) = &found.lost {
        let report = Report { spec, problem, solution: &found.solution, robust: None };
        return Some(format!(
            "the best design without uncertainty has {} = {}, but its gait cannot be followed to the machine with {}: {}; narrow the \
             uncertain ranges, or start from values and a first guess that lead to a gait everywhere in them",
            problem.objective_text,
            report.objective_quantity(found.nominal),
            machine(&lost.values),
            lost.why,
        ));
    }
    let in_the_way = found.in_the_way.as_ref()?;
    let report = Report { spec, problem, solution: &found.solution, robust: None };
    let text = |i: &usize| format!("`{}`", problem.constraints[*i].text);
    let kept = match in_the_way.limits.iter().map(text).collect::<Vec<_>>() {
        none if none.is_empty() => String::new(),
        limits => format!(" where {} hold{} for all", listed(&limits), if limits.len() == 1 { "s" } else { "" }),
    };
    Some(format!(
        "{} cannot hold for all machines with one design for {}: for {} {}{kept} (found by searches, which is not a proof); relax \
         it, narrow the uncertain ranges, or widen the ranges",
        text(&in_the_way.reached.constraint),
        listed(&report.ranges()),
        machine(&in_the_way.values),
        report.best_text(&in_the_way.reached),
    ))
}

impl Report<'_> {
    /// Scenarios and what was found inside the box; null for a problem without uncertainty.
    pub(super) fn robust_json(&self) -> Value {
        let Some(Shown { uncertain, found }) = &self.robust else { return Value::Null };
        let name = |u: &Uncertain| self.spec.parameters[u.parameter].name.clone();
        let values = |values: &[f64]| -> Value {
            uncertain
                .iter()
                .zip(values)
                .map(|(u, value)| (name(u), json!(value)))
                .collect::<serde_json::Map<_, _>>()
                .into()
        };
        let scenario = |s: &Scenario| {
            json!({
                "parameters": values(&s.values),
                "objective": s.objective,
                "spectral_radius": s.spectral_radius,
                "section": self.named_section(&s.section),
                "worst": s.worst,
                "limits": s.limits.iter().map(|i| self.constraint(ActiveKind::Constraint(*i))).collect::<Vec<_>>(),
            })
        };
        let exception =
            |e: &gaitc_runtime::optimize::Exception| json!({ "parameters": values(&e.values), "what": e.what });
        let in_the_way = |way: &InTheWay| {
            let texts = way.limits.iter().map(|i| self.constraint(ActiveKind::Constraint(*i)));
            json!({
                "parameters": values(&way.values),
                "reached": self.one_reached_json(&way.reached),
                "limits": texts.collect::<Vec<_>>(),
            })
        };
        json!({
            "ranges": uncertain.iter().map(|u| (name(u), json!([u.lower, u.upper]))).collect::<serde_json::Map<_, _>>(),
            "nominal": found.nominal,
            "scenarios": found.scenarios.iter().map(scenario).collect::<Vec<_>>(),
            "checked": found.checked,
            "rounds": found.rounds,
            "exceptions": found.exceptions.iter().map(exception).collect::<Vec<_>>(),
            "in_the_way": found.in_the_way.as_ref().map(in_the_way),
            "lost": found.lost.as_ref().map(|lost| json!({ "parameters": values(&lost.values), "why": lost.why })),
        })
    }

    /// The table of scenarios, and what is inside the box.
    pub(super) fn robust_text(&self) -> String {
        let Some(Shown { uncertain, found }) = &self.robust else { return String::new() };
        if found.scenarios.is_empty() {
            return String::new();
        }
        let parameter = |u: &Uncertain| &self.spec.parameters[u.parameter];
        let ranges: Vec<String> = uncertain
            .iter()
            .map(|u| {
                let p = parameter(u);
                let lower = format_number(in_unit(u.lower, &p.unit));
                format!("{} = {lower} .. {}", p.name, format_quantity(u.upper, &p.unit))
            })
            .collect();
        let mut text = format!(
            "\nrobust over {}; without uncertainty {} = {}\n",
            ranges.join(", "),
            self.problem.objective_text,
            self.objective_quantity(found.nominal)
        );
        let mut header: Vec<&str> = uncertain.iter().map(|u| parameter(u).name.as_str()).collect();
        header.push(&self.problem.objective_text);
        if self.problem.objective_text.trim() != "spectral_radius" {
            header.push("spectral_radius");
        }
        header.push("limits by");
        let columns = header.len() - uncertain.len();
        let rows = found.scenarios.iter().map(|s| {
            let mut row: Vec<String> = uncertain.iter().zip(&s.values).map(|(u, v)| self.value(u, *v)).collect();
            row.push(self.objective_quantity(s.objective));
            if columns > 2 {
                row.push(format_quantity(s.spectral_radius, ""));
            }
            row.push(self.limits(s));
            row
        });
        text += &output::table(&header, rows);
        if found.checked > 0 {
            text += &format!("checked at {} points inside", found.checked);
            text += if found.exceptions.is_empty() { ": none is worse\n" } else { "\n" };
        }
        for exception in &found.exceptions {
            let values: Vec<String> = uncertain
                .iter()
                .zip(&exception.values)
                .map(|(u, v)| format!("{} = {}", parameter(u).name, self.value(u, *v)))
                .collect();
            text += &format!("at {}: {}\n", values.join(", "), exception.what);
        }
        text
    }

    fn value(&self, u: &Uncertain, value: f64) -> String {
        format_quantity(value, &self.spec.parameters[u.parameter].unit)
    }

    /// What limits the optimum in a scenario.
    fn limits(&self, scenario: &Scenario) -> String {
        let mut limits: Vec<String> = Vec::new();
        if scenario.worst {
            limits.push("the worst".to_owned());
        }
        limits.extend(scenario.limits.iter().map(|i| self.constraint(ActiveKind::Constraint(*i))));
        limits.join(", ")
    }
}
