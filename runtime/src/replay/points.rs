//! What replays are asked and what they answer, many maps at a time and without allocation once room is there.

use crate::model::ModelInfo;
use crate::return_map::{MapResult, RequestError};
use nalgebra::{DMatrix, DVector};

/// Starts of maps, row by row.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a> {
    /// Section coordinates, count x d, SI units.
    pub coordinates: &'a [f64],
    /// Parameters, count x P, or P for all points, SI units.
    pub parameters: &'a [f64],
}

/// Where maps lead, row by row, with d section coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images {
    /// Whether the plan held; where not, the rest is NaN.
    pub held: Vec<bool>,
    /// P(z), count x d.
    pub coordinates: Vec<f64>,
    /// dP/dz, count x d x d, each matrix by columns.
    pub jacobians: Vec<f64>,
    /// Durations (s).
    pub durations: Vec<f64>,
    /// Derivatives of the durations in z, count x d.
    pub duration_gradients: Vec<f64>,
}

/// A map with its first and second derivatives along n directions: the d section coordinates, then the chosen parameters.
#[derive(Clone, Debug)]
pub struct SecondOrder {
    /// P(z), length d.
    pub coordinates: DVector<f64>,
    /// First derivatives, d x n.
    pub jacobian: DMatrix<f64>,
    /// For each direction, the derivative of the first derivatives along it: d x n each, symmetric in the two directions.
    pub second: Vec<DMatrix<f64>>,
    /// Duration (s).
    pub duration: f64,
    /// Its first derivatives, length n.
    pub duration_gradient: DVector<f64>,
    /// Its second derivatives, n x n.
    pub duration_second: DMatrix<f64>,
}

impl<'a> Points<'a> {
    /// How many there are.
    ///
    /// # Errors
    /// When lengths do not fit the model, or a number is not finite.
    pub(crate) fn count(&self, info: &ModelInfo) -> Result<usize, RequestError> {
        let (d, p) = (info.coordinates.len(), info.parameters.len());
        let shared = self.parameters.len() == p;
        let count = match (self.coordinates.len().checked_div(d), self.parameters.len().checked_div(p)) {
            (Some(count), _) => count,
            (None, Some(count)) => count,
            (None, None) => 1,
        };
        length("section coordinates of all points", self.coordinates.len(), count * d)?;
        if !shared {
            length("parameters of all points", self.parameters.len(), count * p)?;
        }
        finite("section coordinates of all points", self.coordinates)?;
        finite("parameters of all points", self.parameters)?;
        Ok(count)
    }

    /// Coordinates and parameters of one point after the other, of a model with `d` and `p` of them.
    pub(crate) fn rows(&self, d: usize, p: usize) -> Rows<'a> {
        let last = |numbers: &[f64], length: usize| numbers.len().checked_div(length).unwrap_or(0).saturating_sub(1);
        Rows {
            coordinates: self.coordinates,
            parameters: self.parameters,
            d,
            p,
            last_coordinates: last(self.coordinates, d),
            last_parameters: last(self.parameters, p),
        }
    }
}

/// Points by rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<'a> {
    coordinates: &'a [f64],
    parameters: &'a [f64],
    d: usize,
    p: usize,
    last_coordinates: usize,
    last_parameters: usize,
}

impl Rows<'_> {
    /// Section coordinate `i` of a point; the last point stands in for those beyond it.
    #[inline]
    pub(crate) fn coordinate(&self, point: usize, i: usize) -> f64 {
        let row = point.min(self.last_coordinates);
        self.coordinates.get(row * self.d + i).copied().unwrap_or(f64::NAN)
    }

    /// Parameter `i` of a point; likewise.
    #[inline]
    pub(crate) fn parameter(&self, point: usize, i: usize) -> f64 {
        let row = point.min(self.last_parameters);
        self.parameters.get(row * self.p + i).copied().unwrap_or(f64::NAN)
    }

    /// Whether all points have the same parameters.
    #[inline]
    pub(crate) fn shared(&self) -> bool {
        self.last_parameters == 0
    }
}

fn length(what: &'static str, got: usize, expected: usize) -> Result<(), RequestError> {
    if got == expected { Ok(()) } else { Err(RequestError::Length { what, expected, got }) }
}

fn finite(what: &'static str, values: &[f64]) -> Result<(), RequestError> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(RequestError::NotFinite { what, index }),
        None => Ok(()),
    }
}

impl Images {
    /// Makes room for `count` maps of `d` coordinates.
    pub(crate) fn make_room(&mut self, count: usize, d: usize) {
        self.held.clear();
        self.held.resize(count, false);
        for (values, length) in [
            (&mut self.coordinates, count * d),
            (&mut self.jacobians, count * d * d),
            (&mut self.durations, count),
            (&mut self.duration_gradients, count * d),
        ] {
            values.clear();
            values.resize(length, f64::NAN);
        }
    }

    /// Puts the result of a full run in its place; false where a number is not finite.
    pub(crate) fn put(&mut self, point: usize, map: &MapResult) -> bool {
        let d = map.coordinates.len();
        let finite = map.coordinates.iter().chain(map.jacobian.iter()).all(|v| v.is_finite());
        let Some(held) = self.held.get_mut(point).filter(|_| finite) else {
            return false;
        };
        *held = true;
        for (values, length, from) in [
            (&mut self.coordinates, d, map.coordinates.as_slice()),
            (&mut self.jacobians, d * d, map.jacobian.as_slice()),
            (&mut self.durations, 1, &[map.duration][..]),
            (&mut self.duration_gradients, d, map.duration_gradient.as_slice()),
        ] {
            for (slot, value) in values.iter_mut().skip(point * length).zip(from) {
                *slot = *value;
            }
        }
        true
    }

    /// Appends more maps.
    pub(crate) fn append(&mut self, mut more: Self) {
        self.held.append(&mut more.held);
        self.coordinates.append(&mut more.coordinates);
        self.jacobians.append(&mut more.jacobians);
        self.durations.append(&mut more.durations);
        self.duration_gradients.append(&mut more.duration_gradients);
    }

    /// The Jacobian of a map, d x d.
    pub fn jacobian(&self, point: usize, d: usize) -> DMatrix<f64> {
        DMatrix::from_fn(d, d, |i, j| self.jacobians.get((point * d + j) * d + i).copied().unwrap_or(f64::NAN))
    }
}
