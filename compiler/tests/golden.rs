//! The golden files, compiled and run: every derivative against differences of values, and values against formulas
//! written by hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // tests say what went wrong by panicking
#![deny(warnings)] // of the golden files, too

use gaitc_runtime::model::{Directions, Env, Functional, Gradient, Jacobian, Model, RateGradient};

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

/// Step of the central differences, and how far they may be off, relative to the larger of value and 1.
const STEP: f64 = 1e-5;
const TOLERANCE: f64 = 2e-8;

/// Where a model is evaluated.
#[derive(Clone)]
struct Point<const N: usize, const P: usize> {
    x: [f64; N],
    k: [f64; N],
    p: [f64; P],
    tau: f64,
    t: f64,
    memory: Vec<f64>,
    branch: Vec<bool>,
}

impl<const N: usize, const P: usize> Point<N, P> {
    fn env(&self) -> Env<'_, f64, P> {
        Env { tau: self.tau, t: self.t, p: &self.p, memory: &self.memory, branch: &self.branch }
    }

    /// The variable number `i` of states, rates, parameters, tau, t.
    fn variable(&mut self, i: usize) -> &mut f64 {
        match i {
            i if i < N => &mut self.x[i],
            i if i < 2 * N => &mut self.k[i - N],
            i if i < 2 * N + P => &mut self.p[i - 2 * N],
            i if i == 2 * N + P => &mut self.tau,
            _ => &mut self.t,
        }
    }

    /// Columns of derivatives by all variables, by central differences.
    fn differences(&self, f: impl Fn(&Self) -> Vec<f64>) -> Vec<Vec<f64>> {
        (0..2 * N + P + 2)
            .map(|i| {
                let (mut above, mut below) = (self.clone(), self.clone());
                *above.variable(i) += STEP;
                *below.variable(i) -= STEP;
                f(&above).iter().zip(f(&below)).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
            })
            .collect()
    }
}

fn close(what: &str, exact: &[f64], approximate: &[f64]) {
    assert_eq!(exact.len(), approximate.len(), "{what}");
    for (a, b) in exact.iter().zip(approximate) {
        assert!((a - b).abs() <= TOLERANCE * b.abs().max(1.0) * 10.0, "{what}: {exact:?} {approximate:?}");
    }
}

/// Compares columns; those of the rates are zero where the function does not take them.
fn compare<const N: usize>(what: &str, columns: &[Vec<f64>], differences: &[Vec<f64>]) {
    assert_eq!(columns.len(), differences.len(), "{what}");
    for (i, (column, difference)) in columns.iter().zip(differences).enumerate() {
        close(&format!("{what}, column {i}"), column, difference);
    }
}

fn jacobian_columns<const N: usize, const P: usize>(j: &Jacobian<f64, N, P>) -> Vec<Vec<f64>> {
    let rates = [[0.0; N]; N];
    let all = j.dx.iter().chain(&rates).chain(&j.dp).chain([&j.dtau, &j.dt]);
    all.map(|column| column.to_vec()).collect()
}

fn gradient_columns<const N: usize, const P: usize>(g: &Gradient<f64, N, P>) -> Vec<Vec<f64>> {
    let rates = [0.0; N];
    let all = g.dx.iter().chain(&rates).chain(&g.dp).chain([&g.dtau, &g.dt]);
    all.map(|&entry| vec![entry]).collect()
}

fn rate_gradient_columns<const N: usize, const P: usize>(g: &RateGradient<f64, N, P>) -> Vec<Vec<f64>> {
    let all = g.dx.iter().chain(&g.dk).chain(&g.dp).chain([&g.dtau, &g.dt]);
    all.map(|&entry| vec![entry]).collect()
}

