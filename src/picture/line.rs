//! One curve of points in the plane, with marked places.

use super::axis::{aired, extent};
use super::canvas::{Canvas, Ink};
use super::frame::{Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, Sides, heading, horizontal, left_of, vertical};
use super::{Mark, Picture, palette};

/// A curve over an axis, both in the units that their labels name.
#[derive(Clone, Debug, Default)]
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

impl Picture for Line {
    fn draw(&self) -> Canvas {
        let mut canvas = Canvas::new(720.0, 480.0, &self.title);
        let top = heading(&mut canvas, &self.title);
        let bottom = canvas.height - MARGIN - NUMBERS_BELOW - LABEL_BELOW;
        let all = || self.points.iter().chain(self.marks.iter().map(|mark| &mark.at));
        let y = vertical(aired(extent(all().map(|p| p.1)), 0.06), bottom - top);
        let top = if y.factor.is_empty() { top } else { top + 14.0 };
        let sides = Sides { left: left_of([&y]), right: canvas.width - MARGIN - 10.0, top, bottom };
        let x = horizontal(aired(extent(all().map(|p| p.0)), 0.06), sides.right - sides.left);
        let frame = Frame { sides, x, y };
        frame.grid(&mut canvas);
        frame.below(&mut canvas, &self.x);
        frame.beside(&mut canvas, &self.y);
        frame.curve(&mut canvas, &self.points, palette::curve(0));
        // Points that stand apart are shown; a dense curve is just a curve.
        if self.points.len() <= 60 {
            for &point in self.points.iter().filter(|p| p.0.is_finite() && p.1.is_finite()) {
                palette::marker(&mut canvas, frame.at(point), 0, 4.0, Ink::Hue(0));
            }
        }
        for mark in &self.marks {
            palette::marker(&mut canvas, frame.at(mark.at), 3, 6.0, Ink::Hue(1));
            frame.note(&mut canvas, frame.at(mark.at), &mark.label);
        }
        if self.points.is_empty() {
            frame.nothing(&mut canvas);
        }
        canvas
    }
}
