//! `gaitc optimize MODEL`: the best gait over parameters.

mod report;
mod request;
mod verdict;

use super::args::{Cli, OptimizeArgs};
use super::{InputError, Outcome, inputs};
use crate::load::load;
use crate::problem::{Start, assemble};
use gaitc_runtime::optimize::{Settings, Status, solve};
use report::Report;

/// More starts than this tell nothing new and would run for days.
const MOST_STARTS: usize = 100_000;

pub(super) fn run(cli: &Cli, args: &OptimizeArgs) -> Result<Outcome, InputError> {
    if args.starts == 0 || args.starts > MOST_STARTS {
        return Err(InputError(format!("--starts {}: give a number from 1 to {MOST_STARTS}", args.starts)));
    }
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let (spec, problem) = request::problem(&loaded, args)?;
    let settings = Settings {
        accuracy: inputs::accuracy(&args.search)?,
        starts: args.starts,
        seed: args.seed,
        ..Settings::default()
    };
    let start = Start {
        parameters: inputs::parameters(&loaded, &args.model)?,
        section: inputs::guess(&loaded, &args.search)?,
        settings,
    };
    let warnings = inputs::outside_range(&loaded, &start.parameters);
    let mut solution = solve(&assemble(&loaded, &spec, &problem, start))?;
    solution.notes.splice(0..0, warnings);
    let report = Report { spec: &spec, problem: &problem, solution: &solution };
    if cli.json {
        report.print_json();
    } else {
        report.print_text();
    }
    Ok(if solution.status == Status::Optimal { Outcome::Done } else { Outcome::Without })
}
