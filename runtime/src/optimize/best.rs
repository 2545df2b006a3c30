//! What an interrupted search ends with: the best gait found so far. The request to stop is looked at between iterations, between
//! the gaits that a start is followed along, and between the maps of a confirmation.

use super::kkt::infeasibility;
use super::linearisation::Linearisation;
use super::program::Point;

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
