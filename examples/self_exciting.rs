//! Climb speed and push of the self-exciting climber against its gear ratio, with the optima of its two problems: draws the
//! picture that shows what the bounds of the problem `fastest_stable` are for.
//!
//! Run with `cargo run --release --example self_exciting -- docs/self_exciting.svg`.

use gaitc::load::{Loaded, load};
use gaitc::problem::{Start, assemble};
use gaitc_runtime::optimize::{Settings, Status, solve};
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use plotters::prelude::*;
use std::error::Error;

/// What is drawn of one gait.
#[derive(Clone, Copy)]
struct Row {
    /// Gear ratio.
    gear: f64,
    /// Climb speed (m/s).
    speed: f64,
    /// Peak push of the leg (N).
    push: f64,
}

/// The model, and where in its tables stands what is drawn.
struct Climber {
    model: Loaded,
    gear: usize,
    speed: usize,
    push: usize,
}

impl Climber {
    fn load() -> Result<Self, Box<dyn Error>> {
        let model = load("self_exciting", None)?;
        let measure = |name| model.spec.measures.iter().position(|m| m.name == name).ok_or("a measure is missing");
        let (speed, push) = (measure("climb_speed")?, measure("peak_push")?);
        let gear = model.parameter("G").ok_or("no parameter G")?;
        Ok(Self { model, gear, speed, push })
    }

    fn row(&self, parameters: &[f64], measures: &[f64]) -> Row {
        Row { gear: parameters[self.gear], speed: measures[self.speed], push: measures[self.push] }
    }

    /// The optimum of a problem of the spec: all parameters, and its row.
    fn best(&self, problem: &str) -> Result<(Vec<f64>, Row), Box<dyn Error>> {
        let spec = &self.model.spec;
        let stated = spec.problems.iter().find(|p| p.name == problem).ok_or("no such problem")?;
        let start =
            Start { parameters: self.model.parameters(), section: self.model.start(), settings: Settings::default() };
        let solution = solve(&assemble(&self.model, spec, stated, start))?;
        if solution.status != Status::Optimal {
            return Err(solution.message.into());
        }
        let row = self.row(&solution.parameters, &solution.measures);
        Ok((solution.parameters, row))
    }

    /// Gaits over the gear ratio, the other parameters as given; each starts from the one before it.
    fn gaits(&self, parameters: &[f64]) -> Result<Vec<Row>, Box<dyn Error>> {
        let (mut parameters, memory, mut guess) = (parameters.to_vec(), self.model.memory(), self.model.start());
        let mut rows = Vec::new();
        for gear in (15..=120).rev() {
            parameters[self.gear] = f64::from(gear);
            let outcome = find_gait(self.model.compiled, &GaitRequest::new(&parameters, &memory), &guess)?;
            if let (GaitStatus::Converged, Some(gait)) = (&outcome.status, &outcome.gait) {
                rows.push(self.row(&parameters, gait.map.measures.as_slice()));
                guess = gait.coordinates.as_slice().to_vec();
            }
        }
        Ok(rows)
    }
}

const BLUE: RGBColor = RGBColor(0, 114, 178);
const ORANGE: RGBColor = RGBColor(213, 94, 0);
const GREEN: RGBColor = RGBColor(0, 158, 115);

