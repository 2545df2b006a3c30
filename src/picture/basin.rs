//! Cells of a grid coloured by class, with a legend: which starts lead where.

use super::axis::{aired, drawable, extent};
use super::canvas::{Canvas, Ink};
use super::frame::{self, Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, Sample, Sides};
use super::{Mark, Picture, palette};

/// A grid of cells, each of one class.
#[derive(Clone, Debug, Default)]
pub struct Basin {
    /// Above the picture.
    pub title: String,
    /// Below the horizontal axis, with its unit.
    pub x: String,
    /// Beside the vertical axis, with its unit.
    pub y: String,
    /// The grid's outer edges, left and right.
    pub x_range: (f64, f64),
    /// The grid's outer edges, below and above.
    pub y_range: (f64, f64),
    /// Number of cells side by side.
    pub columns: usize,
    /// Class of each cell as an index into `classes`: rows from below, each from the left. Other indices stay empty.
    pub cells: Vec<usize>,
    /// Names for the legend, which lists those that have cells.
    pub classes: Vec<String>,
    /// Marked places, such as gaits.
    pub marks: Vec<Mark>,
}

impl Picture for Basin {
    fn draw(&self) -> Canvas {
        let mut canvas = Canvas::new(620.0, 0.0, &self.title);
        let top = frame::heading(&mut canvas, &self.title);
        let range = |(a, b): (f64, f64)| aired(extent([a, b]), 0.0);
        let y = frame::vertical(range(self.y_range), 480.0);
        let (left, right) = (frame::left_of([&y]), canvas.width - MARGIN - 10.0);
        let entries = self.legend();
        frame::legend(&mut canvas, (left, top), right - left, &entries);
        let top = top + frame::legend_height(&entries, right - left) + if y.is_scaled() { 18.0 } else { 4.0 };
        let sides = Sides { left, right, top, bottom: top + 480.0 };
        canvas.height = sides.bottom + NUMBERS_BELOW + LABEL_BELOW + MARGIN;
        let frame = Frame { sides, x: frame::horizontal(range(self.x_range), right - left), y, indent: left };
        frame.grid(&mut canvas);
        self.fill(&mut canvas, &frame);
        frame.below(&mut canvas, &self.x);
        frame.beside(&mut canvas, &self.y);
        let marks: Vec<_> = self.marks.iter().map(|m| frame.at(m.at)).collect();
        for mark in self.marks.iter().filter(|m| drawable(m.at.0) && drawable(m.at.1)) {
            palette::marker(&mut canvas, frame.at(mark.at), 3, 6.0, Ink::Text);
            frame.note(&mut canvas, frame.at(mark.at), &mark.label, &marks);
        }
        if self.cells.is_empty() || self.columns == 0 {
            frame.nothing(&mut canvas);
        }
        canvas
    }
}

impl Basin {
    fn legend(&self) -> Vec<(String, Sample)> {
        let named = self.classes.iter().enumerate().filter(|(i, _)| self.cells.contains(i));
        named.map(|(i, name)| (name.clone(), Sample::Cell(ink(i)))).collect()
    }

    /// One rectangle for neighbours of the same class.
    fn fill(&self, canvas: &mut Canvas, frame: &Frame) {
        if self.columns == 0 {
            return;
        }
        let rows = self.cells.len().div_ceil(self.columns);
        let Sides { left, right, top, bottom } = frame.sides;
        let (wide, high) = ((right - left) / self.columns as f64, (bottom - top) / rows as f64);
        for (row, cells) in self.cells.chunks(self.columns).enumerate() {
            let mut first = 0;
            for same in cells.chunk_by(|a, b| a == b) {
                let corner = (left + first as f64 * wide, bottom - (row + 1) as f64 * high);
                if same[0] < self.classes.len() {
                    canvas.cell(corner, (same.len() as f64 * wide, high), ink(same[0]));
                }
                first += same.len();
            }
        }
    }
}

/// Areas may have the yellow, too; after the palette, greys.
fn ink(class: usize) -> Ink {
    match class {
        c if c < 7 => Ink::Hue([0, 1, 5, 4, 2, 3, 6][c]),
        _ => Ink::Muted,
    }
}
