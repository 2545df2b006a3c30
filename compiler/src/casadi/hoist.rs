//! A function of the state in two parts: terms that stay the same while only the state changes (they depend on the clock,
//! on parameters, memory and selectors), and the rest, which is evaluated at every state.
//!
//! On the way factors that stay the same are drawn together, so that as little as possible is left for the rest: values
//! are kept as a constant times a moving core. k (x/c) becomes (k/c) x, a choice between k x and 0 is a chosen factor
//! times x, and a division by what stays is a product with its reciprocal. Results agree with those of the undivided
//! program to rounding.

use super::program::{Binary, Builder, Entry, Operation, Program, Unary, Value};
use std::collections::HashMap;

/// The two parts of a program.
#[derive(Clone, Debug, Default)]
pub struct Hoisted {
    /// What stays the same: its values are the terms.
    pub clock: Program,
    /// The rest: the original's results, with [`Operation::Term`] for the terms.
    pub rest: Program,
}

impl Program {
    /// Divides a program. `moves` says which inputs, by position, change while the terms are kept.
    #[must_use]
    pub fn hoisted(&self, moves: impl Fn(usize) -> bool) -> Hoisted {
        let mut rewriter = Rewriter::new(self, &moves);
        for (value, &operation) in self.operations.iter().enumerate() {
            let form = rewriter.operation(value, operation);
            rewriter.forms.push(form);
        }
        let values = self.values.iter().map(|&value| rewriter.written(value)).collect();
        let entry = |entry: &Entry| Entry { value: rewriter.written(entry.value), ..*entry };
        let jacobian = self.jacobian.iter().map(entry).collect();
        divide(&rewriter.builder.finish(values, jacobian), &moves)
    }
}

/// How a value of the original program is known in the new one.
#[derive(Clone, Copy)]
enum Form {
    /// It stays the same.
    Fixed(Value),
    /// A factor that stays the same (none: 1) times a value that does not.
    Moving(Option<Value>, Value),
}

struct Rewriter<'a> {
    program: &'a Program,
    moves: &'a dyn Fn(usize) -> bool,
    builder: Builder,
    forms: Vec<Form>,
    /// How often each original value is used, and as a divisor.
    uses: Vec<usize>,
    divides: HashMap<Value, usize>,
}

impl<'a> Rewriter<'a> {
    fn new(program: &'a Program, moves: &'a dyn Fn(usize) -> bool) -> Self {
        let mut divides = HashMap::new();
        for operation in &program.operations {
            if let Operation::Binary(Binary::Div, _, divisor) = operation {
                *divides.entry(*divisor).or_insert(0) += 1;
            }
        }
        let builder = Builder::default();
        Self { program, moves, builder, forms: Vec::new(), uses: program.uses(), divides }
    }

    /// The form of an operation of the original.
    fn operation(&mut self, value: Value, operation: Operation) -> Form {
        match operation {
            Operation::Input(i) | Operation::Truth(i) if (self.moves)(i) => {
                Form::Moving(None, self.builder.add(operation))
            }
            Operation::Unary(Unary::Neg, a) => self.negative(a),
            Operation::Binary(Binary::Mul, a, b) => self.product(a, b),
            Operation::Binary(Binary::Div, a, b) => self.quotient(a, b),
            Operation::Select(mask, then, otherwise) => self.choice(value, mask, then, otherwise),
            _ => self.plain(value),
        }
    }

    /// The operation as it stands.
    fn plain(&mut self, value: Value) -> Form {
        let Some(&operation) = self.program.operations.get(value) else { return self.fixed(f64::NAN) };
        let moving = operation.operands().any(|operand| matches!(self.form(operand), Form::Moving(..)));
        let operands: HashMap<Value, Value> = operation.operands().map(|v| (v, self.written(v))).collect();
        let added = self.builder.add(operation.with_operands(|v| operands.get(&v).copied().unwrap_or_default()));
        if moving { Form::Moving(None, added) } else { Form::Fixed(added) }
    }

    fn negative(&mut self, a: Value) -> Form {
        match self.form(a) {
            Form::Fixed(value) => Form::Fixed(self.negated(value)),
            Form::Moving(None, core) => match self.negated_sum(a) {
                Some(sum) => Form::Moving(None, sum),
                None => Form::Moving(None, self.negated(core)),
            },
            Form::Moving(Some(factor), core) => Form::Moving(Some(self.negated(factor)), core),
        }
    }

