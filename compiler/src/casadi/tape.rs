//! From CasADi's instruction tape, which reuses registers, to a single-assignment [`Program`].

use super::exchange::{Input, Instruction, Tape};
use super::program::{Binary, Builder, Entry, Logic, Operation, Program, Unary, Value};
use std::collections::HashMap;

/// The program of a tape.
///
/// # Errors
/// When the tape uses an operation that generated code has no word for, or is malformed.
pub fn program(tape: &Tape, inputs: &[Input]) -> Result<Program, String> {
    let mut reader = Reader {
        inputs,
        builder: Builder::default(),
        registers: HashMap::new(),
        values: vec![None; tape.rows],
        nonzeros: vec![None; tape.nonzeros.len()],
    };
    for instruction in &tape.instructions {
        reader.instruction(instruction).ok_or_else(|| format!("cannot read the instruction {instruction:?}"))?;
    }
    reader.finish(tape)
}

struct Reader<'a> {
    inputs: &'a [Input],
    builder: Builder,
    /// The value that each register holds now.
    registers: HashMap<usize, Value>,
    /// The first output; `None` until it is written.
    values: Vec<Option<Value>>,
    /// The second output.
    nonzeros: Vec<Option<Value>>,
}

impl Reader<'_> {
    fn finish(mut self, tape: &Tape) -> Result<Program, String> {
        let (values, nonzeros) = (std::mem::take(&mut self.values), std::mem::take(&mut self.nonzeros));
        let values: Vec<Value> = values.into_iter().map(|value| self.result(value)).collect();
        let mut jacobian = Vec::with_capacity(nonzeros.len());
        for (&(row, column), value) in tape.nonzeros.iter().zip(nonzeros) {
            let value = self.result(value);
            jacobian.push(Entry { row, column, value });
        }
        // Row by row: the order in which the emitter forms products.
        jacobian.sort_by_key(|entry| (entry.row, entry.column));
        jacobian.retain(|entry| self.builder.get(entry.value) != Some(Operation::constant(0.0)));
        Ok(self.builder.finish(values, jacobian))
    }

    /// A result as a number; what CasADi never wrote is a structural zero.
    fn result(&mut self, value: Option<Value>) -> Value {
        match value {
            Some(value) => self.number(value),
            None => self.builder.constant(0.0),
        }
    }

    /// `None` when the instruction makes no sense.
    fn instruction(&mut self, instruction: &Instruction) -> Option<()> {
        if instruction.op == "output" {
            return self.output(instruction);
        }
        let value = match instruction.op.as_str() {
            "input" => self.input(instruction)?,
            "const" => {
                let number = instruction.value.as_ref()?.parse::<f64>().ok()?;
                self.builder.constant(number)
            }
            op => {
                let args: Option<Vec<Value>> =
                    instruction.args.iter().map(|register| self.registers.get(register).copied()).collect();
                match *args?.as_slice() {
                    [a] => self.one(op, a)?,
                    [a, b] => self.two(op, a, b)?,
                    _ => return None,
                }
            }
        };
        self.registers.insert(*instruction.out.first()?, value);
        Some(())
    }

    fn output(&mut self, instruction: &Instruction) -> Option<()> {
        let (&[register], &[output, nonzero]) = (instruction.args.as_slice(), instruction.out.as_slice()) else {
            return None;
        };
        let value = *self.registers.get(&register)?;
        let list = match output {
            0 => &mut self.values,
            1 => &mut self.nonzeros,
            _ => return None,
        };
        *list.get_mut(nonzero)? = Some(value);
        Some(())
    }

    fn input(&mut self, instruction: &Instruction) -> Option<Value> {
        let &[0, position] = instruction.args.as_slice() else { return None };
        let operation = match self.inputs.get(position)? {
            Input::Symbol(_) => Operation::Input(position),
            Input::Branch(_) => Operation::Truth(position),
        };
        Some(self.builder.add(operation))
    }

    fn one(&mut self, op: &str, a: Value) -> Option<Value> {
        if op == "not" {
            let a = self.truth(a);
            return Some(self.builder.add(Operation::Not(a)));
        }
        if op == "assign" {
            return Some(a);
        }
        let a = self.number(a);
        let operation = match op {
            "sq" => Operation::Binary(Binary::Mul, a, a),
            "twice" => Operation::Binary(Binary::Add, a, a),
            "inv" => {
                let one = self.builder.constant(1.0);
                Operation::Binary(Binary::Div, one, a)
            }
            _ => Operation::Unary(unary(op)?, a),
        };
        Some(self.builder.add(operation))
    }

    fn two(&mut self, op: &str, a: Value, b: Value) -> Option<Value> {
        match op {
            "if_else_zero" => {
                let condition = self.truth(a);
                let then = self.number(b);
                let zero = self.builder.constant(0.0);
                Some(self.builder.add(Operation::Select(condition, then, zero)))
            }
            "and" | "or" => {
                let (a, b) = (self.truth(a), self.truth(b));
                let logic = if op == "and" { Logic::And } else { Logic::Or };
                Some(self.builder.add(Operation::Logic(logic, a, b)))
            }
            "lt" | "le" => {
                let (a, b) = (self.number(a), self.number(b));
                let logic = if op == "lt" { Logic::Less } else { Logic::LessEqual };
                Some(self.builder.add(Operation::Logic(logic, a, b)))
            }
            "eq" | "ne" => {
                let (a, b) = (self.number(a), self.number(b));
                let equal = self.equal(a, b);
                Some(if op == "eq" { equal } else { self.builder.add(Operation::Not(equal)) })
            }
            _ => {
                let (a, b) = (self.number(a), self.number(b));
                Some(self.builder.add(Operation::Binary(binary(op)?, a, b)))
            }
        }
    }

    fn equal(&mut self, a: Value, b: Value) -> Value {
        let below = self.builder.add(Operation::Logic(Logic::LessEqual, a, b));
        let above = self.builder.add(Operation::Logic(Logic::LessEqual, b, a));
        self.builder.add(Operation::Logic(Logic::And, below, above))
    }

    /// CasADi knows numbers only; a truth value used as one is 1 or 0.
    fn number(&mut self, value: Value) -> Value {
        if self.builder.get(value).is_some_and(Operation::is_truth) {
            let (one, zero) = (self.builder.constant(1.0), self.builder.constant(0.0));
            self.builder.add(Operation::Select(value, one, zero))
        } else {
            value
        }
    }

    /// A number used as a truth value is true where it is not 0.
    fn truth(&mut self, value: Value) -> Value {
        if self.builder.get(value).is_some_and(Operation::is_truth) {
            return value;
        }
        let zero = self.builder.constant(0.0);
        let equal = self.equal(value, zero);
        self.builder.add(Operation::Not(equal))
    }
}

fn unary(op: &str) -> Option<Unary> {
    Some(match op {
        "neg" => Unary::Neg,
        "sin" => Unary::Sin,
        "cos" => Unary::Cos,
        "tan" => Unary::Tan,
        "asin" => Unary::Asin,
        "acos" => Unary::Acos,
        "atan" => Unary::Atan,
        "sinh" => Unary::Sinh,
        "cosh" => Unary::Cosh,
        "tanh" => Unary::Tanh,
        "asinh" => Unary::Asinh,
        "acosh" => Unary::Acosh,
        "atanh" => Unary::Atanh,
        "exp" => Unary::Exp,
        "log" => Unary::Ln,
        "sqrt" => Unary::Sqrt,
        "fabs" => Unary::Abs,
        "sign" => Unary::Signum,
        _ => return None,
    })
}

fn binary(op: &str) -> Option<Binary> {
    Some(match op {
        "add" => Binary::Add,
        "sub" => Binary::Sub,
        "mul" => Binary::Mul,
        "div" => Binary::Div,
        "pow" | "constpow" => Binary::Pow,
        "atan2" => Binary::Atan2,
        _ => return None,
    })
}
