//! One step of the method of order 8 and the estimate of its error.
//!
//! y1 = y0 + h sum b_i k_i with k_i = f(tau + c_i h, y0 + h sum a_ij k_j). The error estimate combines two embedded
//! methods of order 5 and 3 (Hairer, Norsett, Wanner, section II.10) so that it behaves like h^8.

use super::coefficients::{A, C, E3, E5, STAGES};
use crate::ode::{Blocks, OdeState, Tolerance};
use crate::scalar::{Scalar, filled};

/// The stages k_0 to k_11 of a step.
pub type Stages<V> = [V; STAGES];

/// Linear combination of the stages named, with the coefficients of one row of the tableau.
macro_rules! combine {
    ($y:expr, $h:expr, $k:expr, $row:expr; $($j:literal),+) => {
        $y.advance($h, [$($row[$j]),+], [$(&$k[$j]),+])
    };
}
pub(super) use combine;

/// The times of the stages 1 to 11 of a step, as fractions of it.
pub const NODES: [f64; STAGES - 1] = {
    let mut nodes = [0.0; STAGES - 1];
    let mut i = 0;
    while i < nodes.len() {
        nodes[i] = C[i + 1];
        i += 1;
    }
    nodes
};

/// The times of the stages 1 to 11 of a step, the last of which is its end.
#[inline(always)]
pub fn stage_times<T: Scalar>(tau: T, h: T) -> [T; STAGES - 1] {
    filled(tau, |i| tau.plus_times(C[i + 1], h))
}

/// The flow at the times of the stages of a step. A trait and not a closure: closures are not inlined where they are called
/// twelve times, and what is passed through memory is waited for.
pub trait Rates<V> {
    /// The flow at the time of stage `i` and at `y`.
    fn at(&self, i: usize, y: &V) -> V;
}

impl<V, F: Fn(usize, &V) -> V> Rates<V> for F {
    #[inline(always)]
    fn at(&self, i: usize, y: &V) -> V {
        self(i, y)
    }
}

/// One step of size `h` from `y`, given `k[0]`, the flow there, and the flow at the other stages. Fills these, returns the end
/// value.
#[inline(always)]
pub fn attempt<V: OdeState>(rates: &impl Rates<V>, h: V::Time, y: &V, k: &mut Stages<V>) -> V {
    rates.at(1, &combine!(y, h, k, A[1]; 0)).put(&mut k[1]);
    rates.at(2, &combine!(y, h, k, A[2]; 0, 1)).put(&mut k[2]);
    rates.at(3, &combine!(y, h, k, A[3]; 0, 2)).put(&mut k[3]);
    rates.at(4, &combine!(y, h, k, A[4]; 0, 2, 3)).put(&mut k[4]);
    rates.at(5, &combine!(y, h, k, A[5]; 0, 3, 4)).put(&mut k[5]);
    rates.at(6, &combine!(y, h, k, A[6]; 0, 3, 4, 5)).put(&mut k[6]);
    rates.at(7, &combine!(y, h, k, A[7]; 0, 3, 4, 5, 6)).put(&mut k[7]);
    rates.at(8, &combine!(y, h, k, A[8]; 0, 3, 4, 5, 6, 7)).put(&mut k[8]);
    rates.at(9, &combine!(y, h, k, A[9]; 0, 3, 4, 5, 6, 7, 8)).put(&mut k[9]);
    rates.at(10, &combine!(y, h, k, A[10]; 0, 3, 4, 5, 6, 7, 8, 9)).put(&mut k[10]);
    rates.at(11, &combine!(y, h, k, A[11]; 0, 3, 4, 5, 6, 7, 8, 9, 10)).put(&mut k[11]);
    combine!(y, h, k, A[12]; 0, 5, 6, 7, 8, 9, 10, 11)
}

/// Stages that the error estimate is made of, with their weights of orders 5 and 3.
pub const ERROR_WEIGHTS: [(usize, f64, f64); 8] = {
    let used = [0, 5, 6, 7, 8, 9, 10, 11];
    let mut weights = [(0, 0.0, 0.0); 8];
    let mut i = 0;
    while i < used.len() {
        weights[i] = (used[i], E5[used[i]], E3[used[i]]);
        i += 1;
    }
    weights
};

/// Error of a step relative to the tolerance: accepted where `<= 1`. The largest root mean square over the blocks; not
/// finite where any stage that matters is not.
#[inline(always)]
pub fn error<V: Blocks>(h: f64, y: &V, end: &V, k: &Stages<V>, tolerance: Tolerance) -> f64 {
    let e5 = combine!(V::ZERO, h, k, E5; 0, 5, 6, 7, 8, 9, 10, 11);
    let e3 = combine!(V::ZERO, h, k, E3; 0, 5, 6, 7, 8, 9, 10, 11);
    let mut worst = 0.0;
    y.blocks([end, &e5, &e3], &mut |start, [end, e5, e3]| {
        let block = block_error(start, end, e5, e3, tolerance);
        // NaN wins, and stays.
        if block > worst || block.is_nan() {
            worst = block;
        }
    });
    worst
}

#[inline(always)]
fn block_error(start: &[f64], end: &[f64], e5: &[f64], e3: &[f64], tolerance: Tolerance) -> f64 {
    let mut floor = 1.0_f64;
    for value in start {
        floor = floor.max(value.abs());
    }
    floor *= tolerance.absolute;
    let (mut sum5, mut sum3) = (0.0, 0.0);
    for i in 0..start.len() {
        let scale = 1.0 / (floor + tolerance.relative * start[i].abs().max(end[i].abs()));
        sum5 += (e5[i] * scale) * (e5[i] * scale);
        sum3 += (e3[i] * scale) * (e3[i] * scale);
        // `max` drops NaN, so the end value is asked explicitly.
        sum5 += end[i] * 0.0;
    }
    let denominator = sum5 + 0.01 * sum3;
    if denominator == 0.0 { 0.0 } else { sum5 / (denominator * start.len() as f64).sqrt() }
}

/// How far beyond the method's stability a step reaches: h times the largest rate at which solutions part, as the last
/// two stages show it, relative to the boundary of the stability region on the negative axis (about 6.1; Hairer, Norsett,
/// Wanner, section IV.2). Steps that keep above 1 are limited by stability, not by accuracy: the equation is stiff.
pub fn stiffness<V: Blocks>(h: f64, y: &V, end: &V, end_rates: &V, k: &Stages<V>) -> f64 {
    let last = combine!(y, h, k, A[11]; 0, 3, 4, 5, 6, 7, 8, 9, 10);
    let (mut rates, mut values) = (0.0, 0.0);
    y.blocks([end, end_rates, &last, &k[11]], &mut |_, [end, end_rates, last, k]| {
        for i in 0..end.len() {
            rates += (end_rates[i] - k[i]) * (end_rates[i] - k[i]);
            values += (end[i] - last[i]) * (end[i] - last[i]);
        }
    });
    if values > 0.0 { h * (rates / values).sqrt() / 6.1 } else { 0.0 }
}
