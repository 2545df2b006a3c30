//! The numbers that a replay computes with: reals, lanes of reals, and dual numbers over either.

use crate::scalar::{Real, Scalar};
use crate::sensitivity::Dual;

/// A number whose values (without the derivatives that it carries) can be looked at, lane by lane.
pub(crate) trait Number: Scalar {
    /// How many values there are side by side.
    const LANES: usize;
    /// The order of the derivatives that it carries: products of more variations than this vanish.
    const ORDER: usize;

    /// Numbers that do not vary, one a lane.
    fn from_values(value: impl FnMut(usize) -> f64) -> Self;
    /// The value in a lane; NaN where there is no such lane.
    fn lane(self, index: usize) -> f64;
    /// Whether a mask holds in a lane; false where there is no such lane.
    fn holds(mask: Self::Mask, index: usize) -> bool;

    /// Whether a mask holds in all lanes.
    fn all(mask: Self::Mask) -> bool {
        (0..Self::LANES).all(|lane| Self::holds(mask, lane))
    }

    /// The same answer in all lanes.
    fn mask(answer: bool) -> Self::Mask {
        let one = Self::constant(1.0);
        one.less(Self::constant(if answer { 2.0 } else { 0.0 }))
    }
}

impl<R: Real> Number for R {
    const LANES: usize = R::LANES;
    const ORDER: usize = 0;

    #[inline]
    fn from_values(value: impl FnMut(usize) -> f64) -> Self {
        R::from_lanes(value)
    }
    #[inline]
    fn lane(self, index: usize) -> f64 {
        R::lane(self, index)
    }
    #[inline]
    fn holds(mask: R::Mask, index: usize) -> bool {
        R::holds(mask, index)
    }
}

impl<S: Number, const K: usize> Number for Dual<S, K> {
    const LANES: usize = S::LANES;
    const ORDER: usize = S::ORDER + 1;

    #[inline]
    fn from_values(value: impl FnMut(usize) -> f64) -> Self {
        Self { value: S::from_values(value), derivative: [S::constant(0.0); K] }
    }
    #[inline]
    fn lane(self, index: usize) -> f64 {
        self.value.lane(index)
    }
    #[inline]
    fn holds(mask: S::Mask, index: usize) -> bool {
        S::holds(mask, index)
    }
}
