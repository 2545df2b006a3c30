//! Checks of a request before any work is done.

use crate::model::{ModelInfo, Section};
use crate::return_map::{Accuracy, MapRequest, Method, RequestError, Sensitivity};

/// Whether the request fits the model; where the section stands.
pub(crate) fn check(info: &'static ModelInfo, request: &MapRequest<'_>) -> Result<Section, RequestError> {
    let section = info.section.ok_or(RequestError::NoSection(info.name))?;
    values("section coordinates", request.coordinates, info.coordinates.len())?;
    values("parameters", request.parameters, info.parameters.len())?;
    values("memory", request.memory, info.memory.len())?;
    if let Sensitivity::CoordinatesAndParameters(chosen) = request.sensitivity
        && let Some(&worst) = chosen.iter().find(|i| **i >= info.parameters.len())
    {
        let what = "a parameter index of the sensitivity (counted from 0) is out of range: number of parameters";
        return Err(RequestError::Length { what, expected: info.parameters.len(), got: worst });
    }
    accuracy(&request.accuracy)?;
    if request.period == 0 {
        return Err(RequestError::Accuracy("`period` must be at least 1"));
    }
    if request.accuracy.method == Method::Explicit && !info.explicit {
        return Err(RequestError::NoExplicitFlow(info.name));
    }
    if request.accuracy.method == Method::Radau3 && info.explicit {
        return Err(RequestError::NoMassMatrix(info.name));
    }
    Ok(section)
}

/// Whether there are as many finite values as expected.
pub(super) fn values(what: &'static str, given: &[f64], expected: usize) -> Result<(), RequestError> {
    if given.len() != expected {
        return Err(RequestError::Length { what, expected, got: given.len() });
    }
    match given.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(RequestError::NotFinite { what, index }),
        None => Ok(()),
    }
}

/// Whether an accuracy makes sense.
pub(super) fn accuracy(a: &Accuracy) -> Result<(), RequestError> {
    // Written so that NaN fails.
    if !(a.relative >= 0.0 && a.relative < 1.0) {
        return Err(RequestError::Accuracy("`relative` tolerance must be at least 0 and below 1, e.g. 1e-12"));
    }
    if !(a.absolute > 0.0 && a.absolute.is_finite()) {
        return Err(RequestError::Accuracy("`absolute` tolerance must be positive, e.g. 1e-13"));
    }
    if !(a.time_limit > 0.0 && a.time_limit.is_finite()) {
        return Err(RequestError::Accuracy("the time limit must be positive and finite, e.g. 100 s"));
    }
    Ok(())
}
