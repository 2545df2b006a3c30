//! Multipliers in the complex plane, with the unit circle: inside is stable.

use super::axis::{drawable, extent};
use super::canvas::{Anchor, Canvas, Ink, Stroke};
use super::frame::{self, Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, SMALL, Sample, Sides};
use super::{Picture, palette};

/// Multipliers and the unit circle.
#[derive(Clone, Debug, Default)]
pub struct Circle {
    /// Above the picture.
    pub title: String,
    /// One of a gait, or several to be compared.
    pub groups: Vec<Multipliers>,
}

/// Multipliers of one gait, or of one gait along a parameter.
#[derive(Clone, Debug, Default)]
pub struct Multipliers {
    /// For the legend.
    pub name: String,
    /// Real and imaginary parts.
    pub values: Vec<(f64, f64)>,
}

const SIZE: f64 = 440.0;
const UNIT: Stroke = Stroke { ink: Ink::Text, width: 1.5, dash: &[] };

impl Circle {
    fn values(&self) -> impl Iterator<Item = (f64, f64)> {
        let all = self.groups.iter().flat_map(|g| g.values.iter().copied());
        all.filter(|v| drawable(v.0) && drawable(v.1))
    }

    fn legend(&self) -> Vec<(String, Sample)> {
        let groups = self.groups.iter().enumerate().filter(|(_, g)| !g.name.is_empty());
        let groups = groups.map(|(i, g)| (g.name.clone(), Sample::Marker(i, palette::curve(i).ink)));
        [("unit circle: stable inside".to_owned(), Sample::Line(UNIT))].into_iter().chain(groups).collect()
    }
}

impl Picture for Circle {
    fn draw(&self) -> Canvas {
        // Around the origin, so that the circle is in the middle.
        let largest = extent(self.values().flat_map(|v| [v.0.abs(), v.1.abs()])).map_or(0.0, |e| e.1);
        let end = 1.15 * largest.max(1.0);
        let y = frame::vertical((-end, end), SIZE);
        let left = frame::left_of([&y]);
        let mut canvas = Canvas::new(left + SIZE + MARGIN + 10.0, 0.0, &self.title);
        let top = frame::heading(&mut canvas, &self.title);
        let (entries, width) = (self.legend(), SIZE);
        frame::legend(&mut canvas, (left, top), width, &entries);
        let top = top + frame::legend_height(&entries, width) + if y.is_scaled() { 16.0 } else { 0.0 };
        let sides = Sides { left, right: left + SIZE, top, bottom: top + SIZE };
        canvas.height = sides.bottom + NUMBERS_BELOW + LABEL_BELOW + MARGIN;
        let frame = Frame { sides, x: frame::horizontal((-end, end), SIZE), y, indent: left };
        frame.grid(&mut canvas);
        frame.below(&mut canvas, "real part");
        frame.beside(&mut canvas, "imaginary part");
        let around = (0..180).map(|i| (f64::from(i) * std::f64::consts::PI / 90.0).sin_cos());
        canvas.outline(around.map(|(sine, cosine)| frame.at((cosine, sine))).collect(), UNIT);
        for (index, group) in self.groups.iter().enumerate() {
            for &value in group.values.iter().filter(|v| drawable(v.0) && drawable(v.1)) {
                palette::marker(&mut canvas, frame.at(value), index, 5.5, palette::curve(index).ink);
            }
        }
        if self.values().next().is_none() {
            let text = "no multipliers";
            canvas.label(frame.at((0.0, 0.0)), text, SMALL, Anchor::Middle, Ink::Muted);
        }
        canvas
    }
}
