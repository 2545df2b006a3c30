//! The linear system of all stages, with states that need only be substituted taken out first.
//!
//! The unknowns are w_a = A k_a, with which the state at the stages changes by h w_a: unlike the changes themselves they are
//! known where h is zero. An equation that has no rate of a state has diagonal blocks B_ab = h F_x, and one that has it has
//! B_ab = h F_x + F_k A^-1. A state t whose equation is x_t' = f with an f that does not depend on x_t has B_tt = A^-1: it follows
//! from the others by w_t = A (r_t - sum_b B_tb w_b), which turns the other blocks into B_ab - B_at A B_tb. What remains
//! is inverted with pivoting. Blocks that are zero cost nothing, diagonal ones little.

use super::coefficients::Tableau;
use super::fused::{Block, applied, entries, less_applied, less_entries, scaled};
use super::inverse::Inverse;
use crate::model::Linearised;

/// A number for each stage.
type Staged<const S: usize> = [f64; S];

/// The system of N states and S stages; also its room.
#[derive(Clone, Debug)]
pub(super) struct System<const N: usize, const S: usize> {
    /// Diagonal blocks by equation and state, those in [`Pattern::diagonal`].
    diagonals: Vec<[Staged<S>; N]>,
    /// Full blocks by equation and state, those in [`Pattern::full`]; of substituted equations A B_tb.
    blocks: Vec<[Block<S>; N]>,
    /// Which blocks of an equation are what.
    patterns: [Pattern; N],
    /// The states: those that are substituted, in order, then the others.
    order: [usize; N],
    /// How many are substituted, ...
    substituted: usize,
    /// ... and which: one bit each. They are taken in ascending order.
    taken: u64,
    /// Size of the step.
    h: f64,
    /// A.
    integration: Block<S>,
    /// A^-1.
    differentiation: Block<S>,
    /// What the remaining equations were multiplied with.
    scales: Vec<Staged<S>>,
    /// The remaining equations.
    rest: Inverse,
}

/// Sets of states, one bit each.
#[derive(Clone, Copy, Debug, Default)]
struct Pattern {
    /// Columns with a diagonal block.
    diagonal: u64,
    /// Columns with a full block.
    full: u64,
    /// The own column, where its block is A^-1 and not stored.
    implied: u64,
}

impl Pattern {
    fn has(&self, column: usize) -> bool {
        (self.diagonal | self.full) & (1 << column) != 0
    }

    /// The block of a column, written out in full.
    #[inline(always)]
    fn fill_up<'a, const N: usize, const S: usize>(
        &mut self,
        blocks: &'a mut [Block<S>; N],
        diagonals: &[Staged<S>; N],
        column: usize,
        differentiation: &Block<S>,
    ) -> &'a mut Block<S> {
        let (block, bit) = (&mut blocks[column], 1 << column);
        if self.full & bit == 0 {
            *block = if self.implied & bit != 0 { *differentiation } else { [[0.0; S]; S] };
            if self.diagonal & bit != 0 {
                for i in 0..S {
                    block[i][i] += diagonals[column][i];
                }
            }
            self.diagonal &= !bit;
            self.implied &= !bit;
            self.full |= bit;
        }
        block
    }
}

impl<const N: usize, const S: usize> Default for System<N, S> {
    fn default() -> Self {
        const { assert!(N <= 64, "one bit a state") };
        Self {
            diagonals: vec![[[0.0; S]; N]; N],
            blocks: vec![[[[0.0; S]; S]; N]; N],
            patterns: [Pattern::default(); N],
            order: core::array::from_fn(|a| a),
            substituted: 0,
            taken: 0,
            h: 0.0,
            integration: [[0.0; S]; S],
            differentiation: [[0.0; S]; S],
            scales: vec![[1.0; S]; N],
            rest: Inverse::default(),
        }
    }
}

impl<const N: usize, const S: usize> System<N, S> {
    /// Fills in the blocks and eliminates; false when the matrix is singular or not finite.
    pub(super) fn factorise(&mut self, tableau: &Tableau<S>, h: f64, linearised: &[Linearised<f64, N>; S]) -> bool {
        self.h = h;
        for k in 0..S {
            for i in 0..S {
                self.integration[k][i] = tableau.a[i][k];
                self.differentiation[k][i] = tableau.inverse[i][k];
            }
        }
        let filled = Filled::of(linearised);
        let mut candidates = 0;
        for row in 0..N {
            let candidate = filled.substitutable(row);
            candidates |= u64::from(candidate) << row;
            self.fill(row, candidate, &filled, linearised);
        }
        self.substitute(candidates);
        self.gather();
        self.rest.invert()
    }

