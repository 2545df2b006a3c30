//! Brute force: a dense grid over the ranges, then nested golden sections around every local optimum of the grid.
//!
//! Nothing here uses a derivative or a line of the optimizer. Samples are compared by their violation first and their cost
//! second, so that the best point of a line is found whether it lies inside, on an active constraint or at a kink; the best
//! of all lines is then a search over one variable less.

use super::instance::{Instance, Sample};
use std::collections::VecDeque;

/// Points along each axis for one, two and three parameters.
const POINTS: [usize; 3] = [101, 33, 13];
/// So many local optima of the grid are polished, the best first.
const POLISHED: usize = 3;
/// How far from the end of a range a value is compared with that at the end itself, in fractions of the range.
const NEXT_TO: f64 = 1e-7;
/// Rounds of polishing: each looks around what the one before has found.
const ROUNDS: [Round; 2] = [Round { reach: 1.0, until: 1e-3 }, Round { reach: 0.05, until: 1e-8 }];

/// How far a round looks, in spacings of the grid, and how finely, in fractions of the ranges.
struct Round {
    reach: f64,
    until: f64,
}

/// All local optima that brute force finds, the best first.
pub fn optima(instance: &Instance) -> Vec<Sample> {
    let points = POINTS[(instance.len() - 1).min(2)];
    let grid = flood(instance, points);
    let mut found: Vec<Sample> = Vec::new();
    for peak in peaks(&grid, points, instance.len()) {
        let Some(polished) = polish(instance, peak, 1.0 / (points - 1) as f64) else { continue };
        let known = |other: &Sample| other.at.iter().zip(&polished.at).all(|(a, b)| (a - b).abs() < 1e-3);
        if polished.violation == 0.0 && !found.iter().any(known) {
            found.push(polished);
        }
    }
    found.sort_by(|a, b| if a.better(b) { std::cmp::Ordering::Less } else { std::cmp::Ordering::Greater });
    found
}

/// Gaits at all points of the grid, each found from a neighbour's, outwards from the spec's own.
fn flood(instance: &Instance, points: usize) -> Vec<Option<Sample>> {
    let n = instance.len();
    let mut grid: Vec<Option<Sample>> = vec![None; points.pow(n as u32)];
    let home = instance.home();
    let first: Vec<usize> =
        instance.fractions(&home.0).iter().map(|x| (x * (points - 1) as f64).round() as usize).collect();
    let at = fractions(&first, points);
    let start = instance.follow(&home, &instance.parameters(&at)).expect("the grid begins at a gait");
    let mut queue = VecDeque::new();
    grid[number(&first, points)] = instance.sample(&at, &start);
    queue.push_back(first);
    while let Some(place) = queue.pop_front() {
        let Some(here) = grid[number(&place, points)].clone() else { continue };
        for axis in 0..n {
            for next in
                [place[axis].checked_sub(1), Some(place[axis] + 1).filter(|k| *k < points)].into_iter().flatten()
            {
                let mut other = place.clone();
                other[axis] = next;
                let cell = &mut grid[number(&other, points)];
                if cell.is_none() {
                    *cell = instance.sample(&fractions(&other, points), &here.coordinates);
                    if cell.is_some() {
                        queue.push_back(other);
                    }
                }
            }
        }
    }
    grid
}

fn fractions(place: &[usize], points: usize) -> Vec<f64> {
    place.iter().map(|k| *k as f64 / (points - 1) as f64).collect()
}

fn number(place: &[usize], points: usize) -> usize {
    place.iter().fold(0, |number, k| number * points + k)
}

