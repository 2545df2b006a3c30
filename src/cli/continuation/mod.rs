//! `gaitc continue MODEL --over NAME=LO..HI`: a gait followed over a parameter.

mod args;
mod data;
mod drawing;
mod json;
mod progress;
mod shown;
mod text;
mod windows;
mod words;

pub(super) use args::ContinueArgs;

use super::args::Cli;
use super::{InputError, Outcome, inputs, optimize, output, plots, provenance, table_file};
use crate::load::{Loaded, load};
use crate::provenance::Provenance;
use crate::words::counted;
use gaitc_compiler::front::flags::{parse_assignment, parse_quantity, parse_range};
use gaitc_compiler::front::{LONGEST_PERIOD, format_quantity};
use gaitc_compiler::ir::Parameter;
use gaitc_runtime::orbit::GaitRequest;
use gaitc_runtime::study::continuation::{
    ContinuationOutcome, ContinuationRequest, Diagram, EndReason, Settings, follow,
};
use shown::Shown;
use std::path::PathBuf;

/// Status of a diagram that Ctrl-C ended.
const INTERRUPTED: &str = "interrupted";
/// Status where the start is a gait, but no branch leads on.
const NO_DIRECTION: &str = "no_direction";
/// More points than this show nothing new.
const MOST_POINTS: usize = 10_000;
/// Steps shorter than this part of the range would take days.
const SHORTEST_STEP: f64 = 1e-6;
/// Ranges below this part of the values in them are rounding.
const NO_RANGE: f64 = 1e-9;

pub(super) fn run(cli: &Cli, args: &ContinueArgs) -> Result<Outcome, InputError> {
    inputs::period(args.period)?;
    counts(args)?;
    places(args)?;
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let mut parameters = inputs::parameters(&loaded, &args.model)?;
    let (over, range) = over(&loaded, &args.over)?;
    let parameter = &loaded.spec.parameters[over];
    parameters[over] = start(args, parameter, parameters[over], range)?;
    let mut warnings = inputs::outside_range(&loaded, &parameters);
    warnings.extend(beyond(parameter, range));
    let shown = Shown::new(&loaded, args.measure.as_deref())?;
    let guess = inputs::guess(&loaded, &args.search)?;
    let memory = loaded.memory();
    let accuracy = inputs::accuracy(&args.search)?;
    let search = GaitRequest::new(&parameters, &memory);
    let tolerance = search.tolerance.max(10.0 * accuracy.relative);
    let gait = GaitRequest { period: args.period, accuracy, tolerance, ..search };
    let settings = settings(args, parameter, range)?;
    let interrupt = settings.interrupt;
    let request = ContinuationRequest { gait, parameter: over, range, settings };
    let outcome = follow(loaded.compiled, &request, &guess)?;
    // With it goes the display of its progress.
    drop(request);
    let provenance = provenance::of(&cli.run, &loaded, &parameters);
    let report = Report { loaded: &loaded, parameters: &parameters, over, range, warnings: &warnings, shown, args };
    match &outcome {
        ContinuationOutcome::NoStart(search) => {
            let (status, message) = (search.status.name(), report.no_start(&search.message));
            report.print(cli.json.then_some(&provenance), (status, &message), &Diagram::default());
            Ok(Outcome::Without)
        }
        ContinuationOutcome::Diagram(diagram) => {
            let (status, message) = report.summary(diagram, interrupt.requested());
            report.print(cli.json.then_some(&provenance), (status, &message), diagram);
            report.save(diagram, &provenance);
            Ok(match status {
                INTERRUPTED => Outcome::Interrupted,
                NO_DIRECTION => Outcome::Without,
                _ => Outcome::Done,
            })
        }
    }
}

/// Refuses files that cannot be written, or not as what they are named, before the work begins.
fn places(args: &ContinueArgs) -> Result<(), InputError> {
    if let Some(path) = &args.out {
        table_file::check("--out", path)?;
    }
    let all = [("--out", &args.out), ("--plot", &args.plot), ("--plot-multipliers", &args.plot_multipliers)];
    for (i, (flag, path)) in all.iter().enumerate() {
        let Some(path) = path else { continue };
        if *flag != "--out" {
            plots::check(flag, path)?;
        }
        let same = |other: &Option<PathBuf>| other.as_ref().is_some_and(|other| crate::files::is_same(other, path));
        if let Some((other, _)) = all.iter().take(i).find(|(_, earlier)| same(earlier)) {
            return Err(InputError(format!("{other} and {flag} name the same file\n  help: name two")));
        }
    }
    Ok(())
}

/// What every way of showing a diagram needs.
struct Report<'a> {
    loaded: &'a Loaded,
    /// All parameters at the start.
    parameters: &'a [f64],
    /// Index of the parameter that varies.
    over: usize,
    /// Its range (SI units).
    range: (f64, f64),
    warnings: &'a [String],
    shown: Shown,
    args: &'a ContinueArgs,
}

