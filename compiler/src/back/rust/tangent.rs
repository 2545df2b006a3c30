//! The hot path: flow and integrands fused with any number of variational columns, and the integrands alone along
//! directions.
//!
//! The values and the nonzero derivatives are computed once, as one straight-line program; then each column c gets the
//! sparse product (d./dx) v_c + (d./dp) w_c, with structurally nonzero entries only.

use super::body::{Body, constant};
use super::measured::{integrands_name, optional_rates};
use super::values::{StateFunction, parameters, states};
use super::{Context, EmitError, names, text};
use crate::casadi::Quantity;
use crate::casadi::functions::{Columns, along, integrand_modes};
use crate::casadi::program::{Counts, Program};
use crate::ir::Symbol;
use proc_macro2::TokenStream;
use quote::quote;

/// All fused functions of a model.
pub(super) fn functions(context: &Context<'_>) -> Result<Vec<TokenStream>, EmitError> {
    let mut items = Vec::new();
    if context.validated.facts().explicit {
        for (i, mode) in context.model().modes.iter().enumerate() {
            items.push(flow(context, i, &mode.name)?);
            items.push(integrated(context, i, &mode.name)?);
        }
    }
    for mode in integrand_modes(context.validated) {
        items.push(integrands(context, mode)?);
    }
    Ok(items)
}

