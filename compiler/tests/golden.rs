//! The golden files, compiled and run: every derivative against differences of values, and values against formulas
//! written by hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // tests say what went wrong by panicking
#![deny(warnings)] // of the golden files, too

mod differences;

use differences::{Point, check, close, gradient_columns, jacobian_columns};
use gaitc_runtime::model::{Env, Functional, Model};

#[path = "golden/cart.rs"]
#[rustfmt::skip]
pub mod cart;
#[path = "golden/every_operation.rs"]
#[rustfmt::skip]
pub mod every_operation;
#[path = "golden/prescribed_length.rs"]
#[rustfmt::skip]
pub mod prescribed_length;

use cart::Cart;
use every_operation::EveryOperation;
use prescribed_length::PrescribedLength;

fn climber(tau: f64, branch: [bool; 4]) -> Point<2, 6> {
    Point {
        x: [-0.35, -0.2],
        k: [0.4, -1.3],
        p: [0.13, 0.5, 2.6, 9.81, 0.35, 18.85],
        tau,
        t: 0.3,
        memory: vec![3.0],
        branch: branch.to_vec(),
    }
}

#[test]
fn derivatives_of_the_climber() {
    for branches in 0..16 {
        let branch = [0, 1, 2, 3].map(|bit| branches >> bit & 1 == 1);
        check::<PrescribedLength, 2, 6, 3>(&climber(0.05, branch));
    }
}

#[test]
fn values_of_the_climber() {
    let point = climber(0.05, [true; 4]);
    let ([q, v], [l_s, l_b, m, g, psi, omega]) = (point.x, point.p);
    let r = l_b + l_s / 2.0 * (1.0 + (omega * 0.05).cos());
    let rate = -l_s / 2.0 * omega * (omega * 0.05).sin();
    let expected = [v / r, -g * q.sin() - rate * v / r];
    close("flow", &PrescribedLength::flow(0, &point.x, &point.env()), &expected);
    close("guard", &[PrescribedLength::guard(0, &point.x, &point.env())], &[std::f64::consts::PI / omega - 0.05]);
    let mut memory = [0.0];
    let after = PrescribedLength::reset(0, &point.x, &point.env(), &mut memory);
    close("reset", &after, &[q - 2.0 * psi, (2.0 * psi).cos() * v]);
    assert_eq!(memory, [4.0]);
    let acceleration = -l_s / 2.0 * omega * omega * (omega * 0.05).cos();
    let force = -m * acceleration + m * g * q.cos() + m * v * v / r;
    close("peak force", &[PrescribedLength::observable(0, 0, &point.x, &point.k, &point.env())], &[force]);
    // After the stroke the leg stays short.
    let point = climber(0.2, [false, true, true, true]);
    close("flow", &PrescribedLength::flow(0, &point.x, &point.env()), &[v / l_b, -g * q.sin()]);
}

#[test]
fn the_fingerprint_is_in_the_info() {
    assert_eq!(PrescribedLength::INFO.fingerprint.len(), 64);
    assert_ne!(PrescribedLength::INFO.fingerprint, EveryOperation::INFO.fingerprint);
}

fn everything(x: [f64; 3], branch: &[bool]) -> Point<3, 4> {
    Point {
        x,
        k: [0.1, 0.2, 0.3],
        p: [0.4, 1.3, 2.0, 0.7],
        tau: 0.35,
        t: 0.8,
        memory: vec![1.0, 2.0],
        branch: branch.to_vec(),
    }
}

/// Selectors as the switching functions say, each after the ones that it depends on.
fn selectors(x: [f64; 3]) -> Vec<bool> {
    let mut branch = vec![false; EveryOperation::INFO.switches.len()];
    for _ in 0..branch.len() {
        let point = everything(x, &branch);
        branch = (0..branch.len()).map(|i| EveryOperation::switch(i, &point.x, &point.env()) >= 0.0).collect();
    }
    branch
}

