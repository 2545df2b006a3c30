//! The verdict of an optimisation, as JSON and for people.

use super::robust::Shown;
use super::verdict;
use crate::cli::output;
use crate::provenance::Provenance;
use gaitc_compiler::front::{format_number, format_quantity, format_si, in_unit};
use gaitc_compiler::ir::{Constraint, Model, Node, Problem, Sense, Symbol};
use gaitc_runtime::optimize::{Active, ActiveKind, Sensitivity, Solution, Status};
use serde_json::{Map, Value, json};

/// Fixed parameters that the table shows; JSON has all.
const MOST_SENSITIVITIES: usize = 5;

/// A solved problem with the names and units of its spec.
pub(super) struct Report<'a> {
    pub(super) spec: &'a Model,
    pub(super) problem: &'a Problem,
    pub(super) solution: &'a Solution,
    /// For a robust problem, its scenarios.
    pub(super) robust: Option<Shown<'a>>,
}

impl Report<'_> {
    pub(super) fn print_json(&self, provenance: &Provenance) {
        let s = self.solution;
        output::result(
            provenance,
            json!({
                "model": self.spec.name,
                "problem": self.problem.name,
                "status": status(s.status),
                "message": s.message,
                "notes": s.notes,
                "objective": { "name": self.problem.objective_text, "value": s.objective },
                "parameters": self.named_parameters(&s.parameters),
                "section": self.named_section(&s.section),
                "spectral_radius": s.spectral_radius,
                "multipliers": s.multipliers.iter().map(|m| [m.re, m.im]).collect::<Vec<_>>(),
                "kink": s.kink.map(|k| json!({ "multiplier": [k.multiplier.re, k.multiplier.im], "gap": k.gap })),
                "measures": named(self.spec.measures.iter().map(|m| &m.name), &s.measures),
                "active": s.active.iter().map(|a| json!({
                    "constraint": self.constraint(a.kind),
                    "multiplier": a.multiplier,
                })).collect::<Vec<_>>(),
                "sensitivities": s.sensitivities.iter().map(|q| json!({
                    "parameter": self.spec.parameters[q.parameter].name,
                    "derivative": q.derivative,
                    "per_percent": 0.01 * q.derivative * s.parameters[q.parameter],
                })).collect::<Vec<_>>(),
                "second_order": s.curvature.as_ref().map(|c| verdict::second_order_json(self.spec, c)),
                "iterations": s.iterations,
                "kkt_residual": s.kkt_residual,
                "starts": { "run": s.starts.run, "converged": s.starts.converged },
                "optima": self.optima_json(),
                "conflict": self.conflict_json(),
                "reached": self.reached_json(),
                "robust": self.robust_json(),
                "confirmation": s.confirmation.as_ref().map(verdict::confirmation_json),
            }),
        );
    }

    pub(super) fn named_parameters(&self, values: &[f64]) -> Map<String, Value> {
        named(self.spec.parameters.iter().map(|p| &p.name), values)
    }

    pub(super) fn named_section(&self, values: &[f64]) -> Map<String, Value> {
        named(self.coordinate_names().into_iter(), values)
    }

    fn coordinate_names(&self) -> Vec<&String> {
        let coordinates = self.spec.section.as_ref().map_or(&[][..], |s| &s.coordinates);
        coordinates.iter().map(|&i| &self.spec.states[i].name).collect()
    }

    pub(super) fn print_text(&self) {
        let s = self.solution;
        let verb = match self.problem.sense {
            Sense::Maximize => "maximize",
            Sense::Minimize => "minimize",
        };
        let (name, problem, objective) = (&self.spec.name, &self.problem.name, &self.problem.objective_text);
        let mut text = format!("{name} · {problem} · {verb} {objective}\n{}: {}\n", status(s.status), s.message);
        if s.objective.is_finite() {
            text += &format!("{objective} = {}\n", self.objective_quantity(s.objective));
        }
        for note in &s.notes {
            text += &format!("note: {note}\n");
        }
        if !s.measures.is_empty() {
            text += &self.gait();
        }
        output::print(&text);
    }

    fn gait(&self) -> String {
        let s = self.solution;
        let mut text = format!("\n{}", output::table(&["parameter", "value", "range"], self.varied()));
        if !s.active.is_empty() {
            let rows = s.active.iter().map(|a| vec![self.constraint(a.kind), self.price(a)]);
            text += &format!("\n{}", output::table(&["what limits it", "price"], rows));
        }
        text += &self.robust_text();
        text += &self.sensitivities();
        let mut gait: Vec<Vec<String>> = (self.coordinate_names().into_iter().zip(&s.section))
            .map(|(name, &value)| {
                let unit = self.spec.states.iter().find(|q| &q.name == name).map_or("", |q| q.unit.as_str());
                vec![name.clone(), format_quantity(value, unit)]
            })
            .collect();
        gait.push(vec!["spectral_radius".to_owned(), format_quantity(s.spectral_radius, "")]);
        let measures = self.spec.measures.iter().zip(&s.measures);
        gait.extend(measures.map(|(m, &value)| vec![m.name.clone(), format_quantity(value, &m.unit)]));
        text += &format!("\n{}{}", output::table(&["gait", "value"], gait), output::measures_hint(self.spec));
        text += &self.optima_text();
        text += &verdict::lines(self.spec, self.problem, s);
        text + &format!(
            "\n{} iterations, KKT residual {:.0e}, {} of {} starts converged\n",
            s.iterations, s.kkt_residual, s.starts.converged, s.starts.run
        )
    }

    /// How the optimum follows what is held fixed: the parameters that matter most, for 1 % more and for one unit more.
    fn sensitivities(&self) -> String {
        let s = self.solution;
        // What is below rounding of the objective is none.
        let matters =
            |q: &&Sensitivity| (0.01 * q.derivative * s.parameters[q.parameter]).abs() > 1e-12 * s.objective.abs();
        let rows: Vec<Vec<String>> = (s.sensitivities.iter().filter(matters).take(MOST_SENSITIVITIES))
            .map(|q| {
                let parameter = &self.spec.parameters[q.parameter];
                let value = s.parameters[q.parameter];
                let step = 1.0 / in_unit(1.0, &parameter.unit);
                vec![
                    parameter.name.clone(),
                    format_quantity(value, &parameter.unit),
                    signed(&self.objective_quantity(0.01 * q.derivative * value)),
                    format!("{} per {}", signed(&self.objective_quantity(q.derivative * step)), one(&parameter.unit)),
                ]
            })
            .collect();
        if rows.is_empty() {
            return String::new();
        }
        let more = format!("1 % more: {}", self.problem.objective_text);
        let others = s.sensitivities.iter().filter(matters).count().saturating_sub(MOST_SENSITIVITIES);
        let hint =
            if others > 0 { format!("{others} more held fixed that matter less: --json\n") } else { String::new() };
        format!("\n{}{hint}", output::table(&["held fixed", "value", &more, "or"], rows))
    }

    /// Name, value and range of each varied parameter.
    pub(super) fn varied(&self) -> Vec<Vec<String>> {
        let row = |v: &gaitc_compiler::ir::Vary| {
            let parameter = &self.spec.parameters[v.parameter];
            let range = format!(
                "{} .. {}",
                format_number(in_unit(v.lower, &parameter.unit)),
                format_quantity(v.upper, &parameter.unit)
            );
            vec![parameter.name.clone(), format_quantity(self.solution.parameters[v.parameter], &parameter.unit), range]
        };
        self.problem.vary.iter().map(row).collect()
    }

    /// A bound or constraint as the user would write it.
    pub(super) fn constraint(&self, kind: ActiveKind) -> String {
        let bound = |parameter: usize, relation: &str, upper: bool| {
            let p = &self.spec.parameters[parameter];
            let vary = self.problem.vary.iter().find(|v| v.parameter == parameter);
            let value = vary.map_or(f64::NAN, |v| if upper { v.upper } else { v.lower });
            format!("{} {relation} {}", p.name, format_quantity(value, &p.unit))
        };
        match kind {
            ActiveKind::LowerBound(parameter) => bound(parameter, ">=", false),
            ActiveKind::UpperBound(parameter) => bound(parameter, "<=", true),
            ActiveKind::Constraint(i) => self.problem.constraints[i].text.clone(),
        }
    }

    /// What one natural step of the bound is worth: 0.01 of a spectral radius, one of the unit that the user wrote of
    /// anything else, one SI unit where there is none.
    fn price(&self, active: &Active) -> String {
        let (step, per) = match active.kind {
            ActiveKind::LowerBound(i) | ActiveKind::UpperBound(i) => {
                let unit = &self.spec.parameters[i].unit;
                (1.0 / in_unit(1.0, unit), one(unit))
            }
            ActiveKind::Constraint(i) if self.problem.constraints[i].stability_bound.is_some() => {
                (0.01, "0.01 of spectral radius (stability)".to_owned())
            }
            ActiveKind::Constraint(i) => {
                let constraint = &self.problem.constraints[i];
                match self.unit(constraint) {
                    Some(unit) => (1.0 / in_unit(1.0, unit), one(unit)),
                    None => (1.0, format_si(1.0, constraint.dimension)),
                }
            }
        };
        format!("{} per {per}", self.objective_quantity(active.multiplier * step))
    }

    /// The unit in which people think of a constraint: that behind its bound, else that of a measure or parameter of
    /// the same dimension in it.
    pub(super) fn unit<'a>(&'a self, constraint: &'a Constraint) -> Option<&'a str> {
        if let Some(unit) = &constraint.unit {
            return Some(unit);
        }
        let mut found: Option<&str> = None;
        self.spec.graph.visit(&[constraint.margin], |_, node| {
            let quantity = match node {
                Node::Symbol(Symbol::Measure(i)) => self.spec.measures.get(i).map(|m| (m.dimension, m.unit.as_str())),
                Node::Symbol(Symbol::Parameter(i)) => {
                    self.spec.parameters.get(i).map(|p| (p.dimension, p.unit.as_str()))
                }
                _ => None,
            };
            found =
                found.or(quantity.filter(|(dimension, _)| *dimension == constraint.dimension).map(|(_, unit)| unit));
        });
        found
    }

    /// A value of the objective: in the unit of the measure that it is, else in SI units.
    pub(super) fn objective_quantity(&self, value: f64) -> String {
        match self.spec.measures.iter().find(|m| m.name == self.problem.objective_text.trim()) {
            Some(measure) => format_quantity(value, &measure.unit),
            None => format_si(value, self.problem.objective_dimension),
        }
    }
}

