//! The body of a generated function: inputs bound to names, one `let` a shared value.

use super::{Context, names, text};
use crate::casadi::Program;
use crate::casadi::exchange::Input;
use crate::casadi::program::{Binary, Fused, Logic, Operation, Unary, Value};
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
    /// How many names they have.
    names: usize,
    /// Inputs that occur.
    inputs: BTreeSet<Input>,
    /// Terms computed before that occur.
    terms: BTreeSet<usize>,
    /// Nonzero derivatives by row and column.
    entries: HashMap<(usize, usize), Value>,
}

impl<'a> Body<'a> {
    pub(super) fn new(context: &'a Context<'a>, program: &'a Program) -> Self {
        let entries = program.jacobian.iter().map(|entry| ((entry.row, entry.column), entry.value)).collect();
        let mut body = Self {
            context,
            program,
            uses: Vec::new(),
            statements: Vec::new(),
            names: 0,
            inputs: BTreeSet::new(),
            terms: BTreeSet::new(),
            entries,
        };
        let (pairs, mut known) = (program.pairs(), HashMap::new());
        for (value, &operation) in program.operations.iter().enumerate() {
            let tokens = match (known.remove(&value), pairs.get(&value)) {
                (Some(tokens), _) => tokens,
                (None, Some(&other)) => {
                    let (tokens, others) = body.pair(operation);
                    known.insert(other, others);
                    tokens
                }
                (None, None) => body.operation(operation),
            };
            body.uses.push(tokens);
        }
        body
    }

    /// Computes sine and cosine of the same angle together, given one of them; both as they are written, that one first.
    fn pair(&mut self, operation: Operation) -> (TokenStream, TokenStream) {
        let Operation::Unary(op, angle) = operation else { return (quote!(nan()), quote!(nan())) };
        let n = self.names;
        let angle = self.written(angle);
        let (first, second) = (format_ident!("v{n}"), format_ident!("v{}", n + 1));
        self.names += 2;
        let (sine, cosine) = if op == Unary::Sin { (&first, &second) } else { (&second, &first) };
        self.statements.push(quote!(let (#sine, #cosine) = #angle.sin_cos();));
        (quote!(#first), quote!(#second))
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
            Operation::Term(i) => {
                self.terms.insert(i);
                let name = names::term(i);
                return quote!(#name);
            }
            Operation::Unary(op, a) => unary(op, &arg(a)),
            Operation::Binary(op, a, b) => binary(op, &arg(a), &arg(b)),
            Operation::Fused(Fused::MulAdd, a, b, c) => {
                let (a, b, c) = (arg(a), arg(b), arg(c));
                quote!(#a.mul_add(#b, #c))
            }
            Operation::Fused(Fused::MulSub, a, b, c) => {
                let (a, b, c) = (arg(a), arg(b), self.negated(c));
                quote!(#a.mul_add(#b, #c))
            }
            Operation::Fused(Fused::NegMulAdd, a, b, c) => {
                // The sign of a constant costs nothing.
                let (a, b) = if self.program.constant_value(b).is_some() { (b, a) } else { (a, b) };
                let (negated, b, c) = (self.negated(a), arg(b), arg(c));
                match self.program.constant_value(a) {
                    Some(_) => quote!(#negated.mul_add(#b, #c)),
                    None => quote!((#negated).mul_add(#b, #c)),
                }
            }
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
        let name = format_ident!("v{}", self.names);
        self.names += 1;
        self.statements.push(quote!(let #name = #expression;));
        quote!(#name)
    }

    /// A value with the other sign.
    fn negated(&self, value: Value) -> TokenStream {
        let written = self.written(value);
        self.program.constant_value(value).map_or_else(|| quote!(-#written), |number| constant(-number))
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

    /// Binds the terms computed before, elements of the array `clock` of this length.
    pub(super) fn bind_terms(&self, length: usize) -> TokenStream {
        let names = (0..length).map(|i| {
            let name = names::term(i);
            if self.terms.contains(&i) { quote!(#name) } else { quote!(_) }
        });
        quote!(let &[#(#names),*] = clock;)
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
