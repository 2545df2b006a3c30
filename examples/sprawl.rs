//! Climb speed and stability of the prescribed-length climber against sprawl: draws the picture of the README.
//!
//! Run with `cargo run --release --example sprawl -- docs/sprawl.svg`.

use gaitc::load::load;
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use plotters::prelude::*;
use std::error::Error;

/// Sprawl (deg), climb speed (m/s), spectral radius.
type Row = (f64, f64, f64);

/// Gaits at 1, 1.5, ... 45 degrees; each starts from the one before it.
fn gaits() -> Result<Vec<Row>, Box<dyn Error>> {
    let model = load("prescribed_length", None)?;
    let (mut parameters, memory, mut guess) = (model.parameters(), model.memory(), model.start());
    let psi = model.parameter("psi").ok_or("no parameter psi")?;
    let speed = model.spec.measures.iter().position(|m| m.name == "climb_speed").ok_or("no measure climb_speed")?;
    let mut rows = Vec::new();
    for half_degrees in 2..=90 {
        let degrees = f64::from(half_degrees) / 2.0;
        parameters[psi] = degrees.to_radians();
        let outcome = find_gait(model.compiled, &GaitRequest::new(&parameters, &memory), &guess)?;
        if let (GaitStatus::Converged, Some(gait)) = (&outcome.status, &outcome.gait) {
            rows.push((degrees, gait.map.measures[speed], gait.spectral_radius));
            guess = gait.coordinates.as_slice().to_vec();
        }
    }
    Ok(rows)
}

const BLUE: RGBColor = RGBColor(0, 114, 178);
const ORANGE: RGBColor = RGBColor(213, 94, 0);
const GREEN: RGBColor = RGBColor(0, 158, 115);

/// Gaits have to lose at least 5 % of a disturbance a step.
const BOUND: f64 = 0.95;

/// The narrowest sprawl with a spectral radius of `BOUND`, and the climb speed there, between the rows around it.
fn limit(rows: &[Row]) -> Option<(f64, f64)> {
    let pair = rows.windows(2).find(|pair| pair[0].2 > BOUND && pair[1].2 <= BOUND)?;
    let (a, b) = (pair[0], pair[1]);
    let s = (a.2 - BOUND) / (a.2 - b.2);
    Some((a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1)))
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "sprawl.svg".to_owned());
    let rows = gaits()?;
    let (psi, speed) = limit(&rows).ok_or("no gait is stable enough")?;
    // SVG positions are whole units: a large canvas keeps curves smooth.
    let root = SVGBackend::new(&path, (1800, 720)).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(900);
    let points = |pick: fn(&Row) -> f64| rows.iter().map(move |row| (row.0, pick(row))).collect::<Vec<_>>();
    panel(&left, "climb speed (m/s)", 0.0..0.9, &points(|row| row.1), BLUE, (psi, speed))?;
    panel(&right, "spectral radius of the return map", 0.4..1.2, &points(|row| row.2), ORANGE, (psi, BOUND))?;
    root.present()?;
    Ok(())
}

/// One curve over sprawl, the stable part shaded from `limit` on.
fn panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    title: &str,
    range: std::ops::Range<f64>,
    curve: &[(f64, f64)],
    color: RGBColor,
    limit: (f64, f64),
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 40))
        .margin(30)
        .x_label_area_size(90)
        .y_label_area_size(80)
        .build_cartesian_2d(0.0..45.0, range.clone())?;
    let label = ("sans-serif", 30);
    let mut mesh = chart.configure_mesh();
    mesh.x_desc("sprawl angle psi (deg)").x_labels(10).x_label_formatter(&|x| format!("{x:.0}"));
    mesh.y_label_formatter(&|y| format!("{y:.1}")).label_style(label).axis_desc_style(label).light_line_style(WHITE);
    mesh.draw()?;
    chart.draw_series([Rectangle::new([(limit.0, range.start), (45.0, range.end)], GREEN.mix(0.15).filled())])?;
    chart.draw_series(LineSeries::new(curve.iter().copied(), color.stroke_width(6)))?;
    chart.draw_series([Circle::new(limit, 12, GREEN.filled())])?;
    let note = |text: String, at: (f64, f64)| Text::new(text, at, ("sans-serif", 30).into_font().color(&GREEN));
    let height = range.end - range.start;
    let x = 24.5;
    chart.draw_series([
        note("spectral radius <= 0.95".to_owned(), (x, range.end - 0.04 * height)),
        note(format!("from {:.2} deg", limit.0), (x, range.end - 0.11 * height)),
    ])?;
    Ok(())
}
