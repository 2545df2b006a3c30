//! The private functions that compute values: flow, residual, switching functions, guards, resets, section, measures.

use super::body::Body;
use super::{Context, EmitError, names, text};
use crate::casadi::Quantity;
use crate::casadi::exchange::Input;
use crate::casadi::functions::Columns;
use crate::dimension::Dimension;
use crate::ir::{Model, Symbol};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// All value functions of a model.
pub(super) fn functions(context: &Context<'_>) -> Result<Vec<TokenStream>, EmitError> {
    let model = context.model();
    let mut items = Vec::new();
    for (i, mode) in model.modes.iter().enumerate() {
        if context.validated.facts().explicit {
            items.push(flow(context, i, &mode.name)?);
            items.push(integrated(context, i, &mode.name)?);
        }
        items.push(residual(context, i, &mode.name)?);
    }
    for (i, switch) in model.switches.iter().enumerate() {
        let doc = format!("Switching function {i}, not negative where `{}`.", one_line(&switch.text));
        items.push(scalar(context, Quantity::Switch(i), &names::numbered("switch", i, None), doc)?);
    }
    for (i, transition) in model.transitions.iter().enumerate() {
        let name = &transition.name;
        let doc = format!("Guard of transition `{name}`.");
        items.push(scalar(context, Quantity::Guard(i), &names::function("guard", name), doc)?);
        if transition.when.is_some() {
            let doc = format!("Transition `{name}` is enabled where this is not negative.");
            items.push(scalar(context, Quantity::When(i), &names::function("when", name), doc)?);
        }
        items.push(reset(context, i, name)?);
    }
    if let Some(section) = &model.section {
        items.push(embed(context, &section.coordinates)?);
        if section.symmetry.is_some() {
            items.push(symmetry(context)?);
        }
    }
    items.push(measures(context)?);
    Ok(items)
}

/// A function of state and environment.
pub(super) struct StateFunction<'a> {
    pub(super) name: &'a Ident,
    /// First lines of its documentation.
    pub(super) doc: Vec<String>,
    pub(super) body: &'a Body<'a>,
    /// Further arguments.
    pub(super) arguments: TokenStream,
    /// Bindings of the further arguments.
    pub(super) bindings: TokenStream,
    pub(super) returns: TokenStream,
    /// What is returned when a slice has the wrong length.
    pub(super) otherwise: TokenStream,
    /// Last expression of the body.
    pub(super) result: TokenStream,
}

impl StateFunction<'_> {
    /// Prints it.
    pub(super) fn print(self, context: &Context<'_>, counts: String) -> TokenStream {
        let Self { name, mut doc, body, arguments, bindings, returns, otherwise, result } = self;
        doc.extend([String::new(), counts]);
        let doc = text::doc(&doc);
        let states = states(context.model());
        let x = if body.uses_any(&states) { quote!(x) } else { quote!(_x) };
        let bind_x = body.bind_array(&states, &quote!(x));
        let bind_env = body.bind_env(&quote!(return #otherwise));
        let statements = body.statements();
        quote! {
            #doc
            fn #name<S: scalar::Scalar>(
                #x: &[S; STATES],
                #arguments
                env: &model::Env<'_, S, PARAMETERS>,
            ) -> #returns {
                #bind_env
                #bind_x
                #bindings
                #statements
                #result
            }
        }
    }
}

/// All states as symbols.
pub(super) fn states(model: &Model) -> Vec<Symbol> {
    (0..model.states.len()).map(Symbol::State).collect()
}

/// All parameters as symbols.
pub(super) fn parameters(model: &Model) -> Vec<Symbol> {
    (0..model.parameters.len()).map(Symbol::Parameter).collect()
}

/// Text in a documentation line.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `q (rad), p [m s^-1]` for the states, each dimension changed by `change`.
pub(super) fn components(model: &Model, change: impl Fn(Dimension) -> Option<Dimension>) -> String {
    let list: Vec<String> = model
        .states
        .iter()
        .map(|s| match change(s.dimension) {
            Some(dimension) => format!("{} [{dimension}]", s.name),
            None => s.name.clone(),
        })
        .collect();
    list.join(", ")
}

/// The unit of rates.
pub(super) fn per_second(dimension: Dimension) -> Option<Dimension> {
    dimension.div(Dimension::TIME)
}

