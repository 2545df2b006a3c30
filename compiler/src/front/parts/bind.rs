//! What the user of a part says of it: other names (`rename`), other values of its parameters (`set`), and expressions
//! in the place of its parameters (`fix`).

use crate::diagnostic::{Code, Diagnostic};
use crate::front::lexer::{TokenKind, tokens};
use crate::front::names::{is_identifier, reserved, suggest};
use crate::front::parser::shortened;
use crate::front::spec::{Drawing, Equation, MassRow, Named, Spec, Use};
use crate::front::syntax::{Expr, ExprKind, Expression};
use crate::front::text::Text;
use crate::source::Span;
use std::collections::HashMap;

/// Binds a part, all that it uses included.
pub(super) fn bind(part: &mut Spec, item: &Use, diagnostics: &mut Vec<Diagnostic>) {
    let mut bound: HashMap<&str, Span> = HashMap::new();
    for (name, span) in
        item.set.iter().map(|set| (&set.name, set.span)).chain(item.fix.iter().map(|f| (&f.name, f.span)))
    {
        if let Some(first) = bound.insert(name, span) {
            let error = Diagnostic::error(Code::GivenTwice, format!("`{name}` is both set and fixed")).at(span, "");
            diagnostics.push(
                error
                    .see(first, "set here")
                    .help("`set` gives a parameter another value, `fix` makes it no parameter: keep one"),
            );
        }
    }
    for set in &item.set {
        if let Some(at) = parameter(part, &set.name, set.span, item, diagnostics) {
            let parameter = &mut part.parameters[at].value;
            let replaced = parameter.value.replace(set.value.clone());
            // Of several values, from parts of parts, the first one is the definition.
            parameter.replaced = parameter.replaced.take().or(replaced);
        }
    }
    // What takes the place of a parameter belongs to the user, whose names are not renamed.
    let mut fixed = Vec::new();
    for fix in &item.fix {
        if let Some(at) = parameter(part, &fix.name, fix.span, item, diagnostics) {
            fixed.push((part.parameters.remove(at), fix));
        }
    }
    let renaming = Renaming::new(part, item, &fixed, diagnostics);
    renaming.spec(part);
    for (mut parameter, fix) in fixed {
        renaming.named(&mut parameter);
        parameter.span = fix.span;
        part.lets.push(Named { name: parameter.name.clone(), span: fix.span, value: fix.value.clone() });
        part.fixed.push(parameter);
    }
}

/// The index of a parameter of the part.
fn parameter(part: &Spec, name: &str, span: Span, item: &Use, diagnostics: &mut Vec<Diagnostic>) -> Option<usize> {
    let at = part.parameters.iter().position(|parameter| parameter.name == name);
    if at.is_none() {
        let message = format!("the part `{}` has no parameter `{}`", shortened(&item.part.value), shortened(name));
        let names = part.parameters.iter().map(|parameter| parameter.name.as_str());
        let error = Diagnostic::error(Code::PartUse, message).at(span, "");
        diagnostics.push(error.help(match suggest(name, names.clone()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("its parameters are {}", crate::front::read::list(&names.collect::<Vec<_>>())),
        }));
    }
    at
}

/// New names by old ones, all at once: two names can be exchanged.
struct Renaming<'a> {
    names: HashMap<&'a str, &'a Text>,
}

impl<'a> Renaming<'a> {
    fn new<T>(
        part: &Spec,
        item: &'a Use,
        fixed: &[(Named<T>, &Named<Equation>)],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut names = HashMap::new();
        if item.rename.is_empty() {
            return Self { names };
        }
        let known = vocabulary(part, fixed.iter().map(|(parameter, _)| parameter.name.as_str()));
        for rename in &item.rename {
            if let Some(error) = refused(rename, &known, item) {
                diagnostics.push(error);
                continue;
            }
            names.insert(rename.name.as_str(), &rename.value);
        }
        Self { names }
    }

