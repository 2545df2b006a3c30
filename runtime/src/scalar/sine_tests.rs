//! Against sums of two numbers (106 bits), and against the library's functions.

use super::super::Scalar;
use super::LARGEST;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use proptest::prelude::*;

/// The sum of two numbers, the second far below the last place of the first.
#[derive(Clone, Copy)]
struct Double(f64, f64);

impl Double {
    fn exact_sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let part = sum - a;
        Self(sum, (a - (sum - part)) + (b - part))
    }

    fn exact_product(a: f64, b: f64) -> Self {
        Self(a * b, f64::mul_add(a, b, -(a * b)))
    }

    fn plus(self, o: Self) -> Self {
        let (high, low) = (Self::exact_sum(self.0, o.0), Self::exact_sum(self.1, o.1));
        let once = Self::exact_sum(high.0, high.1 + low.0);
        Self::exact_sum(once.0, once.1 + low.1)
    }

    fn times(self, o: Self) -> Self {
        let product = Self::exact_product(self.0, o.0);
        Self::exact_sum(product.0, product.1 + (self.0 * o.1 + self.1 * o.0))
    }

    fn over(self, divisor: f64) -> Self {
        let quotient = self.0 / divisor;
        let rest = self.plus(Self::exact_product(-quotient, divisor));
        Self::exact_sum(quotient, (rest.0 + rest.1) / divisor)
    }
}

/// pi/2 to 216 bits.
const RIGHT_ANGLE: [f64; 4] = [FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33, 5.562271104316826e-50];

/// Sine and cosine to about 100 bits, by the power series.
fn reference(angle: f64) -> (Double, Double) {
    let k = (angle / FRAC_PI_2).round();
    let r = RIGHT_ANGLE.iter().fold(Double(angle, 0.0), |r, &part| r.plus(Double::exact_product(-k, part)));
    let (mut sine, mut cosine, mut term) = (Double(0.0, 0.0), Double(0.0, 0.0), Double(1.0, 0.0));
    for n in 0..30_u32 {
        let signed = if n % 4 < 2 { term } else { Double(-term.0, -term.1) };
        if n % 2 == 0 {
            cosine = cosine.plus(signed);
        } else {
            sine = sine.plus(signed);
        }
        term = term.times(r).over(f64::from(n + 1));
    }
    let minus = |v: Double| Double(-v.0, -v.1);
    match k.rem_euclid(4.0) {
        0.0 => (sine, cosine),
        1.0 => (cosine, minus(sine)),
        2.0 => (minus(sine), minus(cosine)),
        _ => (minus(cosine), sine),
    }
}

/// Difference in units in the last place of the exact value.
fn places(value: f64, exact: Double) -> f64 {
    let unit = exact.0.abs().next_up() - exact.0.abs();
    ((value - exact.0) - exact.1).abs() / unit
}

/// The larger error of the two, in units in the last place.
fn error(angle: f64) -> f64 {
    let ((sine, cosine), exact) = (Scalar::sin_cos(angle), reference(angle));
    places(sine, exact.0).max(places(cosine, exact.1))
}

/// A cheap sequence that fills the unit interval evenly.
fn evenly(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(|i| (f64::from(i) * 0.618_033_988_749_894_9).fract())
}

/// Whole binary numbers: the same number of places between 0 and any number as between their bits.
fn apart(a: f64, b: f64) -> u64 {
    let ordered = |v: f64| if v.is_sign_negative() { -(v.abs().to_bits() as i64) } else { v.to_bits() as i64 };
    ordered(a).abs_diff(ordered(b))
}

#[test]
fn the_error_is_at_most_one_and_a_half_units_in_the_last_place() {
    for (range, count) in [(FRAC_PI_4, 200_000), (2.0 * PI, 200_000), (1e3, 100_000), (LARGEST, 100_000)] {
        let worst = evenly(count).map(|u| error((2.0 * u - 1.0) * range)).fold(0.0, f64::max);
        assert!(worst <= 1.5, "{worst} units in the last place for angles up to {range}");
    }
}

#[test]
fn nothing_is_lost_next_to_multiples_of_a_right_angle() {
    let largest = (LARGEST / FRAC_PI_2) as i32;
    for k in (0..2_000).chain((2_000..largest).step_by(37)) {
        let angle = f64::from(k) * FRAC_PI_2;
        for near in [angle.next_down(), angle, angle.next_up(), -angle, angle * (1.0 + 1e-12)] {
            assert!(error(near) <= 1.5, "{near:e}: {} units in the last place", error(near));
        }
        // Where one quadrant gives way to the next.
        for near in [angle + FRAC_PI_4, (angle + FRAC_PI_4).next_up(), (angle + FRAC_PI_4).next_down()] {
            assert!(error(near) <= 1.5, "{near:e}: {} units in the last place", error(near));
        }
    }
}

#[test]
fn two_million_angles_agree_with_the_library() {
    let check = |angle: f64| {
        let (sine, cosine) = Scalar::sin_cos(angle);
        assert!(apart(sine, angle.sin()) <= 2, "sine of {angle:e}");
        assert!(apart(cosine, angle.cos()) <= 2, "cosine of {angle:e}");
        assert_eq!((sine, cosine), (Scalar::sin(angle), Scalar::cos(angle)));
    };
    evenly(1_000_000).for_each(|u| check((2.0 * u - 1.0) * 20.0));
    // All magnitudes alike, from the smallest to 1e9.
    evenly(1_000_000).enumerate().for_each(|(i, u)| check(10f64.powf(u * 333.0 - 324.0) * [1.0, -1.0][i % 2]));
}

#[test]
fn zeros_keep_their_sign_and_what_is_not_finite_gives_nan() {
    assert_eq!(Scalar::sin(0.0).to_bits(), 0.0_f64.to_bits());
    assert_eq!(Scalar::sin(-0.0).to_bits(), (-0.0_f64).to_bits());
    assert_eq!((Scalar::cos(0.0), Scalar::cos(-0.0)), (1.0, 1.0));
    for tiny in [f64::from_bits(1), f64::MIN_POSITIVE, 1e-300, 1e-20] {
        assert_eq!(Scalar::sin_cos(tiny), (tiny, 1.0));
        assert_eq!(Scalar::sin_cos(-tiny), (-tiny, 1.0));
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (sine, cosine) = Scalar::sin_cos(bad);
        assert!(sine.is_nan() && cosine.is_nan());
    }
    for large in [LARGEST.next_up(), 1e15, 1e300, f64::MAX] {
        assert_eq!(Scalar::sin_cos(large), large.sin_cos());
        assert_eq!(Scalar::sin_cos(-large), (-large).sin_cos());
    }
}

proptest! {
    #[test]
    fn any_angle_agrees_with_the_library(angle in any::<f64>()) {
        let (sine, cosine) = Scalar::sin_cos(angle);
        let same = |ours: f64, theirs: f64| apart(ours, theirs) <= 2 || (ours.is_nan() && theirs.is_nan());
        prop_assert!(same(sine, angle.sin()) && same(cosine, angle.cos()));
    }
}
