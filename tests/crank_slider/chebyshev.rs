//! Chebyshev collocation on [-1, 1]: Lobatto points, differentiation, quadrature, interpolation, coefficients.

use nalgebra::DMatrix;
use std::f64::consts::PI;

/// What polynomials of one degree need.
pub struct Basis {
    /// Degree; there is one node more.
    pub degree: usize,
    /// Nodes x_j = -cos(pi j/degree), rising from -1 to 1.
    pub nodes: Vec<f64>,
    /// Derivative at node i of the polynomial through values at the nodes.
    pub derivative: DMatrix<f64>,
    /// Weights of the quadrature of Clenshaw and Curtis.
    pub weights: Vec<f64>,
    /// From values at the nodes to coefficients of the polynomials of Chebyshev.
    pub coefficients: DMatrix<f64>,
}

impl Basis {
    /// The basis of a degree, at least 2.
    pub fn new(degree: usize) -> Self {
        let n = degree;
        let angle = |j: usize| PI * j as f64 / n as f64;
        let end = |j: usize| if j == 0 || j == n { 2.0 } else { 1.0 };
        let sign = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut derivative = DMatrix::from_fn(n + 1, n + 1, |i, j| {
            // x_i - x_j as a product of sines, which does not cancel.
            let gap = 2.0 * (0.5 * (angle(i) + angle(j))).sin() * (0.5 * (angle(i) - angle(j))).sin();
            if i == j { 0.0 } else { end(i) / end(j) * sign(i + j) / gap }
        });
        for i in 0..=n {
            // Exactly zero for constants.
            derivative[(i, i)] = -derivative.row(i).sum();
        }
        let coefficients = DMatrix::from_fn(n + 1, n + 1, |k, j| {
            2.0 / (n as f64 * end(k) * end(j)) * (k as f64 * (PI - angle(j))).cos()
        });
        let integral = |k: usize| if k.is_multiple_of(2) { 2.0 / (1.0 - (k * k) as f64) } else { 0.0 };
        let weights = (0..=n).map(|j| (0..=n).map(|k| integral(k) * coefficients[(k, j)]).sum()).collect();
        let nodes = (0..=n).map(|j| -angle(j).cos()).collect();
        Self { degree, nodes, derivative, weights, coefficients }
    }

    /// Value at x in [-1, 1] of the polynomial through `values` at the nodes, by the barycentric formula.
    pub fn interpolate(&self, values: impl Fn(usize) -> f64, x: f64) -> f64 {
        let (mut above, mut below) = (0.0, 0.0);
        for (j, node) in self.nodes.iter().enumerate() {
            if x == *node {
                return values(j);
            }
            let half = if j == 0 || j == self.degree { 0.5 } else { 1.0 };
            let weight = half * if j.is_multiple_of(2) { 1.0 } else { -1.0 } / (x - node);
            above += weight * values(j);
            below += weight;
        }
        above / below
    }
}
