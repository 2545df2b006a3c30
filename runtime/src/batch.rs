//! Many return maps at once, for sweeps and basins: replays of one plan in lanes, full runs where it does not hold, over all
//! cores.
//!
//! Each point's numbers depend on the plan and on the point alone, neither on its neighbours nor on the number of threads: a
//! lane has the bits of a single number.

use crate::return_map::{
    Images, MapOutcome, MapRequest, Plan, Points, RequestError, ReturnMap, Sensitivity, Stop, StopReason,
};
use rayon::prelude::*;

/// Points that a thread takes at a time.
const CHUNK: usize = 256;

/// What [`batch`] found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    /// The images, in the order of the points; `held` says which maps reached the section.
    pub images: Images,
    /// Points whose maps did not, and why.
    pub stops: Vec<(usize, Stop)>,
    /// How many points were run in full.
    pub in_full: usize,
}

/// Maps all points with derivatives in the section coordinates. `plan` is one that was made nearby, if there is one; `request`
/// says accuracy, memory and period, for replays those of the plan hold.
///
/// # Errors
/// When the points or the request do not fit the model, or the plan is another model's.
pub fn batch(
    map: &dyn ReturnMap,
    plan: Option<&Plan>,
    request: &MapRequest<'_>,
    points: Points<'_>,
) -> Result<Batch, RequestError> {
    let info = map.info();
    let (count, d, p) = (points.count(info)?, info.coordinates.len(), info.parameters.len());
    let starts: Vec<usize> = (0..count).step_by(CHUNK).collect();
    let parts: Result<Vec<Batch>, RequestError> = starts
        .into_par_iter()
        .map(|first| {
            let rows = first..(first + CHUNK).min(count);
            // Where all points share the parameters there is one row of them.
            let shared = points.parameters.len() == p;
            let parameters = if shared { 0..p } else { rows.start * p..rows.end * p };
            let part = Points {
                coordinates: points.coordinates.get(rows.start * d..rows.end * d).unwrap_or(&[]),
                parameters: points.parameters.get(parameters).unwrap_or(&[]),
            };
            chunk(map, plan, request, part, rows.len())
        })
        .collect();
    let mut all = Batch::default();
    for (i, part) in parts?.into_iter().enumerate() {
        all.images.append(part.images);
        all.stops.extend(part.stops.into_iter().map(|(point, stop)| (i * CHUNK + point, stop)));
        all.in_full += part.in_full;
    }
    Ok(all)
}

fn chunk(
    map: &dyn ReturnMap,
    plan: Option<&Plan>,
    request: &MapRequest<'_>,
    points: Points<'_>,
    count: usize,
) -> Result<Batch, RequestError> {
    let (d, p) = (map.info().coordinates.len(), map.info().parameters.len());
    let (mut batch, rows) = (Batch::default(), points.rows(d, p));
    match plan {
        Some(plan) => map.replay(plan, points, &mut batch.images)?,
        None => batch.images.make_room(count, d),
    }
    for point in 0..count {
        if batch.images.held.get(point) == Some(&true) {
            continue;
        }
        let z: Vec<f64> = (0..d).map(|i| rows.coordinate(point, i)).collect();
        let parameters: Vec<f64> = (0..p).map(|i| rows.parameter(point, i)).collect();
        let request = MapRequest {
            coordinates: &z,
            parameters: &parameters,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            ..*request
        };
        batch.in_full += 1;
        match map.evaluate(&request)? {
            MapOutcome::Completed(result) if batch.images.put(point, &result) => {}
            MapOutcome::Completed(result) => {
                let (time, state) = (result.duration, result.end.as_slice().to_vec());
                batch.stops.push((point, Stop { reason: StopReason::NotFinite, time, state }));
            }
            MapOutcome::Stopped(stop) => batch.stops.push((point, stop)),
        }
    }
    Ok(batch)
}
