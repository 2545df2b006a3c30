//! Shards of one study become one table.

use super::folder::{Folder, StoreError};
use super::manifest::Manifest;
use crate::table::Table;

/// So many missing stretches are named.
const NAMED: usize = 5;

/// The rows of all points, from folders that hold shards of one study.
///
/// # Errors
/// When they are of different studies, or do not make a whole.
pub fn merge(folders: &[Folder]) -> Result<Table, StoreError> {
    let Some(first) = folders.first() else {
        return Err(StoreError::Incomplete("there is nothing to merge".to_owned()));
    };
    for other in &folders[1..] {
        if let Some(difference) = other.manifest().difference(first.manifest()) {
            let difference = format!("compared with `{}`, {difference}", first.path().display());
            return Err(StoreError::Other { folder: other.path().to_owned(), difference });
        }
    }
    let (mut all, mut missing) = (first.manifest().table(), Vec::new());
    for number in 0..first.manifest().chunks() {
        let mut found = None;
        for folder in folders {
            found = folder.chunk(number)?;
            if found.is_some() {
                break;
            }
        }
        match found {
            Some(rows) if missing.is_empty() => all.append(rows),
            Some(_) => {}
            None => missing.push(number),
        }
    }
    if missing.is_empty() {
        Ok(all)
    } else {
        Err(StoreError::Incomplete(incomplete(folders, first.manifest(), &missing)))
    }
}

/// What is missing, and what to run for it.
fn incomplete(folders: &[Folder], manifest: &Manifest, missing: &[u64]) -> String {
    let mut stretches: Vec<(u64, u64)> = Vec::new();
    for &chunk in missing {
        match stretches.last_mut() {
            Some((_, last)) if *last + 1 == chunk => *last = chunk,
            _ => stretches.push((chunk, chunk)),
        }
    }
    let points = |(first, last): &(u64, u64)| {
        format!("{} to {}", manifest.rows(*first).start, manifest.rows(*last).end.saturating_sub(1))
    };
    let mut named: Vec<String> = stretches.iter().take(NAMED).map(points).collect();
    if stretches.len() > NAMED {
        named.push(format!("{} more stretches", stretches.len() - NAMED));
    }
    let count = folders.iter().map(|folder| folder.manifest().shard.count).max().unwrap_or(1);
    let mut shards: Vec<u64> = missing.iter().map(|chunk| chunk % count + 1).collect();
    shards.sort_unstable();
    shards.dedup();
    let shards: Vec<String> = shards.iter().take(2 * NAMED).map(|shard| format!("{shard}/{count}")).collect();
    let help = match count {
        1 => "run the study again with --resume".to_owned(),
        _ => format!("run the shards {} (again, with --resume), and name their folders, too", shards.join(", ")),
    };
    format!(
        "{} of {} chunks are missing: points {}\n  help: {help}",
        missing.len(),
        manifest.chunks(),
        named.join(", ")
    )
}