    /// -(k a + l b) with the factors negated instead, where nothing else needs the sum.
    fn negated_sum(&mut self, sum: Value) -> Option<Value> {
        let Some(&Operation::Binary(op @ (Binary::Add | Binary::Sub), a, b)) = self.program.operations.get(sum) else {
            return None;
        };
        if self.uses.get(sum) != Some(&1) {
            return None;
        }
        if op == Binary::Sub {
            let (a, b) = (self.written(a), self.written(b));
            return Some(self.binary(Binary::Sub, b, a));
        }
        let mut opposite = |value: Value| match self.form(value) {
            Form::Fixed(value) => Some(self.negated(value)),
            Form::Moving(Some(factor), core) => {
                let factor = self.negated(factor);
                Some(self.binary(Binary::Mul, factor, core))
            }
            Form::Moving(None, _) => None,
        };
        let (a, b) = (opposite(a)?, opposite(b)?);
        Some(self.binary(Binary::Add, a, b))
    }

    fn product(&mut self, a: Value, b: Value) -> Form {
        match (self.form(a), self.form(b)) {
            (Form::Fixed(a), Form::Fixed(b)) => Form::Fixed(self.binary(Binary::Mul, a, b)),
            (Form::Fixed(k), Form::Moving(factor, core)) | (Form::Moving(factor, core), Form::Fixed(k)) => {
                Form::Moving(Some(self.times(factor, k)), core)
            }
            (Form::Moving(..), Form::Moving(..)) => {
                let ((k, a), (l, b)) = (self.drawn(a), self.drawn(b));
                let factor = match (k, l) {
                    (Some(k), Some(l)) => Some(self.binary(Binary::Mul, k, l)),
                    (factor, None) | (None, factor) => factor,
                };
                Form::Moving(factor, self.binary(Binary::Mul, a, b))
            }
        }
    }

    fn quotient(&mut self, a: Value, b: Value) -> Form {
        let shared = self.divides.get(&b).is_some_and(|&count| count > 1);
        match (self.form(a), self.form(b)) {
            (Form::Fixed(k), Form::Fixed(divisor)) if !shared => Form::Fixed(self.binary(Binary::Div, k, divisor)),
            (Form::Fixed(k), Form::Fixed(divisor)) => {
                let reciprocal = self.reciprocal(divisor);
                Form::Fixed(self.times(Some(k), reciprocal))
            }
            (Form::Moving(factor, core), Form::Fixed(divisor)) => {
                let reciprocal = self.reciprocal(divisor);
                Form::Moving(Some(self.times(factor, reciprocal)), core)
            }
            (Form::Fixed(k), Form::Moving(..)) => {
                let divisor = self.written(b);
                if !shared {
                    return Form::Moving(None, self.binary(Binary::Div, k, divisor));
                }
                let reciprocal = self.reciprocal(divisor);
                if self.is_one(k) { Form::Moving(None, reciprocal) } else { Form::Moving(Some(k), reciprocal) }
            }
            (Form::Moving(..), Form::Moving(..)) => {
                let ((factor, core), divisor) = (self.drawn(a), self.written(b));
                if !shared {
                    return Form::Moving(factor, self.binary(Binary::Div, core, divisor));
                }
                let reciprocal = self.reciprocal(divisor);
                Form::Moving(factor, self.binary(Binary::Mul, core, reciprocal))
            }
        }
    }

    fn choice(&mut self, value: Value, mask: Value, then: Value, otherwise: Value) -> Form {
        let (Form::Fixed(fixed_mask), a, b) = (self.form(mask), self.form(then), self.form(otherwise)) else {
            return self.plain(value);
        };
        let (a, b, core) = match (a, b) {
            (Form::Moving(a, core), Form::Moving(b, other)) if core == other => (self.factor(a), self.factor(b), core),
            // Zero times what is not chosen has to be zero.
            (Form::Moving(a, core), Form::Fixed(zero)) if self.is_zero(zero) && self.is_finite(core) => {
                (self.factor(a), zero, core)
            }
            (Form::Fixed(zero), Form::Moving(b, core)) if self.is_zero(zero) && self.is_finite(core) => {
                (zero, self.factor(b), core)
            }
            _ => return self.plain(value),
        };
        Form::Moving(Some(self.builder.add(Operation::Select(fixed_mask, a, b))), core)
    }

    /// Factor and core of a moving value that only one product needs; what several need is multiplied once.
    fn drawn(&mut self, value: Value) -> (Option<Value>, Value) {
        match self.form(value) {
            Form::Moving(factor, core) if self.uses.get(value) == Some(&1) => (factor, core),
            _ => (None, self.written(value)),
        }
    }

    fn form(&self, value: Value) -> Form {
        // Operands come first, so the form is there.
        self.forms.get(value).copied().unwrap_or(Form::Moving(None, value))
    }

