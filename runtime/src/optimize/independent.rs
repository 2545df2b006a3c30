//! The gait's map and Jacobian by another route than the one that the search took.
//!
//! Models with an explicit flow: the other of the two families of methods, explicit Runge-Kutta or Radau. Models with a
//! mass matrix, and where that other method gives up: Gauss collocation on a fixed grid (module `collocation`), whose
//! Jacobian is made of differences of its own maps. Collocation does not control its error; two grids and two differences
//! tell what it may be off by, and what is not exact enough to judge by is not judged by.

use super::problem::Problem;
use super::solution::{Independent, Route};
use crate::orbit::multipliers;
use crate::return_map::{Accuracy, MapOutcome, MapRequest, MapResult, Method, RequestError, Sensitivity};
use nalgebra::{Complex, DMatrix, DVector};

/// Steps a stretch between transitions is cut into, the coarsest grid first.
const GRIDS: [usize; 4] = [16, 24, 36, 54];
/// Two grids that agree so well, relative to the coordinates' sizes, are fine enough ...
const FINE: f64 = 1e-10;
/// ... and two that agree no better say nothing.
const COARSE: f64 = 1e-6;
/// Step of the differences, relative to the coordinates' sizes.
const STEP: f64 = 1e-4;
/// Tolerances of the image and of the Jacobian, and in multiples of the maps' relative tolerance.
const IMAGE: (f64, f64) = (1e-8, 1e3);
const JACOBIAN: (f64, f64) = (1e-6, 1e5);
/// A route's own uncertainty counts so many times.
const UNCERTAIN: f64 = 10.0;

/// Map and Jacobian at a gait as the search has them.
pub(super) struct Claimed<'c> {
    pub(super) parameters: &'c [f64],
    pub(super) section: &'c [f64],
    pub(super) map: &'c MapResult,
    pub(super) sizes: &'c DVector<f64>,
}

/// What another route finds, in scaled coordinates.
struct Found {
    route: Route,
    image: DVector<f64>,
    jacobian: DMatrix<f64>,
    /// What image and Jacobian may be off by.
    uncertain: (f64, f64),
}

/// Compares; `None` where there is no other route.
///
/// # Errors
/// What disagrees, in words.
pub(super) fn independent(problem: &Problem<'_>, claimed: &Claimed<'_>) -> Result<Option<Independent>, String> {
    let found = match other_method(problem, claimed).map_err(words)? {
        Some(found) => Some(found),
        None => match collocated(problem, claimed).map_err(words)? {
            Some(found) => Some(found),
            None => by(problem, claimed, Method::Radau3).map_err(words)?,
        },
    };
    found.map(|found| judge(problem, claimed, &found)).transpose()
}

fn words(error: RequestError) -> String {
    error.to_string()
}

fn judge(problem: &Problem<'_>, claimed: &Claimed<'_>, found: &Found) -> Result<Independent, String> {
    let relative = problem.settings.accuracy.relative;
    let jacobian = scaled(&claimed.map.jacobian, claimed.sizes);
    let image = (&found.image - claimed.map.coordinates.component_div(claimed.sizes)).amax();
    let by = (&found.jacobian - &jacobian).amax() / jacobian.amax().max(1e-3);
    let independent = Independent {
        route: found.route,
        image,
        jacobian: by,
        multipliers: apart(&multipliers(&jacobian), &multipliers(&found.jacobian)),
        uncertainty: found.uncertain.0,
    };
    let bound =
        |(least, multiple): (f64, f64), uncertain: f64| least.max(multiple * relative).max(UNCERTAIN * uncertain);
    let compared =
        [("the map", image, bound(IMAGE, found.uncertain.0)), ("the Jacobian", by, bound(JACOBIAN, found.uncertain.1))];
    match compared.into_iter().find(|(_, value, bound)| value.is_nan() || value > bound) {
        Some((what, value, bound)) => Err(format!(
            "{what} differs from that by {} by {value:.1e}, where {bound:.0e} is allowed",
            found.route.words()
        )),
        None => Ok(independent),
    }
}

/// Jacobian in the coordinates' sizes.
pub(super) fn scaled(jacobian: &DMatrix<f64>, sizes: &DVector<f64>) -> DMatrix<f64> {
    let d = sizes.len();
    DMatrix::from_fn(d, d, |i, j| jacobian[(i, j)] * sizes[j] / sizes[i])
}

/// Largest distance of a multiplier from the nearest of the others, relative to the largest magnitude.
fn apart(a: &[Complex<f64>], b: &[Complex<f64>]) -> f64 {
    let size = a.first().map_or(0.0, |m| m.norm());
    let nearest = |m: &Complex<f64>| b.iter().map(|other| (m - other).norm()).fold(f64::INFINITY, f64::min);
    let worst = a.iter().map(nearest).fold(0.0, f64::max);
    if worst > 0.0 { worst / size.max(1e-9) } else { 0.0 }
}

