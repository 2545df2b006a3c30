//! Sine and cosine of an angle together, as straight-line code that is the same for one number and for several in lanes.
//!
//! The angle is brought to |r| <= pi/4 by taking away a whole number k of right angles (Cody and Waite, Software Manual
//! for the Elementary Functions, 1980): pi/2 is a sum of three numbers, each product with k is subtracted by a fused
//! multiply-add, so that nothing of r is lost where the angle is close to a multiple of pi/2. On that interval the
//! minimax polynomials of FreeBSD's msun (k_sin.c and k_cos.c, Sun Microsystems 1993) hold, here in Estrin's order, which
//! has shorter chains than Horner's. The error is at most 1.5 units in the last place.
//!
//! Angles beyond [`LARGEST`], infinities and NaN go to the library's functions, and everything does on a processor
//! without fused multiply-add.

use super::{FUSED, Scalar};
use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4};
use core::hint::select_unpredictable;

/// The largest magnitude that is reduced here: k times the last part of pi/2 is still far below the last place of r.
const LARGEST: f64 = 1_048_576.0;

/// Added to a number of magnitude below 2^51 it rounds to whole numbers, whose low bits are then the lowest of the sum.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// The sign of a number.
pub(super) const SIGN: u64 = 1 << 63;

/// pi/2 as a sum of three numbers (to 2^-163).
const RIGHT_ANGLE: [f64; 3] = [FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// (sin(r) - r)/r^3 in powers of r^2: S1 to S6 of k_sin.c.
const SINE: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// (cos(r) - 1 + r^2/2)/r^4 in powers of r^2: C1 to C6 of k_cos.c.
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// A number, or several in lanes, whose bits can be worked with.
pub(super) trait Register: Scalar {
    /// Whether no magnitude is above a bound, and none is NaN.
    fn within(self, bound: f64) -> bool;

    /// Sine and cosine of `angle` from those of the angle that is left after k right angles are taken from its
    /// magnitude. The two lowest bits of `quadrant` are those of k.
    fn turned(angle: Self, quadrant: Self, sine: Self, cosine: Self) -> (Self, Self);

    /// Sine and cosine where one of the angles is not for [`sin_cos`].
    fn by_library(self) -> (Self, Self);
}

/// Sine and cosine of an angle in radians.
#[inline]
pub(super) fn sin_cos<R: Register>(angle: R) -> (R, R) {
    let magnitude = angle.abs();
    if FUSED && magnitude.within(FRAC_PI_4) {
        // No right angle to take away: the same numbers sooner, and legs of machines seldom lean further.
        let (sine, cosine) = kernel(magnitude);
        return R::turned(angle, R::constant(ROUNDING), sine, cosine);
    }
    if !FUSED || !magnitude.within(LARGEST) {
        return angle.by_library();
    }
    let quadrant = magnitude.mul_add(R::constant(FRAC_2_PI), R::constant(ROUNDING));
    let k = quadrant - R::constant(ROUNDING);
    let r = RIGHT_ANGLE.iter().fold(magnitude, |r, &part| k.mul_add(R::constant(-part), r));
    let (sine, cosine) = kernel(r);
    R::turned(angle, quadrant, sine, cosine)
}

/// Sine and cosine of |r| <= pi/4.
#[inline]
fn kernel<R: Scalar>(r: R) -> (R, R) {
    let square = r * r;
    let sine = (square * r).mul_add(polynomial(SINE, square), r);
    let half = (-square).mul_add(polynomial(COSINE, square), R::constant(0.5));
    (sine, (-square).mul_add(half, R::constant(1.0)))
}

/// A polynomial of degree 5.
#[inline]
fn polynomial<S: Scalar>([a, b, c, d, e, f]: [f64; 6], z: S) -> S {
    let pair = |low, high| S::constant(high).mul_add(z, S::constant(low));
    let square = z * z;
    pair(e, f).mul_add(square, pair(c, d)).mul_add(square, pair(a, b))
}

impl Register for f64 {
    #[inline]
    fn within(self, bound: f64) -> bool {
        self <= bound
    }
    #[inline]
    fn turned(angle: f64, quadrant: f64, sine: f64, cosine: f64) -> (f64, f64) {
        let q = quadrant.to_bits();
        // Exchanged for an odd number of right angles: every other time, which no branch predictor gets right.
        let odd = q & 1 == 1;
        let (sine, cosine) = (select_unpredictable(odd, cosine, sine), select_unpredictable(odd, sine, cosine));
        let flip_sine = ((q & 2) << 62) ^ (angle.to_bits() & SIGN);
        let flip_cosine = (q.wrapping_add(1) & 2) << 62;
        (f64::from_bits(sine.to_bits() ^ flip_sine), f64::from_bits(cosine.to_bits() ^ flip_cosine))
    }
    #[cold]
    #[inline(never)]
    fn by_library(self) -> (f64, f64) {
        f64::sin_cos(self)
    }
}

#[cfg(test)]
#[path = "sine_tests.rs"]
mod tests;
