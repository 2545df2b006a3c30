//! `gaitc report MODEL`: one HTML page with everything there is to say of a model.

use super::args::{Cli, ModelArgs, SearchArgs};
use super::{InputError, Outcome, guards, inputs, output, provenance, show};
use crate::files;
use crate::load::{Loaded, load};
use crate::report::{Study, contents, page};
use clap::Args;
use gaitc_compiler::show::Sheet;
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use serde_json::json;
use std::path::{Path, PathBuf};

/// More steps than this are no animation but a film.
const MOST_STEPS: usize = 200;

#[derive(Debug, Args)]
#[command(
    after_help = "The page opens offline in any browser. FILE.html#t=0.5 opens it with the machine at 0.5 s.\n\nExamples:\n  \
                  gaitc report prescribed_length\n  gaitc report self_exciting --set 'psi=25 deg' --out climber.html"
)]
pub(crate) struct ReportArgs {
    #[command(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    search: SearchArgs,
    /// Number of steps in the animation
    #[arg(long, default_value_t = 8, value_name = "N")]
    steps: usize,
    /// Where to write the page [default: MODEL.html]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub(super) fn run(cli: &Cli, args: &ReportArgs) -> Result<Outcome, InputError> {
    if args.steps == 0 || args.steps > MOST_STEPS {
        return Err(InputError(format!("--steps {}: give a number from 1 to {MOST_STEPS}", args.steps)));
    }
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{}.html", loaded.spec.name)));
    check(&out)?;
    let parsed = show::find(&args.model.model, cli.specs.as_deref())?;
    let Some(sheet) = Sheet::new(&parsed) else {
        return Err(InputError(format!("the spec of `{}` has errors\n  help: gaitc check", args.model.model)));
    };
    let parameters = inputs::parameters(&loaded, &args.model)?;
    let (guess, memory) = (inputs::guess(&loaded, &args.search)?, loaded.memory());
    let accuracy = inputs::accuracy(&args.search)?;
    let request = GaitRequest::new(&parameters, &memory);
    let tolerance = request.tolerance.max(10.0 * accuracy.relative);
    let request = loaded.spec.section.is_some().then_some(GaitRequest { accuracy, tolerance, ..request });
    let outcome = request.as_ref().map(|request| find_gait(loaded.compiled, request, &guess)).transpose()?;
    let gait = outcome.as_ref().filter(|outcome| outcome.status == GaitStatus::Converged);
    let gait = gait.and_then(|outcome| outcome.gait.as_ref());
    let mut warnings = inputs::outside_range(&loaded, &parameters);
    warnings.extend(gait.into_iter().flat_map(|gait| guards::of_gait(&loaded.spec, gait)));
    let study = Study {
        loaded: &loaded,
        sheet: &sheet,
        parameters: &parameters,
        request,
        guess: &guess,
        outcome: outcome.as_ref(),
        steps: args.steps,
        warnings,
    };
    let made = provenance::of(&cli.run, &loaded, &parameters);
    let text = page(&contents(&study, made.clone(), command(&loaded, &parameters, args))?);
    files::write(&out, text.as_bytes())?;
    let converged = outcome.as_ref().map(|outcome| outcome.status == GaitStatus::Converged);
    if cli.json {
        let report = json!({ "model": loaded.spec.name, "file": out.display().to_string(), "gait": converged });
        output::result(&made, report);
    } else {
        let without = outcome.as_ref().filter(|outcome| outcome.status != GaitStatus::Converged);
        let without = without.map_or_else(String::new, |outcome| format!("no gait: {}\n", outcome.message));
        output::print(&format!("{}: written\n{without}", out.display()));
    }
    // A page without a gait is what was asked for where the model can have none.
    Ok(if converged == Some(false) { Outcome::Without } else { Outcome::Done })
}

/// Refuses a file that cannot be written, or is no page by its name: before the work begins.
fn check(out: &Path) -> Result<(), InputError> {
    let page =
        out.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("html") || ending.eq_ignore_ascii_case("htm"));
    if !page && !std::fs::metadata(out).is_ok_and(|known| !known.is_file() && !known.is_dir()) {
        return Err(InputError(format!(
            "--out {}: a report is an HTML page\n  help: end the name in `.html`",
            out.display()
        )));
    }
    Ok(files::try_place(out)?)
}

/// The command line that makes the page again, without the file's name.
fn command(loaded: &Loaded, parameters: &[f64], args: &ReportArgs) -> String {
    let mut words = vec!["gaitc report".to_owned(), loaded.spec.name.clone()];
    let quoted = |text: &String| format!("'{}'", text.replace('\'', "'\\''"));
    // However they were given: so a page that is made from a page is the same.
    let set = loaded.spec.parameters.iter().zip(parameters).filter(|(p, value)| p.value.to_bits() != value.to_bits());
    let set = set.map(|(p, &value)| format!("{}={}", p.name, provenance::exactly(p, value)));
    words.extend(set.map(|text| format!("--set {}", quoted(&text))));
    words.extend(args.search.guess.iter().map(|text| format!("--guess {}", quoted(text))));
    words.extend(args.search.tol.map(|tol| format!("--tol {tol:e}")));
    words.extend(args.search.method.as_ref().map(|method| format!("--method {}", quoted(method))));
    if args.steps != 8 {
        words.push(format!("--steps {}", args.steps));
    }
    words.join(" ")
}