    #[inline]
    fn fill(&mut self, row: usize, candidate: bool, filled: &Filled<N>, linearised: &[Linearised<f64, N>; S]) {
        let mut pattern = Pattern::default();
        for column in 0..N {
            let (by_state, by_rate) = (filled.states[column][row] != 0, filled.rates[column][row] != 0 && !candidate);
            if by_state || by_rate {
                for (entry, at) in self.diagonals[row][column].iter_mut().zip(linearised) {
                    *entry = self.h * at.dx[column][row];
                }
                pattern.diagonal |= 1 << column;
            }
            if by_rate {
                let block = pattern.fill_up(&mut self.blocks[row], &self.diagonals[row], column, &self.differentiation);
                let mut mass = [0.0; S];
                for i in 0..S {
                    mass[i] = -linearised[i].dk[column][row];
                }
                for k in 0..S {
                    block[k] = less_entries(block[k], mass, self.differentiation[k]);
                }
            }
        }
        pattern.implied = u64::from(candidate) << row;
        self.patterns[row] = pattern;
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
            let columns = (self.patterns[t].diagonal | self.patterns[t].full) & !gone;
            for column in 0..N {
                if columns & (1 << column) != 0 {
                    self.integrate(t, column);
                    for row in 0..N {
                        if gone & (1 << row) == 0 && self.patterns[row].has(t) {
                            self.subtract(row, t, column);
                        }
                    }
                }
            }
            left &= !bits(left).filter(|&row| self.patterns[row].implied == 0).fold(0, |set, row| set | 1 << row);
        }
        (self.substituted, self.taken) = (first, gone);
    }

    /// Turns B_tb into A B_tb.
    #[inline]
    fn integrate(&mut self, t: usize, column: usize) {
        let (pattern, block) = (&mut self.patterns[t], &mut self.blocks[t][column]);
        if pattern.full & (1 << column) != 0 {
            for k in 0..S {
                block[k] = applied(&self.integration, block[k]);
            }
        } else {
            for k in 0..S {
                let factor = self.diagonals[t][column][k];
                block[k] = scaled(factor, self.integration[k]);
            }
            pattern.diagonal &= !(1 << column);
            pattern.full |= 1 << column;
        }
    }

    /// Subtracts B_at A B_tb from B_ab; a is `row`, b is `column`.
    #[inline]
    fn subtract(&mut self, row: usize, t: usize, column: usize) {
        let (pattern, diagonals) = (&mut self.patterns[row], &self.diagonals[row]);
        let Ok([blocks, by]) = self.blocks.get_disjoint_mut([row, t]) else {
            return;
        };
        let by = &by[column];
        if pattern.full & (1 << t) != 0 {
            let factor = blocks[t];
            let target = pattern.fill_up(blocks, diagonals, column, &self.differentiation);
            for k in 0..S {
                target[k] = less_applied(target[k], &factor, by[k]);
            }
        } else {
            let factor = diagonals[t];
            let target = pattern.fill_up(blocks, diagonals, column, &self.differentiation);
            for k in 0..S {
                target[k] = less_entries(target[k], factor, by[k]);
            }
        }
    }

    /// Hands the remaining equations to [`Inverse`], each divided by its largest entry.
    fn gather(&mut self) {
        let rest = &self.order[self.substituted..];
        self.rest.resize(rest.len() * S);
        for &row in rest {
            let pattern = &self.patterns[row];
            let mut largest = [0.0_f64; S];
            for &column in rest {
                let bit = 1 << column;
                if pattern.full & bit != 0 {
                    for entries in &self.blocks[row][column] {
                        for i in 0..S {
                            largest[i] = largest[i].max(entries[i].abs());
                        }
                    }
                } else if pattern.diagonal & bit != 0 {
                    for i in 0..S {
                        largest[i] = largest[i].max(self.diagonals[row][column][i].abs());
                    }
                }
            }
            // Where all are zero, that is found when factorising.
            self.scales[row] = largest.map(|v| if v > 0.0 { 1.0 / v } else { 1.0 });
        }
        for (block, &column) in rest.iter().enumerate() {
            let bit = 1 << column;
            for k in 0..S {
                let (column_entries, _) = self.rest.column(block * S + k).as_chunks_mut::<S>();
                for (&row, column_entries) in rest.iter().zip(column_entries) {
                    let (pattern, scale) = (&self.patterns[row], &self.scales[row]);
                    if pattern.full & bit != 0 {
                        *column_entries = entries(*scale, self.blocks[row][column][k]);
                    } else {
                        *column_entries = [0.0; S];
                        if pattern.diagonal & bit != 0 {
                            column_entries[k] = scale[k] * self.diagonals[row][column][k];
                        }
                    }
                }
            }
        }
    }

    /// Rates of all stages for the right-hand side `right`, and the increments of the state that they make; after a successful
    /// [`Self::factorise`].
    pub(super) fn solve(&mut self, right: &[[f64; N]; S]) -> Solution<N, S> {
        let mut x = [[0.0; S]; N];
        for i in 0..S {
            for a in 0..N {
                x[a][i] = right[i][a];
            }
        }
        let mut gone = 0_u64;
        for t in 0..N {
            if self.taken & (1 << t) == 0 {
                continue;
            }
            gone |= 1 << t;
            let value = applied(&self.integration, x[t]);
            x[t] = value;
            for row in 0..N {
                let pattern = &self.patterns[row];
                if gone & (1 << row) != 0 {
                    continue;
                }
                if pattern.diagonal & (1 << t) != 0 {
                    x[row] = less_entries(x[row], self.diagonals[row][t], value);
                } else if pattern.full & (1 << t) != 0 {
                    x[row] = less_applied(x[row], &self.blocks[row][t], value);
                }
            }
        }
        self.solve_rest(&mut x);
        for t in (0..N).rev() {
            if self.taken & (1 << t) == 0 {
                continue;
            }
            // What was substituted before it is no longer in its equation; the block there is the factor of the right-hand side.
            let columns = self.patterns[t].full & !gone;
            gone &= !(1 << t);
            let mut value = x[t];
            for column in 0..N {
                if columns & (1 << column) != 0 {
                    value = less_applied(value, &self.blocks[t][column], x[column]);
                }
            }
            x[t] = value;
        }
        let mut rates = [[0.0; N]; S];
        for a in 0..N {
            let rate = applied(&self.differentiation, x[a]);
            for i in 0..S {
                rates[i][a] = rate[i];
            }
        }
        Solution { rates, increments: x.map(|x| x.map(|v| self.h * v)) }
    }

    /// The increments of the remaining states, in the place of their equations' right-hand sides.
    #[inline]
    fn solve_rest(&mut self, x: &mut [Staged<S>; N]) {
        let rest = &self.order[self.substituted..];
        let mut scaled = [[0.0; S]; N];
        for (&row, scaled) in rest.iter().zip(&mut scaled) {
            *scaled = entries(x[row], self.scales[row]);
        }
        let (solution, _) = self.rest.solve(scaled.as_flattened()).as_chunks::<S>();
        for (&row, value) in rest.iter().zip(solution) {
            x[row] = *value;
        }
    }
}