#[test]
fn derivatives_of_every_operation() {
    for x in [[0.3, 0.8, -0.2], [0.3, 0.1, 0.6], [-0.4, 0.9, 0.5], [-0.4, -0.7, -1.2]] {
        let branch = selectors(x);
        check::<EveryOperation, 3, 4, { every_operation::INTEGRALS }>(&everything(x, &branch));
    }
}

#[test]
fn values_of_every_operation() {
    let x = [0.3, 0.8, -0.2];
    let point = everything(x, &selectors(x));
    let ([x, y, z], [a, b, c, kind]) = (point.x, point.p);
    let trig = x.sin() + y.cos() * (a * x).tan() + (a * x / 4.0).asin() - (a * y / 4.0).acos()
        + (b * x).atan()
        + (x + 2.0).atan2(y + 3.0);
    let hyper =
        (a * x).sinh() + (a * y).cosh() + z.tanh() + (b * x).asinh() + (2.0 + x * x).acosh() + (a * x / 4.0).atanh();
    let square = x * x + 1.0;
    let powers = x * x
        + x.powi(3)
        + (x + 5.0).powi(-2) / 100.0
        + square.sqrt()
        + square.powf(2.5)
        + square.powf(c)
        + square.powf(-0.5);
    let growth = (-x * x).exp() + (1.0 + x * x + kind).ln();
    let (root, nested) = (x.sqrt() + x * x.sqrt(), x * y);
    let expected = [trig + hyper / 10.0, powers / 10.0 + growth * (point.t * 3.0).cos() - x, root + nested - point.tau];
    close("flow", &EveryOperation::flow(0, &point.x, &point.env()), &expected);
    let mut memory = [0.0; 2];
    EveryOperation::reset(0, &point.x, &point.env(), &mut memory);
    assert_eq!(memory, [2.0, 4.0]);
    // The second mode's rate of x is Y; the first's is what the flow says.
    let last = EveryOperation::INFO.functionals.len();
    assert!(last > 0);
    close("rate", &[EveryOperation::observable(3, 1, &point.x, &point.k, &point.env())], &[y]);
    close("rate", &[EveryOperation::observable(3, 0, &point.x, &point.k, &point.env())], &expected[..1]);
    assert_eq!(EveryOperation::when(0, &point.x, &point.env()), y);
    assert_eq!(EveryOperation::when(1, &point.x, &point.env()), 1.0);
}

/// A square root of a negative number in the branch that is not taken must not reach any result.
#[test]
fn the_branch_not_taken_stays_out() {
    let x = [-0.4, 0.9, 0.5];
    let point = everything(x, &selectors(x));
    let jacobian = EveryOperation::flow_jacobian(0, &point.x, &point.env());
    assert!(jacobian_columns(&jacobian).iter().flatten().all(|entry| entry.is_finite()));
    assert!(jacobian.value.iter().all(|value| value.is_finite()));
    let guard = EveryOperation::guard_gradient(0, &point.x, &point.env());
    assert!(gradient_columns(&guard).iter().flatten().all(|entry| entry.is_finite()));
    let zeros = [[0.1; 3]; 1];
    let fused = EveryOperation::integrated_variational(0, &point.x, &zeros, &[[0.1; 4]], &point.env());
    assert!(fused.dflow.iter().flatten().all(|entry| entry.is_finite()));
    // And with the other selectors it does.
    let wrong: Vec<bool> = point.branch.iter().map(|_| true).collect();
    let point = everything(x, &wrong);
    assert!(EveryOperation::flow(0, &point.x, &point.env())[2].is_nan());
}