    /// Renames everything in a part.
    fn spec(&self, part: &mut Spec) {
        if self.names.is_empty() {
            return;
        }
        part.parameters.iter_mut().for_each(|item| self.named(item));
        part.states.iter_mut().for_each(|item| self.named(item));
        part.memory.iter_mut().for_each(|item| self.named(item));
        part.fixed.iter_mut().for_each(|item| self.named(item));
        part.lets.iter_mut().for_each(|item| self.assignment(item));
        for item in &mut part.functions {
            self.named(item);
            let arguments = &item.value.arguments;
            if let Some(body) = &mut item.value.body {
                self.equation(body, arguments);
            }
        }
        for mode in &mut part.modes {
            mode.value.flow.iter_mut().for_each(|item| self.assignment(item));
            for row in &mut mode.value.mass {
                self.named(row);
                match &mut row.value {
                    MassRow::Factor(equation) => self.equation(equation, &[]),
                    MassRow::Entries(entries) => entries.iter_mut().for_each(|item| self.assignment(item)),
                }
            }
        }
        for measure in &mut part.measures {
            self.named(measure);
            measure.value.expr.iter_mut().for_each(|equation| self.equation(equation, &[]));
        }
        for problem in part.problems.iter_mut().map(|item| &mut item.value) {
            problem.vary.iter_mut().chain(&mut problem.robust).for_each(|item| self.named(item));
            problem.objective.iter_mut().for_each(|(_, equation)| self.equation(equation, &[]));
            problem.subject_to.iter_mut().for_each(|equation| self.equation(equation, &[]));
        }
        let drawn = part.drawing.iter_mut().flat_map(Drawing::equations_mut);
        drawn.for_each(|equation| self.equation(equation, &[]));
        let published = part.published.iter_mut().flat_map(|item| item.value.quantities_mut());
        published.for_each(|item| self.named(item));
    }

    /// Renames a definition; its place is then where the new name stands.
    fn named<T>(&self, item: &mut Named<T>) {
        if let Some(name) = self.names.get(item.name.as_str()) {
            item.name.clone_from(&name.value);
            item.span = name.span;
        }
    }

    fn assignment(&self, item: &mut Named<Equation>) {
        self.named(item);
        self.equation(&mut item.value, &[]);
    }

    /// The new name of one that is no argument of the function at hand.
    fn of(&self, name: &str, arguments: &[Text]) -> Option<&str> {
        let new = self.names.get(name).filter(|_| !arguments.iter().any(|argument| argument.value == name));
        new.map(|text| text.value.as_str())
    }

    fn equation(&self, equation: &mut Equation, arguments: &[Text]) {
        let Some(expression) = &mut equation.expression else { return };
        equation.text.value = self.text(&equation.text.value, expression, arguments);
        for item in &mut expression.names {
            if let Some(new) = self.of(&item.name, arguments) {
                item.name = new.to_owned();
            }
        }
        self.tree(&mut expression.root, arguments);
    }

    /// The depth of a tree is bounded by the parser.
    fn tree(&self, expr: &mut Expr, arguments: &[Text]) {
        match &mut expr.kind {
            ExprKind::Number(..) => {}
            ExprKind::Name(name) => {
                if let Some(new) = self.of(name, arguments) {
                    *name = new.to_owned();
                }
            }
            ExprKind::Neg(a) | ExprKind::Not(a) => self.tree(a, arguments),
            ExprKind::Arithmetic(_, a, b) | ExprKind::Compare(_, a, b) | ExprKind::Logic(_, a, b) => {
                self.tree(a, arguments);
                self.tree(b, arguments);
            }
            ExprKind::Call(call) => {
                if let Some(new) = self.of(&call.name, arguments) {
                    call.name = new.to_owned();
                }
                call.arguments.iter_mut().for_each(|argument| self.tree(argument, arguments));
            }
        }
    }

