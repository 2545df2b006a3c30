//! Climb speed and stability of the prescribed-length climber against sprawl: draws the picture of the README.
//!
//! Run with `cargo run --release --example sprawl -- docs/sprawl.svg`.

use gaitc::load::load;
use gaitc_runtime::orbit::{GaitRequest, GaitStatus, find_gait};
use plotters::prelude::*;
use std::error::Error;

/// Sprawl [deg], climb speed [m/s], spectral radius.
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

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "sprawl.svg".to_owned());
    let rows = gaits()?;
    let root = SVGBackend::new(&path, (860, 360)).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(430);
    panel(&left, "climb speed [m/s]", 0.0..0.9, &rows, |row| row.1, BLUE)?;
    panel(&right, "spectral radius", 0.4..1.2, &rows, |row| row.2, ORANGE)?;
    root.present()?;
    Ok(())
}

fn panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    title: &str,
    range: std::ops::Range<f64>,
    rows: &[Row],
    pick: impl Fn(&Row) -> f64,
    color: RGBColor,
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..45.0, range.clone())?;
    let label = ("sans-serif", 15);
    chart
        .configure_mesh()
        .x_desc("sprawl psi [deg]")
        .label_style(label)
        .axis_desc_style(label)
        .light_line_style(WHITE)
        .draw()?;
    // Where gaits lose at least 5 % of a disturbance a step; the best speed is at its left edge.
    let enough: Vec<&Row> = rows.iter().filter(|row| row.2 <= 0.95).collect();
    if let (Some(first), Some(last)) = (enough.first(), enough.last()) {
        let corners = [(first.0, range.start), (last.0, range.end)];
        chart.draw_series([Rectangle::new(corners, GREEN.mix(0.15).filled())])?;
        let text = format!("spectral radius <= 0.95 from {:.1} deg", first.0);
        let at = (first.0 + 1.0, range.start + 0.06 * (range.end - range.start));
        chart.draw_series([Text::new(text, at, ("sans-serif", 14).into_font().color(&GREEN))])?;
    }
    chart.draw_series(LineSeries::new(rows.iter().map(|row| (row.0, pick(row))), color.stroke_width(3)))?;
    Ok(())
}
