//! Every measure of every model in `specs/` a second time, from samples of a trajectory: integrals and means by the trapezoidal rule,
//! extremes as those of the samples. Both share the integrator and nothing else: what stands inside a functional is evaluated by the
//! observations of the spec, not by generated code, and the arithmetic around functionals as well.

use super::At;
use gaitc::models::MODELS;
use gaitc::motion::observe;
use gaitc_compiler::front::{Library, Observations, parse_with};
use gaitc_compiler::ir::Observation;
use gaitc_compiler::show::Sheet;
use gaitc_runtime::return_map::Accuracy;
use gaitc_runtime::trajectory::{FollowRequest, Sampling, Start, Trajectory, Until};
use std::path::Path;

/// One step of a gait, sampled.
struct Step<'a> {
    at: &'a At,
    observations: Observations,
    run: Trajectory,
}

const FUNCTIONALS: [&str; 6] = ["start", "end", "integral", "mean", "cycle_max", "cycle_min"];

impl<'a> Step<'a> {
    fn new(at: &'a At, samples: usize) -> Self {
        let model = &at.machine.model;
        let request = FollowRequest {
            start: Start::Section(&at.z),
            parameters: &at.machine.parameters,
            memory: &model.memory(),
            until: Until::Crossings(1),
            sampling: Sampling::Count(samples),
            accuracy: Accuracy::default(),
        };
        let run = model.compiled.follow(&request).unwrap();
        assert_eq!(run.stop, None);
        Self { at, observations: model.observations.clone(), run }
    }

    fn observe(&mut self, text: &str) -> (Observation, Vec<f64>) {
        let observation = self.observations.observe(text).unwrap_or_else(|e| panic!("{}: {text}: {e}", self.at.name()));
        let chosen = [observation.clone()];
        let column = observe(&self.observations, &chosen, &self.at.machine.parameters, &self.run).remove(0);
        (observation, column)
    }

    /// A functional by its samples, with its unit: the reset that ends the step is behind it.
    fn functional(&mut self, kind: &str, expression: &str) -> (f64, String) {
        let (observation, mut v) = self.observe(expression);
        let mut t = self.run.samples.t.clone();
        let steps = self.run.events.iter().filter(|event| event.time > 0.0).count();
        if self.run.segments.len() > steps && self.run.events.last().is_some_and(|last| last.time == self.run.time) {
            // Both sides of the last transition are samples.
            t.pop();
            v.pop();
        }
        let integral: f64 = t.windows(2).zip(v.windows(2)).map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1])).sum();
        let unit = observation.unit;
        let value = match kind {
            "start" => v[0],
            "end" => v[v.len() - 1],
            "cycle_max" => v.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            "cycle_min" => v.iter().copied().fold(f64::INFINITY, f64::min),
            "mean" => integral / self.run.time,
            _ if matches!(unit.as_str(), "" | "1") => return (integral, "s".to_owned()),
            _ => return (integral, format!("s*{unit}")),
        };
        (value, unit)
    }

    /// A measure by its text: functionals, the duration and measures before it are put in as numbers. Also the largest of these.
    fn measure(&mut self, text: &str, before: &[(String, f64, String)]) -> (f64, f64) {
        let (mut written, mut rest, mut largest) = (String::new(), text, 0.0_f64);
        while let Some(c) = rest.chars().next() {
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            if end == 0 {
                written.push(c);
                rest = &rest[c.len_utf8()..];
                continue;
            }
            let (word, behind) = rest.split_at(end);
            rest = behind;
            let known = before.iter().find(|(name, ..)| name == word);
            let (value, unit) = match word {
                _ if FUNCTIONALS.contains(&word) => {
                    let close = closing(behind);
                    rest = &behind[close + 1..];
                    self.functional(word, &behind[1..close])
                }
                "duration" => (self.run.time, "s".to_owned()),
                _ if known.is_some() => known.map(|(_, value, unit)| (*value, unit.clone())).unwrap(),
                _ => {
                    written += word;
                    continue;
                }
            };
            largest = largest.max(value.abs());
            written += &if matches!(unit.as_str(), "" | "1") {
                format!("({value:e})")
            } else {
                format!("({value:e} [{unit}])")
            };
        }
        (self.observe(&written).1[0], largest)
    }
}

/// Where the bracket closes with which a text begins.
fn closing(text: &str) -> usize {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if depth == 0 {
            return at;
        }
    }
    panic!("{text}")
}

#[test]
fn measures_are_those_of_a_sampled_trajectory() {
    let mut compared = 0;
    for entry in MODELS {
        let at = At::gait_of(super::Machine::new(entry.compiled.info().name, &[]));
        let (model, gait) = (&at.machine.model, at.machine.gait(None));
        let path = format!("specs/{}.toml", at.name());
        let parsed = parse_with(Path::new(&path), entry.spec, Library::Texts(entry.parts));
        let sheet = Sheet::new(&parsed).unwrap();
        let mut step = Step::new(&at, 4000);
        let mut before: Vec<(String, f64, String)> = Vec::new();
        for ((name, text), (measure, &exact)) in
            sheet.measures().zip(model.spec.measures.iter().zip(gait.map.measures.iter()))
        {
            assert_eq!(name, measure.name);
            let (value, largest) = step.measure(text, &before);
            // The rule and the extremes of samples are of second order: 4000 of them a step.
            let close = (value - exact).abs() <= 1e-5 * largest.max(exact.abs());
            assert!(close, "{} {name} = {text}: {exact}, from samples {value}", at.name());
            compared += 1;
            before.push((name.to_owned(), value, gaitc_compiler::front::si_unit_like(measure.dimension, "")));
        }
    }
    assert!(compared >= 4 * MODELS.len(), "{compared}");
}
