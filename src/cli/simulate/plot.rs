//! A run as pictures: curves over time, and the path of the body.

use super::report::Report;
use crate::motion::BodyPath;
use crate::picture::{self, Curve, Panel, Path, Places, Series, Stretches, label};
use gaitc_compiler::front::si_unit;
use gaitc_compiler::ir::{Joint, Observation};

/// With more transitions than this none is drawn.
const MOST_EVENTS: usize = 60;

impl Report<'_> {
    /// Curves over time: of what was asked for (`chosen`), else of what the spec's drawing names, else of the states.
    pub(super) fn series(&self, chosen: bool) -> Series {
        let drawing = self.loaded.observations.drawing().map_or(&[][..], |drawing| &drawing.panels);
        let panels = match (chosen, drawing.is_empty()) {
            (true, _) => self.by_unit(self.observed.iter().zip(self.values.iter().cloned())),
            (false, false) => drawing.iter().map(|panel| self.panel(panel, &self.along(panel))).collect(),
            (false, true) => self.state_panels(),
        };
        // More lines than this would be a grey area.
        let few = self.trajectory.events.len() <= MOST_EVENTS;
        let events = self
            .trajectory
            .events
            .iter()
            .filter(|_| few)
            .map(|event| picture::Event { at: event.time, label: self.transition(event.transition).to_owned() });
        Series { title: self.title(), x: label("time", "s"), panels, events: events.collect() }
    }

    /// The path of the body, with links and points that are held.
    pub(super) fn plane(&self, path: &BodyPath) -> Path {
        let held: Vec<Places> = path
            .points
            .iter()
            .filter(|point| point.held)
            .map(|point| {
                let mut at: Vec<(f64, f64)> =
                    self.ends_of_segments().filter_map(|i| point.at.get(i).copied()).collect();
                at.retain(|place| place.0.is_finite());
                at.dedup();
                Places { name: point.name.clone(), at }
            })
            .collect();
        let stretches: Vec<Stretches> = path
            .links
            .iter()
            .map(|link| {
                let ends = |i: usize| Some([path.joint(link[0], i)?, path.joint(link[1], i)?]);
                let all = self.ends_of_segments().filter_map(ends);
                let there = |ends: &[(f64, f64); 2]| ends.iter().all(|end| end.0.is_finite() && end.1.is_finite());
                let name = link.map(|joint| joint_name(joint, path)).join(" to ");
                Stretches { name, ends: all.filter(there).collect() }
            })
            .collect();
        Path {
            title: self.title(),
            x: label("to the right", "m"),
            y: label("up", "m"),
            curves: vec![Curve { name: "body".to_owned(), points: path.body.clone() }],
            stretches,
            places: held,
        }
    }

    fn title(&self) -> String {
        let spec = &self.loaded.spec;
        if spec.title.is_empty() { spec.name.clone() } else { spec.title.clone() }
    }

    /// First and last samples of segments.
    fn ends_of_segments(&self) -> impl Iterator<Item = usize> {
        let segment = &self.trajectory.samples.segment;
        (0..segment.len())
            .filter(move |&i| i == 0 || segment.get(i - 1) != segment.get(i) || segment.get(i + 1) != segment.get(i))
    }

    fn along(&self, chosen: &[Observation]) -> Vec<Vec<f64>> {
        crate::motion::observe(&self.loaded.observations, chosen, self.parameters, self.trajectory)
    }

    fn panel(&self, observations: &[Observation], values: &[Vec<f64>]) -> Panel {
        let unit = observations.first().map_or("", |o| o.unit.as_str());
        let (y, name): (String, fn(&Observation) -> String) = match observations {
            [one] => (label(&one.name, unit), |_| String::new()),
            _ => (unit.to_owned(), |o| o.name.clone()),
        };
        let curves = observations.iter().zip(values).map(|(o, values)| self.curve(name(o), values));
        Panel { y, curves: curves.collect(), levels: Vec::new() }
    }

    /// A curve over time, with a gap between both sides of each transition.
    fn curve(&self, name: String, values: &[f64]) -> Curve {
        let samples = &self.trajectory.samples;
        let mut points = Vec::with_capacity(values.len());
        for (i, (&t, &value)) in samples.t.iter().zip(values).enumerate() {
            if i > 0 && samples.segment.get(i - 1) != samples.segment.get(i) {
                points.push((t, f64::NAN));
            }
            points.push((t, value));
        }
        Curve { name, points }
    }

    /// One panel a unit, in the order of their first curves.
    fn by_unit<'o>(&self, all: impl Iterator<Item = (&'o Observation, Vec<f64>)>) -> Vec<Panel> {
        let mut groups: Vec<(Vec<Observation>, Vec<Vec<f64>>)> = Vec::new();
        for (observation, values) in all {
            let group = groups.iter().position(|(o, _)| o.first().is_some_and(|o| o.unit == observation.unit));
            match group.and_then(|i| groups.get_mut(i)) {
                Some((observations, columns)) => {
                    observations.push(observation.clone());
                    columns.push(values);
                }
                None => groups.push((vec![observation.clone()], vec![values])),
            }
        }
        groups.iter().map(|(observations, values)| self.panel(observations, values)).collect()
    }

    fn state_panels(&self) -> Vec<Panel> {
        let (states, samples) = (self.states(), &self.trajectory.samples);
        let mut panels: Vec<(String, Panel, Vec<String>)> = Vec::new();
        for (i, state) in states.iter().enumerate() {
            let values: Vec<f64> = samples.states.iter().skip(i).step_by(states.len()).copied().collect();
            let (unit, curve) = (si_unit(state.dimension), self.curve(state.name.clone(), &values));
            match panels.iter().position(|(known, ..)| *known == unit).and_then(|i| panels.get_mut(i)) {
                Some((_, panel, names)) => {
                    panel.curves.push(curve);
                    names.push(state.name.clone());
                }
                None => {
                    let panel = Panel { y: unit.clone(), curves: vec![curve], levels: Vec::new() };
                    panels.push((unit, panel, vec![state.name.clone()]));
                }
            }
        }
        let finish = |(unit, mut panel, names): (String, Panel, Vec<String>)| {
            if let ([name], [curve]) = (&names[..], &mut panel.curves[..]) {
                panel.y = label(name, &unit);
                curve.name = String::new();
            }
            panel
        };
        panels.into_iter().map(finish).collect()
    }
}

fn joint_name(joint: Joint, path: &BodyPath) -> String {
    match joint {
        Joint::Body => "body".to_owned(),
        Joint::Point(point) => path.points.get(point).map_or("?", |point| &point.name).to_owned(),
    }
}
