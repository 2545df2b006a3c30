//! The methods against their definition and against exact solutions, also where the mass matrix vanishes.

#![allow(clippy::unwrap_used)] // a failed expectation is a failed test

use super::*;
use crate::model::Linearised;
use crate::ode::{Bundle, Tolerance};
use approx::assert_abs_diff_eq;

fn simplifying_assumptions<const S: usize>(t: &Tableau<S>) {
    for q in 1..=S {
        for i in 0..S {
            // C(S): the stages integrate polynomials of degree S - 1.
            let sum: f64 = (0..S).map(|j| t.a[i][j] * t.c[j].powi(q as i32 - 1)).sum();
            assert_abs_diff_eq!(sum, t.c[i].powi(q as i32) / q as f64, epsilon = 2e-15);
        }
    }
    for q in 1..2 * S {
        // B(2S - 1): with C(S) and D(S - 1) this makes the order 2S - 1.
        let sum: f64 = (0..S).map(|j| t.a[S - 1][j] * t.c[j].powi(q as i32 - 1)).sum();
        assert_abs_diff_eq!(sum, 1.0 / q as f64, epsilon = 2e-15);
    }
    let beyond: f64 = (0..S).map(|j| t.a[S - 1][j] * t.c[j].powi(2 * S as i32 - 1)).sum();
    assert!((beyond - 1.0 / (2 * S) as f64).abs() > 1e-8, "not of order 2S: the test can fail");
    for q in 1..S {
        for j in 0..S {
            // D(S - 1).
            let sum: f64 = (0..S).map(|i| t.a[S - 1][i] * t.c[i].powi(q as i32 - 1) * t.a[i][j]).sum();
            let exact = t.a[S - 1][j] * (1.0 - t.c[j].powi(q as i32)) / q as f64;
            assert_abs_diff_eq!(sum, exact, epsilon = 2e-15);
        }
    }
    for j in 0..S {
        for i in 0..S {
            assert_abs_diff_eq!(t.values(t.c[i])[j], f64::from(u8::from(i == j)), epsilon = 2e-13);
            assert_abs_diff_eq!(t.integrals(t.c[i])[j], t.a[i][j], epsilon = 2e-14);
            let product: f64 = (0..S).map(|k| t.inverse[i][k] * t.a[k][j]).sum();
            assert_abs_diff_eq!(product, f64::from(u8::from(i == j)), epsilon = 1e-14);
        }
    }
    let a = nalgebra::DMatrix::from_fn(S, S, |i, j| t.a[i][j] - if i == j { t.gamma } else { 0.0 });
    assert_abs_diff_eq!(a.determinant(), 0.0, epsilon = 1e-16);
}

#[test]
fn coefficients_are_those_of_radau_collocation() {
    simplifying_assumptions(&RADAU3);
    simplifying_assumptions(&RADAU5);
}

/// x' = y^2, y' = x y with the solution (tan tau, 1/cos tau), and a third state that is slaved where its mass vanishes:
/// tau^2 z' = e^tau tau^2 + e^tau - z, with the smooth solution z = e^tau from z(0) = 1, singular at tau = 0.
struct Toy;

impl Implicit<3> for Toy {
    fn residual(&self, tau: f64, x: &[f64; 3], k: &[f64; 3]) -> [f64; 3] {
        self.linearised(tau, x, k).value
    }
    fn linearised(&self, tau: f64, x: &[f64; 3], k: &[f64; 3]) -> Linearised<f64, 3> {
        let mass = tau * tau;
        Linearised {
            value: [k[0] - x[1] * x[1], k[1] - x[0] * x[1], mass * k[2] - tau.exp() * (mass + 1.0) + x[2]],
            dx: [[0.0, -x[1], 0.0], [-2.0 * x[1], -x[0], 0.0], [0.0, 0.0, 1.0]],
            dk: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, mass]],
        }
    }
}

fn exact(tau: f64) -> [f64; 3] {
    [tau.tan(), 1.0 / tau.cos(), tau.exp()]
}

fn one_step<const S: usize>(t: &Tableau<S>, tau: f64, h: f64) -> ([f64; 3], Rates<3, S>) {
    step_from(t, tau, h, exact(tau))
}

fn step_from<const S: usize>(t: &Tableau<S>, tau: f64, h: f64, x: [f64; 3]) -> ([f64; 3], Rates<3, S>) {
    let mut k = [[0.0; 3]; S];
    solve(t, &Toy, (tau, h), &x, &mut k, &[1e-16; 3], &mut Workspace::default()).unwrap();
    let change = weighted(&t.a[S - 1], &k);
    (core::array::from_fn(|i| x[i] + h * change[i]), k)
}

