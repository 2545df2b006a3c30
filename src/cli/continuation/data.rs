//! A diagram as a table: one row a gait, bifurcations among them, in order along each branch.

use super::{Report, words};
use crate::table::{Column, Table, Values};
use gaitc_compiler::front::si_unit_like;
use gaitc_runtime::study::continuation::{Branch, Diagram, Point};

/// A row: the branch (counted from 1), its period, what it is, the gait.
struct Row<'d> {
    branch: usize,
    period: usize,
    kind: &'static str,
    point: &'d Point,
}

impl Report<'_> {
    pub(super) fn table(&self, diagram: &Diagram) -> Table {
        let rows: Vec<Row<'_>> =
            diagram.branches.iter().enumerate().flat_map(|(number, branch)| rows(number + 1, branch)).collect();
        let (spec, parameter) = (&self.loaded.spec, self.parameter());
        let number = |name: &str, unit: String, doc: &str, of: &dyn Fn(&Point) -> f64| {
            column(name, unit, doc, Values::Number(rows.iter().map(|row| of(row.point)).collect()))
        };
        let none = String::new;
        let count = |of: &dyn Fn(&Row<'_>) -> usize| {
            Values::Integer(rows.iter().map(|row| i64::try_from(of(row)).unwrap_or(i64::MAX)).collect())
        };
        let mut columns = vec![
            column("branch", none(), "number of the branch", count(&|row| row.branch)),
            column("period", none(), "number of maps that make one period", count(&|row| row.period)),
            column("kind", none(), "gait, or how gaits change in kind here", {
                Values::Text(rows.iter().map(|row| row.kind.to_owned()).collect())
            }),
            number(&parameter.name, si_unit_like(parameter.dimension, &parameter.unit), &parameter.doc, &|p| p.value),
        ];
        for (i, &state) in self.loaded.coordinates().iter().enumerate() {
            let state = &spec.states[state];
            columns
                .push(number(&state.name, si_unit_like(state.dimension, &state.unit), &state.doc, &|p| p.section[i]));
        }
        for (i, measure) in spec.measures.iter().enumerate() {
            columns.push(number(&measure.name, si_unit_like(measure.dimension, &measure.unit), &measure.doc, &|p| {
                p.measures[i]
            }));
        }
        columns.push(number("spectral_radius", none(), "largest magnitude of the multipliers", &|p| p.spectral_radius));
        for i in 0..self.loaded.coordinates().len() {
            let multiplier = |p: &Point| p.multipliers.get(i).copied();
            let (re, im) = (format!("multiplier_{}_re", i + 1), format!("multiplier_{}_im", i + 1));
            columns.push(number(&re, none(), "real part", &|p| multiplier(p).map_or(f64::NAN, |m| m.re)));
            columns.push(number(&im, none(), "imaginary part", &|p| multiplier(p).map_or(f64::NAN, |m| m.im)));
        }
        columns.push(number("period_time", "s".to_owned(), "duration of one period", &|p| p.duration));
        columns.push(number("residual", none(), "by how much the gait misses itself", &|p| p.residual));
        Table { columns: unique(columns) }
    }
}

fn column(name: &str, unit: String, doc: &str, values: Values) -> Column {
    Column { name: name.to_owned(), unit, doc: doc.to_owned(), values }
}

/// Names of the spec come first where one of them is also the name of a column here.
fn unique(mut columns: Vec<Column>) -> Vec<Column> {
    for i in 0..columns.len() {
        while columns.iter().enumerate().any(|(j, other)| j < i && other.name == columns[i].name) {
            columns[i].name.push('_');
        }
    }
    columns
}

/// Gaits and bifurcations of a branch in order.
fn rows(number: usize, branch: &Branch) -> Vec<Row<'_>> {
    let row = |kind, point| Row { branch: number, period: branch.period, kind, point };
    let mut all = Vec::new();
    for (i, point) in branch.points.iter().enumerate() {
        all.push(row("gait", point));
        let behind = branch.bifurcations.iter().filter(|b| b.after == i);
        all.extend(behind.map(|b| row(words::kind(b.kind), &b.point)));
    }
    all
}
