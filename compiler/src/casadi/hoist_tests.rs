//! Divided programs against the undivided ones, by an interpreter; and how much is left for the rest.
#![allow(clippy::unwrap_used, clippy::panic)] // a test says what went wrong by panicking

use super::*;
use crate::casadi::program::{Fused, Logic};

/// A number or a truth value.
#[derive(Clone, Copy, Debug)]
enum Known {
    Number(f64),
    Truth(bool),
}

impl Known {
    fn number(self) -> f64 {
        if let Self::Number(number) = self { number } else { panic!("a truth value") }
    }

    fn truth(self) -> bool {
        if let Self::Truth(truth) = self { truth } else { panic!("a number") }
    }
}

/// Results of a program; inputs are numbers, but for the last, a truth value.
fn run(program: &Program, inputs: &[f64], selector: bool, terms: &[f64]) -> Vec<f64> {
    let mut known: Vec<Known> = Vec::new();
    for operation in &program.operations {
        let n = |v: Value| known[v].number();
        let value = match *operation {
            Operation::Constant(bits) => f64::from_bits(bits),
            Operation::Input(i) => inputs[i],
            Operation::Term(i) => terms[i],
            Operation::Unary(Unary::Neg, a) => -n(a),
            Operation::Unary(Unary::Sin, a) => n(a).sin(),
            Operation::Unary(Unary::Sqrt, a) => n(a).sqrt(),
            Operation::Binary(Binary::Add, a, b) => n(a) + n(b),
            Operation::Binary(Binary::Sub, a, b) => n(a) - n(b),
            Operation::Binary(Binary::Mul, a, b) => n(a) * n(b),
            Operation::Binary(Binary::Div, a, b) => n(a) / n(b),
            Operation::Fused(Fused::MulAdd, a, b, c) => n(a) * n(b) + n(c),
            Operation::Fused(Fused::MulSub, a, b, c) => n(a) * n(b) - n(c),
            Operation::Fused(Fused::NegMulAdd, a, b, c) => n(c) - n(a) * n(b),
            Operation::Select(mask, a, b) => n(if known[mask].truth() { a } else { b }),
            Operation::Truth(_) => {
                known.push(Known::Truth(selector));
                continue;
            }
            Operation::Logic(Logic::Less, a, b) => {
                known.push(Known::Truth(n(a) < n(b)));
                continue;
            }
            Operation::Not(a) => {
                known.push(Known::Truth(!known[a].truth()));
                continue;
            }
            ref other => panic!("{other:?}"),
        };
        known.push(Known::Number(value));
    }
    program.values.iter().map(|&value| known[value].number()).collect()
}

/// Inputs 0 and 1 move, 2 and 3 stay, 4 is a selector that stays; then the operations. All of them are results.
fn program(operations: &[Operation], results: &[Value]) -> Program {
    let inputs = (0..4).map(Operation::Input).chain([Operation::Truth(4)]);
    let operations: Vec<Operation> = inputs.chain(operations.iter().copied()).collect();
    Program { operations, values: results.to_vec(), jacobian: Vec::new() }.without_dead_values()
}

/// Divides, compares the results on both sides of the selector, and gives the rest.
fn check(operations: &[Operation], results: &[Value]) -> Hoisted {
    let whole = program(operations, results);
    let parts = whole.hoisted(|i| i < 2);
    for selector in [true, false] {
        for inputs in [[0.3, -0.7, 1.9, 2.3], [-1.1, 0.2, -0.4, 0.6]] {
            let fixed = [f64::NAN, f64::NAN, inputs[2], inputs[3]];
            let terms = run(&parts.clock, &fixed, selector, &[]);
            let split = run(&parts.rest.fused(), &inputs, selector, &terms);
            let direct = run(&whole, &inputs, selector, &[]);
            for (a, b) in split.iter().zip(&direct) {
                assert!((a - b).abs() <= 1e-14 * b.abs() || (a.is_nan() && b.is_nan()), "{split:?} {direct:?}");
            }
        }
    }
    parts
}

const fn binary(op: Binary, a: Value, b: Value) -> Operation {
    Operation::Binary(op, a, b)
}

