//! Which problem the flags ask for: the spec's default, a named one with additions, or one made of flags alone.

use super::robust;
use crate::cli::args::OptimizeArgs;
use crate::cli::{InputError, inputs};
use crate::load::Loaded;
use gaitc_compiler::front::flags::{parse_assignment, parse_constraint, parse_objective, parse_range};
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Model, NodeId, Problem, Sense, Symbol, Vary};

/// The problem, and the spec with the expressions that the flags added.
pub(super) fn problem(loaded: &Loaded, args: &OptimizeArgs) -> Result<(Model, Problem), InputError> {
    let mut spec = loaded.spec.clone();
    let mut problem = match (&args.maximize, &args.minimize) {
        (Some(text), _) => fresh(&mut spec, Sense::Maximize, text)?,
        (None, Some(text)) => fresh(&mut spec, Sense::Minimize, text)?,
        (None, None) => named(&spec, args.problem.as_deref())?,
    };
    let mut seen = Vec::new();
    for text in &args.vary {
        let (name, range) = parse_assignment(text).map_err(inputs::given("--vary", text))?;
        let parameter = inputs::parameter(loaded, "--vary", name)?;
        inputs::once(&mut seen, "--vary", name)?;
        let dimension = spec.parameters[parameter].dimension;
        let (lower, upper) = parse_range(range, dimension).map_err(inputs::given("--vary", text))?;
        problem.vary.retain(|v| v.parameter != parameter);
        problem.vary.push(Vary { parameter, lower, upper });
    }
    robust::add(loaded, args, &mut problem)?;
    for text in &args.subject_to {
        problem.constraints.push(parse_constraint(&mut spec, text).map_err(inputs::given("--subject-to", text))?);
    }
    if let Some(period) = args.period {
        inputs::period(period)?;
        problem.period = period;
    }
    if problem.vary.is_empty() {
        return Err(InputError(
            "nothing to vary\n  help: name at least one parameter and its bounds, e.g. --vary 'psi=1..45 deg'"
                .to_owned(),
        ));
    }
    if let [vary, others @ ..] = problem.vary.as_slice()
        && problem.vary.iter().all(|vary| vary.lower >= vary.upper)
    {
        let parameter = &spec.parameters[vary.parameter];
        let value = format_quantity(vary.lower, &parameter.unit);
        let whose =
            if others.is_empty() { "the range is a single value," } else { "every range is a single value, such as" };
        return Err(InputError(format!(
            "nothing to vary: {whose} `{0}` = {value}\n  help: widen one, e.g. --vary '{0}=LO..HI', or \
             look at this gait with `gaitc gait {1} --set '{0}={value}'`",
            parameter.name, spec.name
        )));
    }
    if args.trade.is_none() {
        depends_on_what_varies(&spec, &problem, problem.objective, &problem.objective_text)?;
    }
    Ok((spec, problem))
}

/// Refuses an objective that nothing moves.
pub(super) fn depends_on_what_varies(
    spec: &Model,
    problem: &Problem,
    objective: NodeId,
    text: &str,
) -> Result<(), InputError> {
    let moves = |symbol: Symbol| match symbol {
        Symbol::Parameter(i) => problem.vary.iter().any(|v| v.parameter == i),
        Symbol::Measure(_) | Symbol::SpectralRadius => true,
        _ => false,
    };
    if spec.graph.depends(&[objective], moves) {
        return Ok(());
    }
    Err(InputError(format!(
        "the objective `{text}` does not depend on anything that varies\n  help: state it over measures or over the parameters \
         that --vary names"
    )))
}

fn fresh(spec: &mut Model, sense: Sense, text: &str) -> Result<Problem, InputError> {
    let flag = match sense {
        Sense::Maximize => "--maximize",
        Sense::Minimize => "--minimize",
    };
    let (objective, objective_dimension) = parse_objective(spec, text).map_err(inputs::given(flag, text))?;
    Ok(Problem {
        name: "from flags".to_owned(),
        default: false,
        doc: String::new(),
        sense,
        objective,
        objective_text: text.to_owned(),
        objective_dimension,
        vary: Vec::new(),
        robust: Vec::new(),
        constraints: Vec::new(),
        period: 1,
    })
}

fn named(spec: &Model, name: Option<&str>) -> Result<Problem, InputError> {
    let names: Vec<&str> = spec.problems.iter().map(|p| p.name.as_str()).collect();
    match name {
        Some(name) => (spec.problems.iter().find(|p| p.name == name).cloned())
            .ok_or_else(|| inputs::unknown("--problem", "problem", name, &names)),
        None => (spec.problems.iter().find(|p| p.default).or(spec.problems.first()).cloned()).ok_or_else(|| {
            InputError(format!(
                "`{}` has no [problems]\n  help: state one: --maximize MEASURE --vary NAME=LO..HI",
                spec.name
            ))
        }),
    }
}
