//! `gaitc merge DIR...`: one table from the shards of a study.

use super::args::MergeArgs;
use crate::cli::args::Cli;
use crate::cli::{InputError, Outcome, output, table_file};
use crate::study::{Folder, finish, merge};
use serde_json::json;

pub(crate) fn run(cli: &Cli, args: &MergeArgs) -> Result<Outcome, InputError> {
    table_file::check("--out", &args.out)?;
    let folders: Vec<Folder> = args.folders.iter().map(|path| Folder::read(path)).collect::<Result<_, _>>()?;
    let rows = merge(&folders)?;
    let Some(manifest) = folders.first().map(Folder::manifest) else { return Ok(Outcome::Done) };
    let provenance = manifest.provenance().map_err(InputError)?;
    let table = finish(manifest.kind, rows);
    table_file::save("--out", &args.out, &table, &provenance);
    if cli.json {
        let found = json!({
            "model": provenance.model,
            "status": "complete",
            "points": manifest.points,
            "folders": folders.len(),
        });
        output::result(&provenance, found);
    } else if !output::lost() {
        output::print(&format!(
            "{} · {} · {} points from {} folders\nwritten: {}\n",
            provenance.model,
            manifest.kind.name(),
            manifest.points,
            folders.len(),
            args.out.display()
        ));
    }
    Ok(Outcome::Done)
}
