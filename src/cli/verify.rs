//! `gaitc verify MODEL`: correct digits of every generated derivative, and the health of the guards.

use super::args::{Cli, VerifyArgs};
use super::guards::Guards;
use super::{InputError, Outcome, output, provenance};
use crate::load::{Loaded, load};
use crate::verify::{Checked, verify};
use gaitc_runtime::orbit::{Gait, GaitRequest, GaitStatus, find_gait};
use serde_json::json;

/// Fewer correct digits than this are a defect of the generated code.
const ENOUGH: f64 = 12.0;

/// More points than this make nothing surer.
const MOST_SAMPLES: usize = 20_000;

pub(super) fn run(cli: &Cli, args: &VerifyArgs) -> Result<Outcome, InputError> {
    if args.samples == 0 || args.samples > MOST_SAMPLES {
        return Err(InputError(format!("--samples {}: give a number from 1 to {MOST_SAMPLES}", args.samples)));
    }
    let loaded = load(&args.model, cli.specs.as_deref())?;
    let checked = verify(&loaded, args.samples, args.seed);
    let worst = checked.iter().map(|c| c.digits).fold(f64::INFINITY, f64::min);
    let gait = default_gait(&loaded);
    if cli.json {
        let guards = gait.as_ref().ok().map(|gait| Guards { spec: &loaded.spec, map: &gait.map });
        let one = |c: &Checked| {
            json!({
                "function": c.function,
                "with_respect_to": c.with_respect_to,
                "digits": c.digits,
                "samples": c.samples,
            })
        };
        let answer = json!({
            "model": args.model,
            "derivatives": checked.iter().map(one).collect::<Vec<_>>(),
            "guards": guards.as_ref().map(Guards::events_json),
            "also_zero": guards.as_ref().map(Guards::also_zero_json),
            "no_gait": gait.as_ref().err(),
        });
        output::result(&provenance::of(&cli.run, &loaded, &loaded.parameters()), answer);
    } else {
        let row = |c: &Checked| {
            let digits = format!("{:.1}", c.digits);
            vec![c.function.clone(), c.with_respect_to.to_owned(), digits, c.samples.to_string()]
        };
        output::print(&output::table(&["function", "with respect to", "digits", "points"], checked.iter().map(row)));
        output::print(&format!(
            "\nworst: {worst:.1} digits; the reference evaluates the spec with nilpotent numbers, without CasADi\n"
        ));
        output::print(&match &gait {
            Ok(gait) => format!(
                "\n{}\nof the gait with the spec's parameters\n",
                Guards { spec: &loaded.spec, map: &gait.map }.table()
            ),
            Err(reason) => format!("\nguards are not looked at without a gait: {reason}\n"),
        });
    }
    Ok(if worst >= ENOUGH { Outcome::Done } else { Outcome::Without })
}

/// The gait that the spec's own values give, or why there is none: that is no defect of the generated code.
fn default_gait(loaded: &Loaded) -> Result<Gait, String> {
    let (parameters, memory) = (loaded.parameters(), loaded.memory());
    let request = GaitRequest::new(&parameters, &memory);
    let outcome = find_gait(loaded.compiled, &request, &loaded.start()).map_err(|error| error.to_string())?;
    let gait = outcome.gait.filter(|_| outcome.status == GaitStatus::Converged);
    gait.ok_or(outcome.message)
}
