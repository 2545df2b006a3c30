//! The Rust codes of the comparison, and the units of work that all codes get.
//!
//!     gaitc-peers cases                              the units as JSON (feature `gaitc`)
//!     gaitc-peers run CODE UNIT CASES [--quick]      measures a code on a unit, one JSON object a line
//!
//! Each code is a feature, so that one that does not compile leaves the others alone.

#[cfg(any(feature = "diffsol", feature = "differential-equations"))]
mod climber;
#[cfg(feature = "differential-equations")]
mod differential_equations_code;
#[cfg(feature = "diffsol")]
mod diffsol_code;
#[cfg(feature = "gaitc")]
mod gaitc_code;
mod measure;
#[cfg_attr(not(any(feature = "diffsol", feature = "differential-equations")), allow(dead_code))] // gaitc has its own
mod unit;

use measure::Attempt;
use std::process::ExitCode;
use unit::Unit;

type Failure = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["cases"] => cases(),
        ["run", code, unit, file] => run(code, unit, file, false),
        ["run", code, unit, file, "--quick"] => run(code, unit, file, true),
        _ => Err("write `cases`, or `run CODE UNIT CASES [--quick]`".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(feature = "gaitc")]
fn cases() -> Result<(), Failure> {
    println!("{}", gaitc_code::cases()?);
    Ok(())
}

#[cfg(not(feature = "gaitc"))]
fn cases() -> Result<(), Failure> {
    Err("built without the feature `gaitc`".into())
}

fn run(code: &str, unit: &str, file: &str, quick: bool) -> Result<(), Failure> {
    let unit = Unit::read(file, unit)?;
    for attempt in attempts(code, &unit)? {
        println!("{}", attempt.row(&unit, quick));
    }
    Ok(())
}

/// The configurations of a code for a unit.
fn attempts(code: &str, unit: &Unit) -> Result<Vec<Attempt>, Failure> {
    match code {
        #[cfg(feature = "gaitc")]
        "gaitc" => gaitc_code::attempts(unit),
        #[cfg(feature = "diffsol")]
        "diffsol" => diffsol_code::attempts(unit),
        #[cfg(feature = "differential-equations")]
        "differential_equations" => differential_equations_code::attempts(unit),
        _ => Err(format!("unknown code `{code}` with unit `{}`, or built without its feature", unit.key).into()),
    }
}
