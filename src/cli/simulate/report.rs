//! What `simulate` says: a table of the steps and how it ended for people, everything for programs.

use super::start::Start;
use crate::cli::{guards, inputs, output, stops};
use crate::load::Loaded;
use crate::motion::BodyPath;
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Observation, State};
use gaitc_runtime::return_map::StopReason;
use gaitc_runtime::trajectory::{Event, Trajectory, Until};
use serde_json::{Map, Value, json};

/// More rows than this, and those in the middle are left out.
const MOST_ROWS: usize = 40;

/// A run and what was asked for.
pub(super) struct Report<'a> {
    pub(super) loaded: &'a Loaded,
    pub(super) parameters: &'a [f64],
    pub(super) memory: &'a [f64],
    pub(super) start: &'a Start,
    /// Whether it starts on a gait.
    pub(super) on_gait: bool,
    pub(super) until: Until,
    pub(super) trajectory: &'a Trajectory,
    pub(super) observed: &'a [Observation],
    /// One column an observation, one value a sample.
    pub(super) values: &'a [Vec<f64>],
    pub(super) path: Option<&'a BodyPath>,
}

/// What JSON says where there was no gait to start on.
pub(super) fn nothing(model: &str, message: &str) -> Value {
    json!({
        "model": model, "status": "no_gait", "message": message, "parameters": null, "start": null, "duration": null, "samples": null,
        "events": null, "path": null, "stopped": null, "method": null, "warnings": [],
    })
}

