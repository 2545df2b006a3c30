//! Bifurcation diagrams: branches over a parameter with stable and unstable pieces.

use super::axis::{aired, drawable, extent};
use super::canvas::{Canvas, Ink, Stroke};
use super::frame::{self, Frame, LABEL_BELOW, MARGIN, NUMBERS_BELOW, Sample, Sides};
use super::{Mark, Picture, palette};

/// Branches over a parameter: full lines where gaits are stable, dashed where they are not.
#[derive(Clone, Debug, Default)]
pub struct Branches {
    /// Above the picture.
    pub title: String,
    /// Below the horizontal axis, with its unit: the parameter.
    pub x: String,
    /// Beside the vertical axis, with its unit.
    pub y: String,
    /// In the order of the legend.
    pub branches: Vec<Branch>,
    /// Bifurcations: marks with the same label have the same symbol, and the legend names each label once.
    pub marks: Vec<Mark>,
}

/// Gaits along a parameter.
#[derive(Clone, Debug, Default)]
pub struct Branch {
    /// For the legend.
    pub name: String,
    /// In order along the branch, which may turn back; not finite is a gap.
    pub points: Vec<(f64, f64)>,
    /// Whether the gait at each of these points is stable; the piece between two points is where both are.
    pub stable: Vec<bool>,
}

const UNSTABLE: &[f64] = &[6.0, 4.0];

impl Branch {
    /// Pieces between neighbours of the same stability; the piece to a point of another one is unstable.
    fn pieces(&self) -> Vec<(Vec<(f64, f64)>, bool)> {
        let mut pieces: Vec<(Vec<(f64, f64)>, bool)> = Vec::new();
        let stable = |i: usize| self.stable.get(i).copied().unwrap_or(false);
        for (i, pair) in self.points.windows(2).enumerate() {
            let both = stable(i) && stable(i + 1);
            match pieces.last_mut().filter(|(_, before)| *before == both) {
                Some((points, _)) => points.push(pair[1]),
                None => pieces.push((pair.to_vec(), both)),
            }
        }
        if let [point] = self.points[..] {
            pieces.push((vec![point], stable(0)));
        }
        pieces
    }
}

impl Branches {
    /// Each label once, in the order of the marks.
    fn labels(&self) -> Vec<&str> {
        let mut labels: Vec<&str> = Vec::new();
        for mark in &self.marks {
            if !labels.contains(&mark.label.as_str()) {
                labels.push(&mark.label);
            }
        }
        labels
    }

    fn stroke(index: usize, stable: bool) -> Stroke {
        let ink = palette::curve(index).ink;
        if stable { Stroke { ink, width: 2.4, dash: &[] } } else { Stroke { ink, width: 1.5, dash: UNSTABLE } }
    }

    fn mark_ink(&self, kind: usize) -> Ink {
        palette::curve(self.branches.len() + kind).ink
    }

    fn legend(&self) -> Vec<(String, Sample)> {
        let several = self.branches.iter().enumerate().filter(|(_, b)| !b.name.is_empty());
        let mut all: Vec<_> = several.map(|(i, b)| (b.name.clone(), Sample::Line(Self::stroke(i, true)))).collect();
        // What full and dashed lines mean, in the colour of the only branch, or in none.
        let ink = if self.branches.len() == 1 { palette::curve(0).ink } else { Ink::Muted };
        for (name, stable) in [("stable", true), ("unstable", false)] {
            if self.branches.iter().any(|b| b.pieces().iter().any(|(_, of_piece)| *of_piece == stable)) {
                all.push((name.to_owned(), Sample::Line(Stroke { ink, ..Self::stroke(0, stable) })));
            }
        }
        let labels = self.labels().into_iter().enumerate();
        all.extend(
            labels
                .filter(|(_, l)| !l.is_empty())
                .map(|(kind, l)| (l.to_owned(), Sample::Marker(kind + 1, self.mark_ink(kind)))),
        );
        all
    }
}

impl Picture for Branches {
    fn draw(&self) -> Canvas {
        let mut canvas = Canvas::new(720.0, 500.0, &self.title);
        let top = frame::heading(&mut canvas, &self.title);
        let all = || {
            let points = self.branches.iter().flat_map(|b| b.points.iter()).chain(self.marks.iter().map(|m| &m.at));
            points.filter(|p| drawable(p.0) && drawable(p.1))
        };
        let bottom = canvas.height - MARGIN - NUMBERS_BELOW - LABEL_BELOW;
        let y = frame::vertical(aired(extent(all().map(|p| p.1)), 0.06), bottom - top - 20.0);
        let (left, right) = (frame::left_of([&y]), canvas.width - MARGIN - 10.0);
        let entries = self.legend();
        frame::legend(&mut canvas, (left, top), right - left, &entries);
        let top = top + frame::legend_height(&entries, right - left) + if y.is_scaled() { 16.0 } else { 0.0 };
        let x = frame::horizontal(aired(extent(all().map(|p| p.0)), 0.02), right - left);
        let frame = Frame { sides: Sides { left, right, top, bottom }, x, y, indent: left };
        frame.grid(&mut canvas);
        frame.below(&mut canvas, &self.x);
        frame.beside(&mut canvas, &self.y);
        for (index, branch) in self.branches.iter().enumerate() {
            for (points, stable) in branch.pieces() {
                frame.curve(&mut canvas, &points, Self::stroke(index, stable));
            }
        }
        let labels = self.labels();
        for mark in self.marks.iter().filter(|m| drawable(m.at.0) && drawable(m.at.1)) {
            let kind = labels.iter().position(|l| *l == mark.label).unwrap_or(0);
            palette::marker(&mut canvas, frame.at(mark.at), kind + 1, 5.5, self.mark_ink(kind));
        }
        if all().next().is_none() {
            frame.nothing(&mut canvas);
        }
        canvas
    }
}
