//! Dual numbers a + b eps with eps^2 = 0: the derivative with respect to t of flows and integrands that use t.
//!
//! Only models with [`crate::model::ModelInfo::uses_time`] come here, so clarity goes before speed.

use crate::scalar::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative along one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S = f64> {
    /// The value.
    pub value: S,
    /// The derivative.
    pub derivative: S,
}

impl<S: Scalar> Dual<S> {
    /// The chain rule: `value` is f(self), `slope` is f'(self).
    fn chain(self, value: S, slope: S) -> Self {
        // A zero derivative stays zero also where the slope is infinite (a square root at 0).
        let zero = S::constant(0.0);
        let flat = S::and(self.derivative.less_equal(zero), zero.less_equal(self.derivative));
        Self { value, derivative: S::select(flat, zero, slope * self.derivative) }
    }
}

fn one<S: Scalar>() -> S {
    S::constant(1.0)
}

impl<S: Scalar> Add for Dual<S> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, derivative: self.derivative + o.derivative }
    }
}

impl<S: Scalar> Sub for Dual<S> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, derivative: self.derivative - o.derivative }
    }
}

impl<S: Scalar> Mul for Dual<S> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { value: self.value * o.value, derivative: self.derivative * o.value + self.value * o.derivative }
    }
}

impl<S: Scalar> Div for Dual<S> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        Self { value, derivative: (self.derivative - value * o.derivative) / o.value }
    }
}

impl<S: Scalar> Neg for Dual<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, derivative: -self.derivative }
    }
}

impl<S: Scalar> Scalar for Dual<S> {
    type Mask = S::Mask;

    fn constant(value: f64) -> Self {
        Self { value: S::constant(value), derivative: S::constant(0.0) }
    }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
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
        let derivative = (self.derivative * x.value - self.value * x.derivative) / square;
        Self { value: self.value.atan2(x.value), derivative }
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
        Self { value, derivative: by_base.derivative + by_exponent.derivative }
    }
    fn signum(self) -> Self {
        Self { value: self.value.signum(), derivative: S::constant(0.0) }
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
        Self {
            value: S::select(mask, then.value, otherwise.value),
            derivative: S::select(mask, then.derivative, otherwise.derivative),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(f: impl Fn(Dual<f64>) -> Dual<f64>, at: f64) {
        let h = 1e-5;
        let exact = f(Dual { value: at, derivative: 1.0 });
        let difference = (f(Dual::constant(at + h)).value - f(Dual::constant(at - h)).value) / (2.0 * h);
        approx::assert_relative_eq!(exact.derivative, difference, max_relative = 1e-8, epsilon = 1e-9);
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