/// The samples that no neighbour, also across corners, is better than; the best first.
fn peaks(grid: &[Option<Sample>], points: usize, n: usize) -> Vec<&Sample> {
    let mut peaks: Vec<&Sample> = Vec::new();
    for (index, sample) in grid.iter().enumerate() {
        let Some(sample) = sample else { continue };
        let place: Vec<usize> = (0..n).map(|axis| index / points.pow((n - 1 - axis) as u32) % points).collect();
        let beaten = (0..3_usize.pow(n as u32)).any(|code| {
            let moved =
                place.iter().enumerate().map(|(axis, k)| (k + code / 3_usize.pow(axis as u32) % 3).wrapping_sub(1));
            let other: Vec<usize> = moved.collect();
            other.iter().all(|k| *k < points)
                && grid[number(&other, points)].as_ref().is_some_and(|other| other.better(sample))
        });
        if !beaten {
            peaks.push(sample);
        }
    }
    peaks.sort_by(|a, b| if a.better(b) { std::cmp::Ordering::Less } else { std::cmp::Ordering::Greater });
    peaks.truncate(POLISHED);
    peaks
}

/// The best point near a sample, `spacing` (in fractions of the ranges) around it.
pub fn polish(instance: &Instance, near: &Sample, spacing: f64) -> Option<Sample> {
    let mut best = near.clone();
    for round in &ROUNDS {
        // A best point at the rim of what was looked at has better ones behind it: look again from there.
        for _ in 0..20 {
            let line = Lines { instance, centre: best.clone(), reach: round.reach * spacing, until: round.until };
            let found = line.best(&mut best.at.clone(), 0, &mut best.coordinates.clone())?;
            let rim = found.at.iter().zip(&best.at).any(|(a, b)| (a - b).abs() > 0.9 * line.reach);
            let better = found.better(&best);
            if better {
                best = found;
            }
            if !(rim && better) {
                break;
            }
        }
    }
    Some(best)
}

/// Nested golden sections in a box.
struct Lines<'a> {
    instance: &'a Instance,
    centre: Sample,
    reach: f64,
    until: f64,
}

impl Lines<'_> {
    /// The best sample over the axes from `axis` on, the others as they stand in `at`; gaits are looked for near `guess`.
    fn best(&self, at: &mut Vec<f64>, axis: usize, guess: &mut Vec<f64>) -> Option<Sample> {
        if axis == at.len() {
            let sample = self.instance.sample(at, guess).or_else(|| self.instance.sample(at, &self.centre.coordinates));
            if let Some(sample) = &sample {
                guess.clone_from(&sample.coordinates);
            }
            return sample;
        }
        let low = (self.centre.at[axis] - self.reach).max(0.0);
        let high = (self.centre.at[axis] + self.reach).min(1.0);
        let mut best: Option<Sample> = None;
        let mut value = |x: f64| {
            at[axis] = x;
            let sample = self.best(at, axis + 1, guess);
            if let Some(sample) = &sample
                && best.as_ref().is_none_or(|best| sample.better(best))
            {
                best = Some(sample.clone());
            }
            sample
        };
        // The ends of a range belong to it. Where it gets worse from there on, the best of the line is the end itself.
        for (end, next) in [(low, low + NEXT_TO), (high, high - NEXT_TO)] {
            if (end == 0.0 || end == 1.0)
                && let Some(at_end) = value(end)
                && value(next).is_some_and(|next| at_end.better(&next))
            {
                return best;
            }
        }
        golden(&mut value, low, high, self.until);
        best
    }
}

/// Golden section; a point without a gait is worse than any with one.
fn golden(value: &mut impl FnMut(f64) -> Option<Sample>, mut a: f64, mut b: f64, until: f64) {
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut c, mut d) = (b - ratio * (b - a), a + ratio * (b - a));
    let (mut at_c, mut at_d) = (value(c), value(d));
    while b - a > until {
        let left = match (&at_c, &at_d) {
            (Some(c), Some(d)) => c.better(d),
            (c, _) => c.is_some(),
        };
        if left {
            (b, d) = (d, c);
            at_d = at_c;
            c = b - ratio * (b - a);
            at_c = value(c);
        } else {
            (a, c) = (c, d);
            at_c = at_d;
            d = a + ratio * (b - a);
            at_d = value(d);
        }
    }
}
