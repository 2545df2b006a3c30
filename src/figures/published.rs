//! The computed motion with published numbers as horizontal lines: the mean, the largest, the least value of what is drawn.

use super::Run;
use crate::load::Loaded;
use crate::picture::Series;
use crate::published::Comparison;
use gaitc_compiler::front::{Observations, format_quantity};
use gaitc_compiler::ir::{Observation, PublishedOf};
use gaitc_compiler::show::Sheet;
use gaitc_runtime::orbit::Gait;
use gaitc_runtime::return_map::{Accuracy, RequestError};
use gaitc_runtime::trajectory::{FollowRequest, Sampling, Start, Until};

/// Samples of the two steps that are drawn.
const SAMPLES: usize = 300;

/// Functionals of one expression that are places on its curve, with their names for people.
const ON_THE_CURVE: [(&str, &str); 5] =
    [("mean", "mean"), ("cycle_max", "largest"), ("cycle_min", "least"), ("start", "start"), ("end", "end")];

/// A number as a horizontal line: of which curve, what it is of it, and by what to multiply the number.
#[derive(Clone, Debug, PartialEq)]
struct Place<'a> {
    expression: &'a str,
    kind: &'static str,
    sign: f64,
}

/// What a measure is of a curve, where it is one value of one: `cycle_max(v)`, `-cycle_min(v)`.
fn place(measure: &str) -> Option<Place<'_>> {
    let text = measure.trim();
    let (sign, text) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest.trim_start()));
    let (name, rest) = text.split_once('(')?;
    let (_, kind) = ON_THE_CURVE.iter().find(|(functional, _)| *functional == name.trim_end())?;
    // The bracket that opens here has to close at the end.
    let mut depth = 1;
    let close = rest.char_indices().find_map(|(at, c)| {
        depth += match c {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        (depth == 0).then_some(at)
    })?;
    let (expression, behind) = rest.split_at(close);
    (behind.len() == 1).then_some(Place { expression: expression.trim(), kind, sign })
}

/// Without spaces: so written the same expressions are the same text.
fn bare(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}

fn level(kind: &str, observation: &Observation, value: f64) -> String {
    format!("{}: {kind}, {}", observation.name, format_quantity(value, &observation.unit))
}

/// The mean of an observation on a gait as a level, where a measure of the spec is that mean.
#[must_use]
pub fn mean(sheet: &Sheet, gait: &Gait, observation: &Observation) -> Option<(String, f64)> {
    let mean = format!("mean({})", bare(&observation.name));
    let measure = sheet.measures().position(|(_, text)| bare(text) == mean)?;
    let value = *gait.map.measures.get(measure)?;
    value.is_finite().then(|| (level("mean, computed", observation, value), value))
}

/// The panels of a picture, and the levels of each observation in them.
#[derive(Default)]
struct Panels {
    panels: Vec<Vec<Observation>>,
    levels: Vec<(String, Vec<(String, f64)>)>,
}

impl Panels {
    /// Adds levels to a curve, and the curve where it is not there: to a panel of its unit.
    fn add(&mut self, observation: Observation, levels: Vec<(String, f64)>) {
        let name = bare(&observation.name);
        match self.levels.iter_mut().find(|(known, _)| *known == name) {
            Some((_, known)) => known.extend(levels),
            None => self.levels.push((name.clone(), levels)),
        }
        if self.panels.iter().flatten().any(|known| bare(&known.name) == name) {
            return;
        }
        match self.panels.iter_mut().find(|panel| panel.first().is_some_and(|first| first.unit == observation.unit)) {
            Some(panel) => panel.push(observation),
            None => self.panels.push(vec![observation]),
        }
    }

    fn of(&self, observation: &Observation) -> Vec<(String, f64)> {
        let name = bare(&observation.name);
        let levels = self.levels.iter().find(|(known, _)| *known == name);
        levels.map_or_else(Vec::new, |(_, levels)| levels.clone())
    }
}

