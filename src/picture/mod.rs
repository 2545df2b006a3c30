//! Pictures of results: what is drawn is data with labels and units, and knows no model.
//!
//! Each kind of picture is plain data and is drawn onto a [`Canvas`] by [`Picture::draw`]; [`write()`] makes an SVG or a PNG of
//! it, by the name of the file. Both carry their provenance: an SVG in its `metadata` element, a PNG in its text chunk
//! `gaitc`. The same data gives the same bytes. Labels name quantity and unit, see [`label`].
//!
//! Drawn by hand, with no plotting library: the width of every text is known, so that nothing overlaps, dashes and text stay
//! dashes and text in an SVG, and a page can give it the colours of its theme.

mod axis;
mod basin;
mod branches;
mod canvas;
mod circle;
mod cobweb;
mod font;
mod frame;
mod line;
mod palette;
mod path;
mod png;
mod series;
mod svg;
mod write;

pub use basin::Basin;
pub use branches::{Branch, Branches};
pub use canvas::Canvas;
pub use circle::{Circle, Multipliers};
pub use cobweb::{Cobweb, Return};
pub use line::Line;
pub use path::{Path, Places, Stretches};
pub use series::{Curve, Event, Level, Panel, Series};
pub(crate) use svg::escape;
pub use write::{PictureError, check_name, write};

use crate::provenance::Provenance;

/// Anything that can be drawn.
pub trait Picture {
    /// As shapes at places. Values that are not finite are left out; a picture without any says that there is nothing to draw.
    fn draw(&self) -> Canvas;
}

/// A named place in a picture.
#[derive(Clone, Debug, Default)]
pub struct Mark {
    /// Where.
    pub at: (f64, f64),
    /// What stands beside it, or in the legend.
    pub label: String,
}

/// A label of an axis: `climb_speed [m/s]`; the name alone where the unit is empty or 1.
#[must_use]
pub fn label(name: &str, unit: &str) -> String {
    if matches!(unit, "" | "1") { name.to_owned() } else { format!("{name} [{unit}]") }
}

/// The picture as the text of an SVG file.
#[must_use]
pub fn svg(picture: &dyn Picture, provenance: &Provenance) -> String {
    svg::text(&picture.draw(), svg::Setting::File(provenance))
}

/// The picture as an `svg` element of an HTML page, whose styles choose the colours `--ink`, `--muted`, `--grid`, `--paper`
/// and `--hue-0` to `--hue-6`.
#[must_use]
pub fn inline_svg(picture: &dyn Picture) -> String {
    svg::text(&picture.draw(), svg::Setting::Page)
}
