//! The problem as a nonlinear program in the scaled unknowns u: minimise f(u) subject to h(u) = 0 and c(u) >= 0.
//!
//! h is the scaled periodicity P(z; p) - z, c the scaled margins and Jury rows. One map evaluation gives all values and
//! all first derivatives except those of the Jacobian's entries (module `jacobian_derivative`).

use super::characteristic::Characteristic;
use super::jury;
use super::kkt::infeasibility;
use super::problem::{Bound, ConstraintKind, Expression, Objective, Problem, ProblemError, Sense, Value};
use super::task::{Goal, Task};
use super::variables::{Free, Variables};
use crate::event::NOTHING;
use crate::orbit::{multipliers, spectral_radius};
use crate::return_map::{MapOutcome, MapRequest, MapResult, Plan, RequestError, Sensitivity, Stop};
use nalgebra::{DMatrix, DVector};

/// Where an inequality row comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Row {
    /// A margin (index into the problem's constraints).
    Margin(usize),
    /// A Jury inequality: of a constraint, or of the epigraph of the objective (`None`); which of them.
    Jury(Option<usize>, usize),
}

/// Why there are no values or derivatives at a point.
#[derive(Clone, Debug)]
pub(super) enum Failure {
    /// The map has no next section crossing.
    Stopped(Stop),
    /// This is not a finite number there.
    NotFinite(String),
    /// The Jacobian cannot be differenced: the map stops at every neighbour.
    NoDerivative,
    /// The problem itself is wrong.
    Wrong(ProblemError),
}

impl From<RequestError> for Failure {
    fn from(error: RequestError) -> Self {
        Self::Wrong(error.into())
    }
}

/// All values at a point.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) u: DVector<f64>,
    pub(super) parameters: Vec<f64>,
    pub(super) section: Vec<f64>,
    pub(super) map: MapResult,
    /// Scaled objective, to be minimised.
    pub(super) f: f64,
    /// Scaled periodicity.
    pub(super) h: DVector<f64>,
    /// Scaled inequalities.
    pub(super) c: DVector<f64>,
}

/// The nonlinear program.
pub(super) struct Program<'a> {
    pub(super) problem: &'a Problem<'a>,
    /// What the search is after.
    pub(super) task: Task,
    /// Parameters at the start; those not varied keep their values.
    pub(super) base: Vec<f64>,
    pub(super) variables: Variables,
    pub(super) rows: Vec<Row>,
    /// Reference radius of each constraint's Jury rows (1 for margins).
    references: Vec<f64>,
    /// Objective in SI units = sign * scale * f.
    pub(super) objective_scale: f64,
}

impl<'a> Program<'a> {
    /// The program around a gait: scales of unknowns and rows are fixed here and never change.
    pub(super) fn new(
        problem: &'a Problem<'a>,
        task: Task,
        parameters: &[f64],
        section: &[f64],
    ) -> Result<Self, Failure> {
        let free = Variables::free(&problem.vary);
        let nominal = vec![1.0; section.len()];
        let rows = rows(problem, &task);
        let mut program = Self {
            problem,
            task,
            base: parameters.to_vec(),
            variables: Variables { free, nominal, epigraph: None },
            rows,
            references: vec![1.0; problem.constraints.len()],
            objective_scale: 1.0,
        };
        let map = program.map(parameters, section)?;
        program.variables.nominal = nominal_sizes(&map, section, &program.variables);
        if program.task.minimises_radius(problem) {
            let d = section.len();
            program.variables.epigraph =
                Some(spectral_radius(&multipliers(&map.jacobian.columns(0, d).into_owned())).max(1e-3));
        }
        program.set_references(parameters, &map)?;
        program.set_objective_scale(parameters, section)?;
        Ok(program)
    }

    /// The same program with other parameters free, the rest as in `base`: rows, scales of coordinates and of rows stay.
    pub(super) fn with_free(&self, free: Vec<Free>, base: &[f64]) -> Self {
        Self {
            problem: self.problem,
            task: self.task.clone(),
            base: base.to_vec(),
            variables: Variables { free, ..self.variables.clone() },
            rows: self.rows.clone(),
            references: self.references.clone(),
            objective_scale: self.objective_scale,
        }
    }

    fn set_references(&mut self, parameters: &[f64], map: &MapResult) -> Result<(), Failure> {
        for (i, constraint) in self.problem.constraints.iter().enumerate() {
            if let ConstraintKind::SpectralRadius { bound } = &constraint.kind {
                self.references[i] = match bound {
                    Bound::Constant(r) => *r,
                    Bound::Expression(e) => {
                        let r = self.value(&constraint.name, e.as_ref(), map, parameters)?.value.abs();
                        if r > 1e-3 { r } else { 1.0 }
                    }
                };
            }
        }
        Ok(())
    }

