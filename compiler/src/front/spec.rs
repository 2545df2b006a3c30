//! A spec as it was written: all tables read and their types checked, names not yet resolved.

use super::syntax::Expression;
use super::text::Text;
use crate::ir::{Direction, Sense};
use crate::source::Span;

/// A spec. What is missing or broken is `None` or left out, and has been reported.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spec {
    pub(crate) name: Option<Text>,
    pub(crate) title: String,
    pub(crate) source: String,
    /// Parts, in the order in which they are pulled in.
    pub(crate) uses: Vec<Use>,
    pub(crate) parameters: Vec<Named<Parameter>>,
    pub(crate) states: Vec<Named<State>>,
    pub(crate) memory: Vec<Named<Memory>>,
    pub(crate) lets: Vec<Named<Equation>>,
    pub(crate) functions: Vec<Named<Function>>,
    pub(crate) modes: Vec<Named<Mode>>,
    pub(crate) transitions: Vec<Named<Transition>>,
    pub(crate) surfaces: Vec<Named<Surface>>,
    pub(crate) section: Option<Section>,
    pub(crate) measures: Vec<Named<Measure>>,
    pub(crate) problems: Vec<Named<Problem>>,
    pub(crate) drawing: Option<Drawing>,
    pub(crate) published: Vec<Named<Published>>,
    /// Parameters of parts whose place a let has taken, each by the name of that let.
    pub(crate) fixed: Vec<Named<Parameter>>,
}

/// A part that is pulled in, and what its user says of it.
#[derive(Clone, Debug)]
pub(crate) struct Use {
    /// Its file, seen from the folder of the spec.
    pub(crate) part: Text,
    /// New names, by the names that the part uses.
    pub(crate) rename: Vec<Named<Text>>,
    /// Values of its parameters.
    pub(crate) set: Vec<Named<Text>>,
    /// Expressions that take the place of its parameters.
    pub(crate) fix: Vec<Named<Equation>>,
}

/// Something with a name and the place of that name.
#[derive(Clone, Debug)]
pub(crate) struct Named<T> {
    pub(crate) name: String,
    pub(crate) span: Span,
    pub(crate) value: T,
}

/// The text of an expression, and its tree if it could be read.
#[derive(Clone, Debug)]
pub(crate) struct Equation {
    pub(crate) text: Text,
    pub(crate) expression: Option<Expression>,
}

/// Two quantities.
#[derive(Clone, Debug)]
pub(crate) struct Interval {
    pub(crate) lower: Text,
    pub(crate) upper: Text,
    pub(crate) span: Span,
}

#[derive(Clone, Debug)]
pub(crate) struct Parameter {
    pub(crate) value: Option<Text>,
    pub(crate) range: Option<Interval>,
    pub(crate) doc: String,
    /// The value that its part gives it, where the user of the part has set another one.
    pub(crate) replaced: Option<Text>,
}

#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) unit: Option<Text>,
    /// The modes that have it; all of them without.
    pub(crate) modes: Option<Vec<Text>>,
    pub(crate) doc: String,
}

#[derive(Clone, Debug)]
pub(crate) struct Memory {
    pub(crate) initial: i64,
    pub(crate) doc: String,
}

#[derive(Clone, Debug)]
pub(crate) struct Function {
    pub(crate) arguments: Vec<Text>,
    pub(crate) body: Option<Equation>,
    pub(crate) doc: String,
}

#[derive(Clone, Debug)]
pub(crate) struct Mode {
    pub(crate) flow: Vec<Named<Equation>>,
    /// Rows of the mass matrix, each by the state whose flow it belongs to; none is the identity.
    pub(crate) mass: Vec<Named<MassRow>>,
    pub(crate) doc: String,
}

/// What stands at a row of a mass matrix.
#[derive(Clone, Debug)]
pub(crate) enum MassRow {
    /// The diagonal entry; the others are 0.
    Factor(Equation),
    /// Entries by the state whose rate they multiply; the others are 0.
    Entries(Vec<Named<Equation>>),
}

#[derive(Clone, Debug)]
pub(crate) struct Transition {
    pub(crate) from: Option<Text>,
    pub(crate) to: Option<Text>,
    pub(crate) guard: Option<Equation>,
    pub(crate) direction: Option<Direction>,
    pub(crate) when: Option<Equation>,
    pub(crate) reset: Vec<Named<Equation>>,
    /// Functions that vanish together with the guard, and the place of their key.
    pub(crate) also_zero: Option<(Span, Vec<Equation>)>,
    pub(crate) doc: String,
}

/// A surface inside a mode, which a run passes without noticing.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub(crate) mode: Option<Text>,
    pub(crate) guard: Option<Equation>,
    pub(crate) direction: Option<Direction>,
    pub(crate) doc: String,
}

/// At what a section stands.
#[derive(Clone, Debug)]
pub(crate) enum Anchor {
    /// Just after this transition.
    After(Text),
    /// Just before this transition.
    Before(Text),
    /// On this surface.
    At(Text),
}

#[derive(Clone, Debug)]
pub(crate) struct Section {
    pub(crate) span: Span,
    pub(crate) anchor: Option<Anchor>,
    /// `None` where they are missing or broken.
    pub(crate) coordinates: Option<Vec<Text>>,
    pub(crate) embed: Vec<Named<Equation>>,
    pub(crate) start: Vec<Named<Text>>,
    pub(crate) symmetry: Option<Vec<Named<Equation>>>,
}

