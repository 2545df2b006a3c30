//! What is integrated: a state with its integrals and the variations of both, one block of arrays.
//!
//! With x' = f(x) and I' = i(x), the columns v of variations obey v' = (df/dx) v + (df/dp) w and so on (the variational
//! equations); all are advanced by the same linear combinations of stages.

use crate::scalar::{Scalar, filled};

/// N states, Q integrals and C columns of their variations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bundle<const N: usize, const Q: usize, const C: usize> {
    /// The state.
    pub x: [f64; N],
    /// The integrals.
    pub q: [f64; Q],
    /// Variations of the state, one array a column.
    pub dx: [[f64; N]; C],
    /// Variations of the integrals, one array a column.
    pub dq: [[f64; Q]; C],
}

/// What a Runge-Kutta method needs to know of what it integrates.
pub trait OdeState: Copy {
    /// The numbers that time is counted in.
    type Time: Scalar;

    /// `self + h * sum(weights[i] * stages[i])`.
    fn advance<const S: usize>(&self, h: Self::Time, weights: [f64; S], stages: [&Self; S]) -> Self;

    /// Puts it in a place. Where components fill registers they go one by one: a copy in other pieces has to reach memory
    /// before a component can be read again.
    #[inline(always)]
    fn put(self, slot: &mut Self) {
        *slot = self;
    }
}

/// What error norms need to know of it.
pub trait Blocks: OdeState<Time = f64> {
    /// All zeros.
    const ZERO: Self;

    /// Calls `visit(block, start, end)` for each group of components that shares one error norm. The groups of `self`
    /// and `others` are passed side by side.
    fn blocks<const S: usize>(&self, others: [&Self; S], visit: &mut impl FnMut(&[f64], [&[f64]; S]));
}

impl<const N: usize, const Q: usize, const C: usize> Bundle<N, Q, C> {
    /// All zeros.
    pub const ZERO: Self = Self { x: [0.0; N], q: [0.0; Q], dx: [[0.0; N]; C], dq: [[0.0; Q]; C] };
}

impl<const N: usize, const Q: usize, const C: usize> OdeState for Bundle<N, Q, C> {
    type Time = f64;

    #[inline(always)]
    fn advance<const S: usize>(&self, h: f64, weights: [f64; S], stages: [&Self; S]) -> Self {
        // Plain loops: closures and array adapters would be compiled once for each method, model and width.
        let mut result = *self;
        for i in 0..N {
            let mut sum = 0.0;
            for s in 0..S {
                sum += weights[s] * stages[s].x[i];
            }
            result.x[i] += h * sum;
        }
        for i in 0..Q {
            let mut sum = 0.0;
            for s in 0..S {
                sum += weights[s] * stages[s].q[i];
            }
            result.q[i] += h * sum;
        }
        for c in 0..C {
            for i in 0..N {
                let mut sum = 0.0;
                for s in 0..S {
                    sum += weights[s] * stages[s].dx[c][i];
                }
                result.dx[c][i] += h * sum;
            }
            for i in 0..Q {
                let mut sum = 0.0;
                for s in 0..S {
                    sum += weights[s] * stages[s].dq[c][i];
                }
                result.dq[c][i] += h * sum;
            }
        }
        result
    }
}

impl<const N: usize, const Q: usize, const C: usize> Blocks for Bundle<N, Q, C> {
    const ZERO: Self = Bundle::ZERO;

    #[inline(always)]
    fn blocks<const S: usize>(&self, others: [&Self; S], visit: &mut impl FnMut(&[f64], [&[f64]; S])) {
        visit(&self.x, filled(&self.x[..], |s| &others[s].x[..]));
        visit(&self.q, filled(&self.q[..], |s| &others[s].q[..]));
        for c in 0..C {
            visit(&self.dx[c], filled(&self.x[..], |s| &others[s].dx[c][..]));
            visit(&self.dq[c], filled(&self.q[..], |s| &others[s].dq[c][..]));
        }
    }
}
