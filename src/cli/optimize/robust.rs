//! `--robust NAME=LO..HI`: parameters that are only known to lie in ranges, and how the design does over these.

use super::report::Report;
use crate::cli::args::OptimizeArgs;
use crate::cli::{InputError, inputs, output};
use crate::load::Loaded;
use crate::problem::fixed;
use gaitc_compiler::front::flags::{parse_assignment, parse_range};
use gaitc_compiler::front::{format_number, format_quantity, in_unit};
use gaitc_compiler::ir::{Model, Problem, Vary};
use gaitc_runtime::optimize::{ActiveKind, RobustSolution, Scenario, Uncertain};
use serde_json::{Value, json};

/// More uncertain parameters than this have more scenarios than anybody would wait for.
const MOST_UNCERTAIN: usize = 12;

/// A robust result with what was uncertain.
pub(super) struct Shown<'a> {
    pub(super) uncertain: &'a [Uncertain],
    pub(super) found: &'a RobustSolution,
}

/// The uncertain parameters of the flags.
pub(super) fn uncertain(loaded: &Loaded, args: &OptimizeArgs, problem: &Problem) -> Result<Vec<Uncertain>, InputError> {
    let mut uncertain = Vec::new();
    let mut seen = Vec::new();
    for text in &args.robust {
        let (name, range) = parse_assignment(text)?;
        let parameter = inputs::parameter(loaded, "--robust", name)?;
        inputs::once(&mut seen, "--robust", name)?;
        let (lower, upper) = parse_range(range, loaded.spec.parameters[parameter].dimension)?;
        if problem.vary.iter().any(|vary| vary.parameter == parameter) {
            return Err(InputError(format!(
                "--robust: `{name}` is varied, so it cannot be uncertain\n  help: leave it out of --robust, or state a problem \
                 that does not vary it, with --maximize or --minimize and --vary"
            )));
        }
        uncertain.push(Uncertain { parameter, lower, upper });
    }
    if uncertain.len() > MOST_UNCERTAIN {
        return Err(InputError(format!("--robust: give at most {MOST_UNCERTAIN} parameters")));
    }
    Ok(uncertain)
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
            "--robust: the bound in `{}` is not the same for all machines\n  help: bound the spectral radius by a number, as in \
             `spectral_radius <= 0.95`",
            constraint.text
        ))),
        _ => Ok(()),
    }
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
        json!({
            "ranges": uncertain.iter().map(|u| (name(u), json!([u.lower, u.upper]))).collect::<serde_json::Map<_, _>>(),
            "nominal": found.nominal,
            "scenarios": found.scenarios.iter().map(scenario).collect::<Vec<_>>(),
            "checked": found.checked,
            "rounds": found.rounds,
            "exceptions": found.exceptions.iter().map(exception).collect::<Vec<_>>(),
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
