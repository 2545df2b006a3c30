//! Where a run starts: `--from`, `--state`, `--mode`, `--tau`, `--memory`, `--gait`.

use super::SimulateArgs;
use crate::cli::{InputError, inputs};
use crate::load::Loaded;
use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::{parse_assignment, parse_quantity};
use gaitc_compiler::ir::Mode;
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::Accuracy;
use gaitc_runtime::trajectory;

/// Whole numbers up to here are exact as numbers with a point.
const LARGEST_COUNT: i64 = 1 << 53;

/// A start, with its values.
pub(super) enum Start {
    /// On the section.
    Section(Vec<f64>),
    /// Anywhere in a mode.
    State { mode: usize, state: Vec<f64>, tau: f64 },
}

impl Start {
    /// As the runtime takes it.
    pub(super) fn borrowed(&self) -> trajectory::Start<'_> {
        match self {
            Self::Section(coordinates) => trajectory::Start::Section(coordinates),
            Self::State { mode, state, tau } => trajectory::Start::State { mode: *mode, state, tau: *tau },
        }
    }
}

/// The start that the flags ask for; a message where they ask for a gait and there is none.
pub(super) fn of(
    loaded: &Loaded,
    args: &SimulateArgs,
    parameters: &[f64],
    accuracy: Accuracy,
) -> Result<Result<Start, String>, InputError> {
    if !args.gait && !args.search.guess.is_empty() {
        return Err(InputError(
            "--guess: this is where the search of --gait begins\n  help: add --gait, or start there (--from)"
                .to_owned(),
        ));
    }
    if args.gait {
        return gait(loaded, args, parameters, accuracy);
    }
    if !args.state.is_empty() {
        return state(loaded, args).map(Ok);
    }
    if loaded.spec.section.is_none() {
        return Err(InputError(format!(
            "model `{}` has no [section] to start on\n  help: start in a state (--state NAME=QUANTITY for each state)",
            loaded.spec.name
        )));
    }
    let mut values = loaded.start();
    let (mut seen, states) = (Vec::new(), &loaded.spec.states);
    let names: Vec<&str> = loaded.coordinates().iter().map(|&i| states[i].name.as_str()).collect();
    for text in &args.from {
        let (name, quantity) = parse_assignment(text).map_err(inputs::given("--from", text))?;
        let Some(index) = names.iter().position(|n| *n == name) else {
            return Err(inputs::unknown("--from", "section coordinate", name, &names));
        };
        inputs::once(&mut seen, "--from", name)?;
        values[index] = parse_quantity(quantity, states[loaded.coordinates()[index]].dimension)
            .map_err(inputs::given("--from", text))?;
    }
    Ok(Ok(Start::Section(values)))
}

/// Memory at the start.
pub(super) fn memory(loaded: &Loaded, given: &[String]) -> Result<Vec<f64>, InputError> {
    let mut values = loaded.memory();
    let mut seen = Vec::new();
    let names: Vec<&str> = loaded.spec.memory.iter().map(|m| m.name.as_str()).collect();
    for text in given {
        let (name, number) = parse_assignment(text).map_err(inputs::given("--memory", text))?;
        let Some(index) = names.iter().position(|n| *n == name) else {
            return Err(inputs::unknown("--memory", "memory", name, &names));
        };
        inputs::once(&mut seen, "--memory", name)?;
        let count = number.trim().parse::<i64>().ok().filter(|n| (-LARGEST_COUNT..=LARGEST_COUNT).contains(n));
        let Some(count) = count else {
            return Err(InputError(format!("--memory {text}: memory is a whole number, e.g. --memory {name}=1")));
        };
        values[index] = count as f64;
    }
    Ok(values)
}

fn gait(
    loaded: &Loaded,
    args: &SimulateArgs,
    parameters: &[f64],
    accuracy: Accuracy,
) -> Result<Result<Start, String>, InputError> {
    if !args.memory.is_empty() {
        return Err(InputError(
            "--memory: a gait starts with the memory of the spec\n  help: leave one of --memory and --gait out"
                .to_owned(),
        ));
    }
    let (guess, memory) = (inputs::guess(loaded, &args.search)?, loaded.memory());
    let request = GaitRequest::new(parameters, &memory);
    let tolerance = request.tolerance.max(10.0 * accuracy.relative);
    let outcome = find_gait(loaded.compiled, &GaitRequest { accuracy, tolerance, ..request }, &guess)?;
    Ok(match outcome.gait.filter(|_| outcome.status == GaitStatus::Converged) {
        Some(gait) => Ok(Start::Section(gait.coordinates.as_slice().to_vec())),
        None => Err(outcome.message),
    })
}

fn state(loaded: &Loaded, args: &SimulateArgs) -> Result<Start, InputError> {
    let spec = &loaded.spec;
    let mode = mode(loaded, args.mode.as_deref())?;
    let no_mode = || InputError(format!("model `{}` has no modes", spec.name));
    let Mode { name: in_mode, has_state, .. } = spec.modes.get(mode).ok_or_else(no_mode)?;
    let has = |i: usize| has_state.get(i).copied().unwrap_or(true);
    let names: Vec<&str> =
        spec.states.iter().enumerate().filter(|(i, _)| has(*i)).map(|(_, s)| s.name.as_str()).collect();
    let (mut values, mut seen) = (vec![0.0; spec.states.len()], Vec::new());
    for text in &args.state {
        let (name, quantity) = parse_assignment(text).map_err(inputs::given("--state", text))?;
        let Some(index) = spec.states.iter().position(|s| s.name == name) else {
            return Err(inputs::unknown("--state", "state", name, &names));
        };
        if !has(index) {
            let help =
                format!("leave it out, or start in another mode (--mode); states of `{in_mode}`: {}", names.join(", "));
            return Err(InputError(format!("--state: mode `{in_mode}` has no state `{name}`\n  help: {help}")));
        }
        inputs::once(&mut seen, "--state", name)?;
        values[index] =
            parse_quantity(quantity, spec.states[index].dimension).map_err(inputs::given("--state", text))?;
    }
    let missing: Vec<&str> = names.iter().copied().filter(|name| !seen.contains(name)).collect();
    if !missing.is_empty() {
        let (all, first) = (missing.join("`, `"), missing.first().copied().unwrap_or_default());
        return Err(InputError(format!(
            "--state: `{all}` missing, a start in mode `{in_mode}` needs all its states\n  help: add --state '{first}=...', or start \
             on the section (--from)"
        )));
    }
    let tau = match &args.tau {
        None => 0.0,
        Some(text) => parse_quantity(text, Dimension::TIME).map_err(inputs::given("--tau", text))?,
    };
    if tau < 0.0 {
        return Err(InputError(
            "--tau: the time since the last transition is not negative, e.g. --tau 20ms".to_owned(),
        ));
    }
    Ok(Start::State { mode, state: values, tau })
}

/// The mode that is named, or the one in which a step begins, or the only one.
fn mode(loaded: &Loaded, name: Option<&str>) -> Result<usize, InputError> {
    let spec = &loaded.spec;
    let names: Vec<&str> = spec.modes.iter().map(|m| m.name.as_str()).collect();
    match name {
        Some(name) => {
            names.iter().position(|n| *n == name).ok_or_else(|| inputs::unknown("--mode", "mode", name, &names))
        }
        None if names.len() == 1 => Ok(0),
        None => spec.section.as_ref().and_then(|section| section.mode(&spec.transitions)).ok_or_else(|| {
            InputError(format!("--state: say in which mode\n  help: add --mode with one of: {}", names.join(", ")))
        }),
    }
}
