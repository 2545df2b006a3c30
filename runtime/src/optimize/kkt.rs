//! The Karush-Kuhn-Tucker conditions: how far a point and its multipliers are from a local optimum.

use super::linearisation::Linearisation;
use super::program::{Point, Program};
use super::subproblem::Multipliers;
use nalgebra::DVector;

/// Smallest singular value, relative to the largest, of a periodicity that determines its gait well.
const NEARLY_SINGULAR: f64 = 1e-4;

/// Residuals in scaled quantities.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kkt {
    /// Largest component of the Lagrangian's gradient, or product of a multiplier and its slack.
    pub(super) optimality: f64,
    /// Largest violation of a constraint.
    pub(super) feasibility: f64,
}

impl Kkt {
    /// The larger one.
    pub(super) fn residual(self) -> f64 {
        self.optimality.max(self.feasibility)
    }
}

/// Gradient of the Lagrangian without the bounds: g - A'y - C'lambda.
pub(super) fn lagrangian_gradient(lin: &Linearisation, m: &Multipliers) -> DVector<f64> {
    &lin.f - lin.h.tr_mul(&m.equality) - lin.c.tr_mul(&m.inequality)
}

/// The same with the multipliers of the periodicity made anew, so that it vanishes in the section coordinates.
///
/// A measure such as `cycle_max` can be taken at the start or at the end of a map; on a gait both are the same, and rounding
/// decides which it is. Their gradients differ by that of the periodicity, so its multiplier has to go with the choice.
/// Where the coordinates alone do not determine the gait (a fold) the multipliers stay as they are.
pub(super) fn gait_gradient(program: &Program<'_>, lin: &Linearisation, m: &Multipliers) -> DVector<f64> {
    let (at, d) = (program.variables.section_at(), lin.h.nrows());
    if d == 0 {
        return lagrangian_gradient(lin, m);
    }
    let by_section = lin.h.columns(at, d).transpose();
    let right = (&lin.f - lin.c.tr_mul(&m.inequality)).rows(at, d).into_owned();
    let svd = by_section.svd(true, true);
    if svd.singular_values.min() < NEARLY_SINGULAR * svd.singular_values.max().max(1.0) {
        return lagrangian_gradient(lin, m);
    }
    match svd.solve(&right, 0.0) {
        Ok(equality) => lagrangian_gradient(lin, &Multipliers { equality, ..m.clone() }),
        Err(_) => lagrangian_gradient(lin, m),
    }
}

/// Residuals at a point.
pub(super) fn kkt(program: &Program<'_>, point: &Point, lin: &Linearisation, m: &Multipliers) -> Kkt {
    // Large multipliers magnify rounding; the residual is relative to them (as in IPOPT).
    let scale = (m.largest() / 100.0).max(1.0);
    let stationarity = (lagrangian_gradient(lin, m) - &m.low + &m.high).amax();
    let mut complementarity: f64 = 0.0;
    for (lambda, c) in m.inequality.iter().zip(point.c.iter()) {
        complementarity = complementarity.max((lambda * c).abs());
    }
    for i in 0..program.len() {
        let (lower, upper) = program.variables.bounds(i);
        if m.low[i] > 0.0 {
            complementarity = complementarity.max(m.low[i] * (point.u[i] - lower).abs());
        }
        if m.high[i] > 0.0 {
            complementarity = complementarity.max(m.high[i] * (upper - point.u[i]).abs());
        }
    }
    Kkt { optimality: stationarity.max(complementarity) / scale, feasibility: infeasibility(point) }
}

/// Largest violation of a constraint at a point.
pub(super) fn infeasibility(point: &Point) -> f64 {
    point.c.iter().fold(point.h.amax(), |worst, c| worst.max(-c))
}
