//! The command line: one file a command. Results go to stdout, everything else to stderr.
//!
//! Exit codes: 0 done and converged; 1 wrong input; 2 ran, but there is no gait or no optimum; 130 interrupted.

mod args;
mod check;
mod compare;
mod completions;
mod continuation;
mod explain;
mod gait;
mod guards;
mod inputs;
mod man;
mod models;
mod new;
mod optimize;
mod output;
mod plots;
mod provenance;
mod report;
pub mod run;
mod schema;
mod show;
mod signals;
mod simulate;
mod stops;
mod study;
mod table_file;
mod verify;
mod whole;

use args::{Cli, Command};
use clap::{CommandFactory, FromArgMatches};
use output::Talk;
use serde_json::json;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;

/// The exit code of a program that Ctrl-C ended: 128 and the number of the signal.
const INTERRUPTED: u8 = 130;

/// How a command that could run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// With what was asked for.
    Done,
    /// Without: no gait, no optimum, a derivative that is wrong.
    Without,
    /// Somebody pressed Ctrl-C; what there was has been printed.
    Interrupted,
}

/// Wrong input: the text says where, what was expected and what to write instead.
#[derive(Debug)]
struct InputError(String);

impl<E: std::error::Error> From<E> for InputError {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    signals::hold_back();
    let cli = match parse(std::env::args_os()) {
        Ok(cli) => cli,
        Err(message) => {
            if message.use_stderr() {
                // The flag cannot be asked for where the arguments could not be read.
                if std::env::args_os().skip(1).take_while(|arg| arg != "--").any(|arg| arg == "--json") {
                    let message = output::shortened(&args::message(&message));
                    output::json(&json!({ "status": "error", "message": message }));
                }
                output::usage(&message);
                return ExitCode::from(1);
            }
            // Help and version: printed like any result.
            output::print(&message.render().ansi().to_string());
            return if output::lost() { ExitCode::from(1) } else { ExitCode::SUCCESS };
        }
    };
    let begun = Instant::now();
    let ended = run(&cli);
    output::note(&format!("{:.2} s", begun.elapsed().as_secs_f64()));
    match ended {
        Ok(_) if output::lost() => ExitCode::from(1),
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Without) => ExitCode::from(2),
        Ok(Outcome::Interrupted) => ExitCode::from(INTERRUPTED),
        Err(InputError(message)) => {
            if cli.json && !cli.command.prints_its_own_errors() {
                output::json(&json!({ "status": "error", "message": output::shortened(&message) }));
            }
            output::error(&message);
            ExitCode::from(1)
        }
    }
}

/// Reads arguments, the program's name first.
fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Cli, clap::Error> {
    let mut command = Cli::command();
    let matches = command.try_get_matches_from_mut(arguments)?;
    let mut cli = Cli::from_arg_matches(&matches)?;
    cli.run = provenance::run(&command, &matches);
    Ok(cli)
}

fn run(cli: &Cli) -> Result<Outcome, InputError> {
    output::talk(match (cli.quiet, cli.verbose) {
        (true, _) => Talk::Quiet,
        (false, true) => Talk::Verbose,
        (false, false) => Talk::Normal,
    });
    match &cli.command {
        Command::Run(args) => run::run(cli, args),
        Command::Completions(args) => completions::run(cli, args),
        Command::Man(args) => man::run(cli, args),
        Command::Models => models::run(cli),
        Command::New(args) => new::run(cli, args),
        Command::Schema(args) => schema::run(args),
        Command::Check(args) => check::run(cli, args),
        Command::Show(args) => show::run(cli, args),
        Command::Explain(args) => explain::run(cli, args),
        Command::Gait(args) => gait::run(cli, args),
        Command::Simulate(args) => simulate::run(cli, args),
        Command::Continue(args) => continuation::run(cli, args),
        Command::Optimize(args) => optimize::run(cli, args),
        Command::Compare(args) => compare::run(cli, args),
        Command::Report(args) => report::run(cli, args),
        Command::Verify(args) => verify::run(cli, args),
        Command::Sweep(args) => study::sweep(cli, args),
        Command::Basin(args) => study::basin(cli, args),
        Command::Merge(args) => study::merge(cli, args),
    }
}
