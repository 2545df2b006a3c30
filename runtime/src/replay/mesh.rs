//! The mesh of a plan, spread evenly over the errors.
//!
//! Error control finds its way: the first step of a leg is careful, the last is cut off by the event. The error of a step of
//! size h behaves like (rho h)^p, with rho the speed at which the solution changes; steps of equal rho h have equal errors, and
//! as few of them as the tolerance allows do.

use super::plan::{Leg, Plan, Sides};
use crate::event::Side;
use crate::ode::explicit::ERROR_ORDER;

/// Errors that steps are spread to, relative to the tolerance: maps near the plan's have somewhat larger ones.
const AIM: f64 = 0.7;
/// A speed is not known from an error below this.
const SMALLEST: f64 = 1e-6;

impl Plan {
    /// Plans with fewer steps, or the same number of equal ones, the boldest first. Each has to be tried.
    pub(crate) fn spread(&self) -> impl Iterator<Item = Self> + '_ {
        (0..self.most_steps()).map(|more| {
            let spread = |leg: &Leg| spread(leg, more).unwrap_or_else(|| leg.clone());
            let turns = self.turns.iter().map(|legs| legs.iter().map(spread).collect()).collect();
            Self { turns, ..self.clone() }
        })
    }

    fn most_steps(&self) -> usize {
        self.legs().map(|leg| leg.sizes.len()).max().unwrap_or(0)
    }
}

/// A leg on an even mesh, with `more` steps than its errors ask for; `None` when there is no more to gain.
fn spread(leg: &Leg, more: usize) -> Option<Leg> {
    let steady = leg.watched.iter().all(|sides| sides.at.windows(2).all(|pair| matches!(pair, [a, b] if a == b)));
    if leg.sizes.len() < 2 || !steady {
        return None;
    }
    let mut shares = Vec::with_capacity(leg.sizes.len());
    let mut speed = None;
    for (size, error) in leg.sizes.iter().zip(&leg.errors) {
        // The last step is no more than a part of one; it goes on like the one before.
        if *error > 0.0 {
            speed = Some(error.max(SMALLEST).powf(1.0 / ERROR_ORDER) / size);
        }
        shares.push(speed? * size);
    }
    let total: f64 = shares.iter().sum();
    let count = (total / AIM.powf(1.0 / ERROR_ORDER)).ceil() as usize + more;
    if count == 0 || count > leg.sizes.len() {
        return None;
    }
    let places: Vec<f64> = (0..=count).map(|i| place(leg, &shares, total * i as f64 / count as f64)).collect();
    let sizes = places.windows(2).map(|pair| if let [a, b] = pair { b - a } else { 0.0 }).collect();
    let sides = |s: &Sides| Sides { at: vec![s.at.first().copied().unwrap_or(Side::Unknown); count + 1], ..s.clone() };
    let errors = (0..count).map(|i| if i + 1 < count { AIM } else { 0.0 }).collect();
    Some(Leg { sizes, errors, watched: leg.watched.iter().map(sides).collect(), ..leg.clone() })
}

/// The time after the start of the leg at which so much of the shares is used up.
fn place(leg: &Leg, shares: &[f64], mut rest: f64) -> f64 {
    let mut time = 0.0;
    for (size, share) in leg.sizes.iter().zip(shares) {
        if rest < *share {
            return time + size * rest / share;
        }
        (time, rest) = (time + size, rest - share);
    }
    time
}
