//! The problem as a nonlinear program in the scaled unknowns u: minimise f(u) subject to h(u) = 0 and c(u) >= 0.
//!
//! h is the scaled periodicity P(z; p) - z, c the scaled margins and Jury rows. One map evaluation gives all values and
//! all first derivatives except those of the Jacobian's entries (module `jacobian_derivative`).
//!
//! A robust problem has several scenes (module `scene`): one design, and in each scene a gait of its own. Coordinates, measures and
//! Jacobians of all scenes are stacked, the rows of each scene follow each other, and the objective is the worst of all.

use super::factors::Groups;
use super::jury;
use super::kkt::infeasibility;
use super::pieces::{self, Piece, Place};
use super::problem::{Bound, ConstraintKind, Expression, Objective, Problem, ProblemError, Sense, Value};
pub(super) use super::rows::Row;
use super::rows::{rows, slots};
use super::scene::Scene;
use super::task::{Goal, Task};
use super::variables::{DEADBEAT, Free, Variables, nominal_sizes};
use crate::orbit::{multipliers, spectral_radius};
use crate::return_map::{Candidate, MapResult, RequestError, Stop};
use nalgebra::DVector;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// The value of a row that there is room for, and no factor.
const NO_ROW: f64 = 1.0;

/// How many rows the pieces of a margin or objective have.
fn slots_of(split: bool) -> usize {
    if split { pieces::MOST } else { 1 }
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
    /// The multipliers of each block of Jury rows in groups; empty where these do not matter.
    pub(super) groups: Vec<Groups>,
    /// The places that compete for extrema, in each scene; none without pieces.
    pub(super) candidates: Vec<Vec<Candidate>>,
    /// Of each row, the place of its extremum, where it is one of several pieces.
    pub(super) places: Vec<Option<Place>>,
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
    /// The machines that the design is for; usually one, as it is.
    pub(super) scenes: Vec<Scene>,
    /// Whether margins and objective are split into pieces, one for each place of their extrema.
    pub(super) split: bool,
    /// Of each row, the scene.
    pub(super) row_scenes: Vec<usize>,
    /// The epigraph variable at the start, SI units.
    pub(super) epigraph_start: f64,
    /// Reference radius of each constraint's Jury rows (1 for margins).
    pub(super) references: Vec<f64>,
    /// Objective in SI units = sign * scale * f.
    pub(super) objective_scale: f64,
    /// The groups of multipliers whose factors have the Jury rows; empty for all in one.
    pub(super) groups: Mutex<Vec<Groups>>,
    /// Single maps so far, each with its sensitivities.
    pub(super) worked: AtomicUsize,
    /// Duration of the gait that the search follows (s), as bits; infinite before there is one.
    pub(super) followed: AtomicU64,
}

