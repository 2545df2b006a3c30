//! How a gait stands with regard to a problem: objective, margins of all constraints, measures. Values only, from one map.

use super::gait::{self, NoGait, Start};
use super::problem::{Bound, ConstraintKind, Objective, Problem};
use crate::orbit;

/// Values at a gait.
#[derive(Clone, Debug)]
pub(super) struct Standing {
    /// Objective, SI units; NaN where it is not defined.
    pub(super) objective: f64,
    /// Margin of each constraint in SI units; for a bound on the spectral radius, what is left to it. NaN: not defined.
    pub(super) margins: Vec<f64>,
    /// The margins in units of their natural scales.
    pub(super) scaled: Vec<f64>,
    pub(super) measures: Vec<f64>,
    pub(super) spectral_radius: f64,
}

impl Standing {
    /// Whether a constraint holds, but for `tolerance` in units of its scale.
    pub(super) fn holds(&self, i: usize, tolerance: f64) -> bool {
        self.scaled.get(i).is_some_and(|margin| *margin >= -tolerance)
    }
}

/// The values at a gait.
pub(super) fn standing(problem: &Problem<'_>, gait: &Start) -> Result<Standing, NoGait> {
    let map = gait::map(problem, &gait.parameters, &gait.section, problem.settings.accuracy, true)?;
    let multipliers = orbit::multipliers(&map.jacobian.columns(0, gait.section.len()).into_owned());
    let spectral_radius = orbit::spectral_radius(&multipliers);
    let measures = map.measures.as_slice().to_vec();
    let value = |e: &dyn super::problem::Expression| e.evaluate(&measures, &gait.parameters).value;
    let (margins, scaled) = problem
        .constraints
        .iter()
        .map(|constraint| match &constraint.kind {
            ConstraintKind::Margin { margin, scale } => {
                let margin = value(margin.as_ref());
                (margin, margin / scale)
            }
            ConstraintKind::SpectralRadius { bound } => {
                let bound = match bound {
                    Bound::Constant(bound) => *bound,
                    Bound::Expression(e) => value(e.as_ref()),
                };
                (bound - spectral_radius, (bound - spectral_radius) / bound.abs().max(1e-3))
            }
        })
        .unzip();
    let objective = match &problem.objective {
        Objective::Expression(e) => value(e.as_ref()),
        Objective::SpectralRadius => spectral_radius,
    };
    Ok(Standing { objective, margins, scaled, measures, spectral_radius })
}
