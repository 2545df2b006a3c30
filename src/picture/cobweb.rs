//! Return maps with the steps of an orbit: one coordinate against its next value.

use super::axis::{Axis, aired, drawable, extent};
use super::canvas::{Canvas, Ink, Stroke};
use super::frame::{self, Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, Sample, Sides};
use super::{Picture, palette};

/// Return maps side by side.
#[derive(Clone, Debug, Default)]
pub struct Cobweb {
    /// Above the picture.
    pub title: String,
    /// One for each coordinate that is shown.
    pub maps: Vec<Return>,
}

/// A coordinate against its next value.
#[derive(Clone, Debug, Default)]
pub struct Return {
    /// Below the horizontal axis, with its unit: the value.
    pub x: String,
    /// Beside the vertical axis, with its unit: the next value.
    pub y: String,
    /// The map as a curve, where the next value depends on this coordinate alone; else empty.
    pub curve: Vec<(f64, f64)>,
    /// The values that an orbit goes through, from its start: drawn as a cobweb.
    pub iterates: Vec<f64>,
    /// Fixed points.
    pub fixed: Vec<f64>,
}

const SIZE: f64 = 420.0;
/// Most maps side by side: with more of them numbers would be too small on a page.
const BESIDE: usize = 2;

impl Return {
    fn ends(&self) -> (f64, f64) {
        let curve = self.curve.iter().filter(|p| drawable(p.0) && drawable(p.1)).flat_map(|p| [p.0, p.1]);
        aired(extent(curve.chain(self.iterates.iter().copied()).chain(self.fixed.iter().copied())), 0.06)
    }

    fn draw(&self, canvas: &mut Canvas, frame: &Frame) {
        frame.grid(canvas);
        frame.below(canvas, &self.x);
        frame.beside(canvas, &self.y);
        let (low, high) = (frame.x.low, frame.x.high);
        frame.curve(canvas, &[(low, low), (high, high)], DIAGONAL);
        frame.curve(canvas, &self.cobweb(), ORBIT);
        frame.curve(canvas, &self.curve, palette::curve(0));
        // Where the curve is not known, the points that are known of it are shown.
        if self.curve.is_empty() {
            for pair in self.iterates.windows(2).filter(|pair| drawable(pair[0]) && drawable(pair[1])) {
                palette::marker(canvas, frame.at((pair[0], pair[1])), 0, 3.5, Ink::Hue(0));
            }
        }
        for &value in self.fixed.iter().filter(|&&v| drawable(v)) {
            palette::marker(canvas, frame.at((value, value)), 3, 6.0, Ink::Hue(2));
        }
        if self.curve.is_empty() && self.iterates.is_empty() && self.fixed.is_empty() {
            frame.nothing(canvas);
        }
    }

    /// From the diagonal to the map and back.
    fn cobweb(&self) -> Vec<(f64, f64)> {
        let start = self.iterates.first().map(|&first| (first, first));
        let steps = self.iterates.windows(2).flat_map(|pair| [(pair[0], pair[1]), (pair[1], pair[1])]);
        start.into_iter().chain(steps).collect()
    }
}

const DIAGONAL: Stroke = Stroke { ink: Ink::Muted, width: 1.0, dash: &[5.0, 3.0] };
const ORBIT: Stroke = Stroke { ink: Ink::Hue(1), width: 1.2, dash: &[] };

impl Picture for Cobweb {
    fn draw(&self) -> Canvas {
        let nothing = [Return::default()];
        let maps = if self.maps.is_empty() { &nothing[..] } else { &self.maps[..] };
        let beside = maps.len().min(BESIDE);
        let axes: Vec<_> = maps.iter().map(|m| frame::vertical(m.ends(), SIZE)).collect();
        let indent = frame::left_of(&axes);
        let (wide, high) = (indent + SIZE + 10.0, SIZE + NUMBERS_BELOW + LABEL_BELOW + 8.0);
        let mut canvas = Canvas::new(beside as f64 * wide + MARGIN, 0.0, &self.title);
        let top = frame::heading(&mut canvas, &self.title);
        let (entries, width) = (self.legend(), canvas.width - indent - MARGIN);
        frame::legend(&mut canvas, (indent, top), width, &entries);
        let above = if axes.iter().any(Axis::is_scaled) { 18.0 } else { 2.0 };
        let top = top + frame::legend_height(&entries, width);
        for (index, (map, y)) in maps.iter().zip(axes).enumerate() {
            let left = (index % beside) as f64 * wide + indent;
            let top = top + (index / beside) as f64 * (high + above) + above;
            let sides = Sides { left, right: left + SIZE, top, bottom: top + SIZE };
            map.draw(&mut canvas, &Frame { sides, x: frame::horizontal(map.ends(), SIZE), y, indent });
        }
        canvas.height = top + maps.len().div_ceil(beside) as f64 * (high + above) + MARGIN - 8.0;
        canvas
    }
}

impl Cobweb {
    fn legend(&self) -> Vec<(String, Sample)> {
        let has = |of: fn(&Return) -> bool| self.maps.iter().any(of);
        let all = [
            (has(|m| !m.curve.is_empty()), "return map", Sample::Line(palette::curve(0))),
            (has(|m| m.iterates.len() > 1), "orbit", Sample::Line(ORBIT)),
            (true, "next value = value", Sample::Line(DIAGONAL)),
            (has(|m| !m.fixed.is_empty()), "gait", Sample::Marker(3, Ink::Hue(2))),
        ];
        all.into_iter().filter(|(shown, ..)| *shown).map(|(_, name, sample)| (name.to_owned(), sample)).collect()
    }
}
