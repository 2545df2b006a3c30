//! `gaitc gait MODEL`: a periodic gait, its stability and its measures.

mod pictures;

use super::args::{Cli, GaitArgs};
use super::guards::{self, Guards};
use super::{InputError, Outcome, inputs, output, provenance};
use crate::load::{Loaded, load};
use gaitc_compiler::front::format_quantity;
use gaitc_runtime::orbit::{Gait, GaitOutcome, GaitRequest, GaitStatus, find_gait};
use gaitc_runtime::return_map::Method;
use serde_json::{Map, Value, json};

/// What a JSON answer says of a gait.
const GAIT_KEYS: [&str; 11] = [
    "section",
    "state",
    "duration",
    "jacobian",
    "multipliers",
    "spectral_radius",
    "stable",
    "measures",
    "events",
    "also_zero",
    "method",
];

/// More segments than this are shorter than the steps of any integration.
const MOST_SEGMENTS: usize = 100;

pub(super) fn run(cli: &Cli, args: &GaitArgs) -> Result<Outcome, InputError> {
    inputs::period(args.period)?;
    if args.segments == 0 || args.segments > MOST_SEGMENTS {
        return Err(InputError(format!("--segments {}: give a number from 1 to {MOST_SEGMENTS}", args.segments)));
    }
    pictures::check(args)?;
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let parameters = inputs::parameters(&loaded, &args.model)?;
    let guess = inputs::guess(&loaded, &args.search)?;
    let memory = loaded.memory();
    let accuracy = inputs::accuracy(&args.search)?;
    let request = GaitRequest::new(&parameters, &memory);
    // A map that is integrated more coarsely is no smoother than its tolerance: nor can its fixed point be.
    let tolerance = request.tolerance.max(10.0 * accuracy.relative);
    let request = GaitRequest { period: args.period, segments: args.segments, accuracy, tolerance, ..request };
    let outcome = find_gait(loaded.compiled, &request, &guess)?;
    let warnings = inputs::outside_range(&loaded, &parameters);
    let report = Report { loaded: &loaded, parameters: &parameters, outcome: &outcome, warnings };
    let provenance = provenance::of(&cli.run, &loaded, &parameters);
    if cli.json {
        output::result(&provenance, report.json());
    } else {
        output::print(&report.text());
    }
    pictures::draw(&report, (args, &request, &guess), &provenance)?;
    let answered = outcome.status == GaitStatus::Converged && !outcome.gait.as_ref().is_some_and(unmeasured);
    Ok(if answered { Outcome::Done } else { Outcome::Without })
}

/// Whether no measure has a value: the run with measures came to no end. Warnings then say so.
fn unmeasured(gait: &Gait) -> bool {
    !gait.map.measures.is_empty() && gait.map.measures.iter().all(|m| m.is_nan())
}

struct Report<'a> {
    loaded: &'a Loaded,
    parameters: &'a [f64],
    outcome: &'a GaitOutcome,
    /// What the user should know of the input.
    warnings: Vec<String>,
}

