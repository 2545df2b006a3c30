//! What a study's outputs say of where they come from.

use super::columns::si_unit;
use crate::load::Loaded;
use crate::provenance::Provenance;
use serde_json::{Value, json};
use toml::Table;

/// Provenance of a run of `command`, with every parameter and every first guess written out, and its flags.
pub(super) fn provenance(
    loaded: &Loaded,
    command: &str,
    (parameters, guess): (&[f64], &[f64]),
    flags: Vec<(&str, toml::Value)>,
) -> Provenance {
    let info = loaded.compiled.info();
    let quantity = |value: f64, si: &str| match si {
        "1" => format!("{value:?}"),
        si => format!("{value:?} {si}"),
    };
    let mut set = Table::new();
    for ((p, known), value) in loaded.spec.parameters.iter().zip(info.parameters).zip(parameters) {
        set.insert(p.name.clone(), quantity(*value, si_unit(known.si, &p.unit)).into());
    }
    let mut first = Table::new();
    for (&i, value) in loaded.coordinates().iter().zip(guess) {
        let state = &loaded.spec.states[i];
        first.insert(state.name.clone(), quantity(*value, si_unit(info.states[i].si, &state.unit)).into());
    }
    let mut run = Table::new();
    run.insert("command".to_owned(), command.into());
    run.insert("model".to_owned(), loaded.spec.name.clone().into());
    run.insert("set".to_owned(), set.into());
    run.insert("guess".to_owned(), first.into());
    run.extend(flags.into_iter().map(|(name, value)| (name.to_owned(), value)));
    Provenance { model: info.name.to_owned(), fingerprint: info.fingerprint.to_owned(), run }
}

/// A flag that may be given several times.
pub(super) fn list(values: &[String]) -> toml::Value {
    toml::Value::Array(values.iter().map(|value| value.clone().into()).collect())
}

/// A count, as far as TOML has it.
pub(super) fn count(value: u64) -> toml::Value {
    i64::try_from(value).map_or_else(|_| value.to_string().into(), toml::Value::from)
}

/// Of a problem what its name does not say: specs change.
pub(super) fn problem(problem: &gaitc_compiler::ir::Problem) -> Value {
    let vary = |v: &gaitc_compiler::ir::Vary| json!([v.parameter, v.lower, v.upper]);
    json!({
        "objective": problem.objective_text,
        "sense": format!("{:?}", problem.sense),
        "vary": problem.vary.iter().map(vary).collect::<Vec<_>>(),
        "subject_to": problem.constraints.iter().map(|c| c.text.clone()).collect::<Vec<_>>(),
        "period": problem.period,
    })
}
