//! A canvas as a PNG, in three pixels for each of the canvas: 300 of them to an inch of paper.

use super::canvas::{Anchor, Canvas, Ink, Place, Shape, Stroke};
use super::{font, palette};
use crate::provenance::{self, Provenance};
use std::io;
use tiny_skia::{Color, FillRule, LineJoin, Paint, PathBuilder, Pixmap, Rect, StrokeDash, Transform};
use ttf_parser::OutlineBuilder;

/// Pixels of the file for each of the canvas.
const SCALE: f32 = 3.0;
/// Pixels a metre, of 300 an inch.
const DENSITY: u32 = 11_811;

/// The canvas as the bytes of a PNG file.
pub(super) fn bytes(canvas: &Canvas, provenance: &Provenance) -> io::Result<Vec<u8>> {
    let pixels = |length: f64| (length * f64::from(SCALE)).round().clamp(1.0, 20_000.0) as u32;
    let (width, height) = (pixels(canvas.width), pixels(canvas.height));
    let map = Pixmap::new(width, height).ok_or_else(|| io::Error::other("the picture is too large"))?;
    let mut brush = Brush { map };
    brush.map.fill(color(Ink::Paper));
    for shape in &canvas.shapes {
        brush.shape(shape);
    }
    encode(&brush.map, canvas, provenance)
}

fn encode(map: &Pixmap, canvas: &Canvas, provenance: &Provenance) -> io::Result<Vec<u8>> {
    // Everything stands on opaque paper: colours without transparency are the file.
    let colors: Vec<u8> = map.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, map.width(), map.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: DENSITY, yppu: DENSITY, unit: png::Unit::Meter }));
    encoder.add_itxt_chunk("Title".to_owned(), canvas.title.clone())?;
    encoder.add_itxt_chunk(provenance::KEY.to_owned(), provenance.line())?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&colors)?;
    writer.finish()?;
    Ok(file)
}

fn color(ink: Ink) -> Color {
    let [r, g, b] = palette::light(ink);
    Color::from_rgba8(r, g, b, 255)
}

fn paint(ink: Ink) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(color(ink));
    paint.anti_alias = true;
    paint
}

fn point(place: Place) -> (f32, f32) {
    (place.0 as f32, place.1 as f32)
}

struct Brush {
    map: Pixmap,
}

impl Brush {
    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Line { points, closed, stroke } => self.stroke(outline(points, *closed), stroke),
            Shape::Area { points, ink, edge } => self.fill(outline(points, true), *ink, edge.as_ref()),
            Shape::Cell { corner, size, ink } => self.cell(*corner, *size, *ink),
            Shape::Disc { at, radius, ink, edge } => {
                let (x, y) = point(*at);
                self.fill(PathBuilder::from_circle(x, y, *radius as f32), *ink, edge.as_ref());
            }
            Shape::Text { at, text, size, anchor, ink, upwards } => {
                let back = match anchor {
                    Anchor::Start => 0.0,
                    Anchor::Middle => 0.5,
                    Anchor::End => 1.0,
                } * font::width(text, *size);
                let (x, y) = point(*at);
                let turn = if *upwards { Transform::from_rotate_at(-90.0, x, y) } else { Transform::identity() };
                let path = glyphs(text, *size, (at.0 - back, at.1));
                if let Some(path) = path.and_then(|path| path.transform(turn)) {
                    self.fill(Some(path), *ink, None);
                }
            }
        }
    }

    fn fill(&mut self, path: Option<tiny_skia::Path>, ink: Ink, edge: Option<&Stroke>) {
        let Some(path) = path else { return };
        let scale = Transform::from_scale(SCALE, SCALE);
        self.map.fill_path(&path, &paint(ink), FillRule::Winding, scale, None);
        if let Some(edge) = edge {
            self.stroke(Some(path), edge);
        }
    }

    fn stroke(&mut self, path: Option<tiny_skia::Path>, stroke: &Stroke) {
        let Some(path) = path else { return };
        // A gap follows each dash: the lengths are pairs.
        let dash = StrokeDash::new(stroke.dash.iter().map(|&length| length as f32).collect(), 0.0);
        let style = tiny_skia::Stroke {
            width: stroke.width as f32,
            dash,
            line_join: LineJoin::Round,
            ..tiny_skia::Stroke::default()
        };
        self.map.stroke_path(&path, &paint(stroke.ink), &style, Transform::from_scale(SCALE, SCALE), None);
    }

    /// Its sides are put on whole pixels, so that neighbouring cells leave no seam.
    fn cell(&mut self, corner: Place, size: Place, ink: Ink) {
        let whole = |length: f64| (length as f32 * SCALE).round();
        let (left, top) = (whole(corner.0), whole(corner.1));
        let (right, bottom) = (whole(corner.0 + size.0), whole(corner.1 + size.1));
        if let Some(rect) = Rect::from_ltrb(left, top, right, bottom) {
            let paint = Paint { anti_alias: false, ..paint(ink) };
            self.map.fill_rect(rect, &paint, Transform::identity(), None);
        }
    }
}

fn outline(points: &[Place], closed: bool) -> Option<tiny_skia::Path> {
    let mut path = PathBuilder::new();
    let (first, rest) = points.split_first()?;
    let (x, y) = point(*first);
    path.move_to(x, y);
    for &place in rest {
        let (x, y) = point(place);
        path.line_to(x, y);
    }
    if closed {
        path.close();
    }
    path.finish()
}

/// The outlines of a text whose baseline begins at a place.
fn glyphs(text: &str, size: f64, start: Place) -> Option<tiny_skia::Path> {
    let face = font::FACE.as_ref()?;
    let scale = size / f64::from(face.units_per_em());
    let mut pen = Outline { path: PathBuilder::new(), scale: scale as f32, x: start.0 as f32, y: start.1 as f32 };
    let mut x = start.0;
    for c in text.chars() {
        // As in an SVG where the font lacks a letter: a place is taken by something.
        let Some(glyph) = face.glyph_index(c).or_else(|| face.glyph_index('?')) else { continue };
        pen.x = x as f32;
        face.outline_glyph(glyph, &mut pen);
        x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) * scale;
    }
    pen.path.finish()
}

/// Glyphs in units of the font, upwards, as a path in pixels, downwards.
struct Outline {
    path: PathBuilder,
    scale: f32,
    x: f32,
    y: f32,
}

impl Outline {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + self.scale * x, self.y - self.scale * y)
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.place(x1, y1), self.place(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.place(x1, y1), self.place(x2, y2), self.place(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
