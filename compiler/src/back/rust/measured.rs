//! What functionals are taken of: integrands and observables. In a model with an explicit f the flow stands in for rates,
//! so what depends on them has one function a mode; in a model with a mass matrix the rates are an argument.

use super::body::{Body, constant};
use super::values::{StateFunction, rate_argument};
use super::{Context, EmitError, names, text};
use crate::casadi::Quantity;
use crate::casadi::functions::{Columns, all_of_rates, integrand_modes, observable_modes};
use crate::ir::{Model, Symbol};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// The private functions; those of the integrands' derivatives are in [`super::tangent`].
pub(super) fn functions(context: &Context<'_>) -> Result<Vec<TokenStream>, EmitError> {
    let mut items = Vec::new();
    for mode in integrand_modes(context.validated) {
        items.push(integrands(context, mode)?);
    }
    for i in 0..context.validated.facts().observables.len() {
        for mode in observable_modes(context.validated, i) {
            items.push(observable(context, i, mode)?);
            items.push(observable_gradient(context, i, mode)?);
        }
    }
    Ok(items)
}

/// The trait's functions: of the integrands, and of the observables.
pub(super) fn dispatch(context: &Context<'_>) -> (TokenStream, TokenStream) {
    (dispatch_integrands(context), dispatch_observables(context))
}

/// Name of an observable's function, and where it holds, for the documentation.
fn observable_name(model: &Model, prefix: &str, index: usize, mode: Option<usize>) -> (Ident, String) {
    let (mode, place) = in_mode(model, mode);
    (names::numbered(prefix, index, mode), place)
}

/// Name of a function of the integrands, and where it holds, for the documentation.
pub(super) fn integrands_name(model: &Model, prefix: &str, mode: Option<usize>) -> (Ident, String) {
    let (mode, place) = in_mode(model, mode);
    (mode.map_or_else(|| quote::format_ident!("{prefix}"), |mode| names::function(prefix, mode)), place)
}

/// Name of a mode, and the same for the documentation.
fn in_mode(model: &Model, mode: Option<usize>) -> (Option<&str>, String) {
    let mode = mode.and_then(|mode| model.modes.get(mode)).map(|mode| mode.name.as_str());
    (mode, mode.map(|mode| format!(" in mode `{mode}`")).unwrap_or_default())
}

