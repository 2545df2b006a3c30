//! Seeded normal random numbers, by the polar form of Box and Muller.

use crate::random::SplitMix64;

/// A sequence that its seed determines.
#[derive(Clone, Debug)]
pub(super) struct Noise {
    random: SplitMix64,
    spare: Option<f64>,
}

impl Noise {
    /// The sequence of a seed.
    pub(super) fn new(seed: u64) -> Self {
        Self { random: SplitMix64::new(seed), spare: None }
    }

    /// The next normal number, of mean 0 and variance 1.
    pub(super) fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (x, y) = (2.0 * self.random.uniform() - 1.0, 2.0 * self.random.uniform() - 1.0);
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                let factor = (-2.0 * square.ln() / square).sqrt();
                self.spare = Some(y * factor);
                return x * factor;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_the_normal_distribution() {
        let mut noise = Noise::new(7);
        let n = 100_000;
        let values: Vec<f64> = (0..n).map(|_| noise.normal()).collect();
        let moment = |k: i32| values.iter().map(|x| x.powi(k)).sum::<f64>() / f64::from(n);
        // Five standard deviations of each mean.
        for (k, exact, spread) in [(1, 0.0, 1.0_f64), (2, 1.0, 2.0), (3, 0.0, 15.0), (4, 3.0, 96.0)] {
            assert!((moment(k) - exact).abs() < 5.0 * (spread / f64::from(n)).sqrt(), "{k}: {}", moment(k));
        }
        let neighbours = values.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / f64::from(n);
        assert!(neighbours.abs() < 5.0 / f64::from(n).sqrt());
        assert_eq!(Noise::new(3).normal(), Noise::new(3).normal());
        assert_ne!(Noise::new(3).normal(), Noise::new(4).normal());
    }
}
