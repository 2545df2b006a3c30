//! Dense factorisation with partial pivoting, row by row, in place.
//!
//! Rows are scaled to a largest entry of 1 first: the equations of a model have different units.

/// A factorised matrix of n rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Factors {
    rows: usize,
    entries: Vec<f64>,
    scales: Vec<f64>,
    order: Vec<usize>,
    scratch: Vec<f64>,
}

impl Factors {
    /// Room for a matrix of `rows` rows; also says how many it has.
    pub(super) fn resize(&mut self, rows: usize) {
        if self.rows != rows {
            self.rows = rows;
            self.entries = vec![0.0; rows * rows];
            self.scales = vec![0.0; rows];
            self.order = vec![0; rows];
            self.scratch = vec![0.0; rows];
        }
    }

    /// The entries, row-major, to be filled in before [`Self::factorise`].
    pub(super) fn entries_mut(&mut self) -> &mut [f64] {
        &mut self.entries
    }

    /// Replaces the entries by their factors; false when the matrix is singular or not finite.
    #[inline]
    pub(super) fn factorise(&mut self) -> bool {
        self.equilibrate() && self.eliminate()
    }

    fn equilibrate(&mut self) -> bool {
        let n = self.rows;
        for (row, scale) in self.entries.chunks_exact_mut(n.max(1)).zip(&mut self.scales) {
            let mut largest = 0.0_f64;
            for entry in row.iter() {
                largest = largest.max(entry.abs());
            }
            // NaN and infinite entries fail at the pivots.
            *scale = 1.0 / largest;
            if largest == 0.0 {
                return false;
            }
            for entry in row {
                *entry *= *scale;
            }
        }
        true
    }

    fn eliminate(&mut self) -> bool {
        let n = self.rows;
        for (i, slot) in self.order.iter_mut().enumerate() {
            *slot = i;
        }
        for j in 0..n {
            let mut pivot = j;
            for i in j + 1..n {
                if self.entries[i * n + j].abs() > self.entries[pivot * n + j].abs() {
                    pivot = i;
                }
            }
            let value = self.entries[pivot * n + j];
            if value == 0.0 || !value.is_finite() {
                return false;
            }
            if pivot != j {
                let (upper, lower) = self.entries.split_at_mut(pivot * n);
                upper[j * n..j * n + n].swap_with_slice(&mut lower[..n]);
                self.order.swap(j, pivot);
            }
            self.reduce(j, 1.0 / value);
        }
        true
    }

    /// Subtracts multiples of row j from the rows below it.
    #[inline]
    fn reduce(&mut self, j: usize, inverse: f64) {
        let n = self.rows;
        let (upper, lower) = self.entries.split_at_mut((j + 1) * n);
        let pivot = &upper[j * n + j + 1..j * n + n];
        for row in lower.chunks_exact_mut(n) {
            let factor = row[j] * inverse;
            row[j] = factor;
            // Blocks of zeros are common.
            if factor != 0.0 {
                for (entry, above) in row[j + 1..].iter_mut().zip(pivot) {
                    *entry -= factor * above;
                }
            }
        }
    }

    /// Solves in place; after a successful [`Self::factorise`].
    #[inline]
    pub(super) fn solve(&mut self, b: &mut [f64]) {
        let n = self.rows;
        for (slot, &i) in self.scratch.iter_mut().zip(&self.order) {
            *slot = b[i] * self.scales[i];
        }
        for i in 1..n {
            let (known, rest) = self.scratch.split_at_mut(i);
            rest[0] -= product(&self.entries[i * n..i * n + i], known);
        }
        for i in (0..n).rev() {
            let (rest, known) = self.scratch.split_at_mut(i + 1);
            let sum = rest[i] - product(&self.entries[i * n + i + 1..(i + 1) * n], known);
            rest[i] = sum / self.entries[i * n + i];
        }
        b.copy_from_slice(&self.scratch);
    }
}

#[inline]
fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::Factors;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn solves_what_nalgebra_solves_and_refuses_singular_matrices() {
        let n = 7;
        let matrix = DMatrix::from_fn(n, n, |i, j| ((3 * i + 5 * j + i * j) as f64).sin() * 10f64.powi(i as i32 - 3));
        let b = DVector::from_fn(n, |i, _| 10f64.powi(i as i32 - 3) * (i as f64).cos());
        let mut factors = Factors::default();
        factors.resize(n);
        factors.entries_mut().copy_from_slice(matrix.transpose().as_slice());
        assert!(factors.factorise());
        let mut x = b.as_slice().to_vec();
        factors.solve(&mut x);
        let exact = matrix.lu().solve(&b);
        for (a, b) in x.iter().zip(exact.iter().flatten()) {
            approx::assert_relative_eq!(*a, *b, max_relative = 1e-11);
        }
        factors.entries_mut().fill(1.0);
        assert!(!factors.factorise());
        factors.entries_mut().fill(f64::NAN);
        assert!(!factors.factorise());
        factors.entries_mut().fill(0.0);
        assert!(!factors.factorise());
    }
}
