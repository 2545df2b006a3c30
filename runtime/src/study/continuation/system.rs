//! The equations of a branch of gaits: F(y) = P_k(z; p) - z = 0 in scaled unknowns y = (z / scale, (p - lower) / (upper - lower)).
//!
//! d equations in d + 1 unknowns. Their matrix A = dF/dy, d x (d + 1), holds the exact derivatives of the return map in section
//! coordinates and parameter. Coordinates of different units become comparable by their scales, the parameter by its range.

use crate::orbit::GaitRequest;
use crate::return_map::{
    MapOutcome, MapRequest, MapResult, Open, RequestError, ReturnMap, Sensitivity, Stop, StopReason,
};
use nalgebra::{DMatrix, DVector};

/// A map that has become so much shorter than that of the start is on its way to no length at all.
const COLLAPSED: f64 = 1e-5;

/// The equations of a branch.
#[derive(Clone)]
pub(super) struct System<'a> {
    pub(super) map: &'a dyn ReturnMap,
    /// Parameters, memory, accuracy, tolerance; its period is not used.
    pub(super) request: GaitRequest<'a>,
    /// Index of the parameter that varies.
    pub(super) parameter: usize,
    /// Its range (SI units).
    pub(super) range: (f64, f64),
    /// How many maps make one period.
    pub(super) period: usize,
    /// What a coordinate of 1 stands for (SI units), length d.
    pub(super) scale: DVector<f64>,
    /// Duration of a map at the start of the branch (s).
    pub(super) usual: f64,
}

/// A point with the equations evaluated there.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    /// Scaled unknowns, length d + 1.
    pub(super) y: DVector<f64>,
    /// dP/dz in SI units, d x d.
    pub(super) jacobian: DMatrix<f64>,
    /// A = dF/dy, d x (d + 1).
    pub(super) matrix: DMatrix<f64>,
    /// F(y), length d.
    pub(super) gap: DVector<f64>,
    /// Largest component of P(z) - z, each relative to `max(1, |z_i|)`.
    pub(super) residual: f64,
    /// Unit vector along the branch, length d + 1; zeros as long as it is not known.
    pub(super) tangent: DVector<f64>,
    /// Duration (s).
    pub(super) duration: f64,
    /// A state that has to return and does not.
    pub(super) open: Option<Open>,
}

impl Sample {
    /// Number of section coordinates.
    pub(super) fn coordinates(&self) -> usize {
        self.gap.len()
    }

    /// The scaled parameter.
    pub(super) fn s(&self) -> f64 {
        self.y[self.coordinates()]
    }

    /// The parameter's component of the tangent.
    pub(super) fn along_parameter(&self) -> f64 {
        self.tangent[self.coordinates()]
    }
}

impl<'a> System<'a> {
    /// The same equations for another period, with scales that also fit a point.
    pub(super) fn with_period(&self, period: usize, near: &Sample) -> Self {
        let z = self.section(&near.y);
        let scale = self.scale.zip_map(&z, |scale, z| scale.max(z.abs()));
        let usual = self.usual * period as f64 / self.period as f64;
        Self { period, scale, usual, ..self.clone() }
    }

    /// Scaled unknowns of another system of the same model.
    pub(super) fn rescaled(&self, from: &System<'_>, y: &DVector<f64>) -> DVector<f64> {
        let mut y = y.clone();
        for (i, (theirs, own)) in from.scale.iter().zip(&self.scale).enumerate() {
            y[i] *= theirs / own;
        }
        y
    }

    /// Section coordinates, SI units.
    pub(super) fn section(&self, y: &DVector<f64>) -> DVector<f64> {
        y.rows(0, self.scale.len()).component_mul(&self.scale)
    }

    /// The parameter's value, exactly that of an end where the scaled parameter is 0 or 1.
    pub(super) fn value(&self, y: &DVector<f64>) -> f64 {
        let (lower, upper) = self.range;
        match y[self.scale.len()] {
            1.0 => upper,
            s => lower + s * (upper - lower),
        }
    }

    /// All parameters at a point.
    pub(super) fn parameters(&self, y: &DVector<f64>) -> Vec<f64> {
        let mut parameters = self.request.parameters.to_vec();
        if let Some(value) = parameters.get_mut(self.parameter) {
            *value = self.value(y);
        }
        parameters
    }

    /// Evaluates the map at a point, with measures and without derivatives, or the other way round.
    pub(super) fn run(&self, y: &DVector<f64>, measures: bool) -> Result<MapOutcome, RequestError> {
        let (z, parameters, chosen) = (self.section(y), self.parameters(y), [self.parameter]);
        let derivatives = Sensitivity::CoordinatesAndParameters(&chosen);
        self.map.evaluate(&MapRequest {
            coordinates: z.as_slice(),
            parameters: &parameters,
            memory: self.request.memory,
            period: self.period,
            sensitivity: if measures { Sensitivity::None } else { derivatives },
            measures,
            accuracy: self.request.accuracy,
        })
    }

    /// The equations at a point, or why the map has no next section crossing there.
    pub(super) fn evaluate(&self, y: &DVector<f64>) -> Result<Result<Sample, Stop>, RequestError> {
        let stopped = |reason| Stop { reason, time: 0.0, state: Vec::new() };
        if y.iter().any(|v| !v.is_finite()) {
            return Ok(Err(stopped(StopReason::NotFinite)));
        }
        let map = match self.run(y, false)? {
            MapOutcome::Stopped(stop) => return Ok(Err(stop)),
            MapOutcome::Completed(map) => *map,
        };
        if map.jacobian.iter().chain(map.coordinates.iter()).any(|v| !v.is_finite()) {
            return Ok(Err(stopped(StopReason::NotFinite)));
        }
        if map.duration <= COLLAPSED * self.usual {
            return Ok(Err(Stop {
                reason: StopReason::Zeno,
                time: map.duration,
                state: map.state.as_slice().to_vec(),
            }));
        }
        Ok(Ok(self.sample(y, &map)))
    }

    fn sample(&self, y: &DVector<f64>, map: &MapResult) -> Sample {
        let d = self.scale.len();
        let z = self.section(y);
        let difference = &map.coordinates - &z;
        let residual = difference.zip_fold(&z, 0.0_f64, |worst, gap, z| worst.max(gap.abs() / z.abs().max(1.0)));
        let span = self.range.1 - self.range.0;
        let matrix = DMatrix::from_fn(d, d + 1, |i, j| {
            let column = if j < d { self.scale[j] } else { span };
            map.jacobian[(i, j)] * column / self.scale[i] - if i == j { 1.0 } else { 0.0 }
        });
        Sample {
            y: y.clone(),
            jacobian: map.jacobian.columns(0, d).into_owned(),
            matrix,
            gap: difference.component_div(&self.scale),
            residual,
            tangent: DVector::zeros(d + 1),
            duration: map.duration,
            open: map.open(self.map.info(), self.request.accuracy.relative),
        }
    }
}
