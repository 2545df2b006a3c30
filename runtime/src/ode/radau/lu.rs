//! Dense factorisation with partial pivoting of a square matrix.
//!
//! Columns lie in memory one after the other in groups of four rows, so that whole groups are worked on at once, and the number of
//! groups is known when that is compiled. Entries on the wrong side of the diagonal are zeros: of L in `lower`, whose
//! unit diagonal is not stored, of U, whose diagonal is stored inverted, in `columns`.

use crate::scalar::Scalar;

/// Four rows of a column.
type Group = [f64; GROUP];
const GROUP: usize = 4;

/// A factorised matrix; also its room.
#[derive(Clone, Debug, Default)]
pub(super) struct Factors {
    /// Rows and columns.
    n: usize,
    /// Groups in a column.
    height: usize,
    /// The matrix, then U above its diagonal.
    columns: Vec<Group>,
    /// L below its diagonal.
    lower: Vec<Group>,
    /// Inverse diagonal of U.
    inverses: Vec<Group>,
    /// Which rows the factors' rows were.
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

impl Factors {
    /// Makes room for `n` rows and columns, at most 320.
    pub(super) fn resize(&mut self, n: usize) {
        if self.n == n && self.height > 0 {
            return;
        }
        self.n = n;
        self.height = HEIGHTS.into_iter().find(|height| n <= GROUP * height).unwrap_or(0);
        let zero = [0.0; GROUP];
        for room in [&mut self.columns, &mut self.lower] {
            room.clear();
            room.resize(GROUP * self.height * self.height, zero);
        }
        self.solution.resize(self.height, zero);
        self.inverses.resize(self.height, zero);
        self.order = (0..GROUP * self.height).collect();
    }

    /// The entries of a column, to be filled in. The largest entries of rows should be of similar size.
    #[inline]
    pub(super) fn column(&mut self, k: usize) -> &mut [f64] {
        let first = k * self.height;
        self.columns[first..first + self.height].as_flattened_mut()
    }

    /// Replaces the entries by their factors; false when the matrix is singular or not finite.
    pub(super) fn factorise(&mut self) -> bool {
        with_height!(self.height, H => self.eliminate::<H>(), false)
    }

    /// The solution for the right-hand side `b`; after a successful [`Self::factorise`].
    pub(super) fn solve(&mut self, b: &[f64]) -> &[f64] {
        with_height!(self.height, H => self.substitute::<H>(b), ());
        &self.solution.as_flattened()[..self.n]
    }

    fn eliminate<const H: usize>(&mut self) -> bool {
        for (i, slot) in self.order.iter_mut().enumerate() {
            *slot = i;
        }
        let (columns, _) = self.columns.as_chunks_mut::<H>();
        let (lowers, _) = self.lower.as_chunks_mut::<H>();
        let inverses = self.inverses.as_flattened_mut();
        for j in 0..self.n {
            let (pivot, value) = largest(&columns[j].as_flattened()[j..self.n]);
            // A column of NaN finds no pivot; one NaN among numbers spreads to the next columns.
            if value == 0.0 || !value.is_finite() {
                return false;
            }
            if pivot > 0 {
                self.order.swap(j, j + pivot);
                for column in lowers[..j].iter_mut().chain(&mut columns[j..self.n]) {
                    column.as_flattened_mut().swap(j, j + pivot);
                }
            }
            inverses[j] = 1.0 / value;
            let Some((finished, rest)) = columns[j..self.n].split_first_mut() else {
                return false;
            };
            let lower = split(finished, j, inverses[j]);
            for column in rest {
                let factor = column.as_flattened()[j];
                *column = less(*column, factor, &lower);
            }
            lowers[j] = lower;
        }
        true
    }

    fn substitute<const H: usize>(&mut self, b: &[f64]) {
        let mut x = [[0.0; GROUP]; H];
        for (slot, &row) in x.as_flattened_mut().iter_mut().zip(&self.order[..self.n]) {
            *slot = b[row];
        }
        let (columns, lowers) = (self.columns.as_chunks::<H>().0, self.lower.as_chunks::<H>().0);
        let (columns, lowers) = (&columns[..H * GROUP], &lowers[..H * GROUP]);
        // Columns beyond `n` are zeros. Nothing is written into single entries of `x`: it stays in registers.
        for h in 0..H {
            for i in 0..GROUP {
                x = less(x, x[h][i], &lowers[h * GROUP + i]);
            }
        }
        for h in (0..H).rev() {
            let mut values = [0.0; GROUP];
            for i in (0..GROUP).rev() {
                values[i] = x[h][i] * self.inverses[h][i];
                x = less(x, values[i], &columns[h * GROUP + i]);
            }
            self.solution[h] = values;
        }
    }
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

/// The column of L that `column` makes, with `inverse` the inverse of entry `j` on the diagonal; leaves the column of U.
#[inline(always)]
fn split<const H: usize>(column: &mut [Group; H], j: usize, inverse: f64) -> [Group; H] {
    let mut lower = [[0.0; GROUP]; H];
    for (i, (lower, entry)) in lower.as_flattened_mut().iter_mut().zip(column.as_flattened_mut()).enumerate() {
        *lower = if i > j { *entry * inverse } else { 0.0 };
        *entry = if i < j { *entry } else { 0.0 };
    }
    lower
}

/// `target - factor * column`.
#[inline(always)]
fn less<const H: usize>(mut target: [Group; H], factor: f64, column: &[Group; H]) -> [Group; H] {
    for h in 0..H {
        for i in 0..GROUP {
            target[h][i] = Scalar::mul_add(-factor, column[h][i], target[h][i]);
        }
    }
    target
}

#[cfg(test)]
mod tests {
    use super::Factors;
    use nalgebra::{DMatrix, DVector};

    fn solves(factors: &mut Factors, n: usize) {
        let entry = |i: usize, j: usize| {
            if (i + j) % 3 == 1 { 0.0 } else { ((3 * i + 5 * j + i * j + 1) as f64).sin() }
        };
        let b = DVector::from_fn(n, |i, _| (i as f64).cos());
        factors.resize(n);
        for j in 0..n {
            let column = factors.column(j);
            for i in 0..n {
                column[i] = entry(i, j);
            }
        }
        assert!(factors.factorise());
        let x = factors.solve(b.as_slice());
        let exact = DMatrix::from_fn(n, n, entry).lu().solve(&b);
        assert_eq!(x.len(), n);
        for (a, b) in x.iter().zip(exact.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, max_relative = 1e-9);
        }
    }

    #[test]
    fn solves_what_nalgebra_solves() {
        // In one room, which grows and shrinks.
        let mut factors = Factors::default();
        for n in [1, 4, 6, 10, 27, 18, 3] {
            solves(&mut factors, n);
        }
        factors.resize(0);
        assert!(factors.factorise() && factors.solve(&[]).is_empty());
    }

    #[test]
    fn refuses_singular_matrices() {
        for entry in [0.0, 1.0, f64::NAN, f64::INFINITY] {
            let mut factors = Factors::default();
            factors.resize(6);
            for j in 0..6 {
                factors.column(j)[..6].fill(entry);
            }
            assert!(!factors.factorise(), "{entry}");
        }
    }
}