    /// The text of an expression as people get to see it, e.g. that of a constraint; the unit at its end stays.
    fn text(&self, text: &str, expression: &Expression, arguments: &[Text]) -> String {
        let unit = expression.unit.as_deref().unwrap_or("");
        let end = text.trim_end().strip_suffix(unit).unwrap_or(text).len();
        let (mut renamed, mut done) = (String::new(), 0);
        for token in tokens(text).into_iter().filter(|token| token.kind == TokenKind::Name && token.range.end <= end) {
            let name = text.get(token.range.clone()).unwrap_or("");
            if let Some(new) = self.of(name, arguments) {
                renamed.push_str(text.get(done..token.range.start).unwrap_or(""));
                renamed.push_str(new);
                done = token.range.end;
            }
        }
        renamed.push_str(text.get(done..).unwrap_or(""));
        renamed
    }
}

/// Everything that a part defines, and everything that its expressions name; with the place of each definition.
fn vocabulary<'p>(part: &'p Spec, fixed: impl Iterator<Item = &'p str>) -> HashMap<String, Option<Span>> {
    let mut known: HashMap<String, Option<Span>> = HashMap::new();
    let used = part.equations().filter_map(|equation| equation.expression.as_ref()).flat_map(|e| &e.names);
    known.extend(used.filter(|name| reserved(&name.name).is_none()).map(|name| (name.name.clone(), None)));
    let ranges = part.problems.iter().flat_map(|problem| problem.value.vary.iter().chain(&problem.value.robust));
    known.extend(ranges.map(|item| (item.name.clone(), None)));
    let published = part.published.iter().flat_map(|item| item.value.quantities());
    let published = published.filter(|item| reserved(&item.name).is_none());
    known.extend(published.map(|item| (item.name.clone(), None)));
    known.extend(part.modes.iter().flat_map(|mode| &mode.value.flow).map(|item| (item.name.clone(), None)));
    for item in part.functions.iter().flat_map(|function| &function.value.arguments) {
        known.remove(&item.value);
    }
    known.extend(fixed.map(|name| (name.to_owned(), None)));
    known.extend(part.parameters.iter().map(|item| (item.name.clone(), Some(item.span))));
    known.extend(part.states.iter().map(|item| (item.name.clone(), Some(item.span))));
    known.extend(part.memory.iter().map(|item| (item.name.clone(), Some(item.span))));
    known.extend(part.lets.iter().map(|item| (item.name.clone(), Some(item.span))));
    known.extend(part.functions.iter().map(|item| (item.name.clone(), Some(item.span))));
    known.extend(part.measures.iter().map(|item| (item.name.clone(), Some(item.span))));
    known
}

/// Why a name cannot be given.
fn refused(rename: &Named<Text>, known: &HashMap<String, Option<Span>>, item: &Use) -> Option<Diagnostic> {
    let (old, new) = (rename.name.as_str(), rename.value.value.as_str());
    if !known.contains_key(old) {
        let message = format!("nothing in the part `{}` is named `{}`", shortened(&item.part.value), shortened(old));
        let mut names: Vec<&str> = known.keys().map(String::as_str).collect();
        names.sort_unstable();
        let error = Diagnostic::error(Code::PartUse, message).at(rename.span, "");
        return Some(error.help(match suggest(old, names) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "write `rename = { old = \"new\" }`, the part's name on the left".to_owned(),
        }));
    }
    if !is_identifier(new) {
        let error = Diagnostic::error(Code::InvalidName, format!("`{}` is not a valid name", shortened(new)));
        let help = "a name has ASCII letters, digits and `_` and does not begin with a digit";
        return Some(error.at(rename.value.span, "").help(help));
    }
    if let Some(meaning) = reserved(new) {
        let message = format!("`{new}` belongs to the language: it is {meaning}");
        let error = Diagnostic::error(Code::ReservedName, message).at(rename.value.span, "");
        return Some(error.help("choose another name"));
    }
    let taken = known.get(new).copied().flatten().filter(|_| !item.rename.iter().any(|other| other.name == new))?;
    let error = Diagnostic::error(Code::DefinedTwice, format!("the part has a `{new}` of its own"));
    Some(error.at(rename.value.span, "").see(taken, "this one").help("choose another name, or rename that one too"))
}
