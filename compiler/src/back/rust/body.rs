//! The body of a generated function: inputs bound to names, one `let` a shared value.

use super::{Context, names, text};
use crate::casadi::Program;
use crate::casadi::exchange::Input;
use crate::casadi::program::{Binary, Logic, Operation, Unary, Value};
use crate::ir::Symbol;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeSet, HashMap};

/// A program as Rust tokens.
pub(super) struct Body<'a> {
    context: &'a Context<'a>,
    program: &'a Program,
    /// How each value is written where it is used.
    uses: Vec<TokenStream>,
    /// The shared values.
    statements: Vec<TokenStream>,
    /// Inputs that occur.
    inputs: BTreeSet<Input>,
    /// Nonzero derivatives by row and column.
    entries: HashMap<(usize, usize), Value>,
}

impl<'a> Body<'a> {
    pub(super) fn new(context: &'a Context<'a>, program: &'a Program) -> Self {
        let entries = program.jacobian.iter().map(|entry| ((entry.row, entry.column), entry.value)).collect();
        let mut body =
            Self { context, program, uses: Vec::new(), statements: Vec::new(), inputs: BTreeSet::new(), entries };
        for &operation in &program.operations {
            let tokens = body.operation(operation);
            body.uses.push(tokens);
        }
        body
    }

