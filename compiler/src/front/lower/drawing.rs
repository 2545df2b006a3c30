//! The table `[drawing]`: expressions of the motion, each of the dimension that it is drawn in.

use super::dimension_text;
use super::lowering::{Expected, Lowering};
use super::value::{Place, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::names::is_identifier;
use crate::front::parser::shortened;
use crate::front::spec::{self, Equation, Named, Spec};
use crate::front::text::Text;
use crate::front::{si_unit, si_unit_like, units::parse_unit};
use crate::ir::{Drawing, DrawnPoint, Joint, Observation, Plane};

/// What links call the body.
const BODY: &str = "body";

impl Lowering<'_> {
    /// Lowers `[drawing]`; `None` without one, or where it is broken.
    pub(super) fn drawing(&mut self, spec: &Spec) -> Option<Drawing> {
        let drawing = spec.drawing.as_ref()?;
        let points: Vec<Option<DrawnPoint>> = drawing.points.iter().map(|item| self.drawn_point(spec, item)).collect();
        let links: Vec<Option<[Joint; 2]>> = drawing.links.iter().map(|ends| self.link(drawing, ends)).collect();
        let panels: Vec<Option<Vec<Observation>>> = drawing.panels.iter().map(|curves| self.panel(curves)).collect();
        let plane = match &drawing.velocity {
            None => None,
            Some(velocity) => Some(Plane {
                velocity: self.drawn(velocity, "m/s", "the velocity of the body")?,
                points: points.into_iter().collect::<Option<_>>()?,
                links: links.into_iter().collect::<Option<_>>()?,
            }),
        };
        Some(Drawing { plane, panels: panels.into_iter().collect::<Option<_>>()? })
    }

    fn drawn_point(&mut self, spec: &Spec, item: &Named<spec::DrawnPoint>) -> Option<DrawnPoint> {
        self.name_of_point(item);
        let modes = self.modes_of_point(spec, item);
        let at = item.value.at.as_ref()?;
        let observations = self.drawn(at, "m", &format!("the point `{}`", item.name))?;
        for (mode, there) in self.model.modes.clone().iter().zip(&modes) {
            for (equation, observation) in at.iter().zip(&observations) {
                if *there && let Some(state) = self.used(observation.expr, &mode.has_state) {
                    let (mode, state) = (&mode.name, self.state_name(state));
                    let message = format!(
                        "the point `{}` uses the state `{state}`, which mode `{mode}` does not have",
                        item.name
                    );
                    let error = Diagnostic::error(Code::NotAvailable, message).at(self.root_span(equation), "");
                    let help = "say in which modes the point is there, as in `modes = [\"stance\"]`";
                    self.diagnostics.push(error.help(help));
                    return None;
                }
            }
        }
        let (name, doc, held) = (item.name.clone(), item.value.doc.clone(), item.value.held);
        Some(DrawnPoint { name, doc, at: observations, modes, held })
    }

    fn name_of_point(&mut self, item: &Named<spec::DrawnPoint>) {
        let (code, message) = if item.name == BODY {
            (Code::ReservedName, "the body itself is no other point".to_owned())
        } else if !is_identifier(&item.name) {
            (Code::InvalidName, format!("`{}` is not a valid name", shortened(&item.name)))
        } else {
            return;
        };
        let help = "a point has a name of its own, such as `foot`: ASCII letters, digits and `_`, no digit first";
        self.diagnostics.push(Diagnostic::error(code, message).at(item.span, "").help(help));
    }

    /// For each mode whether the point is there.
    fn modes_of_point(&mut self, spec: &Spec, item: &Named<spec::DrawnPoint>) -> Vec<bool> {
        let Some(names) = &item.value.modes else { return vec![true; self.model.modes.len()] };
        let mut modes = vec![false; self.model.modes.len()];
        for name in names {
            if let Some(there) = self.mode(spec, name).and_then(|mode| modes.get_mut(mode)) {
                *there = true;
            }
        }
        modes
    }

    /// Two expressions of a unit: to the right, and up.
    fn drawn(&mut self, pair: &[Equation; 2], unit: &str, what: &str) -> Option<[Observation; 2]> {
        let dimension = parse_unit(unit).map_or(Dimension::NONE, |unit| unit.dimension);
        let help = format!("in a drawing lengths are m and speeds m/s: this must be {unit}");
        let expected = Expected { dimension: Some(dimension), what: what.to_owned(), help };
        let [x, y] = pair.each_ref().map(|equation| {
            let value = self.checked(equation, Place::Observation, &expected)?;
            Some(observation(equation, value, dimension))
        });
        Some([x?, y?])
    }

    fn link(&mut self, drawing: &spec::Drawing, ends: &[Text; 2]) -> Option<[Joint; 2]> {
        let mut names: Vec<&str> = drawing.points.iter().map(|point| point.name.as_str()).collect();
        names.push(BODY);
        let [a, b] = ends.each_ref().map(|end| self.reference("point", &end.value, end.span, &names));
        let joint = |end: usize| if end < drawing.points.len() { Joint::Point(end) } else { Joint::Body };
        let link = [joint(a?), joint(b?)];
        if link[0] == link[1] {
            let message = format!("this link joins `{}` with itself", shortened(&ends[0].value));
            let error = Diagnostic::error(Code::BadValue, message).at(ends[1].span, "");
            self.diagnostics.push(error.help("name two points, as in `[\"body\", \"foot\"]`"));
            return None;
        }
        Some(link)
    }

    /// The curves of a panel, which share an axis.
    fn panel(&mut self, curves: &[Equation]) -> Option<Vec<Observation>> {
        let lowered: Vec<Option<Value>> = curves.iter().map(|curve| self.equation(curve, Place::Observation)).collect();
        let known = |(curve, value): (usize, &Option<Value>)| Some((curve, value.as_ref()?.dimension?));
        let mut known = lowered.iter().enumerate().filter_map(known);
        let first = known.next();
        let common = first.map_or(Dimension::NONE, |(_, dimension)| dimension);
        let other = known.find(|(_, dimension)| *dimension != common);
        if let (Some((first, _)), Some((other, dimension))) = (first, other) {
            let message = "the curves of a panel share an axis, and these have different dimensions";
            let spans = [other, first].map(|curve| curves.get(curve).map(|curve| self.root_span(curve)));
            let [Some(span), Some(see)] = spans else { return None };
            let error =
                Diagnostic::error(Code::Clash, message).at(span, format!("this is {}", dimension_text(dimension)));
            let error = error.see(see, format!("this is {}", dimension_text(common)));
            self.diagnostics
                .push(error.help("give each dimension a panel: `panels = [[\"v_x\", \"v_y\"], [\"force\"]]`"));
            return None;
        }
        let lowered = curves.iter().zip(lowered).map(|(curve, value)| {
            let mut curve = observation(curve, value?, common);
            // A state says whether it is an angle, which its dimension does not.
            if let Some(state) = self.model.states.iter().find(|state| state.name == curve.name) {
                curve.unit = si_unit_like(common, &state.unit);
            }
            Some(curve)
        });
        lowered.collect()
    }
}

/// An expression of the spec that is looked at along a run.
fn observation(equation: &Equation, value: Value, dimension: Dimension) -> Observation {
    let text = equation.text.value.trim().to_owned();
    Observation { name: text.clone(), text, dimension, unit: si_unit(dimension), expr: value.node }
}
