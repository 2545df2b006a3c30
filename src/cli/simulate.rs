//! `gaitc simulate MODEL`: the real machine from any start, through steps, until it falls or has gone as far as asked.

mod plot;
mod report;
mod start;
mod tables;

use super::args::{Cli, ModelArgs, SearchArgs};
use super::{InputError, Outcome, inputs, output, plots, provenance, table_file};
use crate::load::load;
use crate::motion;
use clap::Args;
use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::parse_quantity;
use gaitc_runtime::return_map::RequestError;
use gaitc_runtime::trajectory::{FollowRequest, MOST_VALUES, Sampling, Until};
use report::Report;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(
    after_help = "Without --from, --state or --gait it starts where the spec's [section.start] says.\n\nExamples:\n  gaitc simulate \
                  prescribed_length\n  gaitc simulate prescribed_length --gait --steps 2 --plot gait.svg --plot-path path.svg\n  \
                  gaitc simulate prescribed_length --from 'q_theta=-30 deg' --steps 20 --out run.parquet --events steps.csv\n  \
                  gaitc simulate bouncing_ball --state 'y=1 m' --state 'v=0 m/s' --time 2s --interval 10ms --json"
)]
pub(crate) struct SimulateArgs {
    #[command(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    search: SearchArgs,
    /// Start on the section, at this coordinate, e.g. --from 'q_theta=-20 deg'; the others as the spec's start
    #[arg(long, value_name = "COORD=QUANTITY", allow_hyphen_values = true, conflicts_with_all = ["state", "gait"])]
    from: Vec<String>,
    /// Start in this state, e.g. --state 'v=0 m/s'; all states of the mode are needed
    #[arg(long, value_name = "NAME=QUANTITY", allow_hyphen_values = true, conflicts_with = "gait")]
    state: Vec<String>,
    /// The mode to start in [default: the one in which a step begins, or the only one]
    #[arg(long, value_name = "NAME", requires = "state")]
    mode: Option<String>,
    /// Time since the last transition at the start [default: 0 s]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true, requires = "state")]
    tau: Option<String>,
    /// Memory at the start, e.g. --memory n=1 [default: as in the spec]
    #[arg(long, value_name = "NAME=INTEGER", allow_hyphen_values = true)]
    memory: Vec<String>,
    /// Start on the gait that `gaitc gait` finds
    #[arg(long)]
    gait: bool,
    /// Number of steps (crossings of the section) to go [default: 10]
    #[arg(long, value_name = "N", allow_hyphen_values = true, conflicts_with = "time")]
    steps: Option<usize>,
    /// Time to go, e.g. --time 2s
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    time: Option<String>,
    /// Time between samples, e.g. --interval 1ms
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true, conflicts_with = "samples")]
    interval: Option<String>,
    /// Number of equal times at which to sample the run [default: 200 a step, 1000 with --time]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    samples: Option<usize>,
    /// What to observe on the way: a name of [let] or an expression, e.g. --show 'm*g' [default: all names of [let]]
    #[arg(long, value_name = "EXPR", allow_hyphen_values = true)]
    show: Vec<String>,
    /// Write the samples, one a row, as CSV or Parquet
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the transitions, one a row, as CSV or Parquet
    #[arg(long, value_name = "FILE")]
    events: Option<PathBuf>,
    /// Draw what is worth seeing (or what --show names) over time, as SVG or PNG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Draw the path of the body, as SVG or PNG
    #[arg(long, value_name = "FILE")]
    plot_path: Option<PathBuf>,
}

/// More steps than this are no trajectory to look at.
const MOST_STEPS: usize = 1_000_000;
/// How many steps without flags.
const STEPS: usize = 10;
/// How many samples a step has without flags, ...
const SAMPLES_A_STEP: usize = 200;
/// ... at most so many in all; ...
const MOST_BY_ITSELF: usize = 20_000;
/// ... and how many a time has.
const SAMPLES_A_TIME: usize = 1000;

