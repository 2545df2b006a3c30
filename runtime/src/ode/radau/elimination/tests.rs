//! The system of all stages against a dense factorisation of the same equations.

use super::System;
use crate::model::Linearised;
use crate::ode::radau::{RADAU5, weighted};
use nalgebra::{DMatrix, DVector};

/// Derivatives with zeros where `zero` says so, and unit rows in the mass matrix where `unit` says so.
fn linearised<const N: usize>(
    zero: &dyn Fn(usize, usize) -> bool,
    unit: &dyn Fn(usize) -> bool,
) -> [Linearised<f64, N>; 5] {
    core::array::from_fn(|i| {
        let dx = |b: usize, a: usize| {
            if zero(a, b) { 0.0 } else { ((1 + i + 3 * a + 5 * b + a * b) as f64).sin() }
        };
        let dk = |b: usize, a: usize| match unit(a) {
            true => f64::from(u8::from(a == b)),
            false => ((2 + i + 7 * a + 2 * b) as f64).cos(),
        };
        let matrix = |f: &dyn Fn(usize, usize) -> f64| core::array::from_fn(|b| core::array::from_fn(|a| f(b, a)));
        Linearised { value: [0.0; N], dx: matrix(&dx), dk: matrix(&dk) }
    })
}

fn check<const N: usize>(zero: &dyn Fn(usize, usize) -> bool, unit: &dyn Fn(usize) -> bool) {
    let (h, at) = (0.3, linearised::<N>(zero, unit));
    let mut system = System::<N, 5>::default();
    let right: [[f64; N]; 5] = core::array::from_fn(|i| core::array::from_fn(|a| ((i + 2 * a) as f64).cos()));
    let matrix = DMatrix::from_fn(5 * N, 5 * N, |row, column| {
        let (i, a, j, b) = (row / N, row % N, column / N, column % N);
        h * RADAU5.a[i][j] * at[i].dx[b][a] + if i == j { at[i].dk[b][a] } else { 0.0 }
    });
    let exact = matrix.lu().solve(&DVector::from_fn(5 * N, |row, _| right[row / N][row % N]));
    // Twice: what is left of a first matrix must not matter.
    for _ in 0..2 {
        assert!(system.factorise(&RADAU5, h, &at));
        let solution = system.solve(&right);
        for (x, exact) in solution.rates.as_flattened().iter().zip(exact.iter().flatten()) {
            approx::assert_relative_eq!(*x, *exact, max_relative = 1e-9);
        }
        for i in 0..5 {
            let increments = weighted(&RADAU5.a[i], &solution.rates);
            for a in 0..N {
                approx::assert_relative_eq!(solution.increments[a][i], h * increments[a], epsilon = 1e-12);
            }
        }
    }
}

#[test]
fn solves_what_nalgebra_solves() {
    // Nothing, all, some to substitute; a chain; a pair of which the second is no longer to be substituted after the first.
    check::<3>(&|_, _| false, &|_| false);
    check::<1>(&|_, _| true, &|_| true);
    check::<4>(&|a, b| a == b || a > b + 1, &|_| true);
    check::<4>(&|a, b| a == b && a != 2, &|a| a != 1);
    check::<5>(&|a, b| a == b || (a + b) % 3 == 1, &|a| a > 0);
    check::<2>(&|a, b| a == b, &|_| true);
    // The second depends on the first, not the other way round: both are substituted.
    check::<4>(&|a, b| a == b && a < 2 || (a, b) == (0, 1), &|a| a < 2);
    check::<5>(&|a, b| a == b && a < 3 || a < b && b < 3, &|a| a < 3);
}

#[test]
fn refuses_what_has_no_solution() {
    let mut at = linearised::<2>(&|_, _| false, &|_| false);
    for stage in &mut at {
        (stage.dx, stage.dk) = ([[1.0, 1.0]; 2], [[0.5, 0.5]; 2]);
    }
    assert!(!System::<2, 5>::default().factorise(&RADAU5, 0.1, &at));
    at[3].dx[0][1] = f64::NAN;
    assert!(!System::<2, 5>::default().factorise(&RADAU5, 0.1, &at));
}
