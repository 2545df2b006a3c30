//! Parameters, states and memory, and the namespace of everything that expressions can name.

use super::scope::{Definition, Entity, Scope};
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::names::{is_identifier, reserved};
use crate::front::parser::{parse_expression, shortened, unit_diagnostic};
use crate::front::quantity::Quantities;
use crate::front::spec::{Named, Parameter, Spec};
use crate::front::text::Text;
use crate::front::units::parse_unit;
use crate::ir::{self, Model};
use crate::source::{SourceMap, Span};

/// Fills the model's parameters, states and memory and returns the names of the spec.
pub(super) fn declare(spec: &Spec, model: &mut Model, sources: &SourceMap, diagnostics: &mut Vec<Diagnostic>) -> Scope {
    let mut scope = Scope::of_spec(spec.name.as_ref().map(|name| name.span.file));
    for (i, item) in spec.parameters.iter().enumerate() {
        let parameter = parameter(item, spec, &mut Quantities { sources, diagnostics });
        let dimension = parameter.as_ref().map(|parameter| parameter.dimension);
        let broken = || ir::Parameter { name: item.name.clone(), ..broken_parameter() };
        model.parameters.push(parameter.unwrap_or_else(broken));
        define(item, Entity::Parameter(i), dimension, &mut scope, diagnostics);
    }
    for (i, item) in spec.states.iter().enumerate() {
        let unit = item.value.unit.as_ref();
        let dimension = unit.and_then(|unit| self::unit(unit, diagnostics));
        model.states.push(ir::State {
            name: item.name.clone(),
            dimension: dimension.unwrap_or(Dimension::NONE),
            unit: unit.map_or(String::new(), |unit| unit.value.trim().to_owned()),
            doc: item.value.doc.clone(),
        });
        define(item, Entity::State(i), dimension, &mut scope, diagnostics);
    }
    for (i, item) in spec.memory.iter().enumerate() {
        let (name, doc) = (item.name.clone(), item.value.doc.clone());
        model.memory.push(ir::Memory { name, initial: item.value.initial, doc });
        define(item, Entity::Memory(i), Some(Dimension::NONE), &mut scope, diagnostics);
    }
    for (i, item) in spec.lets.iter().enumerate() {
        define(item, Entity::Let(i), None, &mut scope, diagnostics);
    }
    for (i, item) in spec.functions.iter().enumerate() {
        define(item, Entity::Function(i), None, &mut scope, diagnostics);
        arguments(&item.value.arguments, diagnostics);
    }
    for (i, item) in spec.measures.iter().enumerate() {
        let dimension = item.value.unit.as_ref().and_then(|unit| self::unit(unit, diagnostics));
        define(item, Entity::Measure(i), dimension, &mut scope, diagnostics);
    }
    let modes = spec.modes.iter().map(|item| (item.name.as_str(), item.span));
    let transitions = spec.transitions.iter().map(|item| (item.name.as_str(), item.span));
    let problems = spec.problems.iter().map(|item| (item.name.as_str(), item.span));
    let surfaces = spec.surfaces.iter().map(|item| (item.name.as_str(), item.span));
    for (name, span) in modes.chain(transitions).chain(surfaces).chain(problems) {
        valid(name, span, diagnostics);
    }
    scope
}

/// Defines a name, unless it is not valid, belongs to the language or is there already.
fn define<T>(
    item: &Named<T>,
    entity: Entity,
    dimension: Option<Dimension>,
    scope: &mut Scope,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let name = item.name.as_str();
    if !valid(name, item.span, diagnostics) || is_reserved(name, item.span, diagnostics) {
        return;
    }
    let definition = Definition { entity, span: Some(item.span), dimension };
    if let Some(first) = scope.insert(name, definition) {
        let message = format!("`{name}` is defined twice");
        let mut error = Diagnostic::error(Code::DefinedTwice, message).at(item.span, format!("as {}", entity.kind()));
        if let Some(span) = first.span {
            error = error.see(span, format!("as {}", first.entity.kind()));
        }
        let help = "parameters, states, memory, lets, functions and measures share their names: rename one";
        diagnostics.push(error.help(help));
    }
}

fn valid(name: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) -> bool {
    if is_identifier(name) {
        return true;
    }
    let message = format!("`{}` is not a valid name", shortened(name));
    let help = "a name has ASCII letters, digits and `_` and does not begin with a digit";
    diagnostics.push(Diagnostic::error(Code::InvalidName, message).at(span, "").help(help));
    false
}

fn is_reserved(name: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) -> bool {
    let Some(meaning) = reserved(name) else {
        return false;
    };
    let message = format!("`{name}` belongs to the language: it is {meaning}");
    diagnostics.push(Diagnostic::error(Code::ReservedName, message).at(span, "").help("choose another name"));
    true
}

/// Checks the names of a function's arguments.
fn arguments(arguments: &[Text], diagnostics: &mut Vec<Diagnostic>) {
    for (i, argument) in arguments.iter().enumerate() {
        let name = argument.value.as_str();
        if !valid(name, argument.span, diagnostics) || is_reserved(name, argument.span, diagnostics) {
            continue;
        }
        if let Some(first) = arguments.iter().take(i).find(|first| first.value == name) {
            let error = Diagnostic::error(Code::DefinedTwice, format!("two arguments are named `{name}`"));
            diagnostics.push(error.at(argument.span, "").see(first.span, "first one"));
        }
    }
}

