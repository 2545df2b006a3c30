//! Dense factorisation with partial pivoting of a matrix of S x S blocks of N x N, all sizes known when compiled.
//!
//! Rows lie in memory one after the other and are worked on a block at a time. A finished row of U has zeros up to and with
//! its diagonal (whose inverse is kept apart), so that whole blocks can be added without looking where the diagonal is; rows of
//! L are copied out before that.

/// Entries of a row that is worked on as a whole.
const SHORT_ROW: usize = 40;

/// A row: S blocks of N entries.
type Row<const N: usize, const S: usize> = [[f64; N]; S];

/// A factorised matrix; also its room.
#[derive(Clone, Debug)]
pub(super) struct Factors<const N: usize, const S: usize> {
    /// The matrix, then U.
    rows: Vec<Row<N, S>>,
    /// L below its unit diagonal, zeros elsewhere.
    lower: Vec<Row<N, S>>,
    inverses: Vec<f64>,
    order: Vec<usize>,
    scratch: Row<N, S>,
}

impl<const N: usize, const S: usize> Default for Factors<N, S> {
    fn default() -> Self {
        let n = N * S;
        let zero = [[0.0; N]; S];
        let (rows, lower) = (vec![zero; n], vec![zero; n]);
        Self { rows, lower, inverses: vec![0.0; n], order: (0..n).collect(), scratch: zero }
    }
}

impl<const N: usize, const S: usize> Factors<N, S> {
    /// The rows, to be filled in before [`Self::factorise`]; their largest entries should be of similar size.
    pub(super) fn rows_mut(&mut self) -> &mut [Row<N, S>] {
        &mut self.rows
    }

    /// Replaces the entries by their factors; false when the matrix is singular or not finite.
    #[inline]
    pub(super) fn factorise(&mut self) -> bool {
        for (i, slot) in self.order.iter_mut().enumerate() {
            *slot = i;
        }
        for block in 0..S {
            for column in 0..N {
                if !self.eliminate(block, column) {
                    return false;
                }
            }
        }
        true
    }

    /// Makes zeros below the diagonal in one column.
    #[inline(always)]
    fn eliminate(&mut self, block: usize, column: usize) -> bool {
        let j = block * N + column;
        let Some(rest) = self.rows.get_mut(j..) else {
            return false;
        };
        let (mut pivot, mut largest, mut value) = (0, -1.0, 0.0);
        for (i, row) in rest.iter().enumerate() {
            let entry: f64 = row[block][column];
            if entry.abs() > largest {
                (pivot, largest, value) = (i, entry.abs(), entry);
            }
        }
        // A column of NaN finds no pivot and leaves 0 there; one NaN among numbers spreads to the next columns.
        if value == 0.0 || !value.is_finite() {
            return false;
        }
        rest.swap(0, pivot);
        self.order.swap(j, j + pivot);
        let inverse = 1.0 / value;
        self.inverses[j] = inverse;
        let Some((finished, below)) = rest.split_first_mut() else {
            return false;
        };
        let lower = self.lower[j].as_flattened_mut();
        lower[..j].copy_from_slice(&finished.as_flattened()[..j]);
        finished.as_flattened_mut()[..=j].fill(0.0);
        let finished = *finished;
        for row in below {
            let factor = row[block][column] * inverse;
            // Blocks of zeros are common.
            if factor != 0.0 {
                // A short row is done with whole, zeros included: its length is known when compiled.
                if const { N * S <= SHORT_ROW } {
                    subtract(factor, &finished, row);
                } else {
                    subtract(factor, &finished[block..], &mut row[block..]);
                }
            }
            row[block][column] = factor;
        }
        true
    }

    /// Solves in place; after a successful [`Self::factorise`].
    #[inline]
    pub(super) fn solve(&mut self, b: &mut Row<N, S>) {
        let n = N * S;
        let x = &mut self.scratch;
        for (slot, &i) in x.as_flattened_mut().iter_mut().zip(&self.order) {
            *slot = b[i / N][i % N];
        }
        for i in 1..n {
            // L is zero from the diagonal on.
            let blocks = i.div_ceil(N);
            let sum = product(&self.lower[i][..blocks], &x[..blocks]);
            x[i / N][i % N] -= sum;
        }
        for i in (0..n).rev() {
            // U is zero up to the diagonal.
            let from = i / N;
            let sum = product(&self.rows[i][from..], &x[from..]);
            x[i / N][i % N] = (x[i / N][i % N] - sum) * self.inverses[i];
        }
        *b = *x;
    }
}

/// row -= factor * other.
#[inline(always)]
fn subtract<const N: usize>(factor: f64, other: &[[f64; N]], row: &mut [[f64; N]]) {
    for (group, other) in row.iter_mut().zip(other) {
        for i in 0..N {
            group[i] -= factor * other[i];
        }
    }
}

/// Scalar product, group by group.
#[inline]
fn product<const N: usize>(a: &[[f64; N]], b: &[[f64; N]]) -> f64 {
    let mut sums = [0.0; N];
    for (a, b) in a.iter().zip(b) {
        for i in 0..N {
            sums[i] += a[i] * b[i];
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::Factors;
    use nalgebra::{DMatrix, DVector};

    fn solves<const N: usize, const S: usize>() {
        let n = N * S;
        let entry = |i: usize, j: usize| {
            if (i + j) % 3 == 1 { 0.0 } else { ((3 * i + 5 * j + i * j + 1) as f64).sin() }
        };
        let matrix = DMatrix::from_fn(n, n, entry);
        let b = DVector::from_fn(n, |i, _| (i as f64).cos());
        let mut factors = Factors::<N, S>::default();
        for (i, row) in factors.rows_mut().iter_mut().enumerate() {
            for (j, slot) in row.as_flattened_mut().iter_mut().enumerate() {
                *slot = entry(i, j);
            }
        }
        assert!(factors.factorise());
        let mut x = [[0.0; N]; S];
        x.as_flattened_mut().copy_from_slice(b.as_slice());
        factors.solve(&mut x);
        let exact = matrix.lu().solve(&b);
        for (a, b) in x.as_flattened().iter().zip(exact.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, max_relative = 1e-11);
        }
    }

    #[test]
    fn solves_what_nalgebra_solves() {
        solves::<1, 1>();
        solves::<3, 1>();
        solves::<2, 3>();
        solves::<1, 5>();
        solves::<3, 5>();
        solves::<4, 5>();
        solves::<7, 3>();
    }

    #[test]
    fn refuses_singular_matrices() {
        for entry in [0.0, 1.0, f64::NAN, f64::INFINITY] {
            let mut factors = Factors::<2, 3>::default();
            factors.rows_mut().fill([[entry; 2]; 3]);
            assert!(!factors.factorise(), "{entry}");
        }
    }
}
