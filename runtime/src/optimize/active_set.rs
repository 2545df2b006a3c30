//! Refinement of a subproblem's solution on its active set, to rounding error.
//!
//! An interior-point solution is good to its tolerance only, which is not enough near the optimum, where whole steps are
//! smaller. Clarabel says which constraints are active; the KKT system of the quadratic model with these as equalities
//! then gives the step and the multipliers exactly:
//!
//! ```text
//! [ B  G' ] [  s ]   [ -(g + penalties of the violated rows) ]
//! [ G  0  ] [ -y ] = [ -(values of the active rows)           ]
//! ```

use super::subproblem::{Multipliers, Step, Subproblem};
use nalgebra::{DMatrix, DVector};

/// What a row of G is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Active {
    Equality(usize),
    Inequality(usize),
    Low(usize),
    High(usize),
}

/// Most corrections of the guessed active set.
const CORRECTIONS: usize = 20;

/// The exact solution on the active set that `step` suggests, corrected row by row where a multiplier has the wrong sign
/// or a row left out is violated; `None` when no such set is found, or the ball is what limits the step.
pub(super) fn refine(problem: &Subproblem<'_>, step: &Step) -> Option<Step> {
    if problem.gradient.is_empty() || step.s.norm() > 0.999 * problem.radius {
        return None;
    }
    let (mut active, violated) = guess(problem, step);
    let gradient = violated.iter().fold(problem.gradient.clone(), |g, v| g + v);
    for _ in 0..CORRECTIONS {
        let (g, values) = rows(problem, &active);
        let (s, y) = solve(problem.hessian, &gradient, &g, &values)?;
        let refined = assemble(problem, step, &active, s, &y);
        if let Some(wrong) = wrong_sign(&refined, &active, &y) {
            active.swap_remove(wrong);
        } else if let Some(row) = left_out(problem, &refined, &active) {
            active.push(row);
        } else {
            return holds(problem, &refined, &active).then_some(refined);
        }
    }
    None
}

/// Step and multipliers on an active set; violated rows keep their pull.
fn assemble(problem: &Subproblem<'_>, step: &Step, active: &[Active], mut s: DVector<f64>, y: &DVector<f64>) -> Step {
    let mut multipliers = Multipliers::zeros(s.len(), problem.h.len(), problem.c.len());
    multipliers.equality = step.multipliers.equality.map(|y| penalty_sign(y, problem.tie));
    for i in 0..problem.c.len() {
        if step.multipliers.inequality[i] > 0.999 * problem.penalty {
            multipliers.inequality[i] = problem.penalty;
        }
    }
    for (row, &y) in active.iter().zip(y.iter()) {
        match *row {
            Active::Equality(i) => multipliers.equality[i] = y,
            Active::Inequality(i) => multipliers.inequality[i] = y,
            // Exactly onto the bound, not to rounding.
            Active::Low(j) => (multipliers.low[j], s[j]) = (y, problem.lower[j]),
            Active::High(j) => (multipliers.high[j], s[j]) = (y, problem.upper[j]),
        }
    }
    Step { s, multipliers }
}

/// Rounding that a multiplier's sign is allowed.
fn sign_slack(m: &Multipliers) -> f64 {
    1e-9 * (1.0 + m.largest())
}

/// Rounding that a row's value is allowed.
fn value_slack(step: &Step) -> f64 {
    1e-12 + 1e-9 * step.s.norm()
}

/// Position of the active inequality or bound with the most negative multiplier, if any is negative.
fn wrong_sign(step: &Step, active: &[Active], y: &DVector<f64>) -> Option<usize> {
    let slack = sign_slack(&step.multipliers);
    let signed = active.iter().zip(y.iter()).enumerate().filter(|(_, (row, _))| !matches!(row, Active::Equality(_)));
    let worst = signed.map(|(k, (_, &y))| (k, y)).min_by(|a, b| a.1.total_cmp(&b.1));
    worst.filter(|(_, y)| *y < -slack).map(|(k, _)| k)
}

/// The inequality or bound left out that is violated most, if any is.
fn left_out(problem: &Subproblem<'_>, step: &Step, active: &[Active]) -> Option<Active> {
    let c = problem.inequality * &step.s + &problem.c;
    let is_active = |wanted: Active| active.contains(&wanted);
    let rows = (0..c.len())
        .filter(|&i| step.multipliers.inequality[i] < problem.penalty)
        .map(|i| (Active::Inequality(i), c[i]));
    let low = (0..step.s.len()).map(|j| (Active::Low(j), step.s[j] - problem.lower[j]));
    let high = (0..step.s.len()).map(|j| (Active::High(j), problem.upper[j] - step.s[j]));
    let all = rows.chain(low).chain(high).filter(|(row, _)| !is_active(*row));
    let worst = all.min_by(|a, b| a.1.total_cmp(&b.1));
    worst.filter(|(_, value)| *value < -value_slack(step)).map(|(row, _)| row)
}

