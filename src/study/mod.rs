//! The store of a study: a folder that holds what has been computed, in chunks of a fixed number of points, whatever happens in
//! between.
//!
//! `study.json` (module `manifest`) says what is studied; it is written first. `chunks/` has one file for each chunk that is done
//! (module `chunk`), written whole and with a checksum: what is torn, edited or of another study is computed again. A lock (module
//! `lock`) keeps a second run out. When all chunks are there the table is put together. Its bytes depend on the manifest alone.

mod chunk;
mod finish;
mod folder;
mod lock;
mod manifest;
mod merge;

pub use finish::finish;
pub use folder::{Folder, StoreError};
pub use manifest::{Kind, MOST_POINTS, Manifest, Shard};
pub use merge::{Merged, merge};
