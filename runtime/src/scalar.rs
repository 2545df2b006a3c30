//! The numbers that generated code computes with: `f64`, SIMD lanes and dual numbers by the same code.

mod lanes;
mod sine;

pub use lanes::{LaneMask, Lanes};

use core::ops::{Add, Div, Mul, Neg, Sub};

/// An array, entry by entry from their places. It does what `core::array::from_fn` does, which costs the compiler four functions for each
/// closure, and so four for each model, method and width; `blank` may be any value.
#[inline(always)]
pub(crate) fn filled<T: Copy, const N: usize>(blank: T, mut entry: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [blank; N];
    let mut i = 0;
    // Not a range: that would be five more functions for the compiler to inline, in more than a thousand places.
    while i < N {
        all[i] = entry(i);
        i += 1;
    }
    all
}

/// A real number (or several, lane by lane). Generated code uses nothing else.
pub trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// The answer of a comparison: one `bool`, or one a lane.
    type Mask: Copy + Send + Sync + 'static;

    /// The same constant in every lane.
    fn constant(value: f64) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Sine and cosine of an angle in radians.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// `self * factor + term`, rounded once where the processor can do that.
    #[inline]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }
    /// `self * factor` with a constant factor.
    #[inline]
    fn times(self, factor: f64) -> Self {
        self * Self::constant(factor)
    }
    /// `self + factor * other` with a constant factor.
    #[inline]
    fn plus_times(self, factor: f64, other: Self) -> Self {
        other.mul_add(Self::constant(factor), self)
    }
    /// Whether it is exactly zero (with all derivatives that it carries).
    #[inline]
    fn is_zero(self) -> Self::Mask {
        let zero = Self::constant(0.0);
        Self::and(self.less_equal(zero), zero.less_equal(self))
    }
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Inverse sine in radians.
    fn asin(self) -> Self;
    /// Inverse cosine in radians.
    fn acos(self) -> Self;
    /// Inverse tangent in radians.
    fn atan(self) -> Self;
    /// Angle of the point (`x`, `self`) in radians.
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse hyperbolic sine.
    fn asinh(self) -> Self;
    /// Inverse hyperbolic cosine.
    fn acosh(self) -> Self;
    /// Inverse hyperbolic tangent.
    fn atanh(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Square root; NaN for negative numbers.
    fn sqrt(self) -> Self;
    /// Power with a real exponent; negative bases with integer exponents are fine.
    fn pow(self, exponent: Self) -> Self;
    /// -1, 0 or 1.
    fn signum(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self < other`, false where either is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// `self <= other`, false where either is NaN.
    fn less_equal(self, other: Self) -> Self::Mask;
    /// The opposite.
    fn not(mask: Self::Mask) -> Self::Mask;
    /// Both.
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// At least one.
    fn or(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `then` where the mask holds, else `otherwise`. Both are evaluated; the one not chosen may be NaN.
    fn select(mask: Self::Mask, then: Self, otherwise: Self) -> Self;
}

/// Numbers without derivatives, side by side in lanes: what return maps are computed with.
pub trait Real: Scalar {
    /// How many there are.
    const LANES: usize;

    /// The number in a lane; NaN where there is no such lane.
    fn lane(self, index: usize) -> f64;
    /// A number for each lane.
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self;
    /// Whether a mask holds in a lane; false where there is no such lane.
    fn holds(mask: Self::Mask, index: usize) -> bool;
}

/// Whether the processor multiplies and adds with one rounding.
pub(crate) const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

macro_rules! forward {
    ($($name:ident),*) => { $(#[inline] fn $name(self) -> Self { f64::$name(self) })* };
}

impl Scalar for f64 {
    type Mask = bool;

    forward!(tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh, exp, ln, sqrt, abs);

    #[inline]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn sin(self) -> Self {
        sine::sin_cos(self).0
    }
    #[inline]
    fn cos(self) -> Self {
        sine::sin_cos(self).1
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        sine::sin_cos(self)
    }
    #[inline]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // Without the instruction, the library's function would take many times as long.
        if FUSED { f64::mul_add(self, factor, term) } else { self * factor + term }
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        f64::atan2(self, x)
    }
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        f64::powf(self, exponent)
    }
    #[inline]
    fn signum(self) -> Self {
        // f64::signum gives 1 for +0.
        if self == 0.0 { 0.0 } else { f64::signum(self) }
    }
    #[inline]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline]
    fn less_equal(self, other: Self) -> bool {
        self <= other
    }
    #[inline]
    fn not(mask: bool) -> bool {
        !mask
    }
    #[inline]
    fn and(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline]
    fn or(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline]
    fn select(mask: bool, then: Self, otherwise: Self) -> Self {
        if mask { then } else { otherwise }
    }
}

impl Real for f64 {
    const LANES: usize = 1;

    #[inline]
    fn lane(self, index: usize) -> f64 {
        if index == 0 { self } else { f64::NAN }
    }
    #[inline]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        number(0)
    }
    #[inline]
    fn holds(mask: bool, index: usize) -> bool {
        mask && index == 0
    }
}
