//! The Poincare section: coordinates, embedding of the other states, first guess and symmetry.

use super::lowering::{Expected, Lowering};
use super::value::Place;
use crate::diagnostic::{Code, Diagnostic};
use crate::front::quantity::Quantities;
use crate::front::spec::{self, Equation, Named, Spec};
use crate::front::text::Text;
use crate::ir::{self, Model, NodeId, Symbol};
use crate::source::Span;

impl Lowering<'_> {
    /// Lowers `[section]`.
    pub(super) fn section(&mut self, spec: &Spec) {
        let Some(section) = &spec.section else { return };
        let transition = section.anchor.as_ref().and_then(|anchor| self.anchor(spec, anchor));
        let before = matches!(section.anchor, Some(spec::Anchor::Before(_)));
        let ends = transition.and_then(|i| self.model.transitions.get(i)).map(|t| (t.from, t.to));
        let mode = ends.map(|(from, to)| if before { from } else { to });
        let has_state = mode.and_then(|mode| self.model.modes.get(mode)).map(|mode| mode.has_state.clone());
        let given = section.coordinates.as_deref();
        let coordinates = self.coordinates(given.unwrap_or(&[]), has_state.as_deref());
        // Where coordinates are broken, it is not known what else the section has to say.
        self.whole_section = given.is_some_and(|given| given.len() == coordinates.len());
        let embed = self.embed(section, &coordinates, has_state.as_deref());
        let start = self.start(section, &coordinates);
        let symmetry = section.symmetry.as_ref().map(|equations| self.symmetry(equations));
        let transition = transition.unwrap_or(0);
        self.model.section = Some(ir::Section { transition, before, coordinates, embed, start, symmetry });
    }

    /// The index of the transition at which a section stands. Surfaces stand behind the transitions.
    fn anchor(&mut self, spec: &Spec, anchor: &spec::Anchor) -> Option<usize> {
        let name = anchor.name();
        let (kind, names, first): (_, Vec<&str>, _) = match anchor {
            spec::Anchor::At(_) => {
                ("surface", spec.surfaces.iter().map(|item| item.name.as_str()).collect(), spec.transitions.len())
            }
            _ => ("transition", spec.transitions.iter().map(|item| item.name.as_str()).collect(), 0),
        };
        let known = names.contains(&name.value.as_str());
        if let Some(error) = other_anchor(spec, anchor).filter(|_| !known) {
            self.diagnostics.push(error);
            return None;
        }
        self.reference(kind, &name.value, name.span, &names).map(|i| first + i)
    }

    fn coordinates(&mut self, names: &[Text], has_state: Option<&[bool]>) -> Vec<usize> {
        let mut coordinates: Vec<usize> = Vec::new();
        for (n, name) in names.iter().enumerate() {
            let Some(state) = self.state_named(&name.value, name.span, "place among the coordinates of a section")
            else {
                continue;
            };
            if coordinates.contains(&state) {
                let first = names.iter().take(n).find(|first| first.value == name.value);
                let error = Diagnostic::error(Code::GivenTwice, format!("coordinate `{}` is given twice", name.value));
                let error = error.at(name.span, "").see(first.map_or(name.span, |first| first.span), "first time");
                self.diagnostics.push(error.help("remove one"));
                continue;
            }
            if has_state.is_some_and(|has| has.get(state) == Some(&false)) {
                let message = format!("the mode in which the section stands does not have the state `{}`", name.value);
                let error = Diagnostic::error(Code::SuperfluousEquation, message).at(name.span, "");
                self.diagnostics.push(error.help("remove it from the coordinates"));
            }
            coordinates.push(state);
        }
        coordinates
    }

    /// Each state on the section. A coordinate is itself.
    fn embed(&mut self, section: &spec::Section, coordinates: &[usize], has_state: Option<&[bool]>) -> Vec<NodeId> {
        let zero = self.model.graph.constant(0.0);
        let mut embed = vec![zero; self.model.states.len()];
        let mut given = vec![false; embed.len()];
        for &state in coordinates {
            embed[state] = self.model.graph.symbol(Symbol::State(state));
        }
        for equation in &section.embed {
            let state = self.state_of(equation, "embedding");
            let node = self.section_equation(equation, state, "embedding");
            if let Some(node) = node.filter(|_| self.whole_section) {
                self.only_coordinates(equation, node, coordinates);
            }
            let Some(state) = state else { continue };
            if coordinates.contains(&state) {
                let message = format!("`{}` is a coordinate of the section, so it needs no embedding", equation.name);
                let error = Diagnostic::error(Code::SuperfluousEquation, message).at(equation.span, "");
                self.diagnostics.push(error.help("remove the equation, or the coordinate"));
                continue;
            }
            if has_state.is_some_and(|has| has.get(state) == Some(&false)) {
                // It is 0 there: measures rely on it.
                let message =
                    format!("the mode in which the section stands does not have the state `{}`", equation.name);
                let error = Diagnostic::error(Code::SuperfluousEquation, message).at(equation.span, "");
                self.diagnostics.push(error.help("remove its embedding"));
                continue;
            }
            given[state] = true;
            embed[state] = node.unwrap_or(zero);
        }
        let has_state = has_state.filter(|_| self.whole_section).unwrap_or(&[]);
        for state in (0..has_state.len()).filter(|&i| has_state[i] && !given[i] && !coordinates.contains(&i)) {
            let name = self.state_name(state);
            let message = format!("the section does not say what the state `{name}` is on it");
            let error = Diagnostic::error(Code::MissingEquation, message).at(section.span, "");
            let help = format!("add `{name} = \"...\"` to [section.embed], or `\"{name}\"` to the coordinates");
            self.diagnostics.push(error.help(help));
        }
        embed
    }

    fn section_equation(&mut self, equation: &Named<Equation>, state: Option<usize>, what: &str) -> Option<NodeId> {
        let expected = Expected {
            dimension: state.and_then(|state| self.state_dimension(state)),
            what: format!("the {what} of `{}`", equation.name),
            help: "it gives the state's value, in the state's own unit".to_owned(),
        };
        self.checked(&equation.value, Place::Section, &expected).map(|value| value.node)
    }

    /// Reports an embedding that uses a state which is itself to be embedded.
    fn only_coordinates(&mut self, equation: &Named<Equation>, node: NodeId, coordinates: &[usize]) {
        let others = (0..self.model.states.len()).filter(|state| !coordinates.contains(state));
        let used = others.into_iter().find(|&i| self.model.graph.depends(&[node], |s| s == Symbol::State(i)));
        let Some(used) = used else { return };
        let name = self.state_name(used);
        let message =
            format!("the embedding of `{}` uses `{name}`, which is no coordinate of the section", equation.name);
        let error = Diagnostic::error(Code::NotAvailable, message).at(self.root_span(&equation.value), "");
        self.diagnostics.push(error.help("use coordinates and parameters only"));
    }

    /// The first guess of each coordinate.
    fn start(&mut self, section: &spec::Section, coordinates: &[usize]) -> Vec<f64> {
        let mut start = vec![None; coordinates.len()];
        for item in &section.start {
            let state = self.state_named(&item.name, item.span, "first guess");
            let dimension = state.and_then(|state| self.state_dimension(state));
            let mut quantities = Quantities { sources: self.sources, diagnostics: self.diagnostics };
            let value = match dimension {
                Some(dimension) => {
                    quantities.of(&item.value, dimension, &format!("the first guess of `{}`", item.name))
                }
                None => quantities.any(&item.value).map(|quantity| quantity.value),
            };
            let Some(state) = state else { continue };
            match coordinates.iter().position(|&coordinate| coordinate == state) {
                Some(i) => start[i] = Some(value.unwrap_or(0.0)),
                None if self.whole_section => self.no_coordinate(&item.name, item.span),
                None => {}
            }
        }
        for (&state, _) in coordinates.iter().zip(&start).filter(|(_, start)| start.is_none()) {
            let name = self.state_name(state);
            let error = Diagnostic::error(Code::MissingEquation, format!("coordinate `{name}` has no first guess"));
            let help = format!("add `{name} = \"...\"`, a quantity, to [section.start]");
            self.diagnostics.push(error.at(section.span, "").help(help));
        }
        start.into_iter().map(|value| value.unwrap_or(0.0)).collect()
    }

    fn no_coordinate(&mut self, name: &str, span: Span) {
        let message = format!("`{name}` is no coordinate of the section, so it needs no first guess");
        let error = Diagnostic::error(Code::SuperfluousEquation, message).at(span, "");
        self.diagnostics.push(error.help("remove it; [section.embed] says what it is"));
    }

    /// Image of each state; one that is not mentioned is its own image.
    fn symmetry(&mut self, equations: &[Named<Equation>]) -> Vec<NodeId> {
        let mut symmetry: Vec<NodeId> =
            (0..self.model.states.len()).map(|i| self.model.graph.symbol(Symbol::State(i))).collect();
        for equation in equations {
            let state = self.state_of(equation, "symmetry");
            let node = self.section_equation(equation, state, "symmetry");
            if let (Some(state), Some(node)) = (state, node) {
                symmetry[state] = node;
            }
        }
        symmetry
    }
}

