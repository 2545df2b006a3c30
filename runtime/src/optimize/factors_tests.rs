//! Factors against products, groups against their definition.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failing test should say where

use super::*;
use approx::assert_relative_eq;

fn pair(size: f64, angle: f64) -> [Complex<f64>; 2] {
    [Complex::from_polar(size, angle), Complex::from_polar(size, -angle)]
}

fn sizes(groups: &Groups) -> Vec<usize> {
    let mut sizes: Vec<usize> = groups.0.iter().map(Vec::len).collect();
    sizes.sort_unstable();
    sizes
}

#[test]
fn what_is_apart_is_separated_and_stays_so_until_it_is_close() {
    let at = |angle: f64| [&pair(1.0, 0.6)[..], &pair(0.98, angle), &[Complex::new(-0.3, 0.0)]].concat();
    let apart = Groups::whole(&at(2.0)).settled();
    assert_eq!(sizes(&apart), [1, 2, 2]);
    // Between both distances what is separate stays separate, and what is together stays together.
    let (close, closer) = (0.6 + 0.12, 0.6 + 0.02);
    let followed =
        [1.5, 1.1, 0.9, 0.8, close].iter().fold(apart, |groups, angle| groups.followed(&at(*angle)).unwrap());
    assert_eq!(sizes(&followed.settled()), [1, 2, 2]);
    let joined = followed.followed(&at(closer)).unwrap().settled();
    assert_eq!(sizes(&joined), [1, 4]);
    assert_eq!(sizes(&joined.followed(&at(close)).unwrap().settled()), [1, 4]);
    let far = joined.followed(&at(0.85)).unwrap().settled();
    assert_eq!(sizes(&far), [1, 2, 2]);
}

#[test]
fn two_real_multipliers_that_become_a_pair_are_not_followed_one_by_one() {
    let real = |a: f64, b: f64| [Complex::new(a, 0.0), Complex::new(b, 0.0), Complex::new(-0.5, 0.0)];
    let groups = Groups::whole(&real(0.2, 0.8)).settled();
    assert_eq!(sizes(&groups), [1, 1, 1]);
    let met = [&pair(0.5, 0.1)[..], &[Complex::new(-0.5, 0.0)]].concat();
    assert_eq!(groups.followed(&met), None);
    assert_eq!(sizes(&groups.followed(&real(0.48, 0.52)).unwrap().settled()), [1, 2]);
}

#[test]
fn factors_and_their_slopes_are_those_of_the_product() {
    let roots = [&pair(1.0, 0.6)[..], &pair(0.9, 2.0), &[Complex::new(-0.3, 0.0)]].concat();
    let groups = Groups::whole(&roots).settled();
    let polynomial = real(&roots).unwrap();
    let factors = groups.factors(&polynomial);
    let again = factors.iter().fold(vec![1.0], |all, factor| product(&all, &factor.coefficients));
    for (a, b) in again.iter().zip(&polynomial) {
        assert_relative_eq!(a, b, epsilon = 1e-14);
    }
    // The roots that the groups were made of are off by 1e-7; the factors of the polynomial are not.
    let off: Vec<Complex<f64>> = roots.iter().map(|z| z * (1.0 + 1e-7)).collect();
    for (factor, exact) in groups.followed(&off).unwrap().factors(&polynomial).iter().zip(&factors) {
        for (a, b) in factor.coefficients.iter().zip(&exact.coefficients) {
            assert_relative_eq!(a, b, epsilon = 1e-13);
        }
    }
    let direction = [0.3, -0.2, 0.5, 0.1, -0.4];
    let h = 1e-6;
    let moved = |h: f64| {
        let changed: Vec<f64> = polynomial.iter().zip(direction.iter().chain(&[0.0])).map(|(a, d)| a + h * d).collect();
        groups.factors(&changed).into_iter().map(|factor| factor.coefficients).collect::<Vec<_>>()
    };
    let (plus, minus) = (moved(h), moved(-h));
    for (k, factor) in factors.iter().enumerate() {
        for (i, slope) in factor.slope(&direction).into_iter().enumerate() {
            assert_relative_eq!(slope, (plus[k][i] - minus[k][i]) / (2.0 * h), epsilon = 1e-7);
        }
    }
}