/// The dimension of a unit.
fn unit(text: &Text, diagnostics: &mut Vec<Diagnostic>) -> Option<Dimension> {
    match parse_unit(&text.value) {
        Ok(unit) => Some(unit.dimension),
        Err(error) => {
            diagnostics.push(*unit_diagnostic(error, text, 0));
            None
        }
    }
}

fn broken_parameter() -> ir::Parameter {
    let (name, unit, doc) = (String::new(), String::new(), String::new());
    ir::Parameter { name, dimension: Dimension::NONE, value: 0.0, unit, range: None, doc }
}

/// Where the value of a parameter is an expression of other names, says once what to make of it; `said` is what was said
/// of the value.
fn point_to_let(item: &Named<Parameter>, text: &Text, sources: &SourceMap, spec: &Spec, said: &mut Vec<Diagnostic>) {
    let mut first = true;
    said.retain(|error| error.code != Code::NotConstant || std::mem::take(&mut first));
    let Some(error) = said.iter_mut().find(|error| error.code == Code::NotConstant) else { return };
    // In `50*cm` the name was meant as a unit.
    let used = error.primary().map_or("", |span| sources.slice(span));
    if parse_unit(used).is_ok() && !is_defined(spec, used) {
        return;
    }
    let (name, written) = (shortened(&item.name), shortened(&text.value));
    let help = if item.value.replaced.is_some() {
        format!("`set` takes quantities only; an expression in the place of `{name}` stands in `fix`")
    } else if parse_expression(text).is_ok() {
        format!("what other names give is no parameter: move it to [let], as `{name} = \"{written}\"`")
    } else {
        "what other names give is no parameter: move it to [let], without the unit at the end".to_owned()
    };
    error.help = Some(help);
}

/// Whether an expression can use a name.
fn is_defined(spec: &Spec, name: &str) -> bool {
    let parameters = spec.parameters.iter().map(|item| &item.name);
    let states = spec.states.iter().map(|item| &item.name);
    let memory = spec.memory.iter().map(|item| &item.name);
    let lets = spec.lets.iter().map(|item| &item.name);
    parameters.chain(states).chain(memory).chain(lets).any(|other| other == name)
}

/// Value and range of a parameter; `None` when its dimension is not known.
fn parameter(item: &Named<Parameter>, spec: &Spec, quantities: &mut Quantities<'_>) -> Option<ir::Parameter> {
    let Parameter { value, range, doc, replaced } = &item.value;
    let value_span = value.as_ref().map_or(item.span, |value| value.span);
    let value = value.as_ref().and_then(|text| {
        let mut said = Vec::new();
        let value = Quantities { sources: quantities.sources, diagnostics: &mut said }.any(text);
        point_to_let(item, text, quantities.sources, spec, &mut said);
        quantities.diagnostics.append(&mut said);
        value
    });
    let bounds =
        range.as_ref().map(|range| [&range.lower, &range.upper].map(|bound| (quantities.any(bound), bound.span)));
    let default = replaced.as_ref().map(|text| quantities.any(text));
    let value = value?;
    let default = if let Some(default) = default { Some(default?) } else { None };
    // A bare 0 has the dimension of the value in the part, or of the bounds, if there are any.
    let others = default.iter().chain(bounds.iter().flatten().filter_map(|(bound, _)| bound.as_ref()));
    let known = std::iter::once(&value).chain(others).find_map(|quantity| Some((quantity.dimension?, &quantity.unit)));
    let (dimension, unit) =
        known.map_or((Dimension::NONE, String::new()), |(dimension, unit)| (dimension, unit.clone()));
    let what = format!("`{}`", item.name);
    if let Some(expected) = default.and_then(|default| default.dimension) {
        quantities.check(&value, value_span, expected, &format!("the value of {what}"))?;
    }
    let interval_span = range.as_ref().map_or(item.span, |range| range.span);
    let range = range.as_ref().zip(bounds).and_then(|(range, [(lower, lower_span), (upper, upper_span)])| {
        let (lower, upper) = (lower?, upper?);
        let low = quantities.check(&lower, lower_span, dimension, &format!("the lower bound of {what}"));
        let high = quantities.check(&upper, upper_span, dimension, &format!("the upper bound of {what}"));
        low.and(high)?;
        quantities.ordered(lower.value, upper.value, range.span, &what)
    });
    if let Some((lower, upper)) = range.filter(|(lower, upper)| !(*lower..=*upper).contains(&value.value)) {
        let shown = |value| crate::front::format_quantity(value, &unit);
        let message = format!("the value of {what} lies outside its range");
        let label = format!("not within {} and {}", shown(lower), shown(upper));
        let error = Diagnostic::error(Code::Range, message).at(value_span, label).see(interval_span, "the range");
        quantities.diagnostics.push(error.help("change the value or widen the range"));
    }
    let (name, doc) = (item.name.clone(), doc.clone());
    Some(ir::Parameter { name, dimension, value: value.value, unit, range, doc })
}
