//! Sums of a product and a term as one operation, which processors round once.
//!
//! Only a product that nothing else uses is drawn into its sum. The difference of two products stays as it is: where they
//! are equal it is exactly zero, and with one of them not rounded it would be a little off, which a square root may not bear.
//! In the sum of two products the one is drawn in whose factors are known last: the other is then ready, and one operation
//! less is waited for.

use super::program::{Binary, Fused, Operation, Program, Unary, Value};

impl Program {
    /// The same program with fused multiply-adds.
    #[must_use]
    pub fn fused(&self) -> Self {
        let uses = self.uses();
        let is_product = |value: Value| matches!(self.operations.get(value), Some(Operation::Binary(Binary::Mul, ..)));
        let product = |value: Value| match self.operations.get(value) {
            Some(&Operation::Binary(Binary::Mul, a, b)) if uses.get(value) == Some(&1) => Some((a, b)),
            _ => None,
        };
        let depth = self.depths();
        let later = |a: Value, b: Value| depth.get(a) > depth.get(b);
        let fuse = |operation: Operation| match operation {
            Operation::Binary(Binary::Add, a, b) => match (product(a), product(b)) {
                (Some((p, q)), Some(_)) if later(a, b) => Operation::Fused(Fused::MulAdd, p, q, b),
                (_, Some((p, q))) => Operation::Fused(Fused::MulAdd, p, q, a),
                (Some((p, q)), None) => Operation::Fused(Fused::MulAdd, p, q, b),
                (None, None) => operation,
            },
            Operation::Binary(Binary::Sub, a, b) if !(is_product(a) && is_product(b)) => match (product(a), product(b))
            {
                (_, Some((p, q))) => Operation::Fused(Fused::NegMulAdd, p, q, a),
                (Some((p, q)), None) => Operation::Fused(Fused::MulSub, p, q, b),
                (None, None) => operation,
            },
            _ => operation,
        };
        let operations = self.operations.iter().map(|&operation| fuse(operation)).collect();
        Self { operations, values: self.values.clone(), jacobian: self.jacobian.clone() }.without_dead_values()
    }

    /// How long each value is waited for from the inputs on, in products.
    fn depths(&self) -> Vec<usize> {
        let mut depths: Vec<usize> = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            let last = operation.operands().filter_map(|value| depths.get(value).copied()).max();
            depths.push(last.map_or(0, |depth| depth + latency(*operation)));
        }
        depths
    }

    /// How often each value is used, by other values and as a result.
    pub(super) fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.operations.len()];
        let operands = self.operations.iter().flat_map(|operation| operation.operands());
        let results = self.values.iter().copied().chain(self.jacobian.iter().map(|entry| entry.value));
        for value in operands.chain(results) {
            if let Some(count) = uses.get_mut(value) {
                *count += 1;
            }
        }
        uses
    }
}

/// About how many products take as long.
fn latency(operation: Operation) -> usize {
    match operation {
        Operation::Unary(Unary::Neg | Unary::Abs | Unary::Signum, _) => 1,
        Operation::Unary(..) | Operation::Binary(Binary::Pow | Binary::Atan2, ..) => 6,
        Operation::Binary(Binary::Div, ..) => 3,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)] // a test says what went wrong by panicking
    use super::*;

    /// A program from operations on the inputs 0, 1, 2; the last value is the result.
    fn program(operations: &[Operation]) -> Program {
        let inputs = (0..3).map(Operation::Input);
        let operations: Vec<Operation> = inputs.chain(operations.iter().copied()).collect();
        let last = operations.len() - 1;
        Program { operations, values: vec![last], jacobian: Vec::new() }
    }

    fn binary(op: Binary, a: Value, b: Value) -> Operation {
        Operation::Binary(op, a, b)
    }

    fn last(program: &Program) -> Operation {
        *program.operations.get(*program.values.last().unwrap()).unwrap()
    }

    #[test]
    fn a_product_and_a_term_become_one_operation() {
        let product = binary(Binary::Mul, 0, 1);
        let fused = |sum| last(&program(&[product, sum]).fused());
        assert_eq!(fused(binary(Binary::Add, 3, 2)), Operation::Fused(Fused::MulAdd, 0, 1, 2));
        assert_eq!(fused(binary(Binary::Add, 2, 3)), Operation::Fused(Fused::MulAdd, 0, 1, 2));
        assert_eq!(fused(binary(Binary::Sub, 3, 2)), Operation::Fused(Fused::MulSub, 0, 1, 2));
        assert_eq!(fused(binary(Binary::Sub, 2, 3)), Operation::Fused(Fused::NegMulAdd, 0, 1, 2));
    }

    #[test]
    fn a_product_that_is_used_elsewhere_stays() {
        let shared = program(&[binary(Binary::Mul, 0, 1), binary(Binary::Add, 3, 2), binary(Binary::Mul, 3, 4)]);
        assert_eq!(shared.fused().operations, shared.operations);
        let mut result = program(&[binary(Binary::Mul, 0, 1), binary(Binary::Add, 3, 2)]);
        result.values.push(3);
        assert_eq!(result.fused().operations, result.operations);
    }

    #[test]
    fn a_difference_of_products_is_exactly_zero_where_they_are_equal() {
        let products = [binary(Binary::Mul, 0, 0), binary(Binary::Mul, 1, 1), binary(Binary::Sub, 3, 4)];
        let difference = program(&products);
        assert_eq!(difference.fused().values, vec![4]);
        assert_eq!(last(&difference.fused()), Operation::Binary(Binary::Sub, 2, 3));
        let sum = [products[0], products[1], binary(Binary::Add, 3, 4)];
        assert!(matches!(last(&program(&sum).fused()), Operation::Fused(Fused::MulAdd, ..)));
    }

    #[test]
    fn of_two_products_the_later_one_is_drawn_in() {
        let sine = Operation::Unary(Unary::Sin, 0);
        let products = [sine, binary(Binary::Mul, 1, 3), binary(Binary::Mul, 1, 2)];
        for sum in [binary(Binary::Add, 4, 5), binary(Binary::Add, 5, 4)] {
            let fused = program(&[products[0], products[1], products[2], sum]).fused();
            let Operation::Fused(Fused::MulAdd, p, q, term) = last(&fused) else { panic!("{fused:?}") };
            assert_eq!(fused.operations.get(q), Some(&sine));
            assert_eq!((p, fused.operations.get(term)), (1, Some(&products[2])));
        }
    }
}
