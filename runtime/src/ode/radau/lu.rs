//! Dense factorisation with partial pivoting of a matrix of at most N x N blocks of S x S.
//!
//! Rows lie in memory one after the other and are worked on a block at a time. A finished row of U has zeros up to and with
//! its diagonal (whose inverse is kept apart), so that whole blocks can be added without looking where the diagonal is; rows of
//! L are copied out before that.

/// A row: N blocks of S entries.
type Row<const S: usize, const N: usize> = [[f64; S]; N];

/// A factorised matrix; also its room.
#[derive(Clone, Debug)]
pub(super) struct Factors<const S: usize, const N: usize> {
    /// Blocks in a row that are used.
    blocks: usize,
    /// The matrix, then U.
    rows: Vec<Row<S, N>>,
    /// L below its unit diagonal, zeros elsewhere.
    lower: Vec<Row<S, N>>,
    inverses: Vec<f64>,
    order: Vec<usize>,
    solution: Row<S, N>,
}

impl<const S: usize, const N: usize> Default for Factors<S, N> {
    fn default() -> Self {
        let (n, zero) = (N * S, [[0.0; S]; N]);
        let (rows, lower, inverses) = (vec![zero; n], vec![zero; n], vec![0.0; n]);
        Self { blocks: N, rows, lower, inverses, order: (0..n).collect(), solution: zero }
    }
}

impl<const S: usize, const N: usize> Factors<S, N> {
    /// Uses the first `blocks` blocks of rows and columns.
    pub(super) fn resize(&mut self, blocks: usize) {
        self.blocks = blocks.min(N);
    }

    /// Sets a block; `None` is zero. The largest entries of rows should be of similar size.
    #[inline]
    pub(super) fn set(&mut self, row: usize, column: usize, entries: Option<&[[f64; S]; S]>) {
        for (i, row) in self.rows[row * S..(row + 1) * S].iter_mut().enumerate() {
            row[column] = entries.map_or([0.0; S], |entries| entries[i]);
        }
    }

    /// Replaces the entries by their factors; false when the matrix is singular or not finite.
    #[inline]
    pub(super) fn factorise(&mut self) -> bool {
        for (i, slot) in self.order.iter_mut().enumerate() {
            *slot = i;
        }
        (0..self.blocks).all(|block| (0..S).all(|column| self.eliminate(block, column)))
    }

    /// Makes zeros below the diagonal in one column.
    #[inline]
    fn eliminate(&mut self, block: usize, column: usize) -> bool {
        let (j, n) = (block * S + column, self.blocks * S);
        let rows = &mut self.rows[j..n];
        let (mut pivot, mut largest, mut value) = (0, -1.0, 0.0);
        for (i, row) in rows.iter().enumerate() {
            let entry: f64 = row[block][column];
            if entry.abs() > largest {
                (pivot, largest, value) = (i, entry.abs(), entry);
            }
        }
        // A column of NaN finds no pivot; one NaN among numbers spreads to the next columns.
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        rows.swap(0, pivot);
        self.order.swap(j, j + pivot);
        let inverse = 1.0 / value;
        self.inverses[j] = inverse;
        let Some((finished, below)) = rows.split_first_mut() else {
            return false;
        };
        let lower = &mut self.lower[j];
        lower[..block].copy_from_slice(&finished[..block]);
        for i in 0..S {
            lower[block][i] = if i < column { finished[block][i] } else { 0.0 };
            if i <= column {
                finished[block][i] = 0.0;
            }
        }
        let finished = &finished[block..self.blocks];
        for row in below {
            let factor = row[block][column] * inverse;
            if factor != 0.0 {
                for (group, other) in row[block..].iter_mut().zip(finished) {
                    for i in 0..S {
                        group[i] -= factor * other[i];
                    }
                }
            }
            row[block][column] = factor;
        }
        true
    }

    /// The solution for a right-hand side, given block by block; after a successful [`Self::factorise`].
    #[inline]
    pub(super) fn solve(&mut self, b: impl Fn(usize) -> [f64; S]) -> &[[f64; S]] {
        let mut right = [[0.0; S]; N];
        for (block, slot) in right.iter_mut().enumerate().take(self.blocks) {
            *slot = b(block);
        }
        let x = &mut self.solution[..self.blocks];
        for (slot, &i) in x.as_flattened_mut().iter_mut().zip(&self.order) {
            *slot = right.as_flattened()[i];
        }
        for block in 0..x.len() {
            for column in 0..S {
                let sum = product(&self.lower[block * S + column][..=block], x);
                x[block][column] -= sum;
            }
        }
        for block in (0..x.len()).rev() {
            for column in (0..S).rev() {
                let j = block * S + column;
                let sum = product(&self.rows[j][block..self.blocks], &x[block..]);
                x[block][column] = (x[block][column] - sum) * self.inverses[j];
            }
        }
        x
    }
}

/// Scalar product, block by block.
#[inline]
fn product<const S: usize>(a: &[[f64; S]], b: &[[f64; S]]) -> f64 {
    let mut sums = [0.0; S];
    for (a, b) in a.iter().zip(b) {
        for i in 0..S {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::Factors;
    use nalgebra::{DMatrix, DVector};

    fn solves<const S: usize, const N: usize>(blocks: usize) {
        let n = blocks * S;
        let entry = |i: usize, j: usize| {
            if (i + j) % 3 == 1 { 0.0 } else { ((3 * i + 5 * j + i * j + 1) as f64).sin() }
        };
        let b = DVector::from_fn(n, |i, _| (i as f64).cos());
        let mut factors = Factors::<S, N>::default();
        factors.resize(blocks);
        for row in 0..blocks {
            for column in 0..blocks {
                let block = core::array::from_fn(|i| core::array::from_fn(|j| entry(row * S + i, column * S + j)));
                factors.set(row, column, Some(&block));
            }
        }
        assert!(factors.factorise());
        let x = factors.solve(|block| core::array::from_fn(|i| b[block * S + i]));
        let exact = DMatrix::from_fn(n, n, entry).lu().solve(&b);
        for (a, b) in x.as_flattened().iter().zip(exact.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, max_relative = 1e-10);
        }
    }

    #[test]
    fn solves_what_nalgebra_solves() {
        solves::<1, 1>(1);
        solves::<1, 4>(4);
        solves::<3, 2>(2);
        solves::<5, 4>(2);
        solves::<5, 4>(4);
        solves::<3, 7>(6);
    }

    #[test]
    fn refuses_singular_matrices() {
        for entry in [0.0, 1.0, f64::NAN, f64::INFINITY] {
            let mut factors = Factors::<3, 2>::default();
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                factors.set(row, column, (entry != 0.0).then_some(&[[entry; 3]; 3]));
            }
            assert!(!factors.factorise(), "{entry}");
        }
    }
}
