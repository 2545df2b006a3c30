//! The health of a gait's guards: with which rate each of them crosses zero, and whether functions that vanish with it
//! (`also_zero` of the spec) cross zero too or only touch it.
//!
//! Where a guard g has the rate g' along the flow, the time at which it fires moves by -dg/g' with a disturbance dg: a
//! guard that crosses flatly makes a bad event, one that only touches zero (g' = 0) makes none.

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::{format_number, format_quantity, format_si, si_unit_like};
use gaitc_compiler::ir::{AlsoZero, Direction, Model, Transition};
use gaitc_runtime::orbit::Gait;
use gaitc_runtime::return_map::{AlsoZeroAt, Event, MapResult, Passage, Warning};
use gaitc_runtime::trajectory::Beyond;
use serde_json::{Value, json};

use super::output;

/// The guards of one map.
pub(super) struct Guards<'a> {
    pub(super) spec: &'a Model,
    pub(super) map: &'a MapResult,
}

impl Guards<'_> {
    fn transition(&self, index: usize) -> Option<&Transition> {
        self.spec.transitions.get(index)
    }

    fn name(&self, index: usize) -> &str {
        self.transition(index).map_or("?", |t| &t.name)
    }

    fn text_of(&self, index: usize) -> &str {
        self.transition(index).map_or("?", |t| &t.guard_text)
    }

    fn also_zero(&self, at: &AlsoZeroAt) -> Option<&AlsoZero> {
        self.transition(at.transition)?.also_zero.get(at.index)
    }

    /// Every transition that fired, in order of time.
    pub(super) fn events_json(&self) -> Value {
        let event = |e: &Event| {
            json!({
                "transition": self.name(e.transition),
                "guard": self.text_of(e.transition),
                "time": e.time,
                "transversality": e.transversality,
                "transversality_unit": rate_unit(self.spec, e.transition),
                "fastest": e.fastest,
            })
        };
        self.map.events.iter().map(event).collect()
    }

    /// The functions that vanish with the section's guard.
    pub(super) fn also_zero_json(&self) -> Value {
        let one = |at: &AlsoZeroAt| {
            let passage = at.passage(self.map.duration);
            json!({
                "transition": self.name(at.transition),
                "expression": self.also_zero(at).map_or("?", |zero| &zero.text),
                "start": at.start,
                "end": at.end,
                "rate": at.rate,
                "zero": passage != Passage::NotZero,
                "touches": passage == Passage::Touches,
            })
        };
        self.map.also_zero.iter().map(one).collect()
    }

    /// A table, one line a transition (its flattest crossing) and one a function that vanishes with it.
    pub(super) fn table(&self) -> String {
        let mut rows = Vec::new();
        for index in 0..self.spec.transitions.len() {
            rows.extend(self.crossing(index));
            let with_it = self.map.also_zero.iter().filter(|at| at.transition == index);
            rows.extend(with_it.map(|at| self.passage(at)));
        }
        output::table(&["guard", "function", "where it fires"], rows)
    }

    fn crossing(&self, index: usize) -> Option<Vec<String>> {
        let fired: Vec<&Event> = self.map.events.iter().filter(|e| e.transition == index).collect();
        let flattest = fired.iter().min_by(|a, b| steepness(a).total_cmp(&steepness(b)))?;
        let dimension = dimension(self.spec, index);
        let mut says = format!(
            "crosses zero at {}, transversality {}",
            format_quantity(flattest.time, "s"),
            rate(flattest.transversality, dimension)
        );
        if steepness(flattest).is_finite() {
            says += &format!(" ({} of its fastest rate)", percent(steepness(flattest)));
        }
        if fired.len() > 1 {
            says += &format!("; the flattest of {} crossings", fired.len());
        }
        Some(vec![self.name(index).to_owned(), self.text_of(index).to_owned(), says])
    }

    fn passage(&self, at: &AlsoZeroAt) -> Vec<String> {
        let (text, dimension) =
            self.also_zero(at).map_or(("?", Dimension::NONE), |zero| (zero.text.as_str(), zero.dimension));
        let says = match at.passage(self.map.duration) {
            Passage::NotZero => format!("is not zero there, but {}", format_si(at.end, dimension)),
            Passage::Touches => {
                format!("only touches zero (rate {}): it could not serve as guard", rate(at.rate, dimension))
            }
            Passage::Crosses => format!("crosses zero too (rate {})", rate(at.rate, dimension)),
        };
        vec!["  also zero".to_owned(), text.to_owned(), says]
    }
}

