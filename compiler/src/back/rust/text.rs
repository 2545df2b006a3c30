//! From tokens to formatted text.

use super::EmitError;
use crate::casadi::program::{Counts, Program};
use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};

/// Formats items.
pub(super) fn pretty(items: TokenStream) -> Result<String, EmitError> {
    Ok(prettyplease::unparse(&syn::parse2::<syn::File>(items)?))
}

/// A number as a literal that reads back exactly.
pub(super) fn number(value: f64) -> TokenStream {
    if value.is_nan() {
        return quote!(f64::NAN);
    }
    let magnitude = if value.is_infinite() {
        quote!(f64::INFINITY)
    } else {
        // The shortest text that reads back as the same number; `{:?}` writes 1e300 where `{}` writes 300 digits.
        let text = format!("{:?}", value.abs());
        text.parse::<Literal>().map_or_else(|_| quote!(f64::NAN), ToTokens::into_token_stream)
    };
    if value.is_sign_negative() { quote!(-#magnitude) } else { magnitude }
}

/// A number of things as a literal.
pub(super) fn count(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}

/// What is longer is not copied to each of the twelve stages of a step.
const INLINED: usize = 400;

/// The attribute of a function that a step calls at each of its stages. What is passed through memory there is waited for, so
/// the compiler is told to inline it.
pub(super) fn inlined(program: &Program) -> TokenStream {
    if program.operations.len() <= INLINED { always() } else { quote!(#[inline]) }
}

/// The attribute of what has to be inlined to be fast; without optimisation that would only take the compiler's time.
pub(super) fn always() -> TokenStream {
    quote!(#[cfg_attr(not(debug_assertions), inline(always))])
}

/// Operation counts for people.
pub(super) fn counts(counts: Counts) -> String {
    let parts: Vec<String> = [
        (counts.additions, "addition"),
        (counts.multiplications, "multiplication"),
        (counts.fused, "fused multiply-add"),
        (counts.divisions, "division"),
        (counts.functions, "function call"),
        (counts.selections, "selection"),
    ]
    .into_iter()
    .filter(|&(count, _)| count > 0)
    .map(|(count, what)| format!("{count} {what}{}", if count == 1 { "" } else { "s" }))
    .collect();
    if parts.is_empty() { "No operations.".to_owned() } else { format!("{}.", parts.join(", ")) }
}

/// Documentation attributes, one a line.
pub(super) fn doc(lines: &[String]) -> TokenStream {
    let lines = lines.iter().map(|line| format!(" {line}"));
    quote!(#(#[doc = #lines])*)
}
