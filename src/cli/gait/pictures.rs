//! `gaitc gait --plot`: the multipliers, the return map.

use super::Report;
use crate::cli::args::GaitArgs;
use crate::cli::{InputError, plots};
use crate::figures::{self, Orbit};
use crate::picture::Picture;
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
    (args, request, guess): (&GaitArgs, &GaitRequest<'_>, &[f64]),
    wanted: &[(Kind, PathBuf)],
) -> Result<(), InputError> {
    let mut flags = vec![("period", (args.period as i64).into())];
    if !args.search.guess.is_empty() {
        flags.push(("guess", args.search.guess.clone().into()));
    }
    let provenance = plots::provenance(report.loaded, "gait", report.parameters, flags);
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
        plots::save(path, &*picture, &provenance);
    }
    Ok(())
}
