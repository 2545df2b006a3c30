//! Straight-line programs in single-assignment form: what the emitter prints.

use std::collections::HashMap;

/// Index of a value of a [`Program`].
pub type Value = usize;

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // the names say it
pub enum Unary {
    Neg,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
    Signum,
}

/// A function of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // the names say it
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
    Atan2,
}

/// A function whose value is a truth value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Logic {
    /// First number smaller than the second.
    Less,
    /// First number not larger than the second.
    LessEqual,
    /// Both truth values.
    And,
    /// At least one truth value.
    Or,
}

/// A product and a term, rounded once where the processor can do that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fused {
    /// a*b + c
    MulAdd,
    /// a*b - c
    MulSub,
    /// c - a*b
    NegMulAdd,
}

/// How a value comes about. Operands have smaller indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// The bits of a constant.
    Constant(u64),
    /// An input that is a number, by its position.
    Input(usize),
    /// An input that is a truth value, by its position.
    Truth(usize),
    /// A number that was computed before, by its position among the terms of [`super::hoist::Hoisted::clock`].
    Term(usize),
    /// Number from number.
    Unary(Unary, Value),
    /// Number from two numbers.
    Binary(Binary, Value, Value),
    /// Number from the two factors and the term.
    Fused(Fused, Value, Value, Value),
    /// Truth value from two numbers or two truth values.
    Logic(Logic, Value, Value),
    /// The opposite truth value.
    Not(Value),
    /// The second where the first, a truth value, holds, else the third.
    Select(Value, Value, Value),
}

impl Operation {
    /// Constant of a number.
    pub fn constant(value: f64) -> Self {
        Self::Constant(value.to_bits())
    }

    /// What it is computed from.
    pub fn operands(self) -> impl Iterator<Item = Value> {
        let [a, b, c] = match self {
            Self::Constant(_) | Self::Input(_) | Self::Truth(_) | Self::Term(_) => [None; 3],
            Self::Unary(_, a) | Self::Not(a) => [Some(a), None, None],
            Self::Binary(_, a, b) | Self::Logic(_, a, b) => [Some(a), Some(b), None],
            Self::Fused(_, a, b, c) | Self::Select(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        [a, b, c].into_iter().flatten()
    }

    /// The same operation on other values.
    #[must_use]
    pub fn with_operands(self, new: impl Fn(Value) -> Value) -> Self {
        match self {
            Self::Constant(_) | Self::Input(_) | Self::Truth(_) | Self::Term(_) => self,
            Self::Unary(op, a) => Self::Unary(op, new(a)),
            Self::Binary(op, a, b) => Self::Binary(op, new(a), new(b)),
            Self::Fused(op, a, b, c) => Self::Fused(op, new(a), new(b), new(c)),
            Self::Logic(op, a, b) => Self::Logic(op, new(a), new(b)),
            Self::Not(a) => Self::Not(new(a)),
            Self::Select(a, b, c) => Self::Select(new(a), new(b), new(c)),
        }
    }

    /// Whether it is a truth value, not a number.
    pub fn is_truth(self) -> bool {
        matches!(self, Self::Truth(_) | Self::Logic(..) | Self::Not(_))
    }
}

/// An entry of a Jacobian that is not structurally zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Component of the value.
    pub row: usize,
    /// Position among the symbols that the function is differentiated by.
    pub column: usize,
    /// The derivative.
    pub value: Value,
}

/// A straight-line program: values, of which some are the result.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// All values, operands first.
    pub operations: Vec<Operation>,
    /// Components of the value.
    pub values: Vec<Value>,
    /// Nonzeros of the Jacobian.
    pub jacobian: Vec<Entry>,
}

/// How many operations of which kind a program has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Additions, subtractions, negations.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Products with a term, as one operation.
    pub fused: usize,
    /// Divisions.
    pub divisions: usize,
    /// Sines, powers and other functions; sine and cosine of the same angle count once.
    pub functions: usize,
    /// Selections between two values.
    pub selections: usize,
}

impl Program {
    /// The number, if a value is a constant.
    pub fn constant_value(&self, value: Value) -> Option<f64> {
        match self.operations.get(value) {
            Some(Operation::Constant(bits)) => Some(f64::from_bits(*bits)),
            _ => None,
        }
    }

