//! `gaitc merge DIR...`: one table, or one folder, from the shards of a study.

use super::args::MergeArgs;
use super::run::put_tables;
use crate::cli::args::Cli;
use crate::cli::{InputError, Outcome, output, table_file};
use crate::study::{Folder, finish, merge};
use crate::words::counted;
use serde_json::json;
use std::path::{Path, PathBuf};

pub(crate) fn run(cli: &Cli, args: &MergeArgs) -> Result<Outcome, InputError> {
    for (flag, path) in [("--out", &args.out), ("--dir", &args.dir)] {
        path.as_deref().map_or(Ok(()), |path| outside(flag, path, &args.folders))?;
    }
    args.out.as_deref().map_or(Ok(()), |path| table_file::check("--out", path))?;
    let folders: Vec<Folder> = args.folders.iter().map(|path| Folder::read(path)).collect::<Result<_, _>>()?;
    let mut merged = merge(&folders)?;
    let (manifest, warnings) = (merged.manifest().clone(), std::mem::take(&mut merged.warnings));
    let provenance = manifest.provenance().map_err(InputError)?;
    // Where a merge was cut short it goes on.
    let folder = args.dir.as_deref().map(|path| Folder::open(path, manifest.clone(), true)).transpose()?;
    folder.as_ref().map_or(Ok(()), |folder| merged.put(folder))?;
    let table = finish(manifest.kind, merged.rows());
    let mut written = Vec::new();
    if let Some(folder) = &folder {
        put_tables(folder, &table, &provenance)?;
        let (folder, kind) = (folder.path().display(), manifest.kind.name());
        written.extend([format!("{folder}/{kind}.csv"), format!("{folder}/{kind}.parquet")]);
    }
    if let Some(out) = &args.out {
        table_file::save("--out", out, &table, &provenance);
        written.extend((!output::lost()).then(|| out.display().to_string()));
    }
    if cli.json {
        let found = json!({
            "model": provenance.model,
            "status": "complete",
            "points": manifest.points,
            "folders": folders.len(),
            "warnings": warnings,
            "written": written,
        });
        output::result(&provenance, found);
    } else if !written.is_empty() {
        let (points, from) = (counted(manifest.points, "point"), counted(folders.len() as u64, "folder"));
        let mut text = format!("{} · {} · {points} from {from}\n", provenance.model, manifest.kind.name());
        warnings.iter().for_each(|warning| text += &format!("warning: {warning}\n"));
        output::print(&format!("{text}written: {}\n", written.join(", ")));
    }
    Ok(Outcome::Done)
}

/// Refuses to write into a folder that is read.
fn outside(flag: &str, path: &Path, folders: &[PathBuf]) -> Result<(), InputError> {
    let place = resolved(path);
    match folders.iter().find(|folder| place.starts_with(resolved(folder))) {
        None => Ok(()),
        Some(folder) => Err(InputError(format!(
            "{flag}: `{}` is in `{}`, whose chunks are merged\n  help: write to a place outside the shards' folders",
            path.display(),
            folder.display()
        ))),
    }
}

/// A path as the file system knows it, as far as it is there.
fn resolved(path: &Path) -> PathBuf {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let known = whole.ancestors().find_map(|known| Some((known, known.canonicalize().ok()?)));
    known.map_or(whole.clone(), |(known, real)| match whole.strip_prefix(known) {
        Ok(rest) if !rest.as_os_str().is_empty() => real.join(rest),
        _ => real,
    })
}
