//! `gaitc check FILES`: all diagnostics of spec files and parts, without Python and without a build.

use super::args::{CheckArgs, Cli};
use super::{InputError, Outcome, output};
use crate::files::FileError;
use gaitc_compiler::diagnostic::{self, Code, Severity};
use gaitc_compiler::front::{self, Parsed};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

pub(super) fn run(cli: &Cli, args: &CheckArgs) -> Result<Outcome, InputError> {
    let mut found = Found::default();
    for path in &args.files {
        found.path(path, cli.json);
    }
    if cli.json {
        output::json(&json!({ "diagnostics": found.described }));
    } else if let Some(hint) = hint(&found.codes) {
        output::print(&hint);
    }
    match (found.errors, found.unread) {
        (0, 0) => Ok(Outcome::Done),
        (0, 1) => Err(InputError("1 file could not be read".to_owned())),
        (0, n) => Err(InputError(format!("{n} files could not be read"))),
        (1, 0) => Err(InputError("1 error in the spec".to_owned())),
        (n, 0) => Err(InputError(format!("{n} errors in the specs"))),
        (n, m) => Err(InputError(format!("errors in the specs: {n}; files that could not be read: {m}"))),
    }
}

/// What was found in all files.
#[derive(Default)]
struct Found {
    described: Vec<Value>,
    codes: BTreeSet<Code>,
    errors: usize,
    unread: usize,
}

impl Found {
    /// Checks a file, or every spec and part below a folder.
    fn path(&mut self, path: &Path, json: bool) {
        if !path.is_dir() {
            return self.file(path, json);
        }
        let (mut files, mut other) = (Vec::new(), 0);
        let listed = toml_files(path, &mut files, &mut other);
        match &listed {
            Err(error) => self.cannot_read(path, (&error.why(), error.help()), json),
            Ok(()) if files.is_empty() => {
                let why = match other {
                    0 => "no file below this folder ends in .toml",
                    _ => "no TOML file below this folder has the key `spec`: there is no spec",
                };
                self.cannot_read(path, (why, "name a spec, or a folder that holds specs"), json);
            }
            Ok(()) => {}
        }
        files.sort();
        files.iter().for_each(|file| self.file(file, json));
    }

    fn file(&mut self, path: &Path, json: bool) {
        let checked = match front::check_file(path) {
            Ok(checked) => checked,
            Err(error) => return self.cannot_read(path, (&error.why(), error.help()), json),
        };
        let parsed = &checked.parsed;
        self.errors += parsed.diagnostics.iter().filter(|d| d.severity == Severity::Error).count();
        self.codes.extend(parsed.diagnostics.iter().map(|d| d.code));
        if json {
            self.described.extend(describe(parsed));
        } else if parsed.diagnostics.is_empty() {
            let part = if checked.part { "part, " } else { "" };
            output::print(&format!("{}: {part}no problems\n", path.display()));
        } else {
            output::print(&diagnostic::render(&parsed.diagnostics, &parsed.sources, true));
        }
    }

    /// Reports a file that cannot be read, and goes on.
    fn cannot_read(&mut self, path: &Path, (why, help): (&str, &str), json: bool) {
        self.unread += 1;
        let message = format!("cannot read `{}`: {why}", path.display());
        if json {
            let code = Code::File.as_str();
            self.described.push(json!({
                "code": code, "severity": "error", "message": message, "file": path.display().to_string(),
                "line": null, "column": null, "help": help,
            }));
        } else {
            output::error(&format!("{message}\n  help: {help}"));
        }
    }
}

/// Every spec and part below a folder, and the number of `other` files that end in `.toml`. Links to folders are not
/// followed, and hidden folders and what cargo builds are left out.
fn toml_files(folder: &Path, files: &mut Vec<PathBuf>, other: &mut usize) -> Result<(), FileError> {
    let problem = |error| FileError::reading(folder, error);
    for entry in std::fs::read_dir(folder).map_err(problem)? {
        let entry = entry.map_err(problem)?;
        let (path, name) = (entry.path(), entry.file_name());
        if name.as_encoded_bytes().starts_with(b".") {
            continue;
        }
        if entry.file_type().map_err(problem)?.is_dir() {
            if name != "target" {
                toml_files(&path, files, other)?;
            }
        } else if path.extension().is_some_and(|extension| extension == "toml") && !path.is_dir() {
            if front::may_be_spec(&path) {
                files.push(path);
            } else {
                *other += 1;
            }
        }
    }
    Ok(())
}

/// Where to read more, once a run.
fn hint(codes: &BTreeSet<Code>) -> Option<String> {
    let first = codes.first()?;
    let others: Vec<&str> = codes.iter().skip(1).map(|code| code.as_str()).collect();
    let also = if others.is_empty() { String::new() } else { format!(" (also {})", others.join(", ")) };
    Some(format!("\nfor more about {first}: gaitc explain {first}{also}\n"))
}

fn describe(parsed: &Parsed) -> Vec<Value> {
    let one = |d: &diagnostic::Diagnostic| {
        let place = diagnostic::locate(d, &parsed.sources);
        let (file, line, column) = place.map_or((None, None, None), |(f, l, c)| (Some(f), Some(l), Some(c)));
        json!({
            "code": d.code.to_string(),
            "severity": match d.severity { Severity::Error => "error", Severity::Warning => "warning" },
            "message": d.message,
            "file": file,
            "line": line,
            "column": column,
            "help": d.help,
        })
    };
    parsed.diagnostics.iter().map(one).collect()
}