pub(super) fn run(cli: &Cli, args: &SimulateArgs) -> Result<Outcome, InputError> {
    let mut loaded = load(&args.model.model, cli.specs.as_deref())?;
    let parameters = inputs::parameters(&loaded, &args.model)?;
    let until = until(args, loaded.spec.section.is_some())?;
    let sampling = sampling(args, until)?;
    let accuracy = inputs::accuracy(&args.search)?;
    let memory = start::memory(&loaded, &args.memory)?;
    let mut observed = Vec::new();
    for text in &args.show {
        observed.push(loaded.observations.observe(text).map_err(inputs::given("--show", text))?);
    }
    if args.show.is_empty() {
        observed = loaded.observations.named().to_vec();
    }
    files(args, loaded.observations.drawing().is_some_and(|drawing| drawing.plane.is_some()))?;
    let provenance = provenance::of(&cli.run, &loaded, &parameters);
    let start = match start::of(&loaded, args, &parameters, accuracy)? {
        Ok(start) => start,
        Err(message) => {
            no_gait(cli, &provenance, &loaded.spec.name, &message);
            return Ok(Outcome::Without);
        }
    };
    let request =
        FollowRequest { start: start.borrowed(), parameters: &parameters, memory: &memory, until, sampling, accuracy };
    let trajectory = loaded.compiled.follow(&request).map_err(refused)?;
    let values = motion::observe(&loaded.observations, &observed, &parameters, &trajectory);
    let path = motion::body_path(&loaded.observations, &parameters, &trajectory);
    let report = Report {
        loaded: &loaded,
        parameters: &parameters,
        memory: &memory,
        start: &start,
        on_gait: args.gait,
        until,
        trajectory: &trajectory,
        observed: &observed,
        values: &values,
        path: path.as_ref(),
    };
    if cli.json {
        output::result(&provenance, report.json());
    } else {
        output::print(&report.text());
    }
    for (flag, path, table) in
        [("--out", &args.out, report.samples_table()), ("--events", &args.events, report.events_table())]
    {
        if let Some(path) = path {
            table_file::save(flag, path, &table, &provenance);
        }
    }
    if let Some(file) = &args.plot {
        plots::save("--plot", file, &report.series(!args.show.is_empty()), &provenance);
    }
    if let (Some(file), Some(path)) = (&args.plot_path, &path) {
        plots::save("--plot-path", file, &report.plane(path), &provenance);
    }
    Ok(if trajectory.stop.is_none() { Outcome::Done } else { Outcome::Without })
}

/// How far to go.
fn until(args: &SimulateArgs, section: bool) -> Result<Until, InputError> {
    match (&args.time, args.steps) {
        (Some(text), _) => {
            let time = parse_quantity(text, Dimension::TIME).map_err(inputs::given("--time", text))?;
            if time > 0.0 {
                return Ok(Until::Time(time));
            }
            Err(InputError(format!("--time {text}: give a positive time, e.g. --time 2s")))
        }
        (None, Some(steps)) if !(1..=MOST_STEPS).contains(&steps) => {
            Err(InputError(format!("--steps {steps}: give a number from 1 to {MOST_STEPS}, or a time (--time 2s)")))
        }
        (None, _) if !section => Err(InputError(format!(
            "model `{}` has no [section], so its steps cannot be counted\n  help: say how long to follow it, e.g. --time 2s",
            args.model.model
        ))),
        (None, steps) => Ok(Until::Crossings(steps.unwrap_or(STEPS))),
    }
}

/// Where to sample.
fn sampling(args: &SimulateArgs, until: Until) -> Result<Sampling, InputError> {
    if let Some(text) = &args.interval {
        let interval = parse_quantity(text, Dimension::TIME).map_err(inputs::given("--interval", text))?;
        if interval > 0.0 {
            return Ok(Sampling::Interval(interval));
        }
        return Err(InputError(format!("--interval {text}: give a positive time, e.g. --interval 1ms")));
    }
    let by_itself = match until {
        Until::Crossings(steps) => steps.saturating_mul(SAMPLES_A_STEP).min(MOST_BY_ITSELF),
        Until::Time(_) => SAMPLES_A_TIME,
    };
    match args.samples {
        Some(0) => Err(InputError("--samples 0: give a number from 1 on".to_owned())),
        samples => Ok(Sampling::Count(samples.unwrap_or(by_itself))),
    }
}

/// Refuses files that cannot be written, or not as what they are named, before the work begins.
fn files(args: &SimulateArgs, in_plane: bool) -> Result<(), InputError> {
    let all =
        [("--out", &args.out), ("--events", &args.events), ("--plot", &args.plot), ("--plot-path", &args.plot_path)];
    for (i, (flag, path)) in all.iter().enumerate() {
        let Some(path) = path else {
            continue;
        };
        if let Some((other, _)) = all
            .iter()
            .take(i)
            .find(|(_, earlier)| earlier.as_ref().is_some_and(|earlier| crate::files::is_same(earlier, path)))
        {
            return Err(InputError(format!("{other} and {flag} name the same file\n  help: name two")));
        }
        if flag.starts_with("--plot") {
            plots::check(flag, path)?;
        } else {
            table_file::check(flag, path)?;
        }
    }
    if args.plot_path.is_some() && !in_plane {
        return Err(InputError(format!(
            "--plot-path: the spec of `{}` does not say how the body moves in the plane\n  help: add `velocity` to its [drawing], \
             or take --plot",
            args.model.model
        )));
    }
    Ok(())
}

/// A request that the runtime refuses, in the words of the flags.
fn refused(error: RequestError) -> InputError {
    match error {
        RequestError::TooManyValues { .. } => InputError(format!(
            "this run would have more than {MOST_VALUES} values\n  help: sample it less often (--samples 1000, --interval 10ms), or \
             go less far (--steps, --time)"
        )),
        other => other.into(),
    }
}

/// There is nothing to follow: no gait was found.
fn no_gait(cli: &Cli, provenance: &crate::provenance::Provenance, model: &str, message: &str) {
    if cli.json {
        output::result(provenance, report::nothing(model, message));
    } else {
        output::print(&format!(
            "{model} · simulate\nno_gait: {message}\nhelp: start elsewhere (--from COORD=QUANTITY), or look for a gait first (gaitc gait {model})\n"
        ));
    }
}
