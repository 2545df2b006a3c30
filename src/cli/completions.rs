//! `gaitc completions SHELL`: what a shell needs to complete commands and flags.

use super::args::Cli;
use super::{InputError, Outcome, output};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gaitc completions bash > ~/.local/share/bash-completion/completions/gaitc\n  gaitc completions \
                  zsh > ~/.zfunc/_gaitc\n  gaitc completions fish > ~/.config/fish/completions/gaitc.fish"
)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

pub(super) fn run(cli: &Cli, args: &CompletionsArgs) -> Result<Outcome, InputError> {
    if cli.json {
        return Err(InputError("--json: a script for a shell has no JSON form\n  help: leave --json out".to_owned()));
    }
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "gaitc", &mut script);
    output::print(&String::from_utf8_lossy(&script));
    Ok(Outcome::Done)
}
