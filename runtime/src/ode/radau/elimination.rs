//! The linear system of all stages, with states that need only be substituted taken out first.
//!
//! Ordered by states, the matrix has blocks B_ab of S x S. A state t whose equation is x_t' = f with an f that does not depend on
//! x_t has B_tt = 1: its rates follow from the others' by substitution, which turns the other blocks into
//! B_ab - B_at B_tb. What remains is factorised with pivoting. Blocks that are zero cost nothing.

use super::lu::Factors;
use crate::model::Linearised;

/// The rows of one state in the columns of another.
type Block<const S: usize> = [[f64; S]; S];

/// The system of N states and S stages; also its room.
#[derive(Clone, Debug)]
pub(super) struct System<const N: usize, const S: usize> {
    /// Blocks by equation and state.
    blocks: Vec<[Block<S>; N]>,
    /// Which blocks of an equation are not zero, one bit each.
    filled: [u64; N],
    /// The states: those that are substituted, in order, then the others.
    order: [usize; N],
    /// How many are substituted.
    substituted: usize,
    /// What the equations were multiplied with, at each stage.
    scales: [[f64; S]; N],
    /// The remaining equations.
    rest: Factors<S, N>,
}

impl<const N: usize, const S: usize> Default for System<N, S> {
    fn default() -> Self {
        const { assert!(N <= 64, "one bit a state") };
        Self {
            blocks: vec![[[[0.0; S]; S]; N]; N],
            filled: [0; N],
            order: core::array::from_fn(|a| a),
            substituted: 0,
            scales: [[1.0; S]; N],
            rest: Factors::default(),
        }
    }
}

impl<const N: usize, const S: usize> System<N, S> {
    /// Fills in delta_ij F_k + h a_ij F_x and eliminates; false when the matrix is singular or not finite.
    pub(super) fn factorise(&mut self, a: &[[f64; S]; S], h: f64, linearised: &[Linearised<f64, N>; S]) -> bool {
        let mut candidates = 0_u64;
        for row in 0..N {
            let candidate = unit_diagonal(row, linearised);
            candidates |= u64::from(candidate) << row;
            self.scales[row] = if candidate { [1.0; S] } else { linearised.each_ref().map(|at| row_scale(at, h, row)) };
            self.fill(row, a, h, linearised);
        }
        self.substitute(candidates);
        let rest = &self.order[self.substituted..];
        self.rest.resize(rest.len());
        for (position, &row) in rest.iter().enumerate() {
            for (block, &column) in rest.iter().enumerate() {
                let filled = self.filled[row] & (1 << column) != 0;
                self.rest.set(position, block, filled.then(|| &self.blocks[row][column]));
            }
        }
        self.rest.factorise()
    }

    #[inline]
    fn fill(&mut self, row: usize, a: &[[f64; S]; S], h: f64, linearised: &[Linearised<f64, N>; S]) {
        self.filled[row] = 0;
        for column in 0..N {
            if linearised.iter().all(|at| at.dx[column][row] == 0.0 && at.dk[column][row] == 0.0) {
                continue;
            }
            self.filled[row] |= 1 << column;
            let block = &mut self.blocks[row][column];
            for (i, at) in linearised.iter().enumerate() {
                let scale = self.scales[row][i];
                let weight = scale * h * at.dx[column][row];
                for j in 0..S {
                    block[i][j] = weight * a[i][j];
                }
                block[i][i] += scale * at.dk[column][row];
            }
        }
    }

