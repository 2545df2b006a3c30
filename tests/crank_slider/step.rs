//! One step of the climber by piecewise Chebyshev collocation over the crank angle from 0 to pi, with exact variations.
//!
//! On each element the unknowns are the values of u = (Omega, q_theta, p_theta) at the Lobatto points; the equations
//! hold at all of them but the first, where the element before (or the start) gives the values. The last element so
//! imposes the equation at phi = pi too, where it reads Omega = omega_nl/G. Time is the integral of 1/Omega.

use super::chebyshev::Basis;
use super::machine::Machine;
use nalgebra::{DMatrix, DVector, Dyn, LU};
use std::f64::consts::PI;

/// How finely to divide a step.
#[derive(Clone, Debug)]
pub enum Mesh {
    /// Halve elements until the last coefficients are below this fraction of the largest value.
    Adaptive(f64),
    /// Element boundaries from 0 to pi.
    Fixed(Vec<f64>),
}

/// The solution on one element.
pub struct Element {
    /// Where it begins and ends.
    pub range: [f64; 2],
    /// u at the nodes.
    pub values: Vec<[f64; 3]>,
    /// Derivatives of the values with respect to the starting values, one matrix (3 x columns) a node.
    pub variations: Vec<DMatrix<f64>>,
}

/// The solution over one step.
pub struct Step {
    /// Elements from phi = 0 to pi.
    pub elements: Vec<Element>,
    /// Duration (s).
    pub duration: f64,
    /// Its derivatives with respect to the starting values.
    pub duration_gradient: Vec<f64>,
}

/// Narrowest element that the adaptive mesh tries.
const NARROWEST: f64 = 1e-7;

/// Solves a step from u at phi = 0, with variations along the columns of `directions` (3 x columns).
/// `None` where even the narrowest element is not solved, as when the crank would stop.
pub fn solve(
    machine: &Machine,
    basis: &Basis,
    mesh: &Mesh,
    start: [f64; 3],
    directions: &DMatrix<f64>,
) -> Option<Step> {
    let mut step = Step { elements: Vec::new(), duration: 0.0, duration_gradient: vec![0.0; directions.ncols()] };
    // Boundaries still ahead, the nearest last.
    let mut ahead = match mesh {
        Mesh::Adaptive(_) => vec![PI],
        Mesh::Fixed(boundaries) => boundaries[1..].iter().rev().copied().collect(),
    };
    let (mut at, mut u, mut du) = (0.0, start, directions.clone());
    while let Some(end) = ahead.last().copied() {
        let solved = newton(machine, basis, [at, end], u);
        let accepted = match (mesh, &solved) {
            (Mesh::Adaptive(bound), Some(solved)) => tail(basis, &solved.values) <= *bound,
            (Mesh::Adaptive(_), None) => false,
            (Mesh::Fixed(_), _) => true,
        };
        if !accepted {
            if end - at < NARROWEST {
                return None;
            }
            ahead.push(0.5 * (at + end));
            continue;
        }
        let Solved { values, matrix } = solved?;
        let element = Element {
            range: [at, end],
            variations: variations(&values, &matrix, machine, basis, [at, end], &du)?,
            values,
        };
        element.add_time(basis, &mut step);
        (at, u, du) = (end, element.values[basis.degree], element.variations[basis.degree].clone());
        step.elements.push(element);
        ahead.pop();
    }
    Some(step)
}

/// What Newton's method finds on one element: values at the nodes, and the matrix there.
struct Solved {
    values: Vec<[f64; 3]>,
    matrix: LU<f64, Dyn, Dyn>,
}

/// Newton's method on one element: values at the nodes and the factorised matrix at the solution.
fn newton(machine: &Machine, basis: &Basis, range: [f64; 2], start: [f64; 3]) -> Option<Solved> {
    let mut values = vec![start; basis.degree + 1];
    let mut last = f64::INFINITY;
    for _ in 0..25 {
        let (residual, matrix) = system(machine, basis, range, &values);
        let lu = matrix.lu();
        let change = lu.solve(&residual)?;
        let mut size = 0.0_f64;
        for j in 1..=basis.degree {
            for i in 0..3 {
                let delta = change[3 * (j - 1) + i];
                values[j][i] -= delta;
                size = size.max(delta.abs() / values[j][i].abs().max(1.0));
            }
        }
        if !size.is_finite() || values.iter().any(|u| u[0] <= 0.0) {
            return None;
        }
        // Quadratic convergence down to rounding: stop where it cannot get better.
        if size < 1e-10 && (size > 0.3 * last || size < 1e-15) {
            let (_, matrix) = system(machine, basis, range, &values);
            return Some(Solved { values, matrix: matrix.lu() });
        }
        last = size;
    }
    None
}