/// Every derivative of a model at a point, against differences.
fn check<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(point: &Point<N, P>) {
    let env = &point.env();
    for mode in 0..M::INFO.modes.len() {
        check_residual::<M, N, P, Q>(mode, point);
        if M::INFO.explicit {
            check_flow::<M, N, P, Q>(mode, point);
        }
    }
    for i in 0..M::INFO.switches.len() {
        let g = M::switch_gradient(i, &point.x, env);
        assert_eq!(g.value, M::switch(i, &point.x, env));
        let differences = point.differences(|at| vec![M::switch(i, &at.x, &at.env())]);
        compare::<N>(&format!("switch {i}"), &gradient_columns(&g), &differences);
    }
    for i in 0..M::INFO.transitions.len() {
        let g = M::guard_gradient(i, &point.x, env);
        assert_eq!(g.value, M::guard(i, &point.x, env));
        let differences = point.differences(|at| vec![M::guard(i, &at.x, &at.env())]);
        compare::<N>(&format!("guard {i}"), &gradient_columns(&g), &differences);
        let reset = |at: &Point<N, P>| {
            let mut memory = vec![0.0; at.memory.len()];
            M::reset(i, &at.x, &at.env(), &mut memory).to_vec()
        };
        let j = M::reset_jacobian(i, &point.x, env);
        close("reset", &j.value, &reset(point));
        compare::<N>(&format!("reset {i}"), &jacobian_columns(&j), &point.differences(reset));
    }
    let observables = 16;
    for mode in 0..M::INFO.modes.len() {
        for i in 0..observables {
            let g = M::observable_gradient(i, mode, &point.x, &point.k, env);
            if g.value.is_nan() {
                break;
            }
            let differences = point.differences(|at| vec![M::observable(i, mode, &at.x, &at.k, &at.env())]);
            compare::<N>(&format!("observable {i}"), &rate_gradient_columns(&g), &differences);
        }
        check_integrands::<M, N, P, Q>(mode, point);
    }
    let symmetry = |at: &Point<N, P>| M::symmetry(&at.x, &at.p).to_vec();
    let j = M::symmetry_jacobian(&point.x, &point.p);
    compare::<N>("symmetry", &jacobian_columns(&j), &point.differences(symmetry));
    check_embed::<M, N, P, Q>(point);
    check_measures::<M, N, P, Q>(point);
}

fn check_flow<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(mode: usize, point: &Point<N, P>) {
    let env = &point.env();
    let j = M::flow_jacobian(mode, &point.x, env);
    let flow = |at: &Point<N, P>| M::flow(mode, &at.x, &at.env()).to_vec();
    close("flow", &j.value, &flow(point));
    compare::<N>("flow", &jacobian_columns(&j), &point.differences(flow));

    // Two columns: the fused products against the differences' Jacobian times the column.
    let dx: [[f64; N]; 2] = core::array::from_fn(|c| core::array::from_fn(|i| 0.3 + c as f64 - 0.7 * i as f64));
    let dp: [[f64; P]; 2] = core::array::from_fn(|c| core::array::from_fn(|i| 0.2 - c as f64 + 0.4 * i as f64));
    let (value, columns) = M::variational(mode, &point.x, &dx, env);
    close("variational value", &value, &flow(point));
    let by_all = point.differences(flow);
    for (v, product) in dx.iter().zip(&columns) {
        let expected: Vec<f64> = (0..N).map(|row| (0..N).map(|j| by_all[j][row] * v[j]).sum()).collect();
        close("variational", product, &expected);
    }
    let integrated = |at: &Point<N, P>| {
        let (f, q) = M::integrated(mode, &at.x, &at.env());
        f.iter().chain(&q).copied().collect::<Vec<f64>>()
    };
    let fused = M::integrated_variational(mode, &point.x, &dx, &dp, env);
    let value: Vec<f64> = fused.flow.iter().chain(&fused.integrands).copied().collect();
    close("integrated", &value, &integrated(point));
    let by_all = point.differences(integrated);
    for c in 0..2 {
        let product: Vec<f64> = fused.dflow[c].iter().chain(&fused.dintegrands[c]).copied().collect();
        let expected: Vec<f64> = (0..N + Q)
            .map(|row| {
                let states: f64 = (0..N).map(|j| by_all[j][row] * dx[c][j]).sum();
                states + (0..P).map(|j| by_all[2 * N + j][row] * dp[c][j]).sum::<f64>()
            })
            .collect();
        close("integrated variational", &product, &expected);
    }
}

