//! The numbers that a replay computes with: reals, lanes of reals, and dual numbers over either.

use super::segment::Segment;
use crate::model::{Env, Model};
use crate::ode::explicit::NODES;
use crate::scalar::{Lanes, Real, Scalar};
use crate::sensitivity::Dual;

/// Stages of a step but the first, whose rates are known; the last is at the step's end.
pub(crate) const STEPS: usize = NODES.len();

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

    /// The terms of the clock at the stages of a step of size `h` from `tau`, where it pays to compute them together and
    /// beforehand. Numbers that are lanes already have them at each stage, while the one before is waited for.
    #[inline(always)]
    fn clocks<M, const N: usize, const P: usize, const Q: usize, const C: usize>(
        _: &Segment<'_, Self, P, C>,
        _: Self,
        _: Self,
    ) -> Option<[M::Clock<Self>; STEPS]>
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

    /// The stages side by side in lanes: the terms do not wait for each other as the stages of a step do.
    #[inline(always)]
    fn clocks<M, const N: usize, const P: usize, const Q: usize, const C: usize>(
        segment: &Segment<'_, f64, P, C>,
        tau: f64,
        h: f64,
    ) -> Option<[M::Clock<f64>; STEPS]>
    where
        M: Model<N, P, Q>,
    {
        let first = side_by_side::<M, N, P, Q, C>(segment, tau, h, &const { nodes(0) });
        let second = side_by_side::<M, N, P, Q, C>(segment, tau, h, &const { nodes(WIDTH) });
        Some(core::array::from_fn(|i| M::clock_lane(if i < WIDTH { &first } else { &second }, i % WIDTH)))
    }
}

const WIDTH: usize = <Lanes as Real>::LANES;

/// As many nodes of a step as there are lanes, from number `first`; the last one fills what is left.
const fn nodes(first: usize) -> [f64; WIDTH] {
    let mut nodes = [NODES[STEPS - 1]; WIDTH];
    let mut i = 0;
    while i < WIDTH && first + i < STEPS {
        nodes[i] = NODES[first + i];
        i += 1;
    }
    nodes
}

/// The terms of the clock at some nodes of a step. They go through memory, where each is a number again.
#[inline(never)]
fn side_by_side<M, const N: usize, const P: usize, const Q: usize, const C: usize>(
    segment: &Segment<'_, f64, P, C>,
    tau: f64,
    h: f64,
    nodes: &[f64; WIDTH],
) -> M::Clock<Lanes>
where
    M: Model<N, P, Q>,
{
    // The bits of `stage_times`.
    let tau = Lanes::constant(h).mul_add(Lanes::from(*nodes), Lanes::constant(tau));
    let t = tau + Lanes::constant(segment.start);
    // A loop: `map` of arrays is not inlined here.
    let mut p = [Lanes::constant(0.0); P];
    for i in 0..P {
        p[i] = Lanes::constant(segment.p[i]);
    }
    M::clock(segment.mode, &Env { tau, t, p: &p, memory: &segment.wide_memory, branch: &segment.wide_branch })
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
