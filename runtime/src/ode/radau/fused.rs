//! Products that are added or subtracted in one go, where the processor can do that.

use crate::scalar::Scalar;

/// The rows of one state in the columns of another, stored by columns: `block[k][i]` is row i, column k.
pub(super) type Block<const S: usize> = [[f64; S]; S];

/// `target -= factor * vector`.
#[inline(always)]
pub(super) fn subtract_scaled<const L: usize>(target: &mut [f64; L], factor: f64, vector: &[f64; L]) {
    for i in 0..L {
        target[i] = Scalar::mul_add(-factor, vector[i], target[i]);
    }
}

/// `target -= a * b`, entry by entry.
#[inline(always)]
pub(super) fn subtract_entries<const L: usize>(target: &mut [f64; L], a: &[f64; L], b: &[f64; L]) {
    for i in 0..L {
        target[i] = Scalar::mul_add(-a[i], b[i], target[i]);
    }
}

/// `block * vector`.
#[inline(always)]
pub(super) fn applied<const S: usize>(block: &Block<S>, vector: &[f64; S]) -> [f64; S] {
    let mut sum = [0.0; S];
    for k in 0..S {
        for i in 0..S {
            sum[i] = Scalar::mul_add(block[k][i], vector[k], sum[i]);
        }
    }
    sum
}

/// `target -= block * vector`.
#[inline(always)]
pub(super) fn subtract_applied<const S: usize>(target: &mut [f64; S], block: &Block<S>, vector: &[f64; S]) {
    for k in 0..S {
        subtract_scaled(target, vector[k], &block[k]);
    }
}
