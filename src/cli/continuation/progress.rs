//! How far a continuation has come, on stderr.

use super::ContinueArgs;
use crate::cli::output;
use crate::progress::Progress;
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::Parameter;
use gaitc_runtime::study::continuation::Observer;

/// Shows how many gaits have been found, and where the last one is. How many there can be is known of a single branch only: twice
/// `--points`.
pub(super) fn observer(args: &ContinueArgs, parameter: &Parameter) -> Observer {
    let single = args.doublings == 0 && !args.branches;
    let most = u64::try_from(args.points).ok().filter(|_| single).map(|points| 2 * points);
    let progress = Progress::up_to(most, "gait", output::is_quiet());
    let (name, unit) = (parameter.name.clone(), parameter.unit.clone());
    Observer::new(move |value| progress.reach(&format!("{name} = {}", format_quantity(value, &unit))))
}