/// The order of the error after an interval of length 1, from `steps` steps and twice as many.
fn order<const S: usize>(t: &Tableau<S>, steps: i32) -> f64 {
    let error = |steps: i32| {
        let h = 1.0 / f64::from(steps);
        let mut x = exact(0.1);
        for i in 0..steps {
            x = step_from(t, 0.1 + f64::from(i) * h, h, x).0;
        }
        let exact = exact(1.1);
        (x[0] - exact[0]).hypot(x[1] - exact[1])
    };
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn methods_have_their_order() {
    let (three, five) = (order(&RADAU3, 32), order(&RADAU5, 4));
    assert!((three - 5.0).abs() < 0.2, "RADAU3: {three}");
    assert!((five - 9.0).abs() < 0.5, "RADAU5: {five}");
}

#[test]
fn starts_where_the_mass_matrix_vanishes() {
    let (end, k) = one_step(&RADAU5, 0.0, 0.05);
    for (value, exact) in end.iter().zip(exact(0.05)) {
        assert_abs_diff_eq!(*value, exact, epsilon = 1e-12);
    }
    // The rate that the equation gives as 0/0 at the start: z' = e^0.
    let at_start = weighted(&RADAU5.values(0.0), &k);
    assert_abs_diff_eq!(at_start[2], 1.0, epsilon = 1e-7);
}

#[test]
fn the_polynomial_is_the_solution_to_the_order_of_the_stages() {
    let error = |h: f64| {
        let (_, rates) = one_step(&RADAU5, 0.1, h);
        let polynomial = Polynomial { tau: 0.1, h, start: exact(0.1), rates };
        let places = (0..=20).map(|i| f64::from(i) / 20.0);
        let distance = |u: f64| (polynomial.state(&RADAU5, u)[0] - exact(0.1 + u * h)[0]).abs();
        let slope = |u: f64| (polynomial.rate(&RADAU5, u)[0] - exact(0.1 + u * h)[1].powi(2)).abs();
        let bend = |u: f64| {
            let [x, y, _] = exact(0.1 + u * h);
            (polynomial.second_rate(&RADAU5, u)[0] - 2.0 * x * y * y).abs()
        };
        let worst = |f: &dyn Fn(f64) -> f64| places.clone().map(f).fold(0.0, f64::max);
        [worst(&distance), worst(&slope), worst(&bend)]
    };
    let (coarse, fine) = (error(0.2), error(0.1));
    for (i, expected) in [6.0, 5.0, 4.0].into_iter().enumerate() {
        let measured = (coarse[i] / fine[i]).log2();
        assert!((measured - expected).abs() < 0.6, "derivative {i}: {measured}");
    }
}

#[test]
fn the_error_estimate_falls_like_h_to_the_sixth() {
    let tolerance = Tolerance { relative: 1e-3, absolute: 1e-3 };
    let estimate = |h: f64| {
        let (end, k) = one_step(&RADAU5, 0.1, h);
        let state = |x: [f64; 3]| Bundle::<3, 0, 0> { x, q: [], dx: [], dq: [] };
        let [x, y, z] = exact(0.1);
        let rates: [Bundle<3, 0, 0>; 5] = core::array::from_fn(|s| state(k[s]));
        let mut e = RADAU5.defect(h, &state([y * y, x * y, z]), &rates);
        let at = Toy.linearised(0.1 + h, &end, &k[4]);
        let mut work = Workspace::<3, 5>::default();
        work.end = at;
        assert!(work.factorise_filter(h * RADAU5.gamma));
        e.x = work.filtered(&e.x);
        size(&state(exact(0.1)), &state(end), &e, tolerance)
    };
    let measured = (estimate(0.2) / estimate(0.1)).log2();
    assert!((measured - 6.0).abs() < 0.6, "{measured}");
}

#[test]
fn variations_are_the_derivatives_of_the_discrete_step() {
    let (tau, h) = (0.0, 0.2);
    let map = |x: [f64; 3]| {
        let mut k = [[0.0; 3]; 5];
        solve(&RADAU5, &Toy, (tau, h), &x, &mut k, &[1e-16; 3], &mut Workspace::default()).unwrap();
        k
    };
    let x = exact(tau);
    let k = map(x);
    let mut work = Workspace::default();
    assert!(work.differentiate(&RADAU5, &Toy, (tau, h), &x, &k));
    for j in 0..3 {
        let mut dx = [0.0; 3];
        dx[j] = 1.0;
        let column = work.column(&dx, &[[0.0; 3]; 5]);
        let shifted = |d: f64| {
            let mut moved = x;
            moved[j] += d;
            map(moved)
        };
        let (up, down) = (shifted(1e-5), shifted(-1e-5));
        for s in 0..5 {
            for i in 0..3 {
                assert_abs_diff_eq!(column[s][i], (up[s][i] - down[s][i]) / 2e-5, epsilon = 3e-8);
            }
        }
    }
}

#[test]
fn what_cannot_be_solved_is_refused() {
    struct Hopeless;
    impl Implicit<1> for Hopeless {
        fn residual(&self, _: f64, x: &[f64; 1], _: &[f64; 1]) -> [f64; 1] {
            [x[0] * x[0] + 1.0]
        }
        fn linearised(&self, tau: f64, x: &[f64; 1], k: &[f64; 1]) -> Linearised<f64, 1> {
            Linearised { value: self.residual(tau, x, k), dx: [[2.0 * x[0]]], dk: [[0.0]] }
        }
    }
    let mut k = [[0.0; 1]; 5];
    let solved = solve(&RADAU5, &Hopeless, (0.0, 0.1), &[0.3], &mut k, &[1e-14], &mut Workspace::default());
    assert!(solved.is_none());
}
