//! The font of all pictures, within the program: what fits where is known without looking at the machine's fonts.
//!
//! Liberation Sans (SIL Open Font License, `font/OFL.txt`) has the widths of Arial and Helvetica, so that an SVG looks the same
//! where only one of these is at hand.

use std::sync::LazyLock;
use ttf_parser::Face;

/// Of the family and those that have its widths.
pub(super) const FAMILY: &str = "Liberation Sans, Arial, Helvetica, sans-serif";

static DATA: &[u8] = include_bytes!("font/LiberationSans-Regular.ttf");

/// The font; it is part of the program, and a test reads it.
pub(super) static FACE: LazyLock<Option<Face<'static>>> = LazyLock::new(|| Face::parse(DATA, 0).ok());

/// Width of a text in pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let Some(face) = FACE.as_ref() else { return 0.5 * size * text.chars().count() as f64 };
    let units = f64::from(face.units_per_em());
    let of = |c| face.glyph_index(c).or(face.glyph_index('?')).and_then(|glyph| face.glyph_hor_advance(glyph));
    text.chars().filter_map(of).map(f64::from).sum::<f64>() * size / units
}

/// A text that is no wider than that: its end is cut off where it is.
pub(super) fn fitted(text: &str, size: f64, most: f64) -> String {
    if width(text, size) <= most {
        return text.to_owned();
    }
    let mut short: String = text.to_owned();
    while !short.is_empty() && width(&short, size) + width("…", size) > most {
        short.pop();
    }
    short.trim_end().to_owned() + "…"
}

/// A label with a unit in brackets that is no wider than that: the name gives way, not the unit.
pub(super) fn fitted_label(label: &str, size: f64, most: f64) -> String {
    match label.rfind(" [") {
        Some(at) if width(label, size) > most => {
            let (name, unit) = label.split_at(at);
            fitted(name, size, (most - width(unit, size)).max(0.0)) + unit
        }
        _ => fitted(label, size, most),
    }
}