#[derive(Clone, Debug)]
pub(crate) struct Measure {
    pub(crate) expr: Option<Equation>,
    pub(crate) unit: Option<Text>,
    pub(crate) doc: String,
}

#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub(crate) doc: String,
    /// The place of `default = true`.
    pub(crate) default: Option<Span>,
    pub(crate) objective: Option<(Sense, Equation)>,
    pub(crate) vary: Vec<Named<Interval>>,
    /// Parameters that are only known to lie in ranges.
    pub(crate) robust: Vec<Named<Interval>>,
    pub(crate) subject_to: Vec<Equation>,
    /// How many maps make the gait.
    pub(crate) period: usize,
}

/// How the machine is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    pub(crate) span: Span,
    /// Of the body: to the right, and up.
    pub(crate) velocity: Option<[Equation; 2]>,
    pub(crate) points: Vec<Named<DrawnPoint>>,
    /// Names of points, `body` among them.
    pub(crate) links: Vec<[Text; 2]>,
    /// Curves of one axis each.
    pub(crate) panels: Vec<Vec<Equation>>,
}

/// A point seen from the body.
#[derive(Clone, Debug)]
pub(crate) struct DrawnPoint {
    pub(crate) at: Option<[Equation; 2]>,
    /// The modes in which it is there; all of them without.
    pub(crate) modes: Option<Vec<Text>>,
    pub(crate) held: bool,
    pub(crate) doc: String,
}

/// Numbers that others have published.
#[derive(Clone, Debug)]
pub(crate) struct Published {
    pub(crate) doc: String,
    pub(crate) source: Option<Text>,
    pub(crate) set: Vec<Named<Text>>,
    pub(crate) start: Vec<Named<Text>>,
    pub(crate) measures: Vec<Named<Text>>,
    pub(crate) section: Vec<Named<Text>>,
    pub(crate) spread: Vec<Named<Text>>,
}

impl Drawing {
    /// Its expressions.
    pub(crate) fn equations(&self) -> impl Iterator<Item = &Equation> {
        let points = self.points.iter().filter_map(|point| point.value.at.as_ref()).flatten();
        self.velocity.iter().flatten().chain(points).chain(self.panels.iter().flatten())
    }

    /// The same, to be changed.
    pub(crate) fn equations_mut(&mut self) -> impl Iterator<Item = &mut Equation> {
        let points = self.points.iter_mut().filter_map(|point| point.value.at.as_mut()).flatten();
        self.velocity.iter_mut().flatten().chain(points).chain(self.panels.iter_mut().flatten())
    }
}

impl Published {
    /// Everything in it that has a name elsewhere.
    pub(crate) fn quantities(&self) -> impl Iterator<Item = &Named<Text>> {
        self.set.iter().chain(&self.start).chain(&self.measures).chain(&self.section).chain(&self.spread)
    }

    /// The same, to be changed.
    pub(crate) fn quantities_mut(&mut self) -> impl Iterator<Item = &mut Named<Text>> {
        let numbers = self.measures.iter_mut().chain(&mut self.section).chain(&mut self.spread);
        self.set.iter_mut().chain(&mut self.start).chain(numbers)
    }
}

impl Spec {
    /// Every expression of the spec, for checks that hold everywhere.
    pub(crate) fn equations(&self) -> impl Iterator<Item = &Equation> {
        let lets = self.lets.iter().map(|item| &item.value);
        let functions = self.functions.iter().filter_map(|item| item.value.body.as_ref());
        let flows = self.modes.iter().flat_map(|item| &item.value.flow).map(|item| &item.value);
        let masses = self.modes.iter().flat_map(|item| &item.value.mass).flat_map(|row| row.value.equations());
        let transitions = self.transitions.iter().flat_map(|item| {
            let reset = item.value.reset.iter().map(|item| &item.value);
            let also_zero = item.value.also_zero.iter().flat_map(|(_, equations)| equations);
            item.value.guard.iter().chain(&item.value.when).chain(reset).chain(also_zero)
        });
        let surfaces = self.surfaces.iter().filter_map(|item| item.value.guard.as_ref());
        let section = self
            .section
            .iter()
            .flat_map(|section| section.embed.iter().chain(section.symmetry.iter().flatten()).map(|item| &item.value));
        let measures = self.measures.iter().filter_map(|item| item.value.expr.as_ref());
        let problems = self
            .problems
            .iter()
            .flat_map(|item| item.value.objective.iter().map(|(_, equation)| equation).chain(&item.value.subject_to));
        let results = measures.chain(problems).chain(self.drawing.iter().flat_map(Drawing::equations));
        lets.chain(functions)
            .chain(flows)
            .chain(masses)
            .chain(transitions)
            .chain(surfaces)
            .chain(section)
            .chain(results)
    }
}

impl Anchor {
    /// The name of the transition or surface.
    pub(crate) const fn name(&self) -> &Text {
        match self {
            Self::After(name) | Self::Before(name) | Self::At(name) => name,
        }
    }
}

impl MassRow {
    /// Its entries.
    fn equations(&self) -> impl Iterator<Item = &Equation> {
        let (factor, entries) = match self {
            Self::Factor(equation) => (Some(equation), &[][..]),
            Self::Entries(entries) => (None, entries.as_slice()),
        };
        factor.into_iter().chain(entries.iter().map(|entry| &entry.value))
    }
}