    /// How an operation's value is written; one that is computed gets a `let` first.
    fn operation(&mut self, operation: Operation) -> TokenStream {
        let (context, arg) = (self.context, |value: Value| self.uses.get(value).cloned().unwrap_or_default());
        let expression = match operation {
            Operation::Constant(bits) => return constant(f64::from_bits(bits)),
            Operation::Input(i) | Operation::Truth(i) => {
                let Some(&input) = context.inputs.get(i) else { return quote!(nan()) };
                self.inputs.insert(input);
                let name = names::input(context.model(), input);
                return quote!(#name);
            }
            Operation::Unary(op, a) => unary(op, &arg(a)),
            Operation::Binary(op, a, b) => binary(op, &arg(a), &arg(b)),
            Operation::Logic(op, a, b) => logic(op, &arg(a), &arg(b)),
            Operation::Not(a) => {
                let a = arg(a);
                quote!(S::not(#a))
            }
            Operation::Select(mask, a, b) => {
                let (mask, a, b) = (arg(mask), arg(a), arg(b));
                quote!(S::select(#mask, #a, #b))
            }
        };
        let name = format_ident!("v{}", self.statements.len());
        self.statements.push(quote!(let #name = #expression;));
        quote!(#name)
    }

    /// The shared values, one `let` each.
    pub(super) fn statements(&self) -> TokenStream {
        let statements = &self.statements;
        quote!(#(#statements)*)
    }

    /// Component `row` of the value.
    pub(super) fn component(&self, row: usize) -> TokenStream {
        self.program.values.get(row).map_or_else(|| constant(0.0), |&value| self.written(value))
    }

    /// Components of the value.
    pub(super) fn components(&self, rows: std::ops::Range<usize>) -> TokenStream {
        let components = rows.map(|row| self.component(row));
        quote!([#(#components),*])
    }

    /// A derivative; a constant zero where it is structurally zero.
    pub(super) fn derivative(&self, row: usize, column: usize) -> TokenStream {
        self.entries.get(&(row, column)).map_or_else(|| constant(0.0), |&value| self.written(value))
    }

    /// A column of the Jacobian, all `rows`.
    pub(super) fn column(&self, rows: usize, column: usize) -> TokenStream {
        let entries = (0..rows).map(|row| self.derivative(row, column));
        quote!([#(#entries),*])
    }

    /// Several columns of the Jacobian as an array of columns.
    pub(super) fn columns(&self, rows: usize, columns: std::ops::Range<usize>) -> TokenStream {
        let columns = columns.map(|column| self.column(rows, column));
        quote!([#(#columns),*])
    }

    /// How a value is written.
    pub(super) fn written(&self, value: Value) -> TokenStream {
        self.uses.get(value).cloned().unwrap_or_else(|| quote!(nan()))
    }

    /// Binds states, or another list of symbols that are elements of the array `source`; nothing when none occurs.
    pub(super) fn bind_array(&self, symbols: &[Symbol], source: &TokenStream) -> TokenStream {
        if !self.uses_any(symbols) {
            return quote!();
        }
        let names = self.pattern(symbols.iter().map(|&symbol| Input::Symbol(symbol)));
        quote!(let &[#(#names),*] = #source;)
    }

    /// Binds the elements of the slice `source`, with another way out when its length is wrong.
    pub(super) fn bind_slice(
        &self,
        inputs: impl Iterator<Item = Input>,
        source: &TokenStream,
        otherwise: &TokenStream,
    ) -> TokenStream {
        let names = self.pattern(inputs);
        quote!(let &[#(#names),*] = #source else { #otherwise };)
    }

    /// Whether any of some symbols occurs.
    pub(super) fn uses_any(&self, symbols: &[Symbol]) -> bool {
        symbols.iter().any(|&symbol| self.inputs.contains(&Input::Symbol(symbol)))
    }

    /// Binds parameters, times, memory and selectors of `env`.
    pub(super) fn bind_env(&self, otherwise: &TokenStream) -> TokenStream {
        let model = self.context.model();
        let parameters: Vec<Symbol> = (0..model.parameters.len()).map(Symbol::Parameter).collect();
        let parameters = self.bind_array(&parameters, &quote!(env.p));
        let tau = self.uses_any(&[Symbol::Tau]).then(|| quote!(let tau = env.tau;));
        let t = self.uses_any(&[Symbol::Time]).then(|| quote!(let t = env.t;));
        let memory = (0..model.memory.len()).map(|i| Input::Symbol(Symbol::Memory(i)));
        let memory = self.bind_slice(memory, &quote!(env.memory), otherwise);
        let branch = self.bind_slice((0..model.switches.len()).map(Input::Branch), &quote!(env.branch), otherwise);
        quote!(#memory #branch #parameters #tau #t)
    }

    fn pattern(&self, inputs: impl Iterator<Item = Input>) -> Vec<TokenStream> {
        inputs
            .map(|input| {
                if self.inputs.contains(&input) {
                    let name: Ident = names::input(self.context.model(), input);
                    quote!(#name)
                } else {
                    quote!(_)
                }
            })
            .collect()
    }
}

/// A constant in every lane.
pub(super) fn constant(value: f64) -> TokenStream {
    let number = text::number(value);
    quote!(S::constant(#number))
}

fn unary(op: Unary, a: &TokenStream) -> TokenStream {
    let name = match op {
        Unary::Neg => return quote!(-#a),
        Unary::Sin => "sin",
        Unary::Cos => "cos",
        Unary::Tan => "tan",
        Unary::Asin => "asin",
        Unary::Acos => "acos",
        Unary::Atan => "atan",
        Unary::Sinh => "sinh",
        Unary::Cosh => "cosh",
        Unary::Tanh => "tanh",
        Unary::Asinh => "asinh",
        Unary::Acosh => "acosh",
        Unary::Atanh => "atanh",
        Unary::Exp => "exp",
        Unary::Ln => "ln",
        Unary::Sqrt => "sqrt",
        Unary::Abs => "abs",
        Unary::Signum => "signum",
    };
    let name = format_ident!("{name}");
    quote!(#a.#name())
}

fn binary(op: Binary, a: &TokenStream, b: &TokenStream) -> TokenStream {
    match op {
        Binary::Add => quote!(#a + #b),
        Binary::Sub => quote!(#a - #b),
        Binary::Mul => quote!(#a * #b),
        Binary::Div => quote!(#a / #b),
        Binary::Pow => quote!(#a.pow(#b)),
        Binary::Atan2 => quote!(#a.atan2(#b)),
    }
}

fn logic(op: Logic, a: &TokenStream, b: &TokenStream) -> TokenStream {
    match op {
        Logic::Less => quote!(#a.less(#b)),
        Logic::LessEqual => quote!(#a.less_equal(#b)),
        Logic::And => quote!(S::and(#a, #b)),
        Logic::Or => quote!(S::or(#a, #b)),
    }
}
