//! The health of a gait's guards: with which rate each of them crosses zero, and whether functions that vanish with it
//! (`also_zero` of the spec) cross zero too or only touch it.
//!
//! Where a guard g has the rate g' along the flow, the time at which it fires moves by -dg/g' with a disturbance dg: a
//! guard that crosses flatly makes a bad event, one that only touches zero (g' = 0) makes none.

use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::{format_number, format_quantity, format_si};
use gaitc_compiler::ir::{AlsoZero, Model, Transition};
use gaitc_runtime::return_map::{AlsoZeroAt, Event, MapResult};
use serde_json::{Value, json};

use super::output;

/// A function only touches zero when its rate there, kept up for the whole map, would change it by less than this
/// fraction of what the map changes it by.
const TOUCHING: f64 = 1e-6;
/// A value within this fraction of the function's size is zero.
const ZERO: f64 = 1e-6;

/// How a function behaves at the moment when it should be zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Passage {
    /// It is not zero.
    NotZero,
    /// It is zero, and its rate too.
    Touches,
    /// It is zero, and its rate is not.
    Crosses,
}

impl Passage {
    fn of(at: &AlsoZeroAt, duration: f64) -> Self {
        let change = (at.start - at.end).abs();
        let swing = at.rate.abs() * duration;
        let size = at.start.abs().max(change).max(swing);
        // Written so that what is no number counts as not zero.
        if !(at.end.abs() <= ZERO * size || at.end == 0.0) {
            Self::NotZero
        } else if swing <= TOUCHING * change {
            Self::Touches
        } else {
            Self::Crosses
        }
    }
}

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
            let passage = Passage::of(at, self.map.duration);
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
        let says = match Passage::of(at, self.map.duration) {
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

#[cfg(test)]
mod tests {
    use super::{AlsoZeroAt, Passage};

    fn passage(start: f64, end: f64, rate: f64) -> Passage {
        Passage::of(&AlsoZeroAt { transition: 0, index: 0, start, end, rate }, 0.5)
    }

    #[test]
    fn a_function_touches_where_it_is_zero_with_its_rate() {
        assert_eq!(passage(0.13, 1e-17, -3e-12), Passage::Touches);
        assert_eq!(passage(0.13, 0.0, 0.0), Passage::Touches);
        assert_eq!(passage(0.13, 1e-17, -1e-6), Passage::Crosses);
        // Up and down again.
        assert_eq!(passage(0.0, 1e-14, -2.0), Passage::Crosses);
    }

    #[test]
    fn a_function_that_is_not_zero_neither_touches_nor_crosses() {
        assert_eq!(passage(0.13, 1e-3, -3e-12), Passage::NotZero);
        assert_eq!(passage(0.13, 0.13, 0.0), Passage::NotZero);
        assert_eq!(passage(0.13, f64::NAN, 0.0), Passage::NotZero);
    }
}
