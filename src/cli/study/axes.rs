//! From `--over` and `--sobol` to a set of points.

use crate::cli::InputError;
use gaitc_compiler::front::flags::Values;
use gaitc_runtime::study::{Axis, Design};

/// The grid of some quantities, by name.
pub(super) fn grid(over: &[(&str, Values)]) -> Result<Design, InputError> {
    let axes: Result<Vec<Axis>, InputError> = over.iter().map(|(name, values)| axis(name, values)).collect();
    axes.map(Design::Grid)
}

fn axis(name: &str, values: &Values) -> Result<Axis, InputError> {
    match values {
        Values::List(values) => Ok(Axis::List(values.clone())),
        Values::Range { count: None, .. } => Err(InputError(format!(
            "--over {name}: how many values?\n  help: write the number behind the range, as in `--over '{name}=1..2 m:11'`"
        ))),
        Values::Range { lower, upper, count: Some(1) } if lower < upper => Err(InputError(format!(
            "--over {name}: one value cannot cover a range\n  help: write at least 2 behind `:`, or one value in place of the range"
        ))),
        Values::Range { lower, upper, count: Some(count) } if lower == upper && *count > 1 => Err(InputError(format!(
            "--over {name}: both ends of the range are the same, so all {count} values would be\n  help: write another bound, or \
             one value in place of the range"
        ))),
        Values::Range { lower, upper, count: Some(count) } => {
            Ok(Axis::Range { lower: *lower, upper: *upper, count: *count })
        }
    }
}

/// So many points in a box.
pub(super) fn sobol(over: &[(&str, Values)], count: u64, seed: u64) -> Result<Design, InputError> {
    if count == 0 {
        return Err(InputError("--sobol 0: give a number of points from 1".to_owned()));
    }
    let bounds = over.iter().map(|(name, values)| match values {
        Values::Range { lower, upper, count: None } if lower < upper => Ok((*lower, *upper)),
        Values::Range { count: Some(_), .. } => Err(InputError(format!(
            "--over {name}: with --sobol the number of points is that of --sobol\n  help: leave away what stands behind `:`"
        ))),
        _ => Err(InputError(format!(
            "--over {name}: --sobol needs a range\n  help: write `{name}=LO..HI` with LO below HI, or hold it fixed with --set"
        ))),
    });
    Ok(Design::Sobol { bounds: bounds.collect::<Result<_, _>>()?, count, seed })
}

/// How the number of points comes about, for messages.
pub(super) fn arithmetic(design: &Design) -> String {
    match design {
        Design::Grid(axes) => {
            let factors: Vec<String> = axes.iter().map(|axis| axis.len().to_string()).collect();
            factors.join(" x ")
        }
        Design::Sobol { count, .. } => count.to_string(),
    }
}
