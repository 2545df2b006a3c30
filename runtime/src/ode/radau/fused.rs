//! Products that are added or subtracted in one go, where the processor can do that.

use crate::scalar::Scalar;

/// The rows of one state in the columns of another, stored by columns: `block[k][i]` is row i, column k.
pub(super) type Block<const S: usize> = [[f64; S]; S];

/// `target - factor * vector`. Here and below results are returned, not written through references that might be the
/// same: so several entries are worked on at once.
#[inline(always)]
fn less_scaled<const L: usize>(mut target: [f64; L], factor: f64, vector: [f64; L]) -> [f64; L] {
    for i in 0..L {
        target[i] = Scalar::mul_add(-factor, vector[i], target[i]);
    }
    target
}

/// `target - a * b`, entry by entry.
#[inline(always)]
pub(super) fn less_entries<const L: usize>(mut target: [f64; L], a: [f64; L], b: [f64; L]) -> [f64; L] {
    for i in 0..L {
        target[i] = Scalar::mul_add(-a[i], b[i], target[i]);
    }
    target
}

/// `a * b`, entry by entry.
#[inline(always)]
pub(super) fn entries<const L: usize>(mut a: [f64; L], b: [f64; L]) -> [f64; L] {
    for i in 0..L {
        a[i] *= b[i];
    }
    a
}

/// `factor * vector`.
#[inline(always)]
pub(super) fn scaled<const L: usize>(factor: f64, mut vector: [f64; L]) -> [f64; L] {
    for i in 0..L {
        vector[i] *= factor;
    }
    vector
}

/// `block * vector`.
#[inline(always)]
pub(super) fn applied<const S: usize>(block: &Block<S>, vector: [f64; S]) -> [f64; S] {
    let mut sum = [0.0; S];
    for k in 0..S {
        let column = block[k];
        for i in 0..S {
            sum[i] = Scalar::mul_add(column[i], vector[k], sum[i]);
        }
    }
    sum
}

/// `target - block * vector`.
#[inline(always)]
pub(super) fn less_applied<const S: usize>(mut target: [f64; S], block: &Block<S>, vector: [f64; S]) -> [f64; S] {
    for k in 0..S {
        target = less_scaled(target, vector[k], block[k]);
    }
    target
}