impl Report<'_> {
    pub(super) fn states(&self) -> &[State] {
        &self.loaded.spec.states
    }

    fn state_names(&self) -> impl Iterator<Item = &str> {
        self.states().iter().map(|s| s.name.as_str())
    }

    pub(super) fn memory_names(&self) -> impl Iterator<Item = &str> {
        self.loaded.spec.memory.iter().map(|m| m.name.as_str())
    }

    pub(super) fn transition(&self, index: usize) -> &str {
        self.loaded.spec.transitions.get(index).map_or("?", |t| &t.name)
    }

    pub(super) fn mode(&self, index: usize) -> &str {
        self.loaded.spec.modes.get(index).map_or("?", |m| &m.name)
    }

    /// Whether a transition ends a step.
    pub(super) fn ends_step(&self, event: &Event) -> bool {
        self.loaded.spec.section.as_ref().is_some_and(|section| section.transition == event.transition)
    }

    fn steps(&self) -> usize {
        self.trajectory.events.iter().filter(|event| self.ends_step(event)).count()
    }

    fn status(&self) -> &'static str {
        self.trajectory.stop.map_or("completed", StopReason::name)
    }

    fn message(&self) -> String {
        let (run, steps) = (self.trajectory, self.steps());
        let (time, plural) = (format_quantity(run.time, "s"), |n: usize| if n == 1 { "" } else { "s" });
        match (run.stop, self.until) {
            (None, _) => format!("{steps} step{} in {time}", plural(steps)),
            (Some(reason), Until::Crossings(asked)) => {
                format!(
                    "stopped at {time}, after {steps} of {asked} step{}: {}",
                    plural(asked),
                    stops::explanation(reason).0
                )
            }
            (Some(reason), Until::Time(asked)) => {
                format!("stopped at {time} of {}: {}", format_quantity(asked, "s"), stops::explanation(reason).0)
            }
        }
    }

    fn warnings(&self) -> Vec<String> {
        let mut all = inputs::outside_range(self.loaded, self.parameters);
        // A gait may begin beyond a guard, and comes back to it by itself; so does a run that has just fired it.
        let beyond = self.trajectory.beyond.iter().filter(|_| !self.on_gait);
        let lost = beyond.filter(|beyond| !beyond.at_zero || self.trajectory.events.is_empty());
        all.extend(lost.filter_map(|beyond| guards::beyond(&self.loaded.spec, beyond)));
        let consequence = "a slightly other start may pass it by";
        let warnings = self.trajectory.warnings.iter();
        all.extend(warnings.map(|warning| guards::warning(&self.loaded.spec, warning, consequence)));
        all
    }

    pub(super) fn json(&self) -> Value {
        let (run, spec) = (self.trajectory, &self.loaded.spec);
        let state = |values: &[f64]| named(self.state_names(), values);
        let stopped =
            run.stop.map(|reason| json!({ "reason": reason.name(), "time": run.time, "state": state(&run.end) }));
        json!({
            "model": spec.name,
            "status": self.status(),
            "message": self.message(),
            "parameters": named(spec.parameters.iter().map(|p| p.name.as_str()), self.parameters),
            "start": self.start_json(),
            "duration": run.time,
            "samples": self.samples_json(),
            "events": run.events.iter().map(|event| json!({
                "transition": self.transition(event.transition),
                "time": event.time,
                "transversality": event.transversality,
                "transversality_unit": guards::rate_unit(spec, event.transition),
                "state_before": state(&event.before),
                "state_after": state(&event.after),
                "memory": named(self.memory_names(), &event.memory),
            })).collect::<Vec<_>>(),
            "path": self.path.map(|path| {
                let (x, y): (Vec<f64>, Vec<f64>) = path.body.iter().copied().unzip();
                json!({ "x": x, "y": y })
            }),
            "stopped": stopped,
            "method": inputs::method_name(run.method),
            "warnings": self.warnings(),
        })
    }

    fn start_json(&self) -> Value {
        let mode = match self.start {
            Start::State { mode, .. } => Some(*mode),
            Start::Section(_) => {
                let spec = &self.loaded.spec;
                spec.section.as_ref().and_then(|section| section.mode(&spec.transitions))
            }
        };
        let section = match self.start {
            Start::Section(coordinates) => {
                let names = self.loaded.coordinates().iter().map(|&i| self.states()[i].name.as_str());
                named(names, coordinates)
            }
            Start::State { .. } => Value::Null,
        };
        json!({
            "mode": mode.map(|mode| self.mode(mode)),
            "section": section,
            "state": named(self.state_names(), &self.trajectory.start),
            "memory": named(self.memory_names(), self.memory),
        })
    }

    fn samples_json(&self) -> Value {
        let (samples, segments) = (&self.trajectory.samples, &self.trajectory.segments);
        let of_segment = |pick: &dyn Fn(usize) -> Value| samples.segment.iter().map(|&s| pick(s)).collect::<Vec<_>>();
        let modes = of_segment(&|s| json!(segments.get(s).map(|segment| self.mode(segment.mode))));
        let memory: Map<String, Value> = self
            .memory_names()
            .enumerate()
            .map(|(m, name)| {
                let values = of_segment(&|s| json!(segments.get(s).and_then(|segment| segment.memory.get(m))));
                (name.to_owned(), json!(values))
            })
            .collect();
        let columns = |rows: &[f64]| -> Map<String, Value> {
            let width = self.states().len();
            let column = |i: usize| rows.iter().skip(i).step_by(width.max(1)).copied().collect::<Vec<f64>>();
            self.state_names().enumerate().map(|(i, name)| (name.to_owned(), json!(column(i)))).collect()
        };
        let observed = self.observed.iter().zip(self.values).map(|(o, values)| (o.name.clone(), json!(values)));
        json!({
            "t": samples.t,
            "tau": samples.tau,
            "mode": modes,
            "memory": memory,
            "state": columns(&samples.states),
            "rate": columns(&samples.rates),
            "observed": observed.collect::<Map<_, _>>(),
        })
    }

    pub(super) fn text(&self) -> String {
        let spec = &self.loaded.spec;
        let mut text = format!("{} · simulate\n{}: {}\n", spec.name, self.status(), self.message());
        for warning in self.warnings() {
            text += &format!("warning: {warning}\n");
        }
        if let Some(reason) = self.trajectory.stop {
            text += &format!("help: {}\n", self.help(reason));
        }
        text + "\n" + &self.steps_table()
    }

    fn help(&self, reason: StopReason) -> String {
        let general = stops::explanation(reason).1;
        if reason != StopReason::NoEvent {
            return general.to_owned();
        }
        // Some seconds after the last step are enough to see what it does instead of the next one.
        let last = self.trajectory.events.last().map_or(0.0, |event| event.time);
        format!("see it fall: --time {}s --plot FILE.svg; or {general}", (last + 2.0).ceil())
    }

    /// One row a step, with the section's coordinates after it; without a section one row a transition, with all states.
    fn steps_table(&self) -> String {
        let section = self.loaded.spec.section.as_ref();
        let shown: Vec<usize> =
            section.map_or_else(|| (0..self.states().len()).collect(), |section| section.coordinates.clone());
        let mut header = vec!["step".to_owned(), "time".to_owned(), "duration".to_owned(), "transitions".to_owned()];
        header.extend(shown.iter().filter_map(|&i| self.states().get(i)).map(|s| s.name.clone()));
        let states = |values: &[f64]| -> Vec<String> {
            let one = |&i: &usize| Some(format_quantity(*values.get(i)?, &self.states().get(i)?.unit));
            shown.iter().filter_map(one).collect()
        };
        let row = |first: [String; 4], values: &[f64]| [first.to_vec(), states(values)].concat();
        let seconds = |time: f64| format_quantity(time, "s");
        let mut rows =
            vec![row(["0".to_owned(), seconds(0.0), String::new(), "start".to_owned()], &self.trajectory.start)];
        let (mut since, mut passed) = (0.0, Vec::new());
        for event in &self.trajectory.events {
            passed.push(self.transition(event.transition));
            if section.is_some() && !self.ends_step(event) {
                continue;
            }
            let at = if section.is_some_and(|section| section.before) { &event.before } else { &event.after };
            let number = rows.len().to_string();
            rows.push(row([number, seconds(event.time), seconds(event.time - since), several(&passed)], at));
            since = event.time;
            passed.clear();
        }
        if self.trajectory.time > since {
            let (time, last) = (self.trajectory.time, self.trajectory.end.as_slice());
            passed.push(if self.trajectory.stop.is_some() { "stop" } else { "end" });
            rows.push(row([String::new(), seconds(time), seconds(time - since), several(&passed)], last));
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        output::table(&header, without_middle(rows))
    }
}

/// Names in order, many of one in a row counted.
fn several(names: &[&str]) -> String {
    let groups = names.chunk_by(|a, b| a == b);
    let one = |group: &[&str]| match group {
        [name] => (*name).to_owned(),
        [name, ..] => format!("{} x {name}", group.len()),
        [] => String::new(),
    };
    groups.map(one).collect::<Vec<_>>().join(", ")
}

/// Long tables lose their middle.
fn without_middle(mut rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    if rows.len() > MOST_ROWS {
        let (half, end) = (MOST_ROWS / 2, rows.len() - MOST_ROWS / 2);
        rows.splice(half..end, [vec!["...".to_owned()]]);
    }
    rows
}

fn named<'a>(names: impl Iterator<Item = &'a str>, values: &[f64]) -> Value {
    Value::Object(names.zip(values).map(|(name, v)| (name.to_owned(), json!(v))).collect())
}