#[test]
fn factors_that_stay_are_drawn_together() {
    // k (x/l) with a sign: one product is left.
    let parts = check(&[binary(Binary::Div, 0, 3), binary(Binary::Mul, 2, 5), Operation::Unary(Unary::Neg, 6)], &[7]);
    assert_eq!(parts.clock.values.len(), 1);
    let counts = parts.rest.counts();
    assert_eq!((counts.multiplications, counts.divisions, counts.additions), (1, 0, 0));
}

#[test]
fn the_sign_of_a_sum_goes_into_its_factors() {
    let sine = Operation::Unary(Unary::Sin, 0);
    let operations = [
        sine,
        binary(Binary::Mul, 2, 5),
        binary(Binary::Mul, 3, 1),
        binary(Binary::Add, 6, 7),
        Operation::Unary(Unary::Neg, 8),
    ];
    let parts = check(&operations, &[9]);
    let counts = parts.rest.fused().counts();
    assert_eq!((counts.multiplications, counts.fused, counts.additions), (1, 1, 0));
    // A difference turns round; where the sum is needed too, its sign is changed.
    let difference = [binary(Binary::Sub, 0, 1), Operation::Unary(Unary::Neg, 5)];
    assert_eq!(check(&difference, &[6]).rest.counts().additions, 1);
    let both = [binary(Binary::Add, 0, 1), Operation::Unary(Unary::Neg, 5)];
    assert_eq!(check(&both, &[5, 6]).rest.counts().additions, 2);
}

#[test]
fn a_choice_between_a_multiple_and_zero_becomes_a_chosen_factor() {
    let zero = Operation::constant(0.0);
    let parts =
        check(&[zero, binary(Binary::Mul, 2, 0), Operation::Select(4, 6, 5), Operation::Select(4, 5, 6)], &[7, 8]);
    assert_eq!(parts.rest.counts().selections, 0);
    assert_eq!(parts.clock.counts().selections, 2);
    // Not where what is left out may be no number: a root of a negative number times zero is none either.
    let root = Operation::Unary(Unary::Sqrt, 0);
    let parts = check(&[zero, root, binary(Binary::Mul, 2, 6), Operation::Select(4, 7, 5)], &[8]);
    assert_eq!(parts.rest.counts().selections, 1);
}

#[test]
fn several_divisions_by_the_same_become_products() {
    let operations = [binary(Binary::Div, 0, 1), binary(Binary::Div, 2, 1), binary(Binary::Div, 3, 1)];
    assert_eq!(check(&operations, &[5, 6, 7]).rest.counts().divisions, 1);
    let one = [binary(Binary::Div, 0, 1)];
    assert_eq!(check(&one, &[5]).rest.counts().divisions, 1);
    // By what stays: none is left.
    let fixed = [binary(Binary::Div, 0, 2), binary(Binary::Div, 1, 2), binary(Binary::Div, 3, 2)];
    let parts = check(&fixed, &[5, 6, 7]);
    assert_eq!((parts.rest.counts().divisions, parts.clock.counts().divisions), (0, 1));
}

#[test]
fn what_several_need_is_multiplied_once() {
    // y = k x; y^2, y^3, y^4.
    let operations =
        [binary(Binary::Mul, 2, 0), binary(Binary::Mul, 5, 5), binary(Binary::Mul, 6, 5), binary(Binary::Mul, 6, 6)];
    assert_eq!(check(&operations, &[7, 8]).rest.counts().multiplications, 4);
}

#[test]
fn truth_values_are_formed_again_from_terms() {
    let less = Operation::Logic(Logic::Less, 5, 3);
    let operations = [binary(Binary::Mul, 2, 2), less, Operation::Not(6), Operation::Select(7, 0, 1)];
    let parts = check(&operations, &[8]);
    assert!(parts.clock.values.iter().all(|&v| !parts.clock.operations[v].is_truth()));
    // A selection by what moves stays whole.
    let moving = [Operation::Logic(Logic::Less, 0, 1), Operation::Select(5, 2, 3)];
    assert_eq!(check(&moving, &[6]).rest.counts().selections, 1);
}

#[test]
fn results_that_stay_are_terms() {
    let parts = check(&[binary(Binary::Add, 2, 3), Operation::constant(2.0)], &[5, 6, 2, 0]);
    assert_eq!(parts.clock.values.len(), 1);
    assert_eq!(parts.rest.counts(), crate::casadi::program::Counts::default());
}
