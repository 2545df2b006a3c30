//! `gaitc basin MODEL`: which starts lead to which gait.

use super::args::BasinArgs;
use super::axes;
use super::columns::{Cell, Columns, integers, numbers, texts, with_rows};
use super::run::{self, Asked, Ran};
use super::summary::{Findings, Summary};
use crate::cli::args::Cli;
use crate::cli::optimize::on_interrupt;
use crate::cli::{InputError, Outcome, inputs, output, plots, provenance};
use crate::load::{Loaded, load};
use crate::study::{Kind, Manifest};
use crate::table::Table;
use gaitc_compiler::front::flags::{parse_assignment, parse_values};
use gaitc_compiler::front::{LONGEST_PERIOD, format_quantity};
use gaitc_runtime::orbit::GaitRequest;
use gaitc_runtime::return_map::Accuracy;
use gaitc_runtime::study::basin::{Basin, End, Fate, Settings};
use gaitc_runtime::study::{Design, Pool};
use serde_json::{Map, Value, json};
use std::ops::Range;
use std::time::Instant;

/// Starts of a chunk, unless somebody says otherwise: a second's work or so.
const STARTS: u64 = 200;
/// Starts that are followed side by side: enough to fill lanes, few enough for every thread to have some.
const GROUP: u64 = 32;
/// A motion that is undecided after so many maps stays so.
const MOST_STEPS: usize = 10_000_000;

/// Starts: a grid over some coordinates, the others held.
pub(super) struct Starts<'l> {
    pub(super) loaded: &'l Loaded,
    guess: Vec<f64>,
    /// Indices into the section coordinates.
    pub(super) over: Vec<usize>,
    pub(super) design: Design,
}

pub(crate) fn run(cli: &Cli, args: &BasinArgs) -> Result<Outcome, InputError> {
    let began = Instant::now();
    run::check(&args.storage)?;
    if !(1..=MOST_STEPS).contains(&args.steps) {
        return Err(InputError(format!("--steps {}: give a number from 1 to {MOST_STEPS}", args.steps)));
    }
    if !(1..=LONGEST_PERIOD).contains(&args.periods) {
        return Err(InputError(format!("--periods {}: give a number from 1 to {LONGEST_PERIOD}", args.periods)));
    }
    let loaded = load(&args.model.model, cli.specs.as_deref())?;
    let starts = Starts::new(&loaded, args)?;
    let points = run::count(starts.design.count(), &axes::arithmetic(&starts.design), &args.storage)?;
    let parameters = inputs::parameters(&loaded, &args.model)?;
    let warnings = inputs::outside_range(&loaded, &parameters);
    if let Some(path) = &args.plot {
        plots::check("--plot", path)?;
        starts.drawable()?;
    }
    let provenance = provenance::of(&cli.run, &loaded, &parameters);
    let columns = starts.columns();
    let manifest = Manifest::new(Kind::Basin, &columns, points, &provenance);
    let pool = Pool::new(args.storage.threads.unwrap_or(0))?;
    let memory = loaded.memory();
    let interrupt = on_interrupt();
    let accuracy = Accuracy { interrupt, ..inputs::accuracy(&args.search)? };
    let request = GaitRequest::new(&parameters, &memory);
    let tolerance = request.tolerance.max(10.0 * accuracy.relative);
    let request = GaitRequest { accuracy, tolerance, ..request };
    let (steps, periods) = (args.steps, args.periods);
    let settings = Settings { request, steps, periods };
    let basin = Basin::new(loaded.compiled, settings, &starts.guess)?;
    let asked =
        Asked { manifest: manifest.clone(), provenance: &provenance, storage: &args.storage, chunk: STARTS, interrupt };
    let ran = asked.run(|numbers| {
        let (first, count) = (numbers.start, numbers.end - numbers.start);
        let group = |group: u64| {
            let from = first + group * GROUP;
            starts.rows(&basin, from..(from + GROUP).min(numbers.end))
        };
        let rows = pool.map(0..count.div_ceil(GROUP), &interrupt, group)?;
        Ok(rows.map(|rows| with_rows(&columns, rows.into_iter().flatten().collect())))
    })?;
    let summary =
        Summary { provenance: &provenance, manifest: &manifest, storage: &args.storage, warnings: &warnings, began };
    let outcome = summary.print(&ran, cli.json, |table| starts.findings(table));
    if let (Some(path), Ran::Complete(table)) = (&args.plot, &ran) {
        plots::save("--plot", path, &starts.picture(table), &provenance);
    }
    Ok(outcome)
}

