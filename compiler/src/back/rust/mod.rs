//! The Rust emitter: one file a model, and the `mod.rs` that lists them.
//!
//! A model's file implements `gaitc_runtime::model::Model`. Every function of the trait only dispatches to private
//! straight-line functions, one for each mode, transition, switch or observable. The text is formatted by prettyplease
//! and depends on nothing but the model and its programs.

mod body;
mod clock;
mod derivatives;
mod dispatch;
mod info;
mod measured;
mod names;
mod registry;
mod tangent;
mod text;
mod values;

pub use names::camel;
pub use registry::{Mounted, registry};

use crate::casadi::functions::Columns;
use crate::casadi::hoist::Hoisted;
use crate::casadi::{Function, Program, Quantity, exchange};
use crate::ir::{Model, Symbol};
use crate::valid::Validated;
use exchange::Input;
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::{BTreeMap, HashMap};

/// How to print.
#[derive(Clone, Debug)]
pub struct Options {
    /// Path of the runtime crate as the generated code sees it.
    pub runtime_path: String,
    /// Canonical fingerprint of the model's equations.
    pub fingerprint: String,
}

/// Why a model could not be printed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EmitError {
    /// The runtime path is no path.
    #[error("`{0}` is no Rust path to the runtime crate; write one such as `::gaitc_runtime`")]
    RuntimePath(String),
    /// A program is missing: the programs belong to another model.
    #[error("the programs do not belong to the model: {0}")]
    Programs(String),
    /// The printed tokens are no Rust file.
    #[error("the emitter printed something that is not Rust: {0}")]
    Syntax(#[from] syn::Error),
}

/// What all printers of one model share.
struct Context<'a> {
    validated: &'a Validated,
    inputs: Vec<Input>,
    programs: HashMap<Function, Program>,
    /// The flow with its derivatives in the state in two parts, for each mode that has an explicit one.
    hoisted: Vec<Hoisted>,
}

impl<'a> Context<'a> {
    fn model(&self) -> &'a Model {
        self.validated.model()
    }

    fn parts(&self, mode: usize) -> Result<&Hoisted, EmitError> {
        self.hoisted.get(mode).ok_or_else(|| EmitError::Programs(format!("the flow of mode {mode} is missing")))
    }

    fn program(&self, quantity: Quantity, by: Columns) -> Result<&Program, EmitError> {
        let function = Function { quantity, by };
        self.programs.get(&function).ok_or_else(|| EmitError::Programs(format!("{function:?} is missing")))
    }
}

/// The text of a model's file, without its header.
///
/// # Errors
/// When the runtime path is malformed or the programs do not belong to the model.
pub fn emit(validated: &Validated, programs: &[(Function, Program)], options: &Options) -> Result<String, EmitError> {
    let runtime = runtime_path(&options.runtime_path)?;
    let inputs = exchange::inputs(validated.model());
    let context = Context {
        validated,
        hoisted: hoisted(&inputs, programs),
        inputs,
        programs: programs.iter().map(|(function, program)| (*function, program.fused())).collect(),
    };
    let mut items = preamble(&context, &runtime);
    items.push(info::info(&context, &options.fingerprint));
    items.push(dispatch::implementation(&context)?);
    items.extend(values::functions(&context)?);
    items.extend(derivatives::functions(&context)?);
    items.extend(measured::functions(&context)?);
    items.extend(tangent::functions(&context)?);
    items.extend(clock::functions(&context)?);
    items.extend(not_a_number());
    let mut file = head(validated.model())?;
    for item in items {
        file.push('\n');
        file.push_str(&text::pretty(item)?);
    }
    Ok(file)
}

/// The flows of all modes, each in what depends on the state and what does not.
fn hoisted(inputs: &[Input], programs: &[(Function, Program)]) -> Vec<Hoisted> {
    let moves = |input: usize| matches!(inputs.get(input), Some(Input::Symbol(Symbol::State(_))));
    let parts = |program: &Program| {
        let Hoisted { clock, rest } = program.hoisted(moves);
        Hoisted { clock: clock.fused(), rest: rest.fused() }
    };
    let flow = |(function, program): &(Function, Program)| match function {
        Function { quantity: Quantity::Flow(mode), by: Columns::State } => Some((*mode, parts(program))),
        _ => None,
    };
    let by_mode: BTreeMap<usize, Hoisted> = programs.iter().filter_map(flow).collect();
    by_mode.into_values().collect()
}

