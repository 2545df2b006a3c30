//! `gaitc check FILES`: all diagnostics of spec files, without Python and without a build.

use super::args::{CheckArgs, Cli};
use super::{InputError, Outcome, output};
use gaitc_compiler::diagnostic::{self, Severity};
use gaitc_compiler::front::{self, Parsed};
use serde_json::{Value, json};

pub(super) fn run(cli: &Cli, args: &CheckArgs) -> Result<Outcome, InputError> {
    let mut diagnostics = Vec::new();
    let mut errors = 0;
    for path in &args.files {
        let parsed =
            front::parse_file(path).map_err(|e| InputError(format!("cannot read `{}`: {e}", path.display())))?;
        errors += parsed.diagnostics.iter().filter(|d| d.severity == Severity::Error).count();
        if cli.json {
            diagnostics.extend(describe(&parsed));
        } else if parsed.diagnostics.is_empty() {
            output::print(&format!("{}: no problems\n", path.display()));
        } else {
            output::print(&diagnostic::render(&parsed.diagnostics, &parsed.sources, true));
        }
    }
    if cli.json {
        output::json(&json!({ "diagnostics": diagnostics }));
    }
    match errors {
        0 => Ok(Outcome::Done),
        1 => Err(InputError("1 error in the spec".to_owned())),
        n => Err(InputError(format!("{n} errors in the specs"))),
    }
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
