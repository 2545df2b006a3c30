//! `gaitc sweep MODEL`: the gait, or the optimum of a problem, at each of many points.

use super::args::SweepArgs;
use super::axes;
use super::columns::{Cell, Columns, integers, numbers, texts, with_rows};
use super::run::{self, Asked, Ran};
use super::summary::{Findings, Summary};
use crate::cli::args::Cli;
use crate::cli::optimize::{on_interrupt, status};
use crate::cli::{InputError, Outcome, inputs, output, plots, provenance};
use crate::load::{Loaded, load};
use crate::problem::{Start, assemble};
use crate::study::{Kind, Manifest};
use crate::table::Table;
use gaitc_compiler::dimension::Dimension;
use gaitc_compiler::front::flags::{parse_assignment, parse_values};
use gaitc_compiler::front::{format_quantity, format_si};
use gaitc_compiler::ir;
use gaitc_runtime::optimize::{Settings, Status, solve};
use gaitc_runtime::orbit::{GaitOutcome, GaitStatus};
use gaitc_runtime::return_map::Accuracy;
use gaitc_runtime::study::sweep::{Gaits, Reference, Route};
use gaitc_runtime::study::{Design, Pool};
use serde_json::{Map, json};
use std::time::Instant;

/// Points of a chunk, unless somebody says otherwise: a second's work or so.
const GAITS: u64 = 100;
const OPTIMA: u64 = 10;

/// A sweep as it was asked for.
pub(super) struct Sweep<'l> {
    pub(super) loaded: &'l Loaded,
    /// All parameters; those that are swept have the values at which a gait begins that is followed to a point.
    parameters: Vec<f64>,
    guess: Vec<f64>,
    pub(super) swept: Vec<usize>,
    pub(super) design: Design,
    period: usize,
    pub(super) problem: Option<ir::Problem>,
    /// With what Ctrl-C requests.
    accuracy: Accuracy,
}

pub(crate) fn run(cli: &Cli, args: &SweepArgs) -> Result<Outcome, InputError> {
    let began = Instant::now();
    run::check(&args.storage)?;
    inputs::period(args.period)?;
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let sweep = Sweep::new(&loaded, args)?;
    let points = run::count(sweep.design.count(), &axes::arithmetic(&sweep.design), &args.storage)?;
    let mut warnings = inputs::outside_range(&loaded, &sweep.parameters);
    warnings.extend(sweep.outside());
    if let Some(path) = &args.plot {
        plots::check("--plot", path)?;
        sweep.drawable()?;
    }
    let provenance = provenance::of(&cli.run, &loaded, &sweep.parameters);
    let columns = sweep.columns();
    let manifest = Manifest::new(Kind::Sweep, &columns, points, &provenance);
    let pool = Pool::new(args.storage.threads.unwrap_or(0))?;
    let chunk = if sweep.problem.is_some() { OPTIMA } else { GAITS };
    let asked = Asked {
        manifest: manifest.clone(),
        provenance: &provenance,
        storage: &args.storage,
        chunk,
        interrupt: sweep.accuracy.interrupt,
    };
    let gaits = match &sweep.problem {
        Some(_) => None,
        None => Some(sweep.gaits()?),
    };
    let ran = asked.run(|numbers| {
        let rows = match &gaits {
            Some(gaits) => pool.map(numbers, &sweep.accuracy.interrupt, |number| sweep.gait(gaits, number))?,
            None => pool.map(numbers, &sweep.accuracy.interrupt, |number| sweep.optimum(number))?,
        };
        Ok(rows.map(|rows| with_rows(&columns, rows)))
    })?;
    let summary =
        Summary { provenance: &provenance, manifest: &manifest, storage: &args.storage, warnings: &warnings, began };
    let outcome = summary.print(&ran, cli.json, |table| sweep.findings(table));
    if let (Some(path), Ran::Complete(table)) = (&args.plot, &ran) {
        plots::save("--plot", path, &*sweep.picture(table), &provenance);
    }
    Ok(outcome)
}