    /// Scale 1 gives the raw objective and gradient; from these the scale.
    fn set_objective_scale(&mut self, parameters: &[f64], section: &[f64]) -> Result<(), Failure> {
        let u = self.variables.pack(parameters, section, self.variables.epigraph.unwrap_or(0.0));
        let point = self.evaluate(&DVector::from_vec(u))?;
        let gradient = self.objective_gradient(&point)?;
        let scale = gradient.amax().max(1e-3 * point.f.abs());
        self.objective_scale = if scale > 0.0 && scale.is_finite() { scale } else { 1.0 };
        Ok(())
    }

    /// Number of unknowns.
    pub(super) fn len(&self) -> usize {
        self.variables.len()
    }

    /// +1 when minimising, -1 when maximising.
    pub(super) fn sign(&self) -> f64 {
        match self.task.goal {
            Goal::Asked if self.problem.sense == Sense::Minimize => 1.0,
            Goal::Push(_) if self.task.minimises_radius(self.problem) => 1.0,
            Goal::Asked | Goal::Push(_) => -1.0,
        }
    }

    /// The function that is optimised, and its name; `None` for the spectral radius.
    pub(super) fn goal(&self) -> Option<(&str, &dyn Expression)> {
        match self.task.goal {
            Goal::Asked => match &self.problem.objective {
                Objective::Expression(e) => Some(("the objective", e.as_ref())),
                Objective::SpectralRadius => None,
            },
            Goal::Push(i) => self.problem.constraints.get(i).and_then(|constraint| match &constraint.kind {
                ConstraintKind::Margin { margin, .. } => Some((constraint.name.as_str(), margin.as_ref())),
                ConstraintKind::SpectralRadius { .. } => None,
            }),
        }
    }

    /// Whether the search has got what it is after before any optimum: the constraint that it pushes holds.
    pub(super) fn reached(&self, point: &Point) -> bool {
        let Goal::Push(i) = self.task.goal else { return false };
        let settings = &self.problem.settings;
        let holds = match self.goal() {
            Some(_) => point.f <= 0.0,
            None => self.radius(Some(i), &point.u, &point.map, &point.parameters).is_ok_and(|bound| {
                let d = point.section.len();
                let multipliers = multipliers(&point.map.jacobian.columns(0, d).into_owned());
                spectral_radius(&multipliers) <= bound.value * self.reference(Some(i))
            }),
        };
        holds && infeasibility(point) <= 10.0 * settings.attainable_feasibility()
    }

    /// The return map with the sensitivities that the program needs.
    fn map(&self, parameters: &[f64], section: &[f64]) -> Result<MapResult, Failure> {
        let columns: Vec<usize> = self.variables.free.iter().map(|free| free.parameter).collect();
        self.request(parameters, section, Sensitivity::CoordinatesAndParameters(&columns), true)
    }

    /// One evaluation of the map; a result that is not finite is a failure.
    pub(super) fn request(
        &self,
        parameters: &[f64],
        section: &[f64],
        sensitivity: Sensitivity<'_>,
        measures: bool,
    ) -> Result<MapResult, Failure> {
        let outcome = self.problem.map.evaluate(&MapRequest {
            coordinates: section,
            parameters,
            memory: &self.problem.memory,
            period: self.problem.period,
            sensitivity,
            measures,
            accuracy: self.problem.settings.accuracy,
        })?;
        match outcome {
            MapOutcome::Stopped(stop) => Err(Failure::Stopped(stop)),
            MapOutcome::Completed(map) => {
                let finite = map.coordinates.iter().chain(map.jacobian.iter()).all(|x| x.is_finite());
                if finite { Ok(*map) } else { Err(Failure::NotFinite("the return map".to_owned())) }
            }
        }
    }

    /// The plan of the map at a point, if there is one for a single map.
    pub(super) fn plan(&self, parameters: &[f64], section: &[f64]) -> Result<Option<Plan>, Failure> {
        let (_, plan) = self.problem.map.plan(&MapRequest {
            coordinates: section,
            parameters,
            memory: &self.problem.memory,
            period: self.problem.period,
            sensitivity: Sensitivity::Coordinates,
            measures: false,
            accuracy: self.problem.settings.accuracy,
        })?;
        Ok(plan)
    }