fn named<'n>(names: impl Iterator<Item = &'n String>, values: &[f64]) -> Map<String, Value> {
    names.zip(values).map(|(name, value)| (name.clone(), json!(value))).collect()
}

/// With its sign, also where it is a plus.
fn signed(quantity: &str) -> String {
    if quantity.starts_with('-') { quantity.to_owned() } else { format!("+{quantity}") }
}

/// One of a unit, as it stands behind `per`.
fn one(unit: &str) -> String {
    match unit.trim() {
        "" => "1".to_owned(),
        unit if unit.contains(['/', ' ', '*']) => format!("({unit})"),
        unit => unit.to_owned(),
    }
}

/// The word for a status in JSON and text.
pub(in crate::cli) fn status(status: Status) -> &'static str {
    match status {
        Status::Optimal => "optimal",
        Status::Unconfirmed => "unconfirmed",
        Status::Saddle => "saddle",
        Status::Infeasible => "infeasible",
        Status::Undefined => "undefined",
        Status::Interrupted => "interrupted",
        Status::InfeasibleLocally => "infeasible_locally",
        Status::NoGait => "no_gait",
        Status::Unbounded => "unbounded",
        Status::IterationLimit => "iteration_limit",
        Status::WorkLimit => "work_limit",
        Status::Stalled => "stalled",
        Status::SubproblemFailed => "subproblem_failed",
    }
}