impl<'l> Sweep<'l> {
    fn new(loaded: &'l Loaded, args: &SweepArgs) -> Result<Self, InputError> {
        let (mut swept, mut over, mut seen) = (Vec::new(), Vec::new(), Vec::new());
        for text in &args.over {
            let (name, values) = parse_assignment(text).map_err(inputs::given("--over", text))?;
            let parameter = inputs::parameter(loaded, "--over", name)?;
            inputs::once(&mut seen, "--over", name)?;
            swept.push(parameter);
            let dimension = loaded.spec.parameters[parameter].dimension;
            over.push((name, parse_values(values, dimension).map_err(inputs::given("--over", text))?));
        }
        let design = match args.sobol {
            Some(count) => axes::sobol(&over, count, args.seed)?,
            None => axes::grid(&over)?,
        };
        Ok(Self {
            loaded,
            parameters: inputs::parameters(loaded, &args.model)?,
            guess: inputs::guess(loaded, &args.search)?,
            problem: args.optimize.as_deref().map(|name| problem(loaded, name, &swept)).transpose()?,
            swept,
            design,
            period: args.period,
            accuracy: Accuracy { interrupt: on_interrupt(), ..inputs::accuracy(&args.search)? },
        })
    }

    /// One sentence for each swept parameter that leaves the range that the spec gives for it: most often a forgotten unit.
    fn outside(&self) -> Vec<String> {
        let ends = |axis: usize| -> Vec<f64> {
            match &self.design {
                Design::Grid(axes) => {
                    axes.get(axis).map_or_else(Vec::new, |a| (0..a.len()).map(|i| a.value(i)).collect())
                }
                Design::Sobol { bounds, .. } => {
                    bounds.get(axis).map_or_else(Vec::new, |(lower, upper)| vec![*lower, *upper])
                }
            }
        };
        let outside = |(axis, &i): (usize, &usize)| {
            let p = self.loaded.spec.parameters.get(i)?;
            let (lower, upper) = p.range?;
            let slack = 1e-9 * (upper - lower);
            let value = ends(axis).into_iter().find(|v| *v < lower - slack || *v > upper + slack)?;
            let [value, lower, upper] = [value, lower, upper].map(|v| format_quantity(v, &p.unit));
            Some(format!("`{}` = {value} is outside the range that the spec gives for it, {lower} to {upper}", p.name))
        };
        self.swept.iter().enumerate().filter_map(outside).collect()
    }

    fn columns(&self) -> Table {
        let mut columns = Columns::default();
        columns.integer("point", "Number of the point, from 0.");
        columns.parameters(self.loaded, self.swept.iter().copied());
        columns.text("status", "How the search ended.");
        if let Some(problem) = &self.problem {
            let unit = si_text(problem.objective_dimension);
            columns.number(("objective", "_"), &unit, &format!("Best value of {}.", problem.objective_text));
            columns.parameters(self.loaded, problem.vary.iter().map(|vary| vary.parameter));
        } else {
            columns.text(
                "route",
                "How the gait was found: from the start, or followed from that of the reference parameters.",
            );
            columns.number(("duration", "_"), "s", "Duration of the gait's map.");
        }
        columns.integer("stable", "1 where there is a gait and it is stable, else 0.");
        columns.number(("spectral_radius", "_"), "1", "Largest magnitude of a multiplier.");
        if self.problem.is_none() {
            for i in 1..=self.loaded.coordinates().len() {
                for (part, name) in [("re", "Real"), ("im", "Imaginary")] {
                    let doc = format!("{name} part of multiplier number {i}, by falling magnitude.");
                    columns.number((&format!("multiplier_{i}_{part}"), "_"), "1", &doc);
                }
            }
        }
        columns.section(self.loaded, "");
        columns.measures(self.loaded);
        columns.table()
    }

    /// All parameters of a point, and the first cells of its row.
    fn point(&self, number: u64) -> (Vec<f64>, Vec<Cell>) {
        let values = self.design.point(number);
        let mut parameters = self.parameters.clone();
        for (&i, value) in self.swept.iter().zip(&values) {
            parameters[i] = *value;
        }
        let mut cells = vec![Cell::Integer(i64::try_from(number).unwrap_or(i64::MAX))];
        cells.extend(values.into_iter().map(Cell::Number));
        (parameters, cells)
    }

