//! `gaitc optimize MODEL`: the best gait over parameters.

mod conflict;
mod fixed;
mod optima;
mod report;
mod request;
mod robust;
mod trade;
mod verdict;

use super::args::{Cli, OptimizeArgs};
use super::{INTERRUPTED, InputError, Outcome, inputs, provenance};
use crate::load::load;
use crate::problem::{Start, assemble, uncertain};
use gaitc_runtime::optimize::{Interrupt, Settings, Status, solve, solve_robust};
use report::Report;
pub(super) use report::status;

/// More starts than this tell nothing new and would run for days.
const MOST_STARTS: usize = 100_000;
/// More maps than this would run for weeks.
const MOST_WORK: usize = 1_000_000_000;
/// More threads than this only wait for each other.
const MOST_THREADS: usize = 1024;

pub(super) fn run(cli: &Cli, args: &OptimizeArgs) -> Result<Outcome, InputError> {
    if args.starts == 0 || args.starts > MOST_STARTS {
        return Err(InputError(format!("--starts {}: give a number from 1 to {MOST_STARTS}", args.starts)));
    }
    if let Some(threads) = args.threads.filter(|threads| !(1..=MOST_THREADS).contains(threads)) {
        return Err(InputError(format!("--threads {threads}: give a number from 1 to {MOST_THREADS}")));
    }
    if !(1..=MOST_WORK).contains(&args.work) {
        return Err(InputError(format!("--work {}: give a number from 1 to {MOST_WORK}", args.work)));
    }
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let (spec, problem) = request::problem(&loaded, args)?;
    let parameters = inputs::parameters(&loaded, &args.model)?;
    let uncertain = uncertain(&problem);
    let mut warnings = inputs::outside_range(&loaded, &parameters);
    warnings.extend(inputs::varies_outside(&loaded, &problem));
    let loose = robust::loose(&problem, &uncertain);
    robust::stability_bounds(&spec, &loose, &parameters, &uncertain)?;
    warnings.extend(fixed::constraints(&spec, &loose, &parameters)?);
    let settings = Settings {
        accuracy: inputs::accuracy(&args.search)?,
        starts: args.starts,
        seed: args.seed,
        threads: args.threads.unwrap_or(0),
        work: args.work,
        interrupt: on_interrupt(),
        ..Settings::default()
    };
    let provenance = provenance::of(&cli.run, &loaded, &parameters);
    let start = Start { parameters, section: inputs::guess(&loaded, &args.search)?, settings };
    if args.trade.is_some() {
        robust::no_trade(&problem)?;
        return trade::run(&loaded, (spec, problem), start, (args, cli.json), (&warnings, &provenance));
    }
    let assembled = assemble(&loaded, &spec, &problem, start);
    let (mut solution, robust) = if uncertain.is_empty() {
        (solve(&assembled)?, None)
    } else {
        let robust = solve_robust(assembled, &uncertain)?;
        (robust.solution.clone(), Some(robust))
    };
    solution.notes.splice(0..0, warnings);
    if let Some(message) = conflict::message(&spec, &problem, &solution) {
        let nominal = if robust.is_some() { "already without uncertainty: " } else { "" };
        solution.message = format!("{nominal}{message}");
    }
    if let Some(message) = robust.as_ref().and_then(|found| robust::message(&spec, &problem, found)) {
        solution.message = message;
    }
    let robust = robust.as_ref().map(|found| robust::Shown { uncertain: &uncertain, found });
    let report = Report { spec: &spec, problem: &problem, solution: &solution, robust };
    if cli.json {
        report.print_json(&provenance);
    } else {
        report.print_text();
    }
    Ok(match solution.status {
        Status::Optimal => Outcome::Done,
        Status::Interrupted => Outcome::Interrupted,
        _ => Outcome::Without,
    })
}

/// What the first Ctrl-C requests; the second ends the program at once.
pub(super) fn on_interrupt() -> Interrupt {
    let interrupt = Interrupt::new();
    let requested = interrupt;
    let set = ctrlc::set_handler(move || {
        if requested.request() {
            std::process::exit(i32::from(INTERRUPTED));
        }
    });
    // Without a handler Ctrl-C does what it always does: it ends the program.
    set.map_or_else(|_| Interrupt::default(), |()| interrupt)
}
