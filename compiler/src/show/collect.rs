//! From a spec as it was written, joined with its parts, to the content of a page. Lets and functions stay what they
//! are named; those that nothing in the model needs are left out.

use super::drawn::{Drawing, DrawnPoint, Published};
use super::latex::{Latex, rate};
use super::level::Level;
use super::plain::Plain;
use super::sheet::{
    Assignment, Definition, Equation, Formula, Measure, Memory, Mode, Name, Parameter, Problem, Section, Sheet, Start,
    State, Surface, Transition, Vary,
};
use super::symbol::Symbols;
use super::used::used;
use crate::front::quantity::{Quantities, Quantity};
use crate::front::spec::{self, Anchor, Interval, MassRow, Named, Spec};
use crate::front::syntax::ExprKind;
use crate::front::text::Text;
use crate::front::{Parsed, format_quantity};
use crate::ir::{Direction, Model, Sense};
use crate::source::{FileId, SourceMap, Span};
use std::path::Path;

impl Sheet {
    /// The content of a spec that was read without errors; `None` for one with errors.
    pub fn new(parsed: &Parsed) -> Option<Self> {
        let (spec, model) = (parsed.spec.as_ref()?, parsed.model.as_ref()?);
        let names = spec.parameters.iter().map(|item| &item.name).chain(spec.states.iter().map(|item| &item.name));
        let names = names.chain(spec.memory.iter().map(|item| &item.name));
        let names = names.chain(spec.lets.iter().map(|item| &item.name));
        let names = names.chain(spec.functions.iter().map(|item| &item.name));
        let names = names.chain(spec.measures.iter().map(|item| &item.name));
        let symbols = Symbols::new(names.map(String::as_str));
        let collector = Collector { sources: &parsed.sources, symbols: &symbols, file: spec.name.as_ref()?.span.file };
        Some(collector.sheet(spec, model))
    }
}

struct Collector<'a> {
    sources: &'a SourceMap,
    symbols: &'a Symbols,
    /// The spec; other files are parts.
    file: FileId,
}

