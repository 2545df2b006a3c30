//! Curves over time (or anything else) in panels above each other that share the horizontal axis.

use super::axis::{Axis, aired, drawable, extent};
use super::canvas::{Anchor, Canvas, Ink, Stroke};
use super::frame::{self, Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, SMALL, Sample, Sides};
use super::{Picture, font, palette};

/// Stacked panels over one axis.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// Above the picture.
    pub title: String,
    /// Below the horizontal axis, with its unit.
    pub x: String,
    /// From above; curves of one panel share a unit.
    pub panels: Vec<Panel>,
    /// Vertical lines through all panels.
    pub events: Vec<Event>,
}

/// Curves over one vertical axis.
#[derive(Clone, Debug, Default)]
pub struct Panel {
    /// Beside the vertical axis, with its unit.
    pub y: String,
    /// What is drawn, in the order of the legend.
    pub curves: Vec<Curve>,
    /// Horizontal lines.
    pub levels: Vec<Level>,
}

/// A curve with its name.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// For the legend; a curve without a name is not in it.
    pub name: String,
    /// In order; a point that is not finite makes a gap.
    pub points: Vec<(f64, f64)>,
}

/// A reference value: a horizontal line over the whole panel.
#[derive(Clone, Debug, Default)]
pub struct Level {
    /// For the legend; a level without a name is not in it.
    pub name: String,
    /// Where, on the vertical axis.
    pub value: f64,
    /// Which of the panel's curves it belongs to, whose colour it then has.
    pub curve: Option<usize>,
}

/// A vertical line through all panels.
#[derive(Clone, Debug, Default)]
pub struct Event {
    /// Where, on the horizontal axis.
    pub at: f64,
    /// Above the uppermost panel, unless it would stand on another one.
    pub label: String,
}

const WIDTH: f64 = 720.0;
const GAP: f64 = 14.0;

impl Panel {
    /// The levels of each curve have the same dashes in the same order; one without a name those of the level before it.
    fn level(&self, index: usize) -> Stroke {
        let level = &self.levels[index];
        let before = self.levels.iter().take(index + 1).filter(|l| l.curve == level.curve && !l.name.is_empty());
        palette::level(before.count().saturating_sub(1), level.curve.unwrap_or(self.curves.len() + index))
    }

    fn legend(&self) -> Vec<(String, Sample)> {
        let curves = self.curves.iter().enumerate().map(|(i, c)| (c.name.clone(), Sample::Line(palette::curve(i))));
        let levels = self.levels.iter().enumerate().map(|(i, l)| (l.name.clone(), Sample::Line(self.level(i))));
        curves.chain(levels).filter(|(name, _)| !name.is_empty()).collect()
    }

    fn height(&self, panels: usize) -> f64 {
        if panels == 1 { 340.0 } else { (560.0 / panels as f64).max(130.0) }
    }

    fn is_empty(&self) -> bool {
        extent(self.curves.iter().flat_map(|c| c.points.iter().filter(|p| p.0.is_finite()).map(|p| p.1))).is_none()
    }

    /// Range of the values of curves and levels.
    fn ends(&self) -> (f64, f64) {
        let curves = self.curves.iter().flat_map(|c| c.points.iter().map(|p| p.1));
        aired(extent(curves.chain(self.levels.iter().map(|l| l.value))), 0.06)
    }
}

impl Picture for Series {
    fn draw(&self) -> Canvas {
        let nothing = [Panel::default()];
        let panels = if self.panels.is_empty() { &nothing[..] } else { &self.panels[..] };
        let mut canvas = Canvas::new(WIDTH, 0.0, &self.title);
        let mut top = frame::heading(&mut canvas, &self.title);
        let points = panels.iter().flat_map(|p| p.curves.iter().flat_map(|c| c.points.iter().map(|p| p.0)));
        let span = extent(points.chain(self.events.iter().map(|e| e.at)));
        let heights: Vec<f64> = panels.iter().map(|p| p.height(panels.len())).collect();
        let axes: Vec<_> = panels.iter().zip(&heights).map(|(p, &h)| frame::vertical(p.ends(), h)).collect();
        let (left, right) = (frame::left_of(&axes), WIDTH - MARGIN - 10.0);
        let x = frame::horizontal(aired(span, 0.0), right - left);
        for (index, ((panel, y), height)) in panels.iter().zip(axes).zip(heights).enumerate() {
            let entries = panel.legend();
            frame::legend(&mut canvas, (left, top), right - left, &entries);
            top += frame::legend_height(&entries, right - left) + if y.is_scaled() { 18.0 } else { 2.0 };
            let scaled = if y.is_scaled() { frame::factor_width(&y) + 8.0 } else { 0.0 };
            if index == 0 && self.events.iter().any(|e| !e.label.is_empty()) {
                top += if y.is_scaled() { 0.0 } else { SMALL + 5.0 };
                self.event_labels(&mut canvas, &x, (left + scaled, left, right, top));
            }
            let sides = Sides { left, right, top, bottom: top + height };
            let frame = Frame { sides, x: x.clone(), y, indent: left };
            self.panel(&mut canvas, panel, &frame);
            if index + 1 == panels.len() {
                frame.below(&mut canvas, &self.x);
            }
            top += height + GAP;
        }
        canvas.height = top - GAP + NUMBERS_BELOW + LABEL_BELOW + MARGIN;
        canvas
    }
}

impl Series {
    fn panel(&self, canvas: &mut Canvas, panel: &Panel, frame: &Frame) {
        frame.grid(canvas);
        frame.beside(canvas, &panel.y);
        let Sides { left, right, top, bottom } = frame.sides;
        for event in self.events.iter().filter(|e| drawable(e.at)) {
            let x = frame.at((event.at, frame.y.low)).0;
            canvas.line(vec![(x, top), (x, bottom)], palette::thin(Ink::Muted, &[3.0, 3.0]));
        }
        for (index, level) in panel.levels.iter().enumerate().filter(|(_, l)| drawable(l.value)) {
            let y = frame.at((frame.x.low, level.value)).1;
            canvas.line(vec![(left, y), (right, y)], panel.level(index));
        }
        for (index, curve) in panel.curves.iter().enumerate() {
            frame.curve(canvas, &curve.points, palette::curve(index));
        }
        if panel.is_empty() {
            frame.nothing(canvas);
        }
    }

    /// Labels of events above the uppermost panel: those that would stand on another one are left out.
    fn event_labels(&self, canvas: &mut Canvas, x: &Axis, (free, left, right, top): (f64, f64, f64, f64)) {
        let mut free = free;
        for event in self.events.iter().filter(|e| drawable(e.at) && !e.label.is_empty()) {
            let text = font::fitted(&event.label, SMALL, 0.5 * (right - left));
            let width = font::width(&text, SMALL);
            let middle = left + x.share(event.at) * (right - left);
            let start = (middle - 0.5 * width).min(right - width);
            if start >= free {
                canvas.text((start, top - 5.0), &text, SMALL, Anchor::Start, Ink::Muted);
                free = start + width + 8.0;
            }
        }
    }
}