/// A solution: rates by stages, increments of the state by states.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solution<const N: usize, const S: usize> {
    /// Of the state's rates at the stages.
    pub(super) rates: [[f64; N]; S],
    /// Of the states at the stages, one array a state.
    pub(super) increments: [Staged<S>; N],
}

/// Which derivatives are not zero at some stage: bits of numbers by state and equation.
struct Filled<const N: usize> {
    states: [[u64; N]; N],
    rates: [[u64; N]; N],
    /// Where the derivatives in the rates differ from those of an equation x' = f.
    masses: [[u64; N]; N],
}

impl<const N: usize> Filled<N> {
    #[inline]
    fn of<const S: usize>(linearised: &[Linearised<f64, N>; S]) -> Self {
        let zero = [[0; N]; N];
        let mut filled = Self { states: zero, rates: zero, masses: zero };
        for at in linearised {
            for b in 0..N {
                for a in 0..N {
                    let unit = if a == b { 1.0_f64.to_bits() } else { 0 };
                    // Without their signs.
                    filled.states[b][a] |= at.dx[b][a].to_bits() << 1;
                    filled.rates[b][a] |= at.dk[b][a].to_bits() << 1;
                    filled.masses[b][a] |= at.dk[b][a].to_bits() ^ unit;
                }
            }
        }
        filled
    }

    /// Whether an equation reads x_a' = f with an f that does not depend on x_a.
    fn substitutable(&self, a: usize) -> bool {
        self.states[a][a] == 0 && self.masses.iter().all(|column| column[a] == 0)
    }
}

/// The members of a set.
fn bits(mut set: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let member = set.trailing_zeros() as usize;
        set &= set.wrapping_sub(1);
        (member < 64).then_some(member)
    })
}

#[cfg(test)]
mod tests;