fn penalty_sign(y: f64, penalty: f64) -> f64 {
    if y.abs() > 0.999 * penalty { penalty.copysign(y) } else { 0.0 }
}

/// Active rows, and for each violated row its pull on the gradient.
fn guess(problem: &Subproblem<'_>, step: &Step) -> (Vec<Active>, Vec<DVector<f64>>) {
    let m = &step.multipliers;
    let (mut active, mut violated) = (Vec::new(), Vec::new());
    for i in 0..problem.h.len() {
        let pull = penalty_sign(m.equality[i], problem.tie);
        if pull == 0.0 {
            active.push(Active::Equality(i));
        } else {
            violated.push(problem.equality.row(i).transpose() * -pull);
        }
    }
    let c = problem.inequality * &step.s + &problem.c;
    for i in 0..problem.c.len() {
        if m.inequality[i] > 0.999 * problem.penalty {
            violated.push(problem.inequality.row(i).transpose() * -problem.penalty);
        } else if m.inequality[i] > c[i] {
            active.push(Active::Inequality(i));
        }
    }
    for j in 0..step.s.len() {
        if m.low[j] > step.s[j] - problem.lower[j] {
            active.push(Active::Low(j));
        } else if m.high[j] > problem.upper[j] - step.s[j] {
            active.push(Active::High(j));
        }
    }
    (active, violated)
}

/// Gradients (as rows) and values of the active rows.
fn rows(problem: &Subproblem<'_>, active: &[Active]) -> (DMatrix<f64>, DVector<f64>) {
    let n = problem.gradient.len();
    let mut g = DMatrix::zeros(active.len(), n);
    let mut values = DVector::zeros(active.len());
    for (k, row) in active.iter().enumerate() {
        match *row {
            Active::Equality(i) => {
                g.set_row(k, &problem.equality.row(i));
                values[k] = problem.h[i];
            }
            Active::Inequality(i) => {
                g.set_row(k, &problem.inequality.row(i));
                values[k] = problem.c[i];
            }
            Active::Low(j) => {
                g[(k, j)] = 1.0;
                values[k] = -problem.lower[j];
            }
            Active::High(j) => {
                g[(k, j)] = -1.0;
                values[k] = problem.upper[j];
            }
        }
    }
    (g, values)
}

/// Step and multipliers of the equality-constrained model; of several multipliers the smallest.
fn solve(
    hessian: &DMatrix<f64>,
    gradient: &DVector<f64>,
    g: &DMatrix<f64>,
    values: &DVector<f64>,
) -> Option<(DVector<f64>, DVector<f64>)> {
    let (n, k) = (hessian.nrows(), g.nrows());
    let mut matrix = DMatrix::zeros(n + k, n + k);
    matrix.view_mut((0, 0), (n, n)).copy_from(hessian);
    matrix.view_mut((n, 0), (k, n)).copy_from(g);
    matrix.view_mut((0, n), (n, k)).copy_from(&g.transpose());
    let mut right = DVector::zeros(n + k);
    right.rows_mut(0, n).copy_from(&-gradient);
    right.rows_mut(n, k).copy_from(&-values);
    if !matrix.iter().chain(right.iter()).all(|x| x.is_finite()) {
        return None;
    }
    let svd = matrix.clone().try_svd(true, true, f64::EPSILON, 10_000)?;
    let cut = 1e-13 * svd.singular_values.amax();
    let mut x = svd.solve(&right, cut).ok()?;
    // One refinement takes back what the singular value decomposition loses.
    x += svd.solve(&(&right - &matrix * &x), cut).ok()?;
    let residual = (&right - &matrix * &x).amax();
    let fine = residual.is_finite() && residual <= 1e-9 * (1.0 + right.amax());
    fine.then(|| (x.rows(0, n).into_owned(), -x.rows(n, k).into_owned()))
}

/// Whether the refined step satisfies what was left out and its multipliers have the right signs.
fn holds(problem: &Subproblem<'_>, step: &Step, active: &[Active]) -> bool {
    let slack = value_slack(step);
    let m = &step.multipliers;
    let sign = -sign_slack(m);
    let c = problem.inequality * &step.s + &problem.c;
    let inside =
        (0..step.s.len()).all(|j| step.s[j] >= problem.lower[j] - slack && step.s[j] <= problem.upper[j] + slack);
    let violated = |i: usize| m.inequality[i] >= problem.penalty;
    let rows = (0..c.len()).all(|i| m.inequality[i] >= sign && (c[i] >= -slack || violated(i)));
    let signs = m.low.iter().chain(m.high.iter()).all(|&y| y >= sign);
    let capped = active.iter().all(|row| match *row {
        Active::Equality(i) => m.equality[i].abs() <= problem.tie * 1.001,
        Active::Inequality(i) => m.inequality[i] <= problem.penalty * 1.001,
        Active::Low(_) | Active::High(_) => true,
    });
    step.s.norm() <= problem.radius && inside && rows && signs && capped
}
