//! `gaitc man DIR`: a manual page for the program and one for each command, in the format that `man` reads.

use super::args::Cli;
use super::{InputError, Outcome, output};
use crate::files::{self, FileError};
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use serde_json::json;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  gaitc man ~/.local/share/man/man1\n  man gaitc-optimize")]
pub(crate) struct ManArgs {
    /// Folder to write the pages to; made where it does not exist
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

pub(super) fn run(cli: &Cli, args: &ManArgs) -> Result<Outcome, InputError> {
    let folder = &args.folder;
    std::fs::create_dir_all(folder).map_err(|error| FileError::writing(folder, error))?;
    let mut program = Cli::command().name("gaitc");
    program.build();
    let pages = std::iter::once(&program).chain(program.get_subcommands());
    let mut written = Vec::new();
    for command in pages.filter(|command| command.get_name() != "help") {
        let name = format!("{}.1", title(command));
        let path = folder.join(&name);
        let page = page(command).map_err(|error| FileError::writing(&path, error));
        page.and_then(|page| files::write(&path, &page))?;
        written.push(name);
    }
    if cli.json {
        output::json(&json!({ "folder": folder.display().to_string(), "files": written }));
    } else {
        output::print(&format!("{} manual pages in {}\n", written.len(), folder.display()));
    }
    Ok(Outcome::Done)
}

fn title(command: &Command) -> String {
    command.get_display_name().unwrap_or(command.get_name()).to_owned()
}

fn page(command: &Command) -> std::io::Result<Vec<u8>> {
    let mut page = Vec::new();
    Man::new(command.clone()).title(title(command)).section("1").render(&mut page)?;
    Ok(page)
}
