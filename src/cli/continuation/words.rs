//! What bifurcations and ends of branches mean, and what to do about them, in words.

use super::Report;
use gaitc_compiler::front::{format_number, format_quantity, in_unit};
use gaitc_runtime::orbit::why;
use gaitc_runtime::study::continuation::{Bifurcation, Branch, Criticality, Diagram, EndReason, Kind, Side};

/// Significant digits of the parameter's values.
const DIGITS: i32 = 6;

/// A value of the parameter that is followed, with more digits than other quantities have: it is what the study is about.
pub(super) fn value(report: &Report<'_>, si: f64) -> String {
    let unit = &report.parameter().unit;
    let number = in_unit(si, unit);
    let size = number.abs().max(1e-300).log10().floor();
    // Values near zero are as exact as the range, not relative to themselves.
    let (lower, upper) = report.range;
    let span = in_unit(upper, unit) - in_unit(lower, unit);
    let size = (size as i32).max(span.abs().log10().floor() as i32 - 1);
    let decimals = (DIGITS - 1 - size).max(0) as usize;
    let text = if decimals > 12 { format_number(number) } else { format!("{number:.decimals$}") };
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let text = if text == "-0" { "0" } else { text };
    match unit.as_str() {
        "" | "1" => text.to_owned(),
        "%" | "°" => format!("{text}{unit}"),
        unit => format!("{text} {unit}"),
    }
}

pub(super) fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Fold => "fold",
        Kind::Branch => "branch point",
        Kind::Flip => "flip",
        Kind::NeimarkSacker => "Neimark-Sacker",
    }
}

/// What happens at a bifurcation.
pub(super) fn meaning(report: &Report<'_>, branch: &Branch, bifurcation: &Bifurcation) -> String {
    match bifurcation.kind {
        Kind::Fold => {
            let at = bifurcation.point.value;
            let before = branch.points.get(bifurcation.after).map_or(at, |point| point.value);
            let side = if before < at { "larger" } else { "smaller" };
            format!("the branch turns round: it has no gait at {side} {}", report.parameter().name)
        }
        Kind::Branch => match bifurcation.criticality {
            Some(Criticality::Supercritical) => {
                "a pair of gaits branches off to where the multiplier is beyond 1 (supercritical pitchfork)".to_owned()
            }
            Some(Criticality::Subcritical) => {
                "a pair of gaits, not stable, branches off to where the multiplier is not yet 1 (subcritical pitchfork)"
                    .to_owned()
            }
            Some(Criticality::Transcritical) => {
                "another branch of gaits crosses, whose multiplier goes through 1 the other way (transcritical)"
                    .to_owned()
            }
            None => "another branch of gaits crosses".to_owned(),
        },
        Kind::Flip => {
            let twice = 2 * branch.period;
            match bifurcation.criticality {
                Some(Criticality::Supercritical) => {
                    format!("gaits of {twice} maps branch off to where the multiplier is beyond -1 (supercritical)")
                }
                Some(Criticality::Subcritical) => {
                    format!(
                        "gaits of {twice} maps, not stable, branch off to where the multiplier is not yet -1 (subcritical)"
                    )
                }
                Some(Criticality::Transcritical) | None => format!("gaits of {twice} maps branch off"),
            }
        }
        Kind::NeimarkSacker => {
            let pair = bifurcation.point.multipliers.iter().filter(|m| m.im > 0.0);
            let pair = pair.min_by(|a, b| (a.norm() - 1.0).abs().total_cmp(&(b.norm() - 1.0).abs()));
            let maps = pair.map_or(0.0, |m| std::f64::consts::TAU / m.arg());
            let beyond = match bifurcation.criticality {
                Some(Criticality::Supercritical) => "; where they grow they settle on a lasting swing (supercritical)",
                Some(Criticality::Subcritical) => "; where they die out those beyond some size grow (subcritical)",
                Some(Criticality::Transcritical) | None => "",
            };
            format!(
                "a complex pair crosses the unit circle: disturbances swing with a period of {} maps{beyond}",
                format_number(maps)
            )
        }
    }
}

/// Why a branch ends, and what to do where something can be done.
pub(super) fn end(
    report: &Report<'_>,
    diagram: &Diagram,
    branch: &Branch,
    reason: &EndReason,
) -> (String, Option<String>) {
    let (model, name) = (&report.loaded.spec.name, &report.parameter().name);
    // An end is that of the last point, but for the way back from the start.
    let points = if std::ptr::eq(reason, &branch.ends[0]) { branch.points.first() } else { branch.points.last() };
    let (at, duration) = points.map_or((f64::NAN, f64::NAN), |point| (point.value, point.duration));
    let last = format!("gaitc gait {model} --set '{name}={}'", value(report, at));
    match reason {
        EndReason::RangeEnd(Side::Lower) => ("the lower end of the range".to_owned(), None),
        EndReason::RangeEnd(Side::Upper) => ("the upper end of the range".to_owned(), None),
        EndReason::Closed => ("the branch is a closed loop".to_owned(), None),
        EndReason::MapStops(stop) => (
            format!(
                "beyond it the map does not come back: {} (the last gait takes {})",
                why(stop.reason),
                format_quantity(duration, "s")
            ),
            Some(format!("look at the last gait and its guards: {last}")),
        ),
        EndReason::NotClosed(open) => (open.describe(report.loaded.compiled.info()), None),
        EndReason::StepTooSmall => (
            format!(
                "beyond it no gait is found however short the step: most often a guard is only grazed there, or events change their \
                 order (the last gait takes {})",
                format_quantity(duration, "s")
            ),
            Some(format!("look at the last gait and its guards: {last}; start again beyond with --from")),
        ),
        EndReason::Unbounded => ("the section's coordinates grow beyond all bounds".to_owned(), None),
        EndReason::PointLimit => (
            format!("the limit of {} points", report.args.points),
            Some("raise --points, or take longer steps with --step".to_owned()),
        ),
        EndReason::PeriodHalved => {
            (format!("it has come back to the gaits of {} maps", branch.period / 2), None)
        }
        EndReason::Parent => (
            branch.parent.map_or_else(String::new, |parent| {
                let kind = diagram
                    .branches
                    .get(parent.branch)
                    .and_then(|branch| branch.bifurcations.get(parent.bifurcation))
                    .map_or("bifurcation", |b| kind(b.kind));
                format!("the {kind} of branch {}", parent.branch + 1)
            }),
            None,
        ),
        EndReason::NoDirection => (
            "the start is a branch point itself, or one of many gaits at this value (a multiplier is 1): there is no direction to go"
                .to_owned(),
            Some("start elsewhere with --from; where a quantity is conserved, make it a parameter of the section".to_owned()),
        ),
        EndReason::Interrupted => ("interrupted".to_owned(), None),
    }
}
