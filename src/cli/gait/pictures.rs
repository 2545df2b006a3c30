//! `gaitc gait --plot-multipliers`, `--plot-map`.

use super::Report;
use crate::cli::args::GaitArgs;
use crate::cli::{InputError, output, plots};
use crate::figures::{self, Orbit};
use crate::files;
use crate::provenance::Provenance;
use gaitc_runtime::orbit::GaitRequest;

/// Refuses files that cannot be written, or are no pictures by their names, before the work begins.
pub(super) fn check(args: &GaitArgs) -> Result<(), InputError> {
    if let (Some(map), Some(multipliers)) = (&args.plot_map, &args.plot_multipliers)
        && files::is_same(map, multipliers)
    {
        return Err(InputError("--plot-map and --plot-multipliers name the same file\n  help: name two".to_owned()));
    }
    for (flag, path) in [("--plot-multipliers", &args.plot_multipliers), ("--plot-map", &args.plot_map)] {
        if let Some(path) = path {
            plots::check(flag, path)?;
        }
    }
    Ok(())
}

/// Draws what was asked for. Where there is no gait there are no multipliers, but the return map shows where the first guess
/// leads.
pub(super) fn draw(
    report: &Report<'_>,
    (args, request, guess): (&GaitArgs, &GaitRequest<'_>, &[f64]),
    provenance: &Provenance,
) -> Result<(), InputError> {
    let none = |flag: &str, path: &std::path::Path| {
        let why = "since the section has no coordinates: every step is the same";
        output::warning(&format!("{flag} {}: not drawn, {why}", path.display()));
    };
    let nothing = report.loaded.coordinates().is_empty();
    match (&args.plot_multipliers, report.gait()) {
        (Some(path), _) if nothing => none("--plot-multipliers", path),
        (Some(path), Some(gait)) => {
            plots::save("--plot-multipliers", path, &figures::multipliers(report.loaded, gait), provenance);
        }
        (Some(path), None) => {
            output::warning(&format!("--plot-multipliers {}: not drawn, since there is no gait", path.display()));
        }
        (None, _) => {}
    }
    if let Some(path) = args.plot_map.as_ref().filter(|_| nothing) {
        none("--plot-map", path);
    } else if let Some(path) = &args.plot_map {
        let gait = report.gait().map(|gait| gait.coordinates.as_slice());
        let orbit = Orbit { map: figures::map_of(request, guess), start: guess, gait };
        plots::save("--plot-map", path, &figures::return_map(report.loaded, &orbit)?, provenance);
    }
    Ok(())
}
