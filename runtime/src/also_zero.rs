//! Functions that vanish together with the guard of the section's transition (`also_zero` of the spec): whether they cross
//! zero with it or only touch it.

/// A function only touches zero when its rate there, kept up for the whole map, would change it by less than this
/// fraction of what the map changes it by.
const TOUCHING: f64 = 1e-6;
/// A value within this fraction of the function's size is zero.
const ZERO: f64 = 1e-6;

/// How a function that should be zero together with a guard goes through the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlsoZeroAt {
    /// Index into `info().transitions`.
    pub transition: usize,
    /// Index into the transition's `also_zero`.
    pub index: usize,
    /// Value at the start of the map.
    pub start: f64,
    /// Value just before the transition.
    pub end: f64,
    /// Time derivative there; 0 where the function only touches zero.
    pub rate: f64,
}

/// How a function behaves at the moment when it should be zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// It is not zero.
    NotZero,
    /// It is zero, and its rate too.
    Touches,
    /// It is zero, and its rate is not.
    Crosses,
}

impl AlsoZeroAt {
    /// How it goes through zero at the end of a map of this duration (s).
    pub fn passage(&self, duration: f64) -> Passage {
        let change = (self.start - self.end).abs();
        let swing = self.rate.abs() * duration;
        let size = self.start.abs().max(change).max(swing);
        // Written so that what is no number counts as not zero.
        if !(self.end.abs() <= ZERO * size || self.end == 0.0) {
            Passage::NotZero
        } else if swing <= TOUCHING * change {
            Passage::Touches
        } else {
            Passage::Crosses
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{AlsoZeroAt, Passage};

    fn passage(start: f64, end: f64, rate: f64) -> Passage {
        AlsoZeroAt { transition: 0, index: 0, start, end, rate }.passage(0.5)
    }

    #[test]
    fn a_function_touches_where_it_is_zero_with_its_rate() {
        assert_eq!(passage(0.13, 1e-17, -3e-12), Passage::Touches);
        assert_eq!(passage(0.13, 0.0, 0.0), Passage::Touches);
        assert_eq!(passage(0.13, 1e-17, -1e-6), Passage::Crosses);
        // Up and down again.
        assert_eq!(passage(0.0, 1e-14, -2.0), Passage::Crosses);
    }

    #[test]
    fn a_function_that_is_not_zero_neither_touches_nor_crosses() {
        assert_eq!(passage(0.13, 1e-3, -3e-12), Passage::NotZero);
        assert_eq!(passage(0.13, 0.13, 0.0), Passage::NotZero);
        assert_eq!(passage(0.13, f64::NAN, 0.0), Passage::NotZero);
    }
}
