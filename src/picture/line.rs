//! One curve of points in the plane, with marked places.

use super::axis::{aired, drawable, extent};
use super::canvas::{Canvas, Ink, Place};
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
        let top = if y.is_scaled() { top + 14.0 } else { top };
        let indent = left_of([&y]);
        let sides = Sides { left: indent, right: canvas.width - MARGIN - 10.0, top, bottom };
        let x = horizontal(aired(extent(all().map(|p| p.0)), 0.06), sides.right - sides.left);
        let frame = Frame { sides, x, y, indent };
        frame.grid(&mut canvas);
        frame.below(&mut canvas, &self.x);
        frame.beside(&mut canvas, &self.y);
        frame.curve(&mut canvas, &self.points, palette::curve(0));
        // Points that stand apart are shown; a dense curve is just a curve.
        if self.points.len() <= 60 {
            for &point in self.points.iter().filter(|p| drawable(p.0) && drawable(p.1)) {
                palette::marker(&mut canvas, frame.at(point), 0, 4.0, Ink::Hue(0));
            }
        }
        let mut taken = along(&self.points.iter().map(|&p| frame.at(p)).collect::<Vec<_>>());
        taken.extend(self.marks.iter().map(|mark| frame.at(mark.at)));
        for mark in self.marks.iter().filter(|m| drawable(m.at.0) && drawable(m.at.1)) {
            palette::marker(&mut canvas, frame.at(mark.at), 3, 6.0, Ink::Hue(1));
            frame.note(&mut canvas, frame.at(mark.at), &mark.label, &taken);
        }
        if !self.points.iter().any(|p| drawable(p.0) && drawable(p.1)) {
            frame.nothing(&mut canvas);
        }
        canvas
    }
}

/// Places on the lines between neighbours, close enough that no text fits between them.
fn along(points: &[Place]) -> Vec<Place> {
    let pieces = points.windows(2).flat_map(|pair| {
        let (from, to) = (pair[0], pair[1]);
        let parts = ((to.0 - from.0).hypot(to.1 - from.1) / 6.0).clamp(1.0, 200.0) as usize;
        (0..=parts).map(move |i| {
            let share = i as f64 / parts as f64;
            (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
        })
    });
    pieces.collect()
}