/// The rate at a crossing as a fraction of the largest one since the transition before; not finite where none is known.
fn steepness(event: &Event) -> f64 {
    event.transversality.abs() / event.fastest.max(event.transversality.abs())
}

/// A fraction in percent: whole ones, and two digits of what is less.
fn percent(fraction: f64) -> String {
    let percent = 100.0 * fraction;
    if percent >= 1.0 { format!("{percent:.0}%") } else { format!("{percent:.1e}%") }
}

/// The dimension of a transition's guard.
pub(super) fn dimension(spec: &Model, transition: usize) -> Dimension {
    spec.transitions.get(transition).map_or(Dimension::NONE, |t| t.guard_dimension)
}

/// The SI unit of the rate of a transition's guard; empty where it has none.
pub(super) fn rate_unit(spec: &Model, transition: usize) -> String {
    dimension(spec, transition).div(Dimension::TIME).map(|rate| si_unit_like(rate, "")).unwrap_or_default()
}

/// One sentence for what a run warns of. `grazed` is what a guard that is only grazed means for the result.
pub(super) fn warning(spec: &Model, warning: &Warning, grazed: &str) -> String {
    let name = |index: usize| spec.transitions.get(index).map_or("?", |t| &t.name);
    match *warning {
        Warning::Grazing { transition, time, transversality } => format!(
            "the guard of `{}` is only grazed at {time:.6} s (its rate there is {}): {grazed}",
            name(transition),
            rate(transversality, dimension(spec, transition))
        ),
        Warning::Tie { taken, other, time } => format!(
            "`{}` and `{}` fire together at {time:.6} s; the first in the spec's order was taken",
            name(taken),
            name(other)
        ),
    }
}

/// What to know of a gait: guards that it grazes, transitions that fire together, measures that are no numbers.
pub(super) fn of_gait(spec: &Model, gait: &Gait) -> Vec<String> {
    let warnings = gait.map.warnings.iter().map(|w| warning(spec, w, "the linearisation is not valid"));
    let measures = spec.measures.iter().zip(gait.map.measures.iter()).filter(|(_, value)| !value.is_finite());
    let undefined = measures.map(|(m, value)| format!("the measure `{}` is not a finite number ({value})", m.name));
    warnings.chain(undefined).collect()
}

/// One sentence for a run that starts on the far side of a guard: by how much, and what follows. Nothing of surfaces, where
/// nothing changes.
pub(super) fn beyond(spec: &Model, beyond: &Beyond) -> Option<String> {
    let transition = spec.transitions.get(beyond.transition).filter(|transition| !transition.surface)?;
    let Transition { name, guard_text, direction, guard_dimension, .. } = transition;
    let (way, side) = match direction {
        Direction::Rising => ("rises", "negative"),
        _ => ("falls", "positive"),
    };
    let place = match beyond.at_zero {
        true => format!("is zero there and its rate is {}", rate(beyond.rate, *guard_dimension)),
        false => format!("is {} there", format_si(beyond.value, *guard_dimension)),
    };
    Some(format!(
        "the start is beyond the guard of `{name}`: `{guard_text}` {place}, and `{name}` waits until that {way} through zero; start \
         where it is {side}"
    ))
}

/// A rate of a function of this dimension, in SI units.
pub(super) fn rate(value: f64, dimension: Dimension) -> String {
    match dimension.div(Dimension::TIME) {
        Some(dimension) => format_si(value, dimension),
        None => format!("{} (SI)", format_number(value)),
    }
}
