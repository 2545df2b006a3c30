//! Branch selectors at the start of a segment: on which side of every switching function it starts.
//!
//! Selectors may depend on each other (a switching function under the selector of another): each round settles at least
//! one more of a chain, so as many rounds as there are switches suffice unless they contradict each other.

use super::arming::start_side;
use super::surface::{Side, Surface, read};
use crate::integrate::{Frame, Method};
use crate::model::Model;

/// Sets the selectors of `switches` by the plain sign of their functions.
pub(crate) fn by_sign<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    switches: &[usize],
    tau: f64,
    x: &[f64; N],
) -> Vec<bool> {
    let mut branch = frame.branch.to_vec();
    settle(&mut branch, switches, |branch, i| M::switch(i, x, &Frame { branch, ..frame }.env(tau)) >= 0.0);
    branch
}

/// Sets the selectors of `switches` by the first of value and derivatives that is not zero; `k` is the rate as far as it is
/// known.
pub(crate) fn by_derivative<X: Method, M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    frame: Frame<'_, P>,
    switches: &[usize],
    tau: f64,
    (x, k): (&[f64; N], &[f64; N]),
    typical: f64,
) -> Vec<bool> {
    let mut branch = frame.branch.to_vec();
    settle(&mut branch, switches, |branch, i| {
        let frame = Frame { branch, ..frame };
        let surface = Surface::Switch(i);
        let k = X::rate::<M, N, P, Q>(frame, tau, x, k);
        let reading = read::<M, N, P, Q>(surface, x, &k, &frame.env(tau));
        start_side::<X, M, N, P, Q>(frame, surface, &reading, tau, (x, &k), typical).side != Side::Negative
    });
    branch
}

fn settle(branch: &mut [bool], switches: &[usize], selected: impl Fn(&[bool], usize) -> bool) {
    for _ in 0..=switches.len() {
        let mut changed = false;
        for &i in switches {
            let value = selected(branch, i);
            if let Some(slot) = branch.get_mut(i).filter(|slot| **slot != value) {
                *slot = value;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
}
