//! Every function of eight numbers against the same function of each of them.

use super::super::{Real, Scalar};
use super::Lanes;
use core::ops::{Add, Div, Mul, Neg, Sub};
use proptest::prelude::*;

/// Zeros, infinities, NaN, the ends of the range, and the ends of the domains of functions.
const SPECIAL: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -3.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    f64::EPSILON,
    5e-324,
    -5e-324,
    1e5,
    1e7,
    -1e7,
    709.5,
    -745.0,
    core::f64::consts::FRAC_PI_2,
];

fn same(lane: f64, number: f64) -> bool {
    lane.to_bits() == number.to_bits() || (lane.is_nan() && number.is_nan())
}

type One = fn(Lanes) -> Lanes;
type OneF = fn(f64) -> f64;
type Two = fn(Lanes, Lanes) -> Lanes;
type TwoF = fn(f64, f64) -> f64;

macro_rules! both {
    ($($name:path),*) => { [$((stringify!($name), $name, $name)),*] };
}

fn functions_of_one() -> Vec<(&'static str, One, OneF)> {
    let by_name: [(&str, One, OneF); 18] = both!(
        Scalar::sin,
        Scalar::cos,
        Scalar::tan,
        Scalar::asin,
        Scalar::acos,
        Scalar::atan,
        Scalar::sinh,
        Scalar::cosh,
        Scalar::tanh,
        Scalar::asinh,
        Scalar::acosh,
        Scalar::atanh,
        Scalar::exp,
        Scalar::ln,
        Scalar::sqrt,
        Scalar::signum,
        Scalar::abs,
        Neg::neg
    );
    let mut all = by_name.to_vec();
    all.push(("sine of both", |x| x.sin_cos().0, |x| Scalar::sin_cos(x).0));
    all.push(("cosine of both", |x| x.sin_cos().1, |x| Scalar::sin_cos(x).1));
    all
}

fn functions_of_two() -> Vec<(&'static str, Two, TwoF)> {
    let by_name: [(&str, Two, TwoF); 6] = both!(Scalar::atan2, Scalar::pow, Add::add, Sub::sub, Mul::mul, Div::div);
    let mut all = by_name.to_vec();
    all.push(("mul_add", |a, b| a.mul_add(b, a), |a, b| Scalar::mul_add(a, b, a)));
    all.push(("less", |a, b| Scalar::select(a.less(b), a, b), |a, b| Scalar::select(a.less(b), a, b)));
    all.push(("at most", |a, b| Scalar::select(a.less_equal(b), a, b), |a, b| Scalar::select(a.less_equal(b), a, b)));
    all
}

/// Compares all functions at eight pairs of numbers.
fn compare(a: [f64; 8], b: [f64; 8]) {
    for (name, lanes, number) in functions_of_one() {
        let result = lanes(a.into());
        for (i, a) in a.into_iter().enumerate() {
            assert!(same(result.lane(i), number(a)), "{name}({a:e}) in lane {i}: {} {}", result.lane(i), number(a));
        }
    }
    for (name, lanes, number) in functions_of_two() {
        let result = lanes(a.into(), b.into());
        for (i, (a, b)) in a.into_iter().zip(b).enumerate() {
            assert!(same(result.lane(i), number(a, b)), "{name}({a:e}, {b:e}) in lane {i}: {}", result.lane(i));
        }
    }
}

#[test]
fn special_values_have_the_bits_of_single_numbers() {
    for shift in 0..SPECIAL.len() {
        for start in (0..SPECIAL.len()).step_by(8) {
            let at = |i: usize| SPECIAL[i % SPECIAL.len()];
            compare(core::array::from_fn(|i| at(start + i)), core::array::from_fn(|i| at(start + i + shift)));
        }
    }
}

#[test]
fn masks_act_lane_by_lane() {
    let mask =
        |bits: usize| Lanes::from_lanes(|i| if bits >> i & 1 == 1 { -1.0 } else { 1.0 }).less(Lanes::constant(0.0));
    for (a, b) in [(0b1011_0010, 0b0110_1011), (0, 255), (255, 255), (1, 128)] {
        let holds =
            |mask: <Lanes as Scalar>::Mask| (0..8).filter(|&i| Lanes::holds(mask, i)).map(|i| 1 << i).sum::<usize>();
        assert_eq!(holds(mask(a)), a);
        assert_eq!(holds(Lanes::not(mask(a))), 255 - a);
        assert_eq!(holds(Lanes::and(mask(a), mask(b))), a & b);
        assert_eq!(holds(Lanes::or(mask(a), mask(b))), a | b);
        // What is not chosen is NaN or infinite, and stays out.
        let chosen = Lanes::from_lanes(|i| if a >> i & 1 == 1 { 1.0 } else { f64::NAN });
        let other = Lanes::from_lanes(|i| if a >> i & 1 == 1 { f64::INFINITY } else { 2.0 });
        let result = Lanes::select(mask(a), chosen, other);
        assert!((0..8).all(|i| result.lane(i) == if a >> i & 1 == 1 { 1.0 } else { 2.0 }));
    }
    assert!(!Lanes::holds(mask(255), 8));
    // NaN is neither less nor at most.
    let nan = Lanes::constant(f64::NAN);
    assert!((0..8).all(|i| !Lanes::holds(nan.less(nan), i) && !Lanes::holds(nan.less_equal(nan), i)));
}

#[test]
fn lanes_are_numbered_as_they_are_given() {
    let lanes = Lanes::from_lanes(|i| i as f64);
    assert_eq!(<[f64; 8]>::from(lanes), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    assert_eq!((lanes.lane(5), Lanes::LANES), (5.0, 8));
    assert!(lanes.lane(8).is_nan());
    assert_eq!(Lanes::constant(3.0), Lanes::from([3.0; 8]));
}

proptest! {
    #[test]
    fn any_numbers_have_the_bits_of_single_numbers(a in any::<[f64; 8]>(), b in any::<[f64; 8]>()) {
        compare(a, b);
    }

    #[test]
    fn moderate_numbers_have_the_bits_of_single_numbers(
        a in prop::array::uniform8(-20.0..20.0_f64), b in prop::array::uniform8(-2.0..2.0_f64),
    ) {
        compare(a, b);
    }
}