/// The other family of methods, for models with an explicit flow.
fn other_method(problem: &Problem<'_>, claimed: &Claimed<'_>) -> Result<Option<Found>, RequestError> {
    match (problem.map.info().explicit, claimed.map.method) {
        (true, Method::Explicit) => by(problem, claimed, Method::Radau5),
        (true, _) => by(problem, claimed, Method::Explicit),
        (false, _) => Ok(None),
    }
}

/// Map and Jacobian by a method; `None` where it does not reach the section, or is the one that was used.
fn by(problem: &Problem<'_>, claimed: &Claimed<'_>, method: Method) -> Result<Option<Found>, RequestError> {
    let info = problem.map.info();
    if method == claimed.map.method || (method == Method::Radau3 && info.explicit) {
        return Ok(None);
    }
    let accuracy = Accuracy { method, ..problem.settings.accuracy };
    let request = MapRequest { sensitivity: Sensitivity::Coordinates, accuracy, ..request(problem, claimed) };
    Ok(match problem.map.evaluate(&request)? {
        // Maps in closed form know no methods: what they say is no second route.
        MapOutcome::Completed(map) if map.method == method => Some(Found {
            route: Route::Method(method),
            image: map.coordinates.component_div(claimed.sizes),
            jacobian: scaled(&map.jacobian, claimed.sizes),
            uncertain: (0.0, 0.0),
        }),
        _ => None,
    })
}

fn request<'r>(problem: &'r Problem<'_>, claimed: &Claimed<'r>) -> MapRequest<'r> {
    MapRequest {
        coordinates: claimed.section,
        parameters: claimed.parameters,
        memory: &problem.memory,
        period: problem.period,
        sensitivity: Sensitivity::None,
        measures: false,
        accuracy: problem.settings.accuracy,
    }
}

/// By Gauss collocation; `None` where it does not reach the section, or not exactly enough.
fn collocated(problem: &Problem<'_>, claimed: &Claimed<'_>) -> Result<Option<Found>, RequestError> {
    if !claimed.map.warnings.is_empty() {
        return Ok(None);
    }
    let stretches = stretches(claimed.map);
    let z = DVector::from_column_slice(claimed.section);
    let at = |z: &DVector<f64>, steps: usize| -> Result<Option<DVector<f64>>, RequestError> {
        let request = MapRequest { coordinates: z.as_slice(), ..request(problem, claimed) };
        let image = problem.map.collocate(&request, &stretches, steps)?;
        Ok(image.map(|image| image.component_div(claimed.sizes)))
    };
    let Some((steps, image, off)) = finest(|steps| at(&z, steps))? else {
        return Ok(None);
    };
    let d = z.len();
    let (mut jacobian, mut rough) = (DMatrix::zeros(d, d), 0.0_f64);
    for j in 0..d {
        let mut images = Vec::new();
        for offset in [-2.0, -1.0, 1.0, 2.0] {
            let mut z = z.clone();
            z[j] += offset * STEP * claimed.sizes[j];
            let Some(image) = at(&z, steps)? else {
                return Ok(None);
            };
            images.push(image);
        }
        let narrow = (&images[2] - &images[1]) / (2.0 * STEP);
        let wide = (&images[3] - &images[0]) / (4.0 * STEP);
        let column = (&narrow * 4.0 - wide) / 3.0;
        rough = rough.max((&column - &narrow).amax());
        jacobian.set_column(j, &column);
    }
    Ok(Some(Found { route: Route::Collocation { steps }, image, jacobian, uncertain: (off, rough) }))
}

/// The coarsest grid that agrees with the one before it, its image, and by how much they differ.
fn finest(
    image: impl Fn(usize) -> Result<Option<DVector<f64>>, RequestError>,
) -> Result<Option<(usize, DVector<f64>, f64)>, RequestError> {
    let mut best: Option<(usize, DVector<f64>, f64)> = None;
    let mut before: Option<DVector<f64>> = None;
    for steps in GRIDS {
        let now = image(steps)?;
        if let (Some(before), Some(now)) = (&before, &now) {
            let off = (now - before).amax();
            best = Some((steps, now.clone(), off));
            if off <= FINE {
                break;
            }
        }
        before = now;
    }
    Ok(best.filter(|(_, _, off)| *off <= COARSE))
}

/// Times between transitions.
fn stretches(map: &MapResult) -> Vec<f64> {
    let mut last = 0.0;
    let mut since = |event: &crate::return_map::Event| {
        let time = event.time - last;
        last = event.time;
        time
    };
    map.events.iter().map(&mut since).collect()
}