    /// Takes the candidates out of the equations that come after theirs. One whose own block an earlier substitution has
    /// changed is no candidate any more.
    fn substitute(&mut self, candidates: u64) {
        let (mut first, mut last, mut left, mut gone) = (0, N, candidates, 0_u64);
        for t in (0..N).rev().filter(|&t| candidates & (1 << t) == 0) {
            last -= 1;
            self.order[last] = t;
        }
        for t in bits(candidates) {
            if left & (1 << t) == 0 {
                last -= 1;
                self.order[last] = t;
                continue;
            }
            self.order[first] = t;
            first += 1;
            left &= !(1 << t);
            gone |= 1 << t;
            let (by, columns) = (self.blocks[t], self.filled[t] & !gone);
            for row in 0..N {
                if gone & (1 << row) != 0 || self.filled[row] & (1 << t) == 0 {
                    continue;
                }
                let factor = self.blocks[row][t];
                for column in bits(columns) {
                    if self.filled[row] & (1 << column) == 0 {
                        self.blocks[row][column] = [[0.0; S]; S];
                    }
                    subtract_product(&factor, &by[column], &mut self.blocks[row][column]);
                }
                self.filled[row] |= columns;
                if columns & (1 << row) != 0 {
                    left &= !(1 << row);
                }
            }
        }
        self.substituted = first;
    }

    /// The rates of all stages for the right-hand side `b`; after a successful [`Self::factorise`].
    pub(super) fn solve(&mut self, b: &[[f64; N]; S]) -> [[f64; N]; S] {
        let mut x: [[f64; S]; N] = core::array::from_fn(|a| core::array::from_fn(|i| b[i][a] * self.scales[a][i]));
        let (substituted, rest) = self.order.split_at(self.substituted);
        for (position, &t) in substituted.iter().enumerate() {
            let value = x[t];
            for &row in &self.order[position + 1..] {
                if self.filled[row] & (1 << t) != 0 {
                    subtract_applied(&self.blocks[row][t], &value, &mut x[row]);
                }
            }
        }
        let solution = self.rest.solve(|position| rest.get(position).map_or([0.0; S], |&row| x[row]));
        for (&row, value) in rest.iter().zip(solution) {
            x[row] = *value;
        }
        let mut gone = substituted.iter().fold(0_u64, |set, t| set | 1 << t);
        for &t in substituted.iter().rev() {
            // What was substituted before it is no longer in its equation; the block there is the factor of the right-hand side.
            let mut value = x[t];
            let columns = self.filled[t] & !gone;
            gone &= !(1 << t);
            for column in bits(columns) {
                subtract_applied(&self.blocks[t][column], &x[column], &mut value);
            }
            x[t] = value;
        }
        core::array::from_fn(|i| core::array::from_fn(|a| x[a][i]))
    }
}

/// Whether an equation reads x_a' = f with an f that does not depend on x_a.
fn unit_diagonal<const N: usize, const S: usize>(a: usize, linearised: &[Linearised<f64, N>; S]) -> bool {
    let unit = |at: &Linearised<f64, N>| (0..N).all(|b| at.dk[b][a] == f64::from(u8::from(a == b)));
    linearised.iter().all(|at| at.dx[a][a] == 0.0 && unit(at))
}

/// The inverse of the largest derivative of equation a; 1 where all vanish, which is found when factorising.
#[inline]
pub(super) fn row_scale<const N: usize>(at: &Linearised<f64, N>, h: f64, a: usize) -> f64 {
    let mut largest = 0.0_f64;
    for b in 0..N {
        largest = largest.max(at.dk[b][a].abs()).max((h * at.dx[b][a]).abs());
    }
    if largest > 0.0 { 1.0 / largest } else { 1.0 }
}

/// The members of a set.
fn bits(mut set: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let member = set.trailing_zeros() as usize;
        set &= set.wrapping_sub(1);
        (member < 64).then_some(member)
    })
}

/// target -= a b.
#[inline]
fn subtract_product<const S: usize>(a: &Block<S>, b: &Block<S>, target: &mut Block<S>) {
    for i in 0..S {
        for j in 0..S {
            for k in 0..S {
                target[i][k] -= a[i][j] * b[j][k];
            }
        }
    }
}