impl Collector<'_> {
    fn sheet(&self, spec: &Spec, model: &Model) -> Sheet {
        let state = |item: &Named<spec::State>| State {
            name: self.name(&item.name),
            unit: unit(item.value.unit.as_ref()),
            modes: item.value.modes.as_ref().map(|modes| modes.iter().map(|mode| mode.value.clone()).collect()),
            doc: item.value.doc.clone(),
        };
        let memory = |item: &Named<spec::Memory>| Memory {
            name: self.name(&item.name),
            initial: item.value.initial,
            doc: item.value.doc.clone(),
        };
        let measure = |item: &Named<spec::Measure>| Measure {
            name: self.name(&item.name),
            formula: self.optional(item.value.expr.as_ref()),
            unit: unit(item.value.unit.as_ref()),
            doc: item.value.doc.clone(),
        };
        Sheet {
            model: model.name.clone(),
            title: spec.title.clone(),
            source: spec.source.clone(),
            parameters: self.parameters(spec, model),
            states: spec.states.iter().map(state).collect(),
            memory: spec.memory.iter().map(memory).collect(),
            definitions: self.definitions(spec),
            modes: spec.modes.iter().map(|item| self.mode(item)).collect(),
            transitions: spec.transitions.iter().map(|item| self.transition(item)).collect(),
            surfaces: spec.surfaces.iter().map(|item| self.surface(item)).collect(),
            section: spec.section.as_ref().map(|section| self.section(section)),
            measures: spec.measures.iter().map(measure).collect(),
            problems: spec.problems.iter().map(|item| self.problem(item)).collect(),
            drawing: spec.drawing.as_ref().map(|drawing| self.drawing(drawing)),
            published: spec.published.iter().map(|item| self.published(item)).collect(),
        }
    }

    fn name(&self, name: &str) -> Name {
        let symbol = self.symbols.get(name);
        Name { name: name.to_owned(), latex: symbol.latex(), text: symbol.text }
    }

    fn plain(&self) -> Plain<'_> {
        Plain { symbols: self.symbols, sources: self.sources }
    }

    fn latex(&self) -> Latex<'_> {
        Latex { symbols: self.symbols, sources: self.sources, inline: false }
    }

    fn formula(&self, equation: &spec::Equation) -> Formula {
        let source = equation.text.value.trim().to_owned();
        let Some(expression) = &equation.expression else {
            return Formula { source, latex: String::new(), text: String::new(), terms: Vec::new() };
        };
        let (text, latex) = (self.plain().formula(&expression.root), self.latex().formula(&expression.root));
        Formula { source, latex, text, terms: self.latex().terms(&expression.root) }
    }

    /// What a spec without errors has.
    fn optional(&self, equation: Option<&spec::Equation>) -> Formula {
        let none = || Formula { source: String::new(), latex: String::new(), text: String::new(), terms: Vec::new() };
        equation.map_or_else(none, |equation| self.formula(equation))
    }

    fn assignment(&self, item: &Named<spec::Equation>) -> Assignment {
        Assignment { left: self.name(&item.name), right: self.formula(&item.value) }
    }

    fn assignments(&self, items: &[Named<spec::Equation>]) -> Vec<Assignment> {
        items.iter().map(|item| self.assignment(item)).collect()
    }

    /// The part that a place is in, seen from the folder of the spec.
    fn part(&self, span: Span) -> Option<String> {
        let folder = self.sources.path(self.file).parent().unwrap_or(Path::new(""));
        let path = self.sources.path(span.file);
        let below = path.strip_prefix(folder).unwrap_or(path);
        (span.file != self.file).then(|| below.to_string_lossy().replace('\\', "/"))
    }

    fn parameters(&self, spec: &Spec, model: &Model) -> Vec<Parameter> {
        let both = spec.parameters.iter().zip(&model.parameters);
        let one = |(item, parameter): (&Named<spec::Parameter>, &crate::ir::Parameter)| {
            // Where the user of a part has set another value, the part is where the first one stands.
            let value = item.value.replaced.as_ref().or(item.value.value.as_ref());
            Parameter {
                name: self.name(&parameter.name),
                value: parameter.value,
                unit: parameter.unit.clone(),
                range: parameter.range,
                doc: parameter.doc.clone(),
                part: self.part(value.map_or(item.span, |value| value.span)),
            }
        };
        both.map(one).collect()
    }

    /// Lets and functions that are used, each file's in its order.
    fn definitions(&self, spec: &Spec) -> Vec<Definition> {
        let used = used(spec);
        let lets = spec.lets.iter().filter(|item| used.contains(item.name.as_str())).map(|item| {
            let (name, formula) = (self.name(&item.name), self.formula(&item.value));
            let span = item.value.text.span;
            (span, Definition { name, arguments: Vec::new(), formula, doc: String::new(), part: self.part(span) })
        });
        let functions = spec.functions.iter().filter(|item| used.contains(item.name.as_str())).map(|item| {
            let span = item.value.body.as_ref().map_or(item.span, |body| body.text.span);
            let definition = Definition {
                name: self.name(&item.name),
                arguments: item.value.arguments.iter().map(|argument| self.name(&argument.value)).collect(),
                formula: self.optional(item.value.body.as_ref()),
                doc: item.value.doc.clone(),
                part: self.part(span),
            };
            (span, definition)
        });
        let mut all: Vec<(Span, Definition)> = lets.chain(functions).collect();
        all.sort_by_key(|(span, _)| *span);
        all.into_iter().map(|(_, definition)| definition).collect()
    }

    fn mode(&self, item: &Named<spec::Mode>) -> Mode {
        let mass = |state: &str| item.value.mass.iter().find(|row| row.name == state).map(|row| &row.value);
        let equations = item.value.flow.iter().map(|flow| self.equation(flow, mass(&flow.name))).collect();
        Mode { name: item.name.clone(), doc: item.value.doc.clone(), equations }
    }

    fn equation(&self, flow: &Named<spec::Equation>, mass: Option<&MassRow>) -> Equation {
        let entries: Vec<(&str, &spec::Equation)> = match mass {
            None => Vec::new(),
            Some(MassRow::Factor(factor)) => vec![(flow.name.as_str(), factor)],
            Some(MassRow::Entries(entries)) => {
                entries.iter().map(|entry| (entry.name.as_str(), &entry.value)).collect()
            }
        };
        let (text, latex): (Vec<String>, Vec<String>) = match entries.as_slice() {
            [] => (vec![self.rate_text(&flow.name)], vec![self.rate_latex(&flow.name)]),
            entries => entries.iter().map(|(state, entry)| self.entry(state, entry)).unzip(),
        };
        let assignment = |&(state, entry): &(&str, &spec::Equation)| Assignment {
            left: self.name(state),
            right: self.formula(entry),
        };
        Equation {
            state: self.name(&flow.name),
            mass: entries.iter().map(assignment).collect(),
            flow: self.formula(&flow.value),
            left_text: text.join(" + "),
            left_latex: latex.join(" + "),
        }
    }

    fn rate_text(&self, state: &str) -> String {
        format!("d{}/dt", self.symbols.get(state).text)
    }

    fn rate_latex(&self, state: &str) -> String {
        let symbol = self.symbols.get(state);
        symbol.dotted().unwrap_or_else(|| rate(&symbol.latex()))
    }

    /// An entry of a mass matrix times the rate that it multiplies.
    fn entry(&self, state: &str, entry: &spec::Equation) -> (String, String) {
        let (text, latex) = (self.rate_text(state), self.rate_latex(state));
        match entry.expression.as_ref().map(|expression| &expression.root) {
            Some(root) if !matches!(root.kind, ExprKind::Number(1.0, None)) => (
                format!("{} {text}", self.plain().at(root, Level::Product)),
                format!("{}\\,{latex}", self.latex().at(root, Level::Product)),
            ),
            _ => (text, latex),
        }
    }

    fn transition(&self, item: &Named<spec::Transition>) -> Transition {
        let text = |text: Option<&Text>| text.map_or(String::new(), |text| text.value.clone());
        let zero = item.value.also_zero.iter().flat_map(|(_, equations)| equations);
        Transition {
            name: item.name.clone(),
            from: text(item.value.from.as_ref()),
            to: text(item.value.to.as_ref()),
            guard: self.optional(item.value.guard.as_ref()),
            direction: direction(item.value.direction),
            when: item.value.when.as_ref().map(|when| self.formula(when)),
            also_zero: zero.map(|equation| self.formula(equation)).collect(),
            reset: self.assignments(&item.value.reset),
            doc: item.value.doc.clone(),
        }
    }

    fn surface(&self, item: &Named<spec::Surface>) -> Surface {
        Surface {
            name: item.name.clone(),
            mode: item.value.mode.as_ref().map_or(String::new(), |mode| mode.value.clone()),
            guard: self.optional(item.value.guard.as_ref()),
            direction: direction(item.value.direction),
            doc: item.value.doc.clone(),
        }
    }

    fn section(&self, section: &spec::Section) -> Section {
        Section {
            side: match section.anchor {
                Some(Anchor::Before(_)) => "before",
                Some(Anchor::At(_)) => "at",
                Some(Anchor::After(_)) | None => "after",
            },
            of: section.anchor.as_ref().map_or(String::new(), |anchor| anchor.name().value.clone()),
            coordinates: section.coordinates.iter().flatten().map(|name| self.name(&name.value)).collect(),
            embed: self.assignments(&section.embed),
            start: self.quantities(&section.start),
            symmetry: section.symmetry.as_ref().map(|symmetry| self.assignments(symmetry)),
        }
    }

    /// Quantities of something named.
    fn quantities(&self, items: &[Named<Text>]) -> Vec<Start> {
        let start = |item: &Named<Text>| {
            let quantity = self.quantity(&item.value);
            let shown = format_quantity(quantity.value, &quantity.unit);
            Start { name: self.name(&item.name), value: quantity.value, shown }
        };
        items.iter().map(start).collect()
    }

    fn drawing(&self, drawing: &spec::Drawing) -> Drawing {
        let pair = |pair: &[spec::Equation; 2]| pair.each_ref().map(|equation| self.formula(equation));
        let names = |names: &[Text]| names.iter().map(|name| name.value.clone()).collect();
        let point = |item: &Named<spec::DrawnPoint>| {
            let at = item.value.at.as_ref().map(pair)?;
            let modes = item.value.modes.as_deref().map(names);
            Some(DrawnPoint { name: item.name.clone(), at, modes, held: item.value.held, doc: item.value.doc.clone() })
        };
        let panel = |curves: &Vec<spec::Equation>| curves.iter().map(|curve| self.formula(curve)).collect();
        Drawing {
            velocity: drawing.velocity.as_ref().map(pair),
            points: drawing.points.iter().filter_map(point).collect(),
            links: drawing.links.iter().map(|ends| ends.each_ref().map(|end| end.value.clone())).collect(),
            panels: drawing.panels.iter().map(panel).collect(),
        }
    }

    fn published(&self, item: &Named<spec::Published>) -> Published {
        let spec::Published { doc, source, set, start, measures, section, spread } = &item.value;
        Published {
            name: item.name.clone(),
            doc: doc.clone(),
            source: source.as_ref().map_or(String::new(), |source| source.value.clone()),
            set: self.quantities(set),
            start: self.quantities(start),
            measures: self.quantities(measures),
            section: self.quantities(section),
            spread: self.quantities(spread),
        }
    }

    fn problem(&self, item: &Named<spec::Problem>) -> Problem {
        let objective = item.value.objective.as_ref();
        Problem {
            name: item.name.clone(),
            doc: item.value.doc.clone(),
            default: item.value.default.is_some(),
            sense: match objective {
                Some((Sense::Minimize, _)) => "minimize",
                _ => "maximize",
            },
            objective: self.optional(objective.map(|(_, equation)| equation)),
            vary: item.value.vary.iter().map(|item| self.vary(item)).collect(),
            robust: item.value.robust.iter().map(|item| self.vary(item)).collect(),
            subject_to: item.value.subject_to.iter().map(|equation| self.formula(equation)).collect(),
            period: item.value.period,
        }
    }

    fn vary(&self, item: &Named<Interval>) -> Vary {
        let (lower, upper) = (self.quantity(&item.value.lower), self.quantity(&item.value.upper));
        let shown = |quantity: &Quantity| format_quantity(quantity.value, &quantity.unit);
        let (name, shown) = (self.name(&item.name), (shown(&lower), shown(&upper)));
        Vary { name, range: (lower.value, upper.value), shown }
    }

    /// A quantity, which has been read without errors before.
    fn quantity(&self, text: &Text) -> Quantity {
        let mut quantities = Quantities { sources: self.sources, diagnostics: &mut Vec::new() };
        quantities.any(text).unwrap_or(Quantity { value: f64::NAN, dimension: None, unit: String::new() })
    }
}

fn unit(text: Option<&Text>) -> String {
    text.map_or(String::new(), |unit| unit.value.trim().to_owned())
}

/// How a guard passes through zero, as the spec says it.
fn direction(direction: Option<Direction>) -> &'static str {
    match direction {
        Some(Direction::Falling) => "falling",
        Some(Direction::Rising) => "rising",
        Some(Direction::Either) | None => "either",
    }
}
