//! Runs a study chunk by chunk, keeps what is done, and writes the table.

use super::args::StorageArgs;
use crate::cli::{InputError, output, table_file};
use crate::progress::Progress;
use crate::provenance::Provenance;
use crate::study::{Folder, MOST_POINTS, Manifest, Shard, finish};
use crate::table::{self, Format, Table};
use gaitc_runtime::interrupt::Interrupt;
use std::ops::Range;

/// More points than this are too much to lose: they need a folder.
const MOST_WITHOUT_FOLDER: u64 = 100_000;
/// More threads than this only wait for each other.
const MOST_THREADS: usize = 1024;

/// A study as it was asked for.
pub(super) struct Asked<'a> {
    /// What is studied; chunks and shard are those of the flags.
    pub(super) manifest: Manifest,
    pub(super) provenance: &'a Provenance,
    pub(super) storage: &'a StorageArgs,
    /// Points of a chunk, where nobody says otherwise.
    pub(super) chunk: u64,
    /// Ends the work early.
    pub(super) interrupt: Interrupt,
}

/// How it ended.
pub(super) enum Ran {
    /// All points are there, or all of the shard.
    Complete(Table),
    /// Somebody asked to stop; so many points are done.
    Interrupted(u64),
}

/// Refuses numbers of points that cannot be meant; `arithmetic` says how the number comes about.
pub(super) fn count(points: Option<u64>, arithmetic: &str, storage: &StorageArgs) -> Result<u64, InputError> {
    match points {
        Some(points) if points <= MOST_WITHOUT_FOLDER || points <= MOST_POINTS && storage.dir.is_some() => Ok(points),
        Some(points) if points <= MOST_POINTS => Err(InputError(format!(
            "{arithmetic} = {points} points are too many to lose\n  help: keep them in a folder, --dir DIR, or ask for at most \
             {MOST_WITHOUT_FOLDER}"
        ))),
        _ => {
            let points = points.map_or(f64::INFINITY, |points| points as f64);
            let cost = match points.is_finite() {
                true => format!(
                    ": at a millisecond each they would take {:.0} hours, and every column of their table {:.2} GB",
                    points * 1e-3 / 3600.0,
                    points * 8e-9
                ),
                false => String::new(),
            };
            Err(InputError(format!(
                "{arithmetic} points are too many{cost}\n  help: ask for at most {MOST_POINTS}; --sobol N covers several \
                 parameters with fewer points than a grid"
            )))
        }
    }
}

/// Checks what can be known before any work is done.
pub(super) fn check(storage: &StorageArgs) -> Result<(), InputError> {
    if storage.chunk == Some(0) {
        return Err(InputError("--chunk 0: give a number of points from 1".to_owned()));
    }
    if let Some(threads) = storage.threads.filter(|threads| !(1..=MOST_THREADS).contains(threads)) {
        return Err(InputError(format!("--threads {threads}: give a number from 1 to {MOST_THREADS}")));
    }
    storage.out.as_deref().map_or(Ok(()), |path| table_file::check("--out", path))
}

impl Asked<'_> {
    /// Computes what is missing with `rows`, which gives the rows of some points, or `None` where it was told to stop.
    pub(super) fn run(
        mut self,
        rows: impl Fn(Range<u64>) -> Result<Option<Table>, InputError>,
    ) -> Result<Ran, InputError> {
        self.manifest.shard = self.storage.shard.unwrap_or_default();
        let known = self.storage.dir.as_deref().filter(|_| self.storage.resume).and_then(Folder::known);
        let default = known.map_or(self.chunk, |known| known.chunk);
        self.manifest.chunk = self.storage.chunk.unwrap_or(default);
        let folder = match &self.storage.dir {
            Some(path) => Some(Folder::open(path, self.manifest.clone(), self.storage.resume)?),
            None => None,
        };
        let progress = Progress::new(self.manifest.own_points(), "point", output::is_quiet());
        let (mut all, mut done) = (self.manifest.table(), 0);
        for chunk in self.manifest.own() {
            let numbers = self.manifest.rows(chunk);
            let count = numbers.end - numbers.start;
            // Chunks that are there already are read, many of them perhaps.
            if self.interrupt.requested() {
                return Ok(Ran::Interrupted(done));
            }
            let known = folder.as_ref().map_or(Ok(None), |folder| folder.chunk(chunk))?;
            if let Some(known) = known {
                progress.skip(count);
                all.append(known);
            } else {
                let Some(computed) = rows(numbers)? else { return Ok(Ran::Interrupted(done)) };
                if let Some(folder) = &folder {
                    folder.put_chunk(chunk, &computed)?;
                }
                progress.add(count);
                all.append(computed);
            }
            done += count;
        }
        drop(progress);
        let table = finish(self.manifest.kind, all);
        self.write(&table, folder.as_ref())?;
        Ok(Ran::Complete(table))
    }

    /// Writes the table to all the places where it is wanted. A shard is no table.
    fn write(&self, table: &Table, folder: Option<&Folder>) -> Result<(), InputError> {
        if self.manifest.shard != Shard::default() {
            return Ok(());
        }
        folder.map_or(Ok(()), |folder| put_tables(folder, table, self.provenance))?;
        if let Some(path) = &self.storage.out {
            table_file::save("--out", path, table, self.provenance);
        }
        Ok(())
    }
}

/// Writes the tables of a whole study into its folder.
pub(super) fn put_tables(folder: &Folder, table: &Table, provenance: &Provenance) -> Result<(), InputError> {
    for (format, ending) in [(Format::Csv, "csv"), (Format::Parquet, "parquet")] {
        let bytes = table::bytes(table, format, provenance).map_err(|e| InputError(e.to_string()))?;
        folder.put(&format!("{}.{ending}", folder.manifest().kind.name()), &bytes)?;
    }
    Ok(())
}
