//! A request to stop: looked at between iterations, between the gaits that a start is followed along, and between the
//! maps of a confirmation.

use super::kkt::infeasibility;
use super::linearisation::Linearisation;
use super::program::Point;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set from outside (another thread, a signal handler) to end an optimisation early with the best gait found so far.
/// Clones share the request; the default can never be set.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Option<Arc<AtomicBool>>);

impl Interrupt {
    /// One that can be requested.
    pub fn new() -> Self {
        Self(Some(Arc::default()))
    }

    /// Asks to stop; returns whether that had been asked before.
    pub fn request(&self) -> bool {
        self.0.as_ref().is_some_and(|flag| flag.swap(true, Ordering::Relaxed))
    }

    /// Whether somebody asked to stop.
    pub fn requested(&self) -> bool {
        self.0.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}

/// Two are equal when they are the same request.
impl PartialEq for Interrupt {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b),
            (None, None) => true,
            _ => false,
        }
    }
}

/// Violation up to which a point on the way counts as one that meets the constraints: Newton's method on its gait and
/// rounding account for it.
const MET: f64 = 1e-6;

/// The best point of a search so far.
#[derive(Default)]
pub(super) struct Best(Option<(Point, Linearisation)>);

impl Best {
    /// Keeps a point that is better: one that meets the constraints before one that does not, then the lower objective,
    /// among those that do not the lower violation.
    pub(super) fn remember(&mut self, point: &Point, lin: &Linearisation) {
        let rank = |point: &Point| {
            let violation = infeasibility(point);
            if violation <= MET { (false, point.f) } else { (true, violation) }
        };
        if self.0.as_ref().is_none_or(|(known, _)| rank(point) < rank(known)) {
            self.0 = Some((point.clone(), lin.clone()));
        }
    }

    /// Goes back to it.
    pub(super) fn recall(self, point: &mut Point, lin: &mut Linearisation) {
        if let Some((best, derivatives)) = self.0 {
            (*point, *lin) = (best, derivatives);
        }
    }
}