/// The runtime's path as tokens.
fn runtime_path(path: &str) -> Result<TokenStream, EmitError> {
    let parsed: syn::Path = syn::parse_str(path).map_err(|_| EmitError::RuntimePath(path.to_owned()))?;
    Ok(quote!(#parsed))
}

/// Module documentation and lint levels.
fn head(model: &Model) -> Result<String, EmitError> {
    let doc = format!(" Compiled model `{}`.", model.name);
    let more =
        " Each function is straight-line code; `v0`, `v1`, ... are its shared subexpressions. SI units throughout.";
    text::pretty(quote! {
        #![doc = #doc]
        #![doc = ""]
        #![doc = #more]
        #![allow(non_snake_case, reason = "names of the spec appear as they are written there")]
        #![allow(clippy::let_and_return, reason = "straight-line code names every value")]
        #![allow(
            clippy::len_zero, clippy::match_single_binding, clippy::zero_repeat_side_effects,
            reason = "a size or a list of cases is printed in the same way where it is empty"
        )]
        #![allow(clippy::approx_constant, reason = "constants are printed exactly as CasADi computed them")]
    })
}

/// Imports, sizes and the model's type.
fn preamble(context: &Context<'_>, runtime: &TokenStream) -> Vec<TokenStream> {
    let model = context.model();
    let (n, p, q) = (model.states.len(), model.parameters.len(), context.validated.facts().integrals.len());
    let (states, parameters, integrals) = (text::count(n), text::count(p), text::count(q));
    let name = names::type_name(model);
    let doc = format!(" The compiled model `{}`: {n} states, {p} parameters, {q} time integrals.", model.name);
    vec![
        quote!(use #runtime::{model, scalar};),
        quote! {
            /// Number of states.
            pub const STATES: usize = #states;
            /// Number of parameters.
            pub const PARAMETERS: usize = #parameters;
            /// Number of time integrals.
            pub const INTEGRALS: usize = #integrals;
        },
        quote! {
            #[doc = #doc]
            #[derive(Clone, Copy, Debug, Default)]
            pub struct #name;
        },
    ]
}

/// The answers to an index out of range or a slice of the wrong length.
fn not_a_number() -> Vec<TokenStream> {
    vec![
        quote! {
            /// NaN.
            fn nan<S: scalar::Scalar>() -> S {
                S::constant(f64::NAN)
            }
        },
        quote! {
            /// A state of NaN.
            fn nan_state<S: scalar::Scalar>() -> [S; STATES] {
                [nan(); STATES]
            }
        },
        quote! {
            /// A gradient of NaN.
            fn nan_gradient<S: scalar::Scalar>() -> model::Gradient<S, STATES, PARAMETERS> {
                model::Gradient { value: nan(), dx: [nan(); STATES], dp: [nan(); PARAMETERS], dtau: nan(), dt: nan() }
            }
        },
        quote! {
            /// A gradient by state and rate of NaN.
            fn nan_rate_gradient<S: scalar::Scalar>() -> model::RateGradient<S, STATES, PARAMETERS> {
                model::RateGradient {
                    value: nan(),
                    dx: [nan(); STATES],
                    dk: [nan(); STATES],
                    dp: [nan(); PARAMETERS],
                    dtau: nan(),
                    dt: nan(),
                }
            }
        },
        quote! {
            /// A Jacobian of NaN.
            fn nan_jacobian<S: scalar::Scalar>() -> model::Jacobian<S, STATES, PARAMETERS> {
                model::Jacobian {
                    value: nan_state(),
                    dx: [nan_state(); STATES],
                    dp: [nan_state(); PARAMETERS],
                    dtau: nan_state(),
                    dt: nan_state(),
                }
            }
        },
        quote! {
            /// A linearised residual of NaN.
            fn nan_linearised<S: scalar::Scalar>() -> model::Linearised<S, STATES> {
                model::Linearised { value: nan_state(), dx: [nan_state(); STATES], dk: [nan_state(); STATES] }
            }
        },
        quote! {
            /// A residual Jacobian of NaN.
            fn nan_residual_jacobian<S: scalar::Scalar>() -> model::ResidualJacobian<S, STATES, PARAMETERS> {
                model::ResidualJacobian {
                    value: nan_state(),
                    dx: [nan_state(); STATES],
                    dk: [nan_state(); STATES],
                    dp: [nan_state(); PARAMETERS],
                    dtau: nan_state(),
                    dt: nan_state(),
                }
            }
        },
    ]
}
