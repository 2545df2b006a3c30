//! Eight numbers side by side: eight maps of a model in lock-step, by the code that computes one.
//!
//! Each lane has the bits that `f64` would give: arithmetic and square roots round alike, sine and cosine are the same code
//! ([`super::sine`]), and the rarer functions go to `f64` lane by lane. So a map does not depend on whether, and with which
//! others, it is computed in lanes. The registers are those of the crate `wide`; its own functions (exp, ln, ...) differ from
//! the library's in the last places and, for subnormal numbers, in more.

use super::sine::{self, Register};
use super::{FUSED, Real, Scalar, filled};
use core::ops::{Add, Div, Mul, Neg, Sub};
use wide::{f64x8, u64x8};

/// Eight numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes(f64x8);

/// Eight truth values; all bits of a lane are ones, or none.
#[derive(Clone, Copy, Debug)]
pub struct LaneMask(f64x8);

impl From<[f64; 8]> for Lanes {
    #[inline]
    fn from(numbers: [f64; 8]) -> Self {
        Self(f64x8::new(numbers))
    }
}

impl From<Lanes> for [f64; 8] {
    #[inline]
    fn from(lanes: Lanes) -> Self {
        lanes.0.to_array()
    }
}

macro_rules! operator {
    ($($trait:ident, $name:ident, $op:tt);*) => { $(
        impl $trait for Lanes {
            type Output = Self;
            #[inline]
            fn $name(self, other: Self) -> Self {
                Self(self.0 $op other.0)
            }
        }
    )* };
}

operator!(Add, add, +; Sub, sub, -; Mul, mul, *; Div, div, /);

impl Neg for Lanes {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Lanes {
    /// A function of one number in every lane.
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        let numbers = self.0.to_array();
        Self::from_lanes(|i| function(numbers[i]))
    }

    /// A function of two numbers in every lane.
    fn both(self, other: Self, function: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.0.to_array(), other.0.to_array());
        Self::from_lanes(|i| function(a[i], b[i]))
    }
}

macro_rules! lane_by_lane {
    ($($name:ident),*) => { $(fn $name(self) -> Self { self.each(Scalar::$name) })* };
}

impl Scalar for Lanes {
    type Mask = LaneMask;

    lane_by_lane!(tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh, exp, ln);

    #[inline]
    fn constant(value: f64) -> Self {
        Self(f64x8::splat(value))
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
        if FUSED { Self(self.0.mul_add(factor.0, term.0)) } else { self * factor + term }
    }
    fn atan2(self, x: Self) -> Self {
        self.both(x, Scalar::atan2)
    }
    #[inline]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn pow(self, exponent: Self) -> Self {
        let (bases, powers) = (self.0.to_array(), exponent.0.to_array());
        let same = |numbers: [f64; 8]| numbers.iter().all(|number| number.to_bits() == numbers[0].to_bits());
        // Signs that alternate with the memory, such as (-1)^n, are the same in all lanes.
        if same(bases) && same(powers) {
            return Self::constant(Scalar::pow(bases[0], powers[0]));
        }
        self.both(exponent, Scalar::pow)
    }
    #[inline]
    fn signum(self) -> Self {
        let zero = f64x8::ZERO;
        let sign = self.0.simd_lt(zero).select(-f64x8::ONE, f64x8::ONE);
        let sign = self.0.simd_eq(zero).select(zero, sign);
        Self(self.0.is_nan().select(self.0, sign))
    }
    #[inline]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline]
    fn less(self, other: Self) -> LaneMask {
        LaneMask(self.0.simd_lt(other.0))
    }
    #[inline]
    fn less_equal(self, other: Self) -> LaneMask {
        LaneMask(self.0.simd_le(other.0))
    }
    #[inline]
    fn not(mask: LaneMask) -> LaneMask {
        LaneMask(!mask.0)
    }
    #[inline]
    fn and(a: LaneMask, b: LaneMask) -> LaneMask {
        LaneMask(a.0 & b.0)
    }
    #[inline]
    fn or(a: LaneMask, b: LaneMask) -> LaneMask {
        LaneMask(a.0 | b.0)
    }
    #[inline]
    fn select(mask: LaneMask, then: Self, otherwise: Self) -> Self {
        Self(mask.0.select(then.0, otherwise.0))
    }
}

impl Real for Lanes {
    const LANES: usize = 8;

    #[inline]
    fn lane(self, index: usize) -> f64 {
        self.0.to_array().get(index).copied().unwrap_or(f64::NAN)
    }
    #[inline]
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self {
        Self(f64x8::new(filled(0.0, number)))
    }
    #[inline]
    fn holds(mask: LaneMask, index: usize) -> bool {
        index < Self::LANES && (mask.0.to_bitmask() >> index) & 1 == 1
    }
}

impl Register for Lanes {
    #[inline]
    fn within(self, bound: f64) -> bool {
        self.0.simd_le(f64x8::splat(bound)).all()
    }
    #[inline]
    fn turned(angle: Self, quadrant: Self, sine: Self, cosine: Self) -> (Self, Self) {
        let (one, two) = (u64x8::splat(1), u64x8::splat(2));
        let q = quadrant.0.to_bits();
        let odd = f64x8::from_bits(u64x8::splat(0) - (q & one));
        let (first, second) = (odd.select(cosine.0, sine.0), odd.select(sine.0, cosine.0));
        let flip_sine = ((q & two) << 62_u32) ^ (angle.0.to_bits() & u64x8::splat(sine::SIGN));
        let flip_cosine = ((q + one) & two) << 62_u32;
        let flip = |number: f64x8, sign: u64x8| Self(f64x8::from_bits(number.to_bits() ^ sign));
        (flip(first, flip_sine), flip(second, flip_cosine))
    }
    #[inline]
    fn by_library(self) -> (Self, Self) {
        let [sine, cosine] = apart(self.0.to_array());
        (Self::from(sine), Self::from(cosine))
    }
}

/// Sines and cosines lane by lane, so that an angle of another lane never decides how a lane's own is treated. In arrays:
/// registers would have to leave for memory also where this is not called.
#[cold]
#[inline(never)]
fn apart(angles: [f64; 8]) -> [[f64; 8]; 2] {
    let pairs = angles.map(Scalar::sin_cos);
    [pairs.map(|(sine, _)| sine), pairs.map(|(_, cosine)| cosine)]
}

#[cfg(test)]
#[path = "lanes_tests.rs"]
mod tests;