/// The problem `fastest_stable` allows no stronger push (N).
const LARGEST_PUSH: f64 = 100.0;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "self_exciting.svg".to_owned());
    let climber = Climber::load()?;
    let (parameters, bounded) = climber.best("fastest_stable")?;
    let (_, unbounded) = climber.best("fastest_unbounded")?;
    // The bounded optimum has its own sprawl and spring, and lies on a curve of its own.
    let (own, spec) = (climber.gaits(&parameters)?, climber.gaits(&climber.model.parameters())?);
    // SVG positions are whole units: a large canvas keeps curves smooth.
    let root = SVGBackend::new(&path, (1800, 760)).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(900);
    let speed = Panel { title: "climb speed (m/s)", range: 0.0..1.6, labels: 9, label: &|y| format!("{y:.1}") };
    // Forces on a logarithmic axis; where the leg never pushes there is nothing to draw.
    let push = Panel { title: "peak push of the leg (N)", range: 0.0..6.0, labels: 7, label: &power_of_ten };
    let log = |row: &Row| (row.push > 1.0).then(|| (row.gear, row.push.log10()));
    let marks = |y: &dyn Fn(&Row) -> f64| [(unbounded.gear, y(&unbounded)), (bounded.gear, y(&bounded))];
    let curves = |pick: &dyn Fn(&Row) -> Option<(f64, f64)>| {
        [own.iter().filter_map(pick).collect(), spec.iter().filter_map(pick).collect()]
    };
    speed.draw(&left, None, &curves(&|row| Some((row.gear, row.speed))), marks(&|row| row.speed))?;
    push.draw(&right, Some(LARGEST_PUSH.log10()), &curves(&log), marks(&|row| row.push.log10()))?;
    root.present()?;
    Ok(())
}

/// Ten to a whole power, its zeros in groups of three.
fn power_of_ten(exponent: &f64) -> String {
    let zeros = exponent.round().max(0.0) as usize;
    format!("1{}{}", "0".repeat(zeros % 3), " 000".repeat(zeros / 3))
}

/// One diagram over the gear ratio.
struct Panel<'a> {
    title: &'a str,
    range: std::ops::Range<f64>,
    labels: usize,
    label: &'a dyn Fn(&f64) -> String,
}

impl Panel<'_> {
    /// Draws the curves of the bounded optimum's machine and of the spec's, the allowed part below `bound`, and the optima
    /// without and with bounds.
    fn draw(
        &self,
        area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
        bound: Option<f64>,
        [own, spec]: &[Vec<(f64, f64)>; 2],
        [unbounded, bounded]: [(f64, f64); 2],
    ) -> Result<(), Box<dyn Error>> {
        let mut chart = ChartBuilder::on(area)
            .caption(self.title, ("sans-serif", 40))
            .margin(30)
            .x_label_area_size(90)
            .y_label_area_size(110)
            .build_cartesian_2d(10.0..120.0, self.range.clone())?;
        let label = ("sans-serif", 30);
        let mut mesh = chart.configure_mesh();
        mesh.x_desc("gear ratio G from motor to crank").x_labels(12).x_label_formatter(&|x| format!("{x:.0}"));
        mesh.y_labels(self.labels).y_label_formatter(&self.label);
        mesh.label_style(label).axis_desc_style(label).light_line_style(WHITE).draw()?;
        let height = self.range.end - self.range.start;
        let note = |text: &'static str, (x, y): (f64, f64), color: &RGBColor| {
            Text::new(text, (x, y + 0.02 * height), ("sans-serif", 30).into_font().color(color))
        };
        if let Some(bound) = bound {
            chart
                .draw_series([Rectangle::new([(10.0, self.range.start), (120.0, bound)], GREEN.mix(0.15).filled())])?;
            chart.draw_series([note("allowed by `fastest_stable`", (12.0, bound - 0.07 * height), &GREEN)])?;
        }
        chart.draw_series(LineSeries::new(spec.iter().copied(), BLUE.stroke_width(6)))?;
        chart.draw_series(LineSeries::new(own.iter().copied(), GREEN.stroke_width(3)))?;
        chart.draw_series([Circle::new(unbounded, 12, ORANGE.filled()), Circle::new(bounded, 12, GREEN.filled())])?;
        let beside = |(x, y): (f64, f64)| (x + 4.0, y + 0.06 * height);
        chart.draw_series([
            note("fastest_unbounded", beside(unbounded), &ORANGE),
            note("fastest_stable", beside(bounded), &GREEN),
        ])?;
        let line = |line: f64| (12.0, self.range.start + (0.2 - line * 0.07) * height);
        if bound.is_none() {
            let (thick, thin) = ("thick: sprawl and spring of the spec", "thin: sprawl and spring of `fastest_stable`");
            chart.draw_series([note(thick, line(1.0), &BLUE), note(thin, line(2.0), &GREEN)])?;
        }
        Ok(())
    }
}