impl Report<'_> {
    /// The gait only where there is one: the last point of a failed search is no result.
    fn gait(&self) -> Option<&Gait> {
        self.outcome.gait.as_ref().filter(|_| self.outcome.status == GaitStatus::Converged)
    }

    fn coordinate_names(&self) -> Vec<&str> {
        let states = &self.loaded.spec.states;
        self.loaded.coordinates().iter().map(|&i| states[i].name.as_str()).collect()
    }

    fn json(&self) -> Value {
        let spec = &self.loaded.spec;
        let names = spec.parameters.iter().map(|p| p.name.as_str());
        let mut all = json!({
            "model": spec.name,
            "status": self.outcome.status.name(),
            "message": self.outcome.message,
            "parameters": named(names, self.parameters),
            "residual": self.outcome.residual,
            "warnings": self.all_warnings(),
        });
        // Without a gait the keys are there all the same, so that scripts need not ask.
        let keys = || GAIT_KEYS.iter().map(|key| ((*key).to_owned(), Value::Null)).collect();
        if let Some(all) = all.as_object_mut() {
            all.extend(self.gait().map_or_else(keys, |gait| self.gait_json(gait)));
        }
        if let (Some(all), GaitStatus::Stopped(stop)) = (all.as_object_mut(), &self.outcome.status) {
            let state = named(spec.states.iter().map(|s| s.name.as_str()), &stop.state);
            all.insert("stopped".to_owned(), json!({ "time": stop.time, "state": state }));
        }
        all
    }

    fn gait_json(&self, gait: &Gait) -> Map<String, Value> {
        let (spec, map) = (&self.loaded.spec, &gait.map);
        let states = spec.states.iter().map(|s| s.name.as_str());
        let guards = Guards { spec, map };
        let rows: Vec<Vec<f64>> = map.jacobian.row_iter().map(|row| row.iter().copied().collect()).collect();
        let mut all = Map::new();
        let measures = spec.measures.iter().map(|m| m.name.as_str());
        for (key, value) in [
            ("section", named(self.coordinate_names().into_iter(), gait.coordinates.as_slice())),
            ("state", named(states, map.state.as_slice())),
            ("duration", json!(map.duration)),
            ("jacobian", json!(rows)),
            ("multipliers", json!(gait.multipliers.iter().map(|m| [m.re, m.im]).collect::<Vec<_>>())),
            ("spectral_radius", json!(gait.spectral_radius)),
            ("stable", json!(gait.spectral_radius < 1.0)),
            ("measures", named(measures, map.measures.as_slice())),
            ("events", guards.events_json()),
            ("also_zero", guards.also_zero_json()),
            ("method", json!(inputs::method_name(map.method))),
        ] {
            all.insert(key.to_owned(), value);
        }
        all
    }

    /// Of the input, of the linearisation, and of measures that are no numbers.
    fn all_warnings(&self) -> Vec<String> {
        let mut all = self.warnings.clone();
        all.extend(self.gait().into_iter().flat_map(|gait| guards::of_gait(&self.loaded.spec, gait)));
        all
    }

    fn text(&self) -> String {
        let spec = &self.loaded.spec;
        let mut text = format!("{} · gait\n{}: {}\n", spec.name, self.outcome.status.name(), self.outcome.message);
        for warning in self.all_warnings() {
            text += &format!("warning: {warning}\n");
        }
        let Some(gait) = self.gait() else {
            return text
                + "help: try another start (--guess COORD=QUANTITY) or other parameters (--set NAME=QUANTITY)\n";
        };
        let coordinates = self.loaded.coordinates().iter().zip(gait.coordinates.iter());
        let mut rows: Vec<Vec<String>> = coordinates
            .map(|(&i, &value)| vec![spec.states[i].name.clone(), format_quantity(value, &spec.states[i].unit)])
            .collect();
        rows.push(vec!["duration".to_owned(), format_quantity(gait.map.duration, "s")]);
        let measures = spec.measures.iter().zip(gait.map.measures.iter());
        rows.extend(measures.map(|(m, &value)| vec![m.name.clone(), format_quantity(value, &m.unit)]));
        text += &format!("\n{}{}", output::table(&["gait", "value"], rows), output::measures_hint(spec));
        text += &format!("\n{}", Guards { spec, map: &gait.map }.table());
        text + &stability(gait) + &integration(gait.map.method)
    }
}

fn stability(gait: &Gait) -> String {
    if gait.multipliers.is_empty() {
        return "\nthe section has no coordinates: every step is the same, there are no multipliers\n".to_owned();
    }
    let verdict = if gait.spectral_radius < 1.0 { "stable" } else { "not stable" };
    let row = |m: &nalgebra::Complex<f64>| {
        let value = if m.im == 0.0 { format!("{:.6}", m.re) } else { format!("{:.6} {:+.6} i", m.re, m.im) };
        vec![value, format!("{:.6}", m.norm())]
    };
    let table = output::table(&["multiplier", "magnitude"], gait.multipliers.iter().map(row));
    format!("\n{table}\n{verdict}: spectral radius {:.6}\n", gait.spectral_radius)
}

/// How it was integrated, unless by the explicit method, which is the rule.
fn integration(method: Method) -> String {
    let stages = match method {
        Method::Radau5 => 5,
        Method::Radau3 => 3,
        Method::Automatic | Method::Explicit => return String::new(),
    };
    format!("integrated with {} (implicit, Radau IIA with {stages} stages)\n", inputs::method_name(method))
}

pub(super) fn named<'a>(names: impl Iterator<Item = &'a str>, values: &[f64]) -> Value {
    Value::Object(names.zip(values).map(|(name, v)| (name.to_owned(), json!(v))).collect())
}
