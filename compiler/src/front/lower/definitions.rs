//! The definitions that expressions refer to, `[let]` and `[functions]`: their order, and lowering on demand.

use super::lowering::{Context, Lowering};
use super::order::{Order, order};
use super::scope::{Entity, Scope};
use super::value::{Place, Style, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::front::names::{FUNCTIONALS, FUNCTIONS, reserved, suggest};
use crate::front::spec::{Equation, Function, Named, Parameter, Spec};
use crate::front::syntax::NameUse;
use crate::source::Span;
use std::collections::{HashMap, HashSet};

/// The names of `[let]` lowered so far, by index and style; a broken one is `None`.
pub(super) type Lets = HashMap<(usize, Style), Option<Value>>;

/// The definitions of a spec. Items are the lets, then the functions.
#[derive(Default)]
pub(crate) struct Definitions<'a> {
    pub(super) lets: &'a [Named<Equation>],
    pub(super) functions: &'a [Named<Function>],
    /// Parameters of parts whose place a let has taken.
    pub(super) fixed: &'a [Named<Parameter>],
    order: Order,
}

impl<'a> Definitions<'a> {
    /// Orders the definitions; reports those that need each other.
    pub(crate) fn new(spec: &'a Spec, scope: &Scope, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let (lets, functions, fixed) = (&spec.lets, &spec.functions, &spec.fixed);
        let mut definitions = Self { lets, functions, fixed, order: Order::default() };
        let count = definitions.lets.len() + definitions.functions.len();
        let uses: Vec<Vec<usize>> = (0..count)
            .map(|item| definitions.names(item).filter_map(|name| definitions.item(scope, &name.name)).collect())
            .collect();
        definitions.order = order(&uses);
        for cycle in &definitions.order.cycles {
            let members: Vec<_> = cycle.iter().map(|&item| definitions.named(item)).collect();
            diagnostics.extend(cycle_diagnostic(&members));
        }
        definitions
    }

    /// The item that a name stands for.
    fn item(&self, scope: &Scope, name: &str) -> Option<usize> {
        match scope.get(name)?.entity {
            Entity::Let(i) => Some(i),
            Entity::Function(i) => Some(self.lets.len() + i),
            _ => None,
        }
    }

    /// Name and place of an item.
    fn named(&self, item: usize) -> (&'a str, Option<Span>) {
        let named = self.lets.get(item).map(|item| (item.name.as_str(), item.span));
        let function = || self.functions.get(item - self.lets.len()).map(|item| (item.name.as_str(), item.span));
        named.or_else(function).map_or(("", None), |(name, span)| (name, Some(span)))
    }

    /// The names that an item's expression refers to, a function's arguments left out.
    fn names(&self, item: usize) -> impl Iterator<Item = &'a NameUse> + use<'a> {
        let function = item.checked_sub(self.lets.len()).and_then(|i| self.functions.get(i)).map(|item| &item.value);
        let equation = self.lets.get(item).map(|item| &item.value);
        let equation = equation.or(function.and_then(|function| function.body.as_ref()));
        let arguments = function.map_or(&[][..], |function| &function.arguments);
        let names = equation.and_then(|equation| equation.expression.as_ref()).map_or(&[][..], |e| &e.names);
        names.iter().filter(move |name| !arguments.iter().any(|argument| argument.value == name.name))
    }

    /// Whether a function needs itself.
    pub(super) fn function_is_cyclic(&self, function: usize) -> bool {
        self.order.cyclic.get(self.lets.len() + function).copied().unwrap_or(false)
    }

    /// Reports names in functions' bodies that are not defined: a function that is never called is not lowered.
    pub(crate) fn check_function_names(&self, scope: &Scope, diagnostics: &mut Vec<Diagnostic>) {
        for i in 0..self.functions.len() {
            for name in self.names(self.lets.len() + i).filter(|name| reserved(&name.name).is_none()) {
                if scope.get(&name.name).is_none() {
                    let message = if name.called { undefined_function } else { undefined };
                    diagnostics.push(message(&name.name, name.span, scope));
                }
            }
        }
    }
}