    /// An original value as a value of the new program.
    fn written(&mut self, value: Value) -> Value {
        match self.form(value) {
            Form::Fixed(value) | Form::Moving(None, value) => value,
            Form::Moving(Some(factor), core) => self.binary(Binary::Mul, factor, core),
        }
    }

    fn fixed(&mut self, value: f64) -> Form {
        Form::Fixed(self.builder.constant(value))
    }

    fn binary(&mut self, op: Binary, a: Value, b: Value) -> Value {
        self.builder.add(Operation::Binary(op, a, b))
    }

    /// A factor (none: 1) times another one.
    fn times(&mut self, factor: Option<Value>, k: Value) -> Value {
        match factor {
            Some(factor) if !self.is_one(factor) => self.binary(Binary::Mul, factor, k),
            _ => k,
        }
    }

    fn factor(&mut self, factor: Option<Value>) -> Value {
        factor.unwrap_or_else(|| self.builder.constant(1.0))
    }

    fn negated(&mut self, value: Value) -> Value {
        match self.constant(value) {
            Some(number) => self.builder.constant(-number),
            None => self.builder.add(Operation::Unary(Unary::Neg, value)),
        }
    }

    fn reciprocal(&mut self, divisor: Value) -> Value {
        if let Some(number) = self.constant(divisor) {
            return self.builder.constant(1.0 / number);
        }
        let one = self.builder.constant(1.0);
        self.binary(Binary::Div, one, divisor)
    }

    fn constant(&self, value: Value) -> Option<f64> {
        match self.builder.get(value) {
            Some(Operation::Constant(bits)) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    fn is_one(&self, value: Value) -> bool {
        self.constant(value) == Some(1.0)
    }

    fn is_zero(&self, value: Value) -> bool {
        self.constant(value) == Some(0.0)
    }

    /// Whether a moving value of the new program is finite at every finite state.
    fn is_finite(&self, core: Value) -> bool {
        match self.builder.get(core) {
            Some(Operation::Input(i)) => (self.moves)(i),
            Some(Operation::Unary(
                Unary::Neg | Unary::Sin | Unary::Cos | Unary::Atan | Unary::Tanh | Unary::Abs,
                a,
            )) => self.is_finite(a),
            Some(Operation::Binary(Binary::Add | Binary::Sub | Binary::Mul, a, b)) => {
                self.is_finite(a) && self.is_finite(b)
            }
            _ => false,
        }
    }
}

/// Cuts a program where what stays the same meets what does not.
fn divide(program: &Program, moves: &dyn Fn(usize) -> bool) -> Hoisted {
    let mut moving: Vec<bool> = Vec::with_capacity(program.operations.len());
    for operation in &program.operations {
        moving.push(match operation {
            Operation::Input(i) | Operation::Truth(i) => moves(*i),
            _ => operation.operands().any(|operand| moving.get(operand) == Some(&true)),
        });
    }
    let wanted = wanted(program, &moving);
    let mut clock = Program { operations: program.operations.clone(), values: Vec::new(), jacobian: Vec::new() };
    let mut operations = Vec::with_capacity(program.operations.len());
    for (value, (&operation, &moving)) in program.operations.iter().zip(&moving).enumerate() {
        let leaf = matches!(operation, Operation::Constant(_) | Operation::Input(_) | Operation::Truth(_));
        if moving || leaf || operation.is_truth() || wanted.get(value) != Some(&true) {
            operations.push(operation);
        } else {
            operations.push(Operation::Term(clock.values.len()));
            clock.values.push(value);
        }
    }
    let rest = Program { operations, values: program.values.clone(), jacobian: program.jacobian.clone() };
    Hoisted { clock: clock.without_dead_values(), rest: rest.without_dead_values() }
}

/// Which values the rest needs as they are. Truth values are no terms: they are formed again, from numbers that are.
fn wanted(program: &Program, moving: &[bool]) -> Vec<bool> {
    let mut wanted = vec![false; program.operations.len()];
    let results = program.values.iter().copied().chain(program.jacobian.iter().map(|entry| entry.value));
    let mark = |wanted: &mut Vec<bool>, value: Value| {
        if let Some(flag) = wanted.get_mut(value) {
            *flag = true;
        }
    };
    results.for_each(|value| mark(&mut wanted, value));
    for (value, operation) in program.operations.iter().enumerate().rev() {
        let again = moving.get(value) == Some(&true) || (operation.is_truth() && wanted.get(value) == Some(&true));
        if again {
            operation.operands().for_each(|operand| mark(&mut wanted, operand));
        }
    }
    wanted
}

#[cfg(test)]
#[path = "hoist_tests.rs"]
mod tests;