    /// All values at u.
    pub(super) fn evaluate(&self, u: &DVector<f64>) -> Result<Point, Failure> {
        let parameters = self.variables.parameters(u.as_slice(), &self.base);
        let section = self.variables.section(u.as_slice());
        let map = self.map(&parameters, &section)?;
        let f = self.sign() * self.objective(u, &map, &parameters)? / self.objective_scale;
        let h = DVector::from_fn(section.len(), |i, _| (map.coordinates[i] - section[i]) / self.variables.nominal[i]);
        let mut c = Vec::with_capacity(self.rows.len());
        if self.task.minimises_radius(self.problem) {
            let radius = self.radius(None, u, &map, &parameters)?.value;
            c.extend(jury::rows(&self.characteristic(None, &map).coefficients, radius).iter().map(|row| row.value));
        }
        for (i, constraint) in self.problem.constraints.iter().enumerate() {
            match &constraint.kind {
                _ if !self.task.keeps(i) => {}
                ConstraintKind::Margin { margin, scale } => {
                    c.push(self.value(&constraint.name, margin.as_ref(), &map, &parameters)?.value / scale);
                }
                ConstraintKind::SpectralRadius { .. } => {
                    let radius = self.radius(Some(i), u, &map, &parameters)?.value;
                    let p = self.characteristic(Some(i), &map);
                    c.extend(jury::rows(&p.coefficients, radius).iter().map(|row| row.value));
                }
            }
        }
        Ok(Point { u: u.clone(), parameters, section, map, f, h, c: DVector::from_vec(c) })
    }

    /// Objective in SI units.
    fn objective(&self, u: &DVector<f64>, map: &MapResult, parameters: &[f64]) -> Result<f64, Failure> {
        match self.goal() {
            Some((what, e)) => Ok(self.value(what, e, map, parameters)?.value),
            None => {
                let unit = self.variables.epigraph.unwrap_or(1.0);
                Ok(self.variables.epigraph_at().map_or(0.0, |at| u[at] * unit))
            }
        }
    }

    /// An expression's value, checked: right lengths, finite.
    pub(super) fn value(
        &self,
        what: &str,
        e: &dyn Expression,
        map: &MapResult,
        parameters: &[f64],
    ) -> Result<Value, Failure> {
        let value = e.evaluate(map.measures.as_slice(), parameters);
        self.problem.check_value(what, &value).map_err(Failure::Wrong)?;
        if value.value.is_finite() { Ok(value) } else { Err(Failure::NotFinite(what.to_owned())) }
    }

    /// Unit of the bound of a constraint's Jury rows.
    pub(super) fn reference(&self, of: Option<usize>) -> f64 {
        of.map_or(self.variables.epigraph.unwrap_or(1.0), |i| self.references[i])
    }

    /// The bound on the spectral radius in units of its reference.
    pub(super) fn radius(
        &self,
        of: Option<usize>,
        u: &DVector<f64>,
        map: &MapResult,
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

    /// Characteristic polynomial of the Jacobian in scaled coordinates, in units of the reference radius.
    pub(super) fn characteristic(&self, of: Option<usize>, map: &MapResult) -> Characteristic {
        Characteristic::new(&(self.scaled_jacobian(&map.jacobian) / self.reference(of)))
    }

    /// The d x d Jacobian in scaled coordinates: a similarity, so the multipliers are the same.
    pub(super) fn scaled_jacobian(&self, jacobian: &DMatrix<f64>) -> DMatrix<f64> {
        let nominal = &self.variables.nominal;
        DMatrix::from_fn(nominal.len(), nominal.len(), |i, j| jacobian[(i, j)] * nominal[j] / nominal[i])
    }
}

/// Rows in the order in which `evaluate` writes them.
fn rows(problem: &Problem<'_>, task: &Task) -> Vec<Row> {
    let jury = |of| (0..jury::count(problem.start.len())).map(move |which| Row::Jury(of, which));
    let mut rows = Vec::new();
    if task.minimises_radius(problem) {
        rows.extend(jury(None));
    }
    for (i, constraint) in problem.constraints.iter().enumerate() {
        match constraint.kind {
            _ if !task.keeps(i) => {}
            ConstraintKind::Margin { .. } => rows.push(Row::Margin(i)),
            ConstraintKind::SpectralRadius { .. } => rows.extend(jury(Some(i))),
        }
    }
    rows
}

/// Nominal size of each coordinate: its magnitude at the gait, or how far the gait moves (to first order) when the
/// parameters cross their ranges, whichever is larger; 1 where both vanish.
fn nominal_sizes(map: &MapResult, section: &[f64], variables: &Variables) -> Vec<f64> {
    let d = section.len();
    let inverse = (DMatrix::identity(d, d) - map.jacobian.columns(0, d)).try_inverse();
    let shift = |i: usize| -> f64 {
        let Some(inverse) = &inverse else { return 0.0 };
        let move_of = |j: usize| (inverse.row(i) * map.jacobian.column(d + j))[0] * variables.unit(j);
        (0..variables.free.len()).map(move_of).fold(0.0, |a: f64, b| a.max(b.abs()))
    };
    (0..d)
        .map(|i| {
            let size = section[i].abs().max(shift(i).min(10.0 * section[i].abs().max(1.0)));
            if size > NOTHING && size.is_finite() { size } else { 1.0 }
        })
        .collect()
}