/// What is to be said of a section after a surface, or on a transition.
fn other_anchor(spec: &Spec, anchor: &spec::Anchor) -> Option<Diagnostic> {
    let (name, on_surface) = (anchor.name(), matches!(anchor, spec::Anchor::At(_)));
    let (is, help) = if on_surface {
        spec.transitions.iter().find(|item| item.name == name.value)?;
        ("a transition, not a surface", format!("write `after = \"{0}\"` or `before = \"{0}\"`", name.value))
    } else {
        spec.surfaces.iter().find(|item| item.name == name.value)?;
        ("a surface, not a transition", format!("write `at = \"{}\"`", name.value))
    };
    let error = Diagnostic::error(Code::UnknownReference, format!("`{}` is {is}", name.value));
    Some(error.at(name.span, "").help(help))
}

/// What to do where a guard is not zero on the section that stands on it.
pub(super) fn advice_off_guard(model: &Model, section: &ir::Section, guard: NodeId) -> String {
    let has = model.transitions.get(section.transition).and_then(|transition| model.modes.get(transition.from));
    let has_state = has.map_or(&[][..], |mode| &mode.has_state);
    let all = (0..has_state.len()).all(|state| !has_state[state] || section.coordinates.contains(&state));
    let fixes = |state: &&usize| model.graph.depends(&[guard], |symbol| symbol == Symbol::State(**state));
    let fixed: Vec<String> = (section.coordinates.iter().filter(fixes))
        .filter_map(|&state| Some(format!("`{}`", model.states.get(state)?.name)))
        .collect();
    if !all || fixed.is_empty() {
        return "give each state by coordinates and parameters such that the guard vanishes, or make another state a \
                coordinate"
            .to_owned();
    }
    format!(
        "all states are coordinates, and the guard fixes one of them: take {} out of the coordinates, and let \
         [section.embed] say what it is where the guard is zero",
        fixed.join(" or ")
    )
}