/// Residuals at the nodes but the first, and their derivatives with respect to the values there.
fn system(machine: &Machine, basis: &Basis, [from, to]: [f64; 2], values: &[[f64; 3]]) -> (DVector<f64>, DMatrix<f64>) {
    let n = basis.degree;
    let half = 0.5 * (to - from);
    let mut residual = DVector::zeros(3 * n);
    let mut matrix = DMatrix::zeros(3 * n, 3 * n);
    for j in 1..=n {
        let row = 3 * (j - 1);
        let (phi, slope) = at_node(basis, [from, to], values, j);
        let value = machine.residual(phi, values[j], slope);
        let (with_u, with_slope) = machine.linearised(phi, values[j], slope);
        for i in 0..3 {
            residual[row + i] = value[i];
            for k in 0..3 {
                matrix[(row + i, row + k)] += with_u[i][k];
            }
            for l in 1..=n {
                matrix[(row + i, 3 * (l - 1) + i)] += with_slope[i] * basis.derivative[(j, l)] / half;
            }
        }
    }
    (residual, matrix)
}

/// Crank angle and derivative of u at a node.
fn at_node(basis: &Basis, [from, to]: [f64; 2], values: &[[f64; 3]], j: usize) -> (f64, [f64; 3]) {
    let half = 0.5 * (to - from);
    // The dead centre is met exactly.
    let phi = if j == basis.degree { to } else { from + half * (1.0 + basis.nodes[j]) };
    let slope = std::array::from_fn(|i| {
        // Differences to the node itself: a constant has derivative zero to rounding of its changes, not of its size.
        (0..=basis.degree).map(|l| basis.derivative[(j, l)] * (values[l][i] - values[j][i])).sum::<f64>() / half
    });
    (phi, slope)
}

/// Derivatives of the values: the equations differentiated, so the same matrix with other right-hand sides.
fn variations(
    values: &[[f64; 3]],
    matrix: &LU<f64, Dyn, Dyn>,
    machine: &Machine,
    basis: &Basis,
    [from, to]: [f64; 2],
    start: &DMatrix<f64>,
) -> Option<Vec<DMatrix<f64>>> {
    let n = basis.degree;
    let half = 0.5 * (to - from);
    let mut right = DMatrix::zeros(3 * n, start.ncols());
    for j in 1..=n {
        let (phi, slope) = at_node(basis, [from, to], values, j);
        let (_, with_slope) = machine.linearised(phi, values[j], slope);
        for i in 0..3 {
            for c in 0..start.ncols() {
                right[(3 * (j - 1) + i, c)] = -with_slope[i] * basis.derivative[(j, 0)] / half * start[(i, c)];
            }
        }
    }
    let inner = matrix.solve(&right)?;
    let mut all = vec![start.clone()];
    all.extend((0..n).map(|j| inner.rows(3 * j, 3).into_owned()));
    Some(all)
}

/// Size of the last two coefficients relative to the largest value, the worst of the three components.
fn tail(basis: &Basis, values: &[[f64; 3]]) -> f64 {
    let n = basis.degree;
    let coefficient = |k: usize, i: usize| -> f64 { (0..=n).map(|j| basis.coefficients[(k, j)] * values[j][i]).sum() };
    (0..3)
        .map(|i| {
            let size = values.iter().map(|u| u[i].abs()).fold(1e-3, f64::max);
            (coefficient(n, i).abs() + coefficient(n - 1, i).abs() + coefficient(n - 2, i).abs()) / size
        })
        .fold(0.0, f64::max)
}

impl Element {
    /// Adds the integral of 1/Omega and its variations.
    fn add_time(&self, basis: &Basis, step: &mut Step) {
        let half = 0.5 * (self.range[1] - self.range[0]);
        for (j, weight) in basis.weights.iter().enumerate() {
            let omega = self.values[j][0];
            step.duration += half * weight / omega;
            for (c, gradient) in step.duration_gradient.iter_mut().enumerate() {
                *gradient -= half * weight * self.variations[j][(0, c)] / (omega * omega);
            }
        }
    }

    /// u at a crank angle of the element.
    pub fn at(&self, basis: &Basis, phi: f64) -> [f64; 3] {
        let x = (2.0 * phi - self.range[0] - self.range[1]) / (self.range[1] - self.range[0]);
        std::array::from_fn(|i| basis.interpolate(|j| self.values[j][i], x))
    }

    /// d Omega/d phi at a crank angle of the element.
    pub fn slope_at(&self, basis: &Basis, phi: f64) -> f64 {
        let x = (2.0 * phi - self.range[0] - self.range[1]) / (self.range[1] - self.range[0]);
        basis.interpolate(|j| at_node(basis, self.range, &self.values, j).1[0], x)
    }
}

impl Step {
    /// u at phi = pi.
    pub fn end(&self) -> [f64; 3] {
        self.elements.last().and_then(|element| element.values.last()).copied().unwrap_or([f64::NAN; 3])
    }

    /// Element boundaries, each element cut into `parts`.
    pub fn boundaries(&self, parts: usize) -> Vec<f64> {
        let inner = |e: &Element, i: usize| e.range[0] + (e.range[1] - e.range[0]) * i as f64 / parts as f64;
        let mut all: Vec<f64> = self.elements.iter().flat_map(|e| (0..parts).map(move |i| inner(e, i))).collect();
        all.push(PI);
        all
    }
}
