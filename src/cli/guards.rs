//! The health of a gait's guards: with which rate each of them crosses zero, and whether functions that vanish with it
//! (`also_zero` of the spec) cross zero too or only touch it.
//!
//! Where a guard g has the rate g' along the flow, the time at which it fires moves by -dg/g' with a disturbance dg: a
//! guard that crosses flatly makes a bad event, one that only touches zero (g' = 0) makes none.

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::{format_number, format_quantity, format_si};
use gaitc_compiler::ir::{AlsoZero, Model, Transition};
use gaitc_runtime::return_map::{AlsoZeroAt, Event, MapResult, Passage};
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

/// A rate of a function of this dimension, in SI units.
pub(super) fn rate(value: f64, dimension: Dimension) -> String {
    match dimension.div(Dimension::TIME) {
        Some(dimension) => format_si(value, dimension),
        None => format!("{} (SI)", format_number(value)),
    }
}
