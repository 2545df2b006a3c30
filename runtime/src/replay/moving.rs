//! State and variations in any number, one step of them, and whether its error is within the tolerance.

use super::number::Number;
use crate::ode::explicit::{ERROR_WEIGHTS, Stages};
use crate::ode::{OdeState, Tolerance};

/// N states and C columns of their variations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moving<S, const N: usize, const C: usize> {
    /// The state.
    pub(crate) x: [S; N],
    /// Variations, one array a column.
    pub(crate) dx: [[S; N]; C],
}

impl<S: Number, const N: usize, const C: usize> Moving<S, N, C> {
    /// All zeros.
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self { x: [S::constant(0.0); N], dx: [[S::constant(0.0); N]; C] }
    }
}

/// `start + h * sum(weights[i] * stage(i))`. What the last stage adds comes last, in one operation: the rest is known before.
#[inline(always)]
fn combination<S: Number, const K: usize>(start: S, h: S, weights: &[f64; K], stage: impl Fn(usize) -> S) -> S {
    let last = K - 1;
    let mut known = start;
    if const { K > 1 } {
        let mut sum = stage(0).times(weights[0]);
        for s in 1..last {
            sum = sum.plus_times(weights[s], stage(s));
        }
        known = sum.mul_add(h, start);
    }
    stage(last).mul_add(h.times(weights[last]), known)
}

impl<S: Number, const N: usize, const C: usize> OdeState for Moving<S, N, C> {
    type Time = S;

    #[inline(always)]
    fn advance<const K: usize>(&self, h: S, weights: [f64; K], stages: [&Self; K]) -> Self {
        let mut result = Self::zero();
        for i in 0..N {
            result.x[i] = combination(self.x[i], h, &weights, |s| stages[s].x[i]);
        }
        for c in 0..C {
            for i in 0..N {
                result.dx[c][i] = combination(self.dx[c][i], h, &weights, |s| stages[s].dx[c][i]);
            }
        }
        result
    }

    #[inline(always)]
    fn put(self, slot: &mut Self) {
        for i in 0..N {
            slot.x[i] = self.x[i];
        }
        for c in 0..C {
            for i in 0..N {
                slot.dx[c][i] = self.dx[c][i];
            }
        }
    }
}

/// Where the error of a step, of the state and if wanted of all columns, is within the tolerance: the same norm that accepts
/// steps elsewhere.
#[inline(always)]
pub(crate) fn within<S: Number, const N: usize, const C: usize>(
    h: S,
    start: &Moving<S, N, C>,
    end: &Moving<S, N, C>,
    k: &Stages<Moving<S, N, C>>,
    tolerance: Tolerance,
    columns: bool,
) -> S::Mask {
    let mut ok = block(h, &start.x, &end.x, &|s, i| k[s].x[i], tolerance);
    for c in 0..if columns { C } else { 0 } {
        ok = S::and(ok, block(h, &start.dx[c], &end.dx[c], &|s, i| k[s].dx[c][i], tolerance));
    }
    ok
}

#[inline(always)]
fn block<S: Number, const N: usize>(
    h: S,
    start: &[S; N],
    end: &[S; N],
    stage: &impl Fn(usize, usize) -> S,
    tolerance: Tolerance,
) -> S::Mask {
    let larger = |a: S, b: S| S::select(a.less(b), b, a);
    let mut floor = S::constant(1.0);
    for i in 0..N {
        floor = larger(floor, start[i].abs());
    }
    let floor = floor.times(tolerance.absolute);
    let (mut sum5, mut sum3) = (S::constant(0.0), S::constant(0.0));
    for i in 0..N {
        let (mut e5, mut e3) = (S::constant(0.0), S::constant(0.0));
        for (s, five, three) in ERROR_WEIGHTS {
            let k = stage(s, i);
            (e5, e3) = (e5.plus_times(five, k), e3.plus_times(three, k));
        }
        let scale = h / floor.plus_times(tolerance.relative, larger(start[i].abs(), end[i].abs()));
        let (e5, e3) = (e5 * scale, e3 * scale);
        (sum5, sum3) = (e5.mul_add(e5, sum5), e3.mul_add(e3, sum3));
    }
    // sum5 / sqrt((sum5 + sum3 / 100) N) <= 1, false where it is not a number.
    (sum5 * sum5).less_equal(sum5.plus_times(0.01, sum3).times(N as f64))
}
