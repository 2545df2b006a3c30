//! Error of a step, by an embedded formula of order S.
//!
//! The embedded solution adds to the collocation formula h gamma k_0 with the rate k_0 at the start of the step and an
//! implicit term h gamma k at its end (Hairer, Wanner, section IV.8). Its distance e from the step's end obeys, to first
//! order, (F_k + h gamma F_x) e = F_k d with d = h gamma (k_0 - u'(0)): the collocation polynomial's rate at the start
//! against the true one. Where the mass matrix vanishes at the end of the step, so does the error of the states that it makes
//! stiff, as it should: they are slaved there.
//!
//! e behaves like h^(S+1), the step's own error like h^(2S): the tolerance for e is the user's to the power
//! (S+1)/(2S), as in the code RADAU of Hairer and Wanner, times a factor. States that the mass matrix makes stiff have no more
//! than the order of e, but are forgotten as fast as they react; where rates are read from them (in functionals), the factor
//! has to be small.

use super::coefficients::Tableau;
use super::stages::Workspace;
use crate::model::Linearised;
use crate::ode::{Blocks, Bundle, Tolerance};
use crate::scalar::filled;

/// The tolerance for the error estimate of a method with `stages` stages; `factor` as said above.
pub fn tolerance_of_estimate(tolerance: Tolerance, stages: usize, factor: f64) -> Tolerance {
    let exponent = (stages + 1) as f64 / (2 * stages) as f64;
    let map = |value: f64| factor * value.powf(exponent);
    if tolerance.relative > 0.0 {
        let relative = map(tolerance.relative);
        Tolerance { relative, absolute: relative * (tolerance.absolute / tolerance.relative) }
    } else {
        Tolerance { relative: 0.0, absolute: map(tolerance.absolute) }
    }
}

impl<const S: usize> Tableau<S> {
    /// d = h gamma (k_0 - u'(0)).
    pub fn defect<V: Blocks>(&self, h: f64, start_rates: &V, k: &[V; S]) -> V {
        let at_start = V::ZERO.advance(1.0, self.coefficient(0), k.each_ref());
        V::ZERO.advance(h * self.gamma, [1.0, -1.0], [start_rates, &at_start])
    }
}

impl<const N: usize, const S: usize> Workspace<N, S> {
    /// Factorises F_k + h gamma F_x at the end of the step that was solved for last: it turns a defect into an error.
    pub fn factorise_filter(&mut self, h_gamma: f64) -> bool {
        let at = &self.end;
        self.filter.resize(N);
        self.filter_scales = row_scales(at, h_gamma);
        for b in 0..N {
            let column = self.filter.column(b);
            for a in 0..N {
                column[a] = self.filter_scales[a] * (at.dk[b][a] + h_gamma * at.dx[b][a]);
            }
        }
        self.filter.invert()
    }

    /// (F_k + h gamma F_x)^-1 F_k d, with the h gamma of [`Self::factorise_filter`].
    pub fn filtered(&mut self, d: &[f64; N]) -> [f64; N] {
        let mut right = [0.0; N];
        for b in 0..N {
            for a in 0..N {
                right[a] += self.end.dk[b][a] * d[b];
            }
        }
        for a in 0..N {
            right[a] *= self.filter_scales[a];
        }
        let e = self.filter.solve(&right);
        filled(0.0, |a| e[a])
    }
}

/// The inverse of the largest derivative of each equation; 1 where all vanish, which is found when factorising.
fn row_scales<const N: usize>(at: &Linearised<f64, N>, h: f64) -> [f64; N] {
    let mut largest = [0.0_f64; N];
    for b in 0..N {
        for a in 0..N {
            largest[a] = largest[a].max(at.dk[b][a].abs()).max((h * at.dx[b][a]).abs());
        }
    }
    largest.map(|v| if v > 0.0 { 1.0 / v } else { 1.0 })
}

/// Largest root mean square of `e` over the blocks of `start`, relative to the tolerance; NaN wins.
pub fn size<const N: usize, const W: usize, const C: usize>(
    start: &Bundle<N, W, C>,
    end: &Bundle<N, W, C>,
    e: &Bundle<N, W, C>,
    tolerance: Tolerance,
) -> f64 {
    let mut worst = 0.0;
    start.blocks([end, e], &mut |start, [end, e]| {
        let block = block_size(start, end, e, tolerance);
        if block > worst || block.is_nan() {
            worst = block;
        }
    });
    worst
}

fn block_size(start: &[f64], end: &[f64], e: &[f64], tolerance: Tolerance) -> f64 {
    if start.is_empty() {
        return 0.0;
    }
    let mut floor = 1.0_f64;
    for value in start {
        floor = floor.max(value.abs());
    }
    floor *= tolerance.absolute;
    let mut sum = 0.0;
    for i in 0..start.len() {
        let scaled = e[i] / (floor + tolerance.relative * start[i].abs().max(end[i].abs()));
        sum += scaled * scaled + end[i] * 0.0;
    }
    (sum / start.len() as f64).sqrt()
}
