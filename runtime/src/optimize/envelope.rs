//! How the optimum follows the parameters that are held fixed.
//!
//! By the envelope theorem the derivative of the best objective with respect to a parameter q of the problem is that of the
//! Lagrangian at the optimum, unknowns and multipliers held: what q does to the objective, to the periodicity of the gait
//! and to the active constraints, each at its price. So the program is linearised once more there, with the fixed
//! parameters as further unknowns.

use super::kkt::gait_gradient;
use super::problem::Vary;
use super::program::{Failure, Program};
use super::search::Ended;
use super::solution::Sensitivity;
use super::variables::Variables;
use nalgebra::DVector;

/// Range around a fixed value, relative to it: sets the step of differences where second-order sensitivities are missing.
const RANGE: f64 = 0.5;

/// The derivative of the optimum with respect to each fixed parameter, the largest change for one per cent of its value first.
/// Parameters without a derivative (those of a power, or at the edge of their domain) are left out.
pub(super) fn sensitivities(program: &Program<'_>, ended: &Ended) -> Vec<Sensitivity> {
    let varied = |p: usize| program.variables.free.iter().any(|free| free.parameter == p);
    let fixed: Vec<usize> = (0..ended.point.parameters.len()).filter(|p| !varied(*p)).collect();
    // All at once; one by one where one of them has no derivative.
    let mut all = of(program, ended, &fixed)
        .unwrap_or_else(|_| fixed.iter().filter_map(|p| of(program, ended, &[*p]).ok()).flatten().collect());
    let share = |s: &Sensitivity| (s.derivative * ended.point.parameters[s.parameter]).abs();
    all.sort_by(|a, b| share(b).total_cmp(&share(a)));
    all
}

/// Of some of the fixed parameters, all or none.
fn of(program: &Program<'_>, ended: &Ended, fixed: &[usize]) -> Result<Vec<Sensitivity>, Failure> {
    if fixed.is_empty() {
        return Ok(Vec::new());
    }
    let point = &ended.point;
    let ranges: Vec<Vary> = fixed
        .iter()
        .map(|&parameter| {
            let value = point.parameters[parameter];
            let room = if value == 0.0 { RANGE } else { RANGE * value.abs() };
            Vary { parameter, lower: value - room, upper: value + room }
        })
        .collect();
    let extended = program.with_free(Variables::free(&ranges), &point.parameters);
    let radius = program.variables.epigraph_at().map_or(0.0, |at| point.u[at] * program.variables.unit(at));
    let u = extended.variables.pack(&point.parameters, &point.section, radius);
    let at = extended.evaluate(&DVector::from_vec(u))?;
    let gradient = gait_gradient(&extended, &extended.linearise(&at)?, &ended.multipliers);
    let scale = program.sign() * program.objective_scale;
    let derivative = |i: usize| scale * gradient[i] / extended.variables.unit(i);
    let found = |(i, &parameter): (usize, &usize)| Sensitivity { parameter, derivative: derivative(i) };
    Ok(fixed.iter().enumerate().map(found).filter(|s| s.derivative.is_finite()).collect())
}
