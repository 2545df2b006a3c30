//! The probe of one compiled model: calls the generated functions and lays their arrays out as vectors.

use super::{Evaluation, Function, Point, Variable};
use crate::model::{Directions, Env, Gradient, Jacobian, Model, RateGradient, ResidualJacobian};

/// Calls one generated function of `M` at a point; `None` when a slice has the wrong length.
pub(super) fn evaluate<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    function: Function,
    at: &Point<'_>,
) -> Option<Evaluation> {
    let x: &[f64; N] = at.x.try_into().ok()?;
    let k: &[f64; N] = at.k.try_into().ok()?;
    let p: &[f64; P] = at.p.try_into().ok()?;
    let fits = at.memory.len() == M::INFO.memory.len() && at.branch.len() == M::INFO.switches.len();
    if !fits || at.functionals.len() != M::INFO.functionals.len() {
        return None;
    }
    let env = Env { tau: at.tau, t: at.t, p, memory: at.memory, branch: at.branch };
    Some(match function {
        Function::Flow(mode) => jacobian(M::flow(mode, x, &env), M::flow_jacobian(mode, x, &env)),
        Function::Variational(mode) => variational::<M, N, P, Q>(mode, x, &env),
        Function::Staged(mode) => staged::<M, N, P, Q>(mode, x, &env),
        Function::Integrated(mode) => integrated::<M, N, P, Q>(mode, x, &env),
        Function::Residual(mode) => residual(M::residual(mode, x, k, &env), M::residual_jacobian(mode, x, k, &env)),
        Function::Linearised(mode) => linearised::<M, N, P, Q>(mode, x, k, &env),
        Function::Integrands(mode) => integrands::<M, N, P, Q>(mode, x, k, &env),
        Function::Switch(i) => gradient(M::switch(i, x, &env), M::switch_gradient(i, x, &env)),
        Function::Guard(i) => gradient(M::guard(i, x, &env), M::guard_gradient(i, x, &env)),
        Function::Reset(i) => {
            let mut memory = vec![0.0; at.memory.len()];
            jacobian(M::reset(i, x, &env, &mut memory), M::reset_jacobian(i, x, &env))
        }
        Function::Memory(i) => {
            let mut memory = vec![0.0; at.memory.len()];
            M::reset(i, x, &env, &mut memory);
            Evaluation { plain: memory.clone(), value: memory, derivatives: Vec::new() }
        }
        Function::When(i) => {
            let margin = vec![M::when(i, x, &env)];
            Evaluation { plain: margin.clone(), value: margin, derivatives: Vec::new() }
        }
        Function::Embed => embed::<M, N, P, Q>(x, p),
        Function::Symmetry => {
            let mut all = jacobian(M::symmetry(x, p), M::symmetry_jacobian(x, p));
            all.derivatives.retain(|(v, _)| matches!(v, Variable::State | Variable::Parameter));
            all
        }
        Function::Observable { index, mode } => {
            let plain = M::observable(index, mode, x, k, &env);
            rate_gradient(plain, M::observable_gradient(index, mode, x, k, &env))
        }
        Function::Measures => measures::<M, N, P, Q>(at.functionals, p),
    })
}

fn columns<const R: usize>(matrix: &[[f64; R]]) -> Vec<Vec<f64>> {
    matrix.iter().map(|column| column.to_vec()).collect()
}

fn jacobian<const N: usize, const P: usize>(plain: [f64; N], j: Jacobian<f64, N, P>) -> Evaluation {
    Evaluation {
        value: j.value.to_vec(),
        plain: plain.to_vec(),
        derivatives: vec![
            (Variable::State, columns(&j.dx)),
            (Variable::Parameter, columns(&j.dp)),
            (Variable::Tau, columns(&[j.dtau])),
            (Variable::Time, columns(&[j.dt])),
        ],
    }
}

fn residual<const N: usize, const P: usize>(plain: [f64; N], j: ResidualJacobian<f64, N, P>) -> Evaluation {
    let ResidualJacobian { value, dx, dk, dp, dtau, dt } = j;
    let mut all = jacobian(plain, Jacobian { value, dx, dp, dtau, dt });
    all.derivatives.push((Variable::Rate, columns(&dk)));
    all
}

fn gradient<const N: usize, const P: usize>(plain: f64, g: Gradient<f64, N, P>) -> Evaluation {
    let rows = |values: &[f64]| values.iter().map(|&v| vec![v]).collect();
    Evaluation {
        value: vec![g.value],
        plain: vec![plain],
        derivatives: vec![
            (Variable::State, rows(&g.dx)),
            (Variable::Parameter, rows(&g.dp)),
            (Variable::Tau, rows(&[g.dtau])),
            (Variable::Time, rows(&[g.dt])),
        ],
    }
}

fn rate_gradient<const N: usize, const P: usize>(plain: f64, g: RateGradient<f64, N, P>) -> Evaluation {
    let RateGradient { value, dx, dk, dp, dtau, dt } = g;
    let mut all = gradient(plain, Gradient { value, dx, dp, dtau, dt });
    all.derivatives.push((Variable::Rate, dk.iter().map(|&v| vec![v]).collect()));
    all
}

