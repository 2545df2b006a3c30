//! gaitc's optimisation problems as a Python module: its own optimizer, and, for solvers that live in Python, the functions that it
//! optimises with their derivatives.
//!
//! Unknowns are x = (p, z): the varied parameters, then the section coordinates, all in SI units. Matrices are lists of rows.

mod functions;
mod gaits;

use functions::{Row, Values};
use gaitc::load::{Loaded, load};
use gaitc::problem::{Start, assemble};
use gaitc_runtime::optimize::{self, ConstraintKind, Problem, Sense, Settings, Status};
use gaitc_runtime::return_map::Accuracy;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;

/// A problem of a spec.
#[pyclass(frozen)]
struct Posed {
    /// With this problem alone.
    loaded: &'static Loaded,
    /// Posed at the spec's own values.
    problem: Problem<'static>,
}

#[pymethods]
impl Posed {
    /// The problem `name` of `model`, with maps of a relative accuracy; of its constraints those in `only`, as the spec writes them.
    #[new]
    #[pyo3(signature = (model, name, accuracy, only = None))]
    fn new(model: &str, name: &str, accuracy: f64, only: Option<Vec<String>>) -> PyResult<Self> {
        let mut loaded = load(model, None).map_err(wrong)?;
        loaded.spec.problems.retain(|problem| problem.name == name);
        let Some(problem) = loaded.spec.problems.first_mut() else {
            return Err(wrong(format!("`{model}` has no problem `{name}`")));
        };
        if let Some(only) = only {
            problem.constraints.retain(|constraint| only.contains(&constraint.text));
            if problem.constraints.len() != only.len() {
                return Err(wrong(format!("`{name}` of `{model}` does not have all of {only:?}")));
            }
        }
        // Lives as long as the process: a problem borrows its model.
        let loaded: &'static Loaded = Box::leak(Box::new(loaded));
        let problem = posed(loaded, loaded.parameters(), loaded.start(), accuracy)?;
        Ok(Self { loaded, problem })
    }

    /// Names, ranges and values: `varied`, `lower`, `upper`, `start` (of p), `coordinates`, `guess` (of z), `parameters` (all, by
    /// name), `maximise`, `margins` (their names), `scales`, `radius` (the bound on the spectral radius, or None).
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (info, problem) = (self.problem.map.info(), &self.problem);
        let name = |index: usize| info.parameters.get(index).map_or("", |quantity| quantity.name);
        let all: BTreeMap<&str, f64> =
            info.parameters.iter().map(|quantity| quantity.name).zip(problem.parameters.iter().copied()).collect();
        let coordinates: Vec<&str> =
            info.coordinates.iter().filter_map(|&i| info.states.get(i)).map(|state| state.name).collect();
        let margins = problem.constraints.iter().filter_map(|constraint| match constraint.kind {
            ConstraintKind::Margin { scale, .. } => Some((constraint.name.clone(), scale)),
            ConstraintKind::SpectralRadius { .. } => None,
        });
        let (margins, scales): (Vec<String>, Vec<f64>) = margins.unzip();
        let dict = PyDict::new(py);
        dict.set_item("varied", problem.vary.iter().map(|vary| name(vary.parameter)).collect::<Vec<_>>())?;
        dict.set_item("lower", problem.vary.iter().map(|vary| vary.lower).collect::<Vec<_>>())?;
        dict.set_item("upper", problem.vary.iter().map(|vary| vary.upper).collect::<Vec<_>>())?;
        dict.set_item("start", problem.vary.iter().map(|v| problem.parameters[v.parameter]).collect::<Vec<_>>())?;
        dict.set_item("coordinates", coordinates)?;
        dict.set_item("guess", problem.start.clone())?;
        dict.set_item("parameters", all)?;
        dict.set_item("maximise", problem.sense == Sense::Maximize)?;
        dict.set_item("margins", margins)?;
        dict.set_item("scales", scales)?;
        dict.set_item("radius", functions::radius(problem))?;
        Ok(dict)
    }

    /// The gait at p as (z, duration), from the spec's first guess or followed from the gait at its own values; None where none is
    /// found.
    fn gait(&self, p: Vec<f64>) -> PyResult<Option<(Vec<f64>, f64)>> {
        gaits::gait(&self.problem, &self.parameters(&p)?).map_err(wrong)
    }

    /// The functions of the problem at x; None where the map has no next step.
    fn values(&self, py: Python<'_>, p: Vec<f64>, z: Vec<f64>) -> PyResult<Option<Py<PyDict>>> {
        let values = functions::values(&self.problem, &self.parameters(&p)?, &z).map_err(wrong)?;
        values.map(|values| dict(py, &values)).transpose()
    }

    /// Derivatives of the map's Jacobian along x, one matrix for each unknown; None where the map has no next step near x.
    fn jacobian_derivative(&self, p: Vec<f64>, z: Vec<f64>) -> PyResult<Option<Vec<Vec<Row>>>> {
        functions::jacobian_derivative(&self.problem, &self.parameters(&p)?, &z).map_err(wrong)
    }

    /// gaitc's own optimizer from x, one start, its confirmation included.
    fn solve<'py>(&self, py: Python<'py>, p: Vec<f64>, z: Vec<f64>) -> PyResult<Bound<'py, PyDict>> {
        let accuracy = self.problem.settings.accuracy.relative;
        let problem = posed(self.loaded, self.parameters(&p)?, z, accuracy)?;
        let solution = optimize::solve(&problem).map_err(wrong)?;
        let found: Vec<f64> = problem.vary.iter().map(|vary| solution.parameters[vary.parameter]).collect();
        let dict = PyDict::new(py);
        dict.set_item("success", solution.status == Status::Optimal)?;
        dict.set_item("status", format!("{:?}", solution.status))?;
        dict.set_item("message", solution.message)?;
        dict.set_item("iterations", solution.iterations)?;
        dict.set_item("objective", solution.objective)?;
        dict.set_item("p", found)?;
        dict.set_item("z", solution.section)?;
        Ok(dict)
    }
}

