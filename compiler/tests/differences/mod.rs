//! Every derivative of a generated model at a point, against central differences of its values.
#![allow(unreachable_pub, reason = "a module of a test")]

mod lanes;

use gaitc_runtime::model::{Directions, Env, Gradient, Jacobian, Model, RateGradient};

/// Step of the central differences, and how far they may be off, relative to the larger of value and 1.
const STEP: f64 = 1e-5;
const TOLERANCE: f64 = 2e-8;

/// Where a model is evaluated.
#[derive(Clone)]
pub struct Point<const N: usize, const P: usize> {
    pub x: [f64; N],
    pub k: [f64; N],
    pub p: [f64; P],
    pub tau: f64,
    pub t: f64,
    pub memory: Vec<f64>,
    pub branch: Vec<bool>,
}

impl<const N: usize, const P: usize> Point<N, P> {
    pub fn env(&self) -> Env<'_, f64, P> {
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

pub fn close(what: &str, exact: &[f64], approximate: &[f64]) {
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

pub fn jacobian_columns<const N: usize, const P: usize>(j: &Jacobian<f64, N, P>) -> Vec<Vec<f64>> {
    let rates = [[0.0; N]; N];
    let all = j.dx.iter().chain(&rates).chain(&j.dp).chain([&j.dtau, &j.dt]);
    all.map(|column| column.to_vec()).collect()
}

pub fn gradient_columns<const N: usize, const P: usize>(g: &Gradient<f64, N, P>) -> Vec<Vec<f64>> {
    let rates = [0.0; N];
    let all = g.dx.iter().chain(&rates).chain(&g.dp).chain([&g.dtau, &g.dt]);
    all.map(|&entry| vec![entry]).collect()
}

fn rate_gradient_columns<const N: usize, const P: usize>(g: &RateGradient<f64, N, P>) -> Vec<Vec<f64>> {
    let all = g.dx.iter().chain(&g.dk).chain(&g.dp).chain([&g.dtau, &g.dt]);
    all.map(|&entry| vec![entry]).collect()
}

/// Every derivative of a model at a point, against differences.
pub fn check<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(point: &Point<N, P>) {
    let env = &point.env();
    for mode in 0..M::INFO.modes.len() {
        check_residual::<M, N, P, Q>(mode, point);
        if M::INFO.explicit {
            check_flow::<M, N, P, Q>(mode, point);
            lanes::check::<M, N, P, Q>(mode, point);
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
    if M::INFO.section.is_none() {
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
