//! Return maps that are formulas: one map with its derivatives, composed to any period.

use gaitc_runtime::model::{ModelInfo, Quantity};
use gaitc_runtime::return_map::{
    MapOutcome, MapRequest, MapResult, Method, RequestError, ReturnMap, Sensitivity, Statistics, Stop, StopReason,
};
use nalgebra::{DMatrix, DVector};

/// The image with its derivatives, d x d in coordinates (rows) and d x p in parameters; `None` where there is none.
pub type Image<const D: usize, const P: usize> = Option<([f64; D], [[f64; D]; D], [[f64; P]; D])>;

/// A map by its formula.
pub struct Formula<const D: usize, const P: usize> {
    info: &'static ModelInfo,
    image: fn(&[f64; D], &[f64; P]) -> Image<D, P>,
}

impl<const D: usize, const P: usize> Formula<D, P> {
    pub fn new(image: fn(&[f64; D], &[f64; P]) -> Image<D, P>) -> Self {
        let names = |count| -> &'static [Quantity] { vec![Quantity { name: "x", si: "1" }; count].leak() };
        let info = ModelInfo {
            name: "formula",
            parameters: names(P),
            states: names(D),
            coordinates: (0..D).collect::<Vec<_>>().leak(),
            measures: names(1),
            ..super::climbers::BLANK
        };
        Self { info: Box::leak(Box::new(info)), image }
    }
}

impl<const D: usize, const P: usize> ReturnMap for Formula<D, P> {
    fn info(&self) -> &'static ModelInfo {
        self.info
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        let start: [f64; D] = request.coordinates.try_into().unwrap();
        let p: [f64; P] = request.parameters.try_into().unwrap();
        let (mut z, mut dz, mut dp) = (start, DMatrix::identity(D, D), DMatrix::zeros(D, P));
        for _ in 0..request.period {
            let Some((image, a, b)) = (self.image)(&z, &p) else {
                let stop = Stop { reason: StopReason::NoEvent, time: 100.0, state: z.to_vec() };
                return Ok(MapOutcome::Stopped(stop));
            };
            let a = DMatrix::from_fn(D, D, |i, j| a[i][j]);
            dp = &a * dp + DMatrix::from_fn(D, P, |i, j| b[i][j]);
            dz = a * dz;
            z = image;
        }
        let jacobian = match request.sensitivity {
            Sensitivity::None => DMatrix::zeros(D, 0),
            Sensitivity::Coordinates => dz,
            Sensitivity::CoordinatesAndParameters(chosen) => {
                DMatrix::from_fn(D, D + chosen.len(), |i, j| if j < D { dz[(i, j)] } else { dp[(i, chosen[j - D])] })
            }
        };
        Ok(MapOutcome::Completed(Box::new(MapResult {
            coordinates: DVector::from_column_slice(&z),
            jacobian,
            state: DVector::from_column_slice(&start),
            end: DVector::from_column_slice(&z),
            duration: request.period as f64,
            duration_gradient: DVector::zeros(0),
            measures: DVector::from_element(usize::from(request.measures), z.iter().sum::<f64>()),
            measures_jacobian: DMatrix::zeros(0, 0),
            events: Vec::new(),
            also_zero: Vec::new(),
            statistics: Statistics::default(),
            method: Method::Explicit,
            warnings: Vec::new(),
        })))
    }
}
