//! What is on a picture: lines, areas, discs and text at places in pixels, from the upper left corner. Every kind of picture
//! is drawn onto this, and each file format is made from it, so that all formats show the same.

use super::font;

/// A place, in pixels to the right of and below the upper left corner.
pub(super) type Place = (f64, f64);

/// A finished picture, to be written as SVG or PNG.
#[derive(Clone, Debug)]
pub struct Canvas {
    pub(super) width: f64,
    pub(super) height: f64,
    /// What readers that do not see are told.
    pub(super) title: String,
    pub(super) shapes: Vec<Shape>,
}

/// A colour by its purpose, so that a page may choose light or dark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ink {
    /// Text and axes.
    Text,
    /// What is less important.
    Muted,
    /// Grid lines.
    Grid,
    /// What lies behind everything.
    Paper,
    /// One of the palette, counted around.
    Hue(usize),
}

/// How a line is interrupted: lengths of dashes and gaps in pixels.
pub(super) type Dash = &'static [f64];

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    pub(super) ink: Ink,
    pub(super) width: f64,
    pub(super) dash: Dash,
}

/// Which point of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// One thing on the canvas; later ones cover earlier ones.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A line through points.
    Line { points: Vec<Place>, closed: bool, stroke: Stroke },
    /// A filled polygon.
    Area { points: Vec<Place>, ink: Ink, edge: Option<Stroke> },
    /// A rectangle without an edge, its sides on whole pixels where its corners are.
    Cell { corner: Place, size: Place, ink: Ink },
    /// A filled circle.
    Disc { at: Place, radius: f64, ink: Ink, edge: Option<Stroke> },
    /// One line of text; its baseline goes through the place.
    Text { at: Place, text: String, size: f64, anchor: Anchor, ink: Ink, upwards: bool },
}

impl Canvas {
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), shapes: Vec::new() }
    }

    pub(super) fn line(&mut self, points: Vec<Place>, stroke: Stroke) {
        let points = thinned(points);
        if points.len() > 1 {
            self.shapes.push(Shape::Line { points, closed: false, stroke });
        }
    }

    pub(super) fn outline(&mut self, points: Vec<Place>, stroke: Stroke) {
        self.shapes.push(Shape::Line { points, closed: true, stroke });
    }

    pub(super) fn area(&mut self, points: Vec<Place>, ink: Ink, edge: Option<Stroke>) {
        self.shapes.push(Shape::Area { points, ink, edge });
    }

    pub(super) fn cell(&mut self, corner: Place, size: Place, ink: Ink) {
        self.shapes.push(Shape::Cell { corner, size, ink });
    }

    pub(super) fn disc(&mut self, at: Place, radius: f64, ink: Ink, edge: Option<Stroke>) {
        self.shapes.push(Shape::Disc { at, radius, ink, edge });
    }

    pub(super) fn text(&mut self, at: Place, text: &str, size: f64, anchor: Anchor, ink: Ink) {
        self.shapes.push(Shape::Text { at, text: text.to_owned(), size, anchor, ink, upwards: false });
    }

    /// Text that is read from below.
    pub(super) fn upwards(&mut self, at: Place, text: &str, size: f64, ink: Ink) {
        self.shapes.push(Shape::Text { at, text: text.to_owned(), size, anchor: Anchor::Middle, ink, upwards: true });
    }

    /// Text on a background, so that it can be read on lines.
    pub(super) fn label(&mut self, at: Place, text: &str, size: f64, anchor: Anchor, ink: Ink) {
        let width = font::width(text, size);
        let left = match anchor {
            Anchor::Start => at.0,
            Anchor::Middle => at.0 - width / 2.0,
            Anchor::End => at.0 - width,
        };
        self.cell((left - 2.0, at.1 - 0.95 * size), (width + 4.0, 1.25 * size), Ink::Paper);
        self.text(at, text, size, anchor, ink);
    }
}

/// Without the points that lie within a tenth of a pixel of their neighbours' line: they cannot be seen.
fn thinned(points: Vec<Place>) -> Vec<Place> {
    const UNSEEN: f64 = 0.05;
    let mut kept: Vec<Place> = Vec::with_capacity(points.len().min(4096));
    let mut skipped: Vec<Place> = Vec::new();
    for point in points {
        // The line from the last point kept to this one must pass all the points between them.
        if let Some(&from) = kept.last()
            && skipped.len() < 64
            && skipped.iter().all(|&p| distance(p, from, point) < UNSEEN)
        {
            skipped.push(point);
            continue;
        }
        kept.extend(skipped.last().copied());
        skipped.clear();
        if kept.is_empty() { kept.push(point) } else { skipped.push(point) }
    }
    kept.extend(skipped.last().copied());
    kept
}

/// Of a point from the stretch between two others.
fn distance(p: Place, a: Place, b: Place) -> f64 {
    let (along, to) = ((b.0 - a.0, b.1 - a.1), (p.0 - a.0, p.1 - a.1));
    let square = along.0 * along.0 + along.1 * along.1;
    let share = if square > 0.0 { ((along.0 * to.0 + along.1 * to.1) / square).clamp(0.0, 1.0) } else { 0.0 };
    (to.0 - share * along.0).hypot(to.1 - share * along.1)
}
