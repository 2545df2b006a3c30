//! What the Jury rows of the program are made of: the characteristic polynomial of each scene, the bound on its roots, and the
//! groups of multipliers whose factors have rows of their own (module `factors`).

use super::characteristic::Characteristic;
use super::factors::Groups;
use super::problem::{Bound, ConstraintKind, Value};
use super::program::{Failure, Point, Program};
use crate::orbit::multipliers;
use crate::return_map::MapResult;
use nalgebra::{DMatrix, DVector};
use std::sync::PoisonError;
use std::sync::atomic::Ordering;

impl Program<'_> {
    /// The multipliers of a scene in groups, those nearby if there are any.
    pub(super) fn grouped(
        &self,
        (of, scene): (Option<usize>, usize),
        map: &MapResult,
        near: Option<&Groups>,
    ) -> Result<Groups, Failure> {
        let roots = multipliers(&(self.own(scene, &self.scaled_jacobian(&map.jacobian)) / self.reference(of)));
        match near {
            None => Ok(Groups::whole(&roots)),
            Some(near) => {
                near.followed(&roots).ok_or_else(|| Failure::NotFinite("the order of the multipliers".to_owned()))
            }
        }
    }

    pub(super) fn groups(&self) -> Vec<Groups> {
        self.groups.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// From here on the Jury rows are those of the factors of this point, and its gait is the one that is followed; without a
    /// point, those of the whole polynomials, and none.
    pub(super) fn adopt(&self, point: Option<&Point>) {
        let duration = point.map_or(f64::INFINITY, |point| point.map.duration);
        self.followed.store(duration.to_bits(), Ordering::Relaxed);
        let groups = point.map_or_else(Vec::new, |point| point.groups.clone());
        *self.groups.lock().unwrap_or_else(PoisonError::into_inner) = groups;
    }

    /// The point with groups of multipliers that are right for it, which are adopted; and whether they are others than before.
    pub(super) fn settled(&self, point: Point) -> Result<(Point, bool), Failure> {
        let groups: Vec<Groups> = point.groups.iter().map(Groups::settled).collect();
        let others = groups != point.groups;
        let point = match others {
            true => self.at(&point.u, (point.parameters, point.section), (point.map, point.candidates), &groups)?,
            false => point,
        };
        self.adopt(Some(&point));
        Ok((point, others))
    }

    /// Unit of the bound of a constraint's Jury rows.
    pub(super) fn reference(&self, of: Option<usize>) -> f64 {
        of.map_or(self.variables.epigraph.unwrap_or(1.0), |i| self.references[i])
    }

    /// The bound on the spectral radius of a scene in units of its reference.
    pub(super) fn radius(
        &self,
        of: Option<usize>,
        u: &DVector<f64>,
        map: (usize, &MapResult),
        p: &[f64],
    ) -> Result<Value, Failure> {
        let info = self.problem.map.info();
        let constant = |value| Value {
            value,
            dmeasures: vec![0.0; info.measures.len()],
            dparameters: vec![0.0; info.parameters.len()],
        };
        let Some(constraint) = of.and_then(|i| self.problem.constraints.get(i)) else {
            return Ok(constant(self.variables.epigraph_at().map_or(1.0, |at| u[at])));
        };
        let reference = self.reference(of);
        match &constraint.kind {
            ConstraintKind::SpectralRadius { bound: Bound::Expression(e) } => {
                let mut value = self.value(&constraint.name, e.as_ref(), map, p)?;
                value.value /= reference;
                value.dmeasures.iter_mut().chain(&mut value.dparameters).for_each(|d| *d /= reference);
                Ok(value)
            }
            ConstraintKind::SpectralRadius { bound: Bound::Constant(r) } => Ok(constant(r / reference)),
            ConstraintKind::Margin { .. } => Ok(constant(1.0)),
        }
    }

    /// Characteristic polynomial of a scene's Jacobian in scaled coordinates, in units of the reference radius.
    pub(super) fn characteristic(&self, of: Option<usize>, scene: usize, map: &MapResult) -> Characteristic {
        Characteristic::new(&(self.own(scene, &self.scaled_jacobian(&map.jacobian)) / self.reference(of)))
    }

    /// The block of a scene in a matrix over the coordinates of all.
    pub(super) fn own(&self, scene: usize, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let block = self.block(scene);
        matrix.view((block.start, block.start), (block.len(), block.len())).into_owned()
    }

    /// The d x d Jacobian in scaled coordinates: a similarity, so the multipliers are the same.
    pub(super) fn scaled_jacobian(&self, jacobian: &DMatrix<f64>) -> DMatrix<f64> {
        let nominal = &self.variables.nominal;
        DMatrix::from_fn(nominal.len(), nominal.len(), |i, j| jacobian[(i, j)] * nominal[j] / nominal[i])
    }
}
