//! `gaitc verify MODEL`: correct digits of every generated derivative.

use super::args::{Cli, VerifyArgs};
use super::{InputError, Outcome, output};
use crate::load::load;
use crate::verify::{Checked, verify};
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
    if cli.json {
        let one = |c: &Checked| {
            json!({
                "function": c.function,
                "with_respect_to": c.with_respect_to,
                "digits": c.digits,
                "samples": c.samples,
            })
        };
        output::json(&json!({
            "model": args.model,
            "derivatives": checked.iter().map(one).collect::<Vec<_>>(),
        }));
    } else {
        let row = |c: &Checked| {
            let digits = format!("{:.1}", c.digits);
            vec![c.function.clone(), c.with_respect_to.to_owned(), digits, c.samples.to_string()]
        };
        output::print(&output::table(&["function", "with respect to", "digits", "points"], checked.iter().map(row)));
        output::print(&format!(
            "\nworst: {worst:.1} digits; the reference evaluates the spec with nilpotent numbers, without CasADi\n"
        ));
    }
    Ok(if worst >= ENOUGH { Outcome::Done } else { Outcome::Without })
}