impl<'l> Starts<'l> {
    fn new(loaded: &'l Loaded, args: &BasinArgs) -> Result<Self, InputError> {
        let states = &loaded.spec.states;
        let names: Vec<&str> = loaded.coordinates().iter().map(|&i| states[i].name.as_str()).collect();
        let (mut over, mut values, mut seen) = (Vec::new(), Vec::new(), Vec::new());
        for text in &args.over {
            let (name, rest) = parse_assignment(text).map_err(inputs::given("--over", text))?;
            let Some(index) = names.iter().position(|known| *known == name) else {
                return Err(inputs::unknown("--over", "section coordinate", name, &names));
            };
            inputs::once(&mut seen, "--over", name)?;
            over.push(index);
            let dimension = states[loaded.coordinates()[index]].dimension;
            values.push((name, parse_values(rest, dimension).map_err(inputs::given("--over", text))?));
        }
        for text in &args.search.guess {
            let (name, _) = parse_assignment(text).map_err(inputs::given("--guess", text))?;
            if seen.contains(&name) {
                return Err(InputError(format!(
                    "--guess: `{name}` takes the values of --over\n  help: leave one of --guess and --over away"
                )));
            }
        }
        Ok(Self { loaded, guess: inputs::guess(loaded, &args.search)?, over, design: axes::grid(&values)? })
    }

    fn columns(&self) -> Table {
        let mut columns = Columns::default();
        columns.integer("point", "Number of the start, from 0.");
        columns.section(self.loaded, "");
        columns.text("outcome", "`gait`, `undecided`, or why the motion stops.");
        columns.integer("period", "In how many maps the gait repeats; 0 where there is none.");
        columns.integer("steps", "After how many maps this was known.");
        columns.section(self.loaded, "_end");
        columns.table()
    }

    /// Section coordinates of a start.
    fn start(&self, number: u64) -> Vec<f64> {
        let mut start = self.guess.clone();
        for (&i, value) in self.over.iter().zip(self.design.point(number)) {
            start[i] = value;
        }
        start
    }

    fn rows(&self, basin: &Basin<'_>, numbers: Range<u64>) -> Result<Vec<Vec<Cell>>, InputError> {
        let starts: Vec<Vec<f64>> = numbers.clone().map(|number| self.start(number)).collect();
        let fates = basin.fates(&starts)?;
        Ok(numbers.zip(starts).zip(fates).map(|((number, start), fate)| row(number, start, fate)).collect())
    }

    /// The gaits, with their shares, and how many starts come to nothing.
    fn findings(&self, table: &Table) -> Findings {
        let outcomes = texts(table, "outcome").unwrap_or_default();
        let gaits = integers(table, "gait").unwrap_or_default();
        let periods = integers(table, "period").unwrap_or_default();
        let mut rows = Vec::new();
        let mut listed = Vec::new();
        for number in 1..=gaits.iter().copied().max().unwrap_or(0) {
            let count = gaits.iter().filter(|gait| **gait == number).count();
            let first = gaits.iter().position(|gait| *gait == number).unwrap_or(0);
            let period = periods.get(first).copied().unwrap_or(0);
            let (section, shown) = self.end(table, first);
            rows.push(vec![format!("gait {number}, period {period}"), count.to_string(), shown]);
            listed.push(json!({ "gait": number, "period": period, "section": section, "starts": count }));
        }
        let mut others: Vec<(&String, usize)> = Vec::new();
        for outcome in outcomes.iter().filter(|outcome| *outcome != "gait") {
            match others.iter_mut().find(|(known, _)| *known == outcome) {
                Some((_, count)) => *count += 1,
                None => others.push((outcome, 1)),
            }
        }
        rows.extend(others.iter().map(|(outcome, count)| vec![(*outcome).clone(), count.to_string(), String::new()]));
        let mut json = Map::new();
        json.insert("gaits".to_owned(), Value::Array(listed));
        let others: Map<String, Value> = others.into_iter().map(|(name, count)| (name.clone(), count.into())).collect();
        json.insert("others".to_owned(), Value::Object(others));
        Findings { text: output::table(&["outcome", "starts", "where"], rows), json }
    }

    /// The section coordinates in which a motion ended.
    fn end(&self, table: &Table, row: usize) -> (Map<String, Value>, String) {
        let (mut section, mut shown) = (Map::new(), Vec::new());
        for &i in self.loaded.coordinates() {
            let state = &self.loaded.spec.states[i];
            let value = numbers(table, &format!("{}_end", state.name)).and_then(|values| values.get(row)).copied();
            let value = value.unwrap_or(f64::NAN);
            section.insert(state.name.clone(), json!(value));
            shown.push(format!("{} = {}", state.name, format_quantity(value, &state.unit)));
        }
        (section, shown.join(", "))
    }
}

fn row(number: u64, start: Vec<f64>, fate: Fate) -> Vec<Cell> {
    let (outcome, period) = match fate.end {
        End::Gait { period } => ("gait", period),
        End::Stopped(reason) => (reason.name(), 0),
        End::Undecided => ("undecided", 0),
    };
    let integer = |value: usize| Cell::Integer(i64::try_from(value).unwrap_or(i64::MAX));
    let mut row = vec![Cell::Integer(i64::try_from(number).unwrap_or(i64::MAX))];
    row.extend(start.into_iter().map(Cell::Number));
    row.extend([Cell::Text(outcome), integer(period), integer(fate.steps)]);
    row.extend(fate.coordinates.into_iter().map(Cell::Number));
    row
}
