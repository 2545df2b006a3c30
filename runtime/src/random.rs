//! Random numbers that a seed determines, the same on every machine: G. Steele, D. Lea and C. Flood, "Fast splittable pseudorandom
//! number generators", OOPSLA 2014. Good enough for test points and disturbances, not for secrets.

/// A sequence of random numbers.
#[derive(Clone, Debug)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// The golden ratio's share of 2^64, by which states follow each other.
    pub const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(Self::STEP);
        mixed(self.state)
    }

    /// The next number in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        // 53 bits are what a number below one holds exactly.
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The generator's finaliser: spreads every bit over all others; 0 stays 0.
pub(crate) fn mixed(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::SplitMix64;

    /// As the authors' program gives them for seed 1234567.
    #[test]
    fn numbers_are_those_of_the_published_generator() {
        let mut random = SplitMix64::new(1_234_567);
        let first: Vec<u64> = (0..3).map(|_| random.bits()).collect();
        assert_eq!(first, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
        assert!((0..1000).all(|_| (0.0..1.0).contains(&random.uniform())));
    }
}