impl Lowering<'_> {
    /// Lowers every name of `[let]` that these names need and that is not lowered yet, in an order that needs no
    /// recursion from one to the next.
    pub(super) fn lower_lets(&mut self, names: &[NameUse], place: Place) {
        let style = |name: &NameUse, outer| {
            if name.in_functional { Style::Frozen } else { outer }
        };
        let definitions = self.definitions;
        let mut found: HashSet<(usize, Style)> = HashSet::new();
        let item = |name: &NameUse| definitions.item(self.scope, &name.name);
        let mut open: Vec<(usize, Style)> =
            names.iter().filter_map(|name| Some((item(name)?, style(name, place.style())))).collect();
        while let Some((item_index, outer)) = open.pop() {
            if self.lets.contains_key(&(item_index, outer)) || !found.insert((item_index, outer)) {
                continue;
            }
            open.extend(definitions.names(item_index).filter_map(|name| Some((item(name)?, style(name, outer)))));
        }
        let mut wanted: Vec<(usize, Style)> =
            found.into_iter().filter(|(item, _)| *item < definitions.lets.len()).collect();
        wanted.sort_by_key(|&(item, style)| (definitions.order.rank.get(item).copied(), style == Style::Immediate));
        for (item, style) in wanted {
            let cyclic = definitions.order.cyclic.get(item).copied().unwrap_or(false);
            let expression = definitions.lets.get(item).and_then(|item| item.value.expression.as_ref());
            let expression = expression.filter(|_| !cyclic);
            let value = expression.and_then(|e| self.expr(&e.root, Context::of(Place::Let(style))));
            let value = value.filter(|&value| self.fits(item, value));
            self.lets.insert((item, style), value);
        }
    }

    /// What has been lowered of `[let]`.
    pub(crate) fn into_lets(self) -> Lets {
        self.lets
    }

    /// Lowers, for its messages only, every name of `[let]` that is not in `done`.
    pub(crate) fn lower_remaining_lets(&mut self, done: Lets) {
        self.lets = done;
        for (i, item) in self.definitions.lets.iter().enumerate() {
            if !self.lets.contains_key(&(i, Style::Frozen)) && !self.lets.contains_key(&(i, Style::Immediate)) {
                let name = NameUse { name: item.name.clone(), span: item.span, called: false, in_functional: true };
                self.lower_lets(&[name], Place::Functional);
            }
        }
    }
}

/// Why definitions that need each other are no definitions; `members` in the order of use.
pub(super) fn cycle_diagnostic(members: &[(&str, Option<Span>)]) -> Option<Diagnostic> {
    // A long cycle is told by its beginning.
    const TOLD: usize = 8;
    let (first, span) = members.first()?;
    let mut path: Vec<String> = members.iter().take(TOLD).map(|(name, _)| format!("`{name}`")).collect();
    if members.len() > TOLD {
        path.push("...".to_owned());
    }
    path.push(format!("`{first}`"));
    let message = match members.len() {
        1 => format!("`{first}` needs itself"),
        _ => format!("definitions need each other: {}", path.join(" -> ")),
    };
    let mut diagnostic = Diagnostic::error(Code::Cycle, message).at((*span)?, "");
    for (_, span) in members.iter().skip(1).take(TOLD) {
        diagnostic = diagnostic.see((*span)?, "");
    }
    Some(diagnostic.help("definitions are equations without time: a value that depends on its own past is a state"))
}

/// The message for a function that is not defined.
pub(super) fn undefined_function(name: &str, span: Span, scope: &Scope) -> Diagnostic {
    let diagnostic = Diagnostic::error(Code::UndefinedFunction, format!("undefined function `{name}`")).at(span, "");
    let words = FUNCTIONS.iter().map(|(name, _)| *name).chain(FUNCTIONALS.iter().copied());
    let near = suggest(name, words).or_else(|| scope.suggest(name, |entity| matches!(entity, Entity::Function(_))));
    diagnostic.help(match (name, near) {
        ("ln", _) => "did you mean `log`, the natural logarithm?".to_owned(),
        ("pow", _) => "write a power as `x^2`".to_owned(),
        ("der" | "diff", _) => "did you mean `d(expr, x)`?".to_owned(),
        (_, Some(near)) => format!("did you mean `{near}`?"),
        (name, None) => format!("define `{name}` in [functions]"),
    })
}

/// The message for a name that is not defined.
pub(super) fn undefined(name: &str, span: Span, scope: &Scope) -> Diagnostic {
    let diagnostic = Diagnostic::error(Code::UndefinedName, format!("undefined name `{name}`")).at(span, "");
    let near = scope.suggest(name, |entity| !matches!(entity, Entity::Function(_)));
    let words = || suggest(name, ["pi", "tau", "duration", "spectral_radius"]);
    match near.or_else(words) {
        near if scope.in_part(span) => {
            let near = near.map_or(String::new(), |near| format!("; or did the part mean `{near}`?"));
            let take = format!("a part takes from its user what it does not define: define `{name}` in the spec, or ");
            diagnostic.help(format!("{take}`rename` it to what it is called there{near}"))
        }
        Some(near) => diagnostic.help(format!("did you mean `{near}`?")),
        None if scope.is_of_flag() => diagnostic.help("take a name that the model has: `gaitc show MODEL` lists them"),
        None => diagnostic.help(format!("define `{name}` in [parameters], [state], [memory] or [let]")),
    }
}
