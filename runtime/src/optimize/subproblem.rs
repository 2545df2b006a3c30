//! The convex subproblem: a quadratic model with elastic linearised constraints in a ball, solved by Clarabel.
//!
//! ```text
//! minimise   g's + s'Bs/2 + nu sum (t+ + t-) + mu sum w
//! subject to A s + h = t+ - t-,  C s + c + w >= 0,  lower <= s <= upper,  |s| <= radius,  t+, t-, w >= 0
//! ```
//!
//! Elastic variables make it feasible whatever the constraints. With an infinite nu there are no t: the equalities hold, or the
//! program is infeasible. It is posed in units of the radius, so that Clarabel
//! sees steps of order one however small the ball has become.

use super::solver::{Clarabel, Tally};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus, SupportedConeT, ZeroConeT,
};
use nalgebra::{DMatrix, DVector};

/// Data of a subproblem.
#[derive(Clone, Debug)]
pub(super) struct Subproblem<'a> {
    pub(super) hessian: &'a DMatrix<f64>,
    pub(super) gradient: &'a DVector<f64>,
    pub(super) equality: &'a DMatrix<f64>,
    pub(super) h: DVector<f64>,
    pub(super) inequality: &'a DMatrix<f64>,
    pub(super) c: DVector<f64>,
    /// Bounds on the step; may be infinite.
    pub(super) lower: &'a [f64],
    pub(super) upper: &'a [f64],
    pub(super) radius: f64,
    /// What a violated inequality costs: mu.
    pub(super) penalty: f64,
    /// What a violated equality costs: nu; infinite where they have to hold.
    pub(super) tie: f64,
    /// Clarabel's settings at the first attempt.
    pub(super) clarabel: &'a Clarabel,
    pub(super) tally: &'a Tally,
}

/// Multipliers: gradient = A'y + C'lambda + low - high at a stationary point; all but y are not negative.
#[derive(Clone, Debug)]
pub(super) struct Multipliers {
    pub(super) equality: DVector<f64>,
    pub(super) inequality: DVector<f64>,
    pub(super) low: DVector<f64>,
    pub(super) high: DVector<f64>,
}

/// A step and its multipliers.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) s: DVector<f64>,
    pub(super) multipliers: Multipliers,
}

/// Clarabel's last word on a subproblem that it could not solve.
#[derive(Clone, Debug)]
pub(super) struct Unsolved(pub(super) String);

impl Multipliers {
    /// All zero.
    pub(super) fn zeros(n: usize, d: usize, rows: usize) -> Self {
        Self {
            equality: DVector::zeros(d),
            inequality: DVector::zeros(rows),
            low: DVector::zeros(n),
            high: DVector::zeros(n),
        }
    }

    /// Largest multiplier of an equality or inequality.
    pub(super) fn largest(&self) -> f64 {
        self.equality.amax().max(self.inequality.amax())
    }
}