fn integrands(context: &Context<'_>, mode: Option<usize>) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Integrands(mode), Columns::None)?;
    let body = Body::new(context, program);
    let (name, place) = integrands_name(context.model(), "integrands", mode);
    let (arguments, bindings) = optional_rates(context, &body);
    let function = StateFunction {
        name: &name,
        doc: vec![format!("The integrands{place}.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!([S; INTEGRALS]),
        otherwise: quote!([nan(); INTEGRALS]),
        result: body.components(0..context.validated.facts().integrals.len()),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn observable(context: &Context<'_>, index: usize, mode: Option<usize>) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Observable(index, mode), Columns::None)?;
    let body = Body::new(context, program);
    let (name, place) = observable_name(context.model(), "observable", index, mode);
    let (arguments, bindings) = optional_rates(context, &body);
    let function = StateFunction {
        name: &name,
        doc: vec![format!("Observable {index}{place}.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!(S),
        otherwise: quote!(nan()),
        result: body.component(0),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

/// The argument k and its bindings where the model has a mass matrix; nothing where the flow stands in for the rates.
pub(super) fn optional_rates(context: &Context<'_>, body: &Body<'_>) -> (TokenStream, TokenStream) {
    if context.validated.facts().explicit { (quote!(), quote!()) } else { rate_argument(context.model(), body) }
}

fn observable_gradient(context: &Context<'_>, index: usize, mode: Option<usize>) -> Result<TokenStream, EmitError> {
    let by = all_of_rates(context.validated);
    let program = context.program(Quantity::Observable(index, mode), by)?;
    let body = Body::new(context, program);
    let (name, place) = observable_name(context.model(), "d_observable", index, mode);
    let symbols = by.symbols(context.model());
    let entry = |symbol: Symbol| match symbols.iter().position(|&other| other == symbol) {
        Some(column) => body.derivative(0, column),
        // Not an argument.
        None => constant(0.0),
    };
    let (n, p) = (context.model().states.len(), context.model().parameters.len());
    let value = body.component(0);
    let (dx, dk) = ((0..n).map(|i| entry(Symbol::State(i))), (0..n).map(|i| entry(Symbol::Rate(i))));
    let dp = (0..p).map(|i| entry(Symbol::Parameter(i)));
    let (dtau, dt) = (entry(Symbol::Tau), entry(Symbol::Time));
    let (arguments, bindings) = optional_rates(context, &body);
    let function = StateFunction {
        name: &name,
        doc: vec![format!("Observable {index}{place} with all first derivatives.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!(model::RateGradient<S, STATES, PARAMETERS>),
        otherwise: quote!(nan_rate_gradient()),
        result: quote!(model::RateGradient {
            value: #value, dx: [#(#dx),*], dk: [#(#dk),*], dp: [#(#dp),*], dtau: #dtau, dt: #dt,
        }),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

/// The rates as the functions of integrands and observables take them: not at all where the flow stands in for them.
/// The first is the name of the trait function's argument.
fn rates(context: &Context<'_>) -> (TokenStream, TokenStream) {
    if context.validated.facts().explicit { (quote!(_k), quote!()) } else { (quote!(k), quote!(k,)) }
}

fn dispatch_integrands(context: &Context<'_>) -> TokenStream {
    let (k, rates) = rates(context);
    let all: Vec<_> = (0..context.model().modes.len()).map(text::count).collect();
    let pick = |prefix: &str, arguments: TokenStream, otherwise: TokenStream| {
        let arms: Vec<TokenStream> = (integrand_modes(context.validated).into_iter())
            .map(|mode| {
                let (name, _) = integrands_name(context.model(), prefix, mode);
                match mode.map(text::count) {
                    Some(mode) => quote!(#mode => #name(#arguments),),
                    None => quote!(#(#all)|* => #name(#arguments),),
                }
            })
            .collect();
        if arms.is_empty() {
            quote!(let _ = (mode, #arguments); #otherwise)
        } else {
            quote!(match mode { #(#arms)* _ => #otherwise })
        }
    };
    let value = pick("integrands", quote!(x, #rates env), quote!([nan(); INTEGRALS]));
    let otherwise = quote!(([nan(); INTEGRALS], [[nan(); INTEGRALS]; C]));
    let along = pick("tangent_integrands", quote!(x, #rates along, env), otherwise);
    quote! {
        fn integrands<S: scalar::Scalar>(
            mode: usize, x: &[S; STATES], #k: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> [S; INTEGRALS] {
            #value
        }

        #[inline]
        fn integrands_along<S: scalar::Scalar, const C: usize>(
            mode: usize,
            x: &[S; STATES],
            #k: &[S; STATES],
            along: &model::Directions<'_, S, STATES, PARAMETERS, C>,
            env: &model::Env<'_, S, PARAMETERS>,
        ) -> ([S; INTEGRALS], [[S; INTEGRALS]; C]) {
            #along
        }
    }
}

fn dispatch_observables(context: &Context<'_>) -> TokenStream {
    let (k, rates) = rates(context);
    let arms = |prefix: &str| -> Vec<TokenStream> {
        let modes: Vec<_> = (0..context.model().modes.len()).map(text::count).collect();
        (0..context.validated.facts().observables.len())
            .flat_map(|i| observable_modes(context.validated, i).into_iter().map(move |mode| (i, mode)))
            .map(|(i, mode)| {
                let (name, _) = observable_name(context.model(), prefix, i, mode);
                let i = text::count(i);
                match mode.map(text::count) {
                    Some(mode) => quote!((#i, #mode) => #name(x, #rates env),),
                    None => quote!((#i, #(#modes)|*) => #name(x, #rates env),),
                }
            })
            .collect()
    };
    let function = |name: &str, prefix: &str, returns: TokenStream, otherwise: TokenStream| {
        let (name, arms) = (quote::format_ident!("{name}"), arms(prefix));
        let body = if arms.is_empty() {
            quote!(let _ = (index, mode, x, #rates env); #otherwise)
        } else {
            quote!(match (index, mode) { #(#arms)* _ => #otherwise })
        };
        quote! {
            fn #name<S: scalar::Scalar>(
                index: usize, mode: usize, x: &[S; STATES], #k: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
            ) -> #returns {
                #body
            }
        }
    };
    let value = function("observable", "observable", quote!(S), quote!(nan()));
    let gradient = quote!(model::RateGradient<S, STATES, PARAMETERS>);
    let derivative = function("observable_gradient", "d_observable", gradient, quote!(nan_rate_gradient()));
    quote!(#value #derivative)
}
