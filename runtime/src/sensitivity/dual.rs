//! Dual numbers a + sum b_k eps_k with eps_j eps_k = 0: exact first derivatives along K directions by the code that computes
//! values.
//!
//! Nested, `Dual<Dual<S, B>, A>`, they carry all second derivatives along one of A and one of B directions: the scalars of
//! second-order sensitivities.

use crate::scalar::{Scalar, filled};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivatives along K directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S = f64, const K: usize = 1> {
    /// The value.
    pub value: S,
    /// The derivatives.
    pub derivative: [S; K],
}

impl<S: Scalar, const K: usize> Dual<S, K> {
    /// A number that varies along direction `k` only, at unit rate.
    pub fn variable(value: S, k: usize) -> Self {
        Self { value, derivative: filled(S::constant(0.0), |i| S::constant(if i == k { 1.0 } else { 0.0 })) }
    }

    /// The chain rule: `value` is f(self), `slope` is f'(self).
    #[inline]
    fn chain(self, value: S, slope: S) -> Self {
        // A zero derivative stays zero also where the slope is infinite (a square root at 0).
        let zero = S::constant(0.0);
        let part = |d: S| S::select(d.is_zero(), zero, slope * d);
        Self { value, derivative: filled(zero, |k| part(self.derivative[k])) }
    }

    /// Both derivatives, combined one by one.
    #[inline]
    fn zip(self, o: Self, value: S, combine: impl Fn(S, S) -> S) -> Self {
        Self { value, derivative: filled(S::constant(0.0), |k| combine(self.derivative[k], o.derivative[k])) }
    }
}

fn one<S: Scalar>() -> S {
    S::constant(1.0)
}

impl<S: Scalar, const K: usize> Add for Dual<S, K> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        self.zip(o, self.value + o.value, |a, b| a + b)
    }
}

impl<S: Scalar, const K: usize> Sub for Dual<S, K> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        self.zip(o, self.value - o.value, |a, b| a - b)
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
impl<S: Scalar, const K: usize> Mul for Dual<S, K> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        self.zip(o, self.value * o.value, |a, b| a * o.value + self.value * b)
    }
}

#[allow(clippy::suspicious_arithmetic_impl, reason = "the quotient rule multiplies and subtracts")]
impl<S: Scalar, const K: usize> Div for Dual<S, K> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        self.zip(o, value, |a, b| (a - value * b) / o.value)
    }
}

impl<S: Scalar, const K: usize> Neg for Dual<S, K> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, derivative: filled(S::constant(0.0), |k| -self.derivative[k]) }
    }
}

impl<S: Scalar, const K: usize> Scalar for Dual<S, K> {
    type Mask = S::Mask;

