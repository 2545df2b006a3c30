//! What makes an optimum trustworthy, in words and as JSON: the second-order condition and the confirmation.

use gaitc_compiler::front::format_number;
use gaitc_compiler::ir::{Model, Problem, Sense};
use gaitc_runtime::optimize::{Confirmation, Curvature, Disturbed, Independent, Shape, Solution, Status};
use serde_json::{Value, json};

/// The second-order condition as JSON.
pub(super) fn second_order_json(spec: &Model, curvature: &Curvature) -> Value {
    json!({
        "shape": match curvature.shape {
            Shape::Vertex => "vertex",
            Shape::Strict => "strict",
            Shape::Flat => "flat",
            Shape::Saddle => "saddle",
            Shape::Undecided => "undecided",
        },
        "constraints": curvature.constraints,
        "without_price": curvature.weak,
        "directions": curvature.directions,
        "smallest_eigenvalue": curvature.smallest,
        "error": curvature.error,
        "along": curvature.along.iter().map(|p| &spec.parameters[*p].name).collect::<Vec<_>>(),
    })
}

/// The confirmation as JSON.
pub(super) fn confirmation_json(confirmation: &Confirmation) -> Value {
    json!({
        "residual": confirmation.residual,
        "measures": confirmation.measures,
        "linearisation": confirmation.linearisation,
        "maps": confirmation.maps,
        "remaining": confirmation.remaining,
        "disturbed": confirmation.disturbed.as_ref().map(disturbed_json),
        "independent": confirmation.independent.as_ref().map(independent_json),
    })
}

fn disturbed_json(disturbed: &Disturbed) -> Value {
    match *disturbed {
        Disturbed::Stays { maps, level, nonlinear, spread, sampling, memory } => json!({
            "outcome": "stays",
            "maps": maps,
            "level": level,
            "nonlinear": nonlinear,
            "spread": spread,
            "sampling": sampling,
            "memory": memory,
        }),
        Disturbed::Grows { maps, grown, expected } => {
            json!({ "outcome": "grows", "maps": maps, "grown": grown, "expected": expected })
        }
    }
}

fn independent_json(independent: &Independent) -> Value {
    json!({
        "route": independent.route.words(),
        "map": independent.image,
        "jacobian": independent.jacobian,
        "multipliers": independent.multipliers,
        "uncertainty": independent.uncertainty,
    })
}

/// One line on the second-order condition, one on the confirmation; nothing where there is neither.
pub(super) fn lines(spec: &Model, problem: &Problem, solution: &Solution) -> String {
    let second_order = solution.curvature.as_ref().map(|curvature| second_order(spec, problem, curvature));
    let confirmation = solution.confirmation.as_ref().filter(|_| solution.status == Status::Optimal).map(confirmed);
    let lines: Vec<String> = second_order.into_iter().chain(confirmation).map(|line| format!("{line}\n")).collect();
    if lines.is_empty() { String::new() } else { format!("\n{}", lines.concat()) }
}

fn second_order(spec: &Model, problem: &Problem, curvature: &Curvature) -> String {
    let extremum = match problem.sense {
        Sense::Maximize => "maximum",
        Sense::Minimize => "minimum",
    };
    let names: Vec<String> = curvature.along.iter().map(|p| format!("`{}`", spec.parameters[*p].name)).collect();
    let along =
        if names.is_empty() { "as the gait moves".to_owned() } else { format!("along {}", names.join(" and ")) };
    let parameters = problem.vary.iter().filter(|v| v.lower < v.upper).count();
    match curvature.shape {
        Shape::Vertex => format!(
            "a vertex: {}, {}",
            counted(curvature.constraints, "active constraint"),
            counted(parameters, "parameter")
        ),
        Shape::Strict => {
            format!("a strict local {extremum}: it gets worse in {}", directions(curvature.directions))
        }
        Shape::Flat => format!("flat {along}: second derivatives do not tell this point from its neighbours there"),
        Shape::Saddle => format!("a saddle: the objective improves {along}"),
        Shape::Undecided => "second derivatives do not decide whether this is an optimum".to_owned(),
    }
}

fn directions(count: usize) -> String {
    match count {
        1 => "the one direction that the constraints leave".to_owned(),
        n => format!("each of the {} directions that the constraints leave", number(n)),
    }
}

fn counted(count: usize, what: &str) -> String {
    format!("{} {what}{}", number(count), if count == 1 { "" } else { "s" })
}

/// Small numbers in words.
fn number(n: usize) -> String {
    const WORDS: [&str; 10] = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
    WORDS.get(n).map_or_else(|| n.to_string(), |word| (*word).to_owned())
}

fn confirmed(confirmation: &Confirmation) -> String {
    let mut parts = Vec::new();
    match confirmation.disturbed {
        Some(Disturbed::Stays { maps, spread, sampling, memory, .. }) => {
            let long = if memory > 0.1 * maps as f64 {
                format!(", as deviations last {} maps", format_number(memory.round()))
            } else {
                String::new()
            };
            let deviations = if sampling > 0.0 {
                format!(
                    "deviations as predicted within {} (sampling alone: {}{long})",
                    percent(spread),
                    percent(sampling)
                )
            } else {
                "a map leaves nothing of them".to_owned()
            };
            parts.push(format!("{} disturbed maps in sequence, {deviations}", thousands(maps)));
        }
        Some(Disturbed::Grows { maps, grown, expected }) => {
            let close = percent((grown / expected - 1.0).abs().max(1e-3));
            parts.push(format!(
                "not stable, and a small deviation grows {}-fold in {}, as predicted within {close}",
                format_number(three_digits(grown)),
                counted(maps, "map")
            ));
        }
        None => {}
    }
    match &confirmation.independent {
        Some(i) => parts.push(format!(
            "{} agrees to {:.0e}, in the Jacobian to {:.0e}",
            i.route.words(),
            i.image.max(f64::EPSILON),
            i.jacobian.max(f64::EPSILON)
        )),
        None => parts.push(format!(
            "a simulation with tighter tolerances agrees to {:.0e}",
            confirmation.residual.max(f64::EPSILON)
        )),
    }
    format!("confirmed: {}", parts.join("; "))
}

fn percent(part: f64) -> String {
    format!("{} %", format_number((part * 1e3).round() / 10.0))
}

fn three_digits(x: f64) -> f64 {
    let unit = 10_f64.powi(x.abs().max(f64::MIN_POSITIVE).log10().floor() as i32 - 2);
    (x / unit).round() * unit
}

fn thousands(n: usize) -> String {
    if n < 1000 { n.to_string() } else { format!("{},{:03}", n / 1000, n % 1000) }
}