impl Subproblem<'_> {
    /// Violation of the linearised constraints after a step, in the l1 norm.
    pub(super) fn violation(&self, s: &DVector<f64>) -> f64 {
        violation(&(self.equality * s + &self.h), &(self.inequality * s + &self.c))
    }

    /// The model without the penalty.
    pub(super) fn model(&self, s: &DVector<f64>) -> f64 {
        self.gradient.dot(s) + 0.5 * s.dot(&(self.hessian * s))
    }

    /// Solves, trying harder settings when Clarabel does not make it at first.
    pub(super) fn solve(&self) -> Result<Step, Unsolved> {
        let n = self.gradient.len();
        if n == 0 {
            return Ok(Step { s: DVector::zeros(0), multipliers: Multipliers::zeros(0, self.h.len(), self.c.len()) });
        }
        let mut words = Vec::new();
        for attempt in attempts(self.clarabel) {
            match self.attempt(&attempt) {
                Ok(step) => {
                    self.tally.subproblem(words.len() + 1, true);
                    return Ok(step);
                }
                Err(word) => words.push(word),
            }
            if self.tie.is_infinite() && words.iter().any(|word| word.contains("Infeasible")) {
                break;
            }
        }
        self.tally.subproblem(words.len(), false);
        Err(Unsolved(words.join(", ")))
    }

    fn attempt(&self, attempt: &Attempt) -> Result<Step, String> {
        let scale = self.objective_scale(attempt.tame_penalty);
        let data = self.assemble(attempt.regularise, scale);
        let mut solver =
            DefaultSolver::new(&data.p, &data.q, &data.a, &data.b, &data.cones, attempt.clarabel.settings())
                .map_err(|error| error.to_string())?;
        solver.solve();
        let solution = &solver.solution;
        self.tally.attempt(solution.status, solution.iterations);
        let usable = match solution.status {
            SolverStatus::Solved => true,
            SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress | SolverStatus::MaxIterations => {
                solution.r_prim < attempt.accept && solution.r_dual < attempt.accept
            }
            _ => false,
        };
        if usable && solution.x.iter().chain(&solution.z).all(|x| x.is_finite()) {
            Ok(self.step(&solution.x, &solution.z, scale))
        } else {
            Err(format!("{:?}", solution.status))
        }
    }

    /// By what the model's objective is divided, so that its coefficients do not grow without limit.
    fn objective_scale(&self, tame_penalty: bool) -> f64 {
        let scale = self.gradient.amax().max(1.0);
        let tie = if self.tie.is_finite() { self.tie } else { 0.0 };
        if tame_penalty { scale.max(self.penalty).max(tie) } else { scale }
    }

    /// How many elastic variables the equalities have.
    fn ties(&self) -> usize {
        if self.tie.is_finite() { 2 * self.h.len() } else { 0 }
    }

    /// Clarabel's form: minimise x'Px/2 + q'x subject to b - A x in the cones; x = (s, t+, t-, w)/radius.
    ///
    /// Values so large that no step in the ball changes the sign of their row are cut down, and bounds out of reach are
    /// left out: neither changes the solution, but a huge right-hand side would spoil it.
    fn assemble(&self, regularise: f64, scale: f64) -> Data {
        let (n, d, k, ties) = (self.gradient.len(), self.h.len(), self.c.len(), self.ties());
        let mut p = Triplets::default();
        for j in 0..n {
            for i in 0..=j {
                let extra = if i == j { regularise } else { 0.0 };
                p.push(i, j, self.radius * self.hessian[(i, j)] / scale + extra);
            }
        }
        let columns = n + ties + k;
        let cost = |j: usize| match j {
            j if j < n => self.gradient[j],
            j if j < n + ties => self.tie,
            _ => self.penalty,
        };
        let q: Vec<f64> = (0..columns).map(|j| cost(j) / scale).collect();
        let mut a = Triplets::default();
        let mut b = Vec::new();
        for i in 0..d {
            (0..n).for_each(|j| a.push(i, j, self.equality[(i, j)]));
            if ties > 0 {
                a.push(i, n + i, -1.0);
                a.push(i, n + d + i, 1.0);
                b.push(-self.cut(self.h[i], self.equality, i));
            } else {
                b.push(-self.h[i] / self.radius);
            }
        }
        for i in 0..k {
            (0..n).for_each(|j| a.push(d + i, j, -self.inequality[(i, j)]));
            a.push(d + i, n + ties + i, -1.0);
            b.push(self.cut(self.c[i], self.inequality, i));
        }
        let mut single = |column: usize, sign: f64, bound: f64| {
            a.push(b.len(), column, sign);
            b.push(bound);
        };
        (n..columns).for_each(|j| single(j, -1.0, 0.0));
        for j in self.reachable(self.lower) {
            single(j, -1.0, -self.lower[j] / self.radius);
        }
        for j in self.reachable(self.upper) {
            single(j, 1.0, self.upper[j] / self.radius);
        }
        let inequalities = b.len() - d;
        b.push(1.0);
        for j in 0..n {
            a.push(b.len(), j, -1.0);
            b.push(0.0);
        }
        let cones = vec![ZeroConeT(d), NonnegativeConeT(inequalities), SecondOrderConeT(n + 1)];
        Data { p: p.matrix(columns, columns), q, a: a.matrix(b.len(), columns), b, cones }
    }

    /// A row's value in units of the radius, cut where its sign is certain.
    fn cut(&self, value: f64, rows: &DMatrix<f64>, i: usize) -> f64 {
        let certain = 10.0 * (1.0 + rows.row(i).norm());
        (value / self.radius).clamp(-certain, certain)
    }

    /// Which bounds the ball does not imply.
    fn reachable(&self, bounds: &[f64]) -> impl Iterator<Item = usize> {
        bounds.iter().enumerate().filter(|(_, b)| b.abs() < 2.0 * self.radius).map(|(j, _)| j)
    }

    /// The step and the multipliers out of Clarabel's x and z.
    fn step(&self, x: &[f64], z: &[f64], scale: f64) -> Step {
        let (n, d, k) = (self.gradient.len(), self.h.len(), self.c.len());
        let mut m = Multipliers::zeros(n, d, k);
        m.equality = DVector::from_fn(d, |i, _| -z[i] * scale);
        m.inequality = DVector::from_fn(k, |i, _| z[d + i].max(0.0) * scale);
        let mut next = d + k + self.ties() + k;
        for j in self.reachable(self.lower) {
            m.low[j] = z[next].max(0.0) * scale;
            next += 1;
        }
        for j in self.reachable(self.upper) {
            m.high[j] = z[next].max(0.0) * scale;
            next += 1;
        }
        // Rounding must not carry a step across its bounds.
        let s = DVector::from_fn(n, |j, _| (x[j] * self.radius).clamp(self.lower[j], self.upper[j]));
        Step { s, multipliers: m }
    }
}

