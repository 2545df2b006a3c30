//! Colours, dashes and markers that stay apart for colour-blind readers and on paper without colours.

use super::canvas::{Canvas, Dash, Ink, Place, Stroke};

/// M. Okabe, K. Ito, "Color universal design", 2008, in an order in which neighbours differ in lightness, too.
pub(super) const HUES: [[u8; 3]; 7] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [230, 159, 0], [86, 180, 233], [240, 228, 66]];

const DASHES: [Dash; 5] = [&[], &[8.0, 3.0], &[10.0, 3.0, 2.5, 3.0], &[3.5, 2.5], &[16.0, 4.0]];

/// Of reference lines, which have dots.
const DOTS: [Dash; 3] = [&[1.5, 3.0], &[1.5, 3.0, 7.0, 3.0], &[1.5, 3.0, 1.5, 3.0, 7.0, 3.0]];

/// A reference line, in the colour of a curve.
pub(super) fn level(index: usize, hue: usize) -> Stroke {
    Stroke { dash: DOTS[index % DOTS.len()], width: 1.6, ..curve(hue) }
}

/// What a page shows in light; `Ink::Text` and others are its own choice elsewhere.
pub(super) fn light(ink: Ink) -> [u8; 3] {
    match ink {
        Ink::Text => [34, 34, 34],
        Ink::Muted => [102, 102, 102],
        Ink::Grid => [224, 224, 224],
        Ink::Paper => [255, 255, 255],
        Ink::Hue(index) => HUES[index % HUES.len()],
    }
}

/// The line of one of several curves.
pub(super) fn curve(index: usize) -> Stroke {
    // The yellow is too light for lines.
    Stroke { ink: Ink::Hue(index % 6), width: 2.0, dash: DASHES[index % DASHES.len()] }
}

/// A thin line.
pub(super) fn thin(ink: Ink, dash: Dash) -> Stroke {
    Stroke { ink, width: 1.0, dash }
}

/// A marker: circle, square, triangle, diamond, cross, in this order.
pub(super) fn marker(canvas: &mut Canvas, at: Place, kind: usize, size: f64, ink: Ink) {
    let edge = Some(thin(Ink::Paper, &[]));
    let around = |corners: &[Place]| corners.iter().map(|c| (at.0 + size * c.0, at.1 + size * c.1)).collect();
    match kind % 5 {
        0 => canvas.disc(at, size, ink, edge),
        1 => canvas.area(around(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]), ink, edge),
        2 => canvas.area(around(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]), ink, edge),
        3 => canvas.area(around(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]), ink, edge),
        _ => {
            let stroke = Stroke { ink, width: 2.0, dash: &[] };
            canvas.line(around(&[(-0.9, -0.9), (0.9, 0.9)]), stroke);
            canvas.line(around(&[(-0.9, 0.9), (0.9, -0.9)]), stroke);
        }
    }
}