fn scalar(context: &Context<'_>, quantity: Quantity, name: &Ident, doc: String) -> Result<TokenStream, EmitError> {
    let program = context.program(quantity, Columns::None)?;
    let body = Body::new(context, program);
    let function = StateFunction {
        name,
        doc: vec![doc],
        body: &body,
        arguments: quote!(),
        bindings: quote!(),
        returns: quote!(S),
        otherwise: quote!(nan()),
        result: body.component(0),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn flow(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Flow(mode), Columns::None)?;
    let body = Body::new(context, program);
    let function = StateFunction {
        name: &names::function("flow", name),
        doc: vec![
            format!("State derivative f of mode `{name}`."),
            format!("Rates of {}.", components(context.model(), per_second)),
        ],
        body: &body,
        arguments: quote!(),
        bindings: quote!(),
        returns: quote!([S; STATES]),
        otherwise: quote!(nan_state()),
        result: body.components(0..context.model().states.len()),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn integrated(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Integrated(mode), Columns::None)?;
    let body = Body::new(context, program);
    let (n, q) = (context.model().states.len(), context.validated.facts().integrals.len());
    let (flow, integrands) = (body.components(0..n), body.components(n..n + q));
    let function = StateFunction {
        name: &names::function("integrated", name),
        doc: vec![format!("State derivative f and integrands of mode `{name}`.")],
        body: &body,
        arguments: quote!(),
        bindings: quote!(),
        returns: quote!(([S; STATES], [S; INTEGRALS])),
        otherwise: quote!((nan_state(), [nan(); INTEGRALS])),
        result: quote!((#flow, #integrands)),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn residual(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Residual(mode), Columns::None)?;
    let body = Body::new(context, program);
    let (arguments, bindings) = rate_argument(context.model(), &body);
    let function = StateFunction {
        name: &names::function("residual", name),
        doc: vec![format!("Residual F = M k - f of mode `{name}`, k the rates of the states.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!([S; STATES]),
        otherwise: quote!(nan_state()),
        result: body.components(0..context.model().states.len()),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

/// The argument k and its bindings.
pub(super) fn rate_argument(model: &Model, body: &Body<'_>) -> (TokenStream, TokenStream) {
    let rates: Vec<Symbol> = (0..model.states.len()).map(Symbol::Rate).collect();
    let k = if body.uses_any(&rates) { quote!(k) } else { quote!(_k) };
    (quote!(#k: &[S; STATES],), body.bind_array(&rates, &quote!(k)))
}

fn reset(context: &Context<'_>, transition: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::ResetWithMemory(transition), Columns::None)?;
    let body = Body::new(context, program);
    let (n, m) = (context.model().states.len(), context.model().memory.len());
    let (state, memory) = (body.components(0..n), body.components(n..n + m));
    let m = text::count(m);
    let function = StateFunction {
        name: &names::function("reset", name),
        doc: vec![
            format!("State and memory after transition `{name}`, from those before."),
            format!("State: {}.", components(context.model(), Some)),
        ],
        body: &body,
        arguments: quote!(),
        bindings: quote!(),
        returns: quote!(([S; STATES], [S; #m])),
        otherwise: quote!((nan_state(), [nan(); #m])),
        result: quote!((#state, #memory)),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn embed(context: &Context<'_>, coordinates: &[usize]) -> Result<TokenStream, EmitError> {
    let model = context.model();
    let program = context.program(Quantity::Embed, Columns::None)?;
    let body = Body::new(context, program);
    let z = coordinates.iter().map(|&i| Input::Symbol(Symbol::State(i)));
    let bind_z = body.bind_slice(z, &quote!(z), &quote!(return nan_state()));
    let parameters = parameters(model);
    let p = if body.uses_any(&parameters) { quote!(p) } else { quote!(_p) };
    let bind_p = body.bind_array(&parameters, &quote!(p));
    let (statements, result) = (body.statements(), body.components(0..model.states.len()));
    let doc = text::doc(&[
        "Full state on the section from its coordinates.".to_owned(),
        String::new(),
        text::counts(program.counts()),
    ]);
    Ok(quote! {
        #doc
        fn embed<S: scalar::Scalar>(z: &[S], #p: &[S; PARAMETERS]) -> [S; STATES] {
            #bind_z
            #bind_p
            #statements
            #result
        }
    })
}

fn symmetry(context: &Context<'_>) -> Result<TokenStream, EmitError> {
    let model = context.model();
    let program = context.program(Quantity::Symmetry, Columns::None)?;
    let body = Body::new(context, program);
    let (states, parameters) = (states(model), parameters(model));
    let x = if body.uses_any(&states) { quote!(x) } else { quote!(_x) };
    let p = if body.uses_any(&parameters) { quote!(p) } else { quote!(_p) };
    let (bind_x, bind_p) = (body.bind_array(&states, &quote!(x)), body.bind_array(&parameters, &quote!(p)));
    let (statements, result) = (body.statements(), body.components(0..model.states.len()));
    let doc = text::doc(&[
        "Image of a state under the section's symmetry.".to_owned(),
        String::new(),
        text::counts(program.counts()),
    ]);
    Ok(quote! {
        #doc
        fn symmetry<S: scalar::Scalar>(#x: &[S; STATES], #p: &[S; PARAMETERS]) -> [S; STATES] {
            #bind_x
            #bind_p
            #statements
            #result
        }
    })
}

fn measures(context: &Context<'_>) -> Result<TokenStream, EmitError> {
    let model = context.model();
    let count = model.measures.len();
    let program = context.program(Quantity::Measures, Columns::None)?;
    let body = Body::new(context, program);
    let functionals = (0..model.functionals.len()).map(|i| Input::Symbol(Symbol::Functional(i)));
    let otherwise = {
        let count = text::count(count);
        quote!(return [nan(); #count])
    };
    let bind_functionals = body.bind_slice(functionals, &quote!(functionals), &otherwise);
    let parameters = parameters(model);
    let p = if body.uses_any(&parameters) { quote!(p) } else { quote!(_p) };
    let bind_p = body.bind_array(&parameters, &quote!(p));
    let (statements, result) = (body.statements(), body.components(0..count));
    let count = text::count(count);
    let list: Vec<String> = model.measures.iter().map(|m| format!("{} [{}]", m.name, m.dimension)).collect();
    let doc = text::doc(&[
        "Measures from the values of the functionals.".to_owned(),
        format!("Measures: {}.", if list.is_empty() { "none".to_owned() } else { list.join(", ") }),
        String::new(),
        text::counts(program.counts()),
    ]);
    Ok(quote! {
        #doc
        fn measures<S: scalar::Scalar>(functionals: &[S], #p: &[S; PARAMETERS]) -> [S; #count] {
            #bind_functionals
            #bind_p
            #statements
            #result
        }
    })
}
