//! `gaitc run FILE`: does again what a run file says, or what made a result.
//!
//! A run file is TOML: `command`, then the command's arguments by their long names; `NAME=VALUE` flags may be tables. Results of
//! every kind carry the run that made them, so they can be given in its place.

use super::args::Cli;
use super::{InputError, Outcome, output, provenance};
use crate::load::load;
use crate::provenance::{Provenance, find};
use clap::{Arg, ArgAction, Args, Command, CommandFactory};
use gaitc_compiler::front::flags::suggest;
use serde_json::{Map, Value};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// A larger file is no result that carries its run near its beginning or end.
const LARGEST: u64 = 1 << 30;

#[derive(Debug, Args)]
#[command(
    after_help = "A run file is TOML: the command, and its arguments by their long names.\n\n  command = \"gait\"\n  model = \
                  \"prescribed_length\"\n  tol = 1e-10\n\n  [set]\n  psi = \"25 deg\"\n\nExamples:\n  gaitc run study.toml\n  \
                  gaitc run result.json --json\n  gaitc run trade.svg --out trade.csv"
)]
pub(crate) struct RunArgs {
    /// A run file, or a result
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Further arguments of the command
    #[arg(value_name = "ARGUMENTS", trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

/// A run as it was read, and what it says of the program that it was made with.
struct Read {
    run: Map<String, Value>,
    made: Option<Value>,
}

pub(super) fn run(cli: &Cli, args: &RunArgs) -> Result<Outcome, InputError> {
    let mut read = read(&args.file)?;
    give_way(&mut read.run, &args.arguments);
    let arguments = arguments(&read.run, &args.arguments, &args.file)?;
    let mut again = super::parse(arguments)
        .map_err(|error| InputError(format!("{}: {}", args.file.display(), super::args::message(&error))))?;
    again.json |= cli.json;
    again.quiet |= cli.quiet;
    again.verbose |= cli.verbose;
    again.specs = again.specs.take().or_else(|| cli.specs.clone());
    if let Some(made) = &read.made {
        compare(&again, made);
    }
    super::run(&again)
}

fn read(path: &Path) -> Result<Read, InputError> {
    let fail = |message: String| InputError(format!("{}: {message}", path.display()));
    let known = std::fs::metadata(path).map_err(|error| fail(error.to_string()))?;
    if known.len() > LARGEST {
        return Err(fail(format!("this file has more than {LARGEST} bytes\n  help: give a run file")));
    }
    let contents = std::fs::read(path).map_err(|error| fail(error.to_string()))?;
    if let Some(made) = find(&contents) {
        let run = made.get("run").and_then(Value::as_object).cloned().unwrap_or_default();
        return Ok(Read { run, made: Some(made) });
    }
    let text = String::from_utf8(contents).map_err(|_| fail(NOTHING.to_owned()))?;
    if path.extension().is_none_or(|ending| ending != "toml") {
        return Err(fail(NOTHING.to_owned()));
    }
    let table: toml::Table = toml::from_str(&text).map_err(|error| fail(error.to_string()))?;
    match serde_json::to_value(table) {
        Ok(Value::Object(run)) => Ok(Read { run, made: None }),
        _ => Err(fail(NOTHING.to_owned())),
    }
}

const NOTHING: &str = "there is no run in this file\n  help: give a run file (`command = \"gait\"`, ...) whose name ends in \
                       `.toml`, or a result that gaitc wrote";

/// Takes out of a run what further arguments say otherwise: a flag that is given once, or the same name of a `NAME=VALUE` flag.
fn give_way(run: &mut Map<String, Value>, further: &[OsString]) {
    for (i, argument) in further.iter().enumerate() {
        let Some(flag) = argument.to_str().and_then(|text| text.strip_prefix("--")) else {
            continue;
        };
        let next = further.get(i + 1).and_then(|next| next.to_str()).unwrap_or_default();
        let (key, value) = flag.split_once('=').unwrap_or((flag, next));
        let name = value.split_once('=').map(|(name, _)| name.trim());
        let named = |text: &Value| text.as_str().and_then(|t| t.split_once('=')).map(|(known, _)| known.trim()) == name;
        match (run.get_mut(key), name) {
            (Some(Value::Object(all)), Some(name)) => drop(all.remove(name)),
            (Some(Value::Array(all)), Some(_)) => all.retain(|text| !named(text)),
            (None | Some(Value::Object(_) | Value::Array(_)), _) => {}
            (Some(_), _) => drop(run.remove(key)),
        }
    }
}

/// The command line that a run stands for, with further arguments.
fn arguments(run: &Map<String, Value>, further: &[OsString], path: &Path) -> Result<Vec<OsString>, InputError> {
    let fail = |message: String| InputError(format!("{}: {message}", path.display()));
    let program = Cli::command();
    let names: Vec<&str> = program.get_subcommands().map(Command::get_name).filter(|name| *name != "run").collect();
    let Some(name) = run.get("command").and_then(Value::as_str) else {
        let help = format!("write `command = \"NAME\"` with one of: {}", names.join(", "));
        return Err(fail(format!("`command` is missing\n  help: {help}")));
    };
    let Some(command) = program.get_subcommands().find(|c| c.get_name() == name && name != "run") else {
        return Err(fail(format!("no command is named `{name}`\n  help: {}", choose(name, &names))));
    };
    let known: Vec<&Arg> = command.get_arguments().chain(program.get_arguments()).collect();
    let keys: Vec<String> = known.iter().map(|arg| provenance::key(arg)).collect();
    let mut all: Vec<OsString> = vec!["gaitc".into(), name.into()];
    let mut positional = Vec::new();
    for (key, value) in run.iter().filter(|(key, _)| *key != "command") {
        let Some(arg) = known.iter().find(|arg| provenance::key(arg) == *key) else {
            let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
            return Err(fail(format!("`gaitc {name}` has no `{key}`\n  help: {}", choose(key, &keys))));
        };
        let texts = texts(value).map_err(|message| fail(format!("`{key}`: {message}")))?;
        if arg.is_positional() {
            positional.extend(texts.into_iter().map(OsString::from));
        } else if matches!(arg.get_action(), ArgAction::SetTrue) {
            match value {
                Value::Bool(true) => all.push(format!("--{key}").into()),
                Value::Bool(false) => {}
                _ => return Err(fail(format!("`{key}`: write `true` or `false`"))),
            }
        } else {
            all.extend(texts.into_iter().map(|text| OsString::from(format!("--{key}={text}"))));
        }
    }
    all.extend(further.iter().cloned());
    // Behind this nothing is a flag, whatever it begins with.
    all.push("--".into());
    all.extend(positional);
    Ok(all)
}

fn choose(name: &str, names: &[&str]) -> String {
    match suggest(name, names.iter().copied()) {
        Some(close) => format!("did you mean `{close}`?"),
        None => format!("choose from: {}", names.join(", ")),
    }
}

/// The values of one argument as the command line has them.
fn texts(value: &Value) -> Result<Vec<String>, String> {
    match value {
        Value::String(text) => Ok(vec![text.clone()]),
        Value::Number(number) => Ok(vec![number.to_string()]),
        Value::Bool(_) => Ok(Vec::new()),
        Value::Array(all) => Ok(all.iter().map(texts).collect::<Result<Vec<_>, _>>()?.concat()),
        Value::Object(all) => {
            let one = |(name, value): (&String, &Value)| match &texts(value)?[..] {
                [text] => Ok(format!("{name}={text}")),
                _ => Err(format!("write one value for `{name}`")),
            };
            all.iter().map(one).collect()
        }
        Value::Null => Err("there is no value".to_owned()),
    }
}

/// Warns where the result cannot come out the same: other equations, other values, another program.
fn compare(again: &Cli, made: &Value) {
    let text = |key: &str| made.get(key).and_then(Value::as_str).unwrap_or_default();
    if text("version") != Provenance::VERSION {
        let (theirs, ours) = (text("version"), Provenance::VERSION);
        output::warning(&format!("this was made by gaitc {theirs}; this is gaitc {ours}"));
    }
    let Ok(loaded) = load(text("model"), again.specs.as_deref()) else {
        return;
    };
    if loaded.compiled.info().fingerprint != text("fingerprint") {
        output::warning("this was made with other equations of the model");
    } else if loaded.digest != text("spec") {
        output::warning("the spec was changed since: problems and first guesses may be others");
    }
}
