//! `gaitc run FILE`: does again what a run file says, or what made a result.
//!
//! A run file is TOML: `command`, then the command's arguments by their long names; `NAME=VALUE` flags may be tables. Results of
//! every kind carry the run that made them, so they can be given in its place.

mod origin;

use super::args::Cli;
use super::{InputError, Outcome, output, provenance};
use crate::load::load;
use crate::provenance::Provenance;
use clap::{Arg, ArgAction, Args, Command, CommandFactory};
use gaitc_compiler::diagnostic::Code;
use gaitc_compiler::front::flags::suggest;
use gaitc_compiler::front::shortened;
use origin::{Origin, Read};
use serde_json::{Map, Value};
use std::ffi::OsString;
use std::path::PathBuf;

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

pub(super) fn run(cli: &Cli, args: &RunArgs) -> Result<Outcome, InputError> {
    let Read { mut run, made, origin } = origin::read(&args.file)?;
    give_way(&mut run, &args.arguments);
    let arguments = arguments(&run, &args.arguments, &origin)?;
    let mut again = super::parse(arguments).map_err(|error| origin.asked(not_taken(&error)))?;
    again.json |= cli.json;
    again.quiet |= cli.quiet;
    again.verbose |= cli.verbose;
    again.specs = again.specs.take().or_else(|| cli.specs.clone());
    if let Some(made) = &made {
        compare(&again, made);
    }
    super::run(&again).map_err(|error| origin.asked(error))
}

/// Reads the text of a run file, up to the arguments of the command that it asks for, which is not run: what a program that makes run
/// files can check them with.
///
/// # Errors
/// In words, when it is no run file, or the command does not take these arguments.
pub fn check(text: &str) -> Result<(), String> {
    let checked = origin::of_text("run.toml".as_ref(), text.to_owned()).and_then(|read| {
        let arguments = arguments(&read.run, &[], &read.origin)?;
        super::parse(arguments).map_err(|error| not_taken(&error))
    });
    checked.map(drop).map_err(|InputError(message)| message)
}

/// Arguments that the command does not take.
fn not_taken(error: &clap::Error) -> InputError {
    let help = "`gaitc COMMAND --help` says what the command takes, `gaitc run --help` how it is written";
    InputError(format!("{}\n  help: {help}", super::args::message(error)))
}

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
fn arguments(run: &Map<String, Value>, further: &[OsString], origin: &Origin<'_>) -> Result<Vec<OsString>, InputError> {
    let program = Cli::command();
    let (name, command) = command(run, &program, origin)?;
    let known: Vec<&Arg> = command.get_arguments().chain(program.get_arguments()).collect();
    let keys: Vec<String> = known.iter().map(|arg| provenance::key(arg)).collect();
    let mut all: Vec<OsString> = vec!["gaitc".into(), name.into()];
    let mut positional = Vec::new();
    for (key, value) in run.iter().filter(|(key, _)| *key != "command") {
        let Some(arg) = known.iter().find(|arg| provenance::key(arg) == *key) else {
            let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
            let message = format!("`gaitc {name}` has no `{}`", shortened(key));
            return Err(origin.refuse(Code::UnknownKey, key, &message, &choose(key, &keys)));
        };
        if matches!(arg.get_action(), ArgAction::SetTrue) {
            match value {
                Value::Bool(true) => all.push(format!("--{key}").into()),
                Value::Bool(false) => {}
                _ => {
                    let message = format!("`{key}` is {}, not true or false", kind(value));
                    return Err(origin.refuse(Code::WrongType, key, &message, "write `true` or `false`"));
                }
            }
            continue;
        }
        let texts = texts(value).map_err(|inner| {
            let place = inner.map_or_else(|| key.clone(), |inner| format!("{key}.{inner}"));
            let message = format!("`{}` has no value that can be used", shortened(&place));
            let help =
                "write a number, or a text in quotes; of `NAME=VALUE` flags a table with one value for each name";
            origin.refuse(Code::WrongType, &place, &message, help)
        })?;
        if arg.is_positional() {
            positional.extend(texts.into_iter().map(OsString::from));
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

/// The command that a run names.
fn command<'r, 'c>(
    run: &'r Map<String, Value>,
    program: &'c Command,
    origin: &Origin<'_>,
) -> Result<(&'r str, &'c Command), InputError> {
    let commands = || program.get_subcommands().filter(|command| command.get_name() != "run");
    let names: Vec<&str> = commands().map(Command::get_name).collect();
    let help = || format!("write `command = \"NAME\"` with one of: {}", names.join(", "));
    let name = match run.get("command") {
        None => return Err(origin.plainly("`command` is missing", &help())),
        Some(Value::String(name)) => name,
        Some(other) => {
            let message = format!("`command` is {}, not the name of a command", kind(other));
            return Err(origin.refuse(Code::WrongType, "command", &message, &help()));
        }
    };
    let found = commands().find(|command| command.get_name() == name).map(|command| (name.as_str(), command));
    found.ok_or_else(|| {
        let message = format!("no command is named `{}`", shortened(name));
        origin.refuse(Code::BadValue, "command", &message, &choose(name, &names))
    })
}

fn choose(name: &str, names: &[&str]) -> String {
    match suggest(name, names.iter().copied()) {
        Some(close) => format!("did you mean `{close}`?"),
        None => format!("choose from: {}", names.join(", ")),
    }
}

/// What a value is, in words.
fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "nothing",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "a number",
        Value::String(_) => "a text",
        Value::Array(_) => "a list",
        Value::Object(_) => "a table",
    }
}

/// The values of one argument as the command line has them; else the name in its table that has none.
fn texts(value: &Value) -> Result<Vec<String>, Option<String>> {
    match value {
        Value::Array(all) => all.iter().map(|value| text(value).ok_or(None)).collect(),
        Value::Object(all) => {
            let one = |(name, value): (&String, &Value)| match text(value) {
                Some(text) => Ok(format!("{name}={text}")),
                None => Err(Some(name.clone())),
            };
            all.iter().map(one).collect()
        }
        one => Ok(vec![text(one).ok_or(None)?]),
    }
}

/// A single value.
fn text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
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