    fn gaits(&self) -> Result<Gaits<'l>, InputError> {
        Ok(Gaits::new(
            self.loaded.compiled,
            Reference {
                parameters: self.parameters.clone(),
                memory: self.loaded.memory(),
                start: self.guess.clone(),
                period: self.period,
                accuracy: self.accuracy,
            },
        )?)
    }

    fn gait(&self, gaits: &Gaits<'_>, number: u64) -> Result<Vec<Cell>, InputError> {
        let (parameters, mut row) = self.point(number);
        let (GaitOutcome { status, gait, .. }, route) = gaits.at(&parameters)?;
        let gait = gait.filter(|_| status == GaitStatus::Converged);
        let d = self.loaded.coordinates().len();
        row.push(Cell::Text(status.name()));
        row.push(Cell::Text(match (&gait, route) {
            (None, _) => "",
            (Some(_), Route::Start) => "start",
            (Some(_), Route::Followed) => "followed",
        }));
        let all = |values: Option<&[f64]>, count: usize| -> Vec<Cell> {
            (0..count).map(|i| Cell::Number(values.and_then(|v| v.get(i)).copied().unwrap_or(f64::NAN))).collect()
        };
        let one = |value: Option<f64>| Cell::Number(value.unwrap_or(f64::NAN));
        row.push(one(gait.as_ref().map(|gait| gait.map.duration)));
        row.push(Cell::Integer(i64::from(gait.as_ref().is_some_and(|gait| gait.spectral_radius < 1.0))));
        row.push(one(gait.as_ref().map(|gait| gait.spectral_radius)));
        for i in 0..d {
            let multiplier = gait.as_ref().and_then(|gait| gait.multipliers.get(i));
            row.extend([one(multiplier.map(|m| m.re)), one(multiplier.map(|m| m.im))]);
        }
        row.extend(all(gait.as_ref().map(|gait| gait.coordinates.as_slice()), d));
        row.extend(all(gait.as_ref().map(|gait| gait.map.measures.as_slice()), self.loaded.spec.measures.len()));
        Ok(row)
    }

    fn optimum(&self, number: u64) -> Result<Vec<Cell>, InputError> {
        let (parameters, mut row) = self.point(number);
        let Some(problem) = &self.problem else { return Ok(row) };
        let settings = Settings {
            accuracy: self.accuracy,
            interrupt: self.accuracy.interrupt,
            // Each optimum is confirmed by a fresh simulation; the long tests are for single answers.
            long_tests: false,
            ..Settings::default()
        };
        let start = Start { parameters, section: self.guess.clone(), settings };
        let solution = solve(&assemble(self.loaded, &self.loaded.spec, problem, start))?;
        let found = solution.status == Status::Optimal;
        let number = |value: Option<&f64>| Cell::Number(value.copied().filter(|_| found).unwrap_or(f64::NAN));
        row.push(Cell::Text(status(solution.status)));
        row.push(number(Some(&solution.objective)));
        row.extend(problem.vary.iter().map(|vary| number(solution.parameters.get(vary.parameter))));
        row.push(Cell::Integer(i64::from(found && solution.spectral_radius < 1.0)));
        row.push(number(Some(&solution.spectral_radius)));
        row.extend((0..self.loaded.coordinates().len()).map(|i| number(solution.section.get(i))));
        row.extend((0..self.loaded.spec.measures.len()).map(|i| number(solution.measures.get(i))));
        Ok(row)
    }

    /// How many points have what was looked for, and the best of them.
    fn findings(&self, table: &Table) -> Findings {
        let wanted = if self.problem.is_some() { "optimal" } else { "converged" };
        let statuses = texts(table, "status").unwrap_or_default();
        let found = statuses.iter().filter(|status| *status == wanted).count();
        let stable = integers(table, "stable").unwrap_or_default();
        let count = stable.iter().filter(|stable| **stable == 1).count();
        let mut json = Map::new();
        json.insert(wanted.to_owned(), found.into());
        json.insert("stable".to_owned(), count.into());
        let mut text = match self.problem {
            Some(_) => format!("{found} with an optimum\n"),
            None => format!("{found} with a gait, {count} of these stable\n"),
        };
        text += &reasons(statuses, wanted);
        if let Some((row, name, value, shown)) = self.best(table, stable) {
            let point = integers(table, "point").and_then(|points| points.get(row)).copied().unwrap_or(0);
            let at = self.design.point(u64::try_from(point).unwrap_or(0));
            let named: Vec<String> = self
                .swept
                .iter()
                .zip(&at)
                .map(|(&i, value)| {
                    let p = &self.loaded.spec.parameters[i];
                    format!("{} = {}", p.name, format_quantity(*value, &p.unit))
                })
                .collect();
            text += &format!("best: {name} = {shown} at {} (point {point})\n", named.join(", "));
            json.insert("best".to_owned(), json!({ "point": point, "name": name, "value": value }));
        }
        Findings { text, json }
    }

    /// Name and unit of the column by which points are ranked: the objective, or the first measure.
    pub(super) fn ranked(&self) -> (String, String) {
        match (&self.problem, self.loaded.spec.measures.first()) {
            (Some(problem), _) => ("objective".to_owned(), si_text(problem.objective_dimension)),
            (None, Some(measure)) => (measure.name.clone(), measure.unit.clone()),
            (None, None) => (String::new(), String::new()),
        }
    }

    /// The row with the best objective, or with the largest first measure of all stable gaits.
    fn best(&self, table: &Table, stable: &[i64]) -> Option<(usize, String, f64, String)> {
        let (name, column, largest) = match &self.problem {
            Some(p) => (p.objective_text.clone(), numbers(table, "objective")?, p.sense == ir::Sense::Maximize),
            None => {
                let name = self.loaded.spec.measures.first()?.name.clone();
                let column = numbers(table, &name)?;
                (name, column, true)
            }
        };
        let rank = |value: f64| if largest { value } else { -value };
        let known = column.iter().copied().enumerate();
        let known =
            known.filter(|(i, value)| !value.is_nan() && (self.problem.is_some() || stable.get(*i) == Some(&1)));
        // The first of equals.
        let (row, value) = known.reduce(|best, one| if rank(one.1) > rank(best.1) { one } else { best })?;
        let shown = match &self.problem {
            Some(p) => format_si(value, p.objective_dimension),
            None => format_quantity(value, &self.loaded.spec.measures.first()?.unit),
        };
        Some((row, name, value, shown))
    }
}

