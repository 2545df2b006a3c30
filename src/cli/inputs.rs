//! From flags to numbers: `--set`, `--guess`, `--tol`.

use super::InputError;
use super::args::{ModelArgs, SearchArgs};
use crate::load::Loaded;
use gaitc_compiler::front::flags::{parse_assignment, parse_quantity, suggest};
use gaitc_runtime::return_map::Accuracy;

/// The spec's parameter values with every `--set` applied.
pub(super) fn parameters(loaded: &Loaded, args: &ModelArgs) -> Result<Vec<f64>, InputError> {
    let mut values = loaded.parameters();
    for text in &args.set {
        let (name, quantity) = parse_assignment(text)?;
        let index = parameter(loaded, "--set", name)?;
        values[index] = parse_quantity(quantity, loaded.spec.parameters[index].dimension)?;
    }
    Ok(values)
}

/// The section's start with every `--guess` applied.
pub(super) fn guess(loaded: &Loaded, args: &SearchArgs) -> Result<Vec<f64>, InputError> {
    let mut values = loaded.start();
    for text in &args.guess {
        let (name, quantity) = parse_assignment(text)?;
        let states = &loaded.spec.states;
        let names: Vec<&str> = loaded.coordinates().iter().map(|&i| states[i].name.as_str()).collect();
        let Some(index) = names.iter().position(|n| *n == name) else {
            return Err(unknown("--guess", "section coordinate", name, &names));
        };
        values[index] = parse_quantity(quantity, states[loaded.coordinates()[index]].dimension)?;
    }
    Ok(values)
}

/// The default accuracy, or that of `--tol`.
pub(super) fn accuracy(args: &SearchArgs) -> Result<Accuracy, InputError> {
    let accuracy = Accuracy::default();
    match args.tol {
        None => Ok(accuracy),
        // Below a few units of rounding no step can be accepted.
        Some(tol) if (1e-15..=1e-2).contains(&tol) => {
            Ok(Accuracy { relative: tol, absolute: tol * (accuracy.absolute / accuracy.relative), ..accuracy })
        }
        Some(tol) => Err(InputError(format!("--tol {tol}: give a number from 1e-15 to 1e-2"))),
    }
}

/// Index of a parameter that a flag names.
pub(super) fn parameter(loaded: &Loaded, flag: &str, name: &str) -> Result<usize, InputError> {
    let names: Vec<&str> = loaded.spec.parameters.iter().map(|p| p.name.as_str()).collect();
    loaded.parameter(name).ok_or_else(|| unknown(flag, "parameter", name, &names))
}

/// The message for a name that is not there.
pub(super) fn unknown(flag: &str, kind: &str, name: &str, names: &[&str]) -> InputError {
    let help = match suggest(name, names.iter().copied()) {
        Some(close) => format!("did you mean `{close}`?"),
        None if names.is_empty() => format!("the model has no {kind}"),
        None => format!("choose from: {}", names.join(", ")),
    };
    InputError(format!("{flag}: no {kind} is named `{name}`\n  help: {help}"))
}