impl Posed {
    /// All parameters, the varied ones as in `p`.
    fn parameters(&self, p: &[f64]) -> PyResult<Vec<f64>> {
        if p.len() != self.problem.vary.len() {
            return Err(wrong(format!("p: expected {} values, got {}", self.problem.vary.len(), p.len())));
        }
        let mut parameters = self.problem.parameters.clone();
        for (vary, value) in self.problem.vary.iter().zip(p) {
            parameters[vary.parameter] = *value;
        }
        Ok(parameters)
    }
}

/// The only problem of a model, to be searched from these parameters and section coordinates.
fn posed(
    loaded: &'static Loaded,
    parameters: Vec<f64>,
    section: Vec<f64>,
    accuracy: f64,
) -> PyResult<Problem<'static>> {
    let Some(problem) = loaded.spec.problems.first() else {
        return Err(wrong(format!("`{}` has no problem", loaded.spec.name)));
    };
    let accuracy = Accuracy { relative: accuracy, absolute: 0.1 * accuracy, ..Accuracy::default() };
    // Like for like: the long tests are of an answer that is given to people, and no other code has them.
    let settings = Settings { accuracy, long_tests: false, ..Settings::default() };
    Ok(assemble(loaded, &loaded.spec, problem, Start { parameters, section, settings }))
}

fn dict(py: Python<'_>, values: &Values) -> PyResult<Py<PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("image", &values.image)?;
    dict.set_item("jacobian", &values.jacobian)?;
    dict.set_item("duration", values.duration)?;
    dict.set_item("objective", values.objective.value)?;
    dict.set_item("gradient", &values.objective.gradient)?;
    dict.set_item("margins", values.margins.iter().map(|margin| margin.value).collect::<Vec<_>>())?;
    dict.set_item("margin_gradients", values.margins.iter().map(|margin| &margin.gradient).collect::<Vec<_>>())?;
    Ok(dict.unbind())
}

/// Anything that is wrong with a request, as Python's `ValueError`.
fn wrong(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pymodule]
fn gaitc_problem(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<Posed>()
}
