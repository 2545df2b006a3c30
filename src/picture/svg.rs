//! A canvas as SVG text.

use super::canvas::{Anchor, Canvas, Ink, Place, Shape, Stroke};
use super::{font, palette};
use crate::provenance::{self, Provenance};
use std::fmt::Write;

/// Where an SVG is to stand.
#[derive(Clone, Copy, Debug)]
pub(super) enum Setting<'p> {
    /// In a file of its own, on white.
    File(&'p Provenance),
    /// Within a page whose styles choose `--ink`, `--muted`, `--grid`, `--paper` and `--hue-0` to `--hue-6`.
    Page,
}

/// The canvas as one `svg` element.
pub(super) fn text(canvas: &Canvas, setting: Setting<'_>) -> String {
    let (width, height) = (number(canvas.width), number(canvas.height));
    let title = escape(&canvas.title);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         role=\"img\" aria-label=\"{title}\" font-family=\"{}\">\n",
        font::FAMILY
    );
    out += &format!("<title>{title}</title>\n");
    if let Setting::File(provenance) = setting {
        out += &format!("<metadata id=\"{}\">{}</metadata>\n", provenance::KEY, provenance.line());
    }
    let mut pen = Pen { out, setting };
    pen.cell((0.0, 0.0), (canvas.width, canvas.height), Ink::Paper);
    for shape in &canvas.shapes {
        pen.shape(shape);
    }
    pen.out + "</svg>\n"
}

struct Pen<'p> {
    out: String,
    setting: Setting<'p>,
}

impl Pen<'_> {
    fn add(&mut self, text: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.out.write_fmt(text);
    }

    fn ink(&self, ink: Ink) -> String {
        if let Setting::File(_) = self.setting {
            let [r, g, b] = palette::light(ink);
            return format!("#{r:02x}{g:02x}{b:02x}");
        }
        match ink {
            Ink::Text => "var(--ink)".to_owned(),
            Ink::Muted => "var(--muted)".to_owned(),
            Ink::Grid => "var(--grid)".to_owned(),
            Ink::Paper => "var(--paper)".to_owned(),
            Ink::Hue(index) => format!("var(--hue-{})", index % palette::HUES.len()),
        }
    }

    fn stroke(&self, stroke: &Stroke) -> String {
        let mut text = format!(" stroke=\"{}\" stroke-width=\"{}\"", self.ink(stroke.ink), number(stroke.width));
        if !stroke.dash.is_empty() {
            let lengths: Vec<String> = stroke.dash.iter().map(|&length| number(length)).collect();
            text += &format!(" stroke-dasharray=\"{}\"", lengths.join(" "));
        }
        text
    }

    fn cell(&mut self, corner: Place, size: Place, ink: Ink) {
        let ink = self.ink(ink);
        let (x, y, w, h) = (number(corner.0), number(corner.1), number(size.0), number(size.1));
        self.add(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"{ink}\" shape-rendering=\"crispEdges\"/>\n"
        ));
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Line { points, closed, stroke } => {
                let (tag, stroke) = (if *closed { "polygon" } else { "polyline" }, self.stroke(stroke));
                let points = places(points);
                self.add(format_args!(
                    "<{tag} points=\"{points}\" fill=\"none\"{stroke} stroke-linejoin=\"round\" stroke-linecap=\"butt\"/>\n"
                ));
            }
            Shape::Area { points, ink, edge } => {
                let (ink, edge) = (self.ink(*ink), edge.as_ref().map(|e| self.stroke(e)).unwrap_or_default());
                self.add(format_args!("<polygon points=\"{}\" fill=\"{ink}\"{edge}/>\n", places(points)));
            }
            Shape::Cell { corner, size, ink } => self.cell(*corner, *size, *ink),
            Shape::Disc { at, radius, ink, edge } => {
                let (ink, edge) = (self.ink(*ink), edge.as_ref().map(|e| self.stroke(e)).unwrap_or_default());
                let (x, y, r) = (number(at.0), number(at.1), number(*radius));
                self.add(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{ink}\"{edge}/>\n"));
            }
            Shape::Text { at, text, size, anchor, ink, upwards } => {
                let anchor = match anchor {
                    Anchor::Start => "",
                    Anchor::Middle => " text-anchor=\"middle\"",
                    Anchor::End => " text-anchor=\"end\"",
                };
                let (ink, x, y, size) = (self.ink(*ink), number(at.0), number(at.1), number(*size));
                let turn = if *upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
                let text = escape(text);
                self.add(format_args!(
                    "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{ink}\"{anchor}{turn}>{text}</text>\n"
                ));
            }
        }
    }
}

fn places(points: &[Place]) -> String {
    let points: Vec<String> = points.iter().map(|p| format!("{},{}", number(p.0), number(p.1))).collect();
    points.join(" ")
}

/// Hundredths of a pixel.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text as XML and HTML have it in elements and attributes. What XML does not allow at all (most control characters) is left out.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\n' | '\t' => out.push(' '),
            '\u{fffe}' | '\u{ffff}' => {}
            c if c.is_control() => {}
            c => out.push(c),
        }
    }
    out
}
