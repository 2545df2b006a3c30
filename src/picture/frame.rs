//! A rectangle with axes that curves are drawn in, the heading above, the legend.

use super::axis::{Axis, drawable};
use super::canvas::{Anchor, Canvas, Ink, Place, Stroke};
use super::{font, palette};

/// Sizes of text in pixels.
pub(super) const TITLE: f64 = 16.0;
pub(super) const TEXT: f64 = 14.0;
pub(super) const SMALL: f64 = 13.0;

/// Around everything.
pub(super) const MARGIN: f64 = 14.0;
/// Below a frame: for the numbers of its horizontal axis, and for its label.
pub(super) const NUMBERS_BELOW: f64 = 24.0;
pub(super) const LABEL_BELOW: f64 = 24.0;

/// What a legend shows beside a name.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sample {
    Line(Stroke),
    Marker(usize, Ink),
    Cell(Ink),
}

/// The sides of a rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

/// A rectangle with axes.
pub(super) struct Frame {
    pub(super) sides: Sides,
    pub(super) x: Axis,
    pub(super) y: Axis,
    /// Room to the left of the frame.
    pub(super) indent: f64,
}

/// Axis of a horizontal side: as many ticks as their labels leave room for.
pub(super) fn horizontal(ends: (f64, f64), width: f64) -> Axis {
    let mut wished = ((width / 70.0) as usize).clamp(2, 10);
    loop {
        let axis = Axis::new(ends, wished);
        let widest = axis.ticks.iter().map(|(_, label)| font::width(label, SMALL)).fold(0.0, f64::max);
        let room = width / axis.ticks.len().max(1) as f64;
        if wished <= 2 || widest + 14.0 < room {
            return if widest + 8.0 < room { axis } else { axis.thinned() };
        }
        wished -= 1;
    }
}

/// Axis of a vertical side.
pub(super) fn vertical(ends: (f64, f64), height: f64) -> Axis {
    Axis::new(ends, ((height / 32.0) as usize).clamp(2, 10))
}

/// Room to the left of a frame: for the label, and the numbers of all vertical axes.
pub(super) fn left_of<'a>(axes: impl IntoIterator<Item = &'a Axis>) -> f64 {
    let labels = axes.into_iter().flat_map(|axis| &axis.ticks);
    let widest = labels.map(|(_, label)| font::width(label, SMALL)).fold(0.0, f64::max);
    MARGIN + 1.6 * TEXT + widest + 10.0
}

