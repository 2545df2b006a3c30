//! Starting the CasADi script: request on stdin, answer on stdout.

use super::exchange::{Request, Response};
use super::{CasadiError, Python, SCRIPT};
use std::io::Write as _;
use std::process::{Command, Output, Stdio};

/// Longest output of a failing process that is shown.
const SHOWN_LINES: usize = 20;

/// Runs the script once.
///
/// # Errors
/// When the process cannot be started, fails, or its answer cannot be read.
pub fn run(python: &Python, request: &Request) -> Result<Response, CasadiError> {
    let text = serde_json::to_string(request).map_err(|error| CasadiError::Answer(error.to_string()))?;
    let mut command = Command::new(&python.command);
    command.arg("-c").arg(SCRIPT).args(&python.packages);
    let output = converse(&mut command, text)?;
    if !output.status.success() {
        return Err(CasadiError::Failed { status: output.status.to_string(), output: shown(&output) });
    }
    serde_json::from_slice(&output.stdout).map_err(|error| CasadiError::Answer(error.to_string()))
}

/// Runs a command that reads `input`, and waits for all it prints.
pub(super) fn converse(command: &mut Command, input: String) -> Result<Output, CasadiError> {
    let name = command.get_program().to_string_lossy().into_owned();
    let failed = |source| CasadiError::Process { command: name.clone(), source };
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().map_err(failed)?;
    // On a thread of its own: a child that prints before it has read all would otherwise block both. A child that
    // ends early closes the pipe; its own output then says why, so that error of the write is of no interest.
    let writer = child.stdin.take().map(|mut stdin| {
        std::thread::spawn(move || {
            let _ = stdin.write_all(input.as_bytes());
        })
    });
    let output = child.wait_with_output().map_err(failed)?;
    if let Some(writer) = writer {
        let _ = writer.join();
    }
    Ok(output)
}

/// The last lines that a process printed, of stderr if there are any.
pub(super) fn shown(output: &Output) -> String {
    let bytes = if output.stderr.is_empty() { &output.stdout } else { &output.stderr };
    let text = String::from_utf8_lossy(bytes);
    let lines: Vec<&str> = text.lines().collect();
    let hidden = lines.len().saturating_sub(SHOWN_LINES);
    let mut shown = if hidden > 0 { format!("  ... ({hidden} lines more)\n") } else { String::new() };
    for line in lines.iter().skip(hidden) {
        shown.push_str("  ");
        shown.extend(line.chars().take(400));
        shown.push('\n');
    }
    shown
}
