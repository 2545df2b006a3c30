//! Points that fill a cube evenly: a scrambled Sobol sequence.
//!
//! Owen's scrambling keeps what makes the sequence even (each block of 2^k points has one in each of 2^k equal boxes) and
//! lets a seed choose among sequences. B. Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020; direction
//! numbers by Joe and Kuo. The crate `sobol_burley` has both.

use crate::random::mixed;

/// Points of one sequence of the crate; the next ones come from a sequence of another seed.
const LENGTH: usize = 1 << 16;

/// Coordinate `axis` of point `number` of the sequence of a seed, in [0, 1).
pub(crate) fn coordinate(number: usize, axis: usize, seed: u64) -> f64 {
    let axes = sobol_burley::NUM_DIMENSIONS as usize;
    let sequence = mixed(seed ^ mixed((number / LENGTH) as u64) ^ mixed((axis / axes) as u64).rotate_left(32));
    // The casts keep all bits: both remainders are below 2^16, and of the mixed seed any 32 bits will do.
    f64::from(sobol_burley::sample((number % LENGTH) as u32, (axis % axes) as u32, sequence as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_points_fall_into_sixteen_boxes() {
        for seed in [0, 1, 77] {
            for axes in [(0, 1), (1, 2), (0, 3)] {
                let mut lines = ([false; 16], [false; 16]);
                for number in 0..16 {
                    let box_of = |axis| (16.0 * coordinate(number, axis, seed)) as usize;
                    lines.0[box_of(axes.0)] = true;
                    lines.1[box_of(axes.1)] = true;
                }
                assert!(lines.0.iter().chain(&lines.1).all(|hit| *hit), "seed {seed}, axes {axes:?}");
            }
        }
    }

    #[test]
    fn every_number_axis_and_seed_has_its_own_value() {
        let base = coordinate(5, 0, 0);
        assert!((0.0..1.0).contains(&base));
        for (number, axis, seed) in [(6, 0, 0), (5, 1, 0), (5, 0, 1), (5 + LENGTH, 0, 0), (5, 256, 0), (5, 0, 1 << 40)]
        {
            let other = coordinate(number, axis, seed);
            assert!((0.0..1.0).contains(&other) && other != base, "{number} {axis} {seed}");
        }
    }
}
