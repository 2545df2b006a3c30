//! The numbers that a replay computes with: reals, lanes of reals, and dual numbers over either.

use super::segment::Segment;
use crate::model::{Env, Model};
use crate::scalar::{Lanes, Real, Scalar};
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

    /// The terms of the clock at several times, where it pays to compute them together and beforehand. Numbers that are
    /// lanes already have them at each stage, while the one before is waited for.
    #[inline(always)]
    fn clocks<M, const T: usize, const N: usize, const P: usize, const Q: usize, const C: usize>(
        _: &Segment<'_, Self, P, C>,
        _: &[Self; T],
    ) -> Option<[M::Clock<Self>; T]>
    where
        M: Model<N, P, Q>,
    {
        None
    }

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

macro_rules! real {
    () => {
        const LANES: usize = <Self as Real>::LANES;
        const ORDER: usize = 0;

        #[inline]
        fn from_values(value: impl FnMut(usize) -> f64) -> Self {
            <Self as Real>::from_lanes(value)
        }
        #[inline]
        fn lane(self, index: usize) -> f64 {
            <Self as Real>::lane(self, index)
        }
        #[inline]
        fn holds(mask: Self::Mask, index: usize) -> bool {
            <Self as Real>::holds(mask, index)
        }
    };
}

impl Number for Lanes {
    real!();
}

impl Number for f64 {
    real!();

    /// The times side by side in lanes: they do not wait for each other as the stages of a step do.
    #[inline(always)]
    fn clocks<M, const T: usize, const N: usize, const P: usize, const Q: usize, const C: usize>(
        segment: &Segment<'_, f64, P, C>,
        times: &[f64; T],
    ) -> Option<[M::Clock<f64>; T]>
    where
        M: Model<N, P, Q>,
    {
        const WIDTH: usize = <Lanes as Real>::LANES;
        let (first, second) =
            (side_by_side::<M, N, P, Q, C>(segment, times, 0), side_by_side::<M, N, P, Q, C>(segment, times, WIDTH));
        Some(core::array::from_fn(|i| M::clock_lane(if i < WIDTH { &first } else { &second }, i % WIDTH)))
    }
}

/// The terms of the clock at as many times as there are lanes, from number `first`. They go through memory, where each is a
/// number again.
#[inline(never)]
fn side_by_side<M, const N: usize, const P: usize, const Q: usize, const C: usize>(
    segment: &Segment<'_, f64, P, C>,
    times: &[f64],
    first: usize,
) -> M::Clock<Lanes>
where
    M: Model<N, P, Q>,
{
    let tau = Lanes::from_lanes(|lane| times.get(first + lane).copied().unwrap_or(0.0));
    let t = tau + Lanes::constant(segment.start);
    let (memory, branch) = (&segment.wide_memory, &segment.wide_branch);
    M::clock(segment.mode, &Env { tau, t, p: &segment.p.map(Lanes::constant), memory, branch })
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