fn flow(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Flow(mode), Columns::State)?;
    let body = Body::new(context, program);
    let n = context.model().states.len();
    let products = Products::new(context, &body, program, Columns::State);
    let (value, rows) = (body.components(0..n), products.rows(0..n));
    let column = products.pattern(&states(context.model()));
    let zero = constant(0.0);
    let function = StateFunction {
        name: &names::function("tangent_flow", name),
        doc: vec![format!("State derivative f of mode `{name}` and, for each column v, (df/dx) v.")],
        body: &body,
        arguments: quote!(columns: &[[S; STATES]; C],),
        bindings: quote!(),
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
    Ok(with_columns(function.print(context, products.counts()), &quote!(#[inline])))
}

fn integrated(context: &Context<'_>, mode: usize, name: &str) -> Result<TokenStream, EmitError> {
    let program = context.program(Quantity::Integrated(mode), Columns::StateAndParameters)?;
    let body = Body::new(context, program);
    let (n, q) = (context.model().states.len(), context.validated.facts().integrals.len());
    let products = Products::new(context, &body, program, Columns::StateAndParameters);
    let (flow, integrands) = (body.components(0..n), body.components(n..n + q));
    let (dflow, dintegrands) = (products.rows(0..n), products.rows(n..n + q));
    let (dx, dp) = (products.pattern(&states(context.model())), products.pattern(&parameters(context.model())));
    let zero = constant(0.0);
    let function = StateFunction {
        name: &names::function("tangent_integrated", name),
        doc: vec![
            format!("State derivative f and integrands of mode `{name}` and, for each column (v, w),"),
            "(d./dx) v + (d./dp) w.".to_owned(),
        ],
        body: &body,
        arguments: quote!(dx: &[[S; STATES]; C], dp: &[[S; PARAMETERS]; C],),
        bindings: quote!(),
        returns: quote!(model::Integrated<S, STATES, INTEGRALS, C>),
        otherwise: quote!(model::Integrated {
            flow: nan_state(),
            integrands: [nan(); INTEGRALS],
            dflow: [nan_state(); C],
            dintegrands: [[nan(); INTEGRALS]; C],
        }),
        result: quote! {
            let mut dflow = [[#zero; STATES]; C];
            let mut dintegrands = [[#zero; INTEGRALS]; C];
            let results = dflow.iter_mut().zip(dintegrands.iter_mut());
            for ((dflow, dintegrands), (dx, dp)) in results.zip(dx.iter().zip(dp)) {
                let &#dx = dx;
                let &#dp = dp;
                *dflow = #dflow;
                *dintegrands = #dintegrands;
            }
            model::Integrated { flow: #flow, integrands: #integrands, dflow, dintegrands }
        },
    };
    Ok(with_columns(function.print(context, products.counts()), &quote!(#[inline])))
}

fn integrands(context: &Context<'_>, mode: Option<usize>) -> Result<TokenStream, EmitError> {
    let (model, by) = (context.model(), along(context.validated));
    let program = context.program(Quantity::Integrands(mode), by)?;
    let body = Body::new(context, program);
    let q = context.validated.facts().integrals.len();
    let products = Products::new(context, &body, program, by);
    let (values, rows) = (body.components(0..q), products.rows(0..q));
    let (name, place) = integrands_name(model, "tangent_integrands", mode);
    let rates: Vec<Symbol> = (0..model.states.len()).map(Symbol::Rate).collect();
    let [dx, dk, dp] = [states(model), rates, parameters(model)].map(|symbols| products.element(&symbols));
    let dt = if products.uses(Symbol::Time) { quote!(&dt) } else { quote!(_) };
    let zero = constant(0.0);
    let (mut arguments, bindings) = optional_rates(context, &body);
    arguments.extend(quote!(along: &model::Directions<'_, S, STATES, PARAMETERS, C>,));
    let function = StateFunction {
        name: &name,
        doc: vec![format!("The integrands{place} and their derivatives along each direction.")],
        body: &body,
        arguments,
        bindings,
        returns: quote!(([S; INTEGRALS], [[S; INTEGRALS]; C])),
        otherwise: quote!(([nan(); INTEGRALS], [[nan(); INTEGRALS]; C])),
        result: quote! {
            let mut products = [[#zero; INTEGRALS]; C];
            let directions = along.dx.iter().zip(along.dk).zip(along.dp).zip(along.dt);
            for (product, (((#dx, #dk), #dp), #dt)) in products.iter_mut().zip(directions) {
                *product = #rows;
            }
            (#values, products)
        },
    };
    Ok(with_columns(function.print(context, products.counts()), &quote!(#[inline])))
}

/// Makes a printed function generic over the number of columns, with an attribute that lets it be inlined.
pub(super) fn with_columns(function: TokenStream, inline: &TokenStream) -> TokenStream {
    // The printer of state functions knows one type parameter; the number of columns is added in the tree, not the text.
    match syn::parse2::<syn::ItemFn>(function.clone()) {
        Ok(mut item) => {
            item.sig.generics.params.push(syn::parse_quote!(const C: usize));
            item.attrs.push(syn::parse_quote!(#inline));
            quote!(#item)
        }
        // What does not parse is reported where the file is formatted.
        Err(_) => function,
    }
}

/// The sparse products of a program's Jacobian with a column.
pub(super) struct Products<'a> {
    context: &'a Context<'a>,
    body: &'a Body<'a>,
    program: &'a Program,
    symbols: Vec<Symbol>,
}

impl<'a> Products<'a> {
    pub(super) fn new(context: &'a Context<'a>, body: &'a Body<'a>, program: &'a Program, by: Columns) -> Self {
        Self { context, body, program, symbols: by.symbols(context.model()) }
    }

    /// Rows of the product as an array.
    pub(super) fn rows(&self, rows: std::ops::Range<usize>) -> TokenStream {
        let rows = rows.map(|row| self.row(row));
        quote!([#(#rows),*])
    }

    /// One row: the sum of its nonzero derivatives times the column's components.
    fn row(&self, row: usize) -> TokenStream {
        let mut sum: Option<TokenStream> = None;
        for entry in self.program.jacobian.iter().filter(|entry| entry.row == row) {
            let Some(&symbol) = self.symbols.get(entry.column) else { continue };
            let variation = names::variation(self.context.model(), symbol);
            let factor = self.program.constant_value(entry.value);
            let written = self.body.written(entry.value);
            sum = Some(match (sum, factor) {
                (None, Some(1.0)) => quote!(#variation),
                (None, Some(-1.0)) => quote!(-#variation),
                (None, _) => quote!(#written * #variation),
                (Some(sum), Some(1.0)) => quote!(#sum + #variation),
                (Some(sum), Some(-1.0)) => quote!(#sum - #variation),
                (Some(sum), _) => quote!(#written.mul_add(#variation, #sum)),
            });
        }
        sum.unwrap_or_else(|| constant(0.0))
    }

    /// Whether the variation of a symbol occurs in a product.
    fn uses(&self, symbol: Symbol) -> bool {
        self.program.jacobian.iter().any(|entry| self.symbols.get(entry.column) == Some(&symbol))
    }

    /// The pattern for a reference to a column; `_` when none of its components occurs.
    fn element(&self, symbols: &[Symbol]) -> TokenStream {
        let pattern = self.pattern(symbols);
        if symbols.iter().any(|&symbol| self.uses(symbol)) { quote!(&#pattern) } else { quote!(_) }
    }

    /// The pattern that binds the components of a column that occur in a product.
    pub(super) fn pattern(&self, symbols: &[Symbol]) -> TokenStream {
        let names = symbols.iter().map(|symbol| {
            if self.uses(*symbol) {
                let name = names::variation(self.context.model(), *symbol);
                quote!(#name)
            } else {
                quote!(_)
            }
        });
        quote!([#(#names),*])
    }

    /// Operation counts of the shared part, and of each column.
    pub(super) fn counts(&self) -> String {
        let mut column = Counts::default();
        for row in 0..self.program.values.len() {
            for (i, entry) in self.program.jacobian.iter().filter(|entry| entry.row == row).enumerate() {
                match (i, self.program.constant_value(entry.value)) {
                    (0, Some(1.0)) => {}
                    (_, Some(1.0 | -1.0)) => column.additions += 1,
                    (0, _) => column.multiplications += 1,
                    _ => column.fused += 1,
                }
            }
        }
        format!("Once: {} A column: {}", text::counts(self.program.counts()), text::counts(column))
    }
}