#[test]
fn derivatives_with_a_mass_matrix() {
    let point = Point {
        x: [0.3, 0.7, 0.4],
        k: [1.1, -0.6, 0.2],
        p: [2.0, 0.7, 1.3],
        tau: 0.25,
        t: 0.4,
        memory: vec![],
        branch: vec![],
    };
    check::<Cart, 3, 3, { cart::INTEGRALS }>(&point);
    let ([v, w, phi], [kv, kw, kphi], [m, l, g]) = (point.x, point.k, point.p);
    let expected =
        [m * kv + l * phi.cos() * kw - phi.sin() * w * w * l, phi.cos() * kv + l * kw + g * phi.cos(), kphi - w];
    close("residual", &Cart::residual(0, &point.x, &point.k, &point.env()), &expected);
    assert!(!Cart::INFO.explicit);
    // Rates are those that are passed in, not solved for.
    close("push", &[Cart::observable(0, 0, &point.x, &point.k, &point.env())], &[m * kv]);
    let lift = (l * phi.cos() * kphi + kv * point.tau + v) * (3.0 * point.t).cos();
    close("integrands", &Cart::integrands(0, &point.x, &point.k, &point.env()), &[lift, kv]);
    assert!(Cart::flow(0, &point.x, &point.env()).iter().all(|value| value.is_nan()));
}

/// What `also_zero` says in the info, and what its functionals are.
#[test]
fn functions_that_vanish_with_a_guard() {
    let [height, touching] = Cart::INFO.transitions[0].also_zero else { panic!("two functions") };
    assert_eq!((height.text, height.si, touching.text, touching.si), ("height", "m", "1 + cos(phi)", "1"));
    let (x, k, p) = ([0.3, 0.7, 0.4], [1.1, -0.6, 0.2], [2.0, 0.7, 1.3]);
    let env = Env { tau: 0.0, t: 0.0, p: &p, memory: &[], branch: &[] };
    let value = |functional: usize, at_end: bool| match Cart::INFO.functionals[functional] {
        Functional::Start(i) if !at_end => Cart::observable(i, 0, &x, &k, &env),
        Functional::End(i) if at_end => Cart::observable(i, 0, &x, &k, &env),
        other => panic!("{other:?}"),
    };
    let expected = 0.7 * 0.4_f64.sin();
    close("height", &[value(height.start, false), value(height.end, true)], &[expected, expected]);
    close("its rate", &[value(height.rate, true)], &[0.7 * 0.4_f64.cos() * 0.2]);
    close("touching", &[value(touching.rate, true)], &[-0.4_f64.sin() * 0.2]);
}

#[test]
fn wrong_indices_and_lengths_give_nan() {
    let point = climber(0.05, [true; 4]);
    let nan = |values: &[f64]| values.iter().all(|value| value.is_nan());
    assert!(nan(&PrescribedLength::flow(1, &point.x, &point.env())));
    assert!(PrescribedLength::guard(1, &point.x, &point.env()).is_nan());
    assert!(PrescribedLength::switch(4, &point.x, &point.env()).is_nan());
    assert!(PrescribedLength::observable(0, 1, &point.x, &point.k, &point.env()).is_nan());
    assert!(PrescribedLength::observable(1, 0, &point.x, &point.k, &point.env()).is_nan());
    assert!(PrescribedLength::when(1, &point.x, &point.env()).is_nan());
    let short = Env { branch: &[true; 3], ..point.env() };
    assert!(nan(&PrescribedLength::flow(0, &point.x, &short)));
    assert!(nan(&PrescribedLength::variational(0, &point.x, &[[1.0; 2]; 2], &short).1[1]));
    let short = Env { memory: &[], ..point.env() };
    assert!(PrescribedLength::guard_gradient(0, &point.x, &short).dtau.is_nan());
    let mut memory = [0.0; 2];
    assert!(nan(&PrescribedLength::reset(0, &point.x, &point.env(), &mut memory)));
    assert!(nan(&memory));
    assert!(nan(&PrescribedLength::embed(&[1.0], &point.p)));
    let mut dz = [[0.0; 2]; 3];
    assert!(nan(&PrescribedLength::embed_jacobian(&[1.0, 2.0], &point.p, &mut dz)[0]));
    assert!(nan(&dz[2]));
    let mut out = [0.0; 3];
    PrescribedLength::measures(&[1.0; 2], &point.p, &mut out);
    assert!(nan(&out));
}
