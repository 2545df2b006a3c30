//! One curve of points in the plane, with marked places.

use super::axis::{range, tick};
use super::{BLUE, GREY, ORANGE};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::error::Error;

/// A named place on the curve.
pub struct Mark {
    /// Where.
    pub at: (f64, f64),
    /// What stands beside it.
    pub label: String,
}

/// A curve over an axis, both in the units that their labels name.
pub struct Line {
    /// Above the picture.
    pub title: String,
    /// Below the horizontal axis, with its unit.
    pub x: String,
    /// Beside the vertical axis, with its unit.
    pub y: String,
    /// The points in order.
    pub points: Vec<(f64, f64)>,
    /// Marked places.
    pub marks: Vec<Mark>,
}

const SIZE: (u32, u32) = (1000, 700);

impl Line {
    /// The picture as SVG text.
    ///
    /// # Errors
    /// Those of the drawing library.
    pub fn svg(&self) -> Result<String, Box<dyn Error>> {
        let mut text = String::new();
        self.draw(&SVGBackend::with_string(&mut text, SIZE).into_drawing_area())?;
        Ok(text)
    }

    fn draw(&self, area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>) -> Result<(), Box<dyn Error>> {
        area.fill(&WHITE)?;
        let (x, y) = (range(self.points.iter().map(|p| p.0)), range(self.points.iter().map(|p| p.1)));
        let label = ("sans-serif", 22);
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 28))
            .margin(24)
            .x_label_area_size(64)
            .y_label_area_size(100)
            .build_cartesian_2d(x.clone(), y.clone())?;
        let (of_x, of_y) = (|v: &f64| tick(*v, &x), |v: &f64| tick(*v, &y));
        let mut mesh = chart.configure_mesh();
        mesh.x_desc(&self.x).y_desc(&self.y).label_style(label).axis_desc_style(label);
        mesh.x_label_formatter(&of_x).y_label_formatter(&of_y).x_labels(8).y_labels(8).light_line_style(WHITE);
        mesh.draw()?;
        chart.draw_series(LineSeries::new(self.points.iter().copied(), BLUE.stroke_width(3)))?;
        chart.draw_series(self.points.iter().map(|&at| Circle::new(at, 4, BLUE.filled())))?;
        let middle = (0.5 * (x.start + x.end), 0.5 * (y.start + y.end));
        for mark in &self.marks {
            chart.draw_series([Circle::new(mark.at, 8, ORANGE.filled())])?;
            // Towards the middle, so that the text stays inside, and above or below the curve's end.
            let (side, right) = if mark.at.0 < middle.0 { (HPos::Left, 14) } else { (HPos::Right, -14) };
            let down = if mark.at.1 < middle.1 { 16 } else { -16 };
            let style = ("sans-serif", 20).into_font().color(&GREY).pos(Pos::new(side, VPos::Center));
            let text = EmptyElement::at(mark.at) + Text::new(mark.label.clone(), (right, down), style);
            chart.draw_series([text])?;
        }
        area.present()?;
        Ok(())
    }
}
