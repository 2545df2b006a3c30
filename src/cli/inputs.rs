//! From flags to numbers: `--set`, `--guess`, `--tol`, `--method`.

use super::args::{ModelArgs, SearchArgs};
use super::{InputError, output};
use crate::load::Loaded;
use gaitc_compiler::front::LONGEST_PERIOD;
use gaitc_compiler::front::flags::{FlagError, parse_assignment, parse_quantity, suggest};
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Parameter, Problem};
use gaitc_runtime::return_map::{Accuracy, Method};

/// What `--method` takes.
const METHODS: [(&str, Method); 4] = [
    ("auto", Method::Automatic),
    ("explicit", Method::Explicit),
    ("radau5", Method::Radau5),
    ("radau3", Method::Radau3),
];

/// The spec's parameter values with every `--set` applied.
pub(super) fn parameters(loaded: &Loaded, args: &ModelArgs) -> Result<Vec<f64>, InputError> {
    let from = loaded.file.as_ref().map_or("the build".to_owned(), |file| file.display().to_string());
    output::note(&format!("values of {}: from {from}", loaded.spec.name));
    let mut values = loaded.parameters();
    let mut seen = Vec::new();
    for text in &args.set {
        let (name, quantity) = parse_assignment(text).map_err(given("--set", text))?;
        let index = parameter(loaded, "--set", name)?;
        once(&mut seen, "--set", name)?;
        let dimension = loaded.spec.parameters[index].dimension;
        values[index] = parse_quantity(quantity, dimension).map_err(given("--set", text))?;
    }
    Ok(values)
}

/// What is wrong with the text of a flag, with the flag and its whole argument.
pub(super) fn given(flag: &str, argument: &str) -> impl FnOnce(FlagError) -> InputError {
    move |error| error.given_as(flag, argument).into()
}

/// Refuses a name that a flag gives twice: which of the two is meant cannot be known.
pub(super) fn once<'a>(seen: &mut Vec<&'a str>, flag: &str, name: &'a str) -> Result<(), InputError> {
    if seen.contains(&name) {
        return Err(InputError(format!("{flag}: `{name}` is given twice\n  help: keep one of the two")));
    }
    seen.push(name);
    Ok(())
}

/// One sentence for each parameter outside the range that the spec gives for it.
pub(super) fn outside_range(loaded: &Loaded, values: &[f64]) -> Vec<String> {
    let outside = |(p, &value): (&Parameter, &f64)| {
        let (lower, upper) = p.range.filter(|(lower, upper)| !(*lower..=*upper).contains(&value))?;
        let [value, lower, upper] = [value, lower, upper].map(|v| format_quantity(v, &p.unit));
        Some(format!("`{}` = {value} is outside the range that the spec gives for it, {lower} to {upper}", p.name))
    };
    loaded.spec.parameters.iter().zip(values).filter_map(outside).collect()
}

/// One sentence for each range of a problem that leaves the range that the spec gives for its parameter: most often a
/// forgotten unit.
pub(super) fn varies_outside(loaded: &Loaded, problem: &Problem) -> Vec<String> {
    let outside = |(parameter, from, to, verb): (usize, f64, f64, &str)| {
        let p = loaded.spec.parameters.get(parameter)?;
        let (lower, upper) = p.range.filter(|(lower, upper)| {
            let slack = 1e-9 * (upper - lower);
            from < lower - slack || to > upper + slack
        })?;
        let [from, to, lower, upper] = [from, to, lower, upper].map(|v| format_quantity(v, &p.unit));
        Some(format!(
            "`{}` {verb} from {from} to {to}, beyond the range that the spec gives for it, {lower} to {upper}",
            p.name
        ))
    };
    let varied = problem.vary.iter().map(|v| (v.parameter, v.lower, v.upper, "varies"));
    let uncertain = problem.robust.iter().map(|u| (u.parameter, u.lower, u.upper, "is uncertain"));
    varied.chain(uncertain).filter_map(outside).collect()
}

/// The section's start with every `--guess` applied.
pub(super) fn guess(loaded: &Loaded, args: &SearchArgs) -> Result<Vec<f64>, InputError> {
    let mut values = loaded.start();
    for text in &args.guess {
        let (name, quantity) = parse_assignment(text).map_err(given("--guess", text))?;
        let states = &loaded.spec.states;
        let names: Vec<&str> = loaded.coordinates().iter().map(|&i| states[i].name.as_str()).collect();
        let Some(index) = names.iter().position(|n| *n == name) else {
            return Err(unknown("--guess", "section coordinate", name, &names));
        };
        let dimension = states[loaded.coordinates()[index]].dimension;
        values[index] = parse_quantity(quantity, dimension).map_err(given("--guess", text))?;
    }
    Ok(values)
}

/// The default accuracy and method, or those of `--tol` and `--method`.
pub(super) fn accuracy(args: &SearchArgs) -> Result<Accuracy, InputError> {
    let method = args.method.as_deref().map_or(Ok(Method::Automatic), method)?;
    let accuracy = Accuracy { method, ..Accuracy::default() };
    match args.tol {
        None => Ok(accuracy),
        // Below a few units of rounding no step can be accepted.
        Some(tol) if (1e-15..=1e-2).contains(&tol) => {
            Ok(Accuracy { relative: tol, absolute: tol * (accuracy.absolute / accuracy.relative), ..accuracy })
        }
        Some(tol) => Err(InputError(format!("--tol {tol}: give a number from 1e-15 to 1e-2"))),
    }
}

/// Checks a number of maps that make one gait.
pub(super) fn period(period: usize) -> Result<(), InputError> {
    match (1..=LONGEST_PERIOD).contains(&period) {
        true => Ok(()),
        false => Err(InputError(format!("--period {period}: give a number from 1 to {LONGEST_PERIOD}"))),
    }
}

/// The integration method of a name.
fn method(name: &str) -> Result<Method, InputError> {
    let known = METHODS.iter().find(|(known, _)| *known == name);
    known
        .map(|(_, method)| *method)
        .ok_or_else(|| unknown("--method", "method", name, &METHODS.map(|(known, _)| known)))
}

/// The name of an integration method.
pub(super) fn method_name(method: Method) -> &'static str {
    METHODS.iter().find(|(_, known)| *known == method).map_or("auto", |(name, _)| name)
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
