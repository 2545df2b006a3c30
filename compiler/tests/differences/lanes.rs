//! The flow in lanes and in two parts: each lane has the bits of a single evaluation, and the parts make the whole.

use super::Point;
use gaitc_runtime::model::{Env, Model};
use gaitc_runtime::scalar::{Lanes, Real, Scalar};

/// A state and its two columns.
type Fused<S, const N: usize> = ([S; N], [[S; N]; 2]);

pub(super) fn check<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    mode: usize,
    point: &Point<N, P>,
) {
    let truth = |holds: bool| Lanes::constant(if holds { -1.0 } else { 1.0 }).less(Lanes::constant(0.0));
    let branch: Vec<_> = point.branch.iter().map(|&holds| truth(holds)).collect();
    let memory: Vec<Lanes> = point.memory.iter().map(|&n| Lanes::constant(n)).collect();
    let column = |c: usize, i: usize| 0.3 + c as f64 - 0.7 * i as f64;
    let x = core::array::from_fn(|i| Lanes::from_lanes(|lane| state(point, i, lane)));
    let p = core::array::from_fn(|i| Lanes::from_lanes(|lane| parameter(point, i, lane)));
    let dx = core::array::from_fn(|c| core::array::from_fn(|i| Lanes::constant(column(c, i))));
    let tau = Lanes::from_lanes(|lane| clock(point, lane));
    let env = Env { tau, t: Lanes::constant(point.t), p: &p, memory: &memory, branch: &branch };
    let terms = M::clock(mode, &env);
    let (parts, whole) = (M::variational_at(mode, &x, &dx, &terms, &env), M::variational(mode, &x, &dx, &env));
    for lane in 0..Lanes::LANES {
        let x = core::array::from_fn(|i| state(point, i, lane));
        let p = core::array::from_fn(|i| parameter(point, i, lane));
        let dx = core::array::from_fn(|c| core::array::from_fn(|i| column(c, i)));
        let env = Env { tau: clock(point, lane), p: &p, ..point.env() };
        let single = M::variational(mode, &x, &dx, &env);
        same(lane, &whole, &single);
        let own = M::variational_at(mode, &x, &dx, &M::clock(mode, &env), &env);
        same(lane, &parts, &own);
        let from_lane = M::variational_at(mode, &x, &dx, &M::clock_lane(&terms, lane), &env);
        assert_eq!(bits(&own), bits(&from_lane));
        for (part, whole) in numbers(&own).iter().zip(numbers(&single)) {
            assert!((part - whole).abs() <= 1e-14 * whole.abs().max(1.0), "{part} {whole}");
        }
    }
}

fn state<const N: usize, const P: usize>(point: &Point<N, P>, i: usize, lane: usize) -> f64 {
    point.x[i] * (1.0 - 0.01 * lane as f64)
}

fn parameter<const N: usize, const P: usize>(point: &Point<N, P>, i: usize, lane: usize) -> f64 {
    point.p[i] * (1.0 + 0.01 * lane as f64)
}

fn clock<const N: usize, const P: usize>(point: &Point<N, P>, lane: usize) -> f64 {
    point.tau + 0.001 * lane as f64
}

fn numbers<S: Copy, const N: usize>((value, columns): &Fused<S, N>) -> Vec<S> {
    value.iter().chain(columns.iter().flatten()).copied().collect()
}

fn bits<const N: usize>(fused: &Fused<f64, N>) -> Vec<u64> {
    numbers(fused).iter().map(|number| number.to_bits()).collect()
}

/// Every number of a lane is that of the single evaluation, to the last bit; NaN is NaN.
fn same<const N: usize>(lane: usize, lanes: &Fused<Lanes, N>, single: &Fused<f64, N>) {
    for (a, b) in numbers(lanes).iter().zip(numbers(single)) {
        let a = a.lane(lane);
        assert!(a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()), "lane {lane}: {a:e} and {b:e}");
    }
}
