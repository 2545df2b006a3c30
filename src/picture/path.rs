//! Places in the plane, to the same scale in both directions.

use super::axis::{Axis, aired, drawable, extent};
use super::canvas::{Canvas, Ink, Stroke};
use super::frame::{self, Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, Sample, Sides};
use super::{Curve, Picture, palette};

/// Curves, stretches and places in a plane with equal scales: the path of a centre of mass, legs, attachment points.
#[derive(Clone, Debug, Default)]
pub struct Path {
    /// Above the picture.
    pub title: String,
    /// Below the horizontal axis, with its unit, which both axes share.
    pub x: String,
    /// Beside the vertical axis, with its unit.
    pub y: String,
    /// Lines through points.
    pub curves: Vec<Curve>,
    /// Straight pieces, below the curves.
    pub stretches: Vec<Stretches>,
    /// Marked places, above the curves.
    pub places: Vec<Places>,
}

/// Straight pieces of one kind, such as legs.
#[derive(Clone, Debug, Default)]
pub struct Stretches {
    /// For the legend.
    pub name: String,
    /// From where to where.
    pub ends: Vec<[(f64, f64); 2]>,
}

/// Places of one kind, such as attachment points.
#[derive(Clone, Debug, Default)]
pub struct Places {
    /// For the legend.
    pub name: String,
    /// Where.
    pub at: Vec<(f64, f64)>,
}

const LARGEST: (f64, f64) = (720.0, 720.0);
const SMALLEST: f64 = 160.0;
/// The widest legend that stands beside a frame.
const LEGEND_BESIDE: f64 = 220.0;
/// Room above a frame for the power of ten of its vertical axis.
const FACTOR: f64 = 18.0;
/// An extent that is a smaller part of the other than this is widened to it.
const SLIMMEST: f64 = 0.02;

impl Path {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        let curves = self.curves.iter().flat_map(|c| c.points.iter().copied());
        let stretches = self.stretches.iter().flat_map(|s| s.ends.iter().flatten().copied());
        let all = curves.chain(stretches).chain(self.places.iter().flat_map(|p| p.at.iter().copied()));
        all.filter(|p| drawable(p.0) && drawable(p.1))
    }

    fn stretch(index: usize) -> Stroke {
        Stroke { ink: Ink::Muted, width: 1.0, dash: [&[][..], &[4.0, 3.0]][index % 2] }
    }

    fn legend(&self) -> Vec<(String, Sample)> {
        let curves = self.curves.iter().enumerate().map(|(i, c)| (&c.name, Sample::Line(palette::curve(i))));
        let stretches = self.stretches.iter().enumerate().map(|(i, s)| (&s.name, Sample::Line(Self::stretch(i))));
        let places = self.places.iter().enumerate().map(|(i, p)| (&p.name, Sample::Marker(i, self.ink(i))));
        let all = curves.chain(stretches).chain(places).map(|(name, sample)| (name.clone(), sample));
        all.filter(|(name, _)| !name.is_empty()).collect()
    }

    /// Places have colours that no curve has.
    fn ink(&self, index: usize) -> Ink {
        palette::curve(self.curves.len() + index).ink
    }
}

impl Picture for Path {
    fn draw(&self) -> Canvas {
        let mut canvas = Canvas::new(LARGEST.0, 0.0, &self.title);
        let ends = |of: fn((f64, f64)) -> f64| extent(self.points().map(of));
        let fit = fitted(ends(|p| p.0), ends(|p| p.1));
        let top = frame::heading_height(&self.title);
        let y = Axis::new(fit.y, ((fit.size.1 / 45.0) as usize).clamp(2, 12));
        let indent = frame::left_of([&y]);
        let entries = self.legend();
        // Beside a narrow frame there is room for the legend, above it there is none.
        let narrow = fit.size.0 < 0.6 * LARGEST.0;
        let names = if narrow { frame::legend_width(&entries).min(LEGEND_BESIDE) } else { fit.size.0 };
        let above = if narrow { 0.0 } else { frame::legend_height(&entries, names) };
        let heading = top;
        let top = top + above + if y.is_scaled() { FACTOR } else { 0.0 };
        let sides = Sides { left: indent, right: indent + fit.size.0, top, bottom: top + fit.size.1 };
        let beside = if narrow && !entries.is_empty() { MARGIN + names } else { 0.0 };
        let title = frame::heading_width(&self.title).min(LARGEST.0);
        canvas.width = (sides.right + 2.0 * MARGIN + beside).max(title);
        canvas.height = sides.bottom + NUMBERS_BELOW + LABEL_BELOW + MARGIN;
        let corner = if narrow { (sides.right + MARGIN, top) } else { (indent, heading) };
        frame::heading(&mut canvas, &self.title);
        if narrow {
            for (row, entry) in entries.iter().enumerate() {
                frame::legend(
                    &mut canvas,
                    (corner.0, corner.1 + 22.0 * row as f64),
                    names,
                    std::slice::from_ref(entry),
                );
            }
        } else {
            frame::legend(&mut canvas, corner, names, &entries);
        }
        let frame = Frame { sides, x: frame::horizontal(fit.x, fit.size.0), y, indent };
        frame.grid(&mut canvas);
        frame.below(&mut canvas, &self.x);
        frame.beside(&mut canvas, &self.y);
        self.contents(&mut canvas, &frame);
        canvas
    }
}

impl Path {
    fn contents(&self, canvas: &mut Canvas, frame: &Frame) {
        for (index, stretches) in self.stretches.iter().enumerate() {
            for ends in &stretches.ends {
                frame.curve(canvas, ends, Self::stretch(index));
            }
        }
        for (index, curve) in self.curves.iter().enumerate() {
            frame.curve(canvas, &curve.points, palette::curve(index));
        }
        for (index, places) in self.places.iter().enumerate() {
            for &place in places.at.iter().filter(|p| drawable(p.0) && drawable(p.1)) {
                palette::marker(canvas, frame.at(place), index, 4.5, self.ink(index));
            }
        }
        if self.points().next().is_none() {
            frame.nothing(canvas);
        }
    }
}

/// Ends of both axes, and the frame's size, with one scale.
struct Fit {
    x: (f64, f64),
    y: (f64, f64),
    size: (f64, f64),
}

/// The largest frame with one scale; a narrow extent is widened, so that there is room for its axis.
fn fitted(x: Option<(f64, f64)>, y: Option<(f64, f64)>) -> Fit {
    let length = |ends: Option<(f64, f64)>| ends.map_or(0.0, |(low, high)| high - low);
    let slimmest = SLIMMEST * length(x).max(length(y));
    let thick = |ends: Option<(f64, f64)>| match ends {
        Some((low, high)) if high - low < slimmest => {
            let more = 0.5 * (slimmest - (high - low));
            Some((low - more, high + more))
        }
        other => other,
    };
    let (mut x, mut y) = (aired(thick(x), 0.05), aired(thick(y), 0.05));
    let room = (LARGEST.0 - 120.0, LARGEST.1 - 120.0);
    let (wide, high) = (x.1 - x.0, y.1 - y.0);
    let scale = (room.0 / wide).min(room.1 / high);
    let size = ((wide * scale).max(SMALLEST), (high * scale).max(SMALLEST));
    let widen = |ends: &mut (f64, f64), size: f64| {
        let more = 0.5 * (size / scale - (ends.1 - ends.0));
        *ends = (ends.0 - more, ends.1 + more);
    };
    widen(&mut x, size.0);
    widen(&mut y, size.1);
    Fit { x, y, size }
}
