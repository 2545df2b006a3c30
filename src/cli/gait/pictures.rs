//! `gaitc gait --plot`: the multipliers, the return map.

use super::Report;
use crate::cli::{InputError, plots};
use crate::figures::{self, Orbit};
use crate::picture::Picture;
use crate::provenance::Provenance;
use gaitc_runtime::orbit::GaitRequest;
use gaitc_runtime::return_map::{MapRequest, Sensitivity};
use std::path::PathBuf;

/// What can be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Multipliers,
    Map,
}

/// By their names; the first is the default.
pub(super) const KINDS: [(&str, Kind); 2] = [("multipliers", Kind::Multipliers), ("map", Kind::Map)];

/// Draws what was asked for. Where there is no gait, the return map shows where the first guess leads.
pub(super) fn draw(
    report: &Report<'_>,
    (request, guess): (&GaitRequest<'_>, &[f64]),
    wanted: &[(Kind, PathBuf)],
    provenance: &Provenance,
) -> Result<(), InputError> {
    for (kind, path) in wanted {
        let picture: Box<dyn Picture> = match (kind, report.gait()) {
            (Kind::Multipliers, Some(gait)) => Box::new(figures::multipliers(report.loaded, gait)),
            (Kind::Multipliers, None) => continue,
            (Kind::Map, gait) => {
                let map = MapRequest {
                    coordinates: guess,
                    parameters: request.parameters,
                    memory: request.memory,
                    period: request.period,
                    sensitivity: Sensitivity::None,
                    measures: false,
                    accuracy: request.accuracy,
                };
                let gait = gait.map(|gait| gait.coordinates.as_slice());
                Box::new(figures::return_map(report.loaded, &Orbit { map, start: guess, gait })?)
            }
        };
        plots::save("--plot", path, &*picture, provenance);
    }
    Ok(())
}
