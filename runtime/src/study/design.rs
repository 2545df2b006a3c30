//! Which points a study looks at: numbered, and made one by one from a description, however many there are.

use crate::optimize::sobol;

/// The values that a quantity takes, SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Axis {
    /// So many values from the first to the last, evenly spread.
    Range {
        /// First.
        lower: f64,
        /// Last.
        upper: f64,
        /// How many.
        count: u64,
    },
    /// These.
    List(Vec<f64>),
}

impl Axis {
    /// How many values there are.
    pub fn len(&self) -> u64 {
        match self {
            Self::Range { count, .. } => *count,
            Self::List(values) => values.len() as u64,
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Value number `index`; the last one for larger numbers.
    pub fn value(&self, index: u64) -> f64 {
        match self {
            Self::Range { lower, upper, count } => {
                let last = count.saturating_sub(1);
                match index {
                    0 => *lower,
                    // The ends are exactly those that were given.
                    _ if index >= last => *upper,
                    // Counts are far below 2^53.
                    _ => lower + (upper - lower) * (index as f64 / last as f64),
                }
            }
            Self::List(values) => {
                values.get(usize::try_from(index).unwrap_or(usize::MAX)).or(values.last()).copied().unwrap_or(f64::NAN)
            }
        }
    }
}

/// A set of points.
#[derive(Clone, Debug, PartialEq)]
pub enum Design {
    /// Every combination of the values of the axes; the last axis runs fastest.
    Grid(Vec<Axis>),
    /// Points that fill a box evenly: a scrambled Sobol sequence.
    Sobol {
        /// Bounds in each direction.
        bounds: Vec<(f64, f64)>,
        /// How many points.
        count: u64,
        /// Chooses the sequence.
        seed: u64,
    },
}

impl Design {
    /// How many points there are; `None` where they cannot be counted in 64 bits.
    pub fn count(&self) -> Option<u64> {
        match self {
            Self::Grid(axes) => axes.iter().try_fold(1, |product: u64, axis| product.checked_mul(axis.len())),
            Self::Sobol { count, .. } => Some(*count),
        }
    }

    /// The coordinates of a point, one for each axis.
    pub fn point(&self, number: u64) -> Vec<f64> {
        match self {
            Self::Grid(axes) => {
                let mut rest = number;
                let mut point: Vec<f64> = axes
                    .iter()
                    .rev()
                    .map(|axis| {
                        let count = axis.len().max(1);
                        let value = axis.value(rest % count);
                        rest /= count;
                        value
                    })
                    .collect();
                point.reverse();
                point
            }
            Self::Sobol { bounds, seed, .. } => {
                let number = usize::try_from(number).unwrap_or(usize::MAX);
                let inside = |(axis, (lower, upper)): (usize, &(f64, f64))| {
                    (lower + sobol::coordinate(number, axis, *seed) * (upper - lower)).clamp(*lower, *upper)
                };
                bounds.iter().enumerate().map(inside).collect()
            }
        }
    }
}
