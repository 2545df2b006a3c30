//! What cannot hold together, in words and units: `a` and `b` cannot hold together, at most this much of `a` where `b` holds.

use super::report::Report;
use crate::problem::fixed;
use gaitc_compiler::front::{format_quantity, format_si};
use gaitc_compiler::ir::{Binary, Constraint, Model, Node, Problem};
use gaitc_runtime::optimize::{Conflict, Reached, Solution, Status};
use serde_json::{Value, json};

/// The message of a problem whose constraints cannot hold together; `None` where there is no conflict.
pub(super) fn message(spec: &Model, problem: &Problem, solution: &Solution) -> Option<String> {
    let conflict = solution.conflict.as_ref()?;
    let report = Report { spec, problem, solution, robust: None };
    let text = |member: &Reached| format!("`{}`", problem.constraints[member.constraint].text);
    let texts: Vec<String> = conflict.members.iter().map(text).collect();
    let reached: Vec<String> = conflict.members.iter().map(|member| report.reached_text(member, conflict)).collect();
    let together = if texts.len() == 1 { "cannot hold" } else { "cannot hold together" };
    // What one search found can be a matter of where it began.
    let sure = match solution.status {
        Status::Infeasible => "searches from several starts agree, which is not a proof",
        _ => "found by a search that no second start confirms",
    };
    Some(format!(
        "{} {together} for {}: {} ({sure}); relax {}, or widen the ranges",
        listed(&texts),
        listed(&report.ranges()),
        listed(&reached),
        if texts.len() == 1 { "it" } else { "one of them" },
    ))
}

impl Report<'_> {
    /// The texts of the constraints in conflict; `null` without one.
    pub(super) fn conflict_json(&self) -> Value {
        let text = |member: &Reached| self.problem.constraints[member.constraint].text.clone();
        match &self.solution.conflict {
            Some(conflict) => conflict.members.iter().map(text).collect(),
            None => Value::Null,
        }
    }

    /// How far each of them gets while the others hold, SI units; `null` without a conflict.
    pub(super) fn reached_json(&self) -> Value {
        match &self.solution.conflict {
            Some(conflict) => conflict.members.iter().map(|member| self.one_reached_json(member)).collect(),
            None => Value::Null,
        }
    }

    /// How far one constraint gets, SI units.
    pub(super) fn one_reached_json(&self, member: &Reached) -> Value {
        json!({
            "constraint": self.problem.constraints[member.constraint].text,
            "value": self.side(member).map(|side| side.value),
            "margin": member.margin,
            "parameters": self.named_parameters(&member.parameters),
            "section": self.named_section(&member.section),
        })
    }

    /// "`climb_speed` is at most 1.31 m/s where `peak_force <= 100 N` holds".
    fn reached_text(&self, member: &Reached, conflict: &Conflict) -> String {
        let best = self.best_text(member);
        let others: Vec<&Reached> = conflict.members.iter().filter(|m| m.constraint != member.constraint).collect();
        match others.as_slice() {
            [] => best,
            [other] => format!("{best} where `{}` holds", self.problem.constraints[other.constraint].text),
            _ => format!("{best} where the others hold"),
        }
    }

    /// "`climb_speed` is at most 1.31 m/s".
    pub(super) fn best_text(&self, member: &Reached) -> String {
        let constraint = &self.problem.constraints[member.constraint];
        let quantity = |value: f64| match self.unit(constraint) {
            _ if constraint.stability_bound.is_some() => format_quantity(value, ""),
            Some(unit) => format_quantity(value, unit),
            None => format_si(value, constraint.dimension),
        };
        match self.side(member) {
            Some(Side { text, most: true, value }) => format!("`{text}` is at most {}", quantity(value)),
            Some(Side { text, most: false, value }) => format!("`{text}` is at least {}", quantity(value)),
            None => format!("`{}` misses by at least {}", constraint.text, quantity(-member.margin)),
        }
    }

    /// The side of a constraint that varies, where the other one does not.
    fn side(&self, member: &Reached) -> Option<Side<'_>> {
        let constraint = &self.problem.constraints[member.constraint];
        let (left, right, large_left) = sides(constraint)?;
        let text = |large: bool| if large == large_left { left } else { right };
        if constraint.stability_bound.is_some() {
            return Some(Side { text: text(false), most: false, value: member.spectral_radius });
        }
        let bound = |node| fixed(&self.spec.graph, node, self.problem, &member.parameters);
        let Node::Binary(Binary::Sub, large, small) = self.spec.graph.node(constraint.margin) else {
            // `x >= 0` is its own margin.
            return (right == "0" && large_left).then_some(Side { text: left, most: true, value: member.margin });
        };
        match (bound(large), bound(small)) {
            (None, Some(bound)) => Some(Side { text: text(true), most: true, value: bound + member.margin }),
            (Some(bound), None) => Some(Side { text: text(false), most: false, value: bound - member.margin }),
            _ => None,
        }
    }

    /// "psi in 5 .. 45 deg".
    pub(super) fn ranges(&self) -> Vec<String> {
        self.varied().into_iter().map(|row| format!("{} in {}", row[0], row[2])).collect()
    }
}

/// One side of a constraint: as it is written, whether what was reached is the most or the least of it, and how much, SI
/// units.
struct Side<'a> {
    text: &'a str,
    most: bool,
    value: f64,
}

/// Left and right side as they are written, and whether the left one is the larger.
fn sides(constraint: &Constraint) -> Option<(&str, &str, bool)> {
    let split = |relation: &str| constraint.text.split_once(relation).map(|(left, right)| (left.trim(), right.trim()));
    let at_least = split(">=").map(|(left, right)| (left, right, true));
    at_least.or_else(|| split("<=").map(|(left, right)| (left, right, false)))
}

/// `a`, `b` and `c`.
pub(super) fn listed(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}
