//! First derivatives of the nonlinear program in the scaled unknowns, by the chain rule through measures, the return
//! map's Jacobian, its characteristic polynomial and the Jury rows.

use super::factors::{Factor, Groups};
use super::jacobian_derivative::{JacobianDerivative, jacobian_derivative};
use super::jury;
use super::problem::Value;
use super::program::{Failure, Point, Program, Row};
use nalgebra::{DMatrix, DVector};

/// All first derivatives at a point, with respect to u.
#[derive(Clone, Debug)]
pub(super) struct Linearisation {
    /// Of the objective.
    pub(super) f: DVector<f64>,
    /// Of the periodicity, d x n.
    pub(super) h: DMatrix<f64>,
    /// Of the inequalities, rows x n.
    pub(super) c: DMatrix<f64>,
    /// For Jury rows: derivative with respect to the bound r, SI units; 0 for margins.
    pub(super) radius: Vec<f64>,
    /// The Jury rows are to about six digits, and right only for steps that stay with the gaits.
    pub(super) rough: bool,
    /// The gait follows the parameters: a multiplier near 1, where gaits meet or branch, is not close.
    pub(super) follows: bool,
}

/// Largest amplification of a disturbance of the periodicity with which a gait still follows the parameters.
const STEEP: f64 = 30.0;

/// The inverse of the periodicity's derivative in the coordinates (the last d of the first m + d columns), where it is not
/// large: then each set of parameters near here has one gait near here.
pub(super) fn following(periodicity: &DMatrix<f64>, m: usize, d: usize) -> Option<DMatrix<f64>> {
    let inverse = periodicity.columns(m, d).into_owned().try_inverse()?;
    inverse.iter().all(|x| x.abs() <= STEEP).then_some(inverse)
}