impl Frame {
    /// Where a point is.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> Place {
        let Sides { left, right, top, bottom } = self.sides;
        (left + self.x.share(x) * (right - left), bottom - self.y.share(y) * (bottom - top))
    }

    /// The middle of the frame.
    pub(super) fn middle(&self) -> Place {
        (0.5 * (self.sides.left + self.sides.right), 0.5 * (self.sides.top + self.sides.bottom))
    }

    /// Grid and edge: drawn before what stands in the frame.
    pub(super) fn grid(&self, canvas: &mut Canvas) {
        let Sides { left, right, top, bottom } = self.sides;
        let grid = palette::thin(Ink::Grid, &[]);
        for (place, _) in &self.x.ticks {
            let x = self.at((*place, self.y.low)).0;
            canvas.line(vec![(x, top), (x, bottom)], grid);
        }
        for (place, _) in &self.y.ticks {
            let y = self.at((self.x.low, *place)).1;
            canvas.line(vec![(left, y), (right, y)], grid);
        }
        canvas
            .outline(vec![(left, top), (right, top), (right, bottom), (left, bottom)], palette::thin(Ink::Muted, &[]));
    }

    /// Ticks, numbers and label of the horizontal axis.
    pub(super) fn below(&self, canvas: &mut Canvas, label: &str) {
        let Sides { left, right, bottom, .. } = self.sides;
        for (place, number) in &self.x.ticks {
            let x = self.at((*place, self.y.low)).0;
            canvas.line(vec![(x, bottom), (x, bottom + 5.0)], palette::thin(Ink::Muted, &[]));
            canvas.text((x, bottom + 6.0 + SMALL), number, SMALL, Anchor::Middle, Ink::Text);
        }
        let scaled = factor_width(&self.x);
        let baseline = bottom + NUMBERS_BELOW + TEXT + 2.0;
        let beside = if scaled > 0.0 { scaled + 8.0 } else { 0.0 };
        let label = font::fitted_label(label, TEXT, right - left - beside);
        // In the middle, or to the left where the factor needs the room.
        let middle = (0.5 * (left + right)).min(right - beside - 0.5 * font::width(&label, TEXT));
        canvas.text((middle, baseline), &label, TEXT, Anchor::Middle, Ink::Text);
        factor(canvas, &self.x, (right - scaled, baseline));
    }

    /// Ticks, numbers and label of the vertical axis.
    pub(super) fn beside(&self, canvas: &mut Canvas, label: &str) {
        let Sides { left, top, bottom, .. } = self.sides;
        for (place, number) in &self.y.ticks {
            let y = self.at((self.x.low, *place)).1;
            canvas.line(vec![(left - 5.0, y), (left, y)], palette::thin(Ink::Muted, &[]));
            canvas.text((left - 8.0, y + 0.36 * SMALL), number, SMALL, Anchor::End, Ink::Text);
        }
        let label = font::fitted_label(label, TEXT, bottom - top + 16.0);
        let baseline = left - self.indent + MARGIN + 0.9 * TEXT;
        canvas.upwards((baseline, 0.5 * (top + bottom)), &label, TEXT, Ink::Text);
        factor(canvas, &self.y, (left, top - 5.0));
    }

    /// A curve through those of the points that can be drawn: where one cannot, the curve has a gap.
    pub(super) fn curve(&self, canvas: &mut Canvas, points: &[(f64, f64)], stroke: Stroke) {
        for piece in points.split(|p| !drawable(p.0) || !drawable(p.1)) {
            match piece {
                [] => {}
                [point] => canvas.disc(self.at(*point), 3.0, stroke.ink, None),
                _ => canvas.line(piece.iter().map(|&p| self.at(p)).collect(), stroke),
            }
        }
    }

    /// What is said where there is nothing to draw.
    pub(super) fn nothing(&self, canvas: &mut Canvas) {
        let (x, y) = self.middle();
        canvas.label((x, y), "nothing to draw", TEXT, Anchor::Middle, Ink::Muted);
    }

    /// Text beside a marked place: where it stays within the frame and covers as few of the places as can be. A line leads to one that
    /// had to go far.
    pub(super) fn note(&self, canvas: &mut Canvas, at: Place, text: &str, others: &[Place]) {
        let Sides { left, right, top, bottom } = self.sides;
        let text = font::fitted(text, SMALL, 0.8 * (right - left));
        let width = font::width(&text, SMALL);
        let beside = [at.0 + 10.0, at.0 - 10.0 - width, at.0 - 0.5 * width];
        let rows = [0.36, 1.9, -1.0, 3.2, -2.3, 5.0, -4.1, 8.0, -7.1].into_iter();
        let heights = rows.map(|rows| at.1 + rows * SMALL);
        let corners = heights.flat_map(|baseline| beside.into_iter().map(move |x| (x, baseline)));
        let covers = |&(x, baseline): &Place| {
            let outside =
                x < left + 2.0 || x + width > right - 2.0 || baseline > bottom - 4.0 || baseline < top + SMALL;
            let within = |p: &&Place| {
                (x - 4.0..x + width + 4.0).contains(&p.0) && (baseline - SMALL - 2.0..baseline + 6.0).contains(&p.1)
            };
            others.iter().filter(within).count() + if outside { 1_000_000 } else { 0 }
        };
        if let Some(corner) = corners.min_by_key(covers) {
            lead(canvas, at, corner, width);
            canvas.label(corner, &text, SMALL, Anchor::Start, Ink::Text);
        }
    }
}

/// A line from a marked place to the text that belongs to it, where the two are so far apart that no one would see that it does.
fn lead(canvas: &mut Canvas, at: Place, (x, baseline): Place, width: f64) {
    let edge = if baseline > at.1 { baseline - SMALL } else { baseline + 4.0 };
    if (edge - at.1).abs() > 2.0 * SMALL {
        let end = (at.0.clamp(x, x + width), edge);
        canvas.line(vec![at, end], palette::thin(Ink::Muted, &[]));
    }
}

