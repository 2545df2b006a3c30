//! The functions of a problem at one point, with derivatives along x = (p, z).

use gaitc_runtime::optimize::{Bound, ConstraintKind, Expression, Objective, Problem};
use gaitc_runtime::return_map::{MapOutcome, MapRequest, MapResult, Points, RequestError, Sensitivity};

/// A row of a matrix.
pub(crate) type Row = Vec<f64>;

/// A value and its gradient along x.
pub(crate) struct Derivative {
    pub(crate) value: f64,
    pub(crate) gradient: Row,
}

/// What one map gives.
pub(crate) struct Values {
    /// P(z; p).
    pub(crate) image: Vec<f64>,
    /// Its derivatives along x, one row a coordinate.
    pub(crate) jacobian: Vec<Row>,
    /// Time of the map (s).
    pub(crate) duration: f64,
    /// The objective as the spec writes it.
    pub(crate) objective: Derivative,
    /// The margins as the spec writes them.
    pub(crate) margins: Vec<Derivative>,
}

/// The bound on the spectral radius, where a problem has a constant one.
pub(crate) fn radius(problem: &Problem<'_>) -> Option<f64> {
    problem.constraints.iter().find_map(|constraint| match constraint.kind {
        ConstraintKind::SpectralRadius { bound: Bound::Constant(bound) } => Some(bound),
        _ => None,
    })
}

/// The functions at a point; `None` where the map has no next step. Not for problems that minimise the spectral radius.
pub(crate) fn values(
    problem: &Problem<'_>,
    parameters: &[f64],
    z: &[f64],
) -> Result<Option<Values>, Box<dyn std::error::Error>> {
    let varied = varied(problem);
    let Some(map) = map(problem, parameters, z, Sensitivity::CoordinatesAndParameters(&varied), true)? else {
        return Ok(None);
    };
    let Objective::Expression(objective) = &problem.objective else {
        return Err("the objective is not an expression of measures".into());
    };
    let along = Along { map: &map, parameters, varied: &varied, coordinates: z.len() };
    let margins = problem.constraints.iter().filter_map(|constraint| match &constraint.kind {
        ConstraintKind::Margin { margin, .. } => Some(along.derivative(margin.as_ref())),
        ConstraintKind::SpectralRadius { .. } => None,
    });
    Ok(Some(Values {
        image: map.coordinates.as_slice().to_vec(),
        jacobian: (0..z.len()).map(|i| along.order(|column| map.jacobian[(i, column)])).collect(),
        duration: map.duration,
        objective: along.derivative(objective.as_ref()),
        margins: margins.collect(),
    }))
}

/// Derivatives of dP/dz along each unknown: exact where the model has second-order sensitivities, else central differences of the
/// exact Jacobian. `None` where a map on the way has no next step.
pub(crate) fn jacobian_derivative(
    problem: &Problem<'_>,
    parameters: &[f64],
    z: &[f64],
) -> Result<Option<Vec<Vec<Row>>>, RequestError> {
    if let Some(exact) = second_order(problem, parameters, z)? {
        return Ok(Some(exact));
    }
    let mut all = Vec::new();
    for vary in &problem.vary {
        let step = STEP * (vary.upper - vary.lower);
        let at = |sign: f64| {
            let mut moved = parameters.to_vec();
            moved[vary.parameter] += sign * step;
            jacobian(problem, &moved, z)
        };
        all.push(difference(at(-1.0)?, at(1.0)?, step));
    }
    for (i, value) in z.iter().enumerate() {
        let step = STEP * value.abs().max(0.1);
        let at = |sign: f64| {
            let mut moved = z.to_vec();
            moved[i] += sign * step;
            jacobian(problem, parameters, &moved)
        };
        all.push(difference(at(-1.0)?, at(1.0)?, step));
    }
    Ok(all.into_iter().collect())
}

/// Step of a central difference as a part of the range or size: its error and the Jacobian's own meet near here.
const STEP: f64 = 1e-5;

fn second_order(problem: &Problem<'_>, parameters: &[f64], z: &[f64]) -> Result<Option<Vec<Vec<Row>>>, RequestError> {
    let varied = varied(problem);
    let (_, plan) = problem.map.plan(&request(problem, parameters, z, Sensitivity::Coordinates, false))?;
    let Some(plan) = plan else { return Ok(None) };
    let at = Points { coordinates: z, parameters };
    let Some(exact) = problem.map.second_order(&plan, at, &varied)? else { return Ok(None) };
    let (d, m) = (z.len(), varied.len());
    let rows = |direction: usize| -> Vec<Row> {
        (0..d).map(|i| (0..d).map(|j| exact.second[direction][(i, j)]).collect()).collect()
    };
    Ok(Some((d..d + m).chain(0..d).map(rows).collect()))
}

fn jacobian(problem: &Problem<'_>, parameters: &[f64], z: &[f64]) -> Result<Option<Vec<Row>>, RequestError> {
    let d = z.len();
    let map = map(problem, parameters, z, Sensitivity::Coordinates, false)?;
    Ok(map.map(|map| (0..d).map(|i| (0..d).map(|j| map.jacobian[(i, j)]).collect()).collect()))
}

fn difference(before: Option<Vec<Row>>, after: Option<Vec<Row>>, step: f64) -> Option<Vec<Row>> {
    let (before, after) = (before?, after?);
    let row = |(a, b): (&Row, &Row)| a.iter().zip(b).map(|(a, b)| (b - a) / (2.0 * step)).collect();
    Some(before.iter().zip(&after).map(row).collect())
}

fn varied(problem: &Problem<'_>) -> Vec<usize> {
    problem.vary.iter().map(|vary| vary.parameter).collect()
}

fn request<'a>(
    problem: &'a Problem<'_>,
    parameters: &'a [f64],
    z: &'a [f64],
    sensitivity: Sensitivity<'a>,
    measures: bool,
) -> MapRequest<'a> {
    MapRequest {
        coordinates: z,
        parameters,
        memory: &problem.memory,
        period: problem.period,
        sensitivity,
        measures,
        accuracy: problem.settings.accuracy,
    }
}

fn map(
    problem: &Problem<'_>,
    parameters: &[f64],
    z: &[f64],
    sensitivity: Sensitivity<'_>,
    measures: bool,
) -> Result<Option<MapResult>, RequestError> {
    match problem.map.evaluate(&request(problem, parameters, z, sensitivity, measures))? {
        MapOutcome::Completed(map) => Ok(Some(*map)),
        MapOutcome::Stopped(_) => Ok(None),
    }
}

/// Derivatives of a map put into the order of x.
struct Along<'a> {
    map: &'a MapResult,
    parameters: &'a [f64],
    varied: &'a [usize],
    coordinates: usize,
}

impl Along<'_> {
    /// The map's columns are coordinates first, then parameters.
    fn order(&self, column: impl Fn(usize) -> f64) -> Row {
        let (d, m) = (self.coordinates, self.varied.len());
        (d..d + m).chain(0..d).map(column).collect()
    }

    fn derivative(&self, expression: &dyn Expression) -> Derivative {
        let value = expression.evaluate(self.map.measures.as_slice(), self.parameters);
        let measured = |column: usize| -> f64 {
            value.dmeasures.iter().enumerate().map(|(i, slope)| slope * self.map.measures_jacobian[(i, column)]).sum()
        };
        let mut gradient = self.order(measured);
        for (total, &parameter) in gradient.iter_mut().zip(self.varied) {
            *total += value.dparameters[parameter];
        }
        Derivative { value: value.value, gradient }
    }
}
