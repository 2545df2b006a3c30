//! A run as tables: samples and transitions.

use super::report::Report;
use crate::cli::guards;
use crate::table::{Column, Table, Values};
use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::si_unit_like;

impl Report<'_> {
    /// One row a sample: times, mode, memory, states, rates, observations, the place of the body.
    pub(super) fn samples_table(&self) -> Table {
        let (samples, segments) = (&self.trajectory.samples, &self.trajectory.segments);
        let mode = |s: &usize| segments.get(*s).map_or("?", |segment| self.mode(segment.mode)).to_owned();
        let mut columns = vec![
            number("t", "s", "time since the start of the run", samples.t.clone()),
            number("tau", "s", "time since the last transition", samples.tau.clone()),
            column("mode", "", "mode", Values::Text(samples.segment.iter().map(mode).collect())),
        ];
        for (m, memory) in self.loaded.spec.memory.iter().enumerate() {
            let count = |s: &usize| segments.get(*s).and_then(|segment| segment.memory.get(m)).map_or(0, whole);
            columns.push(column(
                &memory.name,
                "",
                &memory.doc,
                Values::Integer(samples.segment.iter().map(count).collect()),
            ));
        }
        let width = self.states().len();
        let pick = |rows: &[f64], i: usize| rows.iter().skip(i).step_by(width.max(1)).copied().collect();
        for (i, state) in self.states().iter().enumerate() {
            columns.push(number(
                &state.name,
                &si_unit_like(state.dimension, &state.unit),
                &state.doc,
                pick(&samples.states, i),
            ));
        }
        for (i, state) in self.states().iter().enumerate() {
            let unit =
                state.dimension.div(Dimension::TIME).map(|rate| si_unit_like(rate, &state.unit)).unwrap_or_default();
            let (name, doc) = (format!("dot({})", state.name), format!("rate of {}", state.name));
            columns.push(number(&name, &unit, &doc, pick(&samples.rates, i)));
        }
        for (observation, values) in self.observed.iter().zip(self.values) {
            columns.push(number(&observation.name, &observation.unit, &observation.text, values.clone()));
        }
        if let Some(path) = self.path {
            let (x, y): (Vec<f64>, Vec<f64>) = path.body.iter().copied().unzip();
            columns.push(number("body_x", "m", "way of the body to the right", x));
            columns.push(number("body_y", "m", "way of the body up", y));
        }
        Table { columns: first_of_each_name(columns) }
    }

    /// One row a transition: when, which, memory after it, states before and after it.
    pub(super) fn events_table(&self) -> Table {
        let events = &self.trajectory.events;
        let mut columns = vec![
            number("time", "s", "time since the start of the run", events.iter().map(|e| e.time).collect()),
            column(
                "transition",
                "",
                "transition",
                Values::Text(events.iter().map(|e| self.transition(e.transition).to_owned()).collect()),
            ),
        ];
        columns.extend(self.transversality());
        for (m, memory) in self.loaded.spec.memory.iter().enumerate() {
            let counts = events.iter().map(|e| e.memory.get(m).map_or(0, whole)).collect();
            columns.push(column(&memory.name, "", &memory.doc, Values::Integer(counts)));
        }
        for (i, state) in self.states().iter().enumerate() {
            let unit = si_unit_like(state.dimension, &state.unit);
            for (side, doc) in [("before", "before the reset"), ("after", "after the reset")] {
                let of = |e: &gaitc_runtime::trajectory::Event| {
                    let values = if side == "before" { &e.before } else { &e.after };
                    values.get(i).copied().unwrap_or(f64::NAN)
                };
                let (name, doc) = (format!("{}_{side}", state.name), format!("{} {doc}", state.name));
                columns.push(number(&name, &unit, &doc, events.iter().map(of).collect()));
            }
        }
        Table { columns: first_of_each_name(columns) }
    }
}

impl Report<'_> {
    /// The rates of guards; their unit in the header where all transitions of the model share one, else beside each.
    fn transversality(&self) -> Vec<Column> {
        let (spec, events) = (&self.loaded.spec, &self.trajectory.events);
        let mut units: Vec<String> = (0..spec.transitions.len()).map(|i| guards::rate_unit(spec, i)).collect();
        units.sort();
        units.dedup();
        let (name, doc) = ("transversality", "time derivative of the guard just before it fired");
        let values = events.iter().map(|e| e.transversality).collect();
        match &units[..] {
            [unit] => vec![number(name, unit, doc, values)],
            _ => {
                let units = events.iter().map(|e| guards::rate_unit(spec, e.transition)).collect();
                let doc = format!("{doc}, in the unit of the next column");
                let beside = "unit of the guard's time derivative";
                vec![number(name, "", &doc, values), column("transversality_unit", "", beside, Values::Text(units))]
            }
        }
    }
}

/// A memory as the integer that it is.
fn whole(value: &f64) -> i64 {
    value.round() as i64
}

fn number(name: &str, unit: &str, doc: &str, values: Vec<f64>) -> Column {
    column(name, unit, doc, Values::Number(values))
}

fn column(name: &str, unit: &str, doc: &str, values: Values) -> Column {
    Column { name: name.to_owned(), unit: unit.to_owned(), doc: doc.to_owned(), values }
}

/// What is shown twice (`--show q_theta`) is written once.
fn first_of_each_name(columns: Vec<Column>) -> Vec<Column> {
    let mut kept: Vec<Column> = Vec::with_capacity(columns.len());
    for column in columns {
        if kept.iter().all(|other| other.name != column.name) {
            kept.push(column);
        }
    }
    kept
}
