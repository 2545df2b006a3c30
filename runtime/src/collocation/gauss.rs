//! The Gauss-Legendre method with S stages, order 2 S: collocation at the zeros of the Legendre polynomial.
//!
//! Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, section II.7.

/// Number of stages.
pub(super) const S: usize = 6;
/// Newton's method for the zeros converges quadratically from the usual guess.
const NEWTON_STEPS: usize = 8;

/// Coefficients on [0, 1].
#[derive(Clone, Copy, Debug)]
pub(super) struct Gauss {
    /// Nodes.
    pub(super) c: [f64; S],
    /// Weights.
    pub(super) b: [f64; S],
    /// a_ij: the integral of the j-th Lagrange polynomial up to the i-th node.
    pub(super) a: [[f64; S]; S],
}

impl Gauss {
    /// The method.
    pub(super) fn new() -> Self {
        let (mut c, mut b) = ([0.0; S], [0.0; S]);
        for i in 0..S {
            let mut x = -(core::f64::consts::PI * (i as f64 + 0.75) / (S as f64 + 0.5)).cos();
            for _ in 0..NEWTON_STEPS {
                let (p, slope) = legendre(x);
                x -= p / slope;
            }
            let (_, slope) = legendre(x);
            c[i] = 0.5 * (1.0 + x);
            b[i] = 1.0 / ((1.0 - x * x) * slope * slope);
        }
        let lagrange =
            |j: usize, x: f64| -> f64 { (0..S).filter(|k| *k != j).map(|k| (x - c[k]) / (c[j] - c[k])).product() };
        // The rule itself integrates the polynomials exactly, also on a part of the interval.
        let integral =
            |i: usize, j: usize| -> f64 { c[i] * (0..S).map(|k| b[k] * lagrange(j, c[i] * c[k])).sum::<f64>() };
        let a = core::array::from_fn(|i| core::array::from_fn(|j| integral(i, j)));
        Self { c, b, a }
    }
}

/// Legendre polynomial of degree S and its derivative, by the three-term recursion.
fn legendre(x: f64) -> (f64, f64) {
    let (mut before, mut p) = (1.0, x);
    for n in 2..=S {
        let n = n as f64;
        (before, p) = (p, ((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n);
    }
    (p, S as f64 * (x * p - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_integrates_polynomials_up_to_its_order_and_its_stages_up_to_theirs() {
        let gauss = Gauss::new();
        for power in 0..2 * S as i32 {
            let sum: f64 = gauss.b.iter().zip(gauss.c).map(|(b, c)| b * c.powi(power)).sum();
            approx::assert_relative_eq!(sum, 1.0 / f64::from(power + 1), epsilon = 1e-14);
        }
        for (row, upper) in gauss.a.iter().zip(gauss.c) {
            for power in 0..S as i32 {
                let sum: f64 = row.iter().zip(gauss.c).map(|(a, c)| a * c.powi(power)).sum();
                approx::assert_relative_eq!(sum, upper.powi(power + 1) / f64::from(power + 1), epsilon = 1e-14);
            }
        }
    }
}
