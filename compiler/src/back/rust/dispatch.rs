//! `impl Model`: every function of the trait picks the private function of the mode, transition, switch or observable
//! that it is asked for, and answers NaN to an index out of range.

use super::{Context, EmitError, clock, measured, names, text};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// The implementation of the trait.
pub(super) fn implementation(context: &Context<'_>) -> Result<TokenStream, EmitError> {
    let name = names::type_name(context.model());
    let flows = flows(context);
    let clock = clock::dispatch(context);
    let residuals = residuals(context);
    let (integrands, observables) = measured::dispatch(context);
    let events = events(context);
    let section = section(context);
    let measures = measures(context);
    Ok(quote! {
        impl model::Model<STATES, PARAMETERS, INTEGRALS> for #name {
            const INFO: &'static model::ModelInfo = &INFO;
            #flows
            #clock
            #residuals
            #integrands
            #events
            #section
            #observables
            #measures
        }
    })
}

/// `index => call`, and NaN for the rest.
fn dispatch(index: &TokenStream, names: &[Ident], arguments: &TokenStream, otherwise: &TokenStream) -> TokenStream {
    let arms = names.iter().enumerate().map(|(i, name)| {
        let i = text::count(i);
        quote!(#i => #name(#arguments),)
    });
    quote!(match #index { #(#arms)* _ => #otherwise })
}

fn mode_names(context: &Context<'_>, prefix: &str, only_explicit: bool) -> Vec<Ident> {
    if only_explicit && !context.validated.facts().explicit {
        return Vec::new();
    }
    context.model().modes.iter().map(|mode| names::function(prefix, &mode.name)).collect()
}

fn transition_names(context: &Context<'_>, prefix: &str) -> Vec<Ident> {
    context.model().transitions.iter().map(|t| names::function(prefix, &t.name)).collect()
}

fn flows(context: &Context<'_>) -> TokenStream {
    let pick = |prefix, arguments: TokenStream, otherwise: TokenStream| {
        let names = mode_names(context, prefix, true);
        if names.is_empty() {
            // Nothing to pick from; the arguments are named all the same, as in the trait.
            quote!(let _ = (mode, #arguments); #otherwise)
        } else {
            dispatch(&quote!(mode), &names, &arguments, &otherwise)
        }
    };
    let flow = pick("flow", quote!(x, env), quote!(nan_state()));
    let d_flow = pick("d_flow", quote!(x, env), quote!(nan_jacobian()));
    let tangent_flow = pick("tangent_flow", quote!(x, dx, env), quote!((nan_state(), [nan_state(); C])));
    let integrated = pick("integrated", quote!(x, env), quote!((nan_state(), [nan(); INTEGRALS])));
    let tangent_integrated = pick(
        "tangent_integrated",
        quote!(x, dx, dp, env),
        quote!(model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }),
    );
    quote! {
        #[inline]
        fn flow<S: scalar::Scalar>(mode: usize, x: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>) -> [S; STATES] {
            #flow
        }

        fn flow_jacobian<S: scalar::Scalar>(
            mode: usize, x: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> model::Jacobian<S, STATES, PARAMETERS> {
            #d_flow
        }

        #[inline]
        fn variational<S: scalar::Scalar, const C: usize>(
            mode: usize, x: &[S; STATES], dx: &[[S; STATES]; C], env: &model::Env<'_, S, PARAMETERS>,
        ) -> ([S; STATES], [[S; STATES]; C]) {
            #tangent_flow
        }

        #[inline]
        fn integrated<S: scalar::Scalar>(
            mode: usize, x: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> ([S; STATES], [S; INTEGRALS]) {
            #integrated
        }

        #[inline]
        fn integrated_variational<S: scalar::Scalar, const C: usize>(
            mode: usize,
            x: &[S; STATES],
            dx: &[[S; STATES]; C],
            dp: &[[S; PARAMETERS]; C],
            env: &model::Env<'_, S, PARAMETERS>,
        ) -> model::Integrated<S, STATES, INTEGRALS, C> {
            #tangent_integrated
        }
    }
}

fn residuals(context: &Context<'_>) -> TokenStream {
    let arguments = quote!(x, k, env);
    let values = mode_names(context, "residual", false);
    let derivatives = mode_names(context, "d_residual", false);
    let residual = dispatch(&quote!(mode), &values, &arguments, &quote!(nan_state()));
    let d_residual = dispatch(&quote!(mode), &derivatives, &arguments, &quote!(nan_residual_jacobian()));
    let linearised = mode_names(context, "linearised", false);
    let linearised = dispatch(&quote!(mode), &linearised, &arguments, &quote!(nan_linearised()));
    quote! {
        fn residual<S: scalar::Scalar>(
            mode: usize, x: &[S; STATES], k: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> [S; STATES] {
            #residual
        }

        fn residual_jacobian<S: scalar::Scalar>(
            mode: usize, x: &[S; STATES], k: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> model::ResidualJacobian<S, STATES, PARAMETERS> {
            #d_residual
        }

        fn residual_linearised<S: scalar::Scalar>(
            mode: usize, x: &[S; STATES], k: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> model::Linearised<S, STATES> {
            #linearised
        }
    }
}

/// A function of the trait with an index, state and environment.
fn indexed(name: &str, index: &str, names: &[Ident], returns: &TokenStream, otherwise: &TokenStream) -> TokenStream {
    let (name, index) = (quote::format_ident!("{name}"), quote::format_ident!("{index}"));
    let body = if names.is_empty() {
        quote!(let _ = (#index, x, env); #otherwise)
    } else {
        dispatch(&quote!(#index), names, &quote!(x, env), otherwise)
    };
    quote! {
        fn #name<S: scalar::Scalar>(
            #index: usize, x: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>,
        ) -> #returns {
            #body
        }
    }
}

fn events(context: &Context<'_>) -> TokenStream {
    let (nan, nan_gradient) = (quote!(nan()), quote!(nan_gradient()));
    let gradient = quote!(model::Gradient<S, STATES, PARAMETERS>);
    let switches = |prefix| -> Vec<Ident> {
        (0..context.model().switches.len()).map(|i| names::numbered(prefix, i, None)).collect()
    };
    let switch = indexed("switch", "index", &switches("switch"), &quote!(S), &nan);
    let d_switch = indexed("switch_gradient", "index", &switches("d_switch"), &gradient, &nan_gradient);
    let guard = indexed("guard", "transition", &transition_names(context, "guard"), &quote!(S), &nan);
    let d_guards = transition_names(context, "d_guard");
    let d_guard = indexed("guard_gradient", "transition", &d_guards, &gradient, &nan_gradient);
    let jacobian = quote!(model::Jacobian<S, STATES, PARAMETERS>);
    let d_resets = transition_names(context, "d_reset");
    let d_reset = indexed("reset_jacobian", "transition", &d_resets, &jacobian, &quote!(nan_jacobian()));
    let (when, reset) = (when(context), reset(context));
    quote!(#switch #d_switch #guard #d_guard #when #reset #d_reset)
}

fn when(context: &Context<'_>) -> TokenStream {
    let arms = context.model().transitions.iter().enumerate().map(|(i, transition)| {
        let number = text::count(i);
        if transition.when.is_some() {
            let name = names::function("when", &transition.name);
            quote!(#number => #name(x, env),)
        } else {
            quote!(#number => S::constant(1.0),)
        }
    });
    let unused = context.model().transitions.iter().all(|t| t.when.is_none()).then(|| quote!(let _ = (x, env);));
    quote! {
        fn when<S: scalar::Scalar>(transition: usize, x: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>) -> S {
            #unused
            match transition { #(#arms)* _ => nan() }
        }
    }
}

fn reset(context: &Context<'_>) -> TokenStream {
    let m = text::count(context.model().memory.len());
    let names = transition_names(context, "reset");
    let chosen = dispatch(&quote!(transition), &names, &quote!(x, env), &quote!((nan_state(), [nan(); #m])));
    let chosen = if names.is_empty() { quote!((nan_state(), [nan(); #m])) } else { chosen };
    let unused = names.is_empty().then(|| quote!(let _ = (transition, x, env);));
    quote! {
        fn reset<S: scalar::Scalar>(
            transition: usize, x: &[S; STATES], env: &model::Env<'_, S, PARAMETERS>, memory: &mut [S],
        ) -> [S; STATES] {
            #unused
            if memory.len() != #m {
                memory.fill(nan());
                return nan_state();
            }
            let (state, after): ([S; STATES], [S; #m]) = #chosen;
            for (slot, value) in memory.iter_mut().zip(after) {
                *slot = value;
            }
            state
        }
    }
}

fn section(context: &Context<'_>) -> TokenStream {
    let section = context.model().section.as_ref();
    let d = text::count(section.map_or(0, |s| s.coordinates.len()));
    let (embed, d_embed) = match section {
        Some(_) => (quote!(embed(z, p)), quote!(d_embed(z, p))),
        None => (quote!(let _ = (z, p); nan_state()), quote!(([nan_state(); #d], [nan_state(); PARAMETERS]))),
    };
    let unused = section.is_none().then(|| quote!(let _ = (z, p);));
    let (symmetry, d_symmetry) = if section.is_some_and(|s| s.symmetry.is_some()) {
        (quote!(symmetry(x, p)), quote!(d_symmetry(x, p)))
    } else {
        (quote!(let _ = p; *x), identity_jacobian(context))
    };
    quote! {
        fn embed<S: scalar::Scalar>(z: &[S], p: &[S; PARAMETERS]) -> [S; STATES] {
            #embed
        }

        fn embed_jacobian<S: scalar::Scalar>(
            z: &[S], p: &[S; PARAMETERS], dz: &mut [[S; STATES]],
        ) -> [[S; STATES]; PARAMETERS] {
            #unused
            if dz.len() != #d {
                dz.fill(nan_state());
                return [nan_state(); PARAMETERS];
            }
            let (columns, dp): ([[S; STATES]; #d], [[S; STATES]; PARAMETERS]) = #d_embed;
            for (slot, column) in dz.iter_mut().zip(columns) {
                *slot = column;
            }
            dp
        }

        fn symmetry<S: scalar::Scalar>(x: &[S; STATES], p: &[S; PARAMETERS]) -> [S; STATES] {
            #symmetry
        }

        fn symmetry_jacobian<S: scalar::Scalar>(
            x: &[S; STATES], p: &[S; PARAMETERS],
        ) -> model::Jacobian<S, STATES, PARAMETERS> {
            #d_symmetry
        }
    }
}

fn identity_jacobian(context: &Context<'_>) -> TokenStream {
    let n = context.model().states.len();
    let columns = (0..n).map(|j| {
        let entries = (0..n).map(|i| if i == j { quote!(one) } else { quote!(zero) });
        quote!([#(#entries),*])
    });
    let one = (n > 0).then(|| quote!(let one = S::constant(1.0);));
    quote! {
        let _ = p;
        #one
        let zero = S::constant(0.0);
        model::Jacobian {
            value: *x,
            dx: [#(#columns),*],
            dp: [[zero; STATES]; PARAMETERS],
            dtau: [zero; STATES],
            dt: [zero; STATES],
        }
    }
}

fn measures(context: &Context<'_>) -> TokenStream {
    let entries = text::count(context.model().measures.len() * context.model().functionals.len());
    let count = text::count(context.model().measures.len());
    quote! {
        fn measures<S: scalar::Scalar>(functionals: &[S], p: &[S; PARAMETERS], out: &mut [S]) {
            if out.len() != #count {
                return out.fill(nan());
            }
            for (slot, value) in out.iter_mut().zip(measures(functionals, p)) {
                *slot = value;
            }
        }

        fn measures_jacobian<S: scalar::Scalar>(
            functionals: &[S], p: &[S; PARAMETERS], dfunctionals: &mut [S], dp: &mut [[S; PARAMETERS]],
        ) {
            if dfunctionals.len() != #entries || dp.len() != #count {
                dfunctionals.fill(nan());
                return dp.fill([nan(); PARAMETERS]);
            }
            let (rows, columns) = d_measures(functionals, p);
            for (slot, value) in dfunctionals.iter_mut().zip(rows) {
                *slot = value;
            }
            for (slot, value) in dp.iter_mut().zip(columns) {
                *slot = value;
            }
        }
    }
}