impl Program<'_> {
    /// All first derivatives at a point.
    pub(super) fn linearise(&self, point: &Point) -> Result<Linearisation, Failure> {
        self.linearise_to(point, false)
    }

    /// The same; `rough` where six digits and steps that stay with the gaits are enough (see `jacobian_derivative`).
    pub(super) fn linearise_to(&self, point: &Point, rough: bool) -> Result<Linearisation, Failure> {
        let wanted = self.rows.iter().any(|row| matches!(row, Row::Jury(..)));
        let derivative = match wanted {
            true => jacobian_derivative(self, point, rough)?,
            false => JacobianDerivative { along: Vec::new(), rough: false },
        };
        let mut c = DMatrix::zeros(self.rows.len(), self.len());
        let mut radius = vec![0.0; self.rows.len()];
        let mut groups = point.groups.iter();
        for (k, (row, &scene)) in self.rows.iter().zip(&self.row_scenes).enumerate() {
            match *row {
                // All rows of a block at once, when its first comes.
                Row::Worst(0) | Row::Margin(_, 0) => {
                    let image = (&point.map, point.candidates.as_slice());
                    for (i, piece) in self.block_pieces(*row, scene, image, &point.parameters)?.iter().enumerate() {
                        c.set_row(k + i, &self.piece_row_gradient(*row, piece, scene, point).transpose());
                    }
                }
                Row::Worst(_) | Row::Margin(..) => {}
                Row::Jury(of, 0) => {
                    for (i, (gradient, slope)) in self
                        .jury_gradients((of, scene), point, &derivative.along, groups.next())?
                        .into_iter()
                        .enumerate()
                    {
                        c.set_row(k + i, &gradient.transpose());
                        radius[k + i] = slope;
                    }
                }
                Row::Jury(..) => {}
            }
        }
        let (f, h) = (self.objective_gradient(point)?, self.periodicity_jacobian(point));
        if f.iter().chain(h.iter()).chain(c.iter()).all(|x| x.is_finite()) {
            let follows = following(&h, self.variables.free.len(), self.variables.nominal.len()).is_some();
            Ok(Linearisation { f, h, c, radius, rough: derivative.rough, follows })
        } else {
            Err(Failure::NotFinite("a derivative".to_owned()))
        }
    }

    /// Gradients of a block of Jury rows, and their derivatives with respect to the bound in SI units.
    fn jury_gradients(
        &self,
        (of, scene): (Option<usize>, usize),
        point: &Point,
        derivative: &[DMatrix<f64>],
        groups: Option<&Groups>,
    ) -> Result<Vec<(DVector<f64>, f64)>, Failure> {
        let bound = self.radius(of, &point.u, (scene, &point.map), &point.parameters)?;
        let reference = self.reference(of);
        let polynomial = self.characteristic(of, scene, &point.map);
        let slope = |d: &DMatrix<f64>| polynomial.derivative(&(self.own(scene, d) / reference));
        let slopes: Vec<Vec<f64>> = derivative.iter().map(slope).collect();
        let mut dbound = self.total(&bound, scene, point);
        if let (None, Some(at)) = (of, self.variables.epigraph_at()) {
            dbound[at] = 1.0;
        }
        let gradient = |row: &jury::Row, slopes: &[Vec<f64>]| {
            let through = |s: &Vec<f64>| -> f64 { s.iter().zip(&row.coefficients).map(|(a, b)| a * b).sum() };
            DVector::from_fn(self.len(), |j, _| slopes.get(j).map_or(0.0, through) + row.radius * dbound[j])
        };
        let rows = |coefficients: &[f64], slopes: &[Vec<f64>]| -> Vec<(DVector<f64>, f64)> {
            let rows = jury::rows(coefficients, bound.value);
            rows.iter().map(|row| (gradient(row, slopes), row.radius / reference)).collect()
        };
        let Some(groups) = groups else { return Ok(rows(&polynomial.coefficients, &slopes)) };
        let factors = groups.factors(&polynomial.coefficients);
        let of_factor = |factor: &Factor| {
            let own: Vec<Vec<f64>> = slopes.iter().map(|whole| factor.slope(whole)).collect();
            rows(&factor.coefficients, &own)
        };
        Ok(factors.iter().flat_map(of_factor).collect())
    }

    /// Of the periodicity, d x n.
    pub(super) fn periodicity_jacobian(&self, point: &Point) -> DMatrix<f64> {
        let d = self.variables.nominal.len();
        let mut h = DMatrix::zeros(d, self.len());
        for i in 0..d {
            for j in 0..self.variables.free.len() + d {
                h[(i, j)] =
                    point.map.jacobian[(i, self.column(j))] * self.variables.unit(j) / self.variables.nominal[i];
            }
            h[(i, self.variables.section_at() + i)] -= 1.0;
        }
        h
    }

    /// Sensitivity column of the map for unknown number j (parameter or coordinate).
    fn column(&self, j: usize) -> usize {
        let m = self.variables.free.len();
        if j < m { self.variables.nominal.len() + j } else { j - m }
    }

    pub(super) fn objective_gradient(&self, point: &Point) -> Result<DVector<f64>, Failure> {
        let gradient = match self.goal() {
            Some((what, e)) => {
                let value = self.value(what, e, (0, &point.map), &point.parameters)?;
                self.total(&value, 0, point)
            }
            None => {
                let unit = self.variables.epigraph.unwrap_or(1.0);
                DVector::from_fn(self.len(), |j, _| if Some(j) == self.variables.epigraph_at() { unit } else { 0.0 })
            }
        };
        Ok(gradient * (self.sign() / self.objective_scale))
    }

    /// Total derivative of an expression of a scene with respect to u, through the measures.
    pub(super) fn total(&self, value: &Value, scene: usize, point: &Point) -> DVector<f64> {
        let first = scene * value.dmeasures.len();
        self.total_through(value, scene, |k, j| point.map.measures_jacobian[(first + k, self.column(j))])
    }

    /// The same with the derivative of measure k of the scene with respect to unknown j from a function.
    pub(super) fn total_through(
        &self,
        value: &Value,
        scene: usize,
        slope: impl Fn(usize, usize) -> f64,
    ) -> DVector<f64> {
        let m = self.variables.free.len();
        let mut gradient = DVector::zeros(self.len());
        for j in 0..m + self.variables.nominal.len() {
            let through: f64 = value
                .dmeasures
                .iter()
                .enumerate()
                // A measure that does not matter may have no derivative there.
                .filter(|(_, d)| **d != 0.0)
                .map(|(k, d)| d * slope(k, j))
                .sum();
            let direct = match self.variables.free.get(j) {
                Some(free) if !self.scenes[scene].changes(free.parameter) => value.dparameters[free.parameter],
                _ => 0.0,
            };
            gradient[j] = (through + direct) * self.variables.unit(j);
        }
        gradient
    }
}
