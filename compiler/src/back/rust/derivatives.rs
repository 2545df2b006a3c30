//! The private functions that compute a value with all its first derivatives in one pass.

use super::body::{Body, constant};
use super::values::{StateFunction, components, parameters, rate_argument, states};
use super::{Context, EmitError, names, text};
use crate::casadi::Quantity;
use crate::casadi::exchange::Input;
use crate::casadi::functions::Columns;
use crate::ir::Symbol;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

/// All derivative functions of a model.
pub(super) fn functions(context: &Context<'_>) -> Result<Vec<TokenStream>, EmitError> {
    let model = context.model();
    let mut items = Vec::new();
    for (i, mode) in model.modes.iter().enumerate() {
        if context.validated.facts().explicit {
            let doc = format!("State derivative f of mode `{}` with all first derivatives.", mode.name);
            items.push(jacobian(context, Quantity::Flow(i), &names::function("d_flow", &mode.name), doc)?);
        }
        items.push(residual(context, i, &mode.name)?);
        items.push(linearised(context, i, &mode.name)?);
    }
    for i in 0..model.switches.len() {
        let doc = format!("Switching function {i} with all first derivatives.");
        items.push(gradient(context, Quantity::Switch(i), &names::numbered("d_switch", i, None), doc)?);
    }
    for (i, transition) in model.transitions.iter().enumerate() {
        let name = &transition.name;
        let doc = format!("Guard of transition `{name}` with all first derivatives.");
        items.push(gradient(context, Quantity::Guard(i), &names::function("d_guard", name), doc)?);
        let doc = format!("State after transition `{name}` with all first derivatives.");
        items.push(jacobian(context, Quantity::Reset(i), &names::function("d_reset", name), doc)?);
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

fn gradient(context: &Context<'_>, quantity: Quantity, name: &Ident, doc: String) -> Result<TokenStream, EmitError> {
    let program = context.program(quantity, Columns::All)?;
    let body = Body::new(context, program);
    let (n, p) = (context.model().states.len(), context.model().parameters.len());
    let value = body.component(0);
    let dx = (0..n).map(|column| body.derivative(0, column));
    let dp = (n..n + p).map(|column| body.derivative(0, column));
    let (dtau, dt) = (body.derivative(0, n + p), body.derivative(0, n + p + 1));
    let function = StateFunction {
        name,
        doc: vec![doc],
        body: &body,
        arguments: quote!(),
        bindings: quote!(),
        returns: quote!(model::Gradient<S, STATES, PARAMETERS>),
        otherwise: quote!(nan_gradient()),
        result: quote!(model::Gradient { value: #value, dx: [#(#dx),*], dp: [#(#dp),*], dtau: #dtau, dt: #dt }),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn jacobian(context: &Context<'_>, quantity: Quantity, name: &Ident, doc: String) -> Result<TokenStream, EmitError> {
    let program = context.program(quantity, Columns::All)?;
    let body = Body::new(context, program);
    let (n, p) = (context.model().states.len(), context.model().parameters.len());
    let value = body.components(0..n);
    let (dx, dp) = (body.columns(n, 0..n), body.columns(n, n..n + p));
    let (dtau, dt) = (body.column(n, n + p), body.column(n, n + p + 1));
    let function = StateFunction {
        name,
        doc: vec![doc, format!("Components: {}; derivatives by columns.", components(context.model(), |_| None))],
        body: &body,
        arguments: quote!(),
        bindings: quote!(),
        returns: quote!(model::Jacobian<S, STATES, PARAMETERS>),
        otherwise: quote!(nan_jacobian()),
        result: quote!(model::Jacobian { value: #value, dx: #dx, dp: #dp, dtau: #dtau, dt: #dt }),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn residual(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Residual(mode), Columns::AllAndRates)?;
    let body = Body::new(context, program);
    let (n, p) = (context.model().states.len(), context.model().parameters.len());
    let value = body.components(0..n);
    let (dx, dk, dp) = (body.columns(n, 0..n), body.columns(n, n..2 * n), body.columns(n, 2 * n..2 * n + p));
    let (dtau, dt) = (body.column(n, 2 * n + p), body.column(n, 2 * n + p + 1));
    let (arguments, bindings) = rate_argument(context.model(), &body);
    let function = StateFunction {
        name: &names::function("d_residual", name),
        doc: vec![format!("Residual F = M k - f of mode `{name}` with all first derivatives, by columns.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!(model::ResidualJacobian<S, STATES, PARAMETERS>),
        otherwise: quote!(nan_residual_jacobian()),
        result: quote!(model::ResidualJacobian {
            value: #value, dx: #dx, dk: #dk, dp: #dp, dtau: #dtau, dt: #dt,
        }),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn linearised(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Residual(mode), Columns::StateAndRates)?;
    let body = Body::new(context, program);
    let n = context.model().states.len();
    let (value, dx, dk) = (body.components(0..n), body.columns(n, 0..n), body.columns(n, n..2 * n));
    let (arguments, bindings) = rate_argument(context.model(), &body);
    let function = StateFunction {
        name: &names::function("linearised", name),
        doc: vec![format!("Residual F = M k - f of mode `{name}` with its derivatives by state and rate, by columns.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!(model::Linearised<S, STATES>),
        otherwise: quote!(nan_linearised()),
        result: quote!(model::Linearised { value: #value, dx: #dx, dk: #dk }),
    };
    Ok(function.print(context, text::counts(program.counts())))
}

fn embed(context: &Context<'_>, coordinates: &[usize]) -> Result<TokenStream, EmitError> {
    let model = context.model();
    let program = context.program(Quantity::Embed, Columns::Coordinates)?;
    let body = Body::new(context, program);
    let (n, d, p) = (model.states.len(), coordinates.len(), model.parameters.len());
    let z = coordinates.iter().map(|&i| Input::Symbol(Symbol::State(i)));
    let width = text::count(d);
    let otherwise = quote!(return ([nan_state(); #width], [nan_state(); PARAMETERS]));
    let bind_z = body.bind_slice(z, &quote!(z), &otherwise);
    let parameters = parameters(model);
    let name_p = if body.uses_any(&parameters) { quote!(p) } else { quote!(_p) };
    let bind_p = body.bind_array(&parameters, &quote!(p));
    let (statements, dz, dp) = (body.statements(), body.columns(n, 0..d), body.columns(n, d..d + p));
    let doc = text::doc(&[
        "Derivatives of the embedding by section coordinates and parameters, by columns.".to_owned(),
        String::new(),
        text::counts(program.counts()),
    ]);
    Ok(quote! {
        #doc
        fn d_embed<S: scalar::Scalar>(
            z: &[S],
            #name_p: &[S; PARAMETERS],
        ) -> ([[S; STATES]; #width], [[S; STATES]; PARAMETERS]) {
            #bind_z
            #bind_p
            #statements
            (#dz, #dp)
        }
    })
}

fn symmetry(context: &Context<'_>) -> Result<TokenStream, EmitError> {
    let model = context.model();
    let program = context.program(Quantity::Symmetry, Columns::StateAndParameters)?;
    let body = Body::new(context, program);
    let (n, p) = (model.states.len(), model.parameters.len());
    let (states, parameters) = (states(model), parameters(model));
    let name_x = if body.uses_any(&states) { quote!(x) } else { quote!(_x) };
    let name_p = if body.uses_any(&parameters) { quote!(p) } else { quote!(_p) };
    let (bind_x, bind_p) = (body.bind_array(&states, &quote!(x)), body.bind_array(&parameters, &quote!(p)));
    let (statements, value) = (body.statements(), body.components(0..n));
    let (dx, dp) = (body.columns(n, 0..n), body.columns(n, n..n + p));
    let zero = constant(0.0);
    let doc = text::doc(&[
        "Symmetry with its derivatives by state and parameters, by columns.".to_owned(),
        String::new(),
        text::counts(program.counts()),
    ]);
    Ok(quote! {
        #doc
        fn d_symmetry<S: scalar::Scalar>(
            #name_x: &[S; STATES],
            #name_p: &[S; PARAMETERS],
        ) -> model::Jacobian<S, STATES, PARAMETERS> {
            #bind_x
            #bind_p
            #statements
            model::Jacobian { value: #value, dx: #dx, dp: #dp, dtau: [#zero; STATES], dt: [#zero; STATES] }
        }
    })
}

fn measures(context: &Context<'_>) -> Result<TokenStream, EmitError> {
    let model = context.model();
    let (count, f, p) = (model.measures.len(), model.functionals.len(), model.parameters.len());
    let program = context.program(Quantity::Measures, Columns::Functionals)?;
    let body = Body::new(context, program);
    let functionals = (0..f).map(|i| Input::Symbol(Symbol::Functional(i)));
    let (entries, rows) = (text::count(count * f), text::count(count));
    let otherwise = quote!(return ([nan(); #entries], [[nan(); PARAMETERS]; #rows]));
    let bind_functionals = body.bind_slice(functionals, &quote!(functionals), &otherwise);
    let parameters = parameters(model);
    let name_p = if body.uses_any(&parameters) { quote!(p) } else { quote!(_p) };
    let bind_p = body.bind_array(&parameters, &quote!(p));
    let statements = body.statements();
    let by_functional = (0..count).flat_map(|row| (0..f).map(move |column| (row, column)));
    let df: Vec<TokenStream> = by_functional.map(|(row, column)| body.derivative(row, column)).collect();
    let dp: Vec<TokenStream> = (0..count)
        .map(|row| {
            let entries = (f..f + p).map(|column| body.derivative(row, column));
            quote!([#(#entries),*])
        })
        .collect();
    let doc = text::doc(&[
        format!(
            "Derivatives of the {count} measures: by the {f} functionals, one row a measure, and by the parameters."
        ),
        String::new(),
        text::counts(program.counts()),
    ]);
    Ok(quote! {
        #doc
        fn d_measures<S: scalar::Scalar>(
            functionals: &[S],
            #name_p: &[S; PARAMETERS],
        ) -> ([S; #entries], [[S; PARAMETERS]; #rows]) {
            #bind_functionals
            #bind_p
            #statements
            ([#(#df),*], [#(#dp),*])
        }
    })
}