/// Every published number that is a value of some curve (the mean, largest, least, first or last value of an expression in a
/// step, or a coordinate of the section) as a level of that curve, with the computed value beside it: over two steps of the gait at
/// the publication's parameters. Curves are those of the spec's drawing, and what is published beyond them. No panels where there
/// is no gait or no such number.
///
/// # Errors
/// When the model cannot be followed.
pub fn published(loaded: &Loaded, sheet: &Sheet, comparison: &Comparison<'_>) -> Result<Series, RequestError> {
    let Some(gait) = comparison.gait() else { return Ok(Series::default()) };
    let mut observations = loaded.observations.clone();
    let drawn = observations.drawing().map_or_else(Vec::new, |drawing| drawing.panels.clone());
    let panels = panels(loaded, sheet, comparison, (&mut observations, drawn));
    if panels.levels.is_empty() {
        return Ok(Series::default());
    }
    let memory = loaded.memory();
    let follow = FollowRequest {
        start: Start::Section(gait.coordinates.as_slice()),
        parameters: &comparison.parameters,
        memory: &memory,
        until: Until::Crossings(2),
        sampling: Sampling::Count(SAMPLES),
        accuracy: Accuracy::default(),
    };
    let trajectory = loaded.compiled.follow(&follow)?;
    let run = Run { loaded, parameters: &comparison.parameters, trajectory: &trajectory };
    let levels = |observation: &Observation| panels.of(observation);
    let all = panels.panels.iter().map(|panel| run.panel_of(&observations, panel, &levels));
    let all = all.filter(|panel| !panel.levels.is_empty()).collect();
    Ok(run.series(&format!("{}: two steps", comparison.published.name), all))
}

/// The curves with the levels of all published numbers.
fn panels(
    loaded: &Loaded,
    sheet: &Sheet,
    comparison: &Comparison<'_>,
    (observations, drawn): (&mut Observations, Vec<Vec<Observation>>),
) -> Panels {
    let measures: Vec<(&str, &str)> = sheet.measures().collect();
    let mut panels = Panels { panels: drawn, ..Panels::default() };
    for number in &comparison.published.numbers {
        let place = match number.of {
            PublishedOf::Measure(i) => measures.get(i).and_then(|(_, text)| place(text)),
            PublishedOf::Coordinate(i) => {
                let state = loaded.coordinates().get(i).and_then(|&state| loaded.spec.states.get(state));
                state.map(|state| Place { expression: &state.name, kind: "on the section", sign: 1.0 })
            }
            PublishedOf::SpectralRadius => None,
        };
        let Some(Place { expression, kind, sign }) = place else { continue };
        let drawn = panels.panels.iter().flatten().find(|known| bare(&known.name) == bare(expression)).cloned();
        // An expression of the spec is one that can be observed, but for what only a map knows, as in `d(x, x_0)`.
        let Some(observation) = drawn.or_else(|| observations.observe(expression).ok()) else { continue };
        let line = |who: &str, value: f64| {
            let spread = number.spread.filter(|_| who == "published");
            let spread = spread.map_or(String::new(), |by| format!(" ± {}", format_quantity(by, &observation.unit)));
            (level(&format!("{kind}, {who}"), &observation, sign * value) + &spread, sign * value)
        };
        let theirs = line("published", number.value);
        // Both ends of the spread, as the published line and without names.
        let spread = number.spread.into_iter().flat_map(|by| [number.value - by, number.value + by]);
        let spread = spread.map(|value| (String::new(), sign * value));
        let ours = comparison.computed(number).map(|value| line("computed", value));
        let levels = std::iter::once(theirs).chain(spread).chain(ours).collect();
        panels.add(observation, levels);
    }
    panels
}

#[cfg(test)]
mod tests {
    use super::{Place, place};

    #[test]
    fn measures_that_are_a_value_of_a_curve_are_told_from_others() {
        let is = |expression, kind, sign| Some(Place { expression, kind, sign });
        assert_eq!(place("mean(v_y)"), is("v_y", "mean", 1.0));
        assert_eq!(place(" - cycle_min( abs(v) ) "), is("abs(v)", "least", -1.0));
        assert_eq!(place("end(a*(b + c))"), is("a*(b + c)", "end", 1.0));
        for other in
            ["mean(a)/mean(b)", "integral(v)", "1/duration", "2*mean(a)", "cycle_max(a) - cycle_min(a)", "mean(a"]
        {
            assert_eq!(place(other), None, "{other}");
        }
    }
}
