//! Names in generated code. A prefix says what a variable is, so that no name of a spec can clash with a keyword, with
//! another name or with a temporary.

use crate::casadi::exchange::Input;
use crate::ir::{Model, Symbol};
use proc_macro2::{Ident, Span};
use quote::format_ident;

/// A name in camel case: `prescribed_length` gives `PrescribedLength`.
pub fn camel(name: &str) -> String {
    name.split('_')
        .flat_map(|part| {
            let mut letters = part.chars();
            letters.next().map(|c| c.to_ascii_uppercase()).into_iter().chain(letters)
        })
        .collect()
}

/// The model's type.
pub(super) fn type_name(model: &Model) -> Ident {
    Ident::new(&camel(&model.name), Span::call_site())
}

/// The local variable that holds an input.
pub(super) fn input(model: &Model, input: Input) -> Ident {
    match input {
        Input::Symbol(symbol) => self::symbol(model, "", symbol),
        Input::Branch(i) => format_ident!("b{i}"),
    }
}

/// The local variable that holds a term of the clock.
pub(super) fn term(index: usize) -> Ident {
    format_ident!("c{index}")
}

/// The local variable that holds the variation of an input.
pub(super) fn variation(model: &Model, symbol: Symbol) -> Ident {
    self::symbol(model, "d", symbol)
}

fn symbol(model: &Model, prefix: &str, symbol: Symbol) -> Ident {
    let named = |kind: &str, name: Option<&String>| format_ident!("{prefix}{kind}_{}", name.map_or("", |n| n.as_str()));
    match symbol {
        Symbol::State(i) => named("x", model.states.get(i).map(|s| &s.name)),
        Symbol::Rate(i) => named("k", model.states.get(i).map(|s| &s.name)),
        Symbol::Parameter(i) => named("p", model.parameters.get(i).map(|p| &p.name)),
        Symbol::Memory(i) => named("n", model.memory.get(i).map(|m| &m.name)),
        Symbol::Tau => format_ident!("{prefix}tau"),
        Symbol::Time => format_ident!("{prefix}t"),
        Symbol::Functional(i) => format_ident!("{prefix}f{i}"),
        Symbol::Measure(i) => format_ident!("{prefix}y{i}"),
        Symbol::SpectralRadius => format_ident!("{prefix}spectral_radius"),
    }
}

/// The private function of a mode or transition: `flow_stance`, `d_reset_step`. No prefix in use begins another one
/// followed by `_`, so two functions never get the same name.
pub(super) fn function(prefix: &str, name: &str) -> Ident {
    format_ident!("{prefix}_{name}")
}

/// The private function of something that has only a number: `switch_0`; in a mode: `observable_0_stance`.
pub(super) fn numbered(prefix: &str, index: usize, mode: Option<&str>) -> Ident {
    match mode {
        Some(mode) => format_ident!("{prefix}_{index}_{mode}"),
        None => format_ident!("{prefix}_{index}"),
    }
}