/// l1 norm of what is violated: h = 0 and c >= 0.
pub(super) fn violation(h: &DVector<f64>, c: &DVector<f64>) -> f64 {
    h.lp_norm(1) + c.iter().map(|c| (-c).max(0.0)).sum::<f64>()
}

/// One way to ask Clarabel.
#[derive(Clone)]
struct Attempt {
    clarabel: Clarabel,
    /// Residuals with which a solution that is not quite solved is still used.
    accept: f64,
    /// Added to the diagonal of P.
    regularise: f64,
    /// Whether the objective is divided by the penalty.
    tame_penalty: bool,
}

/// As wanted; then with the penalty tamed, without equilibration, and with more and more regularisation.
fn attempts(wanted: &Clarabel) -> [Attempt; 5] {
    let looser = |tolerance: f64, static_regularisation: f64| Clarabel {
        tolerance: wanted.tolerance.max(tolerance),
        static_regularisation,
        ..wanted.clone()
    };
    let accept = 10.0 * wanted.tolerance;
    let first = Attempt { clarabel: wanted.clone(), accept, regularise: 0.0, tame_penalty: false };
    let tame = Attempt { tame_penalty: true, ..first.clone() };
    let bare = Attempt {
        clarabel: Clarabel { equilibrate: false, ..looser(1e-9, 1e-9) },
        accept: accept.max(1e-8),
        ..first.clone()
    };
    let firm = Attempt { clarabel: looser(1e-9, 1e-7), accept: accept.max(1e-7), regularise: 1e-8, ..first.clone() };
    let last = Attempt { clarabel: looser(1e-8, 1e-6), accept: 1e-5, regularise: 1e-6, tame_penalty: true };
    [first, tame, bare, firm, last]
}

struct Data {
    p: CscMatrix<f64>,
    q: Vec<f64>,
    a: CscMatrix<f64>,
    b: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

#[derive(Default)]
struct Triplets {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Triplets {
    fn push(&mut self, row: usize, column: usize, value: f64) {
        if value != 0.0 {
            self.rows.push(row);
            self.columns.push(column);
            self.values.push(value);
        }
    }

    fn matrix(self, rows: usize, columns: usize) -> CscMatrix<f64> {
        CscMatrix::new_from_triplets(rows, columns, self.rows, self.columns, self.values)
    }
}

#[cfg(test)]
#[path = "subproblem_tests.rs"]
mod tests;