    fn constant(value: f64) -> Self {
        Self { value: S::constant(value), derivative: [S::constant(0.0); K] }
    }
    #[inline]
    fn times(self, factor: f64) -> Self {
        Self {
            value: self.value.times(factor),
            derivative: filled(S::constant(0.0), |k| self.derivative[k].times(factor)),
        }
    }
    #[inline]
    fn plus_times(self, factor: f64, other: Self) -> Self {
        self.zip(other, self.value.plus_times(factor, other.value), |a, b| a.plus_times(factor, b))
    }
    fn is_zero(self) -> S::Mask {
        self.derivative.into_iter().fold(self.value.is_zero(), |all, d| S::and(all, d.is_zero()))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn tan(self) -> Self {
        let tan = self.value.tan();
        self.chain(tan, one::<S>() + tan * tan)
    }
    fn asin(self) -> Self {
        self.chain(self.value.asin(), one::<S>() / (one::<S>() - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        self.chain(self.value.acos(), -one::<S>() / (one::<S>() - self.value * self.value).sqrt())
    }
    fn atan(self) -> Self {
        self.chain(self.value.atan(), one::<S>() / (one::<S>() + self.value * self.value))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        self.zip(x, self.value.atan2(x.value), |a, b| (a * x.value - self.value * b) / square)
    }
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }
    fn tanh(self) -> Self {
        let tanh = self.value.tanh();
        self.chain(tanh, one::<S>() - tanh * tanh)
    }
    fn asinh(self) -> Self {
        self.chain(self.value.asinh(), one::<S>() / (one::<S>() + self.value * self.value).sqrt())
    }
    fn acosh(self) -> Self {
        self.chain(self.value.acosh(), one::<S>() / (self.value * self.value - one::<S>()).sqrt())
    }
    fn atanh(self) -> Self {
        self.chain(self.value.atanh(), one::<S>() / (one::<S>() - self.value * self.value))
    }
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.chain(exp, exp)
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), one::<S>() / self.value)
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, S::constant(0.5) / root)
    }
    fn pow(self, e: Self) -> Self {
        let value = self.value.pow(e.value);
        let by_base = self.chain(value, e.value * self.value.pow(e.value - one::<S>()));
        let by_exponent = e.chain(value, value * self.value.ln());
        by_base.zip(by_exponent, value, |a, b| a + b)
    }
    fn signum(self) -> Self {
        Self { value: self.value.signum(), derivative: [S::constant(0.0); K] }
    }
    fn abs(self) -> Self {
        self.chain(self.value.abs(), self.value.signum())
    }
    fn less(self, other: Self) -> S::Mask {
        self.value.less(other.value)
    }
    fn less_equal(self, other: Self) -> S::Mask {
        self.value.less_equal(other.value)
    }
    fn not(mask: S::Mask) -> S::Mask {
        S::not(mask)
    }
    fn and(a: S::Mask, b: S::Mask) -> S::Mask {
        S::and(a, b)
    }
    fn or(a: S::Mask, b: S::Mask) -> S::Mask {
        S::or(a, b)
    }
    fn select(mask: S::Mask, then: Self, otherwise: Self) -> Self {
        then.zip(otherwise, S::select(mask, then.value, otherwise.value), |a, b| S::select(mask, a, b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Second derivatives of x^2 sin y + y / x in closed form.
    #[test]
    fn nested_numbers_carry_second_derivatives() {
        let (x, y) = (1.3_f64, 0.7_f64);
        let inner = |value, k| Dual::<f64, 2>::variable(value, k);
        let outer = |value: Dual<f64, 2>, along: [f64; 2]| Dual { value, derivative: along.map(Dual::constant) };
        let (a, b) = (outer(inner(x, 0), [1.0, 0.0]), outer(inner(y, 1), [0.0, 1.0]));
        let f = a * a * b.sin() + b / a;
        let second = |i: usize, j: usize| f.derivative[i].derivative[j];
        approx::assert_relative_eq!(second(0, 0), 2.0 * y.sin() + 2.0 * y / x.powi(3), max_relative = 1e-14);
        approx::assert_relative_eq!(second(0, 1), 2.0 * x * y.cos() - 1.0 / (x * x), max_relative = 1e-14);
        approx::assert_relative_eq!(second(1, 0), second(0, 1), max_relative = 1e-14);
        approx::assert_relative_eq!(second(1, 1), -x * x * y.sin(), max_relative = 1e-14);
    }

    fn check(f: impl Fn(Dual) -> Dual, at: f64) {
        let h = 1e-5;
        let exact = f(Dual::variable(at, 0));
        let difference = (f(Dual::constant(at + h)).value - f(Dual::constant(at - h)).value) / (2.0 * h);
        approx::assert_relative_eq!(exact.derivative[0], difference, max_relative = 1e-8, epsilon = 1e-9);
    }

    #[test]
    fn every_function_agrees_with_a_central_difference() {
        let c = Dual::constant;
        check(|x| x.sin() * x.cos() + x.tan() / (c(2.0) - x), 0.3);
        check(|x| x.asin() + x.acos() * x + x.atan() - x.atan2(c(0.7) * x * x), 0.3);
        check(|x| x.sinh() - x.cosh() * x.tanh() + x.asinh() + x.atanh(), 0.4);
        check(|x| x.acosh() + x.exp() + x.ln() + x.sqrt(), 1.7);
        check(|x| x.pow(x) + x.pow(c(3.0)) + (-x).abs() + x.signum(), 1.3);
        check(|x| (-x).pow(c(3.0)), 1.3);
        check(|x| Dual::select(x.less(c(2.0)), x * x, x), 1.3);
    }
}
