//! Pictures of results as SVG: what is drawn is data with labels and units, and knows no model.

mod axis;
mod line;

pub use line::{Line, Mark};

use plotters::style::RGBColor;

/// Colours that stay apart for colour-blind readers (M. Okabe, K. Ito, "Color universal design", 2008).
const BLUE: RGBColor = RGBColor(0, 114, 178);
const ORANGE: RGBColor = RGBColor(213, 94, 0);
const GREY: RGBColor = RGBColor(90, 90, 90);
