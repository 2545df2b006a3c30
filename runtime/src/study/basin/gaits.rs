//! Which gaits are the same.

use std::cmp::Ordering;

/// Points of the same gait, found from different starts, differ by less than this, relative to `max(1, |component|)`.
pub(super) const SAME: f64 = 1e-6;

/// Whether all components differ by no more than `tolerance`, relative to `max(1, |component|)`.
pub(super) fn near(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance * a.abs().max(1.0))
}

/// Of the points of a gait the one with the largest first coordinate; of those that share it, the largest second, and so on.
pub(super) fn canonical(points: Vec<Vec<f64>>) -> Vec<f64> {
    points
        .into_iter()
        .reduce(|best, point| if compare(&point, &best) == Ordering::Greater { point } else { best })
        .unwrap_or_default()
}

fn compare(a: &[f64], b: &[f64]) -> Ordering {
    let differs = |(a, b): &(&f64, &f64)| !near(&[**a], &[**b], SAME);
    a.iter().zip(b).find(differs).map_or(Ordering::Equal, |(a, b)| a.total_cmp(b))
}

/// The different gaits that were reached, numbered from 1 in the order in which they are first met.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gaits(Vec<(usize, Vec<f64>)>);

impl Gaits {
    /// The number of a gait of this period with these coordinates.
    pub fn number(&mut self, period: usize, coordinates: &[f64]) -> usize {
        let known = self.0.iter().position(|(of, at)| *of == period && near(at, coordinates, SAME));
        known.unwrap_or_else(|| {
            self.0.push((period, coordinates.to_vec()));
            self.0.len() - 1
        }) + 1
    }

    /// Period and coordinates of each.
    pub fn all(&self) -> &[(usize, Vec<f64>)] {
        &self.0
    }
}
