//! The flow with its variational columns once more, in two parts: the terms that depend only on the clock, on parameters,
//! memory and selectors, and what is left to do at each state. Many states at the same time need the first part once.

use super::body::{Body, constant};
use super::tangent::{Products, with_columns};
use super::values::{StateFunction, states};
use super::{Context, EmitError, names, text};
use crate::casadi::functions::Columns;
use crate::ir::Mode;
use proc_macro2::TokenStream;
use quote::quote;

/// The private functions of all modes, and the number of terms.
pub(super) fn functions(context: &Context<'_>) -> Result<Vec<TokenStream>, EmitError> {
    let count = text::count(terms(context));
    let mut items = vec![quote! {
        /// Number of terms that depend only on the clock, on parameters, memory and selectors: the most of any mode.
        const CLOCK_TERMS: usize = #count;
    }];
    if context.validated.facts().explicit {
        for (i, mode) in context.model().modes.iter().enumerate() {
            items.push(clock(context, i, &mode.name)?);
            items.push(staged(context, i, &mode.name)?);
        }
    }
    Ok(items)
}

/// The trait's type and functions.
pub(super) fn dispatch(context: &Context<'_>) -> TokenStream {
    let modes = if context.validated.facts().explicit { context.model().modes.as_slice() } else { &[] };
    let arms = |prefix: &str, arguments: TokenStream| -> Vec<TokenStream> {
        let arm = |(i, mode): (usize, &Mode)| {
            let (i, name) = (text::count(i), names::function(prefix, &mode.name));
            quote!(#i => #name(#arguments),)
        };
        modes.iter().enumerate().map(arm).collect()
    };
    let (clocks, staged) = (arms("clock", quote!(env)), arms("staged_flow", quote!(x, dx, clock, env)));
    let (clock, staged) = if modes.is_empty() {
        (
            quote!(let _ = (mode, env); [nan(); CLOCK_TERMS]),
            quote! {
                let _ = (mode, x, dx, clock, env);
                (nan_state(), [nan_state(); C])
            },
        )
    } else {
        (
            quote!(match mode { #(#clocks)* _ => [nan(); CLOCK_TERMS] }),
            quote!(match mode { #(#staged)* _ => (nan_state(), [nan_state(); C]) }),
        )
    };
    let always = text::always();
    quote! {
        type Clock<S: scalar::Scalar> = [S; CLOCK_TERMS];

        #always
        fn clock<S: scalar::Scalar>(mode: usize, env: &model::Env<'_, S, PARAMETERS>) -> [S; CLOCK_TERMS] {
            #clock
        }

        #always
        fn clock_lane<S: scalar::Real>(clock: &[S; CLOCK_TERMS], lane: usize) -> [f64; CLOCK_TERMS] {
            clock.map(|term| term.lane(lane))
        }

        #always
        fn variational_at<S: scalar::Scalar, const C: usize>(
            mode: usize,
            x: &[S; STATES],
            dx: &[[S; STATES]; C],
            clock: &[S; CLOCK_TERMS],
            env: &model::Env<'_, S, PARAMETERS>,
        ) -> ([S; STATES], [[S; STATES]; C]) {
            #staged
        }
    }
}

/// The largest number of terms of any mode.
fn terms(context: &Context<'_>) -> usize {
    context.hoisted.iter().map(|parts| parts.clock.values.len()).max().unwrap_or(0)
}

fn clock(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = &context.parts(mode)?.clock;
    let body = Body::new(context, program);
    let function = names::function("clock", name);
    let doc = text::doc(&[
        format!("The terms of mode `{name}`'s flow that do not depend on the state."),
        String::new(),
        text::counts(program.counts()),
    ]);
    let (bindings, statements) = (body.bind_env(&quote!(return [nan(); CLOCK_TERMS])), body.statements());
    let inline = text::inlined(program);
    let own = (0..program.values.len()).map(|row| body.component(row));
    let unused = (program.values.len()..terms(context)).map(|_| constant(0.0));
    Ok(quote! {
        #doc
        #inline
        fn #function<S: scalar::Scalar>(env: &model::Env<'_, S, PARAMETERS>) -> [S; CLOCK_TERMS] {
            #bindings
            #statements
            [#(#own,)* #(#unused),*]
        }
    })
}

fn staged(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = &context.parts(mode)?.rest;
    let body = Body::new(context, program);
    let n = context.model().states.len();
    let products = Products::new(context, &body, program, Columns::State);
    let (value, rows) = (body.components(0..n), products.rows(0..n));
    let column = products.pattern(&states(context.model()));
    let zero = constant(0.0);
    let function = StateFunction {
        name: &names::function("staged_flow", name),
        doc: vec![
            format!("State derivative f of mode `{name}` and, for each column v, (df/dx) v, from the terms"),
            "that do not depend on the state.".to_owned(),
        ],
        body: &body,
        arguments: quote!(columns: &[[S; STATES]; C], clock: &[S; CLOCK_TERMS],),
        bindings: body.bind_terms(terms(context)),
        returns: quote!(([S; STATES], [[S; STATES]; C])),
        otherwise: quote!((nan_state(), [nan_state(); C])),
        result: quote! {
            let mut products = [[#zero; STATES]; C];
            for (product, column) in products.iter_mut().zip(columns) {
                let &#column = column;
                *product = #rows;
            }
            (#value, products)
        },
    };
    Ok(with_columns(function.print(context, products.counts()), &text::inlined(program)))
}
