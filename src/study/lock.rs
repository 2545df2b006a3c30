//! One run at a time in a folder: an advisory lock of the operating system, which ends with the process that holds it, however that
//! ends. The file says who that is, for the message to others; that it is there means nothing.

use super::folder::StoreError;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read as _, Seek as _, Write as _};
use std::path::Path;

/// Held as long as it lives.
#[derive(Debug)]
pub(super) struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the lock of a folder.
    ///
    /// # Errors
    /// When another process holds it, or the file cannot be made.
    pub(super) fn take(folder: &Path) -> Result<Self, StoreError> {
        let path = folder.join("lock");
        super::folder::is_own(&path)?;
        let problem = |error| StoreError::not_written(&path, error);
        let mut file =
            OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path).map_err(problem)?;
        match file.try_lock() {
            Ok(()) => {
                // Only for the message: that it cannot be written is no reason not to go on.
                let _ = file
                    .set_len(0)
                    .and_then(|()| file.rewind())
                    .and_then(|()| writeln!(file, "process {}", std::process::id()));
            }
            Err(TryLockError::WouldBlock) => {
                let mut holder = String::new();
                let _ = file.read_to_string(&mut holder);
                return Err(StoreError::Busy { folder: folder.to_owned(), holder: holder.trim().to_owned() });
            }
            // A file system without locks: it is up to the user then.
            Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(problem(error)),
        }
        Ok(Self { _file: file })
    }

    /// Whether somebody holds the lock of a folder, as far as that can be seen.
    pub(super) fn is_held(folder: &Path) -> bool {
        let path = folder.join("lock");
        super::folder::is_own(&path).is_ok()
            && File::open(&path).is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }
}