impl<'a> Program<'a> {
    /// The program around gaits of all scenes (at least one), given by their section coordinates one after the other; with `split`
    /// in pieces. Scales of unknowns and rows are fixed here and never change.
    pub(super) fn new(
        problem: &'a Problem<'a>,
        task: Task,
        (scenes, split): (Vec<Scene>, bool),
        (parameters, section): (&[f64], &[f64]),
    ) -> Result<Self, Failure> {
        let free = Variables::free(&problem.vary);
        let nominal = vec![1.0; section.len()];
        let (rows, row_scenes) = rows(problem, &task, scenes.len(), slots_of(split)).into_iter().unzip();
        let mut program = Self {
            problem,
            task,
            base: parameters.to_vec(),
            variables: Variables { free, nominal, epigraph: None, floor: DEADBEAT },
            rows,
            scenes,
            split,
            row_scenes,
            epigraph_start: 0.0,
            references: vec![1.0; problem.constraints.len()],
            objective_scale: 1.0,
            groups: Mutex::default(),
            worked: AtomicUsize::new(0),
            followed: AtomicU64::new(f64::INFINITY.to_bits()),
        };
        let (map, _) = program.image(parameters, section)?;
        program.variables.nominal = nominal_sizes(&map, section, &program.variables);
        if program.task.minimises_radius(problem) {
            let d = section.len();
            let radius = spectral_radius(&multipliers(&map.jacobian.columns(0, d).into_owned())).max(1e-3);
            program.variables.epigraph = Some(radius);
            program.epigraph_start = radius;
        }
        program.set_references(parameters, &map)?;
        program.set_worst(parameters, section)?;
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
            scenes: self.scenes.clone(),
            split: self.split,
            row_scenes: self.row_scenes.clone(),
            epigraph_start: self.epigraph_start,
            references: self.references.clone(),
            objective_scale: self.objective_scale,
            groups: Mutex::new(self.groups()),
            worked: AtomicUsize::new(0),
            followed: AtomicU64::new(f64::INFINITY.to_bits()),
        }
    }

    /// Counts on from the work of another program.
    pub(super) fn continues(&mut self, other: &Self) {
        self.worked = AtomicUsize::new(self.worked.load(Ordering::Relaxed) + other.worked.load(Ordering::Relaxed));
    }

    /// Whether the search has used up the work that it may do.
    pub(super) fn exhausted(&self) -> bool {
        let most = self.problem.settings.work.saturating_mul(self.scenes.len());
        self.worked.load(Ordering::Relaxed) >= most
    }

    fn set_references(&mut self, parameters: &[f64], map: &MapResult) -> Result<(), Failure> {
        for (i, constraint) in self.problem.constraints.iter().enumerate() {
            if let ConstraintKind::SpectralRadius { bound } = &constraint.kind {
                self.references[i] = match bound {
                    Bound::Constant(r) => *r,
                    Bound::Expression(e) => {
                        let r = self.value(&constraint.name, e.as_ref(), (0, map), parameters)?.value.abs();
                        if r > 1e-3 { r } else { 1.0 }
                    }
                };
            }
        }
        Ok(())
    }

    /// Scale 1 gives the raw objective and gradient; from these the scale.
    fn set_objective_scale(&mut self, parameters: &[f64], section: &[f64]) -> Result<(), Failure> {
        let u = self.variables.pack(parameters, section, self.epigraph_start);
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

    /// The function that is optimised, and its name; `None` where that is the epigraph variable.
    pub(super) fn goal(&self) -> Option<(&str, &dyn Expression)> {
        if self.worst() { None } else { self.target() }
    }

    /// The function that is optimised, or whose worst value over all scenes is; `None` for the spectral radius.
    pub(super) fn target(&self) -> Option<(&str, &dyn Expression)> {
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
        let holds = match self.target() {
            // With several scenes f is that of the epigraph variable, which is no better than any of them.
            Some(_) => point.f <= 0.0,
            None => self.radius(Some(i), &point.u, (0, &point.map), &point.parameters).is_ok_and(|bound| {
                let d = point.section.len();
                let multipliers = multipliers(&point.map.jacobian.columns(0, d).into_owned());
                spectral_radius(&multipliers) <= bound.value * self.reference(Some(i))
            }),
        };
        holds && infeasibility(point) <= 10.0 * settings.attainable_feasibility()
    }

    /// All values at u.
    pub(super) fn evaluate(&self, u: &DVector<f64>) -> Result<Point, Failure> {
        let parameters = self.variables.parameters(u.as_slice(), &self.base);
        let section = self.variables.section(u.as_slice());
        let image = self.image(&parameters, &section)?;
        self.at(u, (parameters, section), image, &self.groups())
    }

    /// All values at u, whose map is known, with the Jury rows of the factors that belong to groups near here.
    pub(super) fn at(
        &self,
        u: &DVector<f64>,
        (parameters, section): (Vec<f64>, Vec<f64>),
        (map, candidates): (MapResult, Vec<Vec<Candidate>>),
        near: &[Groups],
    ) -> Result<Point, Failure> {
        let (mut groups, mut places) = (Vec::new(), Vec::new());
        let f = self.sign() * self.objective(u, &map, &parameters)? / self.objective_scale;
        let h = DVector::from_fn(section.len(), |i, _| (map.coordinates[i] - section[i]) / self.variables.nominal[i]);
        let mut c = Vec::with_capacity(self.rows.len());
        for (row, &scene) in self.rows.iter().zip(&self.row_scenes) {
            places.resize(c.len(), None);
            match *row {
                // All rows of a block at once, when its first comes.
                Row::Worst(0) | Row::Margin(_, 0) => {
                    let pieces = self.block_pieces(*row, scene, (&map, &candidates), &parameters)?;
                    let first = c.len();
                    c.extend(pieces.iter().map(|piece| self.piece_row(*row, piece, u)));
                    places.extend(pieces.iter().map(Piece::place));
                    c.resize(first + slots_of(self.split), NO_ROW);
                }
                Row::Worst(_) | Row::Margin(..) => {}
                Row::Jury(of, 0) => {
                    let radius = self.radius(of, u, (scene, &map), &parameters)?.value;
                    let p = self.characteristic(of, scene, &map).coefficients;
                    let first = c.len();
                    if Groups::matter(self.problem.start.len()) {
                        let here = self.grouped((of, scene), &map, near.get(groups.len()))?;
                        let rows = here.factors(&p).into_iter().flat_map(|f| jury::rows(&f.coefficients, radius));
                        c.extend(rows.map(|row| row.value));
                        groups.push(here);
                    } else {
                        c.extend(jury::rows(&p, radius).iter().map(|row| row.value));
                    }
                    c.resize(first + slots(self.problem.start.len()), NO_ROW);
                }
                Row::Jury(..) => {}
            }
        }
        places.resize(c.len(), None);
        Ok(Point { u: u.clone(), parameters, section, map, f, h, c: DVector::from_vec(c), groups, candidates, places })
    }

    /// Objective in SI units.
    fn objective(&self, u: &DVector<f64>, map: &MapResult, parameters: &[f64]) -> Result<f64, Failure> {
        match self.goal() {
            Some((what, e)) => Ok(self.value(what, e, (0, map), parameters)?.value),
            None => {
                let unit = self.variables.epigraph.unwrap_or(1.0);
                Ok(self.variables.epigraph_at().map_or(0.0, |at| u[at] * unit))
            }
        }
    }

    /// An expression's value in a scene, checked: right lengths, finite.
    pub(super) fn value(
        &self,
        what: &str,
        e: &dyn Expression,
        (scene, map): (usize, &MapResult),
        parameters: &[f64],
    ) -> Result<Value, Failure> {
        let count = map.measures.len() / self.scenes.len();
        let measures = &map.measures.as_slice()[scene * count..(scene + 1) * count];
        let value = e.evaluate(measures, &self.scenes[scene].parameters(parameters));
        self.problem.check_value(what, &value).map_err(Failure::Wrong)?;
        if value.value.is_finite() { Ok(value) } else { Err(Failure::NotFinite(what.to_owned())) }
    }
}
