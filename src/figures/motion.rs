//! A run over time, and the path of its body.

use crate::load::Loaded;
use crate::motion::{self, BodyPath};
use crate::picture::{Curve, Event, Level, Panel, Path, Places, Series, Stretches, label};
use gaitc_compiler::front::Observations;
use gaitc_compiler::ir::{Joint, Observation};
use gaitc_runtime::trajectory::Trajectory;

/// With more transitions than this none is drawn: their lines would be a grey area.
const MOST_EVENTS: usize = 60;

/// Names that find room beside an axis: so many, or so many letters.
const MOST_NAMES: usize = 2;
const MOST_LETTERS: usize = 24;

/// A run to be drawn.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    /// The model.
    pub loaded: &'a Loaded,
    /// All parameters in SI units.
    pub parameters: &'a [f64],
    /// Where it went.
    pub trajectory: &'a Trajectory,
}

impl Run<'_> {
    /// What the spec's drawing finds worth plotting, over time; without a drawing that has panels, nothing.
    /// `levels` names the horizontal lines that belong to an observation, with their values in SI units.
    #[must_use]
    pub fn over_time(&self, title: &str, levels: &dyn Fn(&Observation) -> Vec<(String, f64)>) -> Series {
        let observations = &self.loaded.observations;
        let panels = observations.drawing().map_or(&[][..], |drawing| &drawing.panels);
        let panels = panels.iter().map(|panel| self.panel_of(observations, panel, levels)).collect();
        self.series(title, panels)
    }

    /// A panel of observations of one unit.
    pub(super) fn panel_of(
        &self,
        observations: &Observations,
        panel: &[Observation],
        levels: &dyn Fn(&Observation) -> Vec<(String, f64)>,
    ) -> Panel {
        self.panel(panel, &motion::observe(observations, panel, self.parameters, self.trajectory), levels)
    }

    /// Panels over the time of the run, with its transitions.
    #[must_use]
    pub fn series(&self, title: &str, panels: Vec<Panel>) -> Series {
        let few = self.trajectory.events.len() <= MOST_EVENTS;
        let events = self.trajectory.events.iter().filter(|_| few).map(|event| Event {
            at: event.time,
            label: self.loaded.spec.transitions.get(event.transition).map_or("", |t| &t.name).to_owned(),
        });
        Series { title: title.to_owned(), x: label("time", "s"), panels, events: events.collect() }
    }

    /// Observations of one unit with their values in SI units, one a sample.
    pub fn panel(
        &self,
        observations: &[Observation],
        values: &[Vec<f64>],
        levels: &dyn Fn(&Observation) -> Vec<(String, f64)>,
    ) -> Panel {
        let unit = observations.first().map_or("", |o| o.unit.as_str());
        let names: Vec<&str> = observations.iter().map(|o| o.name.as_str()).collect();
        let mut panel = Panel { y: axis(&names, unit), ..Panel::default() };
        for (index, (observation, values)) in observations.iter().zip(values).enumerate() {
            let levels = levels(observation);
            // A single curve has its name beside the axis.
            let name = if observations.len() == 1 && levels.is_empty() { "" } else { &observation.name };
            panel.curves.push(Curve { name: name.to_owned(), points: self.points(values) });
            panel.levels.extend(levels.into_iter().map(|(name, value)| Level { name, value, curve: Some(index) }));
        }
        panel
    }

    /// A value a sample as a curve over time, with a gap between both sides of each transition, and of each switch, where it may
    /// jump.
    pub fn points(&self, values: &[f64]) -> Vec<(f64, f64)> {
        let samples = &self.trajectory.samples;
        let mut points = Vec::with_capacity(values.len());
        for (i, (&t, &value)) in samples.t.iter().zip(values).enumerate() {
            let one_time = samples.t.get(i.wrapping_sub(1)) == Some(&t);
            if one_time || i > 0 && samples.segment.get(i - 1) != samples.segment.get(i) {
                points.push((t, f64::NAN));
            }
            points.push((t, value));
        }
        points
    }

    /// The path of the body with the points that are held, and the links as they stand at both sides of transitions.
    #[must_use]
    pub fn path(&self, title: &str, body: &BodyPath) -> Path {
        let segment = &self.trajectory.samples.segment;
        let is_end =
            |i: &usize| *i == 0 || segment.get(i - 1) != segment.get(*i) || segment.get(i + 1) != segment.get(*i);
        let ends_of_segments = || (0..segment.len()).filter(is_end);
        let finite = |p: (f64, f64)| p.0.is_finite() && p.1.is_finite();
        let held = body.points.iter().filter(|point| point.held).map(|point| {
            let mut at: Vec<(f64, f64)> = ends_of_segments().filter_map(|i| point.at.get(i).copied()).collect();
            at.retain(|&place| finite(place));
            at.dedup();
            Places { name: point.name.clone(), at }
        });
        let stretches = body.links.iter().map(|link| {
            let ends = ends_of_segments().filter_map(|i| Some([body.joint(link[0], i)?, body.joint(link[1], i)?]));
            let name = link.map(|joint| joint_name(joint, body)).join(" to ");
            Stretches { name, ends: ends.filter(|ends| ends.iter().all(|&end| finite(end))).collect() }
        });
        Path {
            title: title.to_owned(),
            x: label("to the right", "m"),
            y: label("up", "m"),
            curves: vec![Curve { name: "body".to_owned(), points: body.body.clone() }],
            stretches: stretches.collect(),
            places: held.collect(),
        }
    }
}

/// What stands beside an axis: the names as long as they are few.
fn axis(names: &[&str], unit: &str) -> String {
    let all = names.join(", ");
    if names.len() <= MOST_NAMES || all.chars().count() <= MOST_LETTERS {
        return label(&all, unit);
    }
    if matches!(unit, "" | "1") { String::new() } else { format!("[{unit}]") }
}

fn joint_name(joint: Joint, body: &BodyPath) -> String {
    match joint {
        Joint::Body => "body".to_owned(),
        Joint::Point(point) => body.points.get(point).map_or("?", |point| &point.name).to_owned(),
    }
}