/// What the labels of an axis are to be multiplied by and added to: nothing where they are the values.
fn factor(canvas: &mut Canvas, axis: &Axis, (mut x, baseline): Place) {
    if axis.exponent != 0 {
        canvas.text((x, baseline), "×10", SMALL, Anchor::Start, Ink::Text);
        x += font::width("×10", SMALL) + 1.0;
        let raised = axis.exponent.to_string().replace('-', "−");
        canvas.text((x, baseline - 0.4 * SMALL), &raised, 0.75 * SMALL, Anchor::Start, Ink::Text);
        x += font::width(&raised, 0.75 * SMALL) + 5.0;
    }
    canvas.text((x, baseline), &offset(axis), SMALL, Anchor::Start, Ink::Text);
}

fn offset(axis: &Axis) -> String {
    match axis.offset {
        0.0 => String::new(),
        v if v < 0.0 => format!("− {}", -v),
        v => format!("+ {v}"),
    }
}

/// Room that this takes.
pub(super) fn factor_width(axis: &Axis) -> f64 {
    let raised = axis.exponent.to_string();
    let power = font::width("×10", SMALL) + font::width(&raised, 0.75 * SMALL) + 8.0;
    font::width(&offset(axis), SMALL) + if axis.exponent == 0 { 0.0 } else { power }
}

/// The title; returns where the next thing may begin.
pub(super) fn heading(canvas: &mut Canvas, title: &str) -> f64 {
    let text = font::fitted(title, TITLE, canvas.width - 2.0 * MARGIN);
    canvas.text((0.5 * canvas.width, MARGIN + TITLE), &text, TITLE, Anchor::Middle, Ink::Text);
    heading_height(title)
}

/// Width that a title takes.
pub(super) fn heading_width(title: &str) -> f64 {
    font::width(title, TITLE) + 2.0 * MARGIN
}

/// Where the next thing may begin below a title.
pub(super) fn heading_height(title: &str) -> f64 {
    if title.is_empty() { MARGIN } else { MARGIN + TITLE + 10.0 }
}

const LEGEND_ROW: f64 = 20.0;
const SAMPLE: f64 = 28.0;

/// Names and samples in rows, each no wider than that: places from the upper left corner, and the height of all.
fn rows(entries: &[(String, Sample)], width: f64) -> (Vec<(Place, String)>, f64) {
    let (mut x, mut row, mut places) = (0.0, 0.0, Vec::new());
    for (name, _) in entries {
        let name = font::fitted(name, SMALL, width - SAMPLE - 6.0);
        let wide = SAMPLE + 6.0 + font::width(&name, SMALL);
        if x > 0.0 && x + wide > width {
            (x, row) = (0.0, row + 1.0);
        }
        places.push(((x, row * LEGEND_ROW), name));
        x += wide + 18.0;
    }
    (places, if entries.is_empty() { 0.0 } else { (row + 1.0) * LEGEND_ROW })
}

/// Width of the widest entry of a legend.
pub(super) fn legend_width(entries: &[(String, Sample)]) -> f64 {
    entries.iter().map(|(name, _)| SAMPLE + 6.0 + font::width(name, SMALL)).fold(0.0, f64::max)
}

/// Height of a legend of that width.
pub(super) fn legend_height(entries: &[(String, Sample)], width: f64) -> f64 {
    rows(entries, width).1
}

/// A legend from its upper left corner.
pub(super) fn legend(canvas: &mut Canvas, (left, top): Place, width: f64, entries: &[(String, Sample)]) {
    let (places, _) = rows(entries, width);
    for ((place, name), (_, sample)) in places.iter().zip(entries) {
        let (x, middle) = (left + place.0, top + place.1 + 0.5 * LEGEND_ROW);
        match *sample {
            Sample::Line(stroke) => canvas.line(vec![(x, middle), (x + SAMPLE, middle)], stroke),
            Sample::Marker(kind, ink) => palette::marker(canvas, (x + SAMPLE - 8.0, middle), kind, 5.0, ink),
            Sample::Cell(ink) => canvas.cell((x + SAMPLE - 14.0, middle - 7.0), (14.0, 14.0), ink),
        }
        canvas.text((x + SAMPLE + 6.0, middle + 0.36 * SMALL), name, SMALL, Anchor::Start, Ink::Text);
    }
}
