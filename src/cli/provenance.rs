//! The provenance of a command's result: its flags as they were given, and the value of every parameter.

use super::args::Cli;
use crate::load::Loaded;
use crate::provenance::Provenance;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, CommandFactory};
use gaitc_compiler::front::flags::parse_quantity;
use gaitc_compiler::front::{format_exact, in_unit};
use gaitc_compiler::ir::Parameter;
use toml::{Table, Value};

/// Flags that change nothing in a result: what is printed where, and how the work is done.
const ELSEWHERE: [&str; 19] = [
    "json",
    "specs",
    "quiet",
    "verbose",
    "help",
    "version",
    "threads",
    "out",
    "plot",
    "plot_map",
    "plot_multipliers",
    "plot_path",
    "events",
    "dir",
    "resume",
    "shard",
    "chunk",
    "file",
    "arguments",
];

/// What the command line said of a run: `command`, then flags by their long names, positional arguments by their own.
pub(super) fn run(command: &Command, matches: &ArgMatches) -> Table {
    let mut run = Table::new();
    let Some((name, matches)) = matches.subcommand() else {
        return run;
    };
    run.insert("command".to_owned(), name.into());
    let arguments = command.find_subcommand(name).map(Command::get_arguments).into_iter().flatten();
    let given = |arg: &&Arg| {
        let id = arg.get_id().as_str();
        !ELSEWHERE.contains(&id) && matches.value_source(id) == Some(ValueSource::CommandLine)
    };
    for arg in arguments.filter(given) {
        run.insert(key(arg), value(arg, matches));
    }
    run
}

/// How a run file calls an argument.
pub(super) fn key(arg: &Arg) -> String {
    arg.get_long().unwrap_or(arg.get_id().as_str()).to_owned()
}

fn value(arg: &Arg, matches: &ArgMatches) -> Value {
    let raw = matches.get_raw(arg.get_id().as_str()).into_iter().flatten();
    let mut texts: Vec<Value> = raw.map(|text| text.to_string_lossy().into_owned().into()).collect();
    match arg.get_action() {
        ArgAction::SetTrue => Value::Boolean(true),
        ArgAction::Append => Value::Array(texts),
        _ => texts.pop().unwrap_or(Value::Boolean(true)),
    }
}

/// Where the result of a command comes from: its run, with the value of every parameter written out.
pub(super) fn of(run: &Table, loaded: &Loaded, parameters: &[f64]) -> Provenance {
    let mut run = run.clone();
    let command = run.get("command").and_then(Value::as_str).unwrap_or_default();
    let command = Cli::command().find_subcommand(command).cloned();
    if !command.is_some_and(|command| command.get_arguments().any(|arg| arg.get_long() == Some("set"))) {
        return of_values(run, loaded);
    }
    let set = loaded.spec.parameters.iter().zip(parameters);
    let set: Table = set.map(|(p, &value)| (p.name.clone(), exactly(p, value).into())).collect();
    run.insert("set".to_owned(), set.into());
    of_values(run, loaded)
}

/// Where a result of a model comes from whose parameters no flag sets.
fn of_values(run: Table, loaded: &Loaded) -> Provenance {
    let fingerprint = loaded.compiled.info().fingerprint.to_owned();
    Provenance { model: loaded.spec.name.clone(), fingerprint, spec: loaded.digest.clone(), run }
}

/// A parameter's value so that reading it gives the same bits: in the unit of the spec where that does, else in SI units.
pub(super) fn exactly(parameter: &Parameter, value: f64) -> String {
    let theirs = format!("{} {}", in_unit(value, &parameter.unit), parameter.unit);
    let same =
        parse_quantity(theirs.trim_end(), parameter.dimension).is_ok_and(|read| read.to_bits() == value.to_bits());
    if same { theirs.trim_end().to_owned() } else { format_exact(value, parameter.dimension) }
}