/// The problem of a name, without what is swept.
fn problem(loaded: &Loaded, name: &str, swept: &[usize]) -> Result<ir::Problem, InputError> {
    let names: Vec<&str> = loaded.spec.problems.iter().map(|p| p.name.as_str()).collect();
    let known = loaded.spec.problems.iter().find(|p| p.name == name);
    let mut problem = known.cloned().ok_or_else(|| inputs::unknown("--optimize", "problem", name, &names))?;
    problem.vary.retain(|vary| !swept.contains(&vary.parameter));
    if problem.vary.is_empty() {
        return Err(InputError(format!(
            "--optimize {name}: everything that the problem varies is swept\n  help: sweep fewer parameters, or leave --optimize away"
        )));
    }
    Ok(problem)
}

/// How many points have none, and why.
fn reasons(statuses: &[String], wanted: &str) -> String {
    let mut reasons: Vec<(&str, usize)> = Vec::new();
    for status in statuses.iter().filter(|status| *status != wanted) {
        match reasons.iter_mut().find(|(reason, _)| reason == status) {
            Some((_, count)) => *count += 1,
            None => reasons.push((status, 1)),
        }
    }
    if reasons.is_empty() {
        return String::new();
    }
    let rows = reasons.into_iter().map(|(reason, count)| vec![reason.to_owned(), count.to_string()]);
    output::table(&["without", "points"], rows)
}

/// The SI unit of a dimension, as people write it.
fn si_text(dimension: Dimension) -> String {
    format_si(1.0, dimension).split_once(' ').map_or_else(String::new, |(_, unit)| unit.to_owned())
}
