//! Inverse of a square matrix, by elimination with partial pivoting (Gauss and Jordan).
//!
//! A matrix serves for several right-hand sides, one after the other. With the inverse, no entry of a solution has to wait for
//! another one: that is worth the additional work, as matrices are small. Columns lie in memory one after the other in groups
//! of four rows, so that whole groups are worked on at once, and the number of groups is known when that is compiled.

use crate::scalar::Scalar;

/// Four rows of a column.
type Group = [f64; GROUP];
const GROUP: usize = 4;

/// An inverted matrix; also its room.
#[derive(Clone, Debug, Default)]
pub(super) struct Inverse {
    /// Rows and columns.
    n: usize,
    /// Groups in a column.
    height: usize,
    /// The matrix, then the inverse of the matrix with its rows in `order`.
    columns: Vec<Group>,
    /// Which rows the rows were.
    order: Vec<usize>,
    /// The solution.
    solution: Vec<Group>,
}

/// Calls what is compiled for each height; a matrix takes the next larger one.
macro_rules! with_height {
    ($height:expr, $h:ident => $call:expr, $else:expr) => {
        with_height!(@ $height, $h => $call, $else; 1 2 3 4 5 6 8 12 16 24 40 80)
    };
    (@ $height:expr, $h:ident => $call:expr, $else:expr; $($size:literal)+) => {
        match $height {
            $($size => { const $h: usize = $size; $call })+
            _ => $else,
        }
    };
}

/// The heights of [`with_height`].
const HEIGHTS: [usize; 12] = [1, 2, 3, 4, 5, 6, 8, 12, 16, 24, 40, 80];

impl Inverse {
    /// Makes room for `n` rows and columns, at most 320.
    pub(super) fn resize(&mut self, n: usize) {
        if self.n == n && self.height > 0 {
            return;
        }
        self.n = n;
        self.height = HEIGHTS.into_iter().find(|height| n <= GROUP * height).unwrap_or(0);
        let zero = [0.0; GROUP];
        self.columns.clear();
        self.columns.resize(n * self.height, zero);
        self.solution.resize(self.height, zero);
        self.order = (0..n).collect();
    }

    /// The entries of a column, to be filled in. The largest entries of rows should be of similar size.
    #[inline]
    pub(super) fn column(&mut self, k: usize) -> &mut [f64] {
        let first = k * self.height;
        self.columns[first..first + self.height].as_flattened_mut()
    }

    /// Replaces the entries by those of the inverse; false when the matrix is singular or not finite.
    pub(super) fn invert(&mut self) -> bool {
        with_height!(self.height, H => self.eliminate::<H>(), false)
    }

    /// The solution for the right-hand side `b`; after a successful [`Self::invert`].
    pub(super) fn solve(&mut self, b: &[f64]) -> &[f64] {
        with_height!(self.height, H => self.multiply::<H>(b), ());
        &self.solution.as_flattened()[..self.n]
    }

    fn eliminate<const H: usize>(&mut self) -> bool {
        for (i, slot) in self.order.iter_mut().enumerate() {
            *slot = i;
        }
        let (columns, _) = self.columns.as_chunks_mut::<H>();
        for j in 0..columns.len() {
            let (pivot, value) = largest(&columns[j].as_flattened()[j..self.n]);
            // A column of NaN finds no pivot; one NaN among numbers spreads to the next columns.
            if value == 0.0 || !value.is_finite() {
                return false;
            }
            if pivot > 0 {
                self.order.swap(j, j + pivot);
                for column in &mut *columns {
                    column.as_flattened_mut().swap(j, j + pivot);
                }
            }
            let (before, rest) = columns.split_at_mut(j);
            let Some((own, after)) = rest.split_first_mut() else {
                return false;
            };
            let (inverse, mut factors) = (1.0 / value, *own);
            factors.as_flattened_mut()[j] = 0.0;
            for column in before {
                pass(column, j, inverse, &factors);
            }
            for column in after {
                pass(column, j, inverse, &factors);
            }
            *own = plus([[0.0; GROUP]; H], -inverse, &factors);
            own.as_flattened_mut()[j] = inverse;
        }
        true
    }

    fn multiply<const H: usize>(&mut self, b: &[f64]) {
        let mut x = [[0.0; GROUP]; H];
        for (column, &row) in self.columns.as_chunks::<H>().0.iter().zip(&self.order) {
            x = plus(x, b[row], column);
        }
        self.solution.copy_from_slice(&x);
    }
}

/// Divides row `j` of a column by the pivot and takes it, times `factors`, from the other rows.
#[inline(always)]
fn pass<const H: usize>(column: &mut [Group; H], j: usize, inverse: f64, factors: &[Group; H]) {
    let value = column.as_flattened()[j] * inverse;
    *column = plus(*column, -value, factors);
    column.as_flattened_mut()[j] = value;
}

/// Place and value of the entry that is largest in magnitude; 0 where there is none.
#[inline]
fn largest(entries: &[f64]) -> (usize, f64) {
    let (mut place, mut size, mut value) = (0, -1.0, 0.0);
    for (i, &entry) in entries.iter().enumerate() {
        if entry.abs() > size {
            (place, size, value) = (i, entry.abs(), entry);
        }
    }
    (place, value)
}

/// `target + factor * column`.
#[inline(always)]
fn plus<const H: usize>(mut target: [Group; H], factor: f64, column: &[Group; H]) -> [Group; H] {
    for h in 0..H {
        for i in 0..GROUP {
            target[h][i] = Scalar::mul_add(factor, column[h][i], target[h][i]);
        }
    }
    target
}

#[cfg(test)]
mod tests {
    use super::Inverse;
    use nalgebra::{DMatrix, DVector};

    fn solves(inverse: &mut Inverse, n: usize) {
        let entry = |i: usize, j: usize| {
            if (i + j) % 3 == 1 { 0.0 } else { ((3 * i + 5 * j + i * j + 1) as f64).sin() }
        };
        let b = DVector::from_fn(n, |i, _| (i as f64).cos());
        inverse.resize(n);
        for j in 0..n {
            let column = inverse.column(j);
            for i in 0..n {
                column[i] = entry(i, j);
            }
        }
        assert!(inverse.invert());
        let x = inverse.solve(b.as_slice());
        let exact = DMatrix::from_fn(n, n, entry).lu().solve(&b);
        assert_eq!(x.len(), n);
        for (a, b) in x.iter().zip(exact.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, max_relative = 1e-9);
        }
    }

    #[test]
    fn solves_what_nalgebra_solves() {
        // In one room, which grows and shrinks.
        let mut inverse = Inverse::default();
        for n in [1, 4, 6, 10, 27, 18, 3] {
            solves(&mut inverse, n);
        }
        inverse.resize(0);
        assert!(inverse.invert() && inverse.solve(&[]).is_empty());
    }

    #[test]
    fn refuses_singular_matrices() {
        for entry in [0.0, 1.0, f64::NAN, f64::INFINITY] {
            let mut inverse = Inverse::default();
            inverse.resize(6);
            for j in 0..6 {
                inverse.column(j)[..6].fill(entry);
            }
            assert!(!inverse.invert(), "{entry}");
        }
    }
}