/// target -= a x.
#[inline]
fn subtract_applied<const S: usize>(a: &Block<S>, x: &[f64; S], target: &mut [f64; S]) {
    for i in 0..S {
        for j in 0..S {
            target[i] -= a[i][j] * x[j];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::System;
    use crate::model::Linearised;
    use crate::ode::radau::RADAU5;
    use nalgebra::{DMatrix, DVector};

    /// Derivatives with zeros where `zero` says so, and unit rows in the mass matrix where `unit` says so.
    fn linearised<const N: usize>(
        zero: &dyn Fn(usize, usize) -> bool,
        unit: &dyn Fn(usize) -> bool,
    ) -> [Linearised<f64, N>; 5] {
        core::array::from_fn(|i| {
            let dx = |b: usize, a: usize| {
                if zero(a, b) { 0.0 } else { ((1 + i + 3 * a + 5 * b + a * b) as f64).sin() }
            };
            let dk = |b: usize, a: usize| match unit(a) {
                true => f64::from(u8::from(a == b)),
                false => ((2 + i + 7 * a + 2 * b) as f64).cos(),
            };
            let matrix = |f: &dyn Fn(usize, usize) -> f64| core::array::from_fn(|b| core::array::from_fn(|a| f(b, a)));
            Linearised { value: [0.0; N], dx: matrix(&dx), dk: matrix(&dk) }
        })
    }

    fn check<const N: usize>(zero: &dyn Fn(usize, usize) -> bool, unit: &dyn Fn(usize) -> bool) {
        let (h, at) = (0.3, linearised::<N>(zero, unit));
        let mut system = System::<N, 5>::default();
        let right: [[f64; N]; 5] = core::array::from_fn(|i| core::array::from_fn(|a| ((i + 2 * a) as f64).cos()));
        let matrix = DMatrix::from_fn(5 * N, 5 * N, |row, column| {
            let (i, a, j, b) = (row / N, row % N, column / N, column % N);
            h * RADAU5.a[i][j] * at[i].dx[b][a] + if i == j { at[i].dk[b][a] } else { 0.0 }
        });
        let exact = matrix.lu().solve(&DVector::from_fn(5 * N, |row, _| right[row / N][row % N]));
        // Twice: what is left of a first matrix must not matter.
        for _ in 0..2 {
            assert!(system.factorise(&RADAU5.a, h, &at));
            for (x, exact) in system.solve(&right).as_flattened().iter().zip(exact.iter().flatten()) {
                approx::assert_relative_eq!(*x, *exact, max_relative = 1e-9);
            }
        }
    }

    #[test]
    fn solves_what_nalgebra_solves() {
        // Nothing, all, some to substitute; a chain; a pair of which the second is no longer to be substituted after the first.
        check::<3>(&|_, _| false, &|_| false);
        check::<1>(&|_, _| true, &|_| true);
        check::<4>(&|a, b| a == b || a > b + 1, &|_| true);
        check::<4>(&|a, b| a == b && a != 2, &|a| a != 1);
        check::<5>(&|a, b| a == b || (a + b) % 3 == 1, &|a| a > 0);
        check::<2>(&|a, b| a == b, &|_| true);
        // The second depends on the first, not the other way round: both are substituted.
        check::<4>(&|a, b| a == b && a < 2 || (a, b) == (0, 1), &|a| a < 2);
        check::<5>(&|a, b| a == b && a < 3 || a < b && b < 3, &|a| a < 3);
    }

    #[test]
    fn refuses_what_has_no_solution() {
        let mut at = linearised::<2>(&|_, _| false, &|_| false);
        for stage in &mut at {
            (stage.dx, stage.dk) = ([[1.0, 1.0]; 2], [[0.5, 0.5]; 2]);
        }
        assert!(!System::<2, 5>::default().factorise(&RADAU5.a, 0.1, &at));
        at[3].dx[0][1] = f64::NAN;
        assert!(!System::<2, 5>::default().factorise(&RADAU5.a, 0.1, &at));
    }
}
