//! The distinct local optima that the starts found: a short table for people, all of them as JSON.

use super::report::Report;
use crate::cli::output;
use gaitc_compiler::front::format_quantity;
use serde_json::{Value, json};

/// So many stand in the table.
const SHOWN: usize = 10;

impl Report<'_> {
    /// All optima, best first.
    pub(super) fn optima_json(&self) -> Value {
        let one = |optimum: &gaitc_runtime::optimize::Optimum| {
            json!({
                "objective": optimum.objective,
                "parameters": self.named_parameters(&optimum.parameters),
                "section": self.named_section(&optimum.section),
                "spectral_radius": optimum.spectral_radius,
                "starts": optimum.starts,
            })
        };
        self.solution.optima.iter().map(one).collect()
    }

    /// The table of optima, where there is more than one.
    pub(super) fn optima_text(&self) -> String {
        let optima = &self.solution.optima;
        if optima.len() < 2 {
            return String::new();
        }
        let varied: Vec<usize> = self.problem.vary.iter().map(|vary| vary.parameter).collect();
        let mut header = vec!["local optimum"];
        header.extend(varied.iter().map(|&i| self.spec.parameters[i].name.as_str()));
        header.extend(["spectral_radius", "starts"]);
        let rows = optima.iter().take(SHOWN).map(|optimum| {
            let mut row = vec![self.objective_quantity(optimum.objective)];
            row.extend(varied.iter().map(|&i| format_quantity(optimum.parameters[i], &self.spec.parameters[i].unit)));
            row.extend([format_quantity(optimum.spectral_radius, ""), optimum.starts.to_string()]);
            row
        });
        let mut text = format!("\n{}", output::table(&header, rows));
        if optima.len() > SHOWN {
            text += &format!(" and {} more; --json lists all\n", optima.len() - SHOWN);
        }
        text
    }
}