impl Report<'_> {
    fn parameter(&self) -> &Parameter {
        &self.loaded.spec.parameters[self.over]
    }

    fn print(&self, json: Option<&Provenance>, (status, message): (&str, &str), diagram: &Diagram) {
        match json {
            Some(provenance) => output::result(provenance, self.json(status, message, diagram)),
            None => output::print(&self.text(status, message, diagram)),
        }
    }

    /// Writes the files that were asked for; what was printed stands even if that fails.
    fn save(&self, diagram: &Diagram, provenance: &Provenance) {
        if let Some(path) = &self.args.out {
            table_file::save("--out", path, &self.table(diagram), provenance);
        }
        if let Some(path) = &self.args.plot {
            plots::save("--plot", path, &self.picture(diagram), provenance);
        }
        if let Some(path) = &self.args.plot_multipliers {
            plots::save("--plot-multipliers", path, &self.multipliers(diagram), provenance);
        }
    }

    /// Status and message of a diagram.
    fn summary(&self, diagram: &Diagram, interrupted: bool) -> (&'static str, String) {
        let ends = || diagram.branches.iter().flat_map(|branch| &branch.ends);
        let status = match () {
            () if interrupted => INTERRUPTED,
            () if ends().any(|end| *end == EndReason::NoDirection) => NO_DIRECTION,
            () if ends().any(|end| *end == EndReason::PointLimit) => "point_limit",
            () => "complete",
        };
        let count = |count: usize, what: &str| counted(count as u64, what);
        let message = format!(
            "{} of gaits, {}, {}",
            count(diagram.branches.len(), "branch"),
            count(diagram.branches.iter().map(|b| b.points.len()).sum(), "point"),
            count(diagram.branches.iter().map(|b| b.bifurcations.len()).sum(), "bifurcation"),
        );
        (status, message)
    }

    /// Why there is nothing to follow, and what to do.
    fn no_start(&self, why: &str) -> String {
        let parameter = self.parameter();
        let at = format_quantity(self.parameters[self.over], &parameter.unit);
        format!("no gait to start from at {} = {at}: {why}", parameter.name)
    }
}

/// The parameter of `--over` and its range.
fn over(loaded: &Loaded, text: &str) -> Result<(usize, (f64, f64)), InputError> {
    let (name, range) = parse_assignment(text).map_err(inputs::given("--over", text))?;
    let index = inputs::parameter(loaded, "--over", name)?;
    let parameter = &loaded.spec.parameters[index];
    let (lower, upper) = parse_range(range, parameter.dimension).map_err(inputs::given("--over", text))?;
    if upper - lower <= NO_RANGE * lower.abs().max(upper.abs()) {
        let at = format_quantity(lower, &parameter.unit);
        return Err(InputError(format!(
            "--over {text}: both ends of the range are {at}\n  help: give two different ends, as in `--over '{name}=LO..HI {}'`; for one \
             value there is `gaitc gait`",
            parameter.unit
        )));
    }
    Ok((index, (lower, upper)))
}

/// One sentence where the range leaves the one that the spec gives: most often a forgotten unit.
fn beyond(parameter: &Parameter, (from, to): (f64, f64)) -> Option<String> {
    let (lower, upper) = parameter.range?;
    let slack = NO_RANGE * (upper - lower);
    if from >= lower - slack && to <= upper + slack {
        return None;
    }
    let [from, to, lower, upper] = [from, to, lower, upper].map(|v| format_quantity(v, &parameter.unit));
    let name = &parameter.name;
    Some(format!("`{name}` goes from {from} to {to}, beyond the range that the spec gives for it, {lower} to {upper}"))
}

/// Where to start: what `--from` says, else the parameter's own value, or the end of the range that is nearest to it.
fn start(args: &ContinueArgs, parameter: &Parameter, own: f64, (lower, upper): (f64, f64)) -> Result<f64, InputError> {
    let Some(text) = &args.from else {
        return Ok(own.clamp(lower, upper));
    };
    let value = parse_quantity(text, parameter.dimension).map_err(inputs::given("--from", text))?;
    // An end that was written in the same way may differ by its rounding.
    let slack = NO_RANGE * (upper - lower);
    if value < lower - slack || value > upper + slack {
        let [value, lower, upper] = [value, lower, upper].map(|v| format_quantity(v, &parameter.unit));
        return Err(InputError(format!(
            "--from {text}: {value} is outside the range of --over, {lower} to {upper}\n  help: start inside the range"
        )));
    }
    Ok(value.clamp(lower, upper))
}

/// Refuses numbers that make no sense, or no end.
fn counts(args: &ContinueArgs) -> Result<(), InputError> {
    if !(1..=MOST_POINTS).contains(&args.points) {
        return Err(InputError(format!("--points {}: give a number from 1 to {MOST_POINTS}", args.points)));
    }
    let longest = u32::try_from(args.doublings).ok().and_then(|n| args.period.checked_shl(n)).unwrap_or(usize::MAX);
    if args.doublings > 10 || longest > LONGEST_PERIOD {
        return Err(InputError(format!(
            "--doublings {}: period {} doubled so often is more than {LONGEST_PERIOD} maps\n  help: give a smaller number",
            args.doublings, args.period
        )));
    }
    Ok(())
}

fn settings(args: &ContinueArgs, parameter: &Parameter, (lower, upper): (f64, f64)) -> Result<Settings, InputError> {
    let mut settings = Settings {
        point_limit: args.points,
        doublings: args.doublings,
        branches: args.branches,
        interrupt: optimize::on_interrupt(),
        observer: progress::observer(args, parameter),
        ..Settings::default()
    };
    if let Some(text) = &args.step {
        let step = parse_quantity(text, parameter.dimension).map_err(inputs::given("--step", text))? / (upper - lower);
        if !(SHORTEST_STEP..=1.0).contains(&step) {
            let [least, most] =
                [SHORTEST_STEP * (upper - lower), upper - lower].map(|v| format_quantity(v, &parameter.unit));
            return Err(InputError(format!("--step {text}: give a step from {least} to {most}, the whole range")));
        }
        settings.longest = step;
        settings.initial = 0.25 * step;
        settings.shortest = settings.shortest.min(1e-3 * step);
    }
    Ok(settings)
}
