//! The second-order condition: whether a point that meets the first-order conditions is an optimum.
//!
//! On the directions of the critical cone (module `critical_cone`) the sign of the Lagrangian's Hessian decides. It comes
//! from central differences of the Lagrangian's exact gradient along a basis of those directions, multipliers held, at
//! two step sizes: what they differ by, and what the result lacks of symmetry, says how far it can be trusted.

use super::critical_cone::{CriticalCone, Sign, sign};
use super::kkt::gait_gradient;
use super::problem::Vary;
use super::program::{Failure, Point, Program};
use super::search::Ended;
use super::solution::{Curvature, Shape};
use super::subproblem::Multipliers;
use super::variables::Variables;
use nalgebra::{DMatrix, DVector};

/// First steps of the differences in scaled unknowns; the later ones where the map stops earlier.
const STEPS: [f64; 3] = [1e-3, 1e-4, 1e-5];
/// By how much ranges are widened on each side: a difference at a bound may look beyond it.
const WIDER: f64 = 0.25;
/// An eigenvalue has to be clear of the differences' error by this factor ...
const CLEAR: f64 = 3.0;
/// ... and of zero by this, relative to the largest entry of the Hessian, or to one where that is less.
const FLAT: f64 = 1e-7;
/// Part of the largest component from which on a parameter belongs to a direction.
const TAKES_PART: f64 = 0.1;

/// What the second derivatives say, and the direction that leads off a saddle, in scaled unknowns.
pub(super) struct SecondOrder {
    pub(super) curvature: Curvature,
    pub(super) descent: Option<DVector<f64>>,
}

/// Looks at the point where a search ended.
pub(super) fn second_order(program: &Program<'_>, ended: &Ended) -> SecondOrder {
    let cone = CriticalCone::at(program, ended);
    let blank = Curvature {
        shape: Shape::Undecided,
        constraints: cone.strong - usize::from(program.variables.epigraph.is_some()).min(cone.strong),
        weak: cone.weak.nrows(),
        directions: cone.basis.ncols(),
        smallest: f64::NAN,
        error: f64::NAN,
        along: Vec::new(),
    };
    if cone.basis.ncols() == 0 {
        return SecondOrder { curvature: Curvature { shape: Shape::Vertex, ..blank }, descent: None };
    }
    let Some((hessian, error)) = Widened::around(program, &ended.point).hessian(&cone.basis, &ended.multipliers) else {
        return SecondOrder { curvature: blank, descent: None };
    };
    let tolerance = f64::max(CLEAR * error, FLAT * hessian.amax().max(1.0));
    let found = |shape, smallest, direction: Option<&DVector<f64>>| Curvature {
        shape,
        smallest,
        error,
        along: direction.map_or_else(Vec::new, |t| part(program, &(&cone.basis * t))),
        ..blank.clone()
    };
    match sign(&hessian, &cone.weak, tolerance) {
        Sign::Positive(least) if least.is_finite() => {
            SecondOrder { curvature: found(Shape::Strict, least, None), descent: None }
        }
        Sign::Positive(_) => SecondOrder { curvature: found(Shape::Vertex, f64::NAN, None), descent: None },
        Sign::Flat(least, t) => SecondOrder { curvature: found(Shape::Flat, least, Some(&t)), descent: None },
        Sign::Negative(least, t) => {
            SecondOrder { curvature: found(Shape::Saddle, least, Some(&t)), descent: Some(&cone.basis * &t) }
        }
        Sign::Undecided => SecondOrder { curvature: found(Shape::Undecided, f64::NAN, None), descent: None },
    }
}

/// The varied parameters that take part in a direction, the largest share first.
fn part(program: &Program<'_>, direction: &DVector<f64>) -> Vec<usize> {
    let free = &program.variables.free;
    let share = |i: usize| direction[i].abs();
    let largest = (0..free.len()).map(share).fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..free.len()).filter(|&i| share(i) > TAKES_PART * largest.max(1e-9)).collect();
    order.sort_by(|a, b| share(*b).total_cmp(&share(*a)));
    order.into_iter().map(|i| free[i].parameter).collect()
}

/// The program with wider ranges, so that differences need not stop at the bounds.
struct Widened<'a> {
    program: Program<'a>,
    /// The point in its unknowns, ...
    u: DVector<f64>,
    /// ... and how long a unit of the narrow program's unknowns is there.
    scale: DVector<f64>,
}

impl<'a> Widened<'a> {
    fn around(program: &Program<'a>, point: &Point) -> Self {
        let (narrow, n) = (&program.variables, program.len());
        let ranges: Vec<Vary> = (narrow.free.iter().enumerate())
            .map(|(i, free)| {
                let (lower, more) = (free.value(0.0), WIDER * narrow.unit(i));
                Vary { parameter: free.parameter, lower: lower - more, upper: free.value(1.0) + more }
            })
            .collect();
        let wide = program.with_free(Variables::free(&ranges), &point.parameters);
        let radius = narrow.epigraph_at().map_or(0.0, |at| point.u[at] * narrow.unit(at));
        let u = DVector::from_vec(wide.variables.pack(&point.parameters, &point.section, radius));
        let scale = DVector::from_fn(n, |i, _| narrow.unit(i) / wide.variables.unit(i));
        Self { program: wide, u, scale }
    }

    /// Hessian of the Lagrangian on the columns of a basis, and its error; `None` where the map stops next to the point.
    fn hessian(&self, basis: &DMatrix<f64>, multipliers: &Multipliers) -> Option<(DMatrix<f64>, f64)> {
        let r = basis.ncols();
        let (mut hessian, mut error) = (DMatrix::zeros(r, r), 0.0_f64);
        for j in 0..r {
            let along = basis.column(j).into_owned();
            let (column, off) = STEPS.into_iter().find_map(|h| self.column(basis, &along, h, multipliers).ok())?;
            hessian.set_column(j, &column);
            error = error.max(off);
        }
        let error = error.max((&hessian - hessian.transpose()).amax());
        let symmetric = (&hessian + hessian.transpose()) * 0.5;
        (error.is_finite() && symmetric.iter().all(|x| x.is_finite())).then_some((symmetric, error))
    }

    /// One column by extrapolated differences, and by how much two steps differ.
    fn column(
        &self,
        basis: &DMatrix<f64>,
        along: &DVector<f64>,
        h: f64,
        multipliers: &Multipliers,
    ) -> Result<(DVector<f64>, f64), Failure> {
        let difference = |h: f64| -> Result<DVector<f64>, Failure> {
            let change = self.gradient(&(along * h), multipliers)? - self.gradient(&(along * -h), multipliers)?;
            Ok(basis.tr_mul(&change) / (2.0 * h))
        };
        let (wide, narrow) = (difference(h)?, difference(0.5 * h)?);
        let off = (&narrow - &wide).amax();
        Ok(((narrow * 4.0 - wide) / 3.0, off))
    }

    /// Gradient of the Lagrangian with these multipliers of the inequalities after a step in the narrow program's unknowns, in these.
    fn gradient(&self, step: &DVector<f64>, multipliers: &Multipliers) -> Result<DVector<f64>, Failure> {
        let point = self.program.evaluate(&(&self.u + step.component_mul(&self.scale)))?;
        let lin = self.program.linearise(&point)?;
        Ok(gait_gradient(&self.program, &lin, multipliers).component_mul(&self.scale))
    }
}
