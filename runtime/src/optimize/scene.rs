//! Scenes: the machines that one design has to serve. Each is the model with some parameters at other values, and has its own
//! gait; what the scenes have in common are the varied parameters.

use super::program::{Failure, Program};
use crate::return_map::{MapResult, Statistics};
use nalgebra::{DMatrix, DVector};
use std::borrow::Cow;

/// A machine: the values of some parameters, SI units, in place of those of the problem. None for the problem as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Scene {
    /// Indices into `info().parameters` with their values.
    pub(super) changed: Vec<(usize, f64)>,
}

impl Scene {
    /// All parameters in this scene.
    pub(super) fn parameters<'p>(&self, parameters: &'p [f64]) -> Cow<'p, [f64]> {
        if self.changed.is_empty() {
            return Cow::Borrowed(parameters);
        }
        let mut own = parameters.to_vec();
        for &(parameter, value) in &self.changed {
            own[parameter] = value;
        }
        Cow::Owned(own)
    }

    /// Whether a parameter has its own value here.
    pub(super) fn changes(&self, parameter: usize) -> bool {
        self.changed.iter().any(|(changed, _)| *changed == parameter)
    }
}

/// The maps of all scenes (at least one) as one: coordinates and measures one after the other, the Jacobian with a block for each
/// scene and common columns for the parameters. `d` is the number of coordinates of a scene. What belongs to a single run,
/// as events, is that of the first scene; the duration is the longest.
pub(super) fn stacked(maps: &[MapResult], d: usize) -> MapResult {
    let parameters = maps.iter().map(|map| map.jacobian.ncols().saturating_sub(d)).min().unwrap_or(0);
    let own = maps.iter().map(|map| map.jacobian.ncols().min(d)).min().unwrap_or(0);
    let joined = |part: fn(&MapResult) -> &DVector<f64>| {
        let all: Vec<f64> = maps.iter().flat_map(|map| part(map).iter().copied()).collect();
        DVector::from_vec(all)
    };
    let jacobian = |part: fn(&MapResult) -> &DMatrix<f64>| {
        let rows = maps.iter().map(|map| part(map).nrows()).sum();
        let mut all = DMatrix::zeros(rows, own * maps.len() + parameters);
        let mut row = 0;
        for (s, map) in maps.iter().map(part).enumerate() {
            let count = map.nrows();
            if map.ncols() > 0 {
                all.view_mut((row, own * s), (count, own)).copy_from(&map.columns(0, own));
                all.view_mut((row, own * maps.len()), (count, parameters)).copy_from(&map.columns(own, parameters));
            }
            row += count;
        }
        all
    };
    let work = maps.iter().map(|map| map.statistics).fold(Statistics::default(), |sum, one| Statistics {
        steps: sum.steps + one.steps,
        rejected: sum.rejected + one.rejected,
        evaluations: sum.evaluations + one.evaluations,
    });
    MapResult {
        coordinates: joined(|map| &map.coordinates),
        jacobian: jacobian(|map| &map.jacobian),
        state: joined(|map| &map.state),
        end: joined(|map| &map.end),
        measures: joined(|map| &map.measures),
        measures_jacobian: jacobian(|map| &map.measures_jacobian),
        statistics: work,
        duration: maps.iter().map(|map| map.duration).fold(0.0, f64::max),
        warnings: maps.iter().flat_map(|map| map.warnings.iter().copied()).collect(),
        ..maps[0].clone()
    }
}

impl Program<'_> {
    /// Whether what is optimised is the worst of several scenes or pieces, through an epigraph variable t: that of each is no
    /// worse than t. (The spectral radius has an epigraph of its own.)
    pub(super) fn worst(&self) -> bool {
        (self.scenes.len() > 1 || self.split) && !self.task.minimises_radius(self.problem)
    }

    /// By how much a value of the objective is better than t, in units of t.
    pub(super) fn shortfall(&self, value: f64, u: &DVector<f64>) -> f64 {
        let Some(at) = self.variables.epigraph_at() else { return 0.0 };
        -self.sign() * (value / self.variables.unit(at) - u[at])
    }

    /// Its gradient, from that of the value.
    pub(super) fn shortfall_gradient(&self, of_value: DVector<f64>) -> DVector<f64> {
        let Some(at) = self.variables.epigraph_at() else { return of_value };
        let mut gradient = of_value / self.variables.unit(at);
        gradient[at] -= 1.0;
        gradient * -self.sign()
    }

    /// Unit and first value of t: the size of the objective's derivatives, and the worst value at the start.
    pub(super) fn set_worst(&mut self, parameters: &[f64], section: &[f64]) -> Result<(), Failure> {
        if !self.worst() {
            return Ok(());
        }
        (self.variables.epigraph, self.variables.floor) = (Some(1.0), f64::NEG_INFINITY);
        let u = self.variables.pack(parameters, section, 0.0);
        let point = self.evaluate(&DVector::from_vec(u))?;
        let at = self.len() - 1;
        let (mut size, mut worst) = (0.0, f64::INFINITY);
        for scene in 0..self.scenes.len() {
            let Some((what, e)) = self.target() else { break };
            let value = self.value(what, e, (scene, &point.map), &point.parameters)?;
            let slope = self.shortfall_gradient(self.total(&value, scene, &point)).rows(0, at).amax();
            let value = self.shortfall(value.value, &point.u);
            size = f64::max(size, slope.max(1e-3 * value.abs()));
            worst = f64::min(worst, value);
        }
        self.variables.epigraph = Some(if size > 0.0 && size.is_finite() { size } else { 1.0 });
        self.epigraph_start = -self.sign() * worst;
        Ok(())
    }
}