fn check_residual<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(mode: usize, point: &Point<N, P>) {
    let residual = |at: &Point<N, P>| M::residual(mode, &at.x, &at.k, &at.env()).to_vec();
    let j = M::residual_jacobian(mode, &point.x, &point.k, &point.env());
    close("residual", &j.value, &residual(point));
    let columns = j.dx.iter().chain(&j.dk).chain(&j.dp).chain([&j.dtau, &j.dt]).map(|c| c.to_vec());
    compare::<N>("residual", &columns.collect::<Vec<_>>(), &point.differences(residual));
    let l = M::residual_linearised(mode, &point.x, &point.k, &point.env());
    assert_eq!((l.value, l.dx, l.dk), (j.value, j.dx, j.dk));
}

/// Along two directions, against the differences' Jacobian times the direction.
fn check_integrands<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    point: &Point<N, P>,
) {
    let integrands = |at: &Point<N, P>| M::integrands(mode, &at.x, &at.k, &at.env()).to_vec();
    let of_states = |slope: f64| -> [[f64; N]; 2] {
        core::array::from_fn(|c| core::array::from_fn(|i| 0.3 + c as f64 + slope * i as f64))
    };
    let (dx, dk) = (of_states(-0.7), of_states(0.9));
    let dp: [[f64; P]; 2] = core::array::from_fn(|c| core::array::from_fn(|i| 0.2 - c as f64 + 0.4 * i as f64));
    let dt = [0.6, -0.5];
    let directions = Directions { dx: &dx, dk: &dk, dp: &dp, dt: &dt };
    let (value, along) = M::integrands_along(mode, &point.x, &point.k, &directions, &point.env());
    assert_eq!(value.to_vec(), integrands(point));
    let by_all = point.differences(integrands);
    for c in 0..2 {
        let direction: Vec<f64> = [&dx[c][..], &dk[c], &dp[c], &[0.0, dt[c]]].concat();
        let expected: Vec<f64> =
            (0..Q).map(|row| by_all.iter().zip(&direction).map(|(column, v)| column[row] * v).sum()).collect();
        close("integrands along", &along[c], &expected);
    }
}

fn check_embed<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(point: &Point<N, P>) {
    let coordinates = M::INFO.coordinates;
    if M::INFO.section_after.is_none() {
        return;
    }
    let embed = |at: &Point<N, P>| {
        let z: Vec<f64> = coordinates.iter().map(|&i| at.x[i]).collect();
        M::embed(&z, &at.p).to_vec()
    };
    let z: Vec<f64> = coordinates.iter().map(|&i| point.x[i]).collect();
    let mut dz = vec![[0.0; N]; z.len()];
    let dp = M::embed_jacobian(&z, &point.p, &mut dz);
    let differences = point.differences(embed);
    for (&i, column) in coordinates.iter().zip(&dz) {
        close("embed by coordinate", column, &differences[i]);
    }
    for (i, column) in dp.iter().enumerate() {
        close("embed by parameter", column, &differences[2 * N + i]);
    }
}

fn check_measures<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(point: &Point<N, P>) {
    let (count, inputs) = (M::INFO.measures.len(), M::INFO.functionals.len());
    let functionals: Vec<f64> = (0..inputs).map(|i| 1.5 + 0.3 * i as f64).collect();
    let measures = |functionals: &[f64], p: &[f64; P]| {
        let mut out = vec![0.0; count];
        M::measures(functionals, p, &mut out);
        out
    };
    let (mut by_functionals, mut by_parameters) = (vec![0.0; count * inputs], vec![[0.0; P]; count]);
    M::measures_jacobian(&functionals, &point.p, &mut by_functionals, &mut by_parameters);
    let difference = |above: Vec<f64>, below: Vec<f64>| -> Vec<f64> {
        above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
    };
    for j in 0..inputs {
        let (mut above, mut below) = (functionals.clone(), functionals.clone());
        above[j] += STEP;
        below[j] -= STEP;
        let expected = difference(measures(&above, &point.p), measures(&below, &point.p));
        let column: Vec<f64> = (0..count).map(|row| by_functionals[row * inputs + j]).collect();
        close("measures by functionals", &column, &expected);
    }
    for j in 0..P {
        let (mut above, mut below) = (point.p, point.p);
        above[j] += STEP;
        below[j] -= STEP;
        let expected = difference(measures(&functionals, &above), measures(&functionals, &below));
        let column: Vec<f64> = by_parameters.iter().map(|row| row[j]).collect();
        close("measures by parameters", &column, &expected);
    }
}

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
