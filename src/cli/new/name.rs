//! What a new project is called: its folder, and the model in it.

use super::InputError;
use crate::files::FileError;
use gaitc_compiler::front::is_module_name;
use std::path::{Component, Path, PathBuf};

/// What a name looks like.
pub(super) const RULE: &str =
    "a model's name has lower-case letters, digits and `_`, begins with a letter and is no Rust keyword";

/// Longest name: it is in paths of files, whose names have at most 255 bytes almost everywhere.
const LONGEST: usize = 64;

/// Names that cargo or the language keeps for itself, or that another crate of the project has.
const TAKEN: &[&str] = &[
    "alloc",
    "build",
    "core",
    "deps",
    "examples",
    "gaitc",
    "gaitc_compiler",
    "gaitc_runtime",
    "incremental",
    "proc_macro",
    "std",
    "test",
    // Files of these names cannot be made on every system.
    "aux",
    "con",
    "nul",
    "prn",
    "com1",
    "com2",
    "com3",
    "com4",
    "lpt1",
    "lpt2",
    "lpt3",
];

/// The folder of a project as an absolute path, if cargo can build in it.
pub(super) fn folder(given: &Path) -> Result<PathBuf, InputError> {
    let shown = given.display();
    if given.to_str().is_none() {
        return Err(InputError(format!("`{shown}` is not UTF-8\n  help: choose another folder")));
    }
    let absolute = std::path::absolute(given).map_err(|error| FileError::writing(given, error))?;
    // Cargo puts the folder into lists of paths, and talks to build scripts in lines.
    if absolute.to_string_lossy().chars().any(char::is_control) || std::env::join_paths([&absolute]).is_err() {
        let message = format!("cargo cannot build in `{}`", absolute.display().to_string().escape_debug());
        return Err(InputError(format!("{message}\n  help: choose a folder without `:` and control characters")));
    }
    let absolute = without_detours(&absolute);
    // `..` is resolved where that is possible, so that the last part of the path is a name.
    Ok(match absolute.file_name() {
        Some(_) => absolute,
        None => absolute.canonicalize().unwrap_or(absolute),
    })
}

/// The path without steps into folders that are not there and out again: these would be made on the way, and stay empty.
fn without_detours(path: &Path) -> PathBuf {
    let mut straight = PathBuf::new();
    for component in path.components() {
        // Through a folder that is there, or a link to one, `..` is the system's matter.
        let detour = component == Component::ParentDir && straight.symlink_metadata().is_err();
        if !(detour && straight.pop()) {
            straight.push(component);
        }
    }
    straight
}

/// A name that the user gave.
pub(super) fn checked(name: &str, flag: &str) -> Result<String, InputError> {
    match refused(name) {
        None => Ok(name.to_owned()),
        Some(why) => Err(InputError(format!("{flag}: {why}"))),
    }
}

/// The name of the model in a folder: `My Hopper-2` holds `my_hopper_2`.
pub(super) fn of_folder(folder: &Path) -> Result<String, InputError> {
    let last = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut name = String::new();
    for letter in last.to_lowercase().chars() {
        let fits = letter.is_ascii_alphanumeric();
        if fits && !(name.is_empty() && letter.is_ascii_digit()) {
            name.push(letter);
        } else if !fits && !name.is_empty() && !name.ends_with('_') {
            name.push('_');
        }
    }
    let name = name.trim_end_matches('_').to_owned();
    match refused(&name) {
        None => Ok(name),
        Some(_) => {
            let message = format!("the folder's name `{}` gives no name for a model", last.escape_debug());
            Err(InputError(format!("{message}\n  help: give one, as in `--name hopper`; {RULE}")))
        }
    }
}

/// Why a model cannot have a name.
fn refused(name: &str) -> Option<String> {
    let shown: String = name.chars().take(LONGEST).collect::<String>().escape_debug().to_string();
    if name.len() > LONGEST {
        return Some(format!("`{shown}...` has {} bytes\n  help: a name has at most {LONGEST}", name.len()));
    }
    if !is_module_name(name) {
        return Some(format!("`{shown}` cannot name a model\n  help: {RULE}"));
    }
    if TAKEN.contains(&name) {
        return Some(format!("`{shown}` has a meaning for cargo or the system\n  help: choose another name"));
    }
    None
}