fn linearised<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    x: &[f64; N],
    k: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Evaluation {
    let l = M::residual_linearised(mode, x, k, env);
    Evaluation {
        value: l.value.to_vec(),
        plain: M::residual(mode, x, k, env).to_vec(),
        derivatives: vec![(Variable::State, columns(&l.dx)), (Variable::Rate, columns(&l.dk))],
    }
}

fn integrands<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    x: &[f64; N],
    k: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Evaluation {
    let (u, z, p) = (unit::<N>(), [[0.0; N]; N], [[0.0; P]; N]);
    let by = |dx, dk| M::integrands_along(mode, x, k, &Directions { dx, dk, dp: &p, dt: &[0.0; N] }, env);
    let ((value, by_state), (_, by_rate)) = (by(&u, &z), by(&z, &u));
    let none = &[[0.0; N]; P];
    let along = Directions { dx: none, dk: none, dp: &unit::<P>(), dt: &[0.0; P] };
    let (_, by_parameter) = M::integrands_along(mode, x, k, &along, env);
    let still = &[[0.0; N]; 1];
    let along = Directions { dx: still, dk: still, dp: &[[0.0; P]; 1], dt: &[1.0] };
    let (_, by_time) = M::integrands_along(mode, x, k, &along, env);
    Evaluation {
        value: value.to_vec(),
        plain: M::integrands(mode, x, k, env).to_vec(),
        derivatives: vec![
            (Variable::State, columns(&by_state)),
            (Variable::Rate, columns(&by_rate)),
            (Variable::Parameter, columns(&by_parameter)),
            (Variable::Time, columns(&by_time)),
        ],
    }
}

/// The unit matrix by columns.
fn unit<const R: usize>() -> [[f64; R]; R] {
    core::array::from_fn(|j| core::array::from_fn(|i| f64::from(u8::from(i == j))))
}

fn variational<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    x: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Evaluation {
    let (value, dx) = M::variational(mode, x, &unit::<N>(), env);
    Evaluation {
        value: value.to_vec(),
        plain: M::flow(mode, x, env).to_vec(),
        derivatives: vec![(Variable::State, columns(&dx))],
    }
}

fn staged<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    x: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Evaluation {
    let clock = M::clock_lane(&M::clock(mode, env), 0);
    let (value, dx) = M::variational_at(mode, x, &unit::<N>(), &clock, env);
    Evaluation {
        value: value.to_vec(),
        plain: M::flow(mode, x, env).to_vec(),
        derivatives: vec![(Variable::State, columns(&dx))],
    }
}

fn integrated<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    x: &[f64; N],
    env: &Env<'_, f64, P>,
) -> Evaluation {
    let join = |a: &[f64], b: &[f64]| [a, b].concat();
    let both = |a: &[[f64; N]], b: &[[f64; Q]]| a.iter().zip(b).map(|(a, b)| join(a, b)).collect();
    let by_state = M::integrated_variational(mode, x, &unit::<N>(), &[[0.0; P]; N], env);
    let by_parameter = M::integrated_variational(mode, x, &[[0.0; N]; P], &unit::<P>(), env);
    let (flow, integrands) = M::integrated(mode, x, env);
    Evaluation {
        value: join(&by_state.flow, &by_state.integrands),
        plain: join(&flow, &integrands),
        derivatives: vec![
            (Variable::State, both(&by_state.dflow, &by_state.dintegrands)),
            (Variable::Parameter, both(&by_parameter.dflow, &by_parameter.dintegrands)),
        ],
    }
}

fn embed<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(x: &[f64; N], p: &[f64; P]) -> Evaluation {
    let z: Vec<f64> = M::INFO.coordinates.iter().filter_map(|&i| x.get(i).copied()).collect();
    let mut dz = vec![[0.0; N]; z.len()];
    let dp = M::embed_jacobian(&z, p, &mut dz);
    let value = M::embed(&z, p).to_vec();
    Evaluation {
        plain: value.clone(),
        value,
        derivatives: vec![(Variable::Coordinate, columns(&dz)), (Variable::Parameter, columns(&dp))],
    }
}

fn measures<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    functionals: &[f64],
    p: &[f64; P],
) -> Evaluation {
    let rows = M::INFO.measures.len();
    let mut value = vec![0.0; rows];
    M::measures(functionals, p, &mut value);
    let mut by_functional = vec![0.0; rows * functionals.len()];
    let mut by_parameter = vec![[0.0; P]; rows];
    M::measures_jacobian(functionals, p, &mut by_functional, &mut by_parameter);
    let column = |j: usize| (0..rows).filter_map(|i| by_functional.get(i * functionals.len() + j).copied()).collect();
    let parameter_column = |j: usize| by_parameter.iter().filter_map(|row| row.get(j).copied()).collect();
    Evaluation {
        plain: value.clone(),
        value,
        derivatives: vec![
            (Variable::Functional, (0..functionals.len()).map(column).collect()),
            (Variable::Parameter, (0..P).map(parameter_column).collect()),
        ],
    }
}
