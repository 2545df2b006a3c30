//! Warnings about what is defined and never used.

use crate::diagnostic::{Code, Diagnostic};
use crate::front::spec::{Named, Spec};
use crate::source::Span;
use std::collections::HashSet;

/// Warns about parameters, memory, names of `[let]` and functions that no expression and no problem names. Parts may
/// offer more than a spec needs.
pub(super) fn check(spec: &Spec, diagnostics: &mut Vec<Diagnostic>) {
    let expressions = spec.equations().filter_map(|equation| equation.expression.as_ref());
    let mut used: HashSet<&str> = expressions.flat_map(|e| &e.names).map(|name| name.name.as_str()).collect();
    used.extend(spec.problems.iter().flat_map(|problem| &problem.value.vary).map(|item| item.name.as_str()));
    let Some(file) = spec.name.as_ref().map(|name| name.span.file) else { return };
    let used = |name: &str, span: Span| span.file != file || used.contains(name);
    warn(&spec.parameters, "parameter", used, diagnostics);
    warn(&spec.memory, "memory", used, diagnostics);
    warn(&spec.lets, "name of [let]", used, diagnostics);
    warn(&spec.functions, "function", used, diagnostics);
}

fn warn<T>(items: &[Named<T>], kind: &str, used: impl Fn(&str, Span) -> bool, diagnostics: &mut Vec<Diagnostic>) {
    for item in items.iter().filter(|item| !used(&item.name, item.span)) {
        let message = format!("the {kind} `{}` is never used", item.name);
        let warning = Diagnostic::warning(Code::Unused, message).at(item.span, "");
        diagnostics.push(warning.help("remove it, or use it"));
    }
}