    /// Which values the results depend on.
    pub fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.operations.len()];
        let results = self.values.iter().copied().chain(self.jacobian.iter().map(|entry| entry.value));
        let mark = |live: &mut Vec<bool>, value: Value| {
            if let Some(flag) = live.get_mut(value) {
                *flag = true;
            }
        };
        results.for_each(|value| mark(&mut live, value));
        for (value, operation) in self.operations.iter().enumerate().rev() {
            if live.get(value) == Some(&true) {
                operation.operands().for_each(|operand| mark(&mut live, operand));
            }
        }
        live
    }

    /// The same program without values that no result depends on.
    #[must_use]
    pub fn without_dead_values(&self) -> Self {
        let live = self.live();
        let mut number = vec![0; self.operations.len()];
        let mut operations = Vec::new();
        for ((&operation, &live), slot) in self.operations.iter().zip(&live).zip(0..) {
            if live {
                let renumbered = operation.with_operands(|value| number.get(value).copied().unwrap_or_default());
                if let Some(new) = number.get_mut(slot) {
                    *new = operations.len();
                }
                operations.push(renumbered);
            }
        }
        let new = |value: Value| number.get(value).copied().unwrap_or_default();
        Self {
            operations,
            values: self.values.iter().map(|&value| new(value)).collect(),
            jacobian: self.jacobian.iter().map(|entry| Entry { value: new(entry.value), ..*entry }).collect(),
        }
    }

    /// The sine of each cosine, and the cosine of each sine, where the program has both.
    pub fn pairs(&self) -> HashMap<Value, Value> {
        let of = |wanted: Unary| {
            self.operations.iter().enumerate().filter_map(move |(value, &operation)| match operation {
                Operation::Unary(op, angle) if op == wanted => Some((angle, value)),
                _ => None,
            })
        };
        let cosines: HashMap<Value, Value> = of(Unary::Cos).collect();
        let both = of(Unary::Sin).filter_map(|(angle, sine)| Some((sine, *cosines.get(&angle)?)));
        both.flat_map(|(sine, cosine)| [(sine, cosine), (cosine, sine)]).collect()
    }

    /// Operation counts.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        let pairs = self.pairs();
        for (value, operation) in self.operations.iter().enumerate() {
            match operation {
                Operation::Unary(Unary::Cos, _) if pairs.contains_key(&value) => {}
                Operation::Binary(Binary::Add | Binary::Sub, ..) | Operation::Unary(Unary::Neg, _) => {
                    counts.additions += 1;
                }
                Operation::Binary(Binary::Mul, ..) => counts.multiplications += 1,
                Operation::Binary(Binary::Div, ..) => counts.divisions += 1,
                Operation::Fused(..) => counts.fused += 1,
                Operation::Binary(..) | Operation::Unary(..) => counts.functions += 1,
                Operation::Select(..) => counts.selections += 1,
                _ => {}
            }
        }
        counts
    }
}

/// Builds programs: equal values are shared, and a few rewritings that do not change a result's rounding are made.
#[derive(Debug, Default)]
pub(super) struct Builder {
    operations: Vec<Operation>,
    known: HashMap<Operation, Value>,
}

impl Builder {
    pub(super) fn finish(self, values: Vec<Value>, jacobian: Vec<Entry>) -> Program {
        Program { operations: self.operations, values, jacobian }.without_dead_values()
    }

    pub(super) fn get(&self, value: Value) -> Option<Operation> {
        self.operations.get(value).copied()
    }

    pub(super) fn constant(&mut self, value: f64) -> Value {
        self.add(Operation::constant(value))
    }

    /// Adds an operation, or finds an equal or simpler value.
    pub(super) fn add(&mut self, operation: Operation) -> Value {
        let operation = match self.simplified(operation) {
            Ok(operation) => operation,
            Err(value) => return value,
        };
        if let Some(&value) = self.known.get(&operation) {
            return value;
        }
        let value = self.operations.len();
        self.operations.push(operation);
        self.known.insert(operation, value);
        value
    }

    /// A simpler operation, or (`Err`) a value that is there already.
    fn simplified(&self, operation: Operation) -> Result<Operation, Value> {
        match operation {
            Operation::Not(a) => match self.get(a) {
                Some(Operation::Not(inner)) => Err(inner),
                _ => Ok(operation),
            },
            Operation::Select(_, b, c) if b == c => Err(b),
            Operation::Select(mask, b, c) => Ok(match self.get(mask) {
                Some(Operation::Not(opposite)) => Operation::Select(opposite, c, b),
                _ => operation,
            }),
            Operation::Unary(Unary::Neg, a) => match self.get(a) {
                Some(Operation::Unary(Unary::Neg, inner)) => Err(inner),
                _ => Ok(operation),
            },
            Operation::Binary(Binary::Add, a, b) => Ok(self.sum(a, b)),
            Operation::Binary(Binary::Sub, a, b) => Ok(match self.get(b) {
                Some(Operation::Unary(Unary::Neg, inner)) => Operation::Binary(Binary::Add, a, inner),
                _ => operation,
            }),
            _ => Ok(operation),
        }
    }

    /// a + b, where the two halves of a choice become one selection again, and negated terms a difference.
    fn sum(&self, a: Value, b: Value) -> Operation {
        match (self.get(a), self.get(b)) {
            (Some(Operation::Select(c, then, zero)), Some(Operation::Select(d, also_zero, otherwise)))
                if c == d && self.is_zero(zero) && self.is_zero(also_zero) =>
            {
                Operation::Select(c, then, otherwise)
            }
            (Some(Operation::Select(c, zero, otherwise)), Some(Operation::Select(d, then, also_zero)))
                if c == d && self.is_zero(zero) && self.is_zero(also_zero) =>
            {
                Operation::Select(c, then, otherwise)
            }
            (_, Some(Operation::Unary(Unary::Neg, inner))) => Operation::Binary(Binary::Sub, a, inner),
            (Some(Operation::Unary(Unary::Neg, inner)), _) => Operation::Binary(Binary::Sub, b, inner),
            _ => Operation::Binary(Binary::Add, a, b),
        }
    }

    fn is_zero(&self, value: Value) -> bool {
        matches!(self.get(value), Some(Operation::Constant(bits)) if f64::from_bits(bits) == 0.0)
    }
}
