//! The unknowns in scaled form: varied parameters (0 to 1 over their ranges), section coordinates (in units of their
//! nominal size) and, when the spectral radius or the worst of several scenes is the objective, its epigraph variable.

use super::problem::Vary;
use crate::event::NOTHING;
use crate::return_map::MapResult;
use nalgebra::DMatrix;

/// Smallest epigraph variable, relative to the spectral radius at the start. At r = 0 the Jury inequalities have no
/// gradient in r; a map with a spectral radius this small is deadbeat for every practical purpose (and rounding moves
/// the multipliers of a defective matrix by more).
pub(super) const DEADBEAT: f64 = 1e-5;

/// A parameter that really varies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Free {
    /// Index into `info().parameters`.
    pub(super) parameter: usize,
    lower: f64,
    upper: f64,
}

/// The layout u = (parameters, section, epigraph) and its scales.
#[derive(Clone, Debug)]
pub(super) struct Variables {
    /// Varied parameters whose range is not a point.
    pub(super) free: Vec<Free>,
    /// Nominal size of each section coordinate.
    pub(super) nominal: Vec<f64>,
    /// Unit of the epigraph variable.
    pub(super) epigraph: Option<f64>,
    /// Least value of the epigraph variable in that unit.
    pub(super) floor: f64,
}

impl Variables {
    /// The varied parameters; ranges that are a point are left out.
    pub(super) fn free(vary: &[Vary]) -> Vec<Free> {
        vary.iter()
            .filter(|v| v.lower < v.upper)
            .map(|v| Free { parameter: v.parameter, lower: v.lower, upper: v.upper })
            .collect()
    }

    /// Length of u.
    pub(super) fn len(&self) -> usize {
        self.free.len() + self.nominal.len() + usize::from(self.epigraph.is_some())
    }

    /// Position of the first section coordinate.
    pub(super) fn section_at(&self) -> usize {
        self.free.len()
    }

    /// Position of the epigraph variable.
    pub(super) fn epigraph_at(&self) -> Option<usize> {
        self.epigraph.map(|_| self.free.len() + self.nominal.len())
    }

    /// Bounds of each unknown.
    pub(super) fn bounds(&self, i: usize) -> (f64, f64) {
        if i < self.free.len() {
            (0.0, 1.0)
        } else if Some(i) == self.epigraph_at() {
            (self.floor, f64::INFINITY)
        } else {
            (f64::NEG_INFINITY, f64::INFINITY)
        }
    }

    /// All parameters: `base` with the varied ones replaced.
    pub(super) fn parameters(&self, u: &[f64], base: &[f64]) -> Vec<f64> {
        let mut parameters = base.to_vec();
        for (free, &u) in self.free.iter().zip(u) {
            parameters[free.parameter] = free.value(u);
        }
        parameters
    }

    /// Section coordinates.
    pub(super) fn section(&self, u: &[f64]) -> Vec<f64> {
        self.nominal.iter().zip(&u[self.section_at()..]).map(|(scale, u)| scale * u).collect()
    }

    /// u from parameters, section and epigraph variable (SI units).
    pub(super) fn pack(&self, parameters: &[f64], section: &[f64], epigraph: f64) -> Vec<f64> {
        let mut u: Vec<f64> = self.free.iter().map(|free| free.fraction(parameters[free.parameter])).collect();
        u.extend(section.iter().zip(&self.nominal).map(|(z, scale)| z / scale));
        u.extend(self.epigraph.map(|unit| (epigraph / unit).max(self.floor)));
        u
    }

    /// What one unit of unknown number i is in SI units.
    pub(super) fn unit(&self, i: usize) -> f64 {
        let m = self.section_at();
        if i < m { self.free[i].range() } else { self.nominal.get(i - m).copied().or(self.epigraph).unwrap_or(1.0) }
    }
}

impl Free {
    /// Length of the range.
    pub(super) fn range(&self) -> f64 {
        self.upper - self.lower
    }

    /// Value at a fraction of the range; exactly the bounds at 0 and 1.
    pub(super) fn value(&self, fraction: f64) -> f64 {
        if fraction >= 1.0 { self.upper } else { (self.lower + fraction * self.range()).clamp(self.lower, self.upper) }
    }

    /// Where in the range a value lies, from 0 to 1.
    pub(super) fn fraction(&self, value: f64) -> f64 {
        ((value - self.lower) / self.range()).clamp(0.0, 1.0)
    }
}

/// Nominal size of each coordinate: its magnitude at the gait, or how far the gait moves (to first order) when the
/// parameters cross their ranges, whichever is larger; 1 where both vanish.
pub(super) fn nominal_sizes(map: &MapResult, section: &[f64], variables: &Variables) -> Vec<f64> {
    let d = section.len();
    let inverse = (DMatrix::identity(d, d) - map.jacobian.columns(0, d)).try_inverse();
    let shift = |i: usize| -> f64 {
        let Some(inverse) = &inverse else { return 0.0 };
        let move_of = |j: usize| (inverse.row(i) * map.jacobian.column(d + j))[0] * variables.unit(j);
        (0..variables.free.len()).map(move_of).fold(0.0, |a: f64, b| a.max(b.abs()))
    };
    (0..d)
        .map(|i| {
            let size = section[i].abs().max(shift(i).min(10.0 * section[i].abs().max(1.0)));
            if size > NOTHING && size.is_finite() { size } else { 1.0 }
        })
        .collect()
}
