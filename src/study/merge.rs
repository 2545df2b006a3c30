//! Shards of one study become one table, or one folder.

use super::chunk;
use super::folder::{Folder, StoreError};
use super::manifest::Manifest;
use crate::table::Table;
use crate::words::counted;

/// So many missing stretches, and so many shards, are named.
const NAMED: usize = 5;

/// What the shards of a study have made.
#[derive(Debug)]
pub struct Merged {
    manifest: Manifest,
    /// The rows of every chunk, in order.
    chunks: Vec<Table>,
    /// What the user may not have meant, in sentences: a shard that stands in two folders.
    pub warnings: Vec<String>,
}

impl Merged {
    /// What is studied, all of it.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Keeps the chunks in a folder, as if the study had been computed there.
    ///
    /// # Errors
    /// When a chunk cannot be written.
    pub fn put(&self, folder: &Folder) -> Result<(), StoreError> {
        (0..).zip(&self.chunks).try_for_each(|(number, rows)| folder.put_chunk(number, rows))
    }

    /// The rows of all points.
    pub fn rows(self) -> Table {
        let mut all = self.manifest.table();
        self.chunks.into_iter().for_each(|rows| all.append(rows));
        all
    }
}

/// The rows of all points, from folders that hold shards of one study. A shard may stand in several folders as long as they agree.
///
/// # Errors
/// When they are of different studies, disagree, or do not make a whole; when a folder is named twice.
pub fn merge(folders: &[Folder]) -> Result<Merged, StoreError> {
    let Some(first) = folders.first() else {
        return Err(StoreError::Incomplete("there is nothing to merge".to_owned()));
    };
    for (i, other) in folders.iter().enumerate().skip(1) {
        if let Some(known) = folders[..i].iter().find(|known| known.is_same(other)) {
            return Err(StoreError::Twice(known.path().to_owned()));
        }
        if let Some(difference) = other.manifest().difference(first.manifest()) {
            let difference = format!("compared with `{}`, {difference}", first.path().display());
            return Err(StoreError::Other { folder: other.path().to_owned(), difference });
        }
    }
    let manifest = first.manifest().whole();
    let (mut chunks, mut missing) = (Vec::new(), Vec::new());
    for number in 0..manifest.chunks() {
        match find(folders, number)? {
            Some(rows) if missing.is_empty() => chunks.push(rows),
            Some(_) => {}
            None => missing.push(number),
        }
    }
    if missing.is_empty() {
        Ok(Merged { manifest, chunks, warnings: twice(folders) })
    } else {
        Err(StoreError::Incomplete(incomplete(folders, &manifest, &missing)))
    }
}

/// A chunk, from the first folder that has it; the others that have it agree.
fn find(folders: &[Folder], number: u64) -> Result<Option<Table>, StoreError> {
    let mut found: Option<(&Folder, Table)> = None;
    for folder in folders.iter().filter(|folder| folder.manifest().owns(number)) {
        let Some(rows) = folder.chunk(number)? else { continue };
        match &found {
            None => found = Some((folder, rows)),
            Some((first, known)) => {
                let bytes = |rows: &Table| chunk::encode(folder.manifest(), number, rows);
                if bytes(known) != bytes(&rows) {
                    let (one, other) = (first.path().to_owned(), folder.path().to_owned());
                    return Err(StoreError::Disagree {
                        one,
                        other,
                        points: points(folder.manifest(), (number, number)),
                    });
                }
            }
        }
    }
    Ok(found.map(|(_, rows)| rows))
}

/// One sentence for each shard that stands in two folders.
fn twice(folders: &[Folder]) -> Vec<String> {
    let shard = |folder: &Folder| folder.manifest().shard;
    let again = |(i, folder): (usize, &Folder)| {
        let known = folders[..i].iter().find(|known| shard(known) == shard(folder))?;
        let (shard, known, folder) = (shard(folder), known.path().display(), folder.path().display());
        Some(format!("shard {shard} is given twice, by `{known}` and `{folder}`; they agree in what both have"))
    };
    folders.iter().enumerate().filter_map(again).collect()
}

/// What is missing, in which shards, and what to run for it.
fn incomplete(folders: &[Folder], manifest: &Manifest, missing: &[u64]) -> String {
    let is = |count: usize| if count == 1 { "is" } else { "are" };
    let (chunks, points) = (counted(manifest.chunks(), "chunk"), stretches(manifest, missing));
    let mut lines = vec![format!("{} of {chunks} {} missing: points {points}", missing.len(), is(missing.len()))];
    let mut help = Vec::new();
    let unfinished = unfinished(folders, missing);
    lines.extend(unfinished.iter().take(NAMED).cloned());
    if unfinished.len() > NAMED {
        lines.push(format!("nor are {}", counted((unfinished.len() - NAMED) as u64, "more folder")));
    }
    if !unfinished.is_empty() {
        help.push("run what is not finished again with --resume".to_owned());
    }
    let absent = absent(folders, missing);
    if let Some(first) = absent.first() {
        let listed: Vec<&str> = absent.iter().take(2 * NAMED).map(String::as_str).collect();
        let more = if absent.len() > listed.len() { ", ..." } else { "" };
        let shards = if absent.len() == 1 { "shard" } else { "shards" };
        lines.push(format!("{shards} {}{more} {} in none of the folders", listed.join(", "), is(absent.len())));
        help.push(format!("name the folder of every shard, or run what is absent, as with --shard {first}"));
    }
    format!("{}\n  help: {}", lines.join("\n  "), help.join("; "))
}

/// The points of some chunks, in words.
fn stretches(manifest: &Manifest, chunks: &[u64]) -> String {
    let mut all: Vec<(u64, u64)> = Vec::new();
    for &chunk in chunks {
        match all.last_mut() {
            Some((_, last)) if *last + 1 == chunk => *last = chunk,
            _ => all.push((chunk, chunk)),
        }
    }
    let mut named: Vec<String> = all.iter().take(NAMED).map(|stretch| points(manifest, *stretch)).collect();
    if all.len() > NAMED {
        named.push(counted((all.len() - NAMED) as u64, "more stretch"));
    }
    named.join(", ")
}

/// The points of a stretch of chunks, in words.
fn points(manifest: &Manifest, (first, last): (u64, u64)) -> String {
    format!("{} to {}", manifest.rows(first).start, manifest.rows(last).end.saturating_sub(1))
}

/// One line for each folder that has not all of its chunks.
fn unfinished(folders: &[Folder], missing: &[u64]) -> Vec<String> {
    let line = |folder: &Folder| {
        let lacks = missing.iter().filter(|chunk| folder.manifest().owns(**chunk)).count() as u64;
        let (path, shard) = (folder.path().display(), folder.manifest().shard);
        let all = counted(folder.manifest().own().count() as u64, "chunk");
        let busy = if folder.is_busy() { "; a run is at work in it" } else { "" };
        (lacks > 0).then(|| format!("`{path}` (shard {shard}) is not finished: it lacks {lacks} of its {all}{busy}"))
    };
    folders.iter().filter_map(line).collect()
}

/// The shards whose folders are not there: of those that the finest cut has.
fn absent(folders: &[Folder], missing: &[u64]) -> Vec<String> {
    let count = folders.iter().map(|folder| folder.manifest().shard.count).max().unwrap_or(1);
    let nowhere = missing.iter().filter(|chunk| !folders.iter().any(|folder| folder.manifest().owns(**chunk)));
    let mut shards: Vec<u64> = nowhere.map(|chunk| chunk % count + 1).collect();
    shards.sort_unstable();
    shards.dedup();
    shards.iter().map(|shard| format!("{shard}/{count}")).collect()
}
